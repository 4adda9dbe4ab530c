"""Rooms of the Python package: arrows that point one way, one type of each name, one file that starts programs."""

import ast
from collections import Counter

import pytest
from sources import python_files, python_imports, python_uses

FILES = python_files()
USES = python_uses()
ROOMS = {name.split(".")[1] for name in FILES if name.count(".") > 1}

BELOW = {
    "results": set(),
    "model": {"results"},
    "fabric": {"results"},
    "decks": {"fabric", "model", "results"},
    "calibration": {"decks", "model", "results"},
    "laboratory": {"decks", "model", "results"},
    "sweeps": {"decks", "fabric", "model", "results"},
    "figures": {"decks", "fabric", "laboratory", "model", "results", "sweeps"},
}
"""What a room may import beside itself and the files of the package's own folder; cli may import all."""


def room(name: str) -> str:
    """The folder of a module; "" for those of the package's own folder."""
    parts = name.split(".")
    return parts[1] if len(parts) > 1 and parts[1] in ROOMS else ""


@pytest.mark.parametrize("name", [name for name in FILES if room(name) in BELOW])
def test_arrows_point_down(name: str) -> None:
    assert {room(other) for other in USES[name]} <= BELOW[room(name)] | {room(name), ""}


def test_every_room_has_its_place() -> None:
    assert ROOMS - {"cli"} == set(BELOW)


def test_one_file_starts_programs() -> None:
    users = {name for name, tree in FILES.items() if any(one.startswith("subprocess") for one in python_imports(tree))}
    assert users == {"hypofab.cli.launch"}


def test_one_type_of_each_name() -> None:
    names = [node.name for tree in FILES.values() for node in tree.body if isinstance(node, ast.ClassDef)]
    assert len(names) > 50
    assert [name for name, count in Counter(names).items() if count > 1] == []
