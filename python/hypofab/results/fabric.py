"""Read what `hypofab fabric`, `delta`, `describe`, `directions`, `changes` and `stiffness` print as JSON or CSV.

Tensors have the components xx yy zz xy xz yz, or xx yy xy in two dimensions.
"""

import csv
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from hypofab.results.tables import ResultError, read_json
from hypofab.tensors import Array

MECHANISMS = ("loss", "gain", "reorientation")


@dataclass(frozen=True)
class Result:
    """What one file holds."""

    label: str
    path: Path
    data: dict[str, Any]


def has_fabric(data: dict[str, Any]) -> bool:
    """A fabric tensor of three dimensions?"""
    return len(data.get("deviatoric_fabric") or ()) == 6 and data.get("dimension", 3) == 3


def has_directions(data: dict[str, Any]) -> bool:
    """A histogram of directions (`hypofab directions --json`)?"""
    return isinstance(data.get("bins"), list)


def has_changes(data: dict[str, Any]) -> bool:
    """Changes between snapshots (`hypofab changes --json`)?"""
    return isinstance(data.get("snapshots"), list)


def has_delta_intervals(data: dict[str, Any]) -> bool:
    """Intervals of delta (`hypofab delta --bootstrap N --json`)?"""
    return "delta" in data.get("uncertainty", {})


def has_stiffness_intervals(data: dict[str, Any]) -> bool:
    """Intervals of stiffnesses (`hypofab stiffness --bootstrap N --json`)?"""
    tests = data.get("tests")
    return isinstance(tests, list) and all("interval" in test and "stiffness" in test for test in tests)


KINDS: tuple[Callable[[dict[str, Any]], bool], ...] = (
    has_fabric,
    has_directions,
    has_changes,
    has_delta_intervals,
    has_stiffness_intervals,
)


def read_results(path: str | Path, label: str | None = None) -> list[Result]:
    """The objects of a file: one, or those of an array. ResultError when none is known here."""
    path = Path(path)
    data = read_json(path)
    objects = data if isinstance(data, list) else [data]
    for one in objects:
        if not isinstance(one, dict) or not any(kind(one) for kind in KINDS):
            raise ResultError(
                f"{path}: expected JSON of hypofab fabric, delta, describe, directions or changes, or of delta or "
                "stiffness with --bootstrap"
            )
    if len(objects) == 1:
        return [Result(label or path.stem, path, objects[0])]
    return [Result(f"{label or path.stem} {number}", path, one) for number, one in enumerate(objects, start=1)]


def read_series(path: str | Path) -> dict[str, Array]:
    """Columns of numbers of a CSV table, as `hypofab describe FILE... --csv` prints it; empty fields are NaN."""
    path = Path(path)
    try:
        with path.open(newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
    except OSError as error:
        raise ResultError(f"{path}: {error.strerror}") from error
    if not rows:
        raise ResultError(f"{path}: expected a header and at least one row")
    columns = {}
    for name in rows[0]:
        try:
            columns[name] = np.array([float(row[name]) if row[name] else np.nan for row in rows])
        except (TypeError, ValueError):
            continue  # text, as the names of files
    return columns


def tensor(components: list[float]) -> Array:
    """The matrix of six components (or of three, in two dimensions)."""
    if len(components) == 6:
        xx, yy, zz, xy, xz, yz = components
        return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    xx, yy, xy = components
    return np.array([[xx, xy], [xy, yy]])
