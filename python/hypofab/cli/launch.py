"""The command `hypofab` of an installed package: the compiled program, which hands to this Python what is Python's."""

import os
import sys
from pathlib import Path


def packaged_program() -> Path | None:
    """The program that was installed with the package; None in a source tree."""
    path = Path(__file__).parents[1] / "bin" / "hypofab"
    return path if path.exists() else None


def main() -> int:
    """Become the program."""
    program = packaged_program()
    if program is None:
        print("hypofab: the package holds no program; `pip install .` builds it", file=sys.stderr)
        return 3
    os.environ["HYPOFAB_PYTHON"] = sys.executable
    os.execv(program, ["hypofab", *sys.argv[1:]])
