"""`hypofab schema` against the decks of examples/ and against what the program itself refuses."""

import copy
import json
import os
import subprocess
from pathlib import Path

import jsonschema
import pytest
from ruamel import yaml

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = Path(os.environ.get("HYPOFAB_PROGRAM", ROOT / "build" / "cli" / "hypofab"))
DECKS = sorted((ROOT / "examples").glob("*.yaml"))

pytestmark = pytest.mark.skipif(not PROGRAM.exists(), reason=f"no program {PROGRAM}")


def deck_of(path: Path) -> dict:
    """A deck as an editor sees it: YAML 1.2."""
    return json.loads(json.dumps(yaml.YAML(typ="safe", pure=True).load(path)))


@pytest.fixture(scope="module")
def validator() -> jsonschema.Draft202012Validator:
    printed = subprocess.run([PROGRAM, "schema"], check=True, capture_output=True, text=True).stdout
    schema = json.loads(printed)
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


@pytest.mark.parametrize("path", DECKS, ids=lambda path: path.stem)
def test_the_examples_are_valid(path: Path, validator: jsonschema.Draft202012Validator) -> None:
    assert [error.message for error in validator.iter_errors(deck_of(path))] == []


def without_name(deck: dict) -> None:
    del deck["states"][0]["name"]


def with_unknown_key(deck: dict) -> None:
    deck["tests"][0]["steps"][0]["unitl"] = 1


def with_five_numbers(deck: dict) -> None:
    deck["states"][0].pop("p", None)
    deck["states"][0]["stress"] = [-100, -100, -100, 0, 0]


def with_text_for_a_number(deck: dict) -> None:
    deck["states"][0]["void_ratio"] = "loose"


def with_unknown_preset(deck: dict) -> None:
    deck["tests"][0]["steps"][0]["preset"] = "triaxial"


def with_unknown_unit(deck: dict) -> None:
    deck["unit"] = "bar"


def with_text_for_a_truth(deck: dict) -> None:
    deck["materials"][0]["intergranular"] = "yes"


def with_unknown_quantity(deck: dict) -> None:
    deck["tests"][0]["steps"][0]["until"] = {"quantity": "epsilon", "value": 1}


MISTAKES = [
    *(without_name, with_unknown_key, with_five_numbers, with_text_for_a_number, with_unknown_preset),
    *(with_unknown_unit, with_text_for_a_truth, with_unknown_quantity),
]


@pytest.mark.parametrize("spoil", MISTAKES)
def test_a_mistake_is_found_by_schema_and_program(
    spoil: object, validator: jsonschema.Draft202012Validator, tmp_path: Path
) -> None:
    deck = deck_of(ROOT / "examples" / "oedometer.yaml")
    spoiled = copy.deepcopy(deck)
    spoil(spoiled)
    assert spoiled != deck
    assert not validator.is_valid(spoiled)
    path = tmp_path / "deck.yaml"
    for text, expected in ((deck, 0), (spoiled, 2)):
        path.write_text(json.dumps(text))
        assert subprocess.run([PROGRAM, "check", path], capture_output=True, check=False).returncode == expected
