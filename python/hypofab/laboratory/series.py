"""Measured and computed tests in the same form: named columns, compression positive, kPa and ratios."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hypofab.laboratory.catalogue import LabTest
from hypofab.results.element_tests import read_test
from hypofab.results.tables import ResultError, read_columns, read_numbers
from hypofab.tensors import Array


@dataclass(frozen=True)
class Series:
    """Rows of a test: arrays of equal length by name, any of eps1, eps_v, q (signed), p, e, sigma1."""

    columns: dict[str, Array]

    def __getitem__(self, name: str) -> Array:
        """One column."""
        return self.columns[name]

    def __contains__(self, name: str) -> bool:
        """Is the column there?"""
        return name in self.columns


def read_measured(test: LabTest, directory: Path) -> Series:
    """The file of a laboratory test; ResultError when it does not hold what the catalogue says."""
    path = directory / test.file
    table = read_columns(path)
    columns = {key: factor * read_numbers(path, table, name) for key, (name, factor) in test.columns.items()}
    if not all(np.all(np.isfinite(values)) for values in columns.values()):
        raise ResultError(f"{path}: a number is missing or not finite")
    if test.kind == "oedometer":
        kept = columns["sigma1"] >= test.from_sigma1
        columns = {key: values[kept] for key, values in columns.items()}
    return Series(columns)


def read_computed(path: Path) -> Series:
    """A test of `hypofab run` with axis z from a deck with sign: compression_positive."""
    result = read_test(path)
    axial, lateral = result.stress[:, 2], result.stress[:, 0]
    return Series(
        {
            "eps1": result.strain[:, 2],
            "eps_v": result.eps_v,
            "q": axial - lateral,
            "p": result.p,
            "e": result.void_ratio,
            "sigma1": axial,
            "step": result.step,
        }
    )


def legs(values: Array) -> list[slice]:
    """Monotonic parts of a sequence with loops, as slices that share their end points."""
    signs = np.sign(np.diff(values))
    turns = [0]
    direction = 0.0
    for index, sign in enumerate(signs):
        if sign and direction and sign != direction:
            turns.append(index)
        if sign:
            direction = sign
    return [slice(start, end + 1) for start, end in zip(turns, [*turns[1:], len(values) - 1], strict=True)]


def reversals(values: Array, least: float) -> list[int]:
    """Indices at which a noisy sequence turns back by more than `least`, its last extreme before each."""
    found: list[int] = []
    high = low = 0
    rising: bool | None = None
    for index, value in enumerate(values):
        high = index if value > values[high] else high
        low = index if value < values[low] else low
        if rising is not False and values[high] - value > least:
            found += [high] if rising is not None or high else []
            rising, low = False, index
        elif rising is not True and value - values[low] > least:
            found += [low] if rising is not None or low else []
            rising, high = True, index
    return found
