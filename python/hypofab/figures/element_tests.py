"""Figures of element tests and response envelopes. Each function returns a matplotlib Figure and shows nothing.

Lines differ in colour, width and dashes, so that they stay apart in grey print and where two of them coincide.
"""

from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hypofab.figures import measured as laboratory
from hypofab.figures.style import COLUMN, STYLE, legend, line_style
from hypofab.results.element_tests import Run
from hypofab.results.measured import Measured


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
