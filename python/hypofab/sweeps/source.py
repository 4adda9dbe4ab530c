"""Where a value of a sweep file stands, and messages that say so: file, line, key, value, what was expected."""

import math
import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn

from ruamel.yaml import YAML
from ruamel.yaml.error import MarkedYAMLError, YAMLError

from hypofab.errors import InputError, Status

Key = str | int


@dataclass(frozen=True)
class Source:
    """A mapping, and the file it comes from; None: it is an argument of a call."""

    root: Any
    path: Path | None = None

    def line(self, keys: Sequence[Key]) -> int | None:
        """Line of the deepest of these keys that the file has; None without a file."""
        node, line = self.root, None
        for key in keys:
            place = getattr(node, "lc", None)
            if place is None or key not in (place.data or {}):
                break
            line = place.data[key][0] + 1
            node = node[key]
        return line

    def place(self, keys: Sequence[Key]) -> str:
        """File, line and key as messages begin."""
        name = ""
        for key in keys:
            name += f"[{key}]" if isinstance(key, int) else f".{key}" if name else key
        line = self.line(keys)
        parts = [] if self.path is None else [str(self.path) if line is None else f"{self.path}:{line}"]
        return ": ".join([*parts, name] if name else parts or ["sweep"])


@dataclass(frozen=True)
class Node:
    """A value and its keys from the root."""

    source: Source
    keys: tuple[Key, ...]
    value: Any

    def fail(self, what: str) -> NoReturn:
        """Raise InputError with the place."""
        raise InputError(f"{self.source.place(self.keys)}: {what}", Status.BAD_FILE)

    def refuse(self, expected: str) -> NoReturn:
        """Raise InputError with place and value."""
        self.fail(f"{_shown(self.value)}, expected {expected}")

    def mapping(self, known: Iterable[str] | None = None, required: Iterable[str] = ()) -> "dict[str, Node]":
        """The entries of a mapping; known: no other keys than these."""
        if not isinstance(self.value, Mapping):
            self.refuse("a mapping")
        entries = {str(key): Node(self.source, (*self.keys, key), value) for key, value in self.value.items()}
        if known is not None:
            known = tuple(known)
            for key, entry in entries.items():
                if key not in known:
                    entry.fail(f"unknown key, expected one of {', '.join(known)}")
        for key in required:
            if key not in entries:
                self.fail(f"key '{key}' is missing")
        return entries

    def items(self, expected: str = "a list") -> "list[Node]":
        """The entries of a list."""
        if isinstance(self.value, str | bytes) or not isinstance(self.value, Iterable):
            self.refuse(expected)
        return [Node(self.source, (*self.keys, index), value) for index, value in enumerate(self.value)]

    def text(self, expected: str = "a text") -> str:
        """A text that is not empty."""
        if not isinstance(self.value, str) or not self.value:
            self.refuse(expected)
        return str(self.value)

    def one_of(self, choices: Iterable[str]) -> str:
        """One of some words."""
        choices = tuple(choices)
        if self.value not in choices:
            self.refuse(f"one of {', '.join(choices)}")
        return str(self.value)

    def number(self, expected: str = "a number", *, infinite: bool = False) -> float:
        """A number, finite unless allowed otherwise."""
        value = self.value
        if isinstance(value, bool | str) or not hasattr(value, "__float__"):
            self.refuse(expected)
        number = float(value)
        if math.isnan(number) or (math.isinf(number) and not infinite):
            self.refuse(expected)
        return number

    def whole(self, lowest: int, expected: str) -> int:
        """A whole number, not below the lowest."""
        number = self.number(expected)
        if number != int(number) or number < lowest:
            self.refuse(expected)
        return int(number)

    def pair(self, expected: str) -> tuple[float, float]:
        """Two numbers."""
        entries = self.items(expected)
        if len(entries) != 2:
            self.refuse(expected)
        return entries[0].number(expected), entries[1].number(expected)


def _shown(value: object) -> str:
    text = value if isinstance(value, str) else repr(value)
    return text if len(text) <= 60 else text[:57] + "..."


def read_yaml(path: str | os.PathLike, *, plain: bool = False) -> Source:
    """A YAML file. plain: every scalar as the text it is in the file; else numbers, and lines are known."""
    path = Path(path)
    reader = YAML(typ="base", pure=True) if plain else YAML(typ="rt")
    try:
        root = reader.load(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}", Status.BAD_FILE) from error
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: not a text in UTF-8", Status.BAD_FILE) from error
    except MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        line = f":{mark.line + 1}" if mark else ""
        raise InputError(f"{path}{line}: {error.problem or error.context}", Status.BAD_FILE) from error
    except YAMLError as error:
        raise InputError(f"{path}: {error}", Status.BAD_FILE) from error
    return Source(root, path)
