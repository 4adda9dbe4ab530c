"""Tables and JSON that the program writes, as columns and objects; what is wrong names the file."""

import csv
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from hypofab.tensors import Array


class ResultError(ValueError):
    """A result file is missing or does not have the expected content; the message names the file."""


def read_columns(path: Path) -> dict[str, list[str]]:
    """The columns of a CSV file by the names of its header; ResultError when it is no table."""
    try:
        with path.open(newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
    except OSError as error:
        raise ResultError(f"{path}: {error.strerror}") from error
    if len(rows) < 2:
        raise ResultError(f"{path}: expected a header and at least one row")
    header = rows[0]
    for number, row in enumerate(rows[1:], start=2):
        if len(row) != len(header):
            raise ResultError(f"{path}, line {number}: {len(row)} fields where the header has {len(header)}")
    return {name: [row[index] for row in rows[1:]] for index, name in enumerate(header)}


def read_numbers(path: Path, columns: Mapping[str, list[str]], name: str) -> Array:
    """One column as numbers; ResultError when it is missing or holds something else."""
    if name not in columns:
        raise ResultError(f"{path}: no column {name}")
    try:
        return np.array(columns[name], dtype=np.float64)
    except ValueError as error:
        raise ResultError(f"{path}, column {name}: {error}") from error


def read_json(path: str | Path) -> Any:  # noqa: ANN401 - whatever the file holds
    """What a JSON file holds; ResultError when it cannot be read."""
    path = Path(path)
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise ResultError(f"{path}: {error.strerror}") from error
    except ValueError as error:  # no JSON, or no UTF-8
        raise ResultError(f"{path}: {error}") from error


def read_summary(directory: str | Path) -> dict[str, Any]:
    """DIR/summary.json of `hypofab run`."""
    return read_json(Path(directory) / "summary.json")
