"""Figures of `hypofab changes --json`: rates over a probe's direction, roses of lost and gained contacts."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure

from hypofab.figures.fabric import BAR, FIT, limit_radius
from hypofab.figures.style import INCH, STYLE
from hypofab.results.fabric import MECHANISMS, Result
from hypofab.results.tables import ResultError
from hypofab.tensors import Array

SYMBOLS = {"dZ": r"$\Delta Z^*$", "dA": r"$\Delta A^*$"}
NAMES = {"loss": "contact loss", "gain": "contact gain", "reorientation": "reorientation"}


def law(response: Mapping[str, Any], mechanism: str, which: str, alpha: Array) -> Array:
    """The fitted rate at angles alpha [deg] (paper 001, Eq. 15, with the signs that Eqs. 10 and 11 demand)."""
    b, c, d, e, g = (response[mechanism][name]["value"] for name in "BCDEG")
    cos, sin = np.cos(np.radians(alpha)), np.sin(np.radians(alpha))
    if which == "dZ":
        return 2 * b + g + (2 * c + e) * (cos + sin) + 2 * (d + g) * cos * sin
    return e * (sin - cos) + g * (sin**2 - cos**2)


def rates(sample: Result) -> Figure:
    """Rates of change of each mechanism over the direction of the probe (paper 001, Figures 5 and 6).

    Points: probes. Lines: the fit, when there is one. Grey: no gain or no loss expected when isotropic.
    """
    data = sample.data
    probes = sorted((one for one in data["snapshots"] if one["angle"] is not None), key=lambda one: one["angle"])
    if not probes:
        raise ResultError(f"{sample.path}: no strain probes; expected hypofab changes with --angles and --strain")
    angle = np.array([one["angle"] for one in probes])
    fine = np.linspace(min(0.0, angle.min()), max(360.0, angle.max()), 361)
    zones = {"gain": data.get("no_gain"), "loss": data.get("no_loss")}
    with rc_context(STYLE):
        figure = Figure(figsize=(190 / INCH, 105 / INCH), layout="constrained")
        panels = figure.subplots(2, 3, sharex=True)
        for column, mechanism in enumerate(MECHANISMS):
            for row, which in enumerate(("dZ", "dA")):
                axes = panels[row, column]
                axes.axhline(0, color="0.4", linewidth=0.8)
                if zone := zones.get(mechanism):
                    axes.axvspan(*zone, color="0.88", zorder=0)
                if "response" in data:
                    axes.plot(fine, law(data["response"], mechanism, which, fine), label="fit", **FIT)
                values = [one[mechanism][which] for one in probes]
                axes.plot(angle, values, "o", markersize=4.5, color="black", label="probes", zorder=3)
                axes.set(xlim=(fine[0], fine[-1]), xticks=range(0, 361, 90))
                if row == 0:
                    axes.set_title(NAMES[mechanism])
                else:
                    axes.set_xlabel(r"probe direction $\alpha$ [deg]")
                if column == 0:
                    axes.set_ylabel(f"{SYMBOLS[which]} [-]")
        panels[0, 2].set_ylim(-1, 1)  # zero: no contact comes or goes
        figure.legend(*panels[0, 0].get_legend_handles_labels(), loc="outside upper right", ncols=2)
        figure.suptitle(f"{sample.label}: {data['contacts_before']} contacts", x=0.02, ha="left", fontsize=9)
        return figure


def roses(sample: Result) -> Figure:
    """Orientation of lost and gained contacts of every later snapshot, with second-order harmonics (001, Figure 4)."""
    data = sample.data
    shown = data["snapshots"]
    first, second = data["plane"]
    with rc_context(STYLE):
        figure = Figure(figsize=(max(60, 42 * len(shown)) / INCH, 108 / INCH), layout="constrained")
        for column, snapshot in enumerate(shown):
            for row, mechanism in enumerate(("loss", "gain")):
                axes = figure.add_subplot(2, len(shown), row * len(shown) + column + 1, projection="polar")
                rose = snapshot[mechanism]["rose"]
                count = np.array(rose["count"], dtype=float)
                middle = (np.arange(rose["bins"]) + 0.5) * np.pi / rose["bins"]
                theta = np.linspace(0, 2 * np.pi, 361)
                if rose["contacts"]:
                    for turn in (0, np.pi):
                        axes.bar(middle + turn, count, width=np.pi / rose["bins"], **BAR)
                    wave = 1 + rose["anisotropy"] * np.cos(2 * (theta - np.radians(rose["direction"])))
                    axes.plot(theta, np.maximum(count.mean() * wave, 0), **FIT)
                    limit_radius(axes)
                else:
                    axes.set_yticks([])
                angle = snapshot["angle"]
                head = ("no strain" if angle is None else rf"$\alpha$ = {angle:g}$^\circ$") if data["strain"] else ""
                axes.set_title(f"{head}\n{rose['contacts']} {'lost' if mechanism == 'loss' else 'gained'}", fontsize=8)
                axes.set_xticks(np.radians([0, 90]), [first, second])
                axes.tick_params(axis="x", labelsize=7, pad=-2)
        figure.supxlabel("radius: contacts per bin, each bin drawn on both sides", fontsize=7)
        return figure
