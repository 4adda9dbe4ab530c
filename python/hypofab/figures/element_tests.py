"""Figures of element tests and response envelopes. Each function returns a matplotlib Figure and shows nothing.

Lines differ in colour, width and dashes, so that they stay apart in grey print and where two of them coincide.
"""

import re
from collections.abc import Sequence

from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke

from hypofab.results import measured as laboratory
from hypofab.results.element_tests import EnvelopeSeries, Run
from hypofab.results.measured import Measured

STYLE = {
    "font.family": "sans-serif",
    "font.size": 9,
    "axes.linewidth": 0.8,
    "axes.grid": True,
    "grid.color": "0.88",
    "grid.linewidth": 0.6,
    "axes.axisbelow": True,
    "xtick.direction": "in",
    "ytick.direction": "in",
    "legend.frameon": False,
    "lines.solid_capstyle": "round",
    "mathtext.fontset": "dejavusans",
    "axes.unicode_minus": True,
}

LINES = (
    {"color": "#000000", "linestyle": "-", "linewidth": 1.4},
    {"color": "#D55E00", "linestyle": (0, (5, 2)), "linewidth": 1.6},
    {"color": "#7FBFE8", "linestyle": "-", "linewidth": 3.2, "zorder": 1.9},
    {"color": "#00508C", "linestyle": (0, (1, 1.6)), "linewidth": 1.6},
    {"color": "#009E73", "linestyle": (0, (6, 1.5, 1, 1.5)), "linewidth": 1.5},
    {"color": "#AA3377", "linestyle": (0, (3, 1, 1, 1, 1, 1)), "linewidth": 1.5},
)
"""Line styles in the order of use; the wide light line shows beside a dark one drawn on top of it."""

INCH = 25.4  # mm
COLUMN = (120 / INCH, 90 / INCH)
"""Size of a figure [inch]: readable when printed across one column and a half."""


def line_style(index: int) -> dict:
    """Line style number index; they repeat after the last one."""
    return dict(LINES[index % len(LINES)])


def legend(figure: Figure, axes: Axes, columns: int) -> None:
    """A legend above the axes, where it covers no data; fewer columns where labels are long."""
    handles, labels = axes.get_legend_handles_labels()
    longest = max((len(re.sub(r"\\[A-Za-z]+|[${}]", "", label)) for label in labels), default=0)
    fitting = max(1, int(10 * figure.get_figwidth() / (longest + 5)))
    figure.legend(handles, labels, loc="outside upper center", ncols=min(columns, fitting), handlelength=2.8)


def stress_strain(run: Run, *, zoom: float | None = None, measured: Measured | None = None) -> Figure:
    """Deviatoric stress q over deviatoric strain eps_q (paper 000, Figure 7).

    zoom: an inset shows eps_q from 0 to this value [-], e.g. 1e-3; None: no inset. Where the tests reach less than ten
    times as far, the axes show that range themselves and the inset would cover the curves: it is left out.
    measured: data of tests to draw over them, columns eps_q and q (hypofab.measured).
    """
    with rc_context(STYLE):
        figure = Figure(figsize=COLUMN, layout="constrained")
        axes = figure.add_subplot()
        for index, test in enumerate(run.tests):
            axes.plot(100 * test.eps_q, test.q, label=test.name, **line_style(index))
        laboratory.draw(axes, measured or {}, ("eps_q", "q"), (100, 1))
        axes.set(xlabel=r"deviatoric strain $\varepsilon_q$ [%]", ylabel=rf"deviatoric stress $q$ [{run.unit}]")
        axes.set_xlim(left=0)
        axes.set_ylim(bottom=0)
        if zoom is not None and max(test.eps_q.max() for test in run.tests) > 10 * zoom:
            _zoom_inset(axes, run, zoom)
        legend(figure, axes, columns=4)
        return figure


def _zoom_inset(axes: Axes, run: Run, zoom: float) -> None:
    """An inset in the lower right of the axes with eps_q from 0 to zoom."""
    inset = axes.inset_axes((0.40, 0.14, 0.56, 0.50))
    top = 0.0
    for index, test in enumerate(run.tests):
        shown = test.eps_q <= zoom * (1 + 1e-9)
        top = max(top, test.q[shown].max(initial=0.0))
        inset.plot(100 * test.eps_q, test.q, **line_style(index))
    inset.set_xlim(0, 100 * zoom)
    inset.set_ylim(0, 1.05 * top if top > 0 else None)
    inset.tick_params(labelsize=7)
    inset.locator_params(nbins=5)


def volumetric(run: Run, *, compression_positive: bool = False, measured: Measured | None = None) -> Figure:
    """Volumetric strain eps_v over deviatoric strain eps_q (paper 000, Figure 8).

    compression_positive: sign of eps_v in the figure, whatever that of the results and of measured data.
    """
    sign = 1 if compression_positive == run.compression_positive else -1
    meaning = "contraction" if compression_positive else "dilation"
    with rc_context(STYLE):
        figure = Figure(figsize=COLUMN, layout="constrained")
        axes = figure.add_subplot()
        axes.axhline(0, color="0.4", linewidth=0.8)
        for index, test in enumerate(run.tests):
            axes.plot(100 * test.eps_q, 100 * sign * test.eps_v, label=test.name, **line_style(index))
        laboratory.draw(axes, measured or {}, ("eps_q", "eps_v"), (100, 100 * sign))
        axes.set(
            xlabel=r"deviatoric strain $\varepsilon_q$ [%]",
            ylabel=rf"volumetric strain $\varepsilon_v$ [%] ({meaning} positive)",
        )
        axes.set_xlim(left=0)
        legend(figure, axes, columns=4)
        return figure


def stress_path(run: Run, *, measured: Measured | None = None) -> Figure:
    """Deviator along the axis over mean effective stress: undrained tests, cycles, extension below zero."""
    with rc_context(STYLE):
        figure = Figure(figsize=COLUMN, layout="constrained")
        axes = figure.add_subplot()
        axes.axhline(0, color="0.4", linewidth=0.8)
        for index, test in enumerate(run.tests):
            axes.plot(test.p, test.q_signed, label=test.name, **line_style(index))
        laboratory.draw(axes, measured or {}, ("p", "q_signed"))
        axes.set(
            xlabel=rf"mean effective stress $p$ [{run.unit}]",
            ylabel=rf"axial deviator $q$ [{run.unit}]",
        )
        axes.set_xlim(left=0)
        legend(figure, axes, columns=4)
        return figure


def _delta_symbol(name: str) -> str | None:
    """The symbol of a series named delta_A, with its index as in the paper; None for other names."""
    index = re.fullmatch(r"delta_([A-Za-z0-9]+)", name)
    return rf"$\boldsymbol{{\delta}}_{{\mathrm{{{index[1]}}}}}$" if index else None


def _arrow(axes: Axes, x: float, y: float, *, label: str, style: dict) -> None:
    """An arrow from the origin to (x, y) with a label behind its tip; none for a vanishing vector."""
    size = (x**2 + y**2) ** 0.5
    if size == 0:
        return
    arrow = {"arrowstyle": "-|>", "color": style["color"], "linewidth": 1.6, "shrinkA": 0, "shrinkB": 0, "zorder": 3}
    axes.annotate("", xy=(x, y), xytext=(0, 0), arrowprops=arrow)
    axes.update_datalim([(1.15 * x, 1.15 * y)])  # room for the label
    _mark(axes, (x, y), (11 * x / size, 11 * y / size), label)


def _mark(axes: Axes, point: tuple[float, float], offset: tuple[float, float], label: str) -> None:
    """A label at an offset [pt] from a point, legible on top of lines."""
    axes.annotate(
        label,
        point,
        offset,
        textcoords="offset points",
        ha="center",
        va="center",
        path_effects=[withStroke(linewidth=2.5, foreground="white")],
    )


def response_envelopes(
    series: Sequence[EnvelopeSeries],
    *,
    compression_positive: bool = False,
) -> Figure:
    """Response envelopes around the stress T0 in the axisymmetric plane (paper 000, Figure 1).

    The plane is isometric: sqrt(2) times the lateral over the axial stress rate, both per unit strain rate. An arrow in
    the line's colour shows the intergranular strain of each state that has one, to the scale of R.

    compression_positive: sign in the figure, whatever that of the results.
    """
    sign = 1 if compression_positive == series[0].compression_positive else -1
    factor, unit = (1e-3, "MPa") if series[0].unit == "kPa" else (1.0, series[0].unit)
    with rc_context(STYLE):
        figure = Figure(figsize=(110 / INCH, 115 / INCH), layout="constrained")
        axes = figure.add_subplot()
        axes.axhline(0, color="0.55", linewidth=0.8)
        axes.axvline(0, color="0.55", linewidth=0.8)
        reach = max(float((s.axial**2 + s.lateral**2).max()) for s in series) ** 0.5 * factor
        for index, state in enumerate(series):
            symbol = _delta_symbol(state.name)
            lateral, axial = (sign * factor * values for values in (state.lateral, state.axial))
            closed = [*range(len(axial)), 0]
            axes.plot(lateral[closed], axial[closed], label=symbol or state.name, **line_style(index))
            scale = sign * 0.5 * reach  # |delta| = R: half of the largest response
            tip = (scale * state.delta[1], scale * state.delta[0])
            _arrow(axes, *tip, label=symbol or r"$\boldsymbol{\delta}$", style=line_style(index))
        axes.plot(0, 0, marker="o", markersize=4, color="black")
        _mark(axes, (0, 0), (12, -9), r"$\mathbf{T}_0$")
        axes.set_aspect("equal", adjustable="datalim")
        convention = "compression" if compression_positive else "tension"
        axes.set(
            xlabel=rf"$\sqrt{{2}}\,\dot{{T}}_\mathrm{{lateral}}/|\mathbf{{D}}|$ [{unit}] ({convention} positive)",
            ylabel=rf"$\dot{{T}}_\mathrm{{axial}}/|\mathbf{{D}}|$ [{unit}] ({convention} positive)",
        )
        legend(figure, axes, columns=min(3, len(series)))
        return figure
