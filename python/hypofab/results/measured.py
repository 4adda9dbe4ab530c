"""Measured data to draw over computed tests: tables with named columns, in the units and the sign of the results."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes

from hypofab.results.element_tests import Array, ResultError, read_columns, read_numbers

Measured = Mapping[str, Mapping[str, Array]]
"""Columns of each data set, by its label."""

OTHER_NAMES = {"void_ratio": ("e",), "q_signed": ("q",), "q": ("q_signed",)}
"""Columns that serve for another one."""

MARKERS = "osD^v<>"


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


def draw(axes: Axes, data: Measured, names: tuple[str, str], factors: tuple[float, float] = (1.0, 1.0)) -> None:
    """Two quantities of every data set that has both as open grey markers, at most about 200 of a set."""
    for index, (label, columns) in enumerate(data.items()):
        x, y = (quantity(columns, name) for name in names)
        if x is None or y is None:
            continue
        every = max(1, len(x) // 200)
        style = {"marker": MARKERS[index % len(MARKERS)], "markersize": 3.5, "markerfacecolor": "white"}
        style |= {"linestyle": "", "color": "0.35", "markeredgewidth": 0.8, "zorder": 1.8}
        axes.plot(factors[0] * x[::every], factors[1] * y[::every], label=label, **style)
