"""Accumulation in cyclic tests: a quantity at the reversals."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hypofab.results.tables import ResultError, read_columns, read_numbers, read_summary
from hypofab.tensors import Array


@dataclass(frozen=True)
class Accumulation:
    """A quantity of one cyclic test: arrays over the cycles that have rows."""

    name: str
    cycle: Array
    """Number of the cycle, from 1."""
    turned: Array
    """At the first reversal of the cycle."""
    returned: Array
    """At its end."""

    @property
    def grown(self) -> float:
        """Change of the value at the ends of cycles, from the first to the last: without the first loading."""
        return float(self.returned[-1] - self.returned[0])


def accumulation(path: Path, quantity: str) -> Accumulation | None:
    """The cycles of one result file of `hypofab run`, of the last step that has any; None when none has."""
    table = read_columns(path)
    return accumulation_of(path.stem, *(read_numbers(path, table, name) for name in ("cycle", "step", quantity)))


def accumulation_of(name: str, cycle: Array, step: Array, values: Array) -> Accumulation | None:
    """The cycles of one test from columns of its rows."""
    cyclic = step[cycle > 0]
    if cyclic.size == 0:
        return None
    rows = (step == cyclic[-1]) & (cycle > 0)
    cycle, values = cycle[rows], values[rows]
    last = np.append(np.diff(cycle) > 0, True)  # the row of the reversal itself comes after those on the way to it
    cycle, values = cycle[last], values[last]
    half = {float(number): value for number, value in zip(cycle, values, strict=True)}
    whole = [number for number in half if number == int(number) and number - 0.5 in half]
    if not whole:
        return None
    return Accumulation(
        name,
        np.array(whole),
        np.array([half[number - 0.5] for number in whole]),
        np.array([half[number] for number in whole]),
    )


def read_accumulations(directory: Path, quantity: str, tests: Sequence[str] = ()) -> list[Accumulation]:
    """The cyclic tests of a folder of results, or those named, in the order of the deck."""
    files = [test["file"] for test in read_summary(directory)["tests"] if test["file"] is not None]
    unknown = [name for name in tests if f"{name}.csv" not in files]
    if unknown:
        raise ResultError(f"{directory}: no test {', '.join(unknown)}")
    found = [
        accumulation(directory / file, quantity) for file in files if not tests or file.removesuffix(".csv") in tests
    ]
    cyclic = [one for one in found if one is not None]
    if not cyclic:
        raise ResultError(f"{directory}: no test with cycles")
    return cyclic


def table(tests: Sequence[Accumulation], quantity: str) -> str:
    """Value after the first cycle, amplitude of the last one, and growth in between."""
    lines = [f"{quantity:<20}{'cycles':>8}{'after first':>14}{'grown since':>14}{'amplitude':>14}"]
    for test in tests:
        amplitude = abs(float(test.turned[-1] - test.returned[-1]))
        lines.append(
            f"{test.name:<20}{test.cycle[-1]:>8.0f}{test.returned[0]:>14.4e}{test.grown:>14.4e}{amplitude:>14.4e}"
        )
    return "\n".join(lines)
