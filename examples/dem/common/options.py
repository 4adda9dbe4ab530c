"""Options that every script has, and the bounds of numbers in options."""

import argparse
import itertools
import math
import sys
from collections.abc import Callable
from typing import NoReturn

from common.folder import fail

FEWEST = 40
"""Particles of the smallest sample: fewer do not fill a periodic cell."""


def number(low: float, high: float = math.inf, *, above: bool = False) -> Callable[[str], float]:
    """The type of an option: a finite number from low to below high, or above low.

    Its errors say what was expected.
    """
    expected = f"a number {'above' if above else 'of at least'} {low:g}" + (
        f" and below {high:g}" if high < math.inf else ""
    )

    def check(text: str) -> float:
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not low <= value < high or (above and value == low):
            raise argparse.ArgumentTypeError(f"{text}: expected {expected}")
        return value

    return check


positive = number(0.0, above=True)
not_negative = number(0.0)


def whole(low: int) -> Callable[[str], int]:
    """The type of an option: a whole number of at least low."""

    def check(text: str) -> int:
        if not text.isdecimal() or int(text) < low:
            raise argparse.ArgumentTypeError(f"{text}: expected a whole number of at least {low}")
        return int(text)

    return check


def ascending(kind: Callable[[str], float]) -> Callable[[str], list]:
    """The type of an option: numbers of a kind with commas between, each larger than the one before."""

    def check(text: str) -> list:
        values = [kind(word) for word in text.split(",") if word]
        if any(b <= a for a, b in itertools.pairwise(values)):
            raise argparse.ArgumentTypeError(f"{text}: expected numbers that grow")
        return values

    return check


class Parser(argparse.ArgumentParser):
    """An argument parser whose errors end the script with exit code 2, also inside YADE."""

    def error(self, message: str) -> NoReturn:
        """Report wrong options."""
        fail(f"{self.prog}: {message}; --help lists the options")


def parser(description: str, particles: int | None = None) -> Parser:
    """A parser with --out, --checkpoint and --seed, and with --particles for scripts that make a sample."""
    top = Parser(description=description, formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    top.add_argument("--out", required=True, help="folder of results; an interrupted run in it is continued")
    top.add_argument(
        "--checkpoint", type=not_negative, default=120.0, metavar="SECONDS", help="time between checkpoints"
    )
    seed = (
        "of the random positions and sizes" if particles else "kept in the manifest; this script uses no random numbers"
    )
    top.add_argument("--seed", type=whole(0), default=1, help=seed)
    if particles is not None:
        top.add_argument("--particles", type=whole(FEWEST), default=particles, help="number of particles")
    return top


def parse(top: argparse.ArgumentParser) -> tuple[argparse.Namespace, dict]:
    """Options, and those of them that decide the result."""
    options = top.parse_args(sys.argv[1:])
    return options, {key: value for key, value in vars(options).items() if key not in ("out", "checkpoint")}
