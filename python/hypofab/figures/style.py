"""The look of all figures. Lines differ in colour, width and dashes: apart in grey print and where two coincide."""

import re

from matplotlib.axes import Axes
from matplotlib.figure import Figure

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
