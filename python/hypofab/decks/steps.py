"""Decks from objects and mappings: the keys of deck files (docs/deck.md). Objects are tension positive."""

import json
import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from hypofab.errors import InputError, Status
from hypofab.model.materials import Material
from hypofab.model.states import State

Mark = tuple[str, float] | Mapping[str, Any]
"""A quantity and a value: ("eps_zz", -0.1), or a mapping as in decks."""


class Step:
    """A step of an element test. Arguments are the keys of a step in decks; None: not given."""

    def __init__(
        self,
        *,
        name: str | None = None,
        preset: str | None = None,
        control: Mapping[str, Any] | None = None,
        conditions: Sequence[Mapping[str, Any]] | None = None,
        table: Mapping[str, Any] | None = None,
        pore_water: Mapping[str, Any] | None = None,
        until: Mark | None = None,
        stop: Sequence[Mapping[str, Any]] | None = None,
        cycle: Mapping[str, Any] | None = None,
        rows: int | None = None,
        every: Mark | None = None,
        max_time: float | None = None,
        more: Mapping[str, Any] | None = None,
        **parameters: float | str | Sequence[float] | None,
    ) -> None:
        """preset: a named test (hypofab presets), its parameters (axis, rate, lode, ...) as further arguments; or
        control, conditions or table. more: further keys.
        """
        given = locals()
        keys = [key for key in given if key not in ("self", "more", "parameters")]
        given = {key: given[key] for key in keys} | parameters
        self._given = {key: value for key, value in given.items() if value is not None} | dict(more or {})
        for key in ("until", "every"):
            if isinstance(self._given.get(key), tuple):
                quantity, value = self._given[key]
                self._given[key] = {"quantity": quantity, "value": value}

    def __repr__(self) -> str:
        """As it is written."""
        return f"Step({', '.join(f'{key}={value!r}' for key, value in self._given.items())})"

    def __eq__(self, other: object) -> bool:
        """With the same keys and values."""
        return isinstance(other, Step) and self._given == other._given

    __hash__ = None  # type: ignore[assignment] # as Python has it for what can be compared but changed

    def mapping(self) -> dict[str, Any]:
        """The step as decks have it."""
        return dict(self._given)


@dataclass(frozen=True, kw_only=True)
class Test:
    """An element test: a state of a material, and the steps it goes through."""

    material: Material
    state: State
    steps: Sequence[Step | Mapping[str, Any]]
    name: str = "test"
    integrator: str | None = None
    """erk (default), cvode or ida"""
    tolerance: float | None = None
    """relative tolerance of the integrator"""
    stability: bool = False
    """rows with the measures of stability too"""
    sensitivities: Sequence[str] = ()
    """numbers to differentiate the results with respect to: parameters, "void_ratio", "p", "sig_xx", ..."""

    __test__ = False  # not one of pytest's


def deck_of(tests: Iterable[Test]) -> dict[str, Any]:
    """The deck of tests that are objects; stresses are in whatever unit h_s has."""
    deck: dict[str, list] = {"materials": [], "states": [], "tests": []}
    for index, test in enumerate(tests):
        place = f"{index + 1}"
        deck["materials"].append(_material(place, test.material))
        deck["states"].append({"name": place, "material": place} | _state(test.state))
        options: dict[str, Any] = {
            "integrator": test.integrator,
            "tolerance": test.tolerance,
            "stability": test.stability or None,
        }
        options["sensitivities"] = list(test.sensitivities) or None
        deck["tests"].append(
            {"name": test.name, "state": place}
            | {key: value for key, value in options.items() if value is not None}
            | {"steps": [step.mapping() if isinstance(step, Step) else dict(step) for step in test.steps]}
        )
    return deck


def _material(name: str, material: Material) -> dict[str, Any]:
    """The material of a deck; where its intergranular strain is off, the deck says so."""
    is_off = material.model.memory is not None and material.memory_size == 0
    given = {"name": name, "model": material.model.name, "parameters": material.parameters()}
    return given | ({"intergranular": False} if is_off else {})


def _state(state: State) -> dict[str, Any]:
    """The keys of a state that say what it is in."""
    model = state.model
    given: dict[str, Any] = {"stress": state.stress, "void_ratio": state.variables[model.void_ratio]}
    if model.memory is not None:
        given["delta"] = {"components": state.memory} if state.memory.any() else {"zero": True}
    others = {name: value for name, value in state.variables.items() if name not in (model.void_ratio, model.memory)}
    return given | ({"variables": others} if others else {})


def deck_text(deck: Mapping[str, Any]) -> str:
    """A mapping as the text of a deck, every number with all its digits. JSON is YAML."""

    def plain(value: Any) -> Any:  # noqa: ANN401 - what JSON does not know
        if isinstance(value, np.ndarray | np.generic):
            return value.tolist()
        if isinstance(value, os.PathLike):
            return os.fspath(value)
        if isinstance(value, Mapping):
            return dict(value)
        if isinstance(value, Step):
            return value.mapping()
        raise InputError(f"a deck holds no {type(value).__name__}: {value!r}", Status.BAD_ARGUMENT)

    return json.dumps(deck, indent=1, ensure_ascii=False, default=plain)
