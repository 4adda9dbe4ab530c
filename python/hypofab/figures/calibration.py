"""Figures of a calibration: measured points with computed curves, what is left of the distances, correlations."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hypofab.figures.laboratory import LABELS, MEASURED
from hypofab.figures.style import COLUMN, STYLE, line_style
from hypofab.results.calibration import CalibrationResult, Columns, LabComparison, read_calibration

_PANELS = {
    "oedometer": (("sigma1", "e"),),
    "isotropic_compression": (("p", "e"),),
    "drained": (("eps1", "q"), ("eps1", "eps_v")),
    "undrained": (("eps1", "q"), ("p", "q")),
}
_PER_PAGE = 4


def _pairs(test: LabComparison) -> tuple[tuple[str, str], ...]:
    """Abscissa and ordinate of each panel of a test."""
    kind = test.kind if test.kind in _PANELS else test.kind.split("_")[0]
    return tuple(pair for pair in _PANELS[kind] if all(np.isfinite(test.measured[name]).any() for name in pair))


def _line(axes: Axes, pair: tuple[str, str], columns: Columns, label: str, index: int) -> None:
    x, y = (LABELS[name][1] * columns[name] for name in pair)
    axes.plot(x, y, label=label, **line_style(index))


def _panel(axes: Axes, pair: tuple[str, str], test: LabComparison, unit: str) -> None:
    (x_label, x_factor), (y_label, y_factor) = (LABELS[name] for name in pair)
    x, y = pair
    _line(axes, pair, test.start, "start", 1)
    _line(axes, pair, test.computed, "found", 0)
    axes.plot(x_factor * test.measured[x], y_factor * test.measured[y], label="measured", **MEASURED)
    role = "" if test.use == "fit" else ", not fitted"
    axes.set(xlabel=x_label.replace("kPa", unit), ylabel=y_label.replace("kPa", unit))
    axes.set_title(f"{test.name}{role}", fontsize=9)
    if test.scales.get(x, (1.0, False))[1]:
        axes.set_xscale("log")
    if y == "eps_v":
        axes.invert_yaxis()


def comparisons(result: CalibrationResult) -> list[Figure]:
    """Measured points, the curve of the start and that of the parameters found; four tests to a page."""
    pages = []
    with rc_context(STYLE):
        for first in range(0, len(result.tests), _PER_PAGE):
            tests = result.tests[first : first + _PER_PAGE]
            figure = Figure(figsize=(1.7 * COLUMN[0], 0.72 * COLUMN[1] * len(tests) + 0.3), layout="constrained")
            grid = figure.subplots(len(tests), 2, squeeze=False)
            for row, test in zip(grid, tests, strict=True):
                pairs = _pairs(test)
                for axes, pair in zip(row, pairs, strict=False):
                    _panel(axes, pair, test, result.unit)
                for axes in row[len(pairs) :]:
                    axes.set_axis_off()
            figure.legend(*grid[0][0].get_legend_handles_labels(), loc="outside upper center", ncols=3)
            pages.append(figure)
    return pages


def residuals(result: CalibrationResult) -> Figure:
    """Distances between measured points and computed curve along each test, by its compared quantities."""
    with rc_context(STYLE):
        columns = 2
        rows = -(-len(result.tests) // columns)
        figure = Figure(figsize=(1.7 * COLUMN[0], 0.55 * COLUMN[1] * rows + 0.4), layout="constrained")
        grid = figure.subplots(rows, columns, squeeze=False).ravel()
        names: dict[str, int] = {}
        for axes, test in zip(grid, result.tests, strict=False):
            for name, (scale, logarithmic) in test.scales.items():
                measured, nearest = test.measured[name], test.nearest[name]
                gap = np.log(measured / nearest) if logarithmic else measured - nearest
                index = names.setdefault(name, len(names))
                axes.plot(100 * gap / scale, label=LABELS[name][0].split("[")[0].strip(), **line_style(index))
            axes.axhline(0, color="0.4", linewidth=0.6)
            axes.set_title(f"{test.name}: {100 * test.distance:.1f} %", fontsize=9)
            axes.set(xlabel="row compared", ylabel="offset [% of range]")
        for axes in grid[len(result.tests) :]:
            axes.set_axis_off()
        handles: dict[str, Artist] = {}
        for axes in grid[: len(result.tests)]:
            handles |= {label: handle for handle, label in zip(*axes.get_legend_handles_labels(), strict=True)}
        figure.legend(handles.values(), handles.keys(), loc="outside upper center", ncols=3)
        return figure


def distances(result: CalibrationResult) -> Figure:
    """Distance of every test from its curve, at the start and found; squares are tests that were not fitted."""
    with rc_context(STYLE):
        figure = Figure(figsize=(1.2 * COLUMN[0], 0.2 * len(result.tests) + 1.1), layout="constrained")
        axes = figure.subplots()
        for use, marker, what in (("fit", "o", "fitted"), ("check", "s", "not fitted")):
            chosen = [(place, test) for place, test in enumerate(result.tests) if test.use == use]
            if not chosen:
                continue
            places = [place for place, _ in chosen]
            start, found = ([100 * getattr(test, key) for _, test in chosen] for key in ("start_distance", "distance"))
            axes.hlines(places, start, found, color="0.7", linewidth=1.0, zorder=1)
            shape = {"marker": marker, "linestyle": "none", "markersize": 5, "color": "#00508C"}
            axes.plot(start, places, markerfacecolor="white", label=f"{what}: start", **shape)
            axes.plot(found, places, label=f"{what}: found", **shape)
        axes.set_yticks(range(len(result.tests)), [test.name for test in result.tests], fontsize=7)
        axes.invert_yaxis()
        axes.set(xlabel="root-mean-square distance [% of the measured range]", xlim=(0, None))
        figure.legend(*axes.get_legend_handles_labels(), loc="outside upper center", ncols=2, fontsize=8)
        return figure


def correlations(result: CalibrationResult) -> Figure:
    """Correlations of the free parameters: dark is strong, the number tells the sign."""
    names = [parameter.name for parameter in result.parameters]
    side = 0.42 * len(names) + 1.2
    with rc_context(STYLE | {"axes.grid": False}):
        figure = Figure(figsize=(side + 0.6, side), layout="constrained")
        axes = figure.subplots()
        strength = np.abs(np.nan_to_num(result.correlation))
        axes.imshow(strength, cmap="Greys", vmin=0, vmax=1.2)
        for i, j in np.ndindex(strength.shape):
            value = result.correlation[i, j]
            colour = "white" if strength[i, j] > 0.7 else "black"
            shown = f"{value:.2f}" if np.isfinite(value) else "-"
            axes.text(j, i, shown, ha="center", va="center", fontsize=7, color=colour)
        axes.set_xticks(range(len(names)), names, rotation=60)
        axes.set_yticks(range(len(names)), names)
        axes.set_title("correlation of the parameters", fontsize=9)
        return figure


def draw(directory: Path, save: Callable[[Figure, Path], None]) -> None:
    """All figures of a folder that `hypofab calibrate` wrote, beside its files."""
    result = read_calibration(directory)
    pages = comparisons(result)
    for number, page in enumerate(pages, start=1):
        save(page, directory / (f"tests_{number}" if len(pages) > 1 else "tests"))
    save(residuals(result), directory / "residuals")
    save(distances(result), directory / "distances")
    save(correlations(result), directory / "correlations")
