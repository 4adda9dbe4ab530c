"""Overlays of measured and computed tests."""

from collections.abc import Sequence

from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hypofab.figures.style import COLUMN, STYLE, line_style
from hypofab.laboratory.catalogue import LabTest
from hypofab.laboratory.series import Series
from hypofab.laboratory.variants import Computed

MEASURED = {"color": "0.55", "linewidth": 0, "marker": "o", "markersize": 2.5, "markerfacecolor": "none"}

PANELS = {
    "oedometer": (("sigma1", "e"),),
    "drained_compression": (("eps1", "q"), ("eps1", "eps_v")),
    "undrained_compression": (("eps1", "q"), ("p", "q")),
    "undrained_extension": (("eps1", "q"), ("p", "q")),
    "undrained_cyclic": (("eps1", "q"), ("p", "q")),
}
"""Kind of test -> abscissa and ordinate of each panel."""

LABELS = {
    "sigma1": (r"axial stress $\sigma_1'$ [kPa]", 1.0),
    "e": ("void ratio $e$", 1.0),
    "eps1": (r"axial strain $\varepsilon_1$ [%]", 100.0),
    "eps_v": (r"volumetric strain $\varepsilon_v$ [%]", 100.0),
    "q": ("$q$ [kPa]", 1.0),
    "p": ("$p'$ [kPa]", 1.0),
}
"""Axis title and factor of a quantity."""


def _panel(axes: Axes, pair: tuple[str, str], measured: Series, computed: Sequence[Computed]) -> None:
    (x_label, x_factor), (y_label, y_factor) = (LABELS[name] for name in pair)
    x, y = pair
    every = max(1, len(measured[x]) // 300)
    axes.plot(x_factor * measured[x][::every], y_factor * measured[y][::every], label="measured", **MEASURED)
    for index, run in enumerate(computed):
        label = f"{run.variant.sand}, delta {run.variant.start}"
        axes.plot(x_factor * run.rows[x], y_factor * run.rows[y], label=label, **line_style(index))
    axes.set(xlabel=x_label, ylabel=y_label)
    if x == "sigma1":
        axes.set_xscale("log")
    if y == "eps_v":
        axes.invert_yaxis()


def overlay(test: LabTest, measured: Series, computed: Sequence[Computed]) -> Figure:
    """One test: what was measured as points, every variant as a line."""
    panels = PANELS[test.kind]
    with rc_context(STYLE):
        figure = Figure(figsize=(COLUMN[0] * len(panels), COLUMN[1] * 1.15), layout="constrained")
        axes = figure.subplots(1, len(panels), squeeze=False)[0]
        for axis, pair in zip(axes, panels, strict=True):
            _panel(axis, pair, measured, computed)
        if test.kind == "undrained_cyclic":
            failed = 1.2 * max(abs(measured["eps1"]))
            axes[0].set_xlim(-100 * failed, 100 * failed)
        figure.suptitle(f"{test.material}: {test.name}", fontsize=10)
        figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=2, fontsize=7)
        return figure


def errors(rows: Sequence[dict]) -> Figure:
    """Root mean square errors of every test and quantity, the starts of delta beside each other."""
    with rc_context(STYLE):
        labels = list(dict.fromkeys(f"{row['test']} {row['quantity']}" for row in rows))
        kinds = list(dict.fromkeys((row["sand"], row["start"]) for row in rows))
        figure = Figure(figsize=(1.4 * COLUMN[0], 0.16 * len(labels) + 1.2), layout="constrained")
        axes = figure.subplots()
        for number, (sand, start) in enumerate(kinds):
            chosen = [row for row in rows if (row["sand"], row["start"]) == (sand, start)]
            places = [labels.index(f"{row['test']} {row['quantity']}") for row in chosen]
            sizes = [100 * float(row["rms"]) for row in chosen]
            marker = {"marker": "osD^v<>"[number % 7], "markerfacecolor": "none", "linestyle": "none", "markersize": 4}
            axes.plot(sizes, places, label=f"{sand}, delta {start}", **marker)
        axes.set_yticks(range(len(labels)), labels, fontsize=7)
        axes.invert_yaxis()
        axes.set(xlabel="root mean square error over the measured range [%]", xscale="log")
        axes.set_xticks([2, 5, 10, 20, 50, 100], ["2", "5", "10", "20", "50", "100"])
        axes.minorticks_off()
        figure.legend(*axes.get_legend_handles_labels(), loc="outside upper center", ncols=2, fontsize=7)
        return figure
