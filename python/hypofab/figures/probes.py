"""Figures of probes, after papers 001 and 004. Each function returns a matplotlib Figure and shows nothing."""

import math

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hypofab.figures.style import INCH, STYLE
from hypofab.results.probes import Envelope, ProbeSeries
from hypofab.tensors import COMPONENTS, Array, contraction, coordinates

MARKERS = (("o", "#000000"), ("s", "#D55E00"), ("^", "#00508C"), ("D", "#009E73"), ("v", "#AA3377"), ("P", "#7F7F7F"))
"""Marker and colour of a series: apart in grey print by their shapes."""
UNIT_TENSOR = np.array([1.0, 1.0, 1.0, 0.0, 0.0, 0.0])


def marker_style(index: int) -> dict:
    """Open markers without lines; they repeat after the last one."""
    marker, color = MARKERS[index % len(MARKERS)]
    return {"linestyle": "", "marker": marker, "color": color, "markerfacecolor": "white", "markeredgewidth": 0.8}


def _sign(envelope: Envelope, compression_positive: bool) -> int:
    """Factor from the results' sign to that of the figure."""
    return 1 if compression_positive == envelope.compression_positive else -1


def convention(compression_positive: bool) -> str:
    """The sign of a figure in words."""
    return "compression positive" if compression_positive else "tension positive"


def scale(envelope: Envelope, *, of_response: bool) -> tuple[float, str, str]:
    """Factor, symbol and unit of what is drawn: increments for probes of finite size, else rates."""
    of_stress = envelope.imposes_stress != of_response
    symbol = r"\sigma" if of_stress else r"\varepsilon"
    megapascal = (1e-3, "MPa") if envelope.unit == "kPa" else (1.0, envelope.unit)
    if envelope.size > 0:
        if of_stress:
            return envelope.size, rf"\Delta {symbol}", envelope.unit
        # Strains of about one: the power of ten of the largest.
        largest = max(np.nanmax(np.abs(series.response)) for series in envelope.series) if of_response else 1.0
        power = math.floor(math.log10(envelope.size * largest))
        return envelope.size * 10.0**-power, rf"\Delta {symbol}", rf"$10^{{{power}}}$"
    rate = rf"\dot{{{symbol}}}"
    if not of_response:
        return 1.0, rate, "of norm 1"
    if of_stress:
        return megapascal[0], rate, rf"{megapascal[1]} per unit of $|\dot{{\boldsymbol{{\varepsilon}}}}|$"
    return 1 / megapascal[0], rate, rf"per {megapascal[1]} of $|\dot{{\boldsymbol{{\sigma}}}}|$"


def _axis_label(envelope: Envelope, basis: Array, index: int, symbol: str, unit: str) -> str:
    """Label of a coordinate: a component where the basis tensor is one, else its number."""
    nonzero = np.flatnonzero(np.abs(basis[index]) > 1e-12)
    factor, name = "", f"({index + 1})"
    if envelope.directions == "axisymmetric":
        factor, name = ("", r"\sqrt{2}\,")[index], ("axial", "lateral")[index]
    elif len(nonzero) == 1:
        factor, name = ("" if nonzero[0] < 3 else r"\sqrt{2}\,"), COMPONENTS[nonzero[0]]
    return rf"${factor}{symbol}_{{\mathrm{{{name}}}}}$ [{unit}]"


def ellipse(series: ProbeSeries, points: int = 181) -> Array:
    """Points of the fitted ellipse in the plane of the probes, shape (points, 2)."""
    assert series.ellipsoid is not None
    turn = np.linspace(0, 2 * np.pi, points)
    circle = np.column_stack([np.cos(turn), np.sin(turn)])
    tensors = series.ellipsoid.centre + (circle * series.ellipsoid.semi_axis) @ series.ellipsoid.axis
    return coordinates(series.basis, tensors)


def fan(envelope: Envelope, *, compression_positive: bool = False) -> Figure:
    """Probes in a plane as rays, and their answers with fitted ellipses (paper 001, Figures 2 and 3).

    compression_positive: sign in the figure, whatever that of the results.
    """
    sign = _sign(envelope, compression_positive)
    with rc_context(STYLE):
        figure = Figure(figsize=(170 / INCH, 92 / INCH), layout="constrained")
        left, right = figure.subplots(1, 2)
        for axes, of_response in ((left, False), (right, True)):
            axes.axhline(0, color="0.55", linewidth=0.8)
            axes.axvline(0, color="0.55", linewidth=0.8)
            axes.set_aspect("equal", adjustable="datalim")
            factor, symbol, unit = scale(envelope, of_response=of_response)
            labels = [_axis_label(envelope, envelope.series[0].basis, index, symbol, unit) for index in range(2)]
            axes.set(xlabel=labels[0], ylabel=labels[1])
            axes.locator_params(nbins=5)
            what = "stress" if envelope.imposes_stress != of_response else "strain"
            axes.set_title(f"{what} {'answering' if of_response else 'imposed'}", fontsize=9)
            if not of_response:
                series = envelope.series[0]
                _rays(axes, sign * factor * coordinates(series.basis, series.direction), 0, label=None)
                _angles(axes, factor)
                continue
            for index, series in enumerate(envelope.series):
                _rays(axes, sign * factor * coordinates(series.basis, series.response), index, label=series.name)
                if series.ellipsoid is not None:
                    style = {"color": MARKERS[index % len(MARKERS)][1], "linestyle": (0, (4, 2)), "linewidth": 1.0}
                    axes.plot(*(sign * factor * ellipse(series)).T, **style)
        handles, labels = right.get_legend_handles_labels()
        handles += right.plot([], [], color="0.3", linestyle=(0, (4, 2)), linewidth=1.0)
        title = convention(compression_positive)
        figure.legend(handles, [*labels, "ellipse"], title=title, loc="outside upper center", ncols=5)
        return figure


def _rays(axes: Axes, tips: Array, index: int, *, label: str | None) -> None:
    """Rays from the origin to points with a marker at their tips."""
    style = marker_style(index)
    for tip in tips:
        axes.plot([0, tip[0]], [0, tip[1]], color=style["color"], linewidth=0.4, alpha=0.5)
    axes.plot(*tips.T, **style, markersize=3.5, label=label)


def _angles(axes: Axes, radius: float) -> None:
    """Every 45 degrees written beside the tips of the probes, angles as in the results."""
    for angle in range(0, 360, 45):
        x, y = 1.21 * radius * np.cos(np.radians(angle)), 1.21 * radius * np.sin(np.radians(angle))
        box = {"facecolor": "white", "edgecolor": "none", "pad": 0.5}
        axes.text(x, y, rf"${angle}^\circ$", fontsize=7, ha="center", va="center", bbox=box)
    axes.update_datalim([(-1.3 * radius, -1.3 * radius), (1.3 * radius, 1.3 * radius)])


def deviatoric_coordinates(tensors: Array) -> Array:
    """Components xx, yy, zz seen along the hydrostatic axis: zz upwards, yy to the lower right; shape (..., 2)."""
    x, y, z = (tensors[..., index] for index in range(3))
    return np.stack([(y - x) / np.sqrt(2), (2 * z - x - y) / np.sqrt(6)], axis=-1)


def _scaled_strains(envelope: Envelope) -> list[Array]:
    """The strain that stress probes leave, compression positive, largest norm 1; zero where nothing is left."""
    sign = _sign(envelope, compression_positive=True)
    strains = []
    for series in envelope.series:
        strain = series.irrecoverable if series.unloaded else series.response
        largest = np.sqrt(np.nanmax(contraction(strain, strain)))
        whole = np.sqrt(np.nanmax(contraction(series.response, series.response)))
        strains.append(sign * strain / largest if largest > 1e-9 * whole else np.zeros_like(strain))
    return strains


def flow(envelope: Envelope) -> Figure:
    """Direction of the strain that stress probes leave (paper 004, Figures 1 and 2), compression positive.

    Left: in the deviatoric plane of stress each envelope is drawn at the stress it starts from, scaled to one size.
    Right: volumetric over deviatoric strain. Without unloading the strain is the whole answer.
    """
    strains = _scaled_strains(envelope)
    what = "irrecoverable strain" if envelope.series[0].unloaded else "strain"
    with rc_context(STYLE):
        figure = Figure(figsize=(170 / INCH, 100 / INCH), layout="constrained")
        left, right = figure.subplots(1, 2, width_ratios=(1.15, 1))
        for index, (series, strain) in enumerate(zip(envelope.series, strains, strict=True)):
            volumetric = contraction(strain, UNIT_TENSOR)
            deviator = strain - volumetric[:, None] / 3 * UNIT_TENSOR
            style = marker_style(index) | {"markersize": 3, "label": series.name}
            right.plot(np.sqrt(2 / 3 * contraction(deviator, deviator)), volumetric, **style)
        _deviatoric_plane(left, envelope, strains)
        left.set_title(f"{what}, drawn at its stress", fontsize=9)
        right.set_title(f"{what}, largest norm 1", fontsize=9)
        right.axhline(0, color="0.55", linewidth=0.8)
        right.set(xlabel=r"$\Delta\varepsilon_q$", ylabel=r"$\Delta\varepsilon_v$ (contraction positive)")
        right.set_xlim(left=0)
        figure.legend(*right.get_legend_handles_labels(), loc="outside upper center", ncols=4)
        return figure


def _deviatoric_plane(axes: Axes, envelope: Envelope, strains: list[Array]) -> None:
    """Stress points and, starting from them, strain envelopes scaled to a common length."""
    sign = _sign(envelope, compression_positive=True)
    starts = np.array([deviatoric_coordinates(sign * series.stress) for series in envelope.series])
    spread = np.hypot(*(starts - starts.mean(axis=0)).T).max()
    reach = np.hypot(*starts.T).max()
    pressure = abs(envelope.series[0].stress[:3].mean())
    is_close = 1e-9 * pressure < spread < 0.2 * reach  # different states near each other: the origin is out of sight
    length = 12 * spread if is_close else 0.45 * max(reach, 0.2 * pressure)
    outermost = 0.0
    for index, (start, strain) in enumerate(zip(starts, strains, strict=True)):
        tips = start + length * deviatoric_coordinates(strain)
        outermost = max(outermost, 1.12 * np.nanmax(np.hypot(*tips.T)))
        style = marker_style(index)
        if not is_close:
            axes.plot([0, start[0]], [0, start[1]], color=style["color"], linewidth=0.8, linestyle=(0, (2, 2)))
        axes.plot(*start, marker="o", markersize=5, color=style["color"])
        axes.plot(*tips.T, **style, markersize=3.5)
    if not is_close:
        for name, tensor in zip(("xx", "yy", "zz"), np.eye(3, 6), strict=True):
            end = deviatoric_coordinates(tensor) / np.sqrt(2 / 3)
            end *= outermost * (1.0 if end @ starts.mean(axis=0) > 0.5 * reach else 0.5)  # long where the states are
            axes.plot([0, end[0]], [0, end[1]], color="0.55", linewidth=0.8, zorder=1)
            box = {"facecolor": "white", "edgecolor": "none", "pad": 0.8}
            axes.annotate(rf"$\sigma_{{{name}}}$", end, ha="center", va="center", bbox=box)
    axes.set_aspect("equal", adjustable="datalim")
    axes.set(
        xlabel=rf"$(\sigma_{{yy}}-\sigma_{{xx}})/\sqrt{{2}}$ [{envelope.unit}]",
        ylabel=rf"$(2\sigma_{{zz}}-\sigma_{{xx}}-\sigma_{{yy}})/\sqrt{{6}}$ [{envelope.unit}] (compression positive)",
    )


def directional_stiffness(envelope: Envelope) -> Figure:
    """Stiffness over the angle between what is imposed and the intergranular strain.

    0 degrees: loading goes on; 180: it is reversed. Without intergranular strain the angle is that to the stress.
    """
    factor, unit = (1e-3, "MPa") if envelope.unit == "kPa" else (1.0, envelope.unit)
    to_delta = any(np.any(series.delta) for series in envelope.series)
    with rc_context(STYLE):
        figure = Figure(figsize=(120 / INCH, 90 / INCH), layout="constrained")
        axes = figure.add_subplot()
        drawn = []
        for index, series in enumerate(envelope.series):
            reference = series.delta if to_delta else series.stress
            length = np.sqrt(contraction(reference, reference))
            if length == 0:
                continue
            angle = np.degrees(np.arccos(np.clip(contraction(series.direction, reference) / length, -1, 1)))
            stiffness = factor * series.stiffness
            drawn.append(stiffness[np.isfinite(stiffness)])
            axes.plot(
                angle, stiffness, **marker_style(index) | {"markerfacecolor": "none"}, markersize=3, label=series.name
            )
        values = np.concatenate(drawn) if drawn else np.ones(1)
        if values.max(initial=1) > 20 * values.min(initial=1e300):
            axes.set_yscale("log")
        else:
            axes.set_ylim(bottom=0)
        imposed = "stress" if envelope.imposes_stress else "strain"
        other = "intergranular strain" if to_delta else "stress"
        axes.set(
            xlabel=rf"angle between the {imposed} imposed and the {other} [$^\circ$]",
            ylabel=rf"stiffness $|\Delta\boldsymbol{{\sigma}}|/|\Delta\boldsymbol{{\varepsilon}}|$ [{unit}]",
            xlim=(0, 180),
        )
        axes.set_xticks(range(0, 181, 30))
        figure.legend(*axes.get_legend_handles_labels(), loc="outside upper center", ncols=4)
        return figure
