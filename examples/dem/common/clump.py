"""Elongated particles of two dimensions: two overlapping equal discs with an aspect ratio of 0.6 (paper 003)."""

import math

import numpy as np
from yade import O, Vector3, utils

from common.material import Material

ASPECT_RATIO = 0.6
DISTANCE = 2 * (1 / ASPECT_RATIO - 1)
"""Between the centres of the two discs, over their radius."""
LENS = 2 * math.acos(DISTANCE / 2) - DISTANCE / 2 * math.sqrt(4 - DISTANCE**2)
"""Area where the discs overlap, over radius^2."""
AREA = 2 * math.pi - LENS
"""Area of a particle, over radius^2."""
REACH = 2 + DISTANCE
"""Length of a particle, over radius."""


def _lens_inertia() -> float:
    """Polar moment of the overlap about its centre, over radius^4, by Simpson's rule over its width."""
    half = 1 - DISTANCE / 2
    x = np.linspace(-half, half, 2001)
    y = np.sqrt(np.maximum(0, 1 - (np.abs(x) + DISTANCE / 2) ** 2))
    f = 2 * (x**2 * y + y**3 / 3)
    weights = np.ones_like(x)
    weights[1:-1:2], weights[2:-1:2] = 4, 2
    return float(np.sum(weights * f) * (x[1] - x[0]) / 3)


POLAR_MOMENT = 2 * (math.pi / 2 + math.pi * (DISTANCE / 2) ** 2) - _lens_inertia()
"""Polar moment of area of a particle about its centre, over radius^4."""


def disc_radius(diameter: float) -> float:
    """Radius of the two discs of a particle with the area of a disc of this diameter [m]."""
    return diameter / 2 * math.sqrt(math.pi / AREA)


def circumscribed(diameters: np.ndarray) -> np.ndarray:
    """Diameters of the discs that hold the particles in every orientation [m]."""
    return np.array([REACH * disc_radius(d) for d in diameters])


def add_clumps(material: Material, diameters: np.ndarray, positions: np.ndarray, angles: np.ndarray) -> list[int]:
    """Add particles of 1 m length with given angles of their long axis [rad]; the ids of the clumps."""
    ids = []
    for diameter, position, angle in zip(diameters, positions, angles, strict=True):
        radius = disc_radius(float(diameter))
        offset = np.array([math.cos(angle), math.sin(angle), 0.0]) * (DISTANCE / 2 * radius)
        members = [
            utils.sphere(Vector3(*(position + sign * offset)), radius, material="grains") for sign in (-1.0, 1.0)
        ]
        clump_id, _ = O.bodies.appendClumped(members, discretization=0)
        clump = O.bodies[clump_id]
        clump.state.mass = material.density * AREA * radius**2
        clump.state.inertia = Vector3(1, 1, 1) * (material.density * POLAR_MOMENT * radius**4)
        clump.state.blockedDOFs = "zXY"
        clump.aspherical = False  # only rotation about z, for which one moment is enough
        ids.append(clump_id)
    return ids
