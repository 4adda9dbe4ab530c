"""The command `hypofab sweep`: its options, and what it says where the packages it needs are not installed."""

import argparse
from importlib import import_module
from pathlib import Path
from types import ModuleType

from hypofab.errors import InputError, Status

EXECUTORS = ("processes", "threads", "dask", "mpi")


def add_arguments(one: argparse.ArgumentParser) -> None:
    """The sweep file, and who runs it."""
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


def run(options: argparse.Namespace) -> int:
    """Run the command; its exit code."""
    return _sweeps().run(options)


def draw(directory: Path) -> None:
    """Draw the figures of a sweep's results, beside them."""
    _sweeps().draw_folder(directory)


def _sweeps() -> ModuleType:
    """What sweeps need packages for."""
    try:
        return import_module("hypofab.cli.sweep_run")
    except ImportError as failure:
        raise InputError(str(failure), Status.BAD_ARGUMENT) from failure
