"""Element tests beside DEM runs: any deck, and the directional tests of paper 000 with delta from contact lists."""

import tempfile
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

import hypofab
from hypofab.results import TestResult
from hypofab.results.probes import Envelope, read_probes
from papers.runs import DemRun

SMALL = 1e-3
"""Deviatoric strain of the secant stiffness (paper 000)."""
R = 1e-4
"""Size of the elastic strain range of the sand of paper 000."""


@dataclass(frozen=True)
class Loading:
    """One directional test: a sample compressed along an axis."""

    name: str
    sample: DemRun
    axis: str


def delta_of(sample: DemRun, c: float, corrected: bool) -> dict:
    """Delta of a state from the contacts of a sample; corrected: without the noise of their finite number."""
    if not corrected:
        return {"contacts": str(sample.contacts.resolve()), "c": c}
    fabric = hypofab.fabric_of_file(sample.contacts).without_noise()
    return {"components": fabric.delta(R, c).delta.tolist()}


def deck(loadings: list[Loading], c: float, strain: float | None, *, corrected: bool = False) -> dict:
    """The deck of these tests: material of paper 000, void ratio and contacts of the samples.

    strain: axial compression at the end; None: stop at eps_q = 0.1 %. corrected: as in delta_of.
    """
    samples = {loading.sample.name: loading.sample for loading in loadings}
    states = [
        {
            "name": name,
            "material": "sand",
            "p": 100,
            "void_ratio": sample.results["void_ratio"],
            "delta": delta_of(sample, c, corrected),
        }
        for name, sample in samples.items()
    ]
    tests = []
    for loading in loadings:
        control: dict = {name: {"stress_rate": 0} for name in ("xx", "yy", "zz", "xy", "xz", "yz")}
        control[2 * loading.axis] = {"strain_rate": -1}
        along = f"eps_{2 * loading.axis}"
        steps = [
            {
                "name": "small strain",
                "control": control,
                "until": {"quantity": "eps_q", "value": SMALL},
                "every": {"quantity": along, "value": 1e-5},
            }
        ]
        if strain is not None:
            end = {"quantity": along, "value": -strain}
            steps.append({"name": "large strain", "control": control, "until": end, "rows": 300})
        tests.append({"name": loading.name, "state": loading.sample.name, "steps": steps})
    return {
        "unit": "kPa",
        "materials": [{"name": "sand", "sand": "paper000"}],
        "states": states,
        "tests": tests,
    }


def run_deck(deck: dict, *, may_stop: bool = False) -> dict[str, TestResult]:
    """Run the tests of a deck. may_stop: a test may stop early, as at a peak."""
    tests = hypofab.Study(deck).run()
    return tests if may_stop else {name: test.check() for name, test in tests.items()}


def run_envelopes(deck: dict) -> dict[str, Envelope]:
    """Run the envelopes of a deck."""
    with tempfile.TemporaryDirectory() as folder:
        hypofab.Study(deck).write_envelopes(folder)
        return {envelope.name: envelope for envelope in read_probes(folder)}


def fabric_in_space(xx: float, yy: float, xy: float) -> list[float]:
    """N of space whose part in the plane xy is that of a two-dimensional sample and whose rest is isotropic.

    xx, yy, xy: N of the plane, trace 1. N of space is 2/3 of it and 1/3 z z: isotropic where the sample is.
    """
    return [2 / 3 * xx, 2 / 3 * yy, 1 / 3, 2 / 3 * xy, 0, 0]


def element_tests(
    loadings: list[Loading], c: float, strain: float | None = None, *, corrected: bool = False
) -> dict[str, TestResult]:
    """Run the directional tests."""
    return run_deck(deck(loadings, c, strain, corrected=corrected))


def secants(tests: Mapping[str, TestResult]) -> dict[str, float]:
    """Secant stiffness of each test at eps_q = 0.1 % [kPa]."""
    return {name: float(np.interp(SMALL, test.eps_q, test.q)) / SMALL for name, test in tests.items()}


def fit_c(loadings: list[Loading], measured: Mapping[str, float], *, corrected: bool = False) -> hypofab.FitOfC:
    """The c that fits the ratios of the measured stiffnesses [kPa] best."""
    return hypofab.Study(deck(loadings, 0.05, None)).fit_c(measured, corrected=corrected)
