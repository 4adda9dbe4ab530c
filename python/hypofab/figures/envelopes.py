"""Response envelopes in the axisymmetric plane."""

import re
from collections.abc import Sequence

from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke

from hypofab.figures.style import INCH, STYLE, legend, line_style
from hypofab.results.envelopes import EnvelopeSeries


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
