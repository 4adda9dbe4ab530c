"""The command `hypofab sweep`: its options, and what it says where the packages it needs are not installed."""

import argparse
from collections.abc import Callable
from pathlib import Path

from matplotlib.figure import Figure

from hypofab.errors import InputError, Status

EXECUTORS = ("processes", "threads", "dask", "mpi")


def add_parser(commands: argparse._SubParsersAction) -> None:
    """Add the command `sweep`."""
    one = commands.add_parser("sweep", help="many runs of a deck: grids, tables, Monte Carlo, Sobol indices")
    one.add_argument("file", metavar="FILE", type=Path, help="deck, inputs, design, outputs: docs/sweeps.md")
    one.add_argument(
        "-o", "--output", metavar="DIR", type=Path, required=True, help="folder; an old sweep goes on there"
    )
    one.add_argument("--workers", metavar="N", type=int, help="processes or threads (default: one per processor)")
    one.add_argument("--executor", choices=EXECUTORS, default="processes", help="what runs it (default: %(default)s)")
    one.add_argument("--scheduler", metavar="ADDRESS", help="of Dask (default: workers on this machine)")
    one.add_argument("--figures", action="store_true", help="figures, too, as PNG and PDF")
    one.add_argument("--quiet", action="store_true", help="no progress bar (none either where stderr is no terminal)")


def is_sweep(directory: Path) -> bool:
    """Does a folder hold a sweep, at its end or on its way?"""
    return (directory / "manifest.json").exists()


def run(options: argparse.Namespace, save: Callable[[Figure, Path], None]) -> int:
    """Run the command; its exit code."""
    try:
        from hypofab.sweeps import command
    except ImportError as failure:
        raise InputError(str(failure), Status.BAD_ARGUMENT) from failure
    return command.run(options, save)


def draw(directory: Path, save: Callable[[Figure, Path], None]) -> None:
    """Draw the figures of a sweep's results, beside them."""
    try:
        from hypofab.cli.sweep import draw as draw_sweep
        from hypofab.sweeps.sweep import read_sweep
    except ImportError as failure:
        raise InputError(str(failure), Status.BAD_ARGUMENT) from failure
    draw_sweep(read_sweep(directory), directory, save)
