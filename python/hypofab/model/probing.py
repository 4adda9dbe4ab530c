"""Probes of a state, response envelopes and their ellipsoids, and stability of a state."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hypofab.errors import InputError, Status, error_of
from hypofab.library import check, core, interruptible, last_message
from hypofab.model.materials import Material
from hypofab.model.points import Branch
from hypofab.model.states import State
from hypofab.results.probes import Ellipsoid, Probes
from hypofab.tensors import Array, components, coordinates, many_components

AXES = ("x", "y", "z")


@dataclass(frozen=True, slots=True, eq=False)
class Subspace:
    """A linear space of tensors for probes: orthonormal tensors, (2, 3 or 6, 6). Coordinates in it are isometric."""

    basis: Array

    @classmethod
    def axisymmetric(cls, axis: str = "y") -> "Subspace":
        """The axisymmetric plane: coordinates are the axial component and sqrt(2) times the lateral one."""
        return cls._make(0, axis=_axis(axis))

    @classmethod
    def plane(cls, first: ArrayLike, second: ArrayLike) -> "Subspace":
        """The plane that two tensors span; the first basis tensor is along the first."""
        return cls._make(1, components(first, "first"), components(second, "second"))

    @classmethod
    def principal(cls, axes_of: ArrayLike | None = None) -> "Subspace":
        """Tensors with the principal directions of a tensor (None: x, y, z); coordinates are principal values."""
        return cls._make(2) if axes_of is None else cls._make(3, components(axes_of, "axes_of"))

    @classmethod
    def all_components(cls) -> "Subspace":
        """All tensors; coordinates xx, yy, zz, sqrt(2) xy, sqrt(2) xz, sqrt(2) yz."""
        return cls._make(4)

    @classmethod
    def _make(cls, kind: int, first: ArrayLike = (0,) * 6, second: ArrayLike = (0,) * 6, axis: int = 0) -> "Subspace":
        status, dimension, basis = core.subspace(kind, axis, first, second)
        check(status)
        return cls(basis[: dimension[0]].copy())

    @property
    def dimension(self) -> int:
        """2, 3 or 6."""
        return len(self.basis)

    def coordinates(self, tensors: ArrayLike) -> Array:
        """Coordinates of tensors (..., 6): (..., dimension)."""
        return coordinates(self.basis, tensors)

    def directions(self, n: int) -> Array:
        """Evenly distributed unit tensors, (n, 6). Three dimensions: 5 or more; six: an even number."""
        if n < 1:
            raise InputError(f"{n} directions, expected 1 or more", Status.BAD_ARGUMENT)
        status, tensors = core.directions(self.basis, n)
        check(status)
        return tensors


def triangles(n: int) -> NDArray[np.intc]:
    """The closed surface on n directions of a space of three dimensions: (2 n - 4, 3) indices."""
    status, corners = core.triangles(n, max(2 * n - 4, 1))
    check(status)
    return corners


def probe(
    material: Material,
    state: State,
    directions: ArrayLike,
    *,
    impose: str = "strain",
    size: float = 0.0,
    unload: bool = False,
    tolerance: float = 0.0,
    threads: int = 1,
    check_probes: bool = False,
) -> Probes:
    """Probe one state in many directions (n, 6), each from the state anew.

    impose: "strain" or "stress". size: norm of the increment; 0: rates. unload: then back by the same increment.
    check_probes: raise the exception of the first probe without answer; else look at `status`.
    """
    if impose not in ("strain", "stress"):
        raise InputError(f"impose = '{impose}', expected strain or stress", Status.BAD_ARGUMENT)
    tensors = many_components(directions, "directions")
    imposed = int(impose == "stress")
    options = (imposed, size, unload, tolerance, threads, tensors)
    message = ""

    def call(stop: NDArray[np.intc]) -> tuple:
        nonlocal message
        results = core.probe(material.numbers(), state.numbers(), *options, stop)
        message = last_message()
        return results

    status, answers, measures, statuses = interruptible(call)
    if status >= Status.BAD_MATERIAL or (status and check_probes):
        raise error_of(status, message)
    return Probes(
        *(impose, answers[:, :6], answers[:, 6:12], answers[:, 12:], statuses, *measures.T),
        *(material, state, float(size)),
    )


def envelope(material: Material, state: State, n: int = 72, axis: str = "y", **options: object) -> Probes:
    """Response envelope of a state in the axisymmetric plane (Gudehus 1979): n probes, options as probe()."""
    return probe(material, state, Subspace.axisymmetric(axis).directions(n), **options)


def fit_ellipsoid(space: Subspace, probes: Probes, part: str = "response") -> Ellipsoid:
    """Fit an ellipsoid to the answers of evenly distributed probes; part: "response" or "irrecoverable"."""
    if part not in ("response", "irrecoverable"):
        raise InputError(f"part = '{part}', expected response or irrecoverable", Status.BAD_ARGUMENT)
    answers = np.hstack([probes.direction, probes.response, probes.irrecoverable])
    status, numbers, distances = core.probe_fit(space.basis, answers, probes.status, int(part == "irrecoverable"))
    check(status)
    points, distance, nonlinearity, straightness = map(float, numbers[:4])
    return Ellipsoid(
        centre=numbers[4:10],
        semi_axis=numbers[10 : 10 + space.dimension],
        axis=numbers[22:].reshape(6, 6)[: space.dimension],
        distance=distance,
        nonlinearity=nonlinearity,
        direction=numbers[16:22],
        straightness=straightness,
        points=int(points),
        distances=distances,
    )


@dataclass(frozen=True, slots=True, eq=False)
class Stability:
    """Stability of a state over all strain rates and all planes; docs/stability.md."""

    work: float
    """smallest second-order work over |D| = 1 [stress]"""
    work_ratio: float
    """over that of the state without memory"""
    acoustic: float
    """smallest determinant of the acoustic tensor [stress^3]; <= 0: a band can form"""
    acoustic_ratio: float
    """over that on this plane without memory"""
    band_angle: float
    """between the band's normal and the most compressive principal stress [deg]; NaN for isotropic stress"""
    band_dilatancy: float
    """[deg]"""
    bound: float
    """|L^-1 N|; 1 on the bound surface"""
    work_direction: Array
    """the D of the smallest second-order work"""
    band_normal: Array
    band_mode: Array
    work_branch: Branch
    acoustic_branch: Branch


def state_stability(material: Material, state: State) -> Stability:
    """Measures of stability of a state."""
    status, numbers, branches = core.stability(material.numbers(), state.numbers())
    check(status)
    tensors = numbers[7:13], numbers[13:16], numbers[16:19]
    return Stability(*map(float, numbers[:7]), *tensors, *map(Branch, branches))


def _axis(name: str) -> int:
    if name not in AXES:
        raise InputError(f"axis = {name!r}, expected x, y or z", Status.BAD_ARGUMENT)
    return AXES.index(name)
