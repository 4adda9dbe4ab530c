"""State of a material point: stress and the variables of a model by their names."""

import math
from collections.abc import Mapping
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike

from hypofab.errors import InputError, Status
from hypofab.library import check, core
from hypofab.model.described import VariableNames
from hypofab.model.materials import Material
from hypofab.model.registry import STATE_SIZE, Model, Variable, model_of
from hypofab.tensors import Array, components, deviatoric_stress, mean_stress, norm, read_only

Value = float | Array


def named(variables: Mapping[str, Value], name: str) -> Any:  # noqa: ANN401 - a number or an array
    """A variable as an attribute: what __getattr__ of states, rates and points does."""
    if name.startswith("_") or name == "variables" or name not in variables:
        raise AttributeError(f"no variable '{name}'")
    return variables[name]


def given_variables(model: Model, void_ratio: Any, delta: Any, others: Mapping[str, Any]) -> dict[str, Any]:  # noqa: ANN401
    """What was given, by the names of a model: the void ratio and the intergranular strain have arguments of their own.

    InputError for what the model does not have.
    """
    given = {**others, model.void_ratio: void_ratio}
    if delta is not None:
        given[model.memory or "delta"] = delta
    unknown = [name for name in given if name not in model.variables]
    if unknown:
        raise InputError(f"model '{model.name}' has no state variable '{unknown[0]}'", Status.BAD_STATE)
    return given


def _value(variable: Variable, given: Mapping[str, Any]) -> Value:
    value = given.get(variable.name)
    if value is None:
        if math.isnan(variable.start):
            raise InputError(f"{variable.name} is missing, expected a value", Status.BAD_STATE)
        value = variable.start if variable.size == 1 else np.full(variable.size, variable.start)
    if variable.size == 1:
        return float(value)
    if variable.size == 6:
        return read_only(components(value, variable.name))
    array = np.array(value, dtype=np.float64)
    if array.shape != (variable.size,):
        raise InputError(f"{variable.name} has the shape {array.shape}, expected three numbers", Status.BAD_ARGUMENT)
    return read_only(array)


def unpack(model: Model, numbers: Array) -> dict[str, Value]:
    """Variables from the numbers of the library that stand behind the stress."""
    return {
        one.name: float(numbers[one.place]) if one.size == 1 else read_only(numbers[one.place : one.place + one.size])
        for one in model.variables.values()
    }


class State(VariableNames):
    """State of a material point: effective stress and state variables, as attributes too: void_ratio, delta, ...

    Tensors are given as six components or 3x3 and kept as six components, not to be written to.
    """

    __slots__ = ("model", "stress", "variables")

    model: Model
    stress: Array
    variables: Mapping[str, Value]
    """by name, in the order of the model"""

    def __init__(
        self,
        stress: ArrayLike,
        void_ratio: float,
        delta: ArrayLike | None = None,
        *,
        model: str | None = None,
        **variables: ArrayLike,
    ) -> None:
        """Of a model (None: the sand). delta: intergranular strain; variables: further ones that the model has."""
        known = model_of(model)
        given = given_variables(known, void_ratio, delta, variables)
        values = {name: _value(variable, given) for name, variable in known.variables.items()}
        self._set(known, components(stress, "stress"), values)

    def _set(self, model: Model, stress: Array, variables: Mapping[str, Value]) -> None:
        object.__setattr__(self, "model", model)
        object.__setattr__(self, "stress", read_only(stress))
        object.__setattr__(self, "variables", variables)

    @classmethod
    def isotropic(
        cls,
        p: float,
        void_ratio: float,
        delta: ArrayLike | None = None,
        *,
        model: str | None = None,
        **variables: ArrayLike,
    ) -> Self:
        """A state of isotropic stress -p 1; p > 0 is compression."""
        return cls([-p, -p, -p, 0, 0, 0], void_ratio, delta, model=model, **variables)

    @classmethod
    def from_numbers(cls, numbers: Array, model: str | None = None) -> Self:
        """From the numbers of the library: stress, then those of the variables."""
        state = cls.__new__(cls)
        known = model_of(model)
        state._set(known, np.array(numbers[:6]), unpack(known, np.array(numbers[6:])))
        return state

    def numbers(self) -> Array:
        """The numbers of the library: stress, then those of the variables."""
        numbers = np.zeros(STATE_SIZE)
        numbers[:6] = self.stress
        for name, variable in self.model.variables.items():
            numbers[6 + variable.place : 6 + variable.place + variable.size] = self.variables[name]
        return numbers

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401 - a number or an array
        """A state variable."""
        return named(self.variables, name)

    def __setattr__(self, name: str, value: object) -> None:
        """Refuse to change."""
        raise AttributeError("a state is not to be changed")

    def __dir__(self) -> list[str]:
        """Attributes, state variables among them."""
        return [*super().__dir__(), *self.variables]

    def __eq__(self, other: object) -> bool:
        """The same numbers of the same model."""
        return (
            isinstance(other, State) and self.model is other.model and np.array_equal(self.numbers(), other.numbers())
        )

    def __hash__(self) -> int:
        """Of the numbers."""
        return hash(self.numbers().tobytes())

    def __repr__(self) -> str:
        """As one would write it."""
        parts = [f"stress={self.stress.tolist()}"]
        parts += [f"{name}={np.asarray(value).tolist()}" for name, value in self.variables.items()]
        return f"State({', '.join(parts)})"

    def __reduce__(self) -> tuple:
        """Pickle by the numbers."""
        return State.from_numbers, (self.numbers(), self.model.name)

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

    @property
    def memory(self) -> Array:
        """The intergranular strain, six components; zero where the model has none."""
        return np.asarray(self.variables[self.model.memory]) if self.model.memory else np.zeros(6)

    def check(self, material: Material) -> None:
        """Raise InputError unless the state is inside the model's domain for this material."""
        check(core.state_check(material.numbers(), self.numbers()))

    def rho(self, material: Material) -> float:
        """|delta|/R, how far the intergranular strain is mobilised."""
        return float(norm(self.memory)) / material.memory_size
