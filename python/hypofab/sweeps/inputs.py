"""Inputs of a sweep: what varies, where it stands in the deck, and between which values."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from hypofab.sampling import Distribution, Shape
from hypofab.sweeps.deck_path import Part, PathError, parse_path
from hypofab.sweeps.source import Node
from hypofab.tensors import Array

KEYS = ("path", "values", "range", "uniform", "log_uniform", "normal", "log_normal", "unit")
_WAYS = KEYS[1:7]
_ENDS = "two numbers, the lower one first"


@dataclass(frozen=True)
class Input:
    """One number (or word) that varies."""

    name: str
    paths: tuple[tuple[Part, ...], ...] = ()
    """places in the deck that take it"""
    distribution: Distribution | None = None
    values: tuple[Any, ...] | None = None
    """the values it takes; None, and no distribution: those of a table"""

    def take(self, probabilities: Array) -> Any:  # noqa: ANN401 - an array of numbers, or a list
        """Values at probabilities in [0, 1): quantiles, or the values in equal parts."""
        if self.distribution is not None:
            return self.distribution.quantiles(probabilities)
        if self.values is None:
            raise TypeError(f"{self.name} takes the values of a table")
        places = np.minimum((probabilities * len(self.values)).astype(int), len(self.values) - 1)
        return [self.values[place] for place in places]


def read_inputs(node: Node, *, deck: bool) -> tuple[Input, ...]:
    """The inputs by name. deck: they have paths in a deck; else a function takes them by name."""
    entries = node.mapping()
    if not entries:
        node.fail("no inputs, expected some")
    return tuple(_read(name, entry, deck) for name, entry in entries.items())


def _read(name: str, node: Node, deck: bool) -> Input:
    entries = node.mapping(KEYS, ["path"] if deck else [])
    if not deck and "path" in entries:
        entries["path"].fail("a function takes its inputs by name, expected no path")
    ways = [entries[key] for key in _WAYS if key in entries]
    if len(ways) > 1:
        ways[1].fail(f"a second way to say how it varies, expected one of {', '.join(_WAYS)}")
    given = {"values": None, "distribution": None}
    if ways:
        given |= _WAY[str(ways[0].keys[-1])](ways[0])
    paths = _paths(entries["path"]) if deck else ()
    if "unit" in entries:
        entries["unit"].text()  # the manifest keeps it, for figures
    return Input(name, paths, **given)


def _paths(node: Node) -> tuple[tuple[Part, ...], ...]:
    nodes = [node] if isinstance(node.value, str) else node.items("a path into the deck, or a list of paths")
    paths = []
    for one in nodes:
        try:
            paths.append(parse_path(one.text("a path into the deck")))
        except PathError as error:
            one.refuse(str(error))
    if not paths:
        node.refuse("a path into the deck, or a list of paths")
    return tuple(paths)


def _values(node: Node) -> dict[str, Any]:
    expected = "a list of numbers, or one of words"
    values = [item.value for item in node.items(expected)]
    plain = [value.item() if isinstance(value, np.generic) else value for value in values]
    if not plain:
        node.refuse(expected)
    if any(isinstance(value, float) for value in plain):
        return {"values": tuple(item.number() for item in node.items())}
    kinds = {type(value) for value in plain}
    for kind in (bool, int, str):  # ruamel has classes of its own for these
        if all(issubclass(found, kind) and (kind is bool or found is not bool) for found in kinds):
            return {"values": tuple(kind(value) for value in plain)}
    node.refuse(expected)


def _range(node: Node) -> dict[str, Any]:
    entries = node.mapping(("from", "to", "count", "spacing"), ("from", "to", "count"))
    start, end = entries["from"].number(), entries["to"].number()
    count = entries["count"].whole(2, "a whole number, 2 or more")
    spacing = entries["spacing"].one_of(("linear", "logarithmic")) if "spacing" in entries else "linear"
    if spacing == "linear":
        return {"values": tuple(np.linspace(start, end, count).tolist())}
    if start <= 0 or end <= 0:
        node.fail(f"from {start:g} to {end:g}, expected ends > 0 with logarithmic spacing")
    return {"values": tuple(np.geomspace(start, end, count).tolist())}


def _ends(node: Node, shape: Shape) -> dict[str, Any]:
    lower, upper = node.pair(_ENDS)
    if not lower < upper or (shape is Shape.LOG_UNIFORM and lower <= 0):
        node.refuse(_ENDS + (", both > 0" if shape is Shape.LOG_UNIFORM else ""))
    return {"distribution": Distribution(shape, lower=lower, upper=upper)}


def _normal(node: Node, shape: Shape) -> dict[str, Any]:
    centre = "mean" if shape is Shape.NORMAL else "median"
    entries = node.mapping((centre, "deviation", "lower", "upper"), (centre, "deviation"))
    mean, deviation = entries[centre].number(), entries["deviation"].number()
    if deviation <= 0:
        entries["deviation"].refuse("a standard deviation > 0")
    lowest = -math.inf
    if shape is Shape.LOG_NORMAL:
        if mean <= 0:
            entries[centre].refuse("a median > 0")
        mean, lowest = math.log(mean), 0.0
    lower = entries["lower"].number(infinite=True) if "lower" in entries else lowest
    upper = entries["upper"].number(infinite=True) if "upper" in entries else math.inf
    if not lowest <= lower < upper:
        node.fail(f"cut off at {lower:g} and {upper:g}, expected lower < upper" + (", lower >= 0" * (lowest == 0)))
    return {"distribution": Distribution(shape, mean, deviation, lower, upper)}


_WAY = {
    "values": _values,
    "range": _range,
    "uniform": lambda node: _ends(node, Shape.UNIFORM),
    "log_uniform": lambda node: _ends(node, Shape.LOG_UNIFORM),
    "normal": lambda node: _normal(node, Shape.NORMAL),
    "log_normal": lambda node: _normal(node, Shape.LOG_NORMAL),
}
