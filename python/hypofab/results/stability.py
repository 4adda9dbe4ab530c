"""Measures of stability along tests that were run with `stability: true`."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hypofab.results.tables import read_columns, read_numbers, read_summary
from hypofab.tensors import Array

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
