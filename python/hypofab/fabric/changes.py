"""What changes between snapshots of a sample, and the fabric response to strain probes (paper 001; docs/changes.md)."""

import os
import weakref
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hypofab.drawing import draw
from hypofab.errors import InputError, Status
from hypofab.fabric.samples import Fabric, fabric_of_file, reading
from hypofab.library import check, core
from hypofab.tensors import Array, read_only

if TYPE_CHECKING:
    from hypofab.drawing import Figure

MECHANISMS = ("loss", "gain", "reorientation")


@dataclass(frozen=True, slots=True, eq=False)
class Rose:
    """Contact directions in a plane over half a turn; fit: (contacts/180 deg) [1 + a cos 2(angle - direction)]."""

    count: NDArray[np.int64]
    """contacts in bins of equal width"""
    anisotropy: float
    """a of the fit"""
    direction: float
    """of the largest density [deg]"""


@dataclass(frozen=True, slots=True, eq=False)
class FabricChange:
    """Change of F = (2/N_p) sum n n between two snapshots: dF = dF^g - dF^l + dF^r (paper 001, Eq. 4)."""

    particles: int
    """N_p of F"""
    contacts_before: int
    contacts_after: int
    lost: int
    gained: int
    persisting: int
    fabric_before: Array
    fabric_after: Array
    change: Array
    by_mechanism: Array
    """(3, 6) dF^l, dF^g, dF^r"""
    turn: float
    """root-mean-square turn of the persisting normals [deg]"""
    lost_rose: Rose
    gained_rose: Rose

    def rates(self, strain: float, axes: str = "xy") -> Array:
        """Rates of a strain probe of this size, (2, 3): dZ^m = tr dF^m/strain, dA^m = (dF^m_22 - dF^m_11)/strain."""
        if strain <= 0 or not np.isfinite(strain):
            raise InputError(f"strain = {strain:g}, expected > 0", Status.BAD_ARGUMENT)
        first, second = plane(axes)
        trace = self.by_mechanism[:, :3].sum(axis=1)
        return np.array([trace, self.by_mechanism[:, second] - self.by_mechanism[:, first]]) / strain


def changes(
    before: str | os.PathLike,
    after: Iterable[str | os.PathLike],
    *,
    particles_of_fabric: int = 0,
    axes: str = "xy",
    bins: int = 24,
    ignore_images: bool = False,
    **options: Any,  # noqa: ANN401 - those of fabric_of_file
) -> list[FabricChange]:
    """Compare later snapshots to a first one; contacts need ids.

    particles_of_fabric: N_p of F; 0: the particles with two contacts or more in the first snapshot. axes, bins: of the
    roses. ignore_images: contacts are told apart by their ids alone. options: those of fabric_of_file.
    """
    read = reading(**options)
    status, handle = core.snapshot_read(os.fsencode(before), *read, int(ignore_images))
    check(status)
    snapshot = _Snapshot(int(handle[0]))
    wanted = (particles_of_fabric, *plane(axes), bins)
    found = []
    for path in after:
        status, counts, tensors, numbers, roses = core.snapshot_compare(
            snapshot.handle, os.fsencode(path), *read, wanted
        )
        check(status)
        two = [
            Rose(read_only(one[one >= 0]), *map(float, numbers[place : place + 2]))
            for one, place in zip(roses, (1, 3), strict=True)
        ]
        found.append(
            FabricChange(
                *map(int, counts),
                *(read_only(one) for one in tensors[:3]),
                read_only(tensors[3:]),
                float(numbers[0]),
                *two,
            )
        )
    return found


@dataclass(frozen=True, slots=True)
class Estimate:
    """A fitted number and its standard error; NaN without degrees of freedom."""

    value: float
    error: float


@dataclass(frozen=True, slots=True)
class MechanismFit:
    """Coefficients of one mechanism (paper 001, Eqs. 14 and 16)."""

    B: Estimate
    C: Estimate
    D: Estimate
    E: Estimate
    G: Estimate
    dZ_extension: Estimate
    dZ_shear: Estimate
    dZ_compression: Estimate
    r2_dZ: float
    """share of the variation that the fit explains"""
    r2_dA: float


@dataclass(frozen=True, slots=True)
class FabricResponse:
    """Fabric response to a fan of strain probes (paper 001, section 4)."""

    loss: MechanismFit
    gain: MechanismFit
    reorientation: MechanismFit
    a: tuple[Estimate, ...]
    """a1 .. a5 of the total change (Eq. 19)"""
    linear: tuple[Estimate, ...]
    """B^g - B^l, D^g - D^l, G^g - G^l + G^r: zero for an incrementally linear response (Eq. 18)"""


def fit_fabric_response(angles: ArrayLike, rates: ArrayLike, *, printed: bool = False) -> FabricResponse:
    """Fit the representation theorem to probes at angles [deg] with their rates (n, 2, 3), of FabricChange.rates.

    printed: the signs of dA as Eqs. 13 and 15 of paper 001 print them.
    """
    angles, rates = np.asarray(angles, dtype=np.float64), np.asarray(rates, dtype=np.float64)
    if angles.ndim != 1 or rates.shape != (len(angles), 2, 3):
        raise InputError(f"rates has the shape {rates.shape}, expected ({angles.size}, 2, 3)", Status.BAD_ARGUMENT)
    probes = np.column_stack([angles, rates.reshape(len(angles), 6)])
    if not len(probes):
        raise InputError("no probes, expected 3 or more", Status.BAD_ARGUMENT)
    status, fits, totals = core.fabric_fit(probes, int(printed))
    check(status)
    estimates = [Estimate(*map(float, pair)) for pair in totals]
    mechanisms = [
        MechanismFit(*(Estimate(*map(float, pair)) for pair in fit[:16].reshape(8, 2)), *map(float, fit[16:]))
        for fit in fits
    ]
    return FabricResponse(*mechanisms, tuple(estimates[:5]), tuple(estimates[5:]))


@dataclass(frozen=True, slots=True, eq=False)
class Directions:
    """Histogram of contact directions: bins of equal area on the hemisphere, or of equal angle on the half circle."""

    dimension: int
    contacts: NDArray[np.int64]
    polar: Array
    """(bins, 2) limits of the angle from z [deg]"""
    azimuth: Array
    """(bins, 2) limits of the angle from x towards y [deg]"""
    density: Array
    """over that of an isotropic sample: 1 on average"""
    normal_force: Array
    """mean of a bin's contacts; NaN without forces"""
    shear_force: Array
    """(bins, 3) mean"""
    fabric: Fabric
    """fabric of the same contacts"""

    def plot(self, label: str = "sample") -> "Figure":
        """The sphere seen from +z with the density of second order, or in the plane roses."""
        return draw("memory.plot_directions", self, label)


def directions(path: str | os.PathLike, *, bins: int = 0, **options: Any) -> Directions:  # noqa: ANN401
    """Histogram of contact directions; bins: about as many (0: 100, in the plane 18); options as fabric_of_file."""
    room = 4 * (int(np.sqrt(max(bins, 100) / 4)) + 2) ** 2
    status, count, numbers = core.contact_directions(os.fsencode(path), *reading(**options), bins, room)
    check(status)
    numbers = numbers[: int(count[0])]
    return Directions(
        int(options.get("dimension", 3)),
        read_only(numbers[:, 4].astype(np.int64)),
        *(read_only(numbers[:, part]) for part in (slice(0, 2), slice(2, 4), 5, 6, slice(7, 10))),
        fabric_of_file(path, **options),
    )


def plane(axes: str) -> tuple[int, int]:
    """Two different axes by their letters, as numbers."""
    if len(axes) != 2 or not set(axes) <= set("xyz") or axes[0] == axes[1]:
        raise InputError(f"axes = '{axes}', expected two of x, y, z", Status.BAD_ARGUMENT)
    return "xyz".index(axes[0]), "xyz".index(axes[1])


class _Snapshot:
    """Owner of a snapshot in the library."""

    def __init__(self, handle: int) -> None:
        self.handle = handle
        weakref.finalize(self, core.snapshot_free, handle)
