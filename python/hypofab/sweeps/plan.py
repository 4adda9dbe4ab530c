"""A sweep as it is told: a file or a mapping, checked, with everything that its runs need."""

import hashlib
import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa

from hypofab.decks.study import Study
from hypofab.errors import InputError, Status
from hypofab.library import version
from hypofab.sweeps.deck_path import PathError, path_text, replaced
from hypofab.sweeps.design import Design, read_design
from hypofab.sweeps.inputs import Input, read_inputs
from hypofab.sweeps.models import BuiltModel, DeckModel, FunctionModel, ManyModel, Model
from hypofab.sweeps.outputs import Output, read_outputs
from hypofab.sweeps.source import Node, Source, read_yaml
from hypofab.sweeps.store import RESERVED, schema_of

_KEYS = ("deck", "inputs", "design", "outputs")
_TRIED = 20  # points of which one at least must give a good deck


@dataclass(frozen=True)
class Plan:
    """What a sweep runs and keeps."""

    model: Model
    inputs: tuple[Input, ...]
    design: Design
    outputs: tuple[Output | str, ...]
    manifest: Mapping[str, Any]
    """"sweep": what makes it this sweep and no other"""

    @property
    def points(self) -> pa.Table:
        """One row per run."""
        return self.design.points

    @property
    def schema(self) -> pa.Schema:
        """Of the results."""
        return schema_of(self.points, self.outputs)


def read_plan(source: Source, folder: str | os.PathLike | None = None, *, many: bool = False) -> Plan:
    """Check a sweep. folder: that of the paths in a deck that is a mapping (default: that of the file, or here).

    many: the deck is a function of many points at once.
    """
    root = Node(source, (), source.root)
    entries = root.mapping(_KEYS, _KEYS)
    deck = entries["deck"]
    if callable(deck.value):
        return _of_function(root, entries, os.fspath(folder or "."), many)
    if many:
        deck.refuse("with many=True a function of arrays")
    if isinstance(deck.value, str | os.PathLike):
        path = Path(deck.value)
        if source.path is not None:
            path = source.path.parent / path
        Study(path)  # messages with the line of the deck file
        mapping, folder = read_yaml(path, plain=True).root, path.parent
    elif isinstance(deck.value, Mapping):
        if folder is None:
            folder = "." if source.path is None else source.path.parent
        mapping = deck.value
        _study(deck, mapping, folder)
    else:
        deck.refuse("the name of a deck file, a deck as a mapping, or a function")
    return _of_deck(root, entries, mapping, os.path.abspath(folder))


def _study(node: Node, deck: Mapping[str, Any], folder: str | os.PathLike) -> Study:
    try:
        return Study(deck, folder=folder)
    except InputError as error:
        node.fail(str(error))


def _of_deck(root: Node, entries: Mapping[str, Node], deck: Mapping[str, Any], folder: str) -> Plan:
    inputs = read_inputs(entries["inputs"], deck=True)
    for one in inputs:
        for path in one.paths:
            try:
                replaced(deck, path, 0)
            except PathError as error:
                Node(root.source, ("inputs", one.name, "path"), path_text(path)).fail(f"{path_text(path)}: {error}")
    design = read_design(entries["design"], inputs)
    tests = {test["name"]: str(test.get("stability")).lower() == "true" for test in deck.get("tests") or ()}
    if not tests:
        entries["deck"].fail("the deck has no tests")
    outputs = read_outputs(entries["outputs"], tests)
    model = DeckModel(deck, folder, {one.name: one.paths for one in inputs}, outputs)
    _try(root, model, inputs, design)
    what = {"deck": deck, "files_sha256": _files(deck, folder)}
    return _plan(root, entries, model, inputs, design, outputs, what)


def _of_function(root: Node, entries: Mapping[str, Node], folder: str, many: bool) -> Plan:
    function: Callable = entries["deck"].value
    inputs = read_inputs(entries["inputs"], deck=False)
    design = read_design(entries["design"], inputs)
    if isinstance(entries["outputs"].value, Mapping) and many:
        entries["outputs"].fail("a function of arrays gives the outputs, expected a list of their names")
    outputs: tuple[Output, ...] | tuple[str, ...]
    if isinstance(entries["outputs"].value, Mapping):
        outputs = of_tests = read_outputs(entries["outputs"], None)
        model: Model = BuiltModel(function, os.path.abspath(folder), of_tests)
    else:
        outputs = names = tuple(item.text("the name of an output") for item in entries["outputs"].items())
        model = (ManyModel if many else FunctionModel)(function, names)
    name = f"{getattr(function, '__module__', '?')}.{getattr(function, '__qualname__', repr(type(function)))}"
    return _plan(root, entries, model, inputs, design, outputs, {"function": name})


def _plan(
    root: Node,
    entries: Mapping[str, Node],
    model: Model,
    inputs: tuple[Input, ...],
    design: Design,
    outputs: tuple[Output, ...] | tuple[str, ...],
    what: Mapping[str, Any],
) -> Plan:
    names = [*RESERVED, *(one.name for one in inputs)]
    for key in (one if isinstance(one, str) else one.name for one in outputs):
        if key in names:
            entries["outputs"].fail(f"the name '{key}' is taken, expected others than {', '.join(names)}")
        names.append(key)
    for one in inputs:
        if one.name in RESERVED:
            entries["inputs"].fail(f"the name '{one.name}' is taken, expected others than {', '.join(RESERVED)}")
    told = {key: _plain(entries[key].value) for key in ("inputs", "design", "outputs")}
    told["design"].pop("points", None)
    identity = {"hypofab": version(), **_plain(what), **told}
    identity |= {"runs": design.points.num_rows, "points_sha256": design.digest()}
    program = {"numpy": np.__version__, "pyarrow": pa.__version__}
    return Plan(model, inputs, design, outputs, {"sweep": identity, "written_with": program})


def _try(root: Node, model: DeckModel, inputs: tuple[Input, ...], design: Design) -> None:
    """Refuse a sweep of which no run would get past the keys of its deck: a wrong path, most often.

    Values that are not admissible are reasons of single runs.
    """
    numbers = np.unique(np.linspace(0, design.points.num_rows - 1, _TRIED).astype(int))
    refusals = []
    for point in design.points.take(pa.array(numbers)).to_pylist():
        try:
            model.study(point)
            return
        except InputError as error:
            if error.status is not Status.BAD_FILE:
                return
            refusals.append((point, str(error)))
    point, reason = refusals[0]
    for one in inputs:
        alone = DeckModel(model.deck, model.folder, {one.name: one.paths}, model.outputs)
        try:
            alone.study(point)
        except InputError as error:
            Node(root.source, ("inputs", one.name, "path"), None).fail(
                f"{', '.join(map(path_text, one.paths))} = {point[one.name]} in the deck: {error}"
            )
    root.fail(f"{len(refusals)} runs were tried, and the deck of none is good; of the first: {reason}")


def _files(value: Any, folder: str, key: str = "") -> dict[str, str]:  # noqa: ANN401 - parts of a deck
    """Files that the deck reads, by the names it has for them, and what is in them."""
    if isinstance(value, Mapping):
        parts = [_files(inside, folder, str(name)) for name, inside in value.items()]
    elif isinstance(value, list | tuple):
        parts = [_files(inside, folder) for inside in value]
    elif key in ("contacts", "particles", "file") and isinstance(value, str | os.PathLike):
        path = os.path.join(folder, value)
        parts = [{os.fspath(value): _digest(path)}] if os.path.isfile(path) else []
    else:
        parts = []
    return {name: digest for part in parts for name, digest in part.items()}


def _digest(path: str) -> str:
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _plain(value: Any) -> Any:  # noqa: ANN401 - anything a sweep is told by
    """What JSON can keep of a value."""
    if isinstance(value, Mapping):
        return {str(key): _plain(inside) for key, inside in value.items()}
    if isinstance(value, bool) or value is None:
        return value
    if isinstance(value, str | os.PathLike):
        return str(os.fspath(value))
    if isinstance(value, np.ndarray):
        return _plain(value.tolist())
    if isinstance(value, int | np.integer):
        return int(value)
    if isinstance(value, float | np.floating):
        return float(value)
    if hasattr(value, "mapping"):
        return _plain(value.mapping())
    if isinstance(value, list | tuple):
        return [_plain(inside) for inside in value]
    return repr(value)
