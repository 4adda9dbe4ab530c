"""What `python -m hypofab` does: one command, of which only its own module is loaded."""

import argparse
import sys
from importlib import import_module

from hypofab.cli.commands import COMMANDS
from hypofab.errors import HypofabError, InputError
from hypofab.results.tables import ResultError


def parser(chosen: str = "") -> argparse.ArgumentParser:
    """The command line's parser, with the arguments of the chosen command."""
    top = argparse.ArgumentParser(prog="hypofab", description="Figures, tables and sweeps of hypofab.")
    commands = top.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for name, purpose in COMMANDS.items():
        one = commands.add_parser(name, help=purpose, description=purpose[0].upper() + purpose[1:] + ".")
        if name == chosen:
            module = import_module(f"hypofab.cli.{name}")
            module.add_arguments(one)
            one.set_defaults(run=module.run)
    return top


def main(arguments: list[str] | None = None) -> int:
    """Run one command; 0 done, 1 stopped early, 2 wrong input, 3 internal error."""
    words = sys.argv[1:] if arguments is None else arguments
    options = parser(words[0] if words else "").parse_args(words)
    try:
        return options.run(options) or 0
    except (ResultError, HypofabError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2 if isinstance(error, ResultError | InputError) else 3
