"""What the figures of all papers share."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hypofab.figures import INCH, STYLE
from hypofab.results import Array


@contextmanager
def panels(path: Path, columns: int, *, rows: int = 1, size: tuple[float, float] = (95, 80)) -> Iterator[list[Axes]]:
    """Axes in rows of a figure that is saved as PNG when the block ends.

    size: width and height of one panel [mm].
    """
    with rc_context(STYLE):
        figure = Figure(figsize=(columns * size[0] / INCH, rows * size[1] / INCH), layout="constrained")
        axes = figure.subplots(rows, columns, squeeze=False)
        yield list(axes.flat)
        figure.savefig(path, dpi=110)


def table(head: list[str], rows: list[list[str]]) -> str:
    """A table in Markdown."""
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def fabric_surfaces(path: Path, tensors: dict[str, Array], *, size: float = 80, limit: float = 1.4) -> None:
    """Densities of contact normals 1 + F:nn as surfaces, y upwards, saved as PNG.

    tensors: F, shape (3, 3), by the title of its panel. size: of a panel [mm]. limit: of the axes.
    """
    u, v = np.meshgrid(np.linspace(0, np.pi, 31), np.linspace(0, 2 * np.pi, 61))
    n = np.stack([np.sin(u) * np.cos(v), np.cos(u), np.sin(u) * np.sin(v)])
    with rc_context(STYLE):
        figure = Figure(figsize=(size * len(tensors) / INCH, 1.02 * size / INCH), layout="constrained")
        for index, (title, tensor) in enumerate(tensors.items()):
            x, y, z = n * (1 + np.einsum("i...,ij,j...->...", n, tensor, n))
            axes = figure.add_subplot(1, len(tensors), index + 1, projection="3d")
            axes.plot_surface(x, z, y, color="#7FBFE8", edgecolor="#00508C", linewidth=0.2)
            extent = (-limit, limit)
            axes.set(xlim=extent, ylim=extent, zlim=extent, xlabel="x", ylabel="z", zlabel="y", title=title)
            axes.set_box_aspect((1, 1, 1), zoom=0.8)  # room for the labels
            axes.tick_params(labelsize=6)
        figure.savefig(path, dpi=110)
