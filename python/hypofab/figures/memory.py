"""Figures of results in memory, in one line. Each function returns a matplotlib Figure: .savefig("figure.png").

The same figures as `hypofab plot` draws from files.
"""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from hypofab.errors import InputError, Status
from hypofab.fabric.changes import Directions
from hypofab.fabric.samples import Fabric
from hypofab.figures import cycles
from hypofab.figures import element_tests as figures
from hypofab.figures import fabric as fabric_figures
from hypofab.figures import paths as path_figures
from hypofab.figures import probes as probe_figures
from hypofab.figures import sensitivities as sensitivity_figures
from hypofab.figures import surfaces as probe_surfaces
from hypofab.figures.envelopes import response_envelopes
from hypofab.model.materials import Material
from hypofab.model.probing import Subspace, fit_ellipsoid, triangles
from hypofab.results import vtp
from hypofab.results.cycles import accumulation_of
from hypofab.results.element_tests import Run, TestResult
from hypofab.results.envelopes import EnvelopeSeries
from hypofab.results.fabric import Result
from hypofab.results.measured import Measured, read_measured
from hypofab.results.probes import Envelope, Probes, ProbeSeries
from hypofab.results.sensitivities import Sensitivities
from hypofab.tensors import Array, norm

Tests = TestResult | Mapping[str, TestResult] | Iterable[TestResult]

KINDS = {
    "stress_strain": figures.stress_strain,
    "volumetric": figures.volumetric,
    "stress_path": figures.stress_path,
    "compression": path_figures.compression,
    "loops": path_figures.loops,
}
"""Figures of element tests: q over eps_q, eps_v over eps_q, q over p, void ratio over log p, q over axial strain."""


def plot(
    tests: Tests,
    kind: str = "stress_strain",
    *,
    measured: Measured | Mapping[str, str | Path] | None = None,
    **options: Any,  # noqa: ANN401 - of the figure
) -> Figure:
    """One figure of one or several element tests; a mapping gives the labels.

    kind: one of KINDS; "accumulation": a quantity at the ends of cycles (options quantity, default "eps_acc", and log);
    "sensitivities" of one test: its curve with each number changed (options x, y, change, numbers).
    measured: data to draw over, label -> columns by their names in results (also eps_1, e), or label -> CSV file.
    options: those of the figure's function in hypofab.figures.element_tests or hypofab.figures.paths, as zoom=1e-3.
    """
    if isinstance(tests, Mapping):
        several = list(tests.items())
    else:
        several = [(test.name, test) for test in ([tests] if isinstance(tests, TestResult) else tests)]
    if not several:
        raise InputError("no test to draw, expected at least one", Status.BAD_ARGUMENT)
    if kind == "accumulation":
        return _accumulation(several, **options)
    if kind == "sensitivities":
        return _sensitivities(several, **options)
    if kind not in KINDS:
        raise InputError(
            f"kind = '{kind}', expected one of {', '.join([*KINDS, 'accumulation', 'sensitivities'])}",
            Status.BAD_ARGUMENT,
        )
    return KINDS[kind](_run(several), measured=_data(measured or {}), **options)


def plot_envelopes(
    states: Mapping[str, Probes], *, compression_positive: bool = False, unit: str = "kPa", what: str = "envelope"
) -> Figure:
    """Response envelopes of one or several states in one figure, by their names.

    Probes in the axisymmetric plane give the envelope of Gudehus, in another plane rays and fitted ellipses, over the
    sphere of principal values surfaces in space, in all components the stiffness over the angle to delta.
    what = "flow", "fan" or "stiffness" gives these instead. unit: that of stress, for the labels.
    """
    first = next(iter(states.values()), None)
    if first is None:
        raise InputError("no probes to draw, expected at least one state", Status.BAD_ARGUMENT)
    directions, basis = _space(first)
    envelope = _envelope(states, directions, basis, unit)
    others = {
        "fan": lambda: probe_figures.fan(envelope, compression_positive=compression_positive),
        "flow": lambda: probe_figures.flow(envelope),
        "stiffness": lambda: probe_figures.directional_stiffness(envelope),
    }
    if what in others:
        return others[what]()
    if what != "envelope":
        raise InputError(f"what = '{what}', expected one of envelope, {', '.join(others)}", Status.BAD_ARGUMENT)
    if directions == "axisymmetric" and not envelope.imposes_stress:
        series = [_classical(name, probe, basis, unit) for name, probe in states.items()]
        return response_envelopes(series, compression_positive=compression_positive)
    if directions == "principal":
        pieces = [_piece(index, probe) for index, probe in enumerate(states.values())]
        return probe_surfaces.surfaces_of(envelope, list(states), pieces, compression_positive=compression_positive)
    return others["stiffness" if directions == "all_components" else "fan"]()


def plot_fabrics(samples: Mapping[str, Fabric], *, up: str = "z") -> Figure:
    """Surfaces of the density of contact normals, samples beside each other; up: the axis that stands upright."""
    if not samples:
        raise InputError("no fabric to draw, expected at least one", Status.BAD_ARGUMENT)
    data = [
        Result(name, Path(), {"deviatoric_fabric": list(one.deviatoric_fabric), "anisotropy": one.anisotropy})
        for name, one in samples.items()
    ]
    return fabric_figures.surfaces(data, up=up)


def plot_directions(directions: Directions, label: str = "sample") -> Figure:
    """Contact directions on the sphere with the density of second order; in the plane as a rose with its fit."""
    bins = [
        {
            "polar": polar,
            "azimuth": azimuth,
            "density": density,
            "normal_force": None,
            "shear_force": (None, None, None),
        }
        for polar, azimuth, density in zip(directions.polar, directions.azimuth, directions.density, strict=True)
    ]
    fabric = directions.fabric
    x, y, _ = fabric.principal_directions[0]
    fit = {"a_n": fabric.anisotropy, "phi_n": np.degrees(np.arctan2(y, x)), "mean_normal_force": None}
    data = {
        "bins": bins,
        "contacts": int(directions.contacts.sum()),
        "anisotropy": fabric.anisotropy,
        "deviatoric_fabric": list(fabric.deviatoric_fabric),
        "principal_directions": fabric.principal_directions,
        "fit": fit,
    }
    draw = fabric_figures.sphere if directions.dimension == 3 else fabric_figures.plane_roses
    return draw(Result(label, Path(), data))


def _data(measured: Measured | Mapping[str, str | Path]) -> Measured:
    """Data as columns, files read."""
    files = {label: one for label, one in measured.items() if isinstance(one, str | Path)}
    columns = {label: one for label, one in measured.items() if not isinstance(one, str | Path)}
    return {**columns, **read_measured(files)}


def _run(tests: list[tuple[str, TestResult]]) -> Run:
    """Tests by their labels as a run."""
    first = tests[0][1]
    return Run(first.unit, first.sign < 0, tuple(replace(test, name=label) for label, test in tests))


def _accumulation(tests: list[tuple[str, TestResult]], *, quantity: str = "eps_acc", log: bool = False) -> Figure:
    found = [accumulation_of(label, *(test[name] for name in ("cycle", "step", quantity))) for label, test in tests]
    cyclic = [one for one in found if one is not None]
    if not cyclic:
        raise InputError("no test with cycles among these", Status.BAD_ARGUMENT)
    return cycles.figure(cyclic, quantity, logarithmic=log)


def _sensitivities(tests: list[tuple[str, TestResult]], **options: Any) -> Figure:  # noqa: ANN401 - of the figure
    (label, test), *others = tests
    if others or not test.sensitivities:
        raise InputError("expected one test that was run with sensitivities", Status.BAD_ARGUMENT)
    columns = {name: test.rows[name] for name in next(iter(test.sensitivities.values()))}
    known = {name: float(values[0]) for name, values in columns.items()} | dict(test.material or {})
    found = Sensitivities(label, columns, test.sensitivities, known, test.unit)
    return sensitivity_figures.curves(found, **options)


def _space(probe: Probes) -> tuple[str, Array]:
    """The kind of the space of probes, by the keys of decks, and its basis."""
    for axis in "xyz":
        space = Subspace.axisymmetric(axis)
        if _within(space, probe.direction):
            return "axisymmetric", space.basis
    rank = np.linalg.matrix_rank(probe.direction, tol=1e-8)
    if rank <= 2:
        second = next(
            (d for d in probe.direction if np.linalg.matrix_rank([probe.direction[0], d], tol=1e-8) == 2), None
        )
        if second is None:
            raise InputError("all probes have one direction, expected at least two", Status.BAD_ARGUMENT)
        return "plane", Subspace.plane(probe.direction[0], second).basis
    space = Subspace.principal()
    return ("principal", space.basis) if _within(space, probe.direction) else ("all_components", np.eye(6))


def _within(space: Subspace, tensors: Array) -> bool:
    """Do tensors lie in a space?"""
    return bool(np.abs(space.coordinates(tensors) @ space.basis - tensors).max() < 1e-9)


def _classical(name: str, probe: Probes, basis: Array, unit: str) -> EnvelopeSeries:
    """One state in the axisymmetric plane: coordinates are the axial part and sqrt(2) times the lateral one."""
    space = Subspace(basis)
    direction, response = space.coordinates(probe.direction), space.coordinates(probe.response)
    size = probe.material.memory_size if isinstance(probe.material, Material) else 0.0
    delta = space.coordinates(probe.delta) / (size or 1.0)
    return EnvelopeSeries(
        name or "response",
        np.degrees(np.arctan2(direction[:, 1], direction[:, 0])),
        *response.T,
        (float(delta[0]), float(delta[1])),
        unit,
    )


def _envelope(states: Mapping[str, Probes], directions: str, basis: Array, unit: str) -> Envelope:
    """Probes by their names as an envelope."""

    def series(name: str, probe: Probes) -> ProbeSeries:
        fitted = directions in ("axisymmetric", "plane") and len(probe) > len(basis) + 3
        return ProbeSeries.of(
            probe, name or "response", basis, fit_ellipsoid(Subspace(basis), probe) if fitted else None
        )

    first = next(iter(states.values()))
    return Envelope(
        name="",
        unit=unit,
        compression_positive=False,
        directions=directions,
        imposes_stress=first.imposed == "stress",
        size=first.size,
        file=Path(),
        vtk=None,
        series=tuple(series(name, probe) for name, probe in states.items()),
    )


def _piece(index: int, probe: Probes) -> vtp.Piece:
    """The closed surface of the answers in the space of principal values; probes without answer are at the origin."""
    points = np.nan_to_num(probe.response[:, :3])
    mean = float(np.mean(norm(probe.response))) if len(probe) else 0.0
    if np.abs(probe.response[:, 3:]).max(initial=0.0) > 1e-9 * mean:
        raise InputError("answers have shear components: principal axes are not x, y, z", Status.BAD_ARGUMENT)
    return vtp.Piece(points, triangles(len(probe)), {"series": np.array([index]), "part": np.array([0])})
