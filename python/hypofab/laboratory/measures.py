"""How far a computed test is from a measured one. Computed rows are interpolated to the measured abscissas."""

from dataclasses import dataclass

import numpy as np

from hypofab.laboratory.catalogue import LabTest
from hypofab.laboratory.series import Series, legs, reversals
from hypofab.tensors import Array


@dataclass(frozen=True)
class Agreement:
    """Of one quantity."""

    quantity: str
    rows: int
    """Measured rows compared."""
    r2: float
    """1 - sum of squared errors over that of the deviations from the mean; negative: worse than the mean."""
    rms: float
    """Root mean square error over the range (largest minus smallest) of what was measured."""
    largest: float
    """Largest error over the range."""
    covered: float
    """Part of the measured rows that the computed test reaches; the others are not compared."""


def agreement(quantity: str, measured: Array, computed: Array) -> Agreement:
    """Compare values at the same abscissas; NaN in the computed ones marks rows that it did not reach."""
    reached = np.isfinite(computed)
    if np.count_nonzero(reached) < 2:
        return Agreement(quantity, 0, float("nan"), float("nan"), float("nan"), 0.0)
    error, value = computed[reached] - measured[reached], measured[reached]
    scatter, span = np.sum((value - value.mean()) ** 2), np.ptp(measured)
    return Agreement(
        quantity,
        int(np.count_nonzero(reached)),
        float(1 - np.sum(error**2) / scatter),
        float(np.sqrt(np.mean(error**2)) / span),
        float(np.abs(error).max() / span),
        float(np.mean(reached)),
    )


def interpolate(at: Array, x: Array, y: Array) -> Array:
    """Values of a computed curve at abscissas; NaN beyond its ends. x is monotonic."""
    order = np.argsort(x, kind="stable")
    margin = 1e-9 * np.abs(x).max()
    inside = (at >= x.min() - margin) & (at <= x.max() + margin)
    return np.where(inside, np.interp(at, x[order], y[order]), np.nan)


def compare(test: LabTest, measured: Series, computed: Series) -> list[Agreement]:
    """The quantities that a test is judged by."""
    if test.kind == "oedometer":
        return [agreement("e", *_oedometer(measured, computed))]
    if test.kind == "undrained_cyclic":
        return [cycles_to_failure(test, measured, computed)]
    quantities = ("q", "eps_v") if test.kind == "drained_compression" else ("q", "p")
    return [
        agreement(name, measured[name], interpolate(measured["eps1"], computed["eps1"], computed[name]))
        for name in quantities
    ]


def _oedometer(measured: Series, computed: Series) -> tuple[Array, Array]:
    """Void ratios at the measured stresses, leg by leg: each is a step of the deck."""
    values, answers = [], []
    for number, part in enumerate(legs(measured["sigma1"]), start=1):
        rows = np.flatnonzero(computed["step"] == number)
        if rows.size == 0:
            answers.append(np.full(part.stop - part.start, np.nan))
        else:
            begin = np.concatenate(([rows[0] - 1] if rows[0] > 0 else [], rows)).astype(int)
            stress, void_ratio = np.log(computed["sigma1"][begin]), computed["e"][begin]
            answers.append(interpolate(np.log(measured["sigma1"][part]), stress, void_ratio))
        values.append(measured["e"][part])
    return np.concatenate(values), np.concatenate(answers)


def half_cycles(test: LabTest, rows: Series) -> int:
    """Reversals of q before the axial strain has left +-1 %."""
    amplitude = test.amplitude or float(np.abs(rows["q"]).max())
    failed = np.flatnonzero(np.abs(rows["eps1"]) > 0.01)
    end = failed[0] if failed.size else len(rows["q"])
    return len(reversals(rows["q"][:end], 0.4 * amplitude))


def cycles_to_failure(test: LabTest, measured: Series, computed: Series) -> Agreement:
    """Cycles until the axial strain reaches 1 %: the relative error of their number; R2 is not defined."""
    wanted, found = half_cycles(test, measured), half_cycles(test, computed)
    error = (found - wanted) / wanted
    return Agreement("cycles", wanted, float("nan"), abs(error), error, 1.0)
