"""Contact and particle lists as `hypofab` reads them, and the numbers of a state."""

import math

import numpy as np
from yade import Body, O, Sphere, utils

from common.boundary import Boundary
from common.cloud import disc_number, grains, particle, particles, solid_volume
from common.folder import Folder
from common.material import Material

CONTACT_COLUMNS = [
    "id1",
    "id2",
    "cellDist_x",
    "cellDist_y",
    "cellDist_z",
    "nx",
    "ny",
    "nz",
    "bx",
    "by",
    "bz",
    "Fnx",
    "Fny",
    "Fnz",
    "Fsx",
    "Fsy",
    "Fsz",
    "penetration",
    "cpx",
    "cpy",
    "cpz",
]
SHORT = 8
"""Columns of a short list."""

PARTICLE_COLUMNS = ["id", "radius", "x", "y", "z", "angle", "n_contacts"]


def contacts() -> np.ndarray:
    """Contacts between particles, one row each with the columns CONTACT_COLUMNS; contacts with walls are left out.

    Two clumps that touch in two points have two contacts. cellDist_z, not needed in two dimensions, tells them apart:
    it is 0 to 3, twice the number of the first clump's disc plus that of the second's.

    The normal runs from id1 to id2. The branch vector is x2 + cell * cellDist - x1, because YADE does not wrap
    positions into the cell. Forces are those that id1 exerts on id2.
    """
    cell = np.array([[O.cell.hSize[i, j] for j in range(3)] for i in range(3)]) if O.periodic else np.zeros((3, 3))
    rows = []
    for contact in O.interactions:
        first, second = O.bodies[contact.id1], O.bodies[contact.id2]
        if not contact.isReal or not (isinstance(first.shape, Sphere) and isinstance(second.shape, Sphere)):
            continue
        if contact.geom.penetrationDepth < 0:
            continue
        period = np.array(contact.cellDist, dtype=float) if O.periodic else np.zeros(3)
        shift = cell @ period
        if first.isClumpMember:
            period[2] += 2 * disc_number(first) + disc_number(second)
        first, second = particle(first), particle(second)
        branch = np.array(second.state.pos) + shift - np.array(first.state.pos)
        geom, phys = contact.geom, contact.phys
        rows.append(
            [
                first.id,
                second.id,
                *period,
                *geom.normal,
                *branch,
                *phys.normalForce,
                *phys.shearForce,
                geom.penetrationDepth,
                *geom.contactPoint,
            ]
        )
    return np.array(rows, dtype=float).reshape(-1, len(CONTACT_COLUMNS))


def void_ratio(boundary: Boundary) -> float:
    """Void ratio e of the whole sample; particles of 1 m length in two dimensions."""
    return boundary.volume() / solid_volume() - 1


def anisotropy(normals: np.ndarray, dimension: int) -> float:
    """A of paper 000 (Eq. 4) in three dimensions, a_n of paper 003 (Eq. 3) in two, where a_n = 2 (Phi_1 - Phi_2)."""
    if len(normals) == 0:
        return 0.0
    tensor = normals.T @ normals / len(normals)
    if dimension == 2:
        return float(2 * np.hypot(tensor[0, 0] - tensor[1, 1], 2 * tensor[0, 1]))
    deviator = 7.5 * (tensor - np.eye(3) / 3)
    return math.sqrt(1.5 * np.sum(deviator**2))


def state(boundary: Boundary, material: Material, rows: np.ndarray | None = None) -> dict:
    """The numbers of the present state: stress [kPa], void ratio, coordination numbers, anisotropy and its noise."""
    rows = contacts() if rows is None else rows
    ids = np.array([body.id for body in particles()])
    counts = np.bincount(rows[:, :2].astype(int).ravel(), minlength=int(ids.max()) + 1)[ids]
    number, touching = len(ids), len(rows)
    idle, single = int((counts == 0).sum()), int((counts == 1).sum())
    noise = 7.5 if material.dimension == 3 else 2.0
    return {
        "particles": number,
        "contacts": touching,
        "coordination_number": 2 * touching / number,
        "mechanical_coordination_number": (2 * touching - single) / max(1, number - idle - single),
        "void_ratio": void_ratio(boundary),
        "anisotropy": anisotropy(rows[:, 5:8], material.dimension),
        "anisotropy_noise": noise / math.sqrt(max(1, touching)),
        "stress_kPa": [float(s) / 1e3 for s in boundary.stress()],
        "sides_m": [float(s) for s in boundary.sides()],
        "unbalanced_force": utils.unbalancedForce(),
        "step": O.iter,
        "time_step_s": O.dt,
    }


def write_contacts(
    folder: Folder,
    name: str,
    boundary: Boundary,
    material: Material,
    title: str,
    rows: np.ndarray | None = None,
    short: bool = False,
) -> dict:
    """Write NAME_contacts.txt.gz and return the numbers of the state.

    rows: the contacts, if they are at hand. short: write ids, periods and normals alone.
    """
    rows = contacts() if rows is None else rows
    numbers = state(boundary, material, rows)
    comments = [
        f"{title}: YADE {folder.manifest['versions']['yade']}, {boundary.kind}",
        "m, N; stress: compression negative; normal from id1 to id2; branch x2 + cell * cellDist - x1; Fn, Fs: 1 on 2",
        "sides: {:.9e} {:.9e} {:.9e}".format(*numbers["sides_m"]),
        "stress x y z [kPa]: {:.5f} {:.5f} {:.5f}".format(*numbers["stress_kPa"]),
        f"void_ratio: {numbers['void_ratio']:.6f}  particles: {numbers['particles']}",
    ]
    formats = ["%d"] * 5 + ["%.6f"] * 3 + ["%.5e"] * 9 + ["%.4e"] + ["%.6e"] * 3
    count = SHORT if short else len(CONTACT_COLUMNS)
    table = rows[:, :count]
    folder.write_table(f"{name}_contacts.txt.gz", comments, CONTACT_COLUMNS[:count], table, formats[:count])
    return numbers


def angle(body: Body) -> float:
    """Rotation about z [rad], which for a clump is that of its long axis since it was made."""
    axis, turn = body.state.ori.toAxisAngle()
    return turn * (1 if axis[2] >= 0 else -1)


def write_particles(folder: Folder, name: str) -> None:
    """Write NAME_particles.txt.gz; a clump has the radius of its discs and its angle as a column."""
    rows = contacts()
    counts = np.bincount(rows[:, :2].astype(int).ravel(), minlength=len(O.bodies))
    radius = {particle(body).id: body.shape.radius for body in grains()}
    table = [[b.id, radius[b.id], *b.state.pos, angle(b), counts[b.id]] for b in particles()]
    folder.write_table(
        f"{name}_particles.txt.gz", ["m"], PARTICLE_COLUMNS, table, ["%d"] + ["%.7e"] * 4 + ["%.5f", "%d"]
    )
