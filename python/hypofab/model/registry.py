"""The models of the library as it describes them: parameters, state variables, built-in sets; no name is known here."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

from hypofab.errors import InputError, Status
from hypofab.library import check, core, text
from hypofab.tensors import Array

MATERIAL_SIZE, STATE_SIZE = map(int, core.sizes())
"""Length of the arrays that stand for a material (its model, parameters) and a state (stress, variables) in calls."""


_OF_MEMORY = 1  # hypofab_parameter_role


@dataclass(frozen=True, slots=True)
class Parameter:
    """What is known of one parameter: unit "deg", "stress" or "-", and admissible values."""

    name: str
    unit: str
    description: str
    lower: float
    upper: float
    start: float
    """value where none is given; NaN: one must be given"""
    of_memory: bool
    """does it belong to the intergranular strain?"""


@dataclass(frozen=True, slots=True)
class Variable:
    """What is known of one state variable beside stress."""

    name: str
    unit: str
    description: str
    size: int
    """1 for a scalar, 3 for a vector, 6 for a tensor"""
    place: int
    """of its first number behind the stress"""
    start: float
    """of each number where none is given; NaN: it must be given"""


@dataclass(frozen=True, slots=True)
class Set:
    """A built-in set of parameters: its numbers, stresses in kPa, and where they come from."""

    name: str
    description: str
    source: str
    numbers: Array


@dataclass(frozen=True, slots=True, eq=False)
class Model:
    """A constitutive model."""

    index: int
    """place in the library's registry"""
    name: str
    description: str
    parameters: Mapping[str, Parameter]
    variables: Mapping[str, Variable]
    sets: Mapping[str, Set]
    memory: str | None
    """name of the variable that is the intergranular strain, a tensor"""
    void_ratio: str
    """name of the variable that is the void ratio"""


@cache
def models() -> Mapping[str, Model]:
    """The models by name; the first is the one meant where none is named."""
    found: dict[str, Model] = {}
    while True:
        status, name, description, (n_parameters, n_variables, _, memory, void_ratio) = core.model(len(found))
        if status:
            return found
        index = len(found)
        variables = [_variable(index, place) for place in range(n_variables)]
        of_place = {variable.place: variable.name for variable in variables}
        found[text(name)] = Model(
            index,
            text(name),
            text(description),
            {one.name: one for one in (_parameter(index, place) for place in range(n_parameters))},
            {one.name: one for one in variables},
            _sets(index),
            of_place.get(int(memory)),
            of_place[int(void_ratio)],
        )


def model_of(name: str | None) -> Model:
    """The model of a name, None: the first."""
    known = models()
    if name is None:
        return next(iter(known.values()))
    if name not in known:
        raise InputError(f"no model '{name}', expected one of {', '.join(known)}", Status.BAD_MATERIAL)
    return known[name]


def _parameter(model: int, index: int) -> Parameter:
    status, (lower, upper, start), role, name, unit, description = core.parameter_info(model, index)
    check(status)
    texts = text(name), text(unit), text(description)
    return Parameter(*texts, float(lower), float(upper), float(start), int(role[0]) == _OF_MEMORY)


def _variable(model: int, index: int) -> Variable:
    status, (size, place, _), start, name, unit, description = core.variable_info(model, index)
    check(status)
    return Variable(text(name), text(unit), text(description), int(size), int(place), float(start[0]))


def _sets(model: int) -> dict[str, Set]:
    found: dict[str, Set] = {}
    while True:
        status, numbers, name, description, source = core.parameter_set(model, len(found))
        if status:
            return found
        found[text(name)] = Set(text(name), text(description), text(source), numbers)
