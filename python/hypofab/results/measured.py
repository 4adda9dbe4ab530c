"""Measured data to draw over computed tests: tables with named columns, in the units and the sign of the results."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from hypofab.results.tables import ResultError, read_columns, read_numbers
from hypofab.tensors import Array

Measured = Mapping[str, Mapping[str, Array]]
"""Columns of each data set, by its label."""

OTHER_NAMES = {"void_ratio": ("e",), "q_signed": ("q",), "q": ("q_signed",)}
"""Columns that serve for another one."""


def read_measured(paths: Mapping[str, str | Path]) -> Measured:
    """CSV files by label: every column whose fields are numbers; strains are numbers, not percent."""
    data = {}
    for label, path in paths.items():
        columns = read_columns(Path(path))
        numbers = {}
        for name in columns:
            try:
                numbers[name] = read_numbers(Path(path), columns, name)
            except ResultError:  # text, as remarks
                continue
        data[label] = numbers
    return data


def quantity(columns: Mapping[str, Array], name: str) -> Array | None:
    """A column by its name in result files, or what follows for it from others; None: not there.

    eps_1, the axial strain of a triaxial test, with eps_v (missing: none) gives eps_q = abs(eps_1 - eps_v/3); both have
    the sign of the results.
    """
    for known in (name, *OTHER_NAMES.get(name, ())):
        if known in columns:
            return np.abs(columns[known]) if name == "q" else np.asarray(columns[known])
    if name == "eps_q" and "eps_1" in columns:
        return np.abs(np.asarray(columns["eps_1"]) - np.asarray(columns.get("eps_v", 0.0)) / 3)
    return None
