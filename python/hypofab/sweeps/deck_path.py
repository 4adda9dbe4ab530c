"""Places in a deck: materials[sand].parameters.phi_c. Entries of lists by name, or by number from 0."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

_PATH = re.compile(r"([^.\[\]]+)((?:\[[^\[\]]+\])*)(?:\.|$)")
_EXPECTED = "a path like materials[sand].parameters.phi_c or states[0].void_ratio"


class PathError(Exception):
    """A path that cannot be read, or leads nowhere."""


@dataclass(frozen=True)
class Part:
    """One part of a path."""

    key: str
    in_list: bool
    """an entry of a list, by name or number; else a key of a mapping"""


def parse_path(text: str) -> tuple[Part, ...]:
    """The parts of a path."""
    steps, end = [], 0
    while end < len(text):
        part = _PATH.match(text, end)
        if part is None:
            raise PathError(_EXPECTED)
        steps.append(Part(part[1], False))
        steps += [Part(entry, True) for entry in re.findall(r"\[([^\]]+)\]", part[2])]
        end = part.end()
    if not steps or text.endswith("."):
        raise PathError(_EXPECTED)
    return tuple(steps)


def path_text(path: Sequence[Part]) -> str:
    """The path as it is written."""
    return "".join(f"[{step.key}]" if step.in_list else f".{step.key}" for step in path).removeprefix(".")


def replaced(deck: Any, path: Sequence[Part], value: Any, _done: int = 0) -> Any:  # noqa: ANN401 - parts of a deck
    """A deck with another value at a place. Mappings on the way that are missing are made; the given deck stays."""
    if _done == len(path):
        return value
    step, where = path[_done], path_text(path[:_done]) or "the deck"
    if not step.in_list:
        if deck is not None and not isinstance(deck, Mapping):
            raise PathError(f"{where} is no mapping that could hold '{step.key}'")
        inside = None if deck is None else deck.get(step.key)
        return {**(deck or {}), step.key: replaced(inside, path, value, _done + 1)}
    if not isinstance(deck, Sequence) or isinstance(deck, str):
        raise PathError(f"{where} is no list that could hold [{step.key}]")
    names = [entry.get("name") if isinstance(entry, Mapping) else None for entry in deck]
    if step.key in names:
        index = names.index(step.key)
    elif step.key.isdecimal() and int(step.key) < len(deck):
        index = int(step.key)
    else:
        known = ", ".join(str(name) for name in names if name is not None)
        raise PathError(f"{where} has no entry '{step.key}', expected {f'one of {known}, or ' if known else ''}"
                        f"a number below {len(deck)}")  # fmt: skip
    entries = list(deck)
    entries[index] = replaced(entries[index], path, value, _done + 1)
    return entries
