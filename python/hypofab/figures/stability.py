"""Measures of stability along tests that were run with `stability: true` (docs/stability.md)."""

from collections.abc import Sequence

from matplotlib import rc_context
from matplotlib.figure import Figure

from hypofab.figures.style import COLUMN, STYLE, line_style
from hypofab.results.stability import PANELS, StabilityRows


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
