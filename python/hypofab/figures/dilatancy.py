"""Stress and dilatancy in drained triaxial compression, and critical states (paper 003, Figures 9 and 19).

Compression positive: eps_v > 0 is contraction, dilation has d eps_v/d eps_1 < 0.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hypofab.figures.element_tests import COLUMN, STYLE
from hypofab.results.element_tests import Array, ResultError, TestResult, read_run, read_summary

LEVELS = (0.005, 0.01, 0.025, 0.05, 0.075, 0.10, 0.125, 0.15)
"""Axial strains at which paper 003 takes its points."""

MARKERS = "osD^v<>phX*"


@dataclass(frozen=True)
class DrainedTest:
    """A drained triaxial compression test: arrays of shape (rows,), compression positive."""

    name: str
    eps_1: Array
    eps_v: Array
    q: Array
    p: Array
    void_ratio: Array


@dataclass(frozen=True)
class DilatancyPoints:
    """Points of one test: stress ratio q/p over d eps_v/d eps_1."""

    name: str
    dilatancy: Array
    ratio: Array


def dilatancy_points(test: DrainedTest, levels: Sequence[float] = LEVELS, width: float = 0.0025) -> DilatancyPoints:
    """Slope of the volumetric strain by a straight line through the rows within +-width of each level of axial strain.

    Levels that the test does not pass by width, or where fewer than three rows lie, are left out.
    """
    slopes, ratios = [], []
    for level in levels:
        near = np.abs(test.eps_1 - level) <= width
        if level + width > test.eps_1.max() or np.count_nonzero(near) < 3:
            continue
        slopes.append(np.polyfit(test.eps_1[near], test.eps_v[near], 1)[0])
        ratios.append(np.mean(test.q[near]) / np.mean(test.p[near]))
    return DilatancyPoints(test.name, np.array(slopes), np.array(ratios))


def drained_test(result: TestResult, compression_positive: bool) -> DrainedTest | None:
    """A triaxial compression test from a result file; None when it is no such test.

    The axis is the one that has shortened most. The stresses across it must be alike, to 1e-6 of the axial one.
    """
    sign = 1 if compression_positive else -1
    axis = int(np.argmax(sign * result.strain[-1, :3]))
    first, second = (sign * result.stress[:, (axis + k) % 3] for k in (1, 2))
    axial, shear = sign * result.stress[:, axis], np.abs(result.stress[:, 3:]).max()
    if max(np.abs(first - second).max(), shear) > 1e-6 * np.abs(axial).max() or result.strain[-1, axis] == 0:
        return None
    strain = sign * (result.strain[:, axis] - result.strain[0, axis])
    if strain[-1] <= 0:
        return None
    return DrainedTest(result.name, strain, sign * result.eps_v, axial - first, result.p, result.void_ratio)


def read_drained(directory: Path) -> tuple[dict[str, list[DrainedTest]], dict[str, Mapping[str, float]]]:
    """Triaxial compression tests of a folder of results by material (its friction angle and critical void ratio), and
    the parameters of these materials. Isochoric tests, whose volume stays within 1e-9, are left out.
    """
    run, summary = read_run(directory), read_summary(directory)
    groups: dict[str, list[DrainedTest]] = {}
    parameters: dict[str, Mapping[str, float]] = {}
    entries = {test["name"]: test for test in summary["tests"]}
    for result in run.tests:
        test = drained_test(result, run.compression_positive)
        if test is None or np.abs(test.eps_v).max() < 1e-9:
            continue
        material = entries[result.name]["material"]
        label = next((name for name, known in parameters.items() if known == material), f"material {len(groups) + 1}")
        parameters[label] = material
        groups.setdefault(label, []).append(test)
    if not groups:
        raise ResultError(f"{directory}: no drained triaxial compression test")
    title = summary.get("title")
    if len(groups) == 1 and title:
        return {title: groups["material 1"]}, {title: parameters["material 1"]}
    return groups, parameters


def rowe(dilatancy: Array, friction_angle: float) -> Array:
    """q/p of Rowe (1962), s1/s3 = (1 - d eps_v/d eps_1) tan^2(45 + phi_f/2) (paper 003, Eq. 7); angle in degrees."""
    ratio = (1 - np.asarray(dilatancy)) * np.tan(np.radians(45 + friction_angle / 2)) ** 2
    return 3 * (ratio - 1) / (ratio + 2)


def critical_void_ratio(p: Array, parameters: Mapping[str, float]) -> Array:
    """e_c of the model at a mean stress, in the unit of h_s."""
    return parameters["e_c0"] * np.exp(-((3 * np.asarray(p) / parameters["h_s"]) ** parameters["n"]))


def critical_ratio(friction_angle: float) -> float:
    """q/p at the critical state in triaxial compression."""
    sine = np.sin(np.radians(friction_angle))
    return float(6 * sine / (3 - sine))


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


def critical_states(groups: Mapping[str, Sequence[DrainedTest]], parameters: Mapping[str, float]) -> Figure:
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
        left.plot(p, critical_void_ratio(p, parameters), "k-", linewidth=1.2, label="model, $e_c(p)$")
        p = np.array([0, 1.1 * highest])
        right.plot(p, critical_ratio(parameters["phi_c"]) * p, "k-", linewidth=1.2, label=r"model, $\varphi_c$")
        left.set(xscale="log", xlabel="$p$ [kPa]", ylabel="void ratio $e$")
        right.set(xlabel="$p$ [kPa]", ylabel="$q$ [kPa]", xlim=(0, None), ylim=(0, None))
        left.legend(fontsize=7)
        right.legend(fontsize=7)
        return figure
