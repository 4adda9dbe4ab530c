"""`hypofab init` writes decks that run, for every preset."""

import os
import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = Path(os.environ.get("HYPOFAB_PROGRAM", ROOT / "build" / "cli" / "hypofab"))

pytestmark = pytest.mark.skipif(not PROGRAM.exists(), reason=f"no program {PROGRAM}")


def hypofab(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=False)


def test_the_deck_of_every_preset_runs_to_its_end(tmp_path: Path) -> None:
    presets = [line for line in hypofab("presets").stdout.splitlines() if line and not line.startswith(" ")]
    assert len(presets) > 20
    for preset in presets:
        deck = tmp_path / f"{preset}.yaml"
        written = hypofab("init", preset, "-o", deck)
        assert (written.returncode, written.stderr) == (0, ""), preset
        done = hypofab("run", deck, "-o", tmp_path / "out")
        assert done.returncode == 0, f"{preset}: {done.stderr}"
        assert len((tmp_path / "out" / f"{preset}.csv").read_text().splitlines()) > 50


def test_every_sand_can_be_chosen(tmp_path: Path) -> None:
    lines = hypofab("materials").stdout.splitlines()
    sands = [line.split()[0] for line in lines if line and not line.startswith(" ")]
    assert "hochstetten_1999" in sands  # without intergranular strain
    for sand in sands:
        deck = tmp_path / f"{sand}.yaml"
        deck.write_text(hypofab("init", "oedometer_loading", "--sand", sand).stdout)
        done = hypofab("check", deck)
        assert done.returncode == 0, done.stderr


def test_nothing_is_overwritten_and_wrong_names_are_refused(tmp_path: Path) -> None:
    deck = tmp_path / "deck.yaml"
    deck.write_text("mine")
    refused = hypofab("init", "oedometer_loading", "-o", deck)
    assert refused.returncode == 2
    assert "File exists" in refused.stderr
    assert deck.read_text() == "mine"
    assert "there is no preset 'oedometer'" in hypofab("init", "oedometer").stderr
    assert hypofab("init", "oedometer_loading", "--sand", "sahara").returncode == 2
    assert "expected the name of a test" in hypofab("init").stderr


def test_presets_stand_in_the_documentation() -> None:
    """Each preset has a row in docs/element_tests.md (`a_loading`, `_unloading` stands for two), with what it takes."""
    text = (ROOT / "docs/element_tests.md").read_text()
    rows = [line.split("|") for line in text.splitlines() if line.startswith("| `")]
    documented = {}
    for row in rows:
        names = re.findall(r"`(\w+)`", row[1])
        for name in names:
            documented[names[0].rpartition("_")[0] + name if name.startswith("_") else name] = row[2]
    blocks = re.findall(r"^(\w+)\n +.+\n +(.+)$", hypofab("presets").stdout, re.MULTILINE)
    assert len(blocks) > 20
    for name, parameters in blocks:
        for parameter in parameters.split():
            assert parameter.startswith("[") or parameter in documented[name], (name, parameter)
