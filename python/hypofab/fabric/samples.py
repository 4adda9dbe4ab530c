"""Contact fabric of arrays and of files, and the initial intergranular strain that follows from it (paper 000)."""

import os
from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from hypofab.drawing import draw
from hypofab.errors import InputError, Status
from hypofab.library import check, core, text
from hypofab.tensors import Array, components, read_only

if TYPE_CHECKING:
    from hypofab.drawing import Figure

_TREATMENTS = ("refuse", "skip", "keep")
_WALLS = (None, "out", "in")
_COLUMNS = ("id1", "id2", "nx", "ny", "nz")


@dataclass(frozen=True, slots=True, eq=False)
class Fabric:
    """Contact fabric of a sample; docs/fabric2delta.md."""

    contacts: int
    """N_c; 0 when the fabric tensor itself was given"""
    particles: int
    """N_p; 0 when not known"""
    rattlers: int
    """particles with fewer than two contacts; -1 when not known"""
    fabric: Array
    """N = (1/N_c) sum n n"""
    deviatoric_fabric: Array
    """F = 15/2 (N - 1/3 1)"""
    anisotropy: float
    """a = sqrt(3/2 F:F)"""
    principal_values: Array
    """of N, largest first"""
    principal_directions: Array
    """(3, 3) row i: unit vector of principal_values[i]"""
    coordination_number: float
    """2 N_c/N_p; NaN when not known"""
    mechanical_coordination_number: float
    """without particles that have fewer than two contacts; NaN when not known"""

    @classmethod
    def _unpack(cls, numbers: Array) -> "Fabric":
        return cls(
            *(int(number) for number in numbers[:3]),
            *(read_only(numbers[3:9]), read_only(numbers[9:15]), float(numbers[15])),
            *(read_only(numbers[16:19]), read_only(numbers[19:28].reshape(3, 3))),
            *map(float, numbers[28:]),
        )

    def _numbers(self) -> Array:
        return np.concatenate([np.ravel(getattr(self, field.name)) for field in fields(self)]).astype(np.float64)

    def plot(self, label: str = "sample", *, up: str = "z") -> "Figure":
        """Surface of the density of contact normals; several samples in one figure: hypofab.plot_fabrics."""
        return draw("memory.plot_fabrics", {label: self}, up=up)

    def rotated(self, rotation: ArrayLike) -> "Fabric":
        """In other axes: row i of the rotation is the new axis i in the old ones."""
        status, turned = core.fabric_rotate(self._numbers(), _shaped(rotation, (3, 3), "rotation"))
        check(status)
        return self._unpack(turned)

    def without_noise(self, noise2: float | None = None) -> "Fabric":
        """F and a without what noise adds to a^2 (None: that of independent contacts)."""
        status, corrected = core.fabric_correct(self._numbers(), -1.0 if noise2 is None else noise2)
        check(status)
        return self._unpack(corrected)

    def significance(self) -> "Significance":
        """How far the anisotropy stands out of the noise of a finite number of contacts."""
        status, numbers = core.fabric_significance(self._numbers())
        check(status)
        return Significance(*map(float, numbers))

    def delta(self, R: float, c: float = 0.05, weight: str = "exponential") -> "InitialDelta":
        """Initial intergranular strain: A = (1 - f) 1 + f F with the weight f(a), delta = R A/|A|."""
        status, numbers = core.fabric_to_delta(self._numbers(), R, c, weight.encode())
        check(status)
        return InitialDelta(float(numbers[0]), read_only(numbers[1:7]), read_only(numbers[7:]))


@dataclass(frozen=True, slots=True)
class Significance:
    """An anisotropy and the noise in it; docs/uncertainty.md."""

    noise: float
    """root-mean-square a of so many independent contacts without preferred direction"""
    corrected: float
    """a without the noise in it"""
    statistic: float
    """of chi-square distribution without anisotropy"""
    p_value: float
    """probability of this a or more without anisotropy"""


@dataclass(frozen=True, slots=True, eq=False)
class InitialDelta:
    """The initial intergranular strain of a fabric."""

    weight: float
    """f(a)"""
    weighted_fabric: Array
    """A = (1 - f) 1 + f F"""
    delta: Array


def fabric_of_normals(
    normals: ArrayLike,
    *,
    ids: tuple[ArrayLike, ArrayLike] | None = None,
    particles: int = 0,
) -> Fabric:
    """Fabric of unit contact normals (n, 3), or (n, 2) of disks in the plane.

    ids: the two particles of each contact, for coordination numbers; particles: N_p (0: the different ids).
    """
    array = np.asarray(normals, dtype=np.float64)
    if array.ndim != 2 or array.shape[1] not in (2, 3):
        raise InputError(f"normals has the shape {array.shape}, expected (n, 3) or (n, 2)", Status.BAD_ARGUMENT)
    if len(array) == 0:
        raise InputError("normals is empty, expected at least one contact", Status.BAD_ARGUMENT)
    dimension = array.shape[1]
    if dimension == 2:
        array = np.column_stack([array, np.zeros(len(array))])
    first, second = (np.zeros(1, dtype=np.int64),) * 2
    if ids is not None:
        first, second = (_shaped(one, (len(array),), "ids", np.int64) for one in ids)
    elif len(array) == 1:
        # One id would stand for the ids of the one contact.
        first = second = np.zeros(2, dtype=np.int64)
    status, numbers = core.fabric_of_contacts(dimension, array, first, second, particles)
    check(status)
    return Fabric._unpack(numbers)


def fabric_of_file(path: str | os.PathLike, **options: Any) -> Fabric:  # noqa: ANN401 - those of reading
    """Fabric of a contact file, streamed; docs/contact_files.md.

    Options: particles: N_p or a particle file. columns: names or numbers (from 1) of id1, id2, nx, ny, nz. kind: the
    format, where the file does not show it; more_columns, particle_columns, separator. dimension: 2 for disks. wrong,
    duplicates: "refuse" or "skip" such contacts, or "keep" duplicates. walls: None, "out" or "in"; wall_ids: "0-5,17".
    normalise: normals of any length. threads: of reading; 0: all.
    """
    status, numbers, _ = core.fabric_read(os.fsencode(path), *reading(**options))
    check(status)
    return Fabric._unpack(numbers)


def reading(
    *,
    particles: int | str | os.PathLike | None = None,
    columns: Mapping[str, str | int] | None = None,
    separator: str = "",
    kind: str = "",
    more_columns: str = "",
    particle_columns: str = "",
    dimension: int = 3,
    wrong: str = "refuse",
    duplicates: str = "refuse",
    walls: str | None = None,
    wall_ids: str = "",
    normalise: bool = False,
    threads: int = 0,
) -> tuple[bytes, int, tuple[int, ...], int]:
    """Options of fabric_of_file as the extension takes them: texts, separator, choices, particles."""
    named = dict(columns or {})
    unknown = set(named) - set(_COLUMNS)
    if unknown:
        raise InputError(f"columns: {sorted(unknown)}, expected some of {', '.join(_COLUMNS)}", Status.BAD_ARGUMENT)
    choices = (
        *(dimension, _choice("wrong", wrong, _TREATMENTS[:2]), _choice("duplicates", duplicates, _TREATMENTS)),
        *(_choice("walls", walls, _WALLS), int(normalise), threads),
    )
    if len(separator) > 1:
        raise InputError(f"separator = {separator!r}, expected one character", Status.BAD_ARGUMENT)
    file, count = "", 0
    if isinstance(particles, int | np.integer):
        count = int(particles)
    elif particles is not None:
        file = os.fspath(particles)
    texts = [*(str(named.get(name, "")) for name in _COLUMNS), kind, file, more_columns, particle_columns, wall_ids]
    return (
        b"".join(os.fsencode(one) + b"\x1f" for one in texts),
        ord(separator) if separator else 0,
        choices,
        count,
    )


def fabric_of_tensor(tensor: ArrayLike) -> Fabric:
    """Fabric of a given tensor N: trace 1 within 0.02, positive semi-definite."""
    status, numbers = core.fabric_from_tensor(components(tensor, "fabric tensor"))
    check(status)
    return Fabric._unpack(numbers)


def weights() -> Mapping[str, str]:
    """Weight functions f(a) by name, with their formulas."""
    found: dict[str, str] = {}
    while True:
        name, formula = map(text, core.weight(len(found)))
        if not name:
            return found
        found[name] = formula


def _choice(name: str, value: str | None, known: tuple[str | None, ...]) -> int:
    if value not in known:
        raise InputError(f"{name} = {value!r}, expected one of {', '.join(map(str, known))}", Status.BAD_ARGUMENT)
    return known.index(value)


def _shaped(array: ArrayLike, shape: tuple[int, ...], name: str, dtype: type = np.float64) -> np.ndarray:
    array = np.ascontiguousarray(array, dtype=dtype)
    if array.shape != shape:
        raise InputError(f"{name} has the shape {array.shape}, expected {shape}", Status.BAD_ARGUMENT)
    return array
