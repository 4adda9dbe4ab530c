"""Beyond the papers: does delta from fabric predict directional stiffness over samples of different anisotropy?

Runs: samples `<lateral>_<seed>` of prepare.py, where lateral is `iso` or the ratio of lateral to vertical strain rate,
and `<lateral>_<seed>_x` and `_y` of load.py: each sample loaded along x and along y.
"""

import re
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

import hypofab
from hypofab.figures import line_style
from hypofab.results import Array, ResultError
from papers import draw
from papers.element import SMALL, Loading, element_tests, fit_c, secants
from papers.runs import DemRun, read_curve, read_dem


@dataclass(frozen=True)
class Member:
    """One sample of the family."""

    group: str
    seed: str
    sample: DemRun
    measured: dict[str, float]
    """Secant stiffness along x and y [kPa]."""

    @property
    def loadings(self) -> list[Loading]:
        """Its element tests."""
        return [Loading(f"{self.sample.name}_{axis}", self.sample, axis) for axis in "xy"]

    @cached_property
    def vertical(self) -> float:
        """1.5 F_yy of the contacts: a with a sign, where the fabric is symmetric about y."""
        return 1.5 * float(hypofab.fabric_of_file(self.sample.contacts).deviatoric_fabric[1])


def read_members(runs: Path) -> list[Member]:
    """All samples with both loadings."""
    members = []
    for folder in sorted(runs.glob("*_*/")):
        name = re.fullmatch(r"(iso|-?[0-9.]+)_([0-9]+)", folder.name)
        if name and all((runs / f"{folder.name}_{axis}" / "manifest.json").exists() for axis in "xy"):
            measured = {axis: read_curve(runs / f"{folder.name}_{axis}").secant(SMALL) for axis in "xy"}
            members.append(Member(name[1], name[2], read_dem(folder), measured))
    if not any(member.group == "iso" for member in members) or len(members) < 2:
        raise ResultError(f"{runs}: no family of samples; examples/dem/README.md says how to make one")
    return members


def relative(members: list[Member], stiffness: dict[str, float]) -> dict[str, Array]:
    """Stiffness along y and x of each member over the mean of all isotropic samples, shape (members, 2)."""
    table = np.array([[stiffness[f"{m.sample.name}_{axis}"] for axis in "yx"] for m in members])
    reference = table[[m.group == "iso" for m in members]].mean()
    return table / reference


def compare(runs: Path, out: Path) -> str:
    """One figure and one table."""
    members = read_members(runs)
    loadings = [loading for member in members for loading in member.loadings]
    measured = {f"{m.sample.name}_{axis}": m.measured[axis] for m in members for axis in "xy"}
    fit = fit_c(loadings, measured)
    model = {c: secants(element_tests(loadings, c)) for c in (0.05, fit.c)}
    dem = relative(members, measured)
    computed = {c: relative(members, stiffness) for c, stiffness in model.items()}
    groups = list(dict.fromkeys(m.group for m in members))
    of = {group: [i for i, m in enumerate(members) if m.group == group] for group in groups}
    groups.sort(key=lambda group: np.mean([members[i].vertical for i in of[group]]))

    def spread(values: Array) -> tuple[float, float]:
        return float(values.mean()), float(values.std(ddof=1)) if len(values) > 1 else float("nan")

    rows = []
    with draw.panels(out / "family_stiffness.png", 3, size=(95, 85)) as (over_a, fixed, fitted):
        for index, group in enumerate(groups):
            at = of[group]
            a = spread(np.array([members[i].vertical for i in at]))
            ratio = {key: spread(values[at, 0] / values[at, 1]) for key, values in {"DEM": dem, **computed}.items()}
            rows.append(
                [
                    group,
                    str(len(at)),
                    f"{np.mean([members[i].sample.results['void_ratio'] for i in at]):.3f}",
                    *(f"{mean:.3f} +- {deviation:.3f}" for mean, deviation in (a, *ratio.values())),
                    *("{:.3f} +- {:.3f}".format(*spread(dem[at, axis])) for axis in (0, 1)),
                    *("{:.3f} +- {:.3f}".format(*spread(computed[fit.c][at, axis])) for axis in (0, 1)),
                ]
            )
            for key, style, shift in (("DEM", "o", 0), (0.05, "^", 0.0015), (fit.c, "s", -0.0015)):
                color = {"DEM": "#000000", 0.05: "#D55E00"}.get(key, "#00508C")
                label = (
                    {"DEM": "DEM", 0.05: "element, c = 0.05"}.get(key, f"element, c = {fit.c:.3g}")
                    if index == 0
                    else None
                )
                mean, deviation = ratio[key]
                over_a.errorbar(
                    a[0] + shift, mean, deviation, a[1], fmt=style, color=color, capsize=2, label=label, markersize=4
                )
            color = line_style(index)["color"]
            for axes, c in ((fixed, 0.05), (fitted, fit.c)):
                for axis, marker in ((0, "^"), (1, ">")):
                    x, y = spread(computed[c][at, axis]), spread(dem[at, axis])
                    label = f"lateral {group}" if axis == 0 else None
                    axes.errorbar(x[0], y[0], y[1], x[1], fmt=marker, color=color, capsize=2, markersize=5, label=label)
        over_a.set(
            xlabel=r"$1.5 F_{yy}$ of the samples", ylabel="stiffness along y over along x", title="ratio A-0 : A-90"
        )
        over_a.axhline(1, color="0.6", linewidth=0.8)
        over_a.legend()
        for axes, title in ((fixed, "c = 0.05"), (fitted, f"c = {fit.c:.3g}, fitted")):
            low, high = axes.get_xlim()[0], axes.get_xlim()[1]
            low, high = min(low, axes.get_ylim()[0]), max(high, axes.get_ylim()[1])
            axes.plot([low, high], [low, high], color="0.6", linewidth=0.8)
            axes.set(xlabel="element test, over I", ylabel="DEM, over I", title=title)
        for marker, axis in (("^", "along y"), (">", "along x")):
            fixed.plot([], [], marker, color="0.6", markersize=5, label=axis)
        fixed.legend(fontsize=7)
    free = fit_c(loadings, measured, corrected=True)
    without_noise = relative(members, secants(element_tests(loadings, free.c, corrected=True)))
    error = {c: float(np.sqrt(np.mean((np.log(values) - np.log(dem)) ** 2))) for c, values in computed.items()}
    ratios = {key: np.log(values[:, 0] / values[:, 1]) for key, values in {"DEM": dem, **computed}.items()}
    correlation = {c: float(np.corrcoef(ratios["DEM"], ratios[c])[0, 1]) for c in computed}
    vertical = float(np.corrcoef(ratios["DEM"], [member.vertical for member in members])[0, 1])
    null = float(np.sqrt(np.mean(np.log(dem) ** 2)))
    head = ["lateral", "seeds", "e", "1.5 F_yy", "y : x, DEM", "y : x, c = 0.05", f"y : x, c = {fit.c:.3g}"]
    head += ["y : I, DEM", "x : I, DEM", "y : I, fitted", "x : I, fitted"]
    return "\n\n".join(
        [
            f"c = {fit.c:.3g} ({fit.lower:.3g} to {fit.upper:.3g}). Root-mean-square error of the logarithms of"
            f" stiffness over that of the isotropic samples: {error[fit.c]:.3f} fitted, {error[0.05]:.3f} at c = 0.05,"
            f" {null:.3f} if all were 1.",
            f"With fabrics without noise: c = {free.c:.3g} ({free.lower:.3g} to {free.upper:.3g}), error"
            f" {float(np.sqrt(np.mean((np.log(without_noise) - np.log(dem)) ** 2))):.3f}, correlation of y : x"
            f" {np.corrcoef(ratios['DEM'], np.log(without_noise[:, 0] / without_noise[:, 1]))[0, 1]:.2f}.",
            f"Correlation of the logarithms of y : x in DEM with those of element tests: {correlation[fit.c]:.2f}"
            f" fitted, {correlation[0.05]:.2f} at c = 0.05; with 1.5 F_yy: {vertical:.2f}.",
            draw.table(head, rows),
        ]
    )
