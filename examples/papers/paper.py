"""`hypofab paper PAPER`: DEM runs and element tests beside a paper's results."""

import argparse
from pathlib import Path

from hypofab import papers

SOURCE = Path(__file__).parents[3]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The paper, its runs, and where its figures go."""
    parser.add_argument("paper", choices=papers.PAPERS, help="; ".join(f"{k}: {v}" for k, v in papers.PAPERS.items()))
    parser.add_argument("--runs", type=Path, metavar="DIR", help="run folders (examples/dem/results/PAPER)")
    parser.add_argument(
        "--out", type=Path, default=SOURCE / "docs/papers/figures", metavar="DIR", help="for the figures"
    )


def run(options: argparse.Namespace) -> None:
    """Print the tables and write the figures."""
    runs = options.runs or SOURCE / "examples/dem/results" / options.paper
    print(papers.compare(options.paper, runs, options.out))
