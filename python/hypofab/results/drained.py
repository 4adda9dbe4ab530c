"""Drained triaxial compression: stress, dilatancy and critical states (paper 003, Figures 9 and 19).

Compression positive: eps_v > 0 is contraction, dilation has d eps_v/d eps_1 < 0.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hypofab.results.element_tests import TestResult, read_run
from hypofab.results.tables import ResultError, read_summary
from hypofab.tensors import Array

LEVELS = (0.005, 0.01, 0.025, 0.05, 0.075, 0.10, 0.125, 0.15)
"""Axial strains at which paper 003 takes its points."""


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


def critical_ratio(friction_angle: float) -> float:
    """q/p at the critical state in triaxial compression."""
    sine = np.sin(np.radians(friction_angle))
    return float(6 * sine / (3 - sine))
