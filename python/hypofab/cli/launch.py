"""The compiled program of an installed package: the command `hypofab` becomes it, and Python can call it."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

from hypofab.results.tables import ResultError


def packaged_program() -> Path | None:
    """The program that was installed with the package; None in a source tree."""
    path = Path(__file__).parents[1] / "bin" / "hypofab"
    return path if path.exists() else None


def program() -> str:
    """Path of the program: HYPOFAB_PROGRAM, that of the package, of this source tree's build, of the search path."""
    built = packaged_program() or Path(__file__).parents[3] / "build" / "cli" / "hypofab"
    found = os.environ.get("HYPOFAB_PROGRAM") or (str(built) if built.exists() else shutil.which("hypofab"))
    if not found:
        raise ResultError("hypofab was not found: build it, or name it in HYPOFAB_PROGRAM")
    return found


def run(*arguments: str | Path, accept: tuple[int, ...] = (0,)) -> str:
    """Standard output of the program; ResultError with its message when it ends with another exit code."""
    words = [program(), *map(str, arguments)]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode not in accept:
        raise ResultError(f"{' '.join(words)}: {done.stderr.strip() or done.stdout.strip()}")
    return done.stdout


def run_json(*arguments: str | Path) -> Any:  # noqa: ANN401 - an object, or a list of them
    """The JSON that a command with --json prints."""
    return json.loads(run(*arguments, "--json"))


def main() -> int:
    """Become the program, which hands to this Python what is Python's."""
    path = packaged_program()
    if path is None:
        print("hypofab: the package holds no program; `pip install .` builds it", file=sys.stderr)
        return 3
    os.environ["HYPOFAB_PYTHON"] = sys.executable
    os.execv(path, ["hypofab", *sys.argv[1:]])
