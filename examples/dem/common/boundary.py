"""What encloses a sample: a periodic cell (two and three dimensions) or a box of four rigid walls (two dimensions).

Both answer the same questions: sides() [m], area or volume [m3], stress() of the three axes [Pa], set_rates().
"""

from dataclasses import dataclass

import numpy as np
from yade import Matrix3, O, Vector3, utils


@dataclass
class PeriodicCell:
    """An orthogonal periodic cell. A two-dimensional sample lies in its plane z = 0; its thickness is 1 m."""

    dimension: int

    kind = "periodic cell"

    def create(self, sides: list[float]) -> None:
        """Set up the cell of a new scene."""
        O.periodic = True
        O.cell.setBox(*sides)

    def sides(self) -> np.ndarray:
        """Lengths of the edges [m]; 1 m along z in two dimensions."""
        sides = np.array([O.cell.hSize[i, i] for i in range(3)])
        if self.dimension == 2:
            sides[2] = 1.0
        return sides

    def volume(self) -> float:
        """Volume [m3]."""
        return float(np.prod(self.sides()))

    def stress(self) -> np.ndarray:
        """Normal stresses along x, y, z [Pa]."""
        tensor = utils.getStress(self.volume())
        return np.array([tensor[i, i] for i in range(3)])

    def set_rates(self, rates: list[float]) -> None:
        """Prescribe the strain rates [1/s]."""
        O.cell.velGrad = Matrix3(rates[0], 0, 0, 0, rates[1], 0, 0, 0, rates[2] if self.dimension == 3 else 0)


class WallBox:
    """Four rigid walls without friction around a two-dimensional sample; bodies 0 to 3: left, right, bottom, top."""

    kind = "four rigid walls"
    dimension = 2

    def create(self, sides: list[float]) -> None:
        """Add the walls to a new scene, before any particle."""
        for axis in (0, 1):
            for position in (0.0, sides[axis]):
                place = [sides[0] / 2, sides[1] / 2, 0.0]
                place[axis] = position
                O.bodies.append(utils.wall(place, axis, material="walls"))

    def sides(self) -> np.ndarray:
        """Distances between the walls [m]; 1 m along z."""
        left, right, bottom, top = (O.bodies[i].state.pos for i in range(4))
        return np.array([right[0] - left[0], top[1] - bottom[1], 1.0])

    def volume(self) -> float:
        """Volume between the walls [m3]."""
        return float(np.prod(self.sides()))

    def stress(self) -> np.ndarray:
        """Normal stresses from the forces on opposite walls [Pa]; 0 along z."""
        sides = self.sides()
        forces = [abs(O.forces.f(i)[i // 2]) for i in range(4)]
        return np.array([-(forces[0] + forces[1]) / 2 / sides[1], -(forces[2] + forces[3]) / 2 / sides[0], 0.0])

    def set_rates(self, rates: list[float]) -> None:
        """Prescribe the strain rates [1/s]; opposite walls move by the same amount."""
        sides = self.sides()
        for axis in (0, 1):
            speed = rates[axis] * sides[axis] / 2
            for index, sense in ((2 * axis, -1), (2 * axis + 1, 1)):
                velocity = [0.0, 0.0, 0.0]
                velocity[axis] = sense * speed
                O.bodies[index].state.vel = Vector3(*velocity)


Boundary = PeriodicCell | WallBox
