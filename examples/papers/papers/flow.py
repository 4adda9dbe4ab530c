"""Directions of plastic flow and the deviatoric plane (paper 004). Vectors hold principal values along x, y, z."""

from dataclasses import dataclass

import numpy as np

from hypofab.results import Array


def octahedral_unit(angle: float) -> Array:
    """Unit deviator with tension positive at a Lode angle [deg], as deviator() of probe_stress.py."""
    turns = np.radians(angle + np.array([120.0, 0.0, -120.0]))
    return -np.sqrt(2 / 3) * np.cos(turns)


def octahedral(vectors: Array) -> tuple[Array, Array]:
    """Coordinates of vectors (x, y, z) in the deviatoric plane: y up, x to the lower left, z to the lower right."""
    x, y, z = np.moveaxis(np.asarray(vectors), -1, 0)
    return (z - x) / np.sqrt(2), (2 * y - x - z) / np.sqrt(6)


@dataclass(frozen=True)
class Flow:
    """The direction of plastic strains."""

    direction: Array
    """Unit vector of principal strains, tension positive; it has a positive part along the stress deviator."""
    share: float
    """Of the squares of all plastic strains that lies along it; 1: the envelope is a straight line."""

    @property
    def angle(self) -> float:
        """Lode angle of the flow, compression positive [deg]; that of the stress where flow and stress are aligned."""
        return float(np.degrees(np.arctan2(*octahedral(-self.direction))))


def flow_of(plastic: Array, stress: Array) -> Flow:
    """The direction that holds most of the plastic strains (probes, 3); stress (3,), tension positive."""
    _, values, axes = np.linalg.svd(plastic, full_matrices=False)
    return Flow(axes[0] * np.sign(axes[0] @ (stress - stress.mean())), float(values[0] ** 2 / np.sum(values**2)))


def range_of(plastic: Array) -> tuple[float, float]:
    """Smallest and largest Lode angle [deg] of those plastic strains that are at least a third of the largest."""
    size = np.linalg.norm(plastic, axis=1)
    angles = np.degrees(np.arctan2(*octahedral(-plastic[size > size.max() / 3])))
    return float(angles.min()), float(angles.max())


def amount_of(increments: Array, plastic: Array, flow: Flow) -> tuple[Array, Array]:
    """Cosine of each increment with the flow direction, and the plastic strain along it per stress."""
    size = np.linalg.norm(increments, axis=1)
    return increments @ flow.direction / size, (plastic @ flow.direction) / size


def cross_section(fabric: Array) -> Array:
    """Density 1 + F:nn in 72 directions n of the deviatoric plane, F = 7.5 (N - 1/3); clockwise from y."""
    turn = np.linspace(0, 2 * np.pi, 73)
    right, up = np.array([-1, 0, 1]) / np.sqrt(2), np.array([-1, 2, -1]) / np.sqrt(6)
    normals = np.outer(np.sin(turn), right) + np.outer(np.cos(turn), up)
    return 1 + 7.5 * normals**2 @ (fabric - 1 / 3)
