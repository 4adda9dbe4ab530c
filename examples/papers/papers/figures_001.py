"""Figures of paper 001: stress and fabric in strain probes."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from hypofab.figures import INCH, STYLE, line_style
from hypofab.results import Array
from papers import draw

if TYPE_CHECKING:
    from papers.paper_001 import ElementFan, Fan

MARKERS = "os^DvP"
MECHANISMS = ("loss", "gain", "reorientation")


def looks(fans: list[Fan]) -> list[dict]:
    """A line with marker for each sample: one per friction while preparing, open markers for further seeds."""
    recipes = list(dict.fromkeys(fan.friction for fan in fans))
    return [
        line_style(recipes.index(fan.friction))
        | {"marker": MARKERS[recipes.index(fan.friction) % 6], "fillstyle": "full" if fan.seed == 1 else "none"}
        for fan in fans
    ]


def names(fans: list[Fan]) -> list[str]:
    """Z of each sample, and its seed if that is not the first."""
    return [f"Z = {fan.coordination:.2f}" + (f", seed {fan.seed}" if fan.seed != 1 else "") for fan in fans]


def stress_panel(axes: Axes, style: dict, strain: Array, stress: Array, matrix: Array, label: str) -> None:
    """Stress responses as points, the ellipse of the linear map as a line. style: of line and points."""
    angle = np.linspace(0, 2 * np.pi, 181)
    ellipse = matrix @ np.stack([np.cos(angle), np.sin(angle)]) * strain.mean()
    axes.plot(*ellipse, **(style | {"linewidth": 1.0, "marker": ""}))
    axes.plot(*stress.T, markersize=3.5, label=label, **(style | {"linestyle": ""}))


def responses(fans: list[Fan], element: list[ElementFan], path: Path) -> None:
    """Figures 2 and 3: stress responses with the linear map's ellipse, of element tests too, and of the fabric."""
    with draw.panels(path, 3) as (stress, sand, fabric):
        for fan, look, label in zip(fans, looks(fans), names(fans), strict=True):
            stiffness = fan.run.results["material"]["stiffness"] / 1e3
            matrix, _ = fan.linear
            scale = 1e4 / stiffness
            stress_panel(stress, look, fan.strain, scale * fan.stress, scale * matrix, label)
            change = np.array([change.change[:2] for change in fan.changes])
            closed = [*range(len(change)), 0]
            fabric.plot(*change[closed].T, markersize=3, **(look | {"linewidth": 1.0}))
        for index, probes in enumerate(element):
            scale = element[0].size / probes.size
            matrix, error = probes.linear
            label = f"{probes.title}: {100 * error:.1f} %"
            style = line_style(index) | {"marker": MARKERS[index % 6]}
            stress_panel(sand, style, np.full(1, element[0].size), scale * probes.stress, matrix, label)
        stress.set(
            xlabel=r"$10^4\,\Delta\sigma_{xx}/k_n$", ylabel=r"$10^4\,\Delta\sigma_{yy}/k_n$", title="DEM, stress"
        )
        sand.set(
            xlabel=r"$\Delta\sigma_{xx}$ [kPa]", ylabel=r"$\Delta\sigma_{yy}$ [kPa]", title="element tests, stress"
        )
        fabric.set(xlabel=r"$\Delta F_{xx}$", ylabel=r"$\Delta F_{yy}$", title="DEM, fabric")
        for axes in (stress, sand, fabric):
            axes.set_aspect("equal", adjustable="datalim")
        stress.legend(fontsize=5.5, loc="center", labelspacing=0.2, handletextpad=0.2)
        sand.legend(fontsize=6, title="off the ellipse", title_fontsize=6, loc="lower right")
        low, high = sand.get_ylim()
        extent = 1.3 * (high - low)  # room for the legend below
        sand.set_aspect("equal", adjustable="box")
        sand.set(xlim=(-extent / 2, extent / 2), ylim=(high - extent, high))


def rates(fans: list[Fan], path: Path) -> None:
    """Figures 5 and 6: rates of change over the direction of the probe, with the fitted law."""
    fine = np.linspace(0, 360, 181)
    with draw.panels(path, 3, rows=2, size=(85, 65)) as axes:
        for column, mechanism in enumerate(MECHANISMS):
            for row, which in enumerate(("dZ", "dA")):
                panel = axes[3 * row + column]
                if (mechanism, which) == ("reorientation", "dZ"):
                    panel.set_axis_off()  # zero by definition
                    continue
                for fan, look, label in zip(fans, looks(fans), names(fans), strict=True):
                    points = look | {"linestyle": "", "markersize": 3}
                    panel.plot(fan.alpha, fan.rate(mechanism, which), label=label, **points)
                    panel.plot(fine, fan.law(mechanism, which, fine), **(look | {"linewidth": 1.0, "marker": ""}))
                name = {"dZ": r"$\Delta Z^*$", "dA": r"$\Delta A^*$"}[which]
                panel.set(xlim=(0, 360), xticks=range(0, 361, 90), title=f"{name}, {mechanism}")
                if column == 0:
                    panel.set_ylabel("rate, per unit strain")
                if row == 1:
                    panel.set_xlabel(r"direction $\alpha$ [deg]")
                low, high = {"gain": (18.4, 71.6), "loss": (198.4, 251.6)}.get(mechanism, (0, 0))
                panel.axvspan(low, high, color="0.9")
        axes[2].legend(*axes[0].get_legend_handles_labels(), loc="center")


def pooled_rose(fans: list[Fan], angle: float, mechanism: str) -> tuple[Array, complex]:
    """Counts per bin of all samples together for one direction of the probe, and a exp(2 i direction) of their law."""
    changes = [fan.changes[int(np.argmin(np.abs(fan.alpha - angle)))] for fan in fans]
    roses = [change.lost_rose if mechanism == "loss" else change.gained_rose for change in changes]
    count = np.sum([rose.count for rose in roses], axis=0).astype(float)
    total = int(count.sum())
    turned = [
        rose.count.sum() * rose.anisotropy * np.exp(2j * math.radians(rose.direction))
        for rose in roses
        if rose.count.any()
    ]
    return count, complex(sum(turned) / total) if total else 0j


def roses(fans: list[Fan], path: Path) -> None:
    """Figure 4: orientations of lost and gained contacts for five directions, with second-order harmonics (Eq. 5)."""
    shown = [45, 90, 135, 180, 225]
    with rc_context(STYLE):
        figure = Figure(figsize=(55 * len(shown) / INCH, 110 / INCH), layout="constrained")
        for column, angle in enumerate(shown):
            for row, mechanism in enumerate(("loss", "gain")):
                axes = figure.add_subplot(2, len(shown), row * len(shown) + column + 1, projection="polar")
                count, harmonic = pooled_rose(fans, angle, mechanism)
                bins = count.reshape(-1, 2).sum(axis=1)  # of 15 degrees: contacts are few
                width = math.pi / len(bins)
                middle = (np.arange(len(bins)) + 0.5) * width
                for turn in (0.0, math.pi):
                    axes.bar(middle + turn, bins, width=width, color="#7FBFE8", edgecolor="#00508C", linewidth=0.4)
                theta = np.linspace(0, 2 * np.pi, 181)
                if count.sum() > 0:
                    law = 1 + np.real(harmonic * np.exp(-2j * theta))
                    axes.plot(theta, np.maximum(0, bins.mean() * law), color="#D55E00", linewidth=1.2)
                axes.set_title(rf"{mechanism}, $\alpha$ = {angle}$^\circ$: {count.sum():.0f}", fontsize=8)
                axes.set(xticklabels=[], ylim=(0, max(1.0, 1.1 * bins.max())))
                axes.yaxis.set_major_locator(MaxNLocator(3, integer=True))
                axes.tick_params(labelsize=6)
        figure.savefig(path, dpi=110)


def _trend(axes: Axes, fans: list[Fan], values: list[tuple[float, float]], index: int, label: str) -> None:
    """One coefficient over Z: samples of the first seed with full markers and a line, others with open ones."""
    for first in (True, False):
        at = [i for i, fan in enumerate(fans) if (fan.seed == 1) == first]
        style = {key: line_style(index)[key] for key in ("color", "linestyle")}
        style |= {} if first else {"linestyle": "", "fillstyle": "none"}
        axes.errorbar(
            [fans[i].coordination for i in at],
            [values[i][0] for i in at],
            [values[i][1] for i in at],
            marker=MARKERS[index],
            markersize=5,
            capsize=2,
            label=label if first else None,
            **style,
        )


def trends(fans: list[Fan], path: Path) -> None:
    """Figures 7 and 8: characteristic rates and a1 to a5 over Z, with standard errors."""
    with draw.panels(path, 3) as (loss, gain, total):
        for axes, mechanism in ((loss, "loss"), (gain, "gain")):
            for index, name in enumerate(("dZ_extension", "dZ_shear", "dZ_compression", "E", "G")):
                values = [fan.coefficient(mechanism, name) for fan in fans]
                _trend(axes, fans, values, index, name.replace("dZ_", "dZ*, "))
            axes.set_title(mechanism)
        for index in range(5):
            entries = [fan.response.a[index] for fan in fans]
            _trend(total, fans, [(entry.value, entry.error) for entry in entries], index, f"a{index + 1}")
        total.set_title("total, Eq. 19")
        loss.set_ylabel("coefficients, per unit strain")
        for axes in (loss, gain, total):
            axes.set_xlabel("Z before the probes")
            low, high = axes.get_ylim()
            axes.set_ylim(low, high + 0.3 * (high - low))  # room for the legend
            axes.legend(fontsize=7, loc="upper left", ncols=2)
