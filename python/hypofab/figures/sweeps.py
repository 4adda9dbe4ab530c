"""Figures of sweeps. Each function returns a matplotlib Figure and shows nothing; all are legible in grey."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure

from hypofab.errors import InputError, Status
from hypofab.figures.style import COLUMN, INCH, STYLE
from hypofab.figures.sweep_labels import abscissa_label, label
from hypofab.sweeps.sobol_indices import SobolIndices
from hypofab.sweeps.sweep import SweepResult
from hypofab.tensors import Array

_BANDS = ((0.05, 0.95, "0.85"), (0.25, 0.75, "0.65"))
_PANEL = (48 / INCH, 42 / INCH)


def scalars(result: SweepResult) -> tuple[str, ...]:
    """Outputs that are one number."""
    return tuple(name for name in result.outputs if result.table[name].type == "double")


def curves(result: SweepResult) -> tuple[str, ...]:
    """Outputs that are curves over a quantity."""
    told = result.manifest["sweep"]["outputs"]
    return tuple(name for name in result.outputs if isinstance(told, Mapping) and "over" in told[name])


def scatter(result: SweepResult, outputs: Sequence[str] | None = None) -> Figure:
    """Each output over each input; crosses at the lower edge stand for runs without this output."""
    rows, columns = list(outputs or scalars(result)), result.inputs
    if not rows:
        raise InputError("no outputs that are one number, expected some", Status.BAD_ARGUMENT)
    with rc_context(STYLE):
        size = (_PANEL[0] * max(len(columns), 1.6), _PANEL[1] * max(len(rows), 1.3))
        figure = Figure(figsize=size, layout="constrained")
        axes = figure.subplots(len(rows), len(columns), squeeze=False, sharex="col", sharey="row")
        many = min(1.0, 30 / len(result) ** 0.5)
        for i, output in enumerate(rows):
            y = result[output]
            for j, name in enumerate(columns):
                x, one = result[name], axes[i, j]
                x = x.astype(str) if x.dtype == object else x
                good = np.isfinite(y)
                one.scatter(
                    x[good],
                    y[good],
                    s=9 * many + 1,
                    color="black",
                    alpha=0.25 + 0.6 * many,
                    linewidths=0,
                    rasterized=len(result) > 2000,
                )
                edge = np.zeros(np.count_nonzero(~good)) + 0.03
                one.scatter(x[~good], edge, s=14, marker="x", color="#D55E00", transform=one.get_xaxis_transform())
                _logarithmic(result, name, one)
            axes[i, 0].set_ylabel(label(result, output))
        for j, name in enumerate(columns):
            axes[-1, j].set_xlabel(label(result, name))
        return figure


def _logarithmic(result: SweepResult, name: str, axes) -> None:  # noqa: ANN001 - matplotlib's Axes
    told = result.manifest["sweep"]["inputs"][name]
    spread = "log_uniform" in told or "log_normal" in told or told.get("range", {}).get("spacing") == "logarithmic"
    if spread:
        axes.set_xscale("log")


def histograms(result: SweepResult, outputs: Sequence[str] | None = None) -> Figure:
    """How often each output has which value, with the median and the quantiles of 5 % and 95 % (dashed)."""
    names = list(outputs or scalars(result))
    if not names:
        raise InputError("no outputs that are one number, expected some", Status.BAD_ARGUMENT)
    with rc_context(STYLE):
        figure = Figure(figsize=(max(1.3 * _PANEL[0] * len(names), COLUMN[0]), 1.4 * _PANEL[1]), layout="constrained")
        for axes, name in zip(figure.subplots(1, len(names), squeeze=False)[0], names, strict=True):
            values = result[name]
            good = values[np.isfinite(values)]
            axes.hist(good, bins="auto" if len(good) > 1 else 1, color="0.75", edgecolor="0.35", linewidth=0.5)
            title = []
            if len(good):
                low, middle, high = np.quantile(good, (0.05, 0.5, 0.95))
                axes.axvline(middle, color="black", linewidth=1.4)
                axes.axvline(low, color="black", linestyle=(0, (4, 2)), linewidth=1)
                axes.axvline(high, color="black", linestyle=(0, (4, 2)), linewidth=1)
                title.append(f"median {middle:.3g}, 90 % from {low:.3g} to {high:.3g}")
            missing = len(values) - len(good)
            if missing:
                title.append(f"{missing} of {len(values)} runs without")
            axes.set_title("\n".join(title), fontsize=7)
            axes.set(xlabel=label(result, name), ylabel="runs")
        return figure


def fan(result: SweepResult, name: str) -> Figure:
    """A curve of all runs: median, and bands that hold half and nine tenths of the runs."""
    if name not in curves(result):
        raise InputError(f"output '{name}' is no curve over a quantity", Status.BAD_ARGUMENT)
    told = result.manifest["sweep"]["outputs"][name]
    x = np.linspace(float(told.get("from", 0.0)), float(told["to"]), int(told["points"]))
    values = result[name]
    reached = np.isfinite(values).any(axis=0)
    x, values = x[reached], values[:, reached]
    with rc_context(STYLE):
        figure = Figure(figsize=COLUMN, layout="constrained")
        axes = figure.add_subplot()
        for low, high, grey in _BANDS:
            band = np.nanquantile(values, (low, high), axis=0)
            axes.fill_between(x, *band, color=grey, linewidth=0, label=f"{100 * low:g} to {100 * high:g} %")
        axes.plot(x, np.nanmedian(values, axis=0), color="black", linewidth=1.5, label="median")
        axes.set(xlabel=abscissa_label(result, name), ylabel=label(result, name))
        axes.locator_params(axis="x", nbins=6)
        if len(x) and x[-1] < x[0]:
            axes.invert_xaxis()
        figure.legend(*axes.get_legend_handles_labels(), loc="outside upper center", ncols=3)
        return figure


def sobol_bars(indices: Mapping[str, SobolIndices]) -> Figure:
    """First-order and total indices of each output that is one number, with their confidence intervals."""
    shown = [one for one in indices.values() if one.first.ndim == 1]
    if not shown:
        raise InputError("no indices of outputs that are one number", Status.BAD_ARGUMENT)
    with rc_context(STYLE):
        size = (max(1.4 * _PANEL[0] * len(shown), COLUMN[0]), 1.5 * _PANEL[1])
        figure = Figure(figsize=size, layout="constrained")
        panels = figure.subplots(1, len(shown), squeeze=False, sharey=True)[0]
        for axes, one in zip(panels, shown, strict=True):
            place = np.arange(len(one.inputs))
            _bars(axes, place - 0.2, one.first, one.first_error, "0.5", "first order")
            _bars(axes, place + 0.2, one.total, one.total_error, "0.85", "total")
            axes.set_xticks(place, one.inputs, rotation=0 if sum(map(len, one.inputs)) < 20 else 45)
            axes.axhline(0, color="0.3", linewidth=0.8)
            axes.set_title(one.output, fontsize=9)
        panels[0].set_ylabel("share of the variance [-]")
        figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=2)
        return figure


def _bars(axes, place: Array, height: Array, error: Array, grey: str, name: str) -> None:  # noqa: ANN001
    whiskers = {"capsize": 2.5, "elinewidth": 0.9, "ecolor": "black"}
    axes.bar(
        place, height, 0.38, yerr=error, color=grey, edgecolor="black", linewidth=0.6, label=name, error_kw=whiskers
    )


def figures_of(result: SweepResult, indices: Mapping[str, SobolIndices] | None = None) -> dict[str, Figure]:
    """All figures that the results have something for, by the names of their files."""
    found: dict[str, Figure] = {}
    if scalars(result):
        found |= {"scatter": scatter(result), "histograms": histograms(result)}
    found |= {f"fan_{name}": fan(result, name) for name in curves(result)}
    if indices and any(one.first.ndim == 1 for one in indices.values()):
        found["sobol"] = sobol_bars(indices)
    return found
