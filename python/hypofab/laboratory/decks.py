"""Decks for laboratory tests, one per test with a variant for each sand and each start of delta; and their runs.

Decks are JSON, which is YAML too.
"""

import json
from contextlib import suppress
from pathlib import Path

import numpy as np

from hypofab.decks.study import Study
from hypofab.errors import PhysicalError
from hypofab.laboratory.catalogue import LabTest
from hypofab.laboratory.series import Series, legs, read_computed
from hypofab.laboratory.variants import Computed, Variant
from hypofab.results.tables import read_summary

CYCLES = 60
"""Cycles computed at most in a cyclic test."""


def initial_stress(test: LabTest, measured: Series) -> tuple[float, float]:
    """Axial and lateral effective stress at the start [kPa]."""
    if test.kind == "oedometer":
        axial = test.sigma1 or float(measured["sigma1"][0])
        return axial, (test.K0 or 0.5) * axial
    lateral = test.sigma3
    if lateral is None:
        lateral = float(measured["p"][0] - measured["q"][0] / 3)
    return lateral, lateral


def _delta(test: LabTest, start: str) -> dict:
    if start == "zero":
        return {"zero": True}
    along = {"oedometer": [0, 0, 1, 0, 0, 0], "undrained_extension": [0.5, 0.5, -1, 0, 0, 0]}
    if start == "shearing":
        return {"mobilised": along.get(test.kind, [-0.5, -0.5, 1, 0, 0, 0])}
    return {"mobilised": along["oedometer"] if test.kind == "oedometer" else [1, 1, 1, 0, 0, 0]}


def _steps(test: LabTest, measured: Series) -> list[dict]:
    """Steps of the deck: to where the measurement ends."""

    def step(preset: str, quantity: str, value: float, rows: int) -> dict:
        return {
            "preset": preset,
            "axis": "z",
            "until": {"quantity": quantity, "value": float(value)},
            "rows": rows,
        }

    if test.kind == "oedometer":
        stress = measured["sigma1"]
        ends = [(float(stress[part][0]), float(stress[part][-1])) for part in legs(stress)]
        return [
            step("oedometer_loading" if last > first else "oedometer_unloading", "sig_zz", last, 200)
            for first, last in ends
        ]
    if test.kind == "undrained_cyclic":
        amplitude = test.amplitude or float(np.abs(measured["q"]).max())
        presets = ("undrained_triaxial_compression", "undrained_triaxial_extension")
        return [step(presets[number % 2], "q_signed", amplitude * (-1) ** number, 40) for number in range(2 * CYCLES)]
    preset = {
        "drained_compression": "drained_triaxial_compression",
        "undrained_compression": "undrained_triaxial_compression",
        "undrained_extension": "undrained_triaxial_extension",
    }[test.kind]
    last = float(measured["eps1"][-1])
    return [step(preset, "eps_zz", 0.02 * last, 50), step(preset, "eps_zz", last, 400)]


def write_deck(variants: list[Variant], measured: Series, path: Path) -> None:
    """The deck of all variants of one laboratory test."""
    test = variants[0].test
    axial, lateral = initial_stress(test, measured)
    states = []
    for variant in variants:
        state = {
            "name": variant.name,
            "material": variant.sand,
            "stress": [lateral, lateral, axial, 0, 0, 0],
            "void_ratio": variant.void_ratio,
        }
        states.append(state if variant.start == "none" else state | {"delta": _delta(test, variant.start)})
    deck = {
        "title": f"{test.material}, {test.name}: {test.kind.replace('_', ' ')}",
        "unit": "kPa",
        "sign": "compression_positive",
        "materials": [{"name": sand, "sand": sand} for sand in dict.fromkeys(v.sand for v in variants)],
        "states": states,
        "tests": [{"name": v.name, "state": v.name, "steps": _steps(test, measured)} for v in variants],
    }
    path.write_text(json.dumps(deck, indent=1) + "\n", encoding="utf-8")


def run_deck(deck: Path, directory: Path, variants: list[Variant]) -> list[Computed]:
    """Run a deck into files; a variant that stops early keeps its rows and its reason."""
    with suppress(PhysicalError):  # one has stopped early: the summary says which
        Study(deck).write(directory)
    ends = {test["name"]: test["status_text"] for test in read_summary(directory)["tests"]}
    return [
        Computed(variant, read_computed(directory / f"{variant.name}.csv"), ends[variant.name]) for variant in variants
    ]
