"""Completion in bash against the program."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = Path(os.environ.get("HYPOFAB_PROGRAM", ROOT / "build" / "cli" / "hypofab"))
SCRIPT = ROOT / "cli" / "completion" / "hypofab.bash"

pytestmark = pytest.mark.skipif(
    not PROGRAM.exists() or shutil.which("bash") is None, reason=f"no program {PROGRAM}, or no bash"
)


def completed(*words: str) -> list[str]:
    """What bash offers for the last of the words after `hypofab`."""
    line = (
        'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); COMPREPLY=(); _hypofab; '
        'printf "%s\\n" "${COMPREPLY[@]}"'
    )
    command = ["bash", "--norc", "-c", line, "bash", SCRIPT, PROGRAM, *words]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stderr == ""
    return done.stdout.split()


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (("env",), ["envelope"]),
        (("f",), ["fabric", "fit-c"]),
        (("init", "oedometer_"), ["oedometer_loading", "oedometer_unloading"]),
        (("init", "oedometer_loading", "--sa"), ["--sand"]),
        (("init", "oedometer_loading", "--sand", "karl"), ["karlsruhe", "karlsruhe_fine"]),
        (("materials", "hostu"), ["hostun"]),
        (("run", "--outp"), ["--output"]),
        (("run", "exam"), []),
    ],
)
def test_words_are_completed(words: tuple[str, ...], expected: list[str]) -> None:
    assert completed(*words) == expected
