"""Accumulation in cyclic tests: a quantity at the reversals, over the number of cycles (paper 002, Figures 3 and 6)."""

from collections.abc import Sequence

from matplotlib import rc_context
from matplotlib.figure import Figure

from hypofab.figures.style import COLUMN, STYLE, line_style
from hypofab.results.cycles import Accumulation

STRAINS = ("eps_xx", "eps_yy", "eps_zz", "eps_v", "eps_q", "eps_acc")


def figure(
    tests: Sequence[Accumulation], quantity: str, *, logarithmic: bool = False, last: float | None = None
) -> Figure:
    """Value at the ends of cycles as a line, the amplitude up to the reversal as a band; up to the cycle `last`."""
    factor, unit = (100, " [%]") if quantity in STRAINS else (1, "")
    with rc_context(STYLE):
        drawn = Figure(figsize=COLUMN, layout="constrained")
        axes = drawn.subplots()
        for index, test in enumerate(tests):
            style = line_style(index)
            shown = test.cycle <= (test.cycle[-1] if last is None else last)
            cycle, band = test.cycle[shown], (factor * test.returned[shown], factor * test.turned[shown])
            axes.plot(cycle, band[0], label=test.name, **style)
            axes.fill_between(cycle, *band, color=style["color"], alpha=0.15, linewidth=0)
        axes.set(xlabel="number of cycles", ylabel=f"{quantity}{unit}")
        if logarithmic:
            axes.set_xscale("log")
        else:
            axes.set_xlim(0, last or max(float(test.cycle[-1]) for test in tests))
        drawn.legend(*axes.get_legend_handles_labels(), loc="outside upper center", ncols=3, handlelength=2.8)
        return drawn
