"""`hypofab cycles DIR`: what accumulates in cyclic tests, as a table and a figure."""

import argparse
from pathlib import Path

from hypofab.cli.saving import save
from hypofab.figures.cycles import figure
from hypofab.results.cycles import read_accumulations, table


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The folder of results, and what to show of it."""
    parser.add_argument("directory", metavar="DIR", type=Path, help="results of hypofab run")
    parser.add_argument("--quantity", default="eps_zz", metavar="NAME", help="a result column (default: %(default)s)")
    parser.add_argument("--tests", nargs="+", default=(), metavar="TEST", help="only these of the deck")
    parser.add_argument("--log", action="store_true", help="logarithm of the number of cycles")
    parser.add_argument("--last", type=float, metavar="N", help="draw up to this cycle")
    parser.add_argument("--name", default="cycles", help="of the figures, written to DIR (default: %(default)s)")


def run(options: argparse.Namespace) -> None:
    """Print the table and draw the figure."""
    tests = read_accumulations(options.directory, options.quantity, options.tests)
    print(table(tests, options.quantity))
    drawn = figure(tests, options.quantity, logarithmic=options.log, last=options.last)
    save(drawn, options.directory / options.name)
