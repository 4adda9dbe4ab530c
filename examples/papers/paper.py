#!/usr/bin/env python3
"""DEM runs and element tests beside a paper's results: prints the tables, writes the figures."""

import argparse
import sys
from pathlib import Path

from hypofab import HypofabError
from hypofab.results import ResultError
from papers import PAPERS, compare

ROOT = Path(__file__).resolve().parents[2]


def main() -> None:
    """Compare the runs that are kept, or one's own."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("paper", choices=PAPERS, help="; ".join(f"{name}: {what}" for name, what in PAPERS.items()))
    parser.add_argument(
        "--runs", type=Path, help="folder of runs, or their packed file (examples/dem/results/PAPER.tar.xz)"
    )
    parser.add_argument("--out", type=Path, default=ROOT / "docs/papers/figures", metavar="DIR", help="for the figures")
    options = parser.parse_args()
    runs = options.runs or ROOT / "examples/dem/results" / f"{options.paper}.tar.xz"
    try:
        print(compare(options.paper, runs, options.out))
    except (ResultError, HypofabError) as error:
        sys.exit(f"error: {error}")


if __name__ == "__main__":
    main()
