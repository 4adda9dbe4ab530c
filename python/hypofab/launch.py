"""The command `hypofab` of an installed package: the compiled program, and the Python commands under the same name."""

import os
import sys
from pathlib import Path

PYTHON_COMMANDS = ("plot", "paper", "cycles", "dilatancy", "laboratory", "contacts", "sweep", "calibration")
"""Commands of `python -m hypofab` that the program does not have."""


def packaged_program() -> Path | None:
    """The program that was installed with the package; None in a source tree."""
    path = Path(__file__).parent / "bin" / "hypofab"
    return path if path.exists() else None


def main() -> int:
    """Become the program, or run a Python command."""
    arguments = sys.argv[1:]
    if arguments and arguments[0] in PYTHON_COMMANDS:
        from hypofab.__main__ import main as python_main  # matplotlib, only where it is wanted

        return python_main(arguments)
    program = packaged_program()
    if program is None:
        print("hypofab: the package holds no program; `pip install .` builds it", file=sys.stderr)
        return 3
    os.execv(program, ["hypofab", *arguments])
