"""`hypofab contacts FILE OUT.npy`: contacts of other files as those that the program reads."""

import argparse
from pathlib import Path

from hypofab.fabric import contact_files


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Source and target."""
    parser.add_argument("source", metavar="FILE", type=Path, help="ends in " + ", ".join(contact_files.OPENERS))
    parser.add_argument("target", metavar="OUT.npy", type=Path)
    parser.add_argument("--group", help="HDF5: group or dataset; .npz: arrays; .npy without names: names of columns")


def run(options: argparse.Namespace) -> None:
    """Convert."""
    print(f"{contact_files.convert(options.source, options.target, options.group)} contacts")
