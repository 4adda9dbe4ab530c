"""Figures of paper 003: biaxial tests of samples made in three ways. Colour and line tell how a sample was made."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure

from hypofab.figures import INCH, STYLE, line_style
from hypofab.results import Array
from papers import draw
from papers.runs import read_table

if TYPE_CHECKING:
    from papers.paper_003 import Test

Groups = dict[str, dict[str, "Test"]]

LOW_PRESSURE = 300.0
"""Tests that begin at a lower p' have open symbols where two groups share a panel [kPa]."""

MARKERS = {"deposition": "o", "layers": "s", "isotropic": "^"}


NAME_RIGHT = {"xytext": (4, 3), "textcoords": "offset points"}
NAME_LEFT = {"xytext": (-4, 3), "textcoords": "offset points", "horizontalalignment": "right"}
NAME_BESIDE = {"xytext": (5, -2), "textcoords": "offset points"}
NAME_BELOW = {"xytext": (4, -8), "textcoords": "offset points"}
NAME_PLACE = {"M07": NAME_LEFT, "M09": NAME_LEFT, "D04": NAME_LEFT, "I14": NAME_BESIDE, "I11": NAME_BELOW}
"""Where names stand so that they do not cover each other in the figure of the peaks."""


def style_of(test: Test) -> dict:
    """Line of a test: by the way its sample was made."""
    return line_style((0, 1, 3)[list(MARKERS).index(test.method)])


def point_of(test: Test) -> dict:
    """Marker of a test."""
    return {"marker": MARKERS[test.method], "color": style_of(test)["color"], "linestyle": "", "markersize": 5}


def macroscopic(groups: Groups, path: Path) -> None:
    """Figures 6 and 7: q, volumetric strain, q/p and dilatancy of both groups, one per row."""
    with draw.panels(path, 4, rows=len(groups), size=(70, 62)) as panels:
        for row, (title, group) in enumerate(groups.items()):
            q, volume, ratio, dilatancy = panels[4 * row : 4 * row + 4]
            for name, test in group.items():
                style = style_of(test)
                strain = 100 * test.curve.axial
                q.plot(strain, test.curve.q, label=f"{name}, {test.method}", **(style | {"linewidth": 1.0}))
                volume.plot(strain, 100 * test.curve.eps_v, **style)
                middle, mean, rate = test.every(0.005)
                ratio.plot(100 * middle, mean, **style)
                dilatancy.plot(100 * middle, rate, **style)
            q.set(ylabel="q [kPa]", title=title, ylim=(0, None))
            q.legend(fontsize=7)
            volume.set(ylabel="volumetric strain [%]")
            ratio.set(ylabel="q/p'", ylim=(0, None))
            dilatancy.set(ylabel=r"dilatancy $d\varepsilon_v/d\varepsilon_a$")
            dilatancy.axhline(0, color="0.5", linewidth=0.8)
            for axes in (q, volume, ratio, dilatancy):
                axes.set_xlabel("axial strain [%]")


def peaks(tests: dict[str, Test], path: Path) -> None:
    """Figures 8 and 9: peaks over a_n; stress ratio over dilatancy with Rowe's line."""
    with draw.panels(path, 3, size=(85, 78)) as (ratio, dilatancy, rowe):
        seen: set[str] = set()
        for name, test in tests.items():
            a_n = test.sample.results["anisotropy"]
            label = None if test.method in seen else test.method
            seen.add(test.method)
            for axes, value in zip((ratio, dilatancy), test.peak(), strict=True):
                axes.plot(a_n, value, label=label, **point_of(test))
                axes.annotate(name, (a_n, value), fontsize=6, **NAME_PLACE.get(name, NAME_RIGHT))
            middle, mean, rate = test.every(0.01)
            at = [int(np.argmin(np.abs(middle - strain))) for strain in (0.005, 0.025, 0.05, 0.075, 0.1, 0.125, 0.145)]
            rowe.plot(rate[at], mean[at], fillstyle="none", **(point_of(test) | {"markersize": 4}))
        phi = np.arcsin(np.mean([test.critical for test in tests.values()]) / 2)
        rates = np.linspace(-0.5, 0.9, 50)
        major = (1 + rates) * np.tan(np.pi / 4 + phi / 2) ** 2
        rowe.plot(
            rates, 2 * (major - 1) / (major + 1), color="0.4", linewidth=1, label=f"Rowe, {np.degrees(phi):.1f} deg"
        )
        ratio.set(xlabel="$a_n$ of the sample", ylabel="peak q/p'")
        dilatancy.set(xlabel="$a_n$ of the sample", ylabel="peak dilatancy")
        rowe.set(xlabel=r"dilatancy $d\varepsilon_v/d\varepsilon_a$", ylabel="q/p'")
        ratio.legend(fontsize=7, loc="upper right")
        rowe.legend()


def microscopic(groups: Groups, path: Path) -> None:
    """Figures 10, 12, 18: anisotropies, coordination number and sliding contacts of both groups, one per row."""
    panels = {
        "a_n": "$a_n$",
        "a_f": "$a_f$",
        "mechanical_coordination_number": "mechanical CN",
        "sliding_ratio": "share of sliding contacts",
    }
    with draw.panels(path, 4, rows=len(groups), size=(70, 62)) as axes:
        for row, (title, group) in enumerate(groups.items()):
            for column, (key, label) in enumerate(panels.items()):
                panel = axes[4 * row + column]
                for name, test in group.items():
                    style = style_of(test) | {"marker": MARKERS[test.method], "markersize": 4}
                    panel.plot(100 * test.strain, test.micro[key], label=f"{name}, {test.method}", **style)
                bottom = 3 if key == "mechanical_coordination_number" else 0
                top = max(float(np.max(test.micro[key])) for test in group.values())
                panel.set(xlabel="axial strain [%]", ylabel=label, ylim=(bottom, top + 0.05 * (top - bottom)))
            axes[4 * row].set_title(title)
            axes[4 * row].legend(fontsize=7)


def shares(one: Test, tests: dict[str, Test], path: Path) -> None:
    """Figures 13 to 15: sin(phi) and anisotropies of one test, and the weights of the anisotropies in all of them."""
    with draw.panels(path, 3, rows=2, size=(85, 65)) as (friction, indices, all_sin, *weights):
        strain = 100 * one.strain
        friction.plot(
            100 * one.curve.axial, one.curve.q / one.p / 2, color="0.6", linewidth=0.9, label="stress of the walls"
        )
        eq9 = (one.micro["a_n"] + one.micro["a_f"] + one.micro["a_t"]) / 2
        friction.plot(strain, one.micro["sin_phi"], "k+", markersize=7, label="stress of the contacts")
        friction.plot(strain, one.micro["sin_phi_from_anisotropies"], "o", color="#D55E00", label="Eq. 8")
        friction.plot(strain, eq9, "^", color="#00508C", fillstyle="none", label="Eq. 9")
        friction.set(title=f"{one.sample.name}: sin(phi)", ylim=(0, None), xlabel="axial strain [%]")
        friction.legend(fontsize=7)
        for index, key in enumerate(("a_n", "a_f", "a_t")):
            indices.plot(strain, one.micro[key], label=f"${key}$", marker="o", markersize=3, **line_style(index))
        indices.set(title=f"{one.sample.name}: anisotropies", xlabel="axial strain [%]", ylim=(0, 0.8))
        indices.legend(loc="upper right", ncols=3)
        for test in tests.values():
            loaded = test.strain > 1e-3
            all_sin.plot(
                test.micro["sin_phi"][loaded], test.micro["sin_phi_from_anisotropies"][loaded], **point_of(test)
            )
            eq9 = (test.micro["a_n"] + test.micro["a_f"] + test.micro["a_t"]) / 2
            for axes, key in zip(weights, ("a_n", "a_f", "a_t"), strict=True):
                style = style_of(test) | {"marker": MARKERS[test.method], "markersize": 4, "linewidth": 1.0}
                style["fillstyle"] = "full" if test.p[0] > LOW_PRESSURE else "none"
                label = f"{test.sample.name}, {test.method}" if key == "a_n" else None
                axes.plot(100 * test.strain[loaded], test.micro[key][loaded] / (2 * eq9[loaded]), label=label, **style)
                axes.set(xlabel="axial strain [%]", title=f"weight of ${key}$", ylim=(0, 0.8))
        low, high = 0.0, 0.7
        all_sin.plot([low, high], [low, high], color="0.6", linewidth=0.8)
        for method, marker in MARKERS.items():
            label_style = {"marker": marker, "color": line_style((0, 1, 3)[list(MARKERS).index(method)])["color"]}
            all_sin.plot([], [], linestyle="", label=method, **label_style)
        all_sin.legend(fontsize=7, loc="upper left")
        all_sin.set(xlabel="sin(phi) of contact forces", ylabel="sin(phi), Eq. 8", xlim=(low, high), ylim=(low, high))
        weights[0].legend(fontsize=6, ncols=2)


def roses(group: dict[str, Test], path: Path) -> None:
    """Figure 11: density of contact normals before and after the test, with 1 + a_n cos 2(phi - phi_n)."""
    with rc_context(STYLE):
        figure = Figure(figsize=(60 * len(group) / INCH, 120 / INCH), layout="constrained")
        for column, (name, test) in enumerate(group.items()):
            for row, index in enumerate((0, len(test.lists) - 1)):
                axes = figure.add_subplot(2, len(group), row * len(group) + column + 1, projection="polar")
                data = read_table(test.lists[index].parent, test.lists[index].name)
                angle = np.arctan2(data["ny"], data["nx"]) % np.pi
                count, edges = np.histogram(angle, bins=18, range=(0, np.pi))
                density = count / count.mean()
                middle = (edges[1:] + edges[:-1]) / 2
                for turn in (0.0, np.pi):
                    axes.bar(
                        middle + turn, density, width=np.pi / 18, color="#7FBFE8", edgecolor="#00508C", linewidth=0.4
                    )
                theta = np.linspace(0, 2 * np.pi, 181)
                a_n, phi_n = test.micro["a_n"][index], np.radians(test.micro["phi_n"][index])
                axes.plot(theta, 1 + a_n * np.cos(2 * (theta - phi_n)), color="#D55E00", linewidth=1.2)
                axes.set_title(f"{name}, {100 * test.strain[index]:.0f} %: $a_n$ = {a_n:.2f}", fontsize=8)
                axes.set(xticklabels=[], yticks=[1, 1.5], ylim=(0, 2.1))
                axes.tick_params(labelsize=6)
        figure.savefig(path, dpi=110)


def critical(tests: dict[str, Test], path: Path) -> None:
    """Figure 19: the ends of all tests in e - log p' and q - p', small grey points the beginnings."""
    with draw.panels(path, 2, size=(95, 80)) as (void_ratio, stress):
        seen: set[str] = set()
        p = np.array([test.late(test.p) for test in tests.values()])
        e = np.array([test.late(test.curve.void_ratio) for test in tests.values()])
        for test, p_end, e_end in zip(tests.values(), p, e, strict=True):
            label = None if test.method in seen else test.method
            seen.add(test.method)
            start = (test.p[0], test.curve.void_ratio[0])
            void_ratio.plot(*zip(start, (p_end, e_end), strict=True), color="0.75", linewidth=0.7)
            void_ratio.plot(*start, ".", color="0.6", markersize=4)
            void_ratio.plot(p_end, e_end, label=label, **point_of(test))
            stress.plot(p_end, test.late(test.curve.q), **point_of(test))
        line = np.array([0.9 * p.min(), 1.1 * p.max()])
        slope, intercept = np.polyfit(np.log10(p), e, 1)
        void_ratio.plot(line, slope * np.log10(line) + intercept, color="0.3", linewidth=1)
        ratio = np.mean([test.critical for test in tests.values()])
        stress.plot([0, line[1]], [0, ratio * line[1]], color="0.3", linewidth=1, label=f"q = {ratio:.2f} p'")
        void_ratio.set(xscale="log", xlabel="p' [kPa]", ylabel="void ratio (grey: at the beginning)")
        ticks = [100, 200, 500, 1000, 1500]
        void_ratio.set_xticks(ticks, [str(tick) for tick in ticks], minor=False)
        void_ratio.set_xticks([], minor=True)
        stress.set(xlabel="p' [kPa]", ylabel="q [kPa]", xlim=(0, None), ylim=(0, None))
        void_ratio.legend(fontsize=7)
        stress.legend()


def elements(groups: Groups, element: dict[str, tuple[Array, Array, Array]], path: Path) -> None:
    """DEM beside element tests: q/p' up to 0.3 % and to the end, volumetric strain; groups in rows."""
    with draw.panels(path, 4, rows=len(groups), size=(70, 62)) as panels:
        for row, (title, group) in enumerate(groups.items()):
            dem_small, small, large, volume = panels[4 * row : 4 * row + 4]
            for name, test in group.items():
                style = style_of(test)
                axial, ratio, eps_v = element[name]
                dem_small.plot(100 * test.curve.axial, test.curve.q / test.p, label=f"{name}, {test.method}", **style)
                small.plot(100 * axial, ratio, **style)
                large.plot(100 * axial, ratio, **style)
                volume.plot(100 * axial, 100 * eps_v, **style)
            dem_small.set(title=f"DEM, {title}", ylabel="q/p'", xlim=(0, 0.3), ylim=(0, 0.7))
            small.set(title="element test", ylabel="q/p'", xlim=(0, 0.3), ylim=(0, 1.0))
            large.set(title="element test", ylabel="q/p'", ylim=(0, None))
            volume.set(title="element test", ylabel="volumetric strain [%]")
            dem_small.legend(fontsize=7)
            for axes in (dem_small, small, large, volume):
                axes.set_xlabel("axial strain [%]")
