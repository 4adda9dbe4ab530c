"""Quasi-random sequences and distributions from Python."""

import math

import numpy as np
import pytest

import hypofab
from hypofab.sampling import SEQUENCES, Distribution, Shape


def test_sequences_have_the_dimensions_that_are_told() -> None:
    for name, most in SEQUENCES.items():
        assert hypofab.quasi_random(name, most, 2).shape == (2, most)
        with pytest.raises(hypofab.InputError, match=f"{most + 1} dimensions of the sequence '{name}'"):
            hypofab.quasi_random(name, most + 1, 2)


def test_a_seed_moves_all_points_alike() -> None:
    plain = hypofab.quasi_random("sobol", 3, 64)
    moved = hypofab.quasi_random("sobol", 3, 64, seed=7)
    assert np.array_equal(moved, hypofab.quasi_random("sobol", 3, 64, seed=7))
    assert np.ptp((moved - plain) % 1, axis=0) == pytest.approx(0, abs=1e-12)
    assert np.array_equal(hypofab.quasi_random("sobol", 3, 54, skip=10), plain[10:])


def test_moments_of_distributions() -> None:
    """Mean and deviation over the quantiles of an even comb, beside the closed forms."""
    comb = (np.arange(20000) + 0.5) / 20000
    uniform = Distribution(Shape.UNIFORM, lower=2, upper=5).quantiles(comb)
    assert uniform.mean() == pytest.approx(3.5)
    assert uniform.std() == pytest.approx(3 / math.sqrt(12), rel=1e-6)
    normal = Distribution(Shape.NORMAL, 4, 2).quantiles(comb)
    assert normal.std() == pytest.approx(2, rel=1e-3)
    # Cut off at one deviation on both sides: variance 1 - 2 phi(1)/(2 Phi(1) - 1).
    cut = Distribution(Shape.NORMAL, 4, 2, 2, 6).quantiles(comb)
    share = math.erf(1 / math.sqrt(2))
    assert cut.std() == pytest.approx(2 * math.sqrt(1 - 2 * math.exp(-0.5) / math.sqrt(2 * math.pi) / share), rel=1e-6)
    lognormal = Distribution(Shape.LOG_NORMAL, math.log(3), 0.2, 0).quantiles(comb)
    assert lognormal.mean() == pytest.approx(3 * math.exp(0.02), rel=1e-4)
