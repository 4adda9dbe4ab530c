"""Figures of paths: void ratio over the logarithm of mean stress, and loops of cycles."""

from importlib.util import find_spec
from typing import TYPE_CHECKING

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

from hypofab.figures import measured as laboratory
from hypofab.figures.style import COLUMN, STYLE, legend, line_style
from hypofab.results.element_tests import Run, TestResult
from hypofab.results.measured import Measured

if TYPE_CHECKING:
    from hypofab.model.materials import Material

LIMITS = (("e_d", (0, (1, 1.5))), ("e_c", (0, (3, 2))), ("e_i", (0, (7, 2))))
"""Symbol and dashes of the limiting void ratios, in the library's order: densest, critical, loosest."""


def _limits(axes: Axes, material: "Material", among_others: bool) -> None:
    """The limiting curves over the range of the axes, with their symbols at the right end."""
    p = np.geomspace(*axes.get_xlim(), 200)
    for (symbol, dashes), curve in reversed(list(zip(LIMITS, material.limiting_void_ratios(p).T, strict=True))):
        if np.isnan(curve).any():  # a model without this limit
            continue
        axes.plot(p, curve, color="0.45", linestyle=dashes, linewidth=1.0, zorder=1.5)
        place = {"textcoords": "offset points", "va": "center", "annotation_clip": False, "color": "0.25"}
        note = rf"${symbol}$" + (f"\n{material['phi_c']:g}°" if among_others and "phi_c" in material else "")
        axes.annotate(note, (p[-1], curve[-1]), (4, 0), **place)


def _materials(run: Run) -> "list[Material]":
    """The materials of a run's tests, each once; none where the compiled library is not here, as in a source tree."""
    if find_spec("hypofab._core") is None:
        return []
    from hypofab.model.materials import Material

    known = [test.material for test in run.tests if test.material is not None]
    materials = (one if isinstance(one, Material) else Material(**one) for one in known)
    return list(dict.fromkeys(materials))


def compression(run: Run, *, limits: bool = True, measured: Measured | None = None) -> Figure:
    """Void ratio over the logarithm of mean effective stress, between the limiting void ratios of the sand.

    Limiting curves of several sands are told apart by their critical friction angles. limits: draw them.
    """
    with rc_context(STYLE):
        figure = Figure(figsize=COLUMN, layout="constrained")
        axes = figure.add_subplot()
        for index, test in enumerate(run.tests):
            shown = test.p > 0
            axes.plot(test.p[shown], test.void_ratio[shown], label=test.name, **line_style(index))
            axes.plot(test.p[shown][:1], test.void_ratio[shown][:1], "o", color=line_style(index)["color"], ms=3)
        laboratory.draw(axes, measured or {}, ("p", "void_ratio"))
        axes.set_xscale("log")
        axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axes.xaxis.set_major_formatter("{x:g}")
        axes.xaxis.set_minor_formatter(NullFormatter())
        axes.set(xlabel=rf"mean effective stress $p$ [{run.unit}]", ylabel="void ratio $e$ [-]")
        low, high = axes.get_xlim()
        if high < 10 * low:  # a decade at least
            middle = np.sqrt(low * high)
            low, high = middle / np.sqrt(10), middle * np.sqrt(10)
        axes.set_xlim(low, high)
        materials = _materials(run) if limits else []
        for material in materials:
            _limits(axes, material, len(materials) > 1)
        axes.set_xlim(low, high)
        legend(figure, axes, columns=4)
        return figure


def axial_component(test: TestResult) -> int:
    """The axis whose stress difference to the two others is q_signed: 0, 1 or 2 for x, y, z."""
    normal = test.stress[:, :3]
    difference = normal - (normal.sum(axis=1)[:, None] - normal) / 2
    return int(np.argmin(np.abs(np.abs(difference) - np.abs(test.q_signed)[:, None]).sum(axis=0)))


def loops(run: Run, *, measured: Measured | None = None) -> Figure:
    """Deviator along the axis over axial strain, compression positive: the loops of cyclic triaxial tests.

    measured: columns eps_1, the axial strain in the sign of the results, and q.
    """
    sign = 1 if run.compression_positive else -1
    with rc_context(STYLE):
        figure = Figure(figsize=COLUMN, layout="constrained")
        axes = figure.add_subplot()
        axes.axhline(0, color="0.4", linewidth=0.8)
        axes.axvline(0, color="0.4", linewidth=0.8)
        for index, test in enumerate(run.tests):
            strain = sign * test.strain[:, axial_component(test)]
            style = line_style(index) | {"linewidth": 0.6 * line_style(index)["linewidth"]}
            axes.plot(100 * strain, test.q_signed, label=test.name, **style)
        laboratory.draw(axes, measured or {}, ("eps_1", "q_signed"), (100 * sign, 1))
        axes.set(
            xlabel=r"axial strain $\varepsilon_1$ [%] (compression positive)",
            ylabel=rf"axial deviator $q$ [{run.unit}]",
        )
        legend(figure, axes, columns=4)
        return figure
