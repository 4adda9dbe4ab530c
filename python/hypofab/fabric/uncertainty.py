"""How sure is a fabric, and the delta that follows? Fabrics drawn again and again (docs/uncertainty.md)."""

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from hypofab.errors import InputError, Status
from hypofab.fabric.samples import Fabric, reading
from hypofab.library import check, core
from hypofab.tensors import Array, read_only

UNITS = ("contacts", "blocks", "samples")


@dataclass(frozen=True, slots=True, eq=False)
class Interval:
    """A range that holds the share `level` of the replicates, and their standard deviation; arrays for tensors."""

    lower: Array
    upper: Array
    error: Array


@dataclass(frozen=True, slots=True, eq=False)
class Uncertainty:
    """Confidence in a fabric and in the delta that follows from it."""

    sample: Fabric
    """fabric of the lists as they are; coordination numbers are not known"""
    units: int
    """contacts, blocks with contacts in them, or samples that were drawn from"""
    noise2: float
    """what noise adds to a^2"""
    p_value: float
    """probability of this F or a larger one without anisotropy; NaN for 6 units or fewer"""
    delta_angle: float
    """the share `level` of deltas is within this angle of the estimate [deg]"""
    fabric: Interval
    deviatoric_fabric: Interval
    anisotropy: Interval
    """where a of another sample like this one would be"""
    corrected_anisotropy: Interval
    """where a of the unlimited sample is"""
    weight: Interval
    delta: Interval
    replicates: Array
    """(replicates, 6) N of each"""


def bootstrap(
    files: str | os.PathLike | Sequence[str | os.PathLike],
    R: float,
    c: float = 0.05,
    *,
    weight: str = "exponential",
    level: float = 0.95,
    units: str = "contacts",
    replicates: int = 1000,
    seed: int = 1,
    blocks: int = 5,
    corrected: bool = False,
    **options: Any,  # noqa: ANN401 - those of fabric_of_file
) -> Uncertainty:
    """Draw the contacts, the blocks or the samples of contact files again, and look at the scatter.

    units: "contacts"; "blocks", cubes of the sample, `blocks` along each edge; "samples", whole files. corrected: from
    fabrics without noise. options: those of fabric_of_file.
    """
    paths = [files] if isinstance(files, str | os.PathLike) else list(files)
    drawn = (*units_and_replicates(units, replicates, seed, blocks), int(corrected))
    status, fabric, numbers, count, tensors = core.bootstrap(
        b"\x1f".join(map(os.fsencode, paths)),
        *reading(**options),
        *(drawn, (level, R, c), weight.encode(), max(replicates, 1)),
    )
    check(status)
    intervals = numbers[3:].reshape(21, 3)

    def interval(rows: slice | int) -> Interval:
        return Interval(*(read_only(column) for column in intervals[rows].T))

    places = (slice(0, 6), slice(6, 12), 12, 13, 14, slice(15, 21))
    return Uncertainty(
        *(Fabric._unpack(fabric), int(count[0]), *map(float, numbers[:3])),
        *(interval(place) for place in places),
        read_only(tensors),
    )


def units_and_replicates(units: str, replicates: int, seed: int, blocks: int) -> tuple[int, int, int, int]:
    """Options of a bootstrap as the extension takes them."""
    if units not in UNITS:
        raise InputError(f"units = '{units}', expected one of {', '.join(UNITS)}", Status.BAD_ARGUMENT)
    if seed < 0:
        raise InputError(f"seed = {seed}, expected 0 or more", Status.BAD_ARGUMENT)
    return UNITS.index(units), replicates, seed, blocks if units == "blocks" else 0
