"""Rooms of the package: no circle of files, arrows that point one way, and one type of each name."""

import ast
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest

PACKAGE = Path(__file__).resolve().parents[2] / "python" / "hypofab"
FILES = {
    ".".join(("hypofab", *path.relative_to(PACKAGE).with_suffix("").parts)).removesuffix(".__init__"): path
    for path in PACKAGE.rglob("*.py")
}
TREES = {name: ast.parse(path.read_text(encoding="utf-8")) for name, path in FILES.items()}

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


def imports(tree: ast.AST) -> Iterator[str]:
    """Full names of what is imported, inside functions too, but not for type checkers alone."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.If) and getattr(node.test, "id", "") == "TYPE_CHECKING":
            continue
        if isinstance(node, ast.Import):
            yield from (name.name for name in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield from (f"{node.module}.{name.name}" for name in node.names)
        yield from imports(node)


def home(name: str) -> str | None:
    """The file of the package that an imported name is of."""
    while name and name not in FILES:
        name = name.rpartition(".")[0]
    return name or None


GRAPH = {name: {home(one) for one in imports(tree)} - {None, name} for name, tree in TREES.items()}


def room(name: str) -> str:
    """The folder of a file; "" for those of the package's own folder."""
    parts = name.split(".")
    return parts[1] if len(parts) > 2 or (FILES[name].name == "__init__.py" and len(parts) > 1) else ""


def test_no_circle_of_files() -> None:
    done: set[str] = set()

    def visit(name: str, way: tuple[str, ...]) -> None:
        assert name not in way, " -> ".join((*way[way.index(name) :], name))
        if name not in done:
            for other in sorted(GRAPH[name]):
                visit(other, (*way, name))
            done.add(name)

    for name in GRAPH:
        visit(name, ())
    assert len(done) > 50


@pytest.mark.parametrize("name", [name for name in GRAPH if room(name) in BELOW])
def test_arrows_point_down(name: str) -> None:
    allowed = BELOW[room(name)] | {room(name), ""}
    assert {room(other) for other in GRAPH[name]} <= allowed


def importers(module: str) -> set[str]:
    """The files that import a module that is not the package's."""
    return {name for name, tree in TREES.items() if module in {one.split(".")[0] for one in imports(tree)}}


def test_only_figures_import_matplotlib_and_one_file_starts_the_program() -> None:
    assert {room(name) for name in importers("matplotlib")} - {"papers"} == {"figures"}
    assert importers("subprocess") == {"hypofab.cli.launch"}


def test_one_type_of_each_name() -> None:
    names = [node.name for tree in TREES.values() for node in tree.body if isinstance(node, ast.ClassDef)]
    own = [name for module, tree in TREES.items() if room(module) == "papers" for name in classes(tree)]
    assert not {name for name, count in (Counter(names) - Counter(own)).items() if count > 1}


def classes(tree: ast.Module) -> list[str]:
    """Names of the classes of a file."""
    return [node.name for node in tree.body if isinstance(node, ast.ClassDef)]
