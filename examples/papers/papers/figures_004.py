"""Figures of paper 004: failure states and plastic flow in the deviatoric plane, DEM beside element tests."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from hypofab.figures import line_style
from hypofab.results import Array
from papers import draw
from papers.flow import amount_of, cross_section, octahedral

if TYPE_CHECKING:
    from papers.paper_004 import ElementProbes, Failure

ORDERS = ([0, 1, 2], [2, 1, 0], [1, 2, 0], [1, 0, 2], [2, 0, 1], [0, 2, 1])
"""Permutations of the axes: an isotropic sample answers all alike."""


def _radial(states: dict[str, Failure]) -> dict[str, Failure]:
    """The states without a tangent path."""
    return {name: state for name, state in states.items() if not state.tangent}


def _envelopes(axes: Axes, probes: dict[str, Failure] | dict[str, ElementProbes], names: list[str]) -> None:
    """Failure points of all permutations, joined, and response envelopes scaled to one length."""
    points = []
    for order in reversed(ORDERS):
        for index, name in enumerate(names):
            state = probes[name]
            place = np.array(octahedral(-state.stress[order]))
            points.append(place)
            color = line_style(index)["color"] if order == ORDERS[0] else "0.65"
            steps = np.array(octahedral(-state.plastic[:, order])).T
            steps *= 0.35 * np.linalg.norm(place) / np.max(np.linalg.norm(steps, axis=1))
            for step in steps:
                axes.plot(*np.stack([place, place + step]).T, color=color, linewidth=0.6)
            label = rf"$\theta$ = {paper_lode(name)}$^\circ$" if order == ORDERS[0] else None
            axes.plot(*place, "os^D"[index % 4] if label else "o", color=color, markersize=4, label=label)
    corners = np.array(sorted(points, key=lambda point: np.arctan2(*point)))
    axes.plot(*np.vstack([corners, corners[:1]]).T, color="0.4", linewidth=0.8, zorder=1)
    axes.plot(0, 0, "+", color="black")
    axes.set_aspect("equal", adjustable="datalim")
    axes.set(xlabel="kPa", ylabel=r"kPa ($\sigma_y$ upwards)")


def paper_lode(name: str) -> str:
    """The Lode angle in the name of a radial run."""
    return name.removeprefix("lode")


def envelopes(states: dict[str, Failure], element: dict[str, ElementProbes], path: Path) -> None:
    """Figure 1: failure surface and response envelopes; and how much flows in which direction of the increment."""
    names = list(_radial(states))
    with draw.panels(path, 4, size=(85, 85)) as (dem, sand, dem_amount, sand_amount):
        _envelopes(dem, states, names)
        _envelopes(sand, element, names)
        dem.set_title("DEM: failure and plastic strain")
        sand.set_title("element tests: 97 % of the peak")
        dem.legend(fontsize=7, loc="upper right")
        for index, name in enumerate(names):
            color = line_style(index)["color"]
            probes = element[name]
            pairs = (states[name].amount, amount_of(probes.increments, probes.plastic, probes.flow))
            for axes, (cosine, amount) in zip((dem_amount, sand_amount), pairs, strict=True):
                axes.plot(cosine, amount / amount.max(), "os^D"[index % 4], markersize=3, color=color, fillstyle="none")
        for axes, title in ((dem_amount, "DEM"), (sand_amount, "element tests")):
            axes.set(
                title=title,
                xlabel="cosine of increment and flow direction",
                ylabel="plastic strain along it, over the largest",
            )


def principal(states: dict[str, Failure], element: dict[str, ElementProbes], path: Path) -> None:
    """Figure 2: principal values of stress, fabric and flow at each Lode angle."""
    radial = _radial(states)
    with draw.panels(path, len(radial), size=(70, 70)) as panels:
        for axes, (name, state) in zip(panels, radial.items(), strict=True):
            bars = {
                "flow, DEM": -state.flow.direction,
                "flow, element": -element[name].flow.direction,
                "stress/tr - 1/3": state.stress / state.stress.sum() - 1 / 3,
                "5 (N - 1/3)": 5 * (state.fabric() - 1 / 3),
                "5 (sliding N - 1/3)": 5 * (state.fabric(sliding=True) - 1 / 3),
            }
            hatches = ("", "//", "", "..", "xx")
            colors = ("#000000", "#D55E00", "#7FBFE8", "#FFFFFF", "#FFFFFF")
            for index, (label, values) in enumerate(bars.items()):
                axes.bar(
                    np.arange(3) + 0.16 * (index - 2),
                    values,
                    width=0.15,
                    label=label,
                    color=colors[index],
                    edgecolor="black",
                    linewidth=0.5,
                    hatch=hatches[index],
                )
            axes.axhline(0, color="black", linewidth=0.8)
            axes.set(xticks=range(3), xticklabels=["x (least)", "y (most)", "z"], ylim=(-1, 1.4))
            axes.set_title(rf"$\theta$ = {state.lode:.0f}$^\circ$")
        panels[0].set_ylabel("compression positive")
        panels[0].legend(fontsize=7, loc="upper left", ncols=2, columnspacing=0.8)


def ellipsoids(states: dict[str, Failure], path: Path) -> None:
    """Figure 3: the fabric of all contacts."""
    tensors = {
        rf"$\theta$ = {state.lode:.0f}$^\circ$": 7.5 * np.diag(state.fabric() - 1 / 3)
        for state in _radial(states).values()
    }
    draw.fabric_surfaces(path, tensors, size=70, limit=1.6)


def _lines(axes: Axes, plastic: Array, color: str, width: float, label: str) -> None:
    """Plastic strains as lines from the origin in the deviatoric plane, the longest of length 1."""
    steps = np.array(octahedral(-plastic)).T
    steps = steps / np.max(np.linalg.norm(steps, axis=1))
    for index, step in enumerate(steps):
        axes.plot([0, step[0]], [0, step[1]], color=color, linewidth=width, label=label if index == 0 else None)


def tangents(states: dict[str, Failure], element: dict[str, ElementProbes], path: Path) -> None:
    """Figure 4: response envelopes at A-, A, A+ (top), sliding contacts in the deviatoric plane (bottom)."""
    names = {"A_minus": "A-", "lode0": "A", "A_plus": "A+"}
    if "tangent20" in states:
        names |= {"lode20": r"$\theta$ = 20$^\circ$, radial", "tangent20": r"$\theta$ = 20$^\circ$, tangent"}
    turn = np.linspace(0, 2 * np.pi, 73)
    with draw.panels(path, len(names), rows=2, size=(62, 62)) as panels:
        for column, (name, title) in enumerate(names.items()):
            above, below = panels[column], panels[len(names) + column]
            _lines(above, element[name].plastic, "#D55E00", 1.6, "element test")
            _lines(above, states[name].plastic, "#000000", 0.7, "DEM")
            above.set(title=title, xlim=(-0.7, 0.9), ylim=(-0.4, 1.2), yticks=(0, 0.5, 1))
            for sliding, style in ((False, {"color": "0.6"}), (True, {"color": "#00508C", "linestyle": "--"})):
                radius = cross_section(states[name].fabric(sliding))
                label = "sliding contacts" if sliding else "all contacts"
                below.plot(radius * np.sin(turn), radius * np.cos(turn), label=label, **style)
            below.set(xlim=(-2, 2), ylim=(-2, 2))
            for axes in (above, below):
                axes.set_aspect("equal")
        panels[0].set_ylabel("plastic strain")
        panels[len(names)].set_ylabel("density of contacts")
        panels[0].legend(fontsize=7, loc="lower left")
        panels[len(names)].legend(fontsize=7, loc="lower left")
