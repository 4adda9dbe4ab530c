"""Stress and dilatancy in drained triaxial compression, and critical states (paper 003, Figures 9 and 19).

Compression positive: eps_v > 0 is contraction, dilation has d eps_v/d eps_1 < 0.
"""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hypofab.figures.style import COLUMN, STYLE
from hypofab.model.materials import Material
from hypofab.results.drained import DrainedTest, critical_ratio, dilatancy_points, rowe

MARKERS = "osD^v<>phX*"


def _axes(figure: Figure, columns: int) -> list[Axes]:
    return list(figure.subplots(1, columns, squeeze=False)[0])


def stress_dilatancy(groups: Mapping[str, Sequence[DrainedTest]], friction_angle: float) -> Figure:
    """q/p over d eps_v/d eps_1 for each group of tests (a column each), with Rowe's line for a friction angle."""
    with rc_context(STYLE):
        figure = Figure(figsize=(COLUMN[0] * (0.35 + 0.65 * len(groups)), COLUMN[1]), layout="constrained")
        axes = _axes(figure, len(groups))
        for axis, (title, tests) in zip(axes, groups.items(), strict=True):
            for number, points in enumerate(dilatancy_points(test) for test in tests):
                style = {"linestyle": "none", "marker": MARKERS[number % len(MARKERS)], "markersize": 4}
                axis.plot(points.dilatancy, points.ratio, markerfacecolor="none", label=points.name, **style)
            line = np.linspace(-1.0, 0.6, 60)
            axis.plot(line, rowe(line, friction_angle), "k-", linewidth=1.2, label=rf"Rowe, {friction_angle:g}°")
            axis.set(title=title, xlabel=r"$d\varepsilon_v/d\varepsilon_1$ (contraction positive)", xlim=(-1.0, 0.6))
            axis.legend(fontsize=7)
        top = max(axis.get_ylim()[1] for axis in axes)
        for axis in axes:
            axis.set_ylim(0, top)
        axes[0].set_ylabel(r"stress ratio $q/p$")
        return figure


def critical_states(groups: Mapping[str, Sequence[DrainedTest]], material: Material) -> Figure:
    """Ends of tests in e-log p and q-p, with the model's critical state lines; open points: not yet critical there.

    A test counts as critical at its end where the slope |d eps_v/d eps_1| over its last 2 % of strain is below 0.05.
    """
    with rc_context(STYLE):
        figure = Figure(figsize=(2 * COLUMN[0], COLUMN[1]), layout="constrained")
        left, right = _axes(figure, 2)
        highest = 1.0
        for number, (title, tests) in enumerate(groups.items()):
            colour = f"C{number}"
            for index, test in enumerate(tests):
                late = test.eps_1 > test.eps_1[-1] - 0.02
                slope = np.polyfit(test.eps_1[late], test.eps_v[late], 1)[0] if np.count_nonzero(late) > 2 else np.inf
                face = colour if abs(slope) < 0.05 else "none"
                style = {"color": colour, "marker": MARKERS[number % len(MARKERS)], "markersize": 5}
                style |= {"markerfacecolor": face, "linestyle": "none", "label": title if index == 0 else None}
                left.plot(test.p[-1], test.void_ratio[-1], **style)
                right.plot(test.p[-1], test.q[-1], **style)
                highest = max(highest, float(test.p[-1]))
        p = np.geomspace(10, 2 * highest, 80)
        left.plot(p, material.limiting_void_ratios(p)[:, 1], "k-", linewidth=1.2, label="model, $e_c(p)$")
        p = np.array([0, 1.1 * highest])
        right.plot(p, critical_ratio(material["phi_c"]) * p, "k-", linewidth=1.2, label=r"model, $\varphi_c$")
        left.set(xscale="log", xlabel="$p$ [kPa]", ylabel="void ratio $e$")
        right.set(xlabel="$p$ [kPa]", ylabel="$q$ [kPa]", xlim=(0, None), ylim=(0, None))
        left.legend(fontsize=7)
        right.legend(fontsize=7)
        return figure
