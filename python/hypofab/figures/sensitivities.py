"""Figures of sensitivities: how far each number of a deck moves a curve (docs/sensitivities.md)."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure

from hypofab.figures.element_tests import COLUMN, STYLE
from hypofab.results.element_tests import Array, ResultError, read_columns, read_numbers, read_summary

LABELS = {
    "eps_q": (r"deviatoric strain $\varepsilon_q$ [%]", 100.0),
    "eps_v": (r"volumetric strain $\varepsilon_v$ [%]", 100.0),
    "q": (r"deviatoric stress $q$ [{unit}]", 1.0),
    "p": (r"mean effective stress $p$ [{unit}]", 1.0),
    "void_ratio": (r"void ratio $e$ [-]", 1.0),
    "pore_pressure": (r"pore pressure $u$ [{unit}]", 1.0),
}
"""Labels of axes and factors of what they show; other quantities are shown by their names."""


@dataclass(frozen=True)
class Sensitivities:
    """Curves of one test with their derivatives."""

    name: str
    columns: Mapping[str, Array]
    """quantities by name, one number for each row"""
    derivatives: Mapping[str, Mapping[str, Array]]
    """by the number varied, then by quantity"""
    values: Mapping[str, float]
    """of the numbers varied, as far as they are known"""
    unit: str = "kPa"

    def moved(self, number: str, quantity: str, change: float) -> Array:
        """A quantity after a relative change of a number, by the linear model."""
        return self.columns[quantity] + change * self.values[number] * self.derivatives[number][quantity]

    def drawable(self) -> list[str]:
        """The numbers whose relative change has a meaning: known and not zero."""
        return [name for name in self.derivatives if self.values.get(name)]


def read_sensitivities(directory: str | Path) -> list[Sensitivities]:
    """The tests of a folder of results that were run with `sensitivities`, in the order of the deck."""
    directory = Path(directory)
    summary = read_summary(directory)
    found = []
    for test in summary["tests"]:
        if test["file"] is None:
            continue
        path = directory / test["file"]
        table = path.with_name(f"{path.stem}_sensitivities.csv")
        if table.exists():
            initial, source = test.get("initial", {}), test.get("fabric", {})
            known = {**initial, **test.get("material", {}), **({"c": source["c"]} if "c" in source else {})}
            found.append(_read(test["name"], path, table, known, summary["unit"]))
    return found


def _read(name: str, rows: Path, table: Path, known: Mapping[str, float], unit: str) -> Sensitivities:
    results, columns = read_columns(rows), read_columns(table)
    derivatives: dict[str, dict[str, Array]] = {}
    for column in columns:
        if column in ("time", "step", "event"):
            continue
        quantity, separator, number = column.removeprefix("d").partition("/d")
        if not separator or quantity not in results:
            raise ResultError(f"{table}: column {column}, expected names like dq/dh_s")
        derivatives.setdefault(number, {})[quantity] = read_numbers(table, columns, column)
    quantities = next(iter(derivatives.values()), {})
    values = {quantity: read_numbers(rows, results, quantity) for quantity in quantities}
    return Sensitivities(name, values, derivatives, known, unit)


def curves(
    test: Sensitivities, x: str = "eps_q", y: str = "q", *, change: float = 0.1, numbers: Sequence[str] | None = None
) -> Figure:
    """One panel for each number: the curve y over x, and where it goes when the number changes by -+ `change`.

    By the linear model; points of a curve move in x as well where x moves with the number. numbers: those to draw;
    by default all whose relative change has a meaning.
    """
    drawn = list(test.drawable() if numbers is None else numbers)
    if not drawn:
        raise ValueError(f"test '{test.name}': no sensitivities whose relative change has a meaning")
    across = min(4, len(drawn))
    down = math.ceil(len(drawn) / across)
    (x_label, x_factor), (y_label, y_factor) = (LABELS.get(name, (name, 1.0)) for name in (x, y))
    steps = np.diff(test.columns[x])
    goes_on = bool((steps >= 0).all() or (steps <= 0).all())  # no band along a curve that turns back
    with rc_context(STYLE):
        size = ((0.3 + 0.42 * across) * COLUMN[0], (0.25 + 0.5 * down) * COLUMN[1])
        figure = Figure(figsize=size, layout="constrained")
        panels = figure.subplots(down, across, sharex=True, sharey=True, squeeze=False)
        for axes, number in zip(panels.flat, drawn, strict=False):
            lower, upper = (
                (x_factor * test.moved(number, x, sign * change), y_factor * test.moved(number, y, sign * change))
                for sign in (-1, 1)
            )
            if goes_on:
                outline = (np.concatenate([a, b[::-1]]) for a, b in zip(lower, upper, strict=True))
                axes.fill(*outline, color="0.85", zorder=1)
            axes.plot(*lower, color="#00508C", linestyle=(0, (1, 1.6)), linewidth=1.4, label=f"-{100 * change:g} %")
            axes.plot(*upper, color="#D55E00", linestyle=(0, (5, 2)), linewidth=1.4, label=f"+{100 * change:g} %")
            axes.plot(
                x_factor * test.columns[x], y_factor * test.columns[y], color="black", linewidth=1.2, label=test.name
            )
            place = {"xycoords": "axes fraction", "ha": "right", "va": "bottom"}
            box = {"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1.5}
            axes.annotate(number, (0.95, 0.06), weight="bold", bbox=box, **place)
        for axes in panels.flat[len(drawn) :]:
            axes.set_visible(False)
        for axes in panels.flat[len(drawn) - across : len(drawn)]:
            axes.tick_params(labelbottom=True)
        figure.supxlabel(x_label.format(unit=test.unit), fontsize=STYLE["font.size"])
        figure.supylabel(y_label.format(unit=test.unit), fontsize=STYLE["font.size"])
        handles, labels = panels[0, 0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside upper center", ncols=3, handlelength=2.8)
        return figure
