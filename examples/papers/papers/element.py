"""Element tests beside DEM runs: any deck, and the directional tests of paper 000 with delta from contact lists."""

import json
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hypofab.papers.program import run, run_json
from hypofab.papers.runs import DemRun
from hypofab.results import TestResult, read_run
from hypofab.results.probes import Envelope, read_probes

SMALL = 1e-3
"""Deviatoric strain of the secant stiffness (paper 000)."""


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
    return {"components": run_json("delta", sample.contacts, f"--c={c:.9g}", "--corrected")["delta"]}


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


@contextmanager
def deck_file(deck: dict) -> Iterator[Path]:
    """A deck as a file that is removed again; JSON is YAML, so that the deck needs no writer of its own."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "deck.yaml"
        file.write_text(json.dumps(deck, indent=1), encoding="utf-8")
        yield file


def run_deck(deck: dict, *, may_stop: bool = False) -> dict[str, TestResult]:
    """Run the tests of a deck. may_stop: a test may stop early, as at a peak."""
    with deck_file(deck) as file:
        run("run", file, "-o", file.parent / "out", accept=(0, 1) if may_stop else (0,))
        return {test.name: test for test in read_run(file.parent / "out").tests}


def run_envelopes(deck: dict) -> dict[str, Envelope]:
    """Run the envelopes of a deck."""
    with deck_file(deck) as file:
        run("envelope", file, "-o", file.parent / "out")
        return {envelope.name: envelope for envelope in read_probes(file.parent / "out")}


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


@dataclass(frozen=True)
class Fit:
    """c fitted to measured ratios of stiffness by `hypofab fit-c`."""

    c: float
    lower: float
    upper: float
    """Bounds of the interval of 95 %."""
    error: float
    """Root-mean-square error of the logarithms of the ratios."""


def fit_c(loadings: list[Loading], measured: Mapping[str, float], *, corrected: bool = False) -> Fit:
    """The c that fits the ratios of the measured stiffnesses [kPa] best."""
    with deck_file(deck(loadings, 0.05, None)) as file:
        targets = ",".join(f"{name}={value:.9g}" for name, value in measured.items())
        options = ["--corrected"] if corrected else []
        result = run_json("fit-c", file, "--target", targets, *options)
    return Fit(result["c"], result["lower"], result["upper"], result["misfit"])
