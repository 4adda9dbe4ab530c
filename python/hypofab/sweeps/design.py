"""Designs: which values of the inputs are run together. Every design ends as one table of points."""

import hashlib
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet

from hypofab.sampling import SEQUENCES, Distribution, Shape, quasi_random
from hypofab.sweeps.inputs import Input
from hypofab.sweeps.source import Node
from hypofab.tensors import Array

KINDS = ("grid", "table", *SEQUENCES, "random", "saltelli")
_KEYS = {
    "grid": (),
    "table": ("file", "points"),
    "random": ("runs", "seed", "correlation"),
    "saltelli": ("base", "seed", "sequence"),
} | dict.fromkeys(SEQUENCES, ("runs", "seed", "skip", "correlation"))
_MOST_RUNS = 2**31 - 1
_STANDARD = Distribution(Shape.NORMAL)


@dataclass(frozen=True)
class Design:
    """The kind of a design and the points it has."""

    kind: str
    points: pa.Table
    """one row per run, one column per input"""

    def digest(self) -> str:
        """SHA-256 of the points: a table's content, too, is part of what a sweep is."""
        digest = hashlib.sha256()
        for name in self.points.column_names:
            column = self.points[name]
            digest.update(f"{name}\0{column.type}\0".encode())
            if pa.types.is_string(column.type):
                digest.update("\0".join(column.to_pylist()).encode())
            else:
                digest.update(np.ascontiguousarray(column.to_numpy()).tobytes())
        return digest.hexdigest()


def read_design(node: Node, inputs: Sequence[Input]) -> Design:
    """The design of a sweep: a mapping with the key `kind`."""
    kind = node.mapping(required=["kind"])["kind"].one_of(KINDS)
    entries = node.mapping(("kind", *_KEYS[kind]))
    seed = entries["seed"].whole(0, "a whole number, 0 or more") if "seed" in entries else None
    if kind == "table":
        return Design(kind, _table(node, entries, inputs))
    for one in inputs:
        if one.values is None and one.distribution is None:
            node.fail(f"input '{one.name}' says not how it varies, which only kind: table does without")
        if kind == "grid" and one.values is None:
            node.fail(f"kind is grid, and input '{one.name}' has a distribution, expected values or range")
    if kind == "grid":
        return Design(kind, _grid(node, inputs))
    if kind == "saltelli":
        base = _required(node, entries, "base").whole(2, "a whole number, 2 or more, best a power of 2")
        return Design(kind, _saltelli(node, entries, inputs, base, seed))
    runs = _required(node, entries, "runs").whole(1, "a whole number, 1 or more")
    _check_runs(node, runs)
    if kind == "random":
        unit = np.random.default_rng(seed or 0).random((runs, len(inputs)))
    else:
        _check_dimensions(node, kind, len(inputs))
        skip = entries["skip"].whole(0, "a whole number, 0 or more") if "skip" in entries else 0
        unit = quasi_random(kind, len(inputs), runs, skip=skip, seed=seed)
    if "correlation" in entries:
        unit = _correlated(unit, _correlation(entries["correlation"], inputs))
    return Design(kind, _columns(inputs, unit))


def _required(node: Node, entries: Mapping[str, Node], key: str) -> Node:
    if key not in entries:
        node.fail(f"key '{key}' is missing")
    return entries[key]


def _check_runs(node: Node, runs: int) -> None:
    if runs > _MOST_RUNS:
        node.fail(f"{runs} runs, expected at most {_MOST_RUNS}")


def _check_dimensions(node: Node, sequence: str, dimension: int) -> None:
    if dimension > SEQUENCES[sequence]:
        node.fail(f"{dimension} dimensions, expected at most {SEQUENCES[sequence]} with {sequence} (halton: 1229)")


def _columns(inputs: Sequence[Input], unit: Array) -> pa.Table:
    """The points whose probabilities are the columns of `unit`."""
    inside = np.clip(unit, 2.0**-54, 1 - 2.0**-53)  # never an infinite quantile
    return pa.table({one.name: pa.array(one.take(inside[:, index])) for index, one in enumerate(inputs)})


def _grid(node: Node, inputs: Sequence[Input]) -> pa.Table:
    """Every combination; the last input varies fastest."""
    shape = [len(one.values or ()) for one in inputs]
    runs = math.prod(shape)
    _check_runs(node, runs)
    places = np.unravel_index(np.arange(runs), shape)
    return pa.table({one.name: pa.array(one.values).take(pa.array(at)) for one, at in zip(inputs, places, strict=True)})


def _saltelli(
    node: Node, entries: Mapping[str, Node], inputs: Sequence[Input], base: int, seed: int | None
) -> pa.Table:
    """For each base sample a row of A, of A with column i of B for each i, and of B (Saltelli et al. 2010)."""
    count = len(inputs)
    sequence = entries["sequence"].one_of(SEQUENCES) if "sequence" in entries else "sobol" if count <= 20 else "halton"
    _check_dimensions(node, sequence, 2 * count)
    _check_runs(node, base * (count + 2))
    both = quasi_random(sequence, 2 * count, base, seed=seed)
    a, b = both[:, :count], both[:, count:]
    rows = np.repeat(a[:, None, :], count + 2, axis=1)
    rows[:, -1, :] = b
    for index in range(count):
        rows[:, 1 + index, index] = b[:, index]
    return _columns(inputs, rows.reshape(-1, count))


def _correlation(node: Node, inputs: Sequence[Input]) -> Array:
    """The matrix of the correlations that are given, of [input, input, value]."""
    names = [one.name for one in inputs]
    matrix = np.eye(len(inputs))
    expected = "[input, input, correlation]"
    for entry in node.items(f"a list of {expected}"):
        parts = entry.items(expected)
        if len(parts) != 3:
            entry.refuse(expected)
        i, j = (names.index(part.one_of(names)) for part in parts[:2])
        value = parts[2].number("a correlation above -1 and below 1")
        if i == j:
            entry.refuse("two different inputs")
        if not -1 < value < 1:
            parts[2].refuse("a correlation above -1 and below 1")
        matrix[i, j] = matrix[j, i] = value
    try:
        np.linalg.cholesky(matrix)
    except np.linalg.LinAlgError:
        node.fail("no numbers are correlated like that, expected a positive definite matrix of correlations")
    return matrix


def _correlated(unit: Array, matrix: Array) -> Array:
    """Gaussian copula: the normal scores of the probabilities have these correlations."""
    scores = _STANDARD.quantiles(np.clip(unit, 2.0**-54, 1 - 2.0**-53))
    return _STANDARD.probabilities(scores @ np.linalg.cholesky(matrix).T)


def _table(node: Node, entries: Mapping[str, Node], inputs: Sequence[Input]) -> pa.Table:
    """The columns named as the inputs, of a CSV or Parquet file or of arrays."""
    if ("file" in entries) == ("points" in entries):
        node.fail("expected one of file (a CSV or Parquet file) and points (columns)")
    where = entries.get("file") or entries["points"]
    table = _read_table(where) if "file" in entries else _table_of(where)
    for one in inputs:
        if one.values is not None or one.distribution is not None:
            node.fail(f"kind is table, and input '{one.name}' says how it varies, which the table does")
        if one.name not in table.column_names:
            where.refuse(f"a column '{one.name}'; it has {', '.join(table.column_names)}")
    if table.num_rows == 0:
        where.refuse("at least one row")
    return pa.table({one.name: _checked_column(where, one.name, table[one.name]) for one in inputs})


def _read_table(node: Node) -> pa.Table:
    path = Path(node.text("a file name"))
    if node.source.path is not None:
        path = node.source.path.parent / path
    try:
        if path.suffix == ".parquet":
            return pyarrow.parquet.read_table(path)
        return pyarrow.csv.read_csv(path)
    except (OSError, pa.ArrowException) as error:
        node.fail(f"{path}: {error}")


def _table_of(node: Node) -> pa.Table:
    columns: Any = node.value
    try:
        return columns if isinstance(columns, pa.Table) else pa.table({key: pa.array(columns[key]) for key in columns})
    except (pa.ArrowException, TypeError, ValueError) as error:
        node.fail(f"{error}, expected columns of equal length")


def _checked_column(node: Node, name: str, column: pa.ChunkedArray) -> pa.ChunkedArray:
    kind = column.type
    if pa.types.is_large_string(kind) or pa.types.is_dictionary(kind):
        column, kind = column.cast(pa.string()), pa.string()
    if pa.types.is_floating(kind):
        column = column.cast(pa.float64())
    elif pa.types.is_integer(kind):
        column = column.cast(pa.int64())
    elif not (pa.types.is_string(kind) or pa.types.is_boolean(kind)):
        node.fail(f"column '{name}' holds {kind}, expected numbers or words")
    bad = column.is_null(nan_is_null=True).to_numpy()
    if bad.any():
        node.fail(f"column '{name}', row {int(np.argmax(bad)) + 1} is empty or no number")
    return column
