"""Measured data over computed curves."""

from matplotlib.axes import Axes

from hypofab.results.measured import Measured, quantity

MARKERS = "osD^v<>"


def draw(axes: Axes, data: Measured, names: tuple[str, str], factors: tuple[float, float] = (1.0, 1.0)) -> None:
    """Two quantities of every data set that has both as open grey markers, at most about 200 of a set."""
    for index, (label, columns) in enumerate(data.items()):
        x, y = (quantity(columns, name) for name in names)
        if x is None or y is None:
            continue
        every = max(1, len(x) // 200)
        style = {"marker": MARKERS[index % len(MARKERS)], "markersize": 3.5, "markerfacecolor": "white"}
        style |= {"linestyle": "", "color": "0.35", "markeredgewidth": 0.8, "zorder": 1.8}
        axes.plot(factors[0] * x[::every], factors[1] * y[::every], label=label, **style)
