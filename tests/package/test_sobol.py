"""Sobol indices against closed forms."""

import math

import numpy as np
import pytest
from sweep_models import INPUTS, OUTPUTS, deck, fragile, ishigami, linear

import hypofab
from hypofab.sweeps.sobol_indices import sobol_table

CIRCLE = {name: {"uniform": [-math.pi, math.pi]} for name in "xyz"}


def test_ishigami() -> None:
    """Variances: of x 0.5 (1 + b pi^4/5)^2, of y a^2/8, of x and z together 8 b^2 pi^8/225; z alone has none."""
    indices = hypofab.sobol(ishigami, CIRCLE, ["f"], base=4096, workers=1)["f"]
    a, b = 7, 0.1
    first = np.array([0.5 * (1 + b * math.pi**4 / 5) ** 2, a**2 / 8, 0])
    both = 8 * b**2 * math.pi**8 / 225
    variance = first.sum() + both
    assert indices.first == pytest.approx(first / variance, abs=0.01)
    assert indices.total == pytest.approx((first + both * np.array([1, 0, 1])) / variance, abs=0.01)
    assert (np.abs(indices.first - first / variance) < 2 * indices.first_error + 1e-3).all()
    assert (indices.first_error < 0.1).all()
    assert (indices.samples, indices.left_out) == (4096, 0)
    assert "0.55" in sobol_table({"f": indices})


def test_linear_model() -> None:
    """Shares are the squares of the weights times the variances; a constant output has none."""
    inputs = {
        "x": {"uniform": [0, math.sqrt(12)]},
        "y": {"normal": {"mean": 5, "deviation": 1}},
        "z": {"uniform": [0, math.sqrt(12)]},
    }
    found = hypofab.sobol(linear, inputs, ["sum", "constant"], base=2048, seed=1, workers=1)
    assert found["sum"].first == pytest.approx([1 / 14, 4 / 14, 9 / 14], abs=0.01)
    assert found["sum"].total == pytest.approx([1 / 14, 4 / 14, 9 / 14], abs=0.01)
    assert np.isnan(found["constant"].total).all()


def test_indices_of_a_test_and_of_its_curve() -> None:
    indices = hypofab.sobol(deck(), INPUTS, OUTPUTS, base=16, workers=2)
    assert indices["q"].first.shape == (2,)
    assert indices["curve"].total.shape == (2, 5)
    assert np.isnan(indices["curve"].total[:, 0]).all()  # q = 0 at the start
    assert indices["curve"].total[:, -1] == pytest.approx(indices["q"].total, rel=1e-6)
    assert indices["q"].total[0] > indices["q"].total[1] > 0


def test_failed_runs_are_left_out_and_counted() -> None:
    inputs = {"x": {"values": [0, 1, 2, 3]}}
    indices = hypofab.sobol(fragile, inputs, ["y"], base=64, workers=1)["y"]
    assert 0 < indices.left_out < 64
    assert indices.samples + indices.left_out == 64
    assert indices.total == pytest.approx([1], abs=0.35)


def test_refusals() -> None:
    result = hypofab.sweep(ishigami, CIRCLE, {"kind": "halton", "runs": 4}, ["f"], workers=1)
    with pytest.raises(hypofab.InputError, match="the design has kind halton, expected saltelli"):
        hypofab.sobol_indices(result)
    good = hypofab.sweep(ishigami, CIRCLE, {"kind": "saltelli", "base": 4}, ["f"], workers=1)
    with pytest.raises(hypofab.InputError, match="output 'g', expected one of f"):
        hypofab.sobol_indices(good, ["g"])
    with pytest.raises(hypofab.InputError, match="confidence = 95"):
        hypofab.sobol_indices(good, confidence=95)
