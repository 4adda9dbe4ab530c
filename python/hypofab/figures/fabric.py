"""Figures of contact fabric: surfaces of the density, directions on the sphere and in the plane, series of samples.

Each function returns a matplotlib Figure and shows nothing. Colours run from dark to light, so that they keep their
order in grey print.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from matplotlib.projections.polar import PolarAxes
from matplotlib.ticker import MaxNLocator

from hypofab.figures.style import INCH, STYLE, line_style
from hypofab.results.fabric import Result, tensor
from hypofab.results.tables import ResultError
from hypofab.tensors import Array

COLOURS = "viridis"
BAR = {"color": "#9ECAE1", "edgecolor": "#3B6C8C", "linewidth": 0.5}
FIT = {"color": "#B03A00", "linewidth": 1.6}

AXES = "xyz"


def sphere_points(steps: int = 90) -> Array:
    """Unit vectors on a grid of polar angle and azimuth, shape (3, steps + 1, 2 steps + 1)."""
    polar, azimuth = np.meshgrid(np.linspace(0, np.pi, steps + 1), np.linspace(0, 2 * np.pi, 2 * steps + 1))
    return np.stack([np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), np.cos(polar)]).swapaxes(1, 2)


def density(fabric: Array, directions: Array) -> Array:
    """Density of contacts over that of an isotropic sample, 4 pi E(n) = 1 + n F n (Kanatani 1984)."""
    return 1 + np.einsum("i...,ij,j...->...", directions, fabric, directions)


def surfaces(samples: Sequence[Result], *, up: str = "z") -> Figure:
    """Surfaces of the density of contact normals, radius and colour 1 + n F n (paper 000, Figure 4; 004, Figure 3).

    up: the axis that stands upright in the figure.
    """
    order = [(AXES.index(up) + shift) % 3 for shift in (1, 2, 0)]
    points = sphere_points()
    values = [density(tensor(sample.data["deviatoric_fabric"]), points) for sample in samples]
    scale = Normalize(min(0.999, *map(np.min, values)), max(1.001, *map(np.max, values)))
    reach = max(1.0, *(float(np.abs(value).max()) for value in values))
    colours = ScalarMappable(scale, COLOURS)
    with rc_context(STYLE):
        figure = Figure(figsize=((25 + 72 * len(samples)) / INCH, 82 / INCH), layout="constrained")
        panels = []
        for column, (sample, value) in enumerate(zip(samples, values, strict=True)):
            axes = figure.add_subplot(1, len(samples), column + 1, projection="3d")
            x, y, z = (np.maximum(value, 0) * points)[order]
            axes.plot_surface(x, y, z, facecolors=colours.to_rgba(value), rstride=2, cstride=2, shade=False, lw=0)
            axes.set(xlim=(-reach, reach), ylim=(-reach, reach), zlim=(-reach, reach))
            axes.set(xlabel=AXES[order[0]], ylabel=AXES[order[1]], zlabel=AXES[order[2]])
            axes.set_box_aspect((1, 1, 1), zoom=0.8)
            axes.tick_params(labelsize=6, pad=-2)
            for axis in (axes.xaxis, axes.yaxis, axes.zaxis):
                axis.labelpad = -7
            axes.locator_params(nbins=4)
            anisotropy = sample.data.get("anisotropy")
            axes.set_title(sample.label + ("" if anisotropy is None else f", $a$ = {anisotropy:.3f}"))
            panels.append(axes)
        figure.colorbar(colours, ax=panels, shrink=0.75, label=r"density $4\pi E(\mathbf{n}) = 1 + \mathbf{nFn}$ [-]")
        return figure


def lambert(polar: Array) -> Array:
    """Radius of a polar angle [rad] in Lambert's equal-area projection of the hemisphere: 1 at 90 degrees."""
    return np.sqrt(1 - np.cos(polar))


def _draw_bins(axes: PolarAxes, bins: Sequence[Mapping[str, Any]], values: Array, colours: ScalarMappable) -> None:
    """Bins of the hemisphere as patches of the disc."""
    polar = np.radians([one["polar"] for one in bins])
    azimuth = np.radians([one["azimuth"] for one in bins])
    radius = lambert(polar)
    axes.bar(
        azimuth[:, 0],
        radius[:, 1] - radius[:, 0],
        width=azimuth[:, 1] - azimuth[:, 0],
        bottom=radius[:, 0],
        align="edge",
        color=colours.to_rgba(values),
        edgecolor="0.35",
        linewidth=0.25,
    )
    rings = np.array([30, 60, 90])
    axes.set(ylim=(0, 1), xticks=np.radians([0, 90, 180, 270]), xticklabels=["x", "y", "-x", "-y"])
    axes.set_yticks(lambert(np.radians(rings)), [rf"{ring}$^\circ$" for ring in rings])
    axes.tick_params(axis="y", labelsize=7)
    axes.grid(color="0.2", linewidth=0.3)
    axes.set_axisbelow(False)


def sphere(sample: Result) -> Figure:
    """Histogram of directions on the hemisphere seen from +z, and the second-order density with principal directions.

    Bins have equal area on the sphere and in the figure.
    """
    data = sample.data
    bins = data["bins"]
    counted = np.array([one["density"] for one in bins])
    polar = np.radians([np.mean(one["polar"]) for one in bins])
    azimuth = np.radians([np.mean(one["azimuth"]) for one in bins])
    middle = np.stack([np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), np.cos(polar)])
    fitted = density(tensor(data["deviatoric_fabric"]), middle)
    both = np.concatenate([counted, fitted])
    colours = ScalarMappable(Normalize(both.min(), both.max()), COLOURS)
    with rc_context(STYLE):
        figure = Figure(figsize=(165 / INCH, 82 / INCH), layout="constrained")
        panels = [figure.add_subplot(1, 2, column, projection="polar") for column in (1, 2)]
        for axes, values, title in zip(panels, (counted, fitted), ("counted", "second order"), strict=True):
            _draw_bins(axes, bins, values, colours)
            axes.set_title(title)
        for number, direction in enumerate(data["principal_directions"], start=1):
            x, y, z = np.array(direction) * (1 if direction[2] >= 0 else -1)
            place = np.arctan2(y, x), lambert(np.arccos(min(z, 1.0)))
            panels[1].plot(*place, "o", markersize=9, color="white", markeredgecolor="black", clip_on=False)
            panels[1].annotate(str(number), place, ha="center", va="center", fontsize=7, annotation_clip=False)
        figure.colorbar(colours, ax=panels, shrink=0.8, label="density over isotropic one [-]")
        figure.suptitle(f"{sample.label}: {data['contacts']} contacts, $a$ = {data['anisotropy']:.3f}")
        return figure


def _rose_bars(axes: PolarAxes, angles: Array, values: Array, *, hatch: str | None = None) -> None:
    """Bars over half a turn, and once more on the other side: a normal has no sense."""
    width = np.pi / len(angles)
    for turn in (0, np.pi):
        axes.bar(angles + turn, values, width=width, hatch=hatch, **BAR)


def limit_radius(axes: PolarAxes) -> None:
    """Two circles with a number each: more would cover the bars."""
    top = axes.get_ylim()[1]
    axes.set_ylim(0, top)
    axes.yaxis.set_major_locator(MaxNLocator(2, steps=[1, 2, 5, 10]))
    axes.tick_params(axis="y", labelsize=7)
    axes.set_axisbelow(False)  # numbers and circles on top of the bars
    axes.grid(color="0.35", linewidth=0.35)
    for label in axes.get_yticklabels():
        label.set_path_effects([withStroke(linewidth=2, foreground="white")])


def _finish_rose(axes: PolarAxes, title: str) -> None:
    axes.set_title(title, fontsize=9)
    axes.set_xticks(np.radians([0, 90, 180, 270]), ["x", "y", "-x", "-y"])
    limit_radius(axes)


def _value(number: float | None) -> float:
    return np.nan if number is None else number


def plane_roses(sample: Result) -> Figure:
    """Rose diagrams of a two-dimensional sample with harmonic fits: contacts, normal and shear force (003, Figure 11).

    E = E0 (1 + a_n cos 2(phi - phi_n)), f = f0 (1 + a_f cos 2(phi - phi_f)), t = -f0 a_t sin 2(phi - phi_t); the
    radius of the last is |t|, and bars with t < 0 are hatched.
    """
    bins, fit = sample.data["bins"], sample.data["fit"]
    angles = np.radians([np.mean(one["azimuth"]) for one in bins])
    contacts = np.array([one["density"] for one in bins])
    normal = np.array([_value(one["normal_force"]) for one in bins])
    shear = np.array([[_value(part) for part in one["shear_force"][:2]] for one in bins])
    tangential = shear[:, 1] * np.cos(angles) - shear[:, 0] * np.sin(angles)
    fine = np.linspace(0, 2 * np.pi, 361)

    def wave(size: str, angle: str) -> Array:
        return 1 + _value(fit[size]) * np.cos(2 * (fine - np.radians(_value(fit[angle]))))

    f0 = _value(fit["mean_normal_force"])
    panels = [("contacts $E/E_0$", contacts, wave("a_n", "phi_n"), f"a_n = {_value(fit['a_n']):.3f}")]
    if np.isfinite(normal).any():
        panels.append(("normal force $f/f_0$", normal / f0, wave("a_f", "phi_f"), f"a_f = {_value(fit['a_f']):.3f}"))
    if np.isfinite(tangential).any():
        law = -_value(fit["a_t"]) * np.sin(2 * (fine - np.radians(_value(fit["phi_t"]))))
        panels.append(("shear force $|t|/f_0$", tangential / f0, law, f"a_t = {_value(fit['a_t']):.3f}"))
    with rc_context(STYLE):
        figure = Figure(figsize=(70 * len(panels) / INCH, 86 / INCH), layout="constrained")
        for column, (title, values, law, size) in enumerate(panels):
            axes = figure.add_subplot(1, len(panels), column + 1, projection="polar")
            values = np.nan_to_num(values)
            _rose_bars(axes, angles, np.maximum(values, 0))
            _rose_bars(axes, angles, np.maximum(-values, 0), hatch="////")
            axes.plot(fine, np.abs(law), **FIT)
            _finish_rose(axes, f"{title}, ${size}$")
        figure.suptitle(f"{sample.label}: {sample.data['contacts']} contacts")
        return figure


SERIES = {
    "coordination_number": "coordination number $Z$ [-]",
    "deviator_fabric": r"deviator fabric $\Phi_\mathrm{max} - \Phi_\mathrm{min}$ [-]",
    "anisotropy": "anisotropy $a$ [-]",
    "void_ratio": "void ratio $e$ [-]",
    "a_n": "$a_n$ [-]",
    "a_f": "$a_f$ [-]",
    "a_t": "$a_t$ [-]",
    "sin_phi": r"$\sin\varphi$ [-]",
    "sliding_ratio": "sliding contacts [-]",
}
"""Columns of a series that have a name in figures; others are shown under their own."""


def series(tables: Mapping[str, Mapping[str, Array]], names: Sequence[str], *, over: str | None = None) -> Figure:
    """Columns of `hypofab describe --csv` over snapshots or cycles (paper 002).

    tables: one line each, by its label. names: columns, one panel each. over: the column of the abscissa; None: the
    number of the snapshot.
    """
    for label, table in tables.items():
        for name in [*names, *([over] if over else [])]:
            if name not in table or not np.isfinite(table[name]).any():
                known = ", ".join(key for key in table if np.isfinite(table[key]).any())
                raise ResultError(f"{label}: no numbers in a column {name}; there are {known}")
    with rc_context(STYLE):
        figure = Figure(figsize=(120 / INCH, (18 + 48 * len(names)) / INCH), layout="constrained")
        panels = figure.subplots(len(names), 1, sharex=True, squeeze=False)[:, 0]
        for axes, name in zip(panels, names, strict=True):
            for index, (label, table) in enumerate(tables.items()):
                x = table[over] if over else np.arange(1, len(table[name]) + 1)
                axes.plot(x, table[name], marker="o", markersize=3, label=label, **line_style(index))
            axes.set_ylabel(SERIES.get(name, name))
        panels[-1].set_xlabel(over or "snapshot")
        if len(tables) > 1:
            figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=4)
        return figure
