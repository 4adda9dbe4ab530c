"""Measures of stability along tests that were run with `stability: true` (docs/stability.md)."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure

from hypofab.figures.element_tests import COLUMN, STYLE, line_style
from hypofab.results.element_tests import Array, read_columns, read_numbers, read_summary

PANELS = (
    ("work2_cos", "second-order work of the path, cosine"),
    ("work2_ratio", "smallest second-order work, ratio"),
    ("acoustic_ratio", "smallest acoustic determinant, ratio"),
    ("control_det", "determinant of the control, ratio"),
)
"""Columns drawn, and the titles of their axes."""


@dataclass(frozen=True)
class StabilityRows:
    """Rows of one test."""

    name: str
    eps_q: Array
    columns: dict[str, Array]

    def first_loss(self, column: str) -> float | None:
        """The deviatoric strain at which a measure first falls to zero, by a straight line between rows; or None."""
        values = self.columns[column]
        below = np.flatnonzero((values[1:] <= 0) & (values[:-1] > 0))
        if below.size == 0:
            return None
        k = int(below[0])
        share = values[k] / (values[k] - values[k + 1])
        return float(self.eps_q[k] + share * (self.eps_q[k + 1] - self.eps_q[k]))


def read_stability(directory: Path) -> list[StabilityRows]:
    """The tests of a folder of results that have these columns, in the order of the deck."""
    found = []
    for test in read_summary(directory)["tests"]:
        if test["file"] is None:
            continue
        path = directory / test["file"]
        table = read_columns(path)
        if all(name in table for name, _ in PANELS):
            columns = {name: read_numbers(path, table, name) for name, _ in PANELS}
            found.append(StabilityRows(test["name"], read_numbers(path, table, "eps_q"), columns))
    return found


def figure(tests: Sequence[StabilityRows]) -> Figure:
    """The four measures over the deviatoric strain; a dot where one first falls to zero."""
    with rc_context(STYLE):
        drawn = Figure(figsize=(2 * COLUMN[0], 1.7 * COLUMN[1]), layout="constrained")
        panels = drawn.subplots(2, 2, sharex=True).flat
        for axes, (column, title) in zip(panels, PANELS, strict=True):
            axes.axhline(0, color="0.4", linewidth=0.8)
            for index, test in enumerate(tests):
                style = line_style(index)
                axes.plot(100 * test.eps_q, test.columns[column], label=test.name, **style)
                loss = test.first_loss(column)
                if loss is not None:
                    axes.plot(100 * loss, 0, marker="o", markersize=4, color=style["color"])
            axes.set(ylabel=title)
            axes.set_xlim(left=0)
        for axes in drawn.axes[2:]:
            axes.set_xlabel(r"deviatoric strain $\varepsilon_q$ [%]")
        drawn.legend(*drawn.axes[0].get_legend_handles_labels(), loc="outside upper center", ncols=4, handlelength=2.8)
        return drawn
