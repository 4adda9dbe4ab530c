"""The model at one point and at many: states, rates, strain increments with their tangent."""

from dataclasses import dataclass, field
from enum import IntEnum
from typing import Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hypofab.errors import InputError, Status, error_of
from hypofab.library import check, core, last_message, text
from hypofab.model.materials import Material
from hypofab.tensors import Array, components, deviatoric_stress, many_components, mean_stress, norm, read_only


class Branch(IntEnum):
    """Branches of the model, told apart by the sign of delta : D."""

    PLAIN = 0
    """no intergranular strain"""
    LOADING = 1
    """delta : D > 0, and delta = 0"""
    REVERSAL = 2
    """delta : D <= 0"""


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """State of a material point: effective stress, void ratio, intergranular strain (default: none).

    Tensors are given as six components or 3x3 and kept as six components, not to be written to.
    """

    stress: Array
    void_ratio: float
    delta: Array = field(default_factory=lambda: np.zeros(6))

    def __post_init__(self) -> None:
        """Bring tensors to six components."""
        object.__setattr__(self, "stress", read_only(components(self.stress, "stress")))
        object.__setattr__(self, "delta", read_only(components(self.delta, "delta")))
        object.__setattr__(self, "void_ratio", float(self.void_ratio))

    @classmethod
    def isotropic(cls, p: float, void_ratio: float, delta: ArrayLike = (0, 0, 0, 0, 0, 0)) -> Self:
        """A state of isotropic stress -p 1; p > 0 is compression."""
        return cls(np.array([-p, -p, -p, 0, 0, 0]), void_ratio, components(delta, "delta"))

    @classmethod
    def from_numbers(cls, numbers: Array) -> Self:
        """From the numbers of the library: stress, delta, void ratio."""
        return cls(numbers[:6], float(numbers[12]), numbers[6:12])

    def numbers(self) -> Array:
        """The numbers of the library: stress, delta, void ratio, and room for those of other models."""
        return np.concatenate([self.stress, self.delta, [self.void_ratio], np.zeros(9)])

    def __eq__(self, other: object) -> bool:
        """The same numbers."""
        return isinstance(other, State) and np.array_equal(self.numbers(), other.numbers())

    def __hash__(self) -> int:
        """Of the numbers."""
        return hash(tuple(self.numbers()))

    @property
    def p(self) -> float:
        """Mean effective stress -tr(T)/3."""
        return float(mean_stress(self.stress))

    @property
    def q(self) -> float:
        """Deviatoric stress sqrt(3/2 s:s)."""
        return float(deviatoric_stress(self.stress))

    @property
    def friction_angle(self) -> float:
        """Mobilised friction angle asin((s1 - s3)/(s1 + s3)) [deg]; 90 where it is not defined."""
        return float(core.friction_angle(self.stress))

    def check(self, material: Material) -> None:
        """Raise InputError unless the state is inside the model's domain for this material."""
        check(core.state_check(material.numbers(), self.numbers()))

    def rho(self, material: Material) -> float:
        """|delta|/R, how far the intergranular strain is mobilised."""
        return float(norm(self.delta)) / material.R


@dataclass(frozen=True, slots=True, eq=False)
class Rate:
    """Rates of a state [per time]."""

    stress: Array
    delta: Array
    void_ratio: float
    branch: Branch


@dataclass(frozen=True, slots=True, eq=False)
class LinearParts:
    """Linear parts of the rate equation, acting on tensor components (double counting of shear is in the columns).

    With intergranular strain: Tdot = reversal D on delta : D <= 0, and Tdot = reversal D + jump (direction : D) on
    delta : D > 0. Without: Tdot = reversal D + jump |D|.
    """

    reversal: Array
    jump: Array
    direction: Array
    branch: Branch


@dataclass(frozen=True, slots=True, eq=False)
class Increment:
    """What a strain increment leads to."""

    state: State
    tangent: Array | None
    """d stress / d strain increment, (6, 6), acting on tensor components; None when not asked for"""
    evaluations: int
    """of the rate"""
    branch: Branch
    """at the end of the increment"""
    substep: float
    """|strain| that the error control suggests for the next substep; 0: none was made"""


@dataclass(frozen=True, slots=True, eq=False)
class Points:
    """Many material points after a strain increment; a point that failed is as it was before."""

    stress: Array
    delta: Array
    void_ratio: Array
    status: NDArray[np.intc]
    evaluations: int
    """of the rate, of all points"""
    scalar: int
    """points that were left to the scalar update"""
    threads: int
    instructions: str
    """"avx512", "avx2" or "portable" """


def rate(material: Material, state: State, stretching: ArrayLike) -> Rate:
    """Rates of stress, intergranular strain and void ratio for a stretching D [1/time]."""
    status, numbers, branch = core.rate(material.numbers(), state.numbers(), components(stretching, "stretching"))
    check(status)
    return Rate(numbers[:6], numbers[6:12], float(numbers[12]), Branch(branch[0]))


def linear_parts(material: Material, state: State) -> LinearParts:
    """The linear parts of the rate equation, for mixed control, stability and tangents."""
    status, reversal, jump, direction, branch = core.linear_parts(material.numbers(), state.numbers())
    check(status)
    return LinearParts(reversal, jump, direction, Branch(branch[0]))


def update(
    material: Material,
    state: State,
    strain: ArrayLike,
    *,
    tangent: bool = True,
    tolerance: float = 0.0,
    max_evaluations: int = 0,
) -> Increment:
    """Integrate one strain increment at constant direction, with error control.

    tolerance: relative local error (0: 1e-6); max_evaluations: bound on rate evaluations (0: 20000).
    """
    status, end, stiffness, substep, report = core.update(
        material.numbers(),
        state.numbers(),
        components(strain, "strain"),
        tolerance,
        max_evaluations,
        tangent,
    )
    check(status)
    return Increment(
        State.from_numbers(end), stiffness if tangent else None, int(report[0]), Branch(report[1]), float(substep[0])
    )


def update_many(
    material: Material,
    stress: ArrayLike,
    void_ratio: ArrayLike,
    strain: ArrayLike,
    delta: ArrayLike | None = None,
    *,
    tolerance: float = 0.0,
    max_evaluations: int = 0,
    threads: int = 1,
    check_points: bool = True,
) -> Points:
    """One strain increment of many points of one material, by the batch kernel: SIMD, on request threads.

    Tensors are (n, 6) or (n, 3, 3), void ratios (n,); a strain of one tensor and one void ratio serve all points. Each
    point gets what update() gives it, to 1e-10, without tangent. Arrays are returned as (n, 6) in Fortran's order:
    given back, they need no turning.
    check_points: raise the exception of the first point that failed; else look at `status`.
    """
    stress = np.array(many_components(stress, "stress"), order="F")
    n = len(stress)

    def all_points(tensors: ArrayLike, name: str) -> Array:
        array = np.asarray(tensors, dtype=np.float64)
        if array.shape in ((6,), (3, 3)):
            array = np.broadcast_to(components(array, name), (n, 6))
        array = many_components(array, name)
        if len(array) != n:
            raise InputError(f"{name} is of {len(array)} points, stress of {n}", Status.BAD_ARGUMENT)
        return np.array(array, order="F")

    strain = all_points(strain, "strain")
    delta = all_points(np.zeros(6) if delta is None else delta, "delta")
    ratios = np.asarray(void_ratio, dtype=np.float64)
    if ratios.shape not in ((), (1,), (n,)):
        raise InputError(f"void_ratio has the shape {ratios.shape}, expected ({n},)", Status.BAD_ARGUMENT)
    ratios = np.array(np.broadcast_to(ratios, (n,)))
    if n == 0:
        material.check()
        return Points(stress, delta, ratios, np.zeros(0, dtype=np.intc), 0, 0, 1, "portable")
    numbers = np.zeros((n, 16), order="F")
    numbers[:, :6], numbers[:, 6] = delta, ratios
    status, statuses, report, instructions = core.update_batch(
        material.numbers(), tolerance, max_evaluations, threads, stress.T, numbers.T, strain.T
    )
    delta, ratios = np.array(numbers[:, :6], order="F"), numbers[:, 6].copy()
    if status >= Status.BAD_MATERIAL and not statuses.any():
        check(status)
    if status and check_points:
        raise error_of(status, last_message())
    return Points(
        *(stress, delta, ratios, statuses), int(report[3]), int(report[2]), int(report[4]), text(instructions)
    )
