"""`hypofab calibration DIR`: figures of a calibration."""

import argparse
from pathlib import Path

from hypofab.cli.saving import save
from hypofab.figures import calibration


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The folder of results."""
    parser.add_argument("directory", metavar="DIR", type=Path, help="results of hypofab calibrate")


def run(options: argparse.Namespace) -> None:
    """Draw."""
    calibration.draw(options.directory, save)
