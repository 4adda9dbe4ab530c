"""Completion in bash, zsh and fish against the program: the same words in each."""

import os
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = Path(os.environ.get("HYPOFAB_PROGRAM", ROOT / "build" / "cli" / "hypofab"))
SCRIPTS = ROOT / "cli" / "completion"

pytestmark = pytest.mark.skipif(not PROGRAM.exists(), reason=f"no program {PROGRAM}")


def output(*command: str | Path, **environment: str) -> str:
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=os.environ | environment)
    assert done.stderr == ""
    return done.stdout


def in_bash(*words: str) -> list[str]:
    """What bash offers for the last of the words after `hypofab`."""
    line = (
        'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); COMPREPLY=(); _hypofab; '
        'printf "%s\\n" "${COMPREPLY[@]}"'
    )
    return output("bash", "--norc", "-c", line, "bash", SCRIPTS / "hypofab.bash", PROGRAM, *words).split()


def in_zsh(*words: str) -> list[str]:
    """What the function for zsh hands to zsh, which keeps those with the beginning that was typed."""
    line = (
        "compdef() { }; _files() { }; compadd() { print -rl -- ${(P)argv[-1]} }; "
        "_describe() { print -rl -- ${${(P)argv[-1]}%%:*} }; "
        'source $1; shift; words=("$@"); CURRENT=$#; _hypofab'
    )
    offered = output("zsh", "-f", "-c", line, "zsh", SCRIPTS / "_hypofab", PROGRAM, *words).split()
    return [word for word in offered if word.startswith(words[-1])]


def in_fish(*words: str) -> list[str]:
    """What fish offers, without files and descriptions."""
    line = "source $argv[1]; complete --do-complete (string join ' ' -- $argv[2..])"
    path = f"{PROGRAM.parent}:{os.environ['PATH']}"
    offered = output("fish", "--no-config", "-c", line, SCRIPTS / "hypofab.fish", "hypofab", *words, PATH=path)
    named = [one.split("\t")[0] for one in offered.splitlines()]
    return [word for word in named if word.startswith(words[-1]) and not (ROOT / word).exists()]


SHELLS = {"bash": in_bash, "zsh": in_zsh, "fish": in_fish}


@pytest.mark.parametrize("shell", SHELLS)
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
def test_words_are_completed(
    shell: str, words: tuple[str, ...], expected: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(ROOT)
    if shutil.which(shell) is None:
        pytest.skip(f"{shell} is not installed: its completion was NOT TESTED")
    completed: Callable[..., list[str]] = SHELLS[shell]
    assert sorted(completed(*words)) == expected
