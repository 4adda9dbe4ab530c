"""What the figures of all papers share."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hypofab.figures import INCH, STYLE


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
