"""Element tests of DEM samples: the four directional tests of paper 000 with delta from the samples' contacts."""

import json
import math
import tempfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hypofab.papers.program import run
from hypofab.papers.runs import DemRun
from hypofab.results import Array, TestResult, read_run

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


def log_ratios(stiffness: Mapping[str, float]) -> Array:
    """Logarithms of stiffnesses over their geometric mean: what directions tell, without the material's magnitude."""
    logs = np.log(list(stiffness.values()))
    return logs - logs.mean()


@dataclass(frozen=True)
class Fit:
    """c fitted to measured ratios of stiffness."""

    c: float
    error: float
    """Root-mean-square error of the logarithms of the ratios."""
    at_bound: bool
    """Whether the best c lies at an end of the range: the data then bound c from one side only."""


def fit_c(error: Callable[[float], float], low: float = 0.01, high: float = 5.0, points: int = 28) -> Fit:
    """The c with the least error: a grid in log c, then golden section around its best point."""
    grid = np.geomspace(low, high, points)
    values = [error(c) for c in grid]
    best = int(np.argmin(values))
    if best in (0, points - 1):
        return Fit(float(grid[best]), values[best], True)
    a, b = math.log(grid[best - 1]), math.log(grid[best + 1])
    golden = (math.sqrt(5) - 1) / 2
    for _ in range(12):
        x, y = b - golden * (b - a), a + golden * (b - a)
        if error(math.exp(x)) < error(math.exp(y)):
            b = y
        else:
            a = x
    c = math.exp((a + b) / 2)
    return Fit(c, error(c), False)


def ratio_error(loadings: list[Loading], measured: Mapping[str, float]) -> Callable[[float], float]:
    """Root-mean-square error of the logarithms of the ratios as a function of c."""

    def error(c: float) -> float:
        tests = secants(element_tests(loadings, c))
        difference = log_ratios({name: tests[name] for name in measured}) - log_ratios(measured)
        return float(np.sqrt(np.mean(difference**2)))

    return error
