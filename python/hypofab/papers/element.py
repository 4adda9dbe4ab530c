"""Element tests of DEM samples: the four directional tests of paper 000 with delta from the samples' contacts."""

import json
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hypofab.papers.program import run, run_json
from hypofab.papers.runs import DemRun
from hypofab.results import TestResult, read_run

SMALL = 1e-3
"""Deviatoric strain of the secant stiffness (paper 000)."""


@dataclass(frozen=True)
class Loading:
    """One directional test: a sample compressed along an axis."""

    name: str
    sample: DemRun
    axis: str


def deck(loadings: list[Loading], c: float, strain: float | None) -> dict:
    """The deck of these tests: material of paper 000, void ratio and contacts of the samples.

    strain: axial compression at the end; None: stop at eps_q = 0.1 %.
    """
    samples = {loading.sample.name: loading.sample for loading in loadings}
    states = [
        {
            "name": name,
            "material": "sand",
            "p": 100,
            "void_ratio": sample.results["void_ratio"],
            "delta": {"contacts": str(sample.contacts.resolve()), "c": c},
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


def element_tests(loadings: list[Loading], c: float, strain: float | None = None) -> dict[str, TestResult]:
    """Run the element tests; JSON is YAML, so that the deck needs no writer of its own."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "deck.yaml"
        file.write_text(json.dumps(deck(loadings, c, strain), indent=1), encoding="utf-8")
        run("run", file, "-o", Path(folder) / "out")
        return {test.name: test for test in read_run(Path(folder) / "out").tests}


def secants(tests: Mapping[str, TestResult]) -> dict[str, float]:
    """Secant stiffness of each test at eps_q = 0.1 % [kPa]."""
    return {name: float(np.interp(SMALL, test.eps_q, test.q)) / SMALL for name, test in tests.items()}


@dataclass(frozen=True)
class Fit:
    """c fitted to measured ratios of stiffness by `hypofab fit-c`."""

    c: float
    lower: float
    upper: float
    """Bounds of the interval of 95 %."""
    error: float
    """Root-mean-square error of the logarithms of the ratios."""


def fit_c(loadings: list[Loading], measured: Mapping[str, float]) -> Fit:
    """The c that fits the ratios of the measured stiffnesses [kPa] best."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "deck.yaml"
        file.write_text(json.dumps(deck(loadings, 0.05, None), indent=1), encoding="utf-8")
        targets = ",".join(f"{name}={value:.9g}" for name, value in measured.items())
        result = run_json("fit-c", file, "--target", targets)
    return Fit(result["c"], result["lower"], result["upper"], result["misfit"])
