"""The command `hypofab` of an installed package: the compiled program, and the Python commands under the same name."""

import os
import subprocess
import sys
from pathlib import Path

PYTHON_COMMANDS = {
    "plot": "figures as PNG and PDF, written beside the results",
    "sweep": "many runs of a deck: grids, tables, Monte Carlo, Sobol indices",
    "calibration": "figures of a calibration: tests, residuals, correlations",
    "laboratory": "laboratory tests computed beside what was measured: a report",
    "cycles": "what accumulates in cyclic tests, over the number of cycles",
    "dilatancy": "stress-dilatancy and critical states of drained triaxial tests",
    "contacts": "contacts of HDF5, .npz or VTK XML as the .npy that hypofab reads",
    "paper": "DEM runs of examples/dem and element tests beside a paper's results",
}
"""Commands of `python -m hypofab` that the program does not have, and their purposes."""


def packaged_program() -> Path | None:
    """The program that was installed with the package; None in a source tree."""
    path = Path(__file__).parent / "bin" / "hypofab"
    return path if path.exists() else None


def with_python_commands(text: str) -> str:
    """The program's help, which lists its own commands, with those of Python behind them: what shells complete, too."""
    own, blank, rest = text.rpartition("\n\n")
    return own + "".join(f"\n  {name:<11} {purpose}" for name, purpose in PYTHON_COMMANDS.items()) + blank + rest


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
    if arguments[:1] in (["--help"], ["-h"], ["help"]):
        text = subprocess.run([program, "--help"], stdout=subprocess.PIPE, text=True, check=True).stdout
        print(with_python_commands(text), end="")
        return 0
    os.execv(program, ["hypofab", *arguments])
