"""Figures of sensitivities: how far each number of a deck moves a curve (docs/sensitivities.md)."""

import math
from collections.abc import Sequence

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure

from hypofab.figures.style import COLUMN, STYLE
from hypofab.results.sensitivities import Sensitivities

LABELS = {
    "eps_q": (r"deviatoric strain $\varepsilon_q$ [%]", 100.0),
    "eps_v": (r"volumetric strain $\varepsilon_v$ [%]", 100.0),
    "q": (r"deviatoric stress $q$ [{unit}]", 1.0),
    "p": (r"mean effective stress $p$ [{unit}]", 1.0),
    "void_ratio": (r"void ratio $e$ [-]", 1.0),
    "pore_pressure": (r"pore pressure $u$ [{unit}]", 1.0),
}
"""Labels of axes and factors of what they show; other quantities are shown by their names."""


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
