"""Material parameters and built-in sands."""

from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, fields, replace
from functools import cache
from typing import Self

import numpy as np

from hypofab.errors import InputError, Status
from hypofab.library import check, core, text
from hypofab.tensors import Array


@dataclass(frozen=True, slots=True)
class Material(Mapping[str, float]):
    """Parameters of the model, in the order of the UMAT's PROPS; docs/theory.md, section 3.

    Stresses carry the unit of h_s, angles are degrees. m_R <= 0.5 is the model without intergranular strain.
    """

    phi_c: float
    """critical friction angle [deg]"""
    h_s: float
    """granular hardness [stress]"""
    n: float
    """exponent of the compression law"""
    e_d0: float
    """void ratio of densest packing at p = 0"""
    e_c0: float
    """critical void ratio at p = 0"""
    e_i0: float
    """void ratio of loosest packing at p = 0"""
    alpha: float
    """exponent of f_d"""
    beta: float
    """exponent of f_e"""
    m_R: float = 0.0
    """stiffness factor at 180 deg reversal"""
    m_T: float = 0.0
    """stiffness factor at 90 deg turn"""
    R: float = 0.0
    """size of the elastic strain range, the largest |delta|"""
    beta_r: float = 0.0
    """exponent of the evolution of delta"""
    chi: float = 0.0
    """exponent of the interpolation in rho"""
    p_t: float = 0.0
    """shift of stress: the model sees T - p_t 1 [stress]"""
    K_w: float = 0.0
    """bulk stiffness of pore water [stress]"""
    e_0: float = 0.0
    """initial void ratio; UMAT only"""

    @classmethod
    def sand(cls, name: str) -> "Material":
        """A built-in sand, h_s in kPa: hypofab.sands() lists them."""
        known = sands()
        if name not in known:
            raise InputError(f"no built-in sand '{name}', expected one of {', '.join(known)}", Status.BAD_MATERIAL)
        return known[name].material

    @classmethod
    def from_numbers(cls, numbers: Array) -> Self:
        """From the numbers of the library: the model's place in the registry, then its parameters."""
        return cls(**dict(zip(ORDER, map(float, numbers[1 : 1 + len(ORDER)]), strict=True)))

    def __getitem__(self, name: str) -> float:
        """A parameter by its name."""
        if name not in ORDER:
            raise KeyError(name)
        return getattr(self, name)

    def __iter__(self) -> Iterator[str]:
        """Names of the parameters."""
        return iter(ORDER)

    def __len__(self) -> int:
        """How many parameters there are."""
        return len(ORDER)

    @property
    def has_memory(self) -> bool:
        """Does the model of these parameters have intergranular strain?"""
        return self.m_R > 0.5

    def numbers(self) -> Array:
        """The numbers of the library: the model's place in the registry, then its parameters."""
        numbers = np.zeros(MATERIAL_NUMBERS)
        numbers[1 : 1 + len(ORDER)] = [getattr(self, name) for name in ORDER]
        return numbers

    def check(self) -> None:
        """Raise InputError unless every parameter is within its bounds and fits the others."""
        check(core.material_check(self.numbers()))

    def without_intergranular_strain(self) -> Self:
        """The same sand without intergranular strain."""
        return replace(self, m_R=0.0)

    def parameters(self) -> Mapping[str, float]:
        """Parameters by name, as decks take them."""
        return asdict(self)


MATERIAL_NUMBERS = 33
"""Length of a material in the library: its model, and room for parameters."""

ORDER = (
    *("phi_c", "p_t", "h_s", "n", "e_d0", "e_c0", "e_i0", "alpha", "beta"),
    *("m_R", "m_T", "R", "beta_r", "chi", "K_w", "e_0"),
)
"""Names of the parameters in the order of PROPS."""

assert {field.name for field in fields(Material)} == set(ORDER)


@dataclass(frozen=True, slots=True)
class Sand:
    """A built-in sand: parameters in kPa and where they come from."""

    name: str
    description: str
    source: str
    material: Material


@dataclass(frozen=True, slots=True)
class Parameter:
    """What is known of one parameter: unit "deg", "stress" or "-", and admissible values."""

    name: str
    unit: str
    description: str
    lower: float
    upper: float


@cache
def sands() -> Mapping[str, Sand]:
    """The built-in sands by name."""
    found: dict[str, Sand] = {}
    while True:
        status, numbers, name, description, source = core.parameter_set(0, len(found))
        if status:
            return found
        found[text(name)] = Sand(text(name), text(description), text(source), Material.from_numbers(numbers))


@cache
def parameters() -> Mapping[str, Parameter]:
    """The material parameters by name."""
    found = {}
    for index in range(len(ORDER)):
        status, bounds, _, name, unit, description = core.parameter_info(0, index)
        check(status)
        found[text(name)] = Parameter(text(name), text(unit), text(description), *map(float, bounds[:2]))
    return found
