"""Sobol indices: how much of an output's variance each input explains alone (first order), and with others (total)."""

import os
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import Executor
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from hypofab.drawing import draw
from hypofab.errors import InputError, Status
from hypofab.sweeps.sweep import SweepResult, sweep
from hypofab.tensors import Array

if TYPE_CHECKING:
    from hypofab.drawing import Figure


@dataclass(frozen=True, eq=False)
class SobolIndices:
    """Indices of one output; arrays (inputs,), or (inputs, points) of a curve."""

    output: str
    inputs: tuple[str, ...]
    first: Array
    """share of the variance that each input explains alone (estimator of Saltelli et al. 2010)"""
    first_error: Array
    """half the width of its confidence interval, by bootstrap"""
    total: Array
    """share that is left when all others are known (estimator of Jansen 1999)"""
    total_error: Array
    samples: int
    """base samples used"""
    left_out: int
    """base samples in which a run failed, or has no such output"""
    confidence: float

    def plot(self) -> "Figure":
        """A bar chart; several outputs beside each other: hypofab.figures.sweeps.sobol_bars."""
        return draw("sweeps.sobol_bars", {self.output: self})

    def mapping(self) -> dict[str, Any]:
        """As JSON keeps it."""
        arrays = ("first", "first_error", "total", "total_error")
        return {
            "inputs": list(self.inputs),
            **{name: getattr(self, name).tolist() for name in arrays},
            **{name: getattr(self, name) for name in ("samples", "left_out", "confidence")},
        }


def sobol_indices(
    result: SweepResult,
    outputs: Iterable[str] | None = None,
    *,
    confidence: float = 0.95,
    resamples: int = 200,
    seed: int = 0,
) -> dict[str, SobolIndices]:
    """Sobol indices of the outputs of a sweep whose design has the kind saltelli.

    outputs: their names (default: all); confidence, resamples, seed: of the bootstrap intervals.
    Base samples with a run that failed are left out of all estimates.
    """
    design = result.manifest["sweep"]["design"]
    if design["kind"] != "saltelli":
        raise InputError(f"the design has kind {design['kind']}, expected saltelli", Status.BAD_ARGUMENT)
    if not 0 < confidence < 1:
        raise InputError(f"confidence = {confidence}, expected between 0 and 1", Status.BAD_ARGUMENT)
    if len(result) != result.manifest["sweep"]["runs"]:
        raise InputError(
            f"{len(result)} of {result.manifest['sweep']['runs']} runs are done, expected all", Status.BAD_ARGUMENT
        )
    names = result.outputs if outputs is None else tuple(outputs)
    unknown = [name for name in names if name not in result.outputs]
    if unknown:
        raise InputError(f"output '{unknown[0]}', expected one of {', '.join(result.outputs)}", Status.BAD_ARGUMENT)
    return {name: _indices(result, name, confidence, resamples, seed) for name in names}


def _indices(result: SweepResult, name: str, confidence: float, resamples: int, seed: int) -> SobolIndices:
    from SALib.analyze import sobol as analysis  # loads pandas, only where it is wanted

    count = len(result.inputs)
    values = result[name]
    curves = values.reshape(-1, count + 2, *values.shape[1:])
    curves = curves.reshape(*curves.shape[:2], -1)  # base sample, row of the sample, point of the curve
    problem = {"num_vars": count, "names": list(result.inputs), "bounds": [[0, 1]] * count}
    good = np.asarray(np.isfinite(curves).all(axis=1))
    if values.ndim == 1 and good.sum() < 2:
        raise InputError(
            f"output '{name}' has {int(good.sum())} complete base samples, expected 2", Status.BAD_ARGUMENT
        )
    found = np.full((4, count, curves.shape[2]), np.nan)
    for point in range(curves.shape[2]):
        sample = curves[good[:, point], :, point].ravel()
        if len(sample) < 2 * (count + 2) or np.ptp(sample[:: count + 2]) == 0:
            continue  # nothing varies: there are no shares
        indices = analysis.analyze(
            problem,
            sample,
            calc_second_order=False,
            num_resamples=resamples,
            conf_level=confidence,
            seed=seed + 1,  # SALib takes 0 for none
        )
        found[:, :, point] = [indices[key] for key in ("S1", "S1_conf", "ST", "ST_conf")]
    arrays = found[:, :, 0] if values.ndim == 1 else found
    used = int(good.all(axis=1).sum())
    return SobolIndices(name, result.inputs, *arrays, used, len(curves) - used, confidence)


def sobol(
    deck: str | os.PathLike | Mapping[str, Any] | Callable[[dict[str, Any]], Any],
    inputs: Mapping[str, Any],
    outputs: Any,  # noqa: ANN401 - as sweep()
    *,
    base: int = 1024,
    seed: int | None = None,
    sequence: str | None = None,
    confidence: float = 0.95,
    resamples: int = 200,
    many: bool = False,
    into: str | os.PathLike | None = None,
    folder: str | os.PathLike | None = None,
    executor: Executor | None = None,
    workers: int | None = None,
    progress: bool | None = None,
) -> dict[str, SobolIndices]:
    """First-order and total Sobol indices of outputs, by base (inputs + 2) runs.

    base: base samples, best a power of 2; sequence: of the samples (default: sobol up to 20 inputs, then halton); the
    other arguments as of sweep() and sobol_indices().
    """
    design: dict[str, Any] = {"kind": "saltelli", "base": base}
    design |= {key: value for key, value in (("seed", seed), ("sequence", sequence)) if value is not None}
    result = sweep(
        deck,
        inputs,
        design,
        outputs,
        many=many,
        into=into,
        folder=folder,
        executor=executor,
        workers=workers,
        progress=progress,
    )
    return sobol_indices(result, confidence=confidence, resamples=resamples, seed=seed or 0)


def sobol_table(indices: Mapping[str, SobolIndices]) -> str:
    """The indices of numbers (not curves) as a table of text."""
    lines = []
    for name, one in indices.items():
        if one.first.ndim > 1:
            continue
        level = f"{100 * one.confidence:g} %"
        note = f", {one.left_out} left out" if one.left_out else ""
        lines.append(f"{name} ({one.samples} base samples{note})")
        lines.append(f"  {'input':<20} {'first order':>12} {'+/- ' + level:>10} {'total':>12} {'+/- ' + level:>10}")
        for row in zip(one.inputs, one.first, one.first_error, one.total, one.total_error, strict=True):
            lines.append("  {:<20} {:>12.4f} {:>10.4f} {:>12.4f} {:>10.4f}".format(*row))
    return "\n".join(lines)
