"""Outputs of a sweep: what is kept of each run. A number at a row, or a whole curve."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hypofab.library import core, stability_quantities, text
from hypofab.sweeps.source import Node
from hypofab.tensors import Array

_KEYS = ("test", "step", "quantity", "at", "over", "from", "to", "points", "stopped", "unit")
_AT = "end, start, max, min, rows, {max: QUANTITY}, {min: QUANTITY} or {QUANTITY: value}"
_WORDS = ("end", "start", "max", "min", "rows")


@dataclass(frozen=True)
class Output:
    """What is kept of a test: a number, or with `grid` or at "rows" a curve."""

    name: str
    test: str
    quantity: str
    step: int | None = None
    at: str = "end"
    """"end", "start", "max", "min", "rows", or with `other`: "max of", "min of", "value of" """
    other: str | None = None
    value: float = 0.0
    grid: tuple[float, float, int] | None = None
    """curve over the quantity `other`: from, to, points"""
    stopped: bool = False
    """keep it when the test stopped early, too"""

    @property
    def is_curve(self) -> bool:
        """A list of numbers, not one."""
        return self.grid is not None or self.at == "rows"

    @property
    def abscissa(self) -> Array | None:
        """The values of `other` that a curve is at; None: the rows of the test."""
        return None if self.grid is None else np.linspace(*self.grid)

    def of(self, rows: NDArray[np.void], complete: bool) -> Any:  # noqa: ANN401 - a number, or a list of them
        """The output of a test's rows; NaN where it has none. complete: the test did not stop early."""
        if self.step is not None:
            rows = rows[rows["step"] == self.step]
        values = rows[self.quantity]
        if self.at == "rows":
            return values.tolist()
        other: Array = rows[self.other] if self.other else values
        if self.abscissa is not None:
            return crossings(other, values, self.abscissa).tolist()
        if self.at == "value of":
            return float(crossings(other, values, np.array([self.value]))[0])
        if not (complete or self.stopped) or len(values) == 0:
            return np.nan
        if self.at in ("start", "end"):
            return float(values[0 if self.at == "start" else -1])
        if np.isnan(other).all():
            return np.nan
        place = np.nanargmax(other) if self.at.startswith("max") else np.nanargmin(other)
        return float(values[place])


def crossings(x: Array, y: Array, wanted: Array) -> Array:
    """The y where x first meets each wanted value, straight between rows; NaN where it never does."""
    known = ~np.isnan(x)
    x, y = x[known], y[known]
    if len(x) == 0:
        return np.full(len(wanted), np.nan)
    steps = np.diff(x)
    for sign in (1.0, -1.0):
        if (sign * steps > 0).all():
            found = np.interp(sign * wanted, sign * x, y, left=np.nan, right=np.nan)
            break
    else:
        found = np.array([_first_crossing(x, y, value) for value in wanted])
    for index in np.flatnonzero(np.isnan(found)):
        if _is_last(x, wanted[index]):
            found[index] = y[-1]
    return found


def _first_crossing(x: Array, y: Array, value: float) -> float:
    side = np.sign(x - value)
    if side[0] == 0:
        return float(y[0])
    after = int(np.argmax(side != side[0]))
    if after == 0:
        return np.nan
    before = after - 1
    return float(y[before] + (value - x[before]) / (x[after] - x[before]) * (y[after] - y[before]))


def _is_last(x: Array, value: float) -> bool:
    """A test ends where it is told to, but for the last bits."""
    return abs(x[-1] - value) <= 1e-9 * max(abs(value), float(np.ptp(x)))


@cache
def quantities() -> tuple[str, ...]:
    """Names of all columns of result rows."""
    names: list[str] = []
    while name := text(core.quantity_name(len(names))):
        names.append(name)
    return (*names, "step", "event")


def read_outputs(node: Node, tests: Mapping[str, bool] | None) -> tuple[Output, ...]:
    """The outputs by name. tests: those of the deck, and whether they have measures of stability; None: not known."""
    entries = node.mapping()
    if not entries:
        node.fail("no outputs, expected some")
    return tuple(_read(name, entry, tests) for name, entry in entries.items())


def _read(name: str, node: Node, tests: Mapping[str, bool] | None) -> Output:
    entries = node.mapping(_KEYS, ["quantity"])
    test = _test(node, entries, None if tests is None else tuple(tests))
    stable = tests is None or tests[test]
    kept: dict[str, Any] = {"quantity": _quantity(entries["quantity"], stable)}
    if "step" in entries:
        kept["step"] = entries["step"].whole(1, "the number of a step, from 1")
    if "stopped" in entries:
        if not isinstance(entries["stopped"].value, bool):
            entries["stopped"].refuse("true or false")
        kept["stopped"] = bool(entries["stopped"].value)
    if "unit" in entries:
        entries["unit"].text()  # the manifest keeps it, for figures
    if "over" in entries:
        if "at" in entries:
            entries["at"].fail("an output has at or over, not both")
        for key in ("to", "points"):
            if key not in entries:
                node.fail(f"key '{key}' is missing: a curve over a quantity has from (0), to and points")
        start = entries["from"].number() if "from" in entries else 0.0
        count = entries["points"].whole(2, "a whole number, 2 or more")
        kept |= {"other": _quantity(entries["over"], stable), "grid": (start, entries["to"].number(), count)}
    else:
        for key in ("from", "to", "points"):
            if key in entries:
                entries[key].fail("has a meaning only with over")
        kept |= _at(entries["at"], stable) if "at" in entries else {}
    return Output(name, test, **kept)


def _test(node: Node, entries: Mapping[str, Node], tests: Sequence[str] | None) -> str:
    if "test" in entries:
        return entries["test"].text() if tests is None else entries["test"].one_of(tests)
    if tests is not None and len(tests) > 1:
        node.fail(f"key 'test' is missing, expected one of {', '.join(tests)}")
    return tests[0] if tests else ""


def _quantity(node: Node, stable: bool) -> str:
    name = node.one_of(quantities())
    if not stable and name in stability_quantities():
        node.refuse("stability: true in the test, which this quantity needs")
    return name


def _at(node: Node, stable: bool) -> dict[str, Any]:
    if isinstance(node.value, str):
        return {"at": node.one_of(_WORDS)} if node.value in _WORDS else node.refuse(_AT)
    if not isinstance(node.value, Mapping) or len(node.value) != 1:
        node.refuse(_AT)
    ((key, entry),) = node.mapping().items()
    if key in ("max", "min"):
        return {"at": f"{key} of", "other": _quantity(entry, stable)}
    if key not in quantities():
        entry.fail(f"no quantity of this name, expected {_AT}")
    return {"at": "value of", "other": key, "value": entry.number()}
