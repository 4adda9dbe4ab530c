"""Call the program `hypofab`."""

import json
import os
import shutil
import subprocess
from pathlib import Path

from hypofab.cli.launch import packaged_program
from hypofab.results import ResultError


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


def run_json(*arguments: str | Path) -> dict | list:
    """The JSON that a command with --json prints."""
    return json.loads(run(*arguments, "--json"))
