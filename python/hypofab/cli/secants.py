"""`hypofab secants [LABEL=]DIR...`: the table of directional stiffnesses."""

import argparse

from hypofab.cli.saving import labelled
from hypofab.results import secants


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Folders of results."""
    parser.add_argument("runs", nargs="+", metavar="[LABEL=]DIR", type=labelled, help="results of hypofab run")


def run(options: argparse.Namespace) -> None:
    """Print the table."""
    columns = {label or directory.name: secants.secant_stiffness(directory) for label, directory in options.runs}
    print(secants.table(columns | secants.REFERENCES))
