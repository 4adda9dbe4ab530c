"""Figures of intervals: of delta (`hypofab delta --bootstrap`) and of stiffnesses (`hypofab stiffness --bootstrap`)."""

from collections.abc import Sequence

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hypofab.figures.style import INCH, STYLE
from hypofab.results.fabric import Result
from hypofab.tensors import COMPONENTS

MARKERS = "osD^vP"
GREYS = ("black", "#D55E00", "#00508C", "#009E73", "#AA3377", "0.5")


def _bars(
    axes: Axes, index: int, count: int, values: Sequence[float], ends: Sequence[Sequence[float]], label: str
) -> None:
    """Estimates with intervals, one sample beside the other."""
    lower, upper = np.asarray(ends)
    place = np.arange(len(values)) + (index - (count - 1) / 2) * 0.6 / count
    axes.errorbar(
        place,
        values,
        # rounding may leave an estimate at the end of its interval a digit outside of it
        yerr=np.maximum([values - lower, upper - values], 0),
        fmt=MARKERS[index % len(MARKERS)],
        color=GREYS[index % len(GREYS)],
        markersize=5,
        capsize=3,
        linewidth=1.2,
        label=label,
    )


def _place(axes: Axes, names: Sequence[str]) -> None:
    """Names below the estimates."""
    axes.set_xticks(range(len(names)), names)
    axes.set_xlim(-0.6, len(names) - 0.4)
    axes.grid(axis="x", visible=False)


def _finish(figure: Figure, axes: Axes, names: Sequence[str], level: float) -> None:
    _place(axes, names)
    figure.legend(
        *axes.get_legend_handles_labels(),
        title=f"estimate and {100 * level:g} % interval",
        loc="outside upper center",
        ncols=3,
        title_fontsize=9,
    )


def delta_intervals(samples: Sequence[Result]) -> Figure:
    """Components of delta with their intervals, in units of R."""
    with rc_context(STYLE):
        figure = Figure(figsize=(120 / INCH, 90 / INCH), layout="constrained")
        axes = figure.add_subplot()
        axes.axhline(0, color="0.4", linewidth=0.8)
        for index, sample in enumerate(samples):
            R, found = sample.data["R"], sample.data["uncertainty"]["delta"]
            ends = np.array([found["lower"], found["upper"]]) / R
            _bars(axes, index, len(samples), np.array(sample.data["delta"]) / R, ends, sample.label)
        axes.set_ylabel(rf"$\boldsymbol{{\delta}}/R$ [-] ({samples[0].data['sign']})")
        _finish(figure, axes, COMPONENTS, samples[0].data["uncertainty"]["level"])
        return figure


def stiffness_intervals(sample: Result) -> Figure:
    """Directional stiffnesses and their ratios to the lowest, with intervals (paper 000, Table 4)."""
    tests = sample.data["tests"]
    names = [test["test"] for test in tests]
    with rc_context(STYLE):
        figure = Figure(figsize=(165 / INCH, 85 / INCH), layout="constrained")
        left, right = figure.subplots(1, 2)
        for axes, key, interval in ((left, "stiffness", "interval"), (right, "relative", "relative_interval")):
            ends = [[test[interval][end] for test in tests] for end in ("lower", "upper")]
            _bars(axes, 0, 1, [test[key] for test in tests], ends, sample.label)
            axes.set_ylim(bottom=0)
        left.set_ylabel(rf"secant stiffness $q/\varepsilon_q$ [{sample.data['unit']}]")
        right.set_ylabel("relative to the lowest [-]")
        _place(right, names)
        _finish(figure, left, names, sample.data["level"])
        return figure
