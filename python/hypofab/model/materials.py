"""Material parameters and built-in sands."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any, Self

import numpy as np

from hypofab.errors import InputError, Status
from hypofab.library import check, core
from hypofab.model.described import ParameterNames
from hypofab.model.registry import MATERIAL_SIZE, Model, Parameter, model_of, models
from hypofab.tensors import Array, read_only


class Material(ParameterNames, Mapping[str, float]):
    """Parameters of a model by their names, as attributes too; docs/theory.md, section 3, for the sand.

    Stresses carry the unit of h_s, angles are degrees. hypofab.parameters() describes them. Not to be changed:
    replace() gives another material.
    """

    __slots__ = ("_numbers", "model")

    model: Model
    """which model they are of"""
    _numbers: Array

    def __init__(self, model: str | None = None, /, **parameters: float) -> None:
        """Parameters of a model (None: the sand); those that are left out take the value of the description.

        Without any parameter of the intergranular strain there is none.
        """
        known = model_of(model)
        unknown = [name for name in parameters if name not in known.parameters]
        if unknown:
            raise InputError(
                f"no parameter '{unknown[0]}' of model '{known.name}', expected some of {', '.join(known.parameters)}",
                Status.BAD_MATERIAL,
            )
        values = [float(parameters.get(one.name, one.start)) for one in known.parameters.values()]
        missing = [name for name, value in zip(known.parameters, values, strict=True) if math.isnan(value)]
        if missing and missing[0] not in parameters:
            raise InputError(f"parameter '{missing[0]}' is missing, expected a value", Status.BAD_MATERIAL)
        numbers = np.zeros(MATERIAL_SIZE)
        numbers[0] = known.index
        numbers[1 : 1 + len(values)] = values
        if not any(known.parameters[name].of_memory for name in parameters):
            numbers = core.memory_off(numbers)
        self._set(known, numbers)

    def _set(self, model: Model, numbers: Array) -> None:
        object.__setattr__(self, "model", model)
        object.__setattr__(self, "_numbers", read_only(numbers))

    @classmethod
    def sand(cls, name: str) -> Self:
        """A built-in set, stresses in kPa: hypofab.sands() lists them."""
        for model in models().values():
            if name in model.sets:
                return cls.from_numbers(model.sets[name].numbers)
        known = ", ".join(one for model in models().values() for one in model.sets)
        raise InputError(f"no built-in sand '{name}', expected one of {known}", Status.BAD_MATERIAL)

    @classmethod
    def from_numbers(cls, numbers: Array) -> Self:
        """From the numbers of the library: the model's place in the registry, then its parameters."""
        material = cls.__new__(cls)
        material._set(list(models().values())[int(numbers[0])], np.array(numbers))
        return material

    def numbers(self) -> Array:
        """The numbers of the library: the model's place in the registry, then its parameters."""
        return self._numbers

    def __getattr__(self, name: str) -> float:
        """A parameter as an attribute."""
        if name.startswith("_") or name not in self:
            raise AttributeError(f"a material has no '{name}'")
        return self[name]

    def __setattr__(self, name: str, value: object) -> None:
        """Refuse to change."""
        raise AttributeError(f"a material is not to be changed: replace({name}=...) gives another")

    def __getitem__(self, name: str) -> float:
        """A parameter by its name."""
        for place, known in enumerate(self.model.parameters, start=1):
            if known == name:
                return float(self._numbers[place])
        raise KeyError(name)

    def __contains__(self, name: object) -> bool:
        """Is this the name of a parameter?"""
        return name in self.model.parameters

    def __iter__(self) -> Iterator[str]:
        """Names of the parameters."""
        return iter(self.model.parameters)

    def __len__(self) -> int:
        """How many parameters there are."""
        return len(self.model.parameters)

    def __dir__(self) -> list[str]:
        """Attributes, parameters among them."""
        return [*super().__dir__(), *self]

    def __eq__(self, other: object) -> bool:
        """The same model with the same numbers."""
        return isinstance(other, Material) and np.array_equal(self._numbers, other._numbers)

    def __hash__(self) -> int:
        """Of the numbers."""
        return hash(self._numbers.tobytes())

    def __repr__(self) -> str:
        """As one would write it."""
        return f"Material({', '.join([repr(self.model.name), *(f'{name}={value:g}' for name, value in self.items())])})"

    def __reduce__(self) -> tuple:
        """Pickle by the numbers."""
        return Material.from_numbers, (np.array(self._numbers),)

    def replace(self, **parameters: float) -> "Material":
        """The same material with other values of some parameters."""
        return Material(self.model.name, **(self.parameters() | parameters))

    def check(self) -> None:
        """Raise InputError unless every parameter is within its bounds and fits the others."""
        check(core.material_check(self._numbers))

    @property
    def memory_size(self) -> float:
        """The largest norm of the intergranular strain, R of the sand; 0 for a material without."""
        return float(core.memory_size(self._numbers))

    def without_intergranular_strain(self) -> Self:
        """The same material without intergranular strain."""
        return self.from_numbers(core.memory_off(self._numbers))

    def parameters(self) -> dict[str, float]:
        """Parameters by name, as decks take them."""
        return dict(self)

    def limiting_void_ratios(self, p: Any) -> Array:  # noqa: ANN401 - numpy's ArrayLike
        """Void ratios of densest, critical and loosest packing at mean stresses (n,): (n, 3); NaN: no such limit."""
        return core.limiting_void_ratios(self._numbers, np.atleast_1d(np.asarray(p, dtype=np.float64)))


@dataclass(frozen=True, slots=True)
class Sand:
    """A built-in set: parameters in kPa and where they come from."""

    name: str
    description: str
    source: str
    material: Material


@cache
def sands() -> Mapping[str, Sand]:
    """The built-in sets of all models by name."""
    return {
        one.name: Sand(one.name, one.description, one.source, Material.from_numbers(one.numbers))
        for model in models().values()
        for one in model.sets.values()
    }


def parameters(model: str | None = None) -> Mapping[str, Parameter]:
    """The parameters of a model (None: the sand) by name."""
    return model_of(model).parameters
