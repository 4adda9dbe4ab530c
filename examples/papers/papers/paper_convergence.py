"""Beyond the papers: how the directional stiffness of DEM samples depends on their size and on the rate of loading.

Runs: samples `<recipe>_<particles>_<seed>` of prepare.py, compressed without lateral strain, where recipe is `dense` or
`loose`; with `_x` and `_y` behind: load.py; with `_x_<rate>`, too: the same at another inertial number at small strain.
"""

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes

from hypofab.figures import line_style
from hypofab.results import Array, ResultError
from papers import draw
from papers.element import SMALL, Loading, element_tests, secants
from papers.runs import DemRun, read_curve, read_dem

SMALLER = 3e-4
"""Deviatoric strain of a second secant stiffness, nearer to the beginning."""


@dataclass(frozen=True)
class Pair:
    """One sample loaded along y and along x at one rate."""

    recipe: str
    particles: int
    seed: int
    rate: float
    """Inertial number at small strain."""
    sample: DemRun
    stiffness: dict[str, Array]
    """Secant stiffness along x and y at SMALL and at SMALLER [kPa]."""

    @property
    def ratio(self) -> Array:
        """Stiffness along y over that along x (A-0 : A-90) at SMALL and SMALLER."""
        return self.stiffness["y"] / self.stiffness["x"]


def read_pairs(runs: Path) -> list[Pair]:
    """All samples and rates with both loadings."""
    pairs = []
    for folder in sorted(runs.glob("*_*_*_y*/")):
        name = re.fullmatch(r"((dense|loose)_([0-9]+)_([0-9]+))_y(_[0-9.e-]+)?", folder.name)
        partner = runs / folder.name.replace("_y", "_x", 1)
        if not name or not (partner / "manifest.json").exists():
            continue
        stiffness = {
            axis: np.array([read_curve(path).secant(strain) for strain in (SMALL, SMALLER)])
            for axis, path in (("y", folder), ("x", partner))
        }
        rate = float(read_dem(folder).parameters["slow"])
        pairs.append(Pair(name[2], int(name[3]), int(name[4]), rate, read_dem(runs / name[1]), stiffness))
    if not pairs:
        raise ResultError(f"{runs}: no samples of different size; examples/dem/README.md says how to make them")
    return pairs


def usual_rate(pairs: list[Pair]) -> float:
    """The rate at which most samples were loaded."""
    rates = [pair.rate for pair in pairs]
    return max(set(rates), key=rates.count)


def spread(values: Array, digits: int = 2) -> str:
    """Mean, with the standard deviation where there are several."""
    text = f"{np.mean(values):.{digits}f}"
    return text + (f" +- {np.std(values, ddof=1):.{digits}f}" if len(values) > 1 else "")


def size_table(pairs: list[Pair], element: dict[str, float]) -> str:
    """One row per recipe and number of particles at the usual rate."""
    rows = []
    rate = usual_rate(pairs)
    for recipe, particles in sorted({(p.recipe, p.particles) for p in pairs}):
        group = [p for p in pairs if (p.recipe, p.particles, p.rate) == (recipe, particles, rate)]
        results = [p.sample.results for p in group]
        model = [element[f"{p.sample.name}_y"] / element[f"{p.sample.name}_x"] for p in group]
        rows.append(
            [
                recipe,
                str(particles),
                str(len(group)),
                spread([r["void_ratio"] for r in results], 3),
                spread([r["coordination_number"] for r in results]),
                spread([r["anisotropy"] for r in results], 3),
                f"{np.mean([r['anisotropy_noise'] for r in results]):.3f}",
                *(spread(np.array([p.stiffness[axis][0] for p in group]) / 1e3, 1) for axis in "yx"),
                spread(np.array([p.ratio[0] for p in group])),
                spread(np.array([p.ratio[1] for p in group])),
                spread(np.array(model)),
            ]
        )
    head = ["recipe", "spheres", "seeds", "e", "2 N_c/N_p", "a", "a of noise", "A-0 [MPa]", "A-90 [MPa]"]
    head += ["A-0 : A-90", "at eps_q = 0.03 %", "element test, c = 0.05"]
    return draw.table(head, rows)


def rate_table(pairs: list[Pair]) -> str:
    """One row per recipe and rate of the sample that was loaded at several."""
    rows = []
    for pair in sorted(pairs, key=lambda p: (p.recipe, p.rate)):
        same = [p for p in pairs if p.sample.name == pair.sample.name]
        if len(same) < 2:
            continue
        y, x = (pair.stiffness[axis][0] / 1e3 for axis in "yx")
        cells = [f"{y:.1f}", f"{x:.1f}", f"{pair.ratio[0]:.2f}", f"{pair.ratio[1]:.2f}"]
        rows.append([pair.recipe, str(pair.particles), f"{pair.rate:.1e}", *cells])
    head = ["recipe", "spheres", "inertial number", "A-0 [MPa]", "A-90 [MPa]", "A-0 : A-90", "at eps_q = 0.03 %"]
    return draw.table(head, rows)


def _points(axes: Axes, pairs: list[Pair], x_of: str, recipe: str, index: int) -> None:
    """The ratio over size or rate: each sample a point, a line through the means."""
    style = line_style(index)
    values = sorted({getattr(p, x_of) for p in pairs})
    means = [np.mean([p.ratio[0] for p in pairs if getattr(p, x_of) == value]) for value in values]
    axes.plot(values, means, label=recipe, **style)
    axes.plot(
        [getattr(p, x_of) for p in pairs],
        [p.ratio[0] for p in pairs],
        "os"[index],
        color=style["color"],
        fillstyle="none",
        markersize=5,
    )


def compare(runs: Path, out: Path) -> str:
    """Two tables and one figure."""
    pairs = read_pairs(runs)
    rate = usual_rate(pairs)
    usual = [pair for pair in pairs if pair.rate == rate]
    loadings = [Loading(f"{p.sample.name}_{axis}", p.sample, axis) for p in usual for axis in "xy"]
    element = secants(element_tests(loadings, 0.05))
    with draw.panels(out / "convergence.png", 3, size=(85, 75)) as (size, over_rate, anisotropy):
        for index, recipe in enumerate(sorted({pair.recipe for pair in pairs})):
            same = [pair for pair in usual if pair.recipe == recipe]
            _points(size, same, "particles", recipe, index)
            several = [p for p in pairs if p.recipe == recipe and sum(q.sample == p.sample for q in pairs) > 1]
            _points(over_rate, several, "rate", recipe, index)
            color = line_style(index)["color"]
            for pair in same:
                a, noise = pair.sample.results["anisotropy"], pair.sample.results["anisotropy_noise"]
                anisotropy.plot(pair.particles, a, "os"[index], color=color, fillstyle="none", markersize=5)
                anisotropy.plot(pair.particles, noise, "_", color="0.4")
        for axes in (size, over_rate):
            axes.axhline(1, color="0.6", linewidth=0.8)
            axes.set(xscale="log", ylabel="A-0 : A-90", ylim=(0, None))
        size.set(xlabel="spheres", title=f"inertial number {rate:.1e}")
        over_rate.set(xlabel="inertial number at small strain", title="one sample of 2,000 spheres")
        anisotropy.set(xscale="log", xlabel="spheres", ylabel="a (bars: of noise)", ylim=(0, None))
        anisotropy.set_title("anisotropy of the samples")
        sizes, rates = sorted({pair.particles for pair in pairs}), sorted({pair.rate for pair in pairs})
        for axes, ticks in ((size, sizes), (anisotropy, sizes), (over_rate, rates)):
            axes.set_xticks([], minor=True)
            axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
        size.legend()
    return size_table(pairs, element) + "\n\n" + rate_table(pairs)
