"""Options that every script has."""

import argparse
import sys
from typing import NoReturn

from common.folder import fail


class Parser(argparse.ArgumentParser):
    """An argument parser whose errors end the script with exit code 2, also inside YADE."""

    def error(self, message: str) -> NoReturn:
        """Report wrong options."""
        fail(f"{self.prog}: {message}; --help lists the options")


def parser(description: str, particles: int | None = None) -> Parser:
    """A parser with --out, and with --particles and --seed for scripts that make a sample."""
    top = Parser(description=description, formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    top.add_argument("--out", required=True, help="folder of results; an interrupted run in it is continued")
    top.add_argument("--checkpoint", type=float, default=120.0, metavar="SECONDS", help="time between checkpoints")
    top.add_argument("--seed", type=int, default=1, help="of the random positions and sizes")
    if particles is not None:
        top.add_argument("--particles", type=int, default=particles, help="number of particles")
    return top


def parse(top: argparse.ArgumentParser) -> tuple[argparse.Namespace, dict]:
    """Options, and those of them that decide the result."""
    options = top.parse_args(sys.argv[1:])
    return options, {key: value for key, value in vars(options).items() if key not in ("out", "checkpoint")}
