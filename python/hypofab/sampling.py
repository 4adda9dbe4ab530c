"""Quasi-random sequences and distributions of one number, those of the library (hypofab_sampling.h)."""

import math
from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import ArrayLike

from hypofab.library import check, core
from hypofab.tensors import Array

SEQUENCES = {"sobol": 40, "halton": 1229, "reverse_halton": 1229, "niederreiter": 12}
"""Sequences and their most dimensions."""


def quasi_random(sequence: str, dimension: int, n: int, *, skip: int = 0, seed: int | None = None) -> Array:
    """Points of a quasi-random sequence in the unit cube, (n, dimension).

    sequence: "sobol" (up to 40 dimensions), "halton", "reverse_halton" (1229) or "niederreiter" (12).
    skip: points left out at the start. seed: all points are moved by the same random vector, modulo 1 (Cranley and
    Patterson 1976), so that results of several seeds are independent; None: the sequence itself.
    """
    status, points = core.quasi_random(sequence.encode(), skip, n, dimension)
    check(status)
    if seed is not None:
        points = (points + np.random.default_rng(seed).random(dimension)) % 1.0
    return points


class Shape(IntEnum):
    """Shapes of a distribution, as in hypofab_sampling.h."""

    UNIFORM = 0
    LOG_UNIFORM = 1
    NORMAL = 2
    LOG_NORMAL = 3


@dataclass(frozen=True)
class Distribution:
    """Distribution of one number. Of LOG_NORMAL, mean and deviation are those of the logarithm."""

    shape: Shape
    mean: float = 0.0
    deviation: float = 1.0
    """mean and standard deviation of the normal distribution before it is cut off"""
    lower: float = -math.inf
    upper: float = math.inf

    def _numbers(self) -> tuple[float, float, float, float]:
        return self.mean, self.deviation, self.lower, self.upper

    def quantiles(self, probabilities: ArrayLike) -> Array:
        """Values below which these shares of the distribution are."""
        wanted = np.atleast_1d(np.asarray(probabilities, dtype=np.float64))
        status, values = core.quantiles(self.shape, self._numbers(), wanted.ravel())
        check(status)
        return values.reshape(wanted.shape)

    def probabilities(self, values: ArrayLike) -> Array:
        """Shares of the distribution below these values."""
        given = np.atleast_1d(np.asarray(values, dtype=np.float64))
        status, probabilities = core.probabilities(self.shape, self._numbers(), given.ravel())
        check(status)
        return probabilities.reshape(given.shape)
