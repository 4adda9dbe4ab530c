"""The model at one point and at many: rates, strain increments with their tangent."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import IntEnum
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hypofab.errors import InputError, Status, error_of
from hypofab.library import check, core, last_message, text
from hypofab.model.described import RateNames
from hypofab.model.materials import Material
from hypofab.model.registry import STATE_SIZE, Model
from hypofab.model.states import State, Value, given_variables, named, unpack
from hypofab.tensors import Array, components, many_components


class Branch(IntEnum):
    """Branches of the model, told apart by the sign of delta : D."""

    PLAIN = 0
    """no intergranular strain"""
    LOADING = 1
    """delta : D > 0, and delta = 0"""
    REVERSAL = 2
    """delta : D <= 0"""


@dataclass(frozen=True, slots=True, eq=False)
class Rate(RateNames):
    """Rates of a state [per time]: of stress, and of the state variables as attributes too."""

    stress: Array
    variables: Mapping[str, Value]
    """by name"""
    branch: Branch

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401 - a number or an array
        """The rate of a state variable."""
        return named(self.variables, name)


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
class Points(RateNames):
    """Many material points after a strain increment; a point that failed is as it was before."""

    stress: Array
    variables: Mapping[str, Array]
    """state variables by name, as attributes too: (n,) or (n, 6)"""
    status: NDArray[np.intc]
    evaluations: int
    """of the rate, of all points"""
    scalar: int
    """points that were left to the scalar update"""
    threads: int
    instructions: str
    """"avx512", "avx2", "portable"; "scalar" for a model without batch"""

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401 - an array
        """A state variable."""
        return named(self.variables, name)


def rate(material: Material, state: State, stretching: ArrayLike) -> Rate:
    """Rates of stress, intergranular strain and void ratio for a stretching D [1/time]."""
    status, numbers, branch = core.rate(material.numbers(), state.numbers(), components(stretching, "stretching"))
    check(status)
    return Rate(numbers[:6], unpack(state.model, numbers[6:]), Branch(branch[0]))


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
    after = State.from_numbers(end, state.model.name)
    return Increment(after, stiffness if tangent else None, int(report[0]), Branch(report[1]), float(substep[0]))


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
    **variables: ArrayLike,
) -> Points:
    """One strain increment of many points of one material, by the batch kernel: SIMD, on request threads.

    Tensors are (n, 6) or (n, 3, 3), void ratios (n,); a strain of one tensor and one void ratio serve all points.
    variables: further ones that the model has, as scalars. Each point gets what update() gives it, to 1e-10, without
    tangent. Arrays are returned as (n, 6) in Fortran's order: given back, they need no turning.
    check_points: raise the exception of the first point that failed; else look at `status`.
    """
    model = material.model
    stress = np.array(many_components(stress, "stress"), order="F")
    n = len(stress)
    strain = _of_points(strain, 6, n, "strain")
    given = given_variables(model, void_ratio, delta, variables)
    numbers = np.zeros((n, STATE_SIZE - 6), order="F")
    for name, one in model.variables.items():
        value = given.get(name, np.full(one.size, one.start) if one.size > 1 else one.start)
        numbers[:, one.place : one.place + one.size] = _of_points(value, one.size, n, name)
    if n == 0:
        material.check()
        return Points(stress, _columns(model, numbers), np.zeros(0, dtype=np.intc), 0, 0, 1, "portable")
    status, statuses, report, instructions = core.update_batch(
        material.numbers(), tolerance, max_evaluations, threads, stress.T, numbers.T, strain.T
    )
    if status >= Status.BAD_MATERIAL and not statuses.any():
        check(status)
    if status and check_points:
        raise error_of(status, last_message())
    return Points(
        *(stress, _columns(model, numbers), statuses, int(report[3]), int(report[2]), int(report[4])),
        text(instructions),
    )


def _of_points(values: ArrayLike, size: int, n: int, name: str) -> Array:
    """Values of n points as (n, size), in Fortran's order; one for all is allowed."""
    array = np.asarray(values, dtype=np.float64)
    if size == 6:
        if array.shape in ((6,), (3, 3)):
            array = np.broadcast_to(components(array, name), (n, 6))
        array = many_components(array, name)
        if len(array) != n:
            raise InputError(f"{name} is of {len(array)} points, stress of {n}", Status.BAD_ARGUMENT)
        return np.array(array, order="F")
    whole = (n,) if size == 1 else (n, size)
    if array.shape not in ((), (1,), whole):
        raise InputError(f"{name} has the shape {array.shape}, expected {whole}", Status.BAD_ARGUMENT)
    return np.array(np.broadcast_to(array, whole).reshape(n, size), order="F")


def _columns(model: Model, numbers: Array) -> dict[str, Array]:
    """State variables of many points by their names."""
    return {
        name: numbers[:, one.place].copy()
        if one.size == 1
        else np.array(numbers[:, one.place : one.place + one.size], order="F")
        for name, one in model.variables.items()
    }
