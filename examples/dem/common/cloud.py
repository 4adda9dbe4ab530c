"""Loose clouds of particles without contacts."""

import math

import numpy as np
from yade import Body, O, Sphere, Vector3, utils

from common.folder import fail
from common.material import Material


def grains() -> list:
    """All spheres of the scene."""
    return [body for body in O.bodies if isinstance(body.shape, Sphere)]


def particle(body: Body) -> Body:
    """The particle a sphere belongs to: itself, or its clump."""
    return O.bodies[body.clumpId] if body.isClumpMember else body


def disc_number(body: Body) -> int:
    """Number of a disc in its clump, 0 or 1; a clump follows its two discs in the order of ids."""
    return body.id - body.clumpId + 2


def particles() -> list:
    """All particles of the scene in the order of their ids."""
    ids = {particle(body).id for body in grains()}
    return [O.bodies[i] for i in sorted(ids)]


def solid_volume() -> float:
    """Volume of all grains, noted when they were added [m3]."""
    return float(O.tags["solid_volume"])


def note_solid_volume(material: Material, diameters: np.ndarray) -> None:
    """Note the volume of grains that have been added; the note is saved with the scene."""
    before = solid_volume() if O.tags.has_key("solid_volume") else 0.0
    O.tags["solid_volume"] = repr(before + material.solid_volume(diameters))


def edge(material: Material, diameters: np.ndarray, void_ratio: float) -> float:
    """Edge of the cube or square that holds the particles at a void ratio [m]."""
    return (material.solid_volume(diameters) * (1 + void_ratio)) ** (1 / material.dimension)


def random_positions(
    diameters: np.ndarray, sides: list[float], random: np.random.Generator, periodic: bool
) -> np.ndarray:
    """Positions without overlap: largest first, each at the first free place of many random ones.

    sides: extent along x, y, z [m], 0 along z in two dimensions. With walls (not periodic) particles keep inside.
    """
    number, reach = len(diameters), float(max(diameters))
    box = np.array(sides)
    dims = [i for i in range(3) if box[i] > 0]
    shape = [max(1, int(box[i] / reach)) for i in dims]
    cells: dict[tuple, list[int]] = {}
    positions = np.zeros((number, 3))
    offsets = np.array(np.meshgrid(*[[-1, 0, 1]] * len(dims))).reshape(len(dims), -1).T

    def cell_of(point: np.ndarray) -> tuple:
        return tuple(min(int(point[i] / box[i] * n), n - 1) for i, n in zip(dims, shape, strict=True))

    for index in np.argsort(-diameters):
        radius = diameters[index] / 2
        for _ in range(20000):
            margin = 0.0 if periodic else radius
            point = np.zeros(3)
            point[dims] = margin + random.random(len(dims)) * (box[dims] - 2 * margin)
            home = np.array(cell_of(point))
            near = {tuple((home + offset) % shape) for offset in offsets}
            others = [other for key in near for other in cells.get(key, ())]
            if others:
                distance = positions[others] - point
                if periodic:
                    distance[:, dims] -= box[dims] * np.round(distance[:, dims] / box[dims])
                if np.any(np.sum(distance**2, axis=1) < (radius + diameters[others] / 2) ** 2):
                    continue
            positions[index] = point
            cells.setdefault(cell_of(point), []).append(int(index))
            break
        else:
            fail(f"no room for {number} particles in a box of {sides} m")
    return positions


def add_particles(material: Material, diameters: np.ndarray, positions: np.ndarray) -> list[int]:
    """Add spheres, or discs of 1 m length that stay in the plane z = 0, and return their ids."""
    ids = []
    for diameter, position in zip(diameters, positions, strict=True):
        radius = float(diameter) / 2
        body = utils.sphere(Vector3(*position), radius, material="grains")
        if material.dimension == 2:
            mass = material.density * math.pi * radius**2
            body.state.mass = mass
            body.state.inertia = Vector3(1, 1, 1) * (mass * radius**2 / 2)
            body.state.blockedDOFs = "zXY"
        ids.append(O.bodies.append(body))
    return ids
