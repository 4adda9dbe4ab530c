"""Directional stiffnesses of the tests of a deck, and the c that fits given ones (docs/uncertainty.md)."""

from dataclasses import dataclass

import numpy as np

from hypofab.fabric.uncertainty import Interval
from hypofab.tensors import Array


@dataclass(frozen=True, slots=True, eq=False)
class Stiffness:
    """Directional stiffness of a test: secant q/eps_q at the end of its first step. NaN without a bootstrap."""

    value: float
    interval: Interval
    relative: float
    """to the test that is lowest"""
    relative_interval: Interval


@dataclass(frozen=True, slots=True, eq=False)
class FitOfC:
    """The c of f(a) = 1 - exp(-a/c) that matches given directional stiffnesses best."""

    c: float
    lower: float
    """interval of c; NaN where neither residuals nor errors give one"""
    upper: float
    misfit: float
    """root-mean-square of ln(given/(factor computed))"""
    factor: float
    """given over computed stiffness, common to all tests"""
    stiffness: dict[str, float]
    """computed"""
    lower_open: bool
    """the interval goes on beyond the range that was searched"""
    upper_open: bool
    at_lower: bool
    """c is at an end of the range"""
    at_upper: bool


def stiffnesses(numbers: Array) -> list[Stiffness]:
    """Rows of the extension as objects."""
    rows = ((float(row[0]), Interval(*row[1:4]), float(row[4]), Interval(*row[5:8])) for row in np.asarray(numbers))
    return [Stiffness(*row) for row in rows]
