"""What a run computes: a deck with the values of a point put in, or a function. Models travel between processes."""

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from time import perf_counter
from typing import Any

import numpy as np

from hypofab.decks.study import Study
from hypofab.errors import HypofabError, Status
from hypofab.fabric.samples import fabric_of_file
from hypofab.sweeps.deck_path import Part, replaced
from hypofab.sweeps.outputs import Output

Point = Mapping[str, Any]


@dataclass(frozen=True)
class Outcome:
    """Outputs of one run, and the reason when there are none or not all."""

    values: Mapping[str, Any]
    status: Status = Status.OK
    reason: str | None = None


@dataclass(frozen=True)
class DeckModel:
    """A deck in which the inputs have places."""

    deck: Mapping[str, Any]
    folder: str
    """of the paths in the deck"""
    places: Mapping[str, Sequence[tuple[Part, ...]]]
    outputs: tuple[Output, ...]

    def at(self, point: Point) -> Mapping[str, Any]:
        """The deck of a point."""
        deck = self.deck
        for name, paths in self.places.items():
            for path in paths:
                deck = replaced(deck, path, point[name])
        return deck

    def study(self, point: Point) -> Study:
        """The study of a point; InputError if its numbers are not admissible."""
        return Study(with_fabrics(self.at(point), self.folder), folder=self.folder)

    def __call__(self, point: Point) -> Outcome:
        """Run the tests that outputs ask for."""
        return _run(self.study(point), self.outputs)


@dataclass(frozen=True)
class BuiltModel:
    """A function that gives a deck, or tests as objects, for a point."""

    build: Callable[[Point], Any]
    folder: str
    outputs: tuple[Output, ...]

    def __call__(self, point: Point) -> Outcome:
        """Build, and run the tests that outputs ask for."""
        return _run(Study(self.build(dict(point)), folder=self.folder), self.outputs)


@dataclass(frozen=True)
class FunctionModel:
    """A function that gives the outputs for a point: a mapping, numbers in their order, or one number."""

    function: Callable[[Point], Any]
    outputs: tuple[str, ...]

    def __call__(self, point: Point) -> Outcome:
        """Call it."""
        result = self.function(dict(point))
        if not isinstance(result, Mapping):
            result = dict(zip(self.outputs, np.atleast_1d(np.asarray(result, dtype=np.float64)), strict=True))
        return Outcome({name: float(result[name]) for name in self.outputs})


@dataclass(frozen=True)
class ManyModel:
    """A function of many points at once, for what the batch computes: arrays of inputs in, arrays of outputs out."""

    function: Callable[[Mapping[str, np.ndarray]], Any]
    outputs: tuple[str, ...]

    def __call__(self, point: Point) -> Outcome:
        """Call it with one point."""
        return self.of([point])[0]

    def of(self, points: Sequence[Point]) -> list[Outcome]:
        """Call it with several points."""
        result = self.function({name: np.array([point[name] for point in points]) for name in points[0]})
        if not isinstance(result, Mapping):
            result = dict(zip(self.outputs, result if isinstance(result, tuple) else (result,), strict=True))
        columns = {name: np.asarray(result[name], dtype=np.float64) for name in self.outputs}
        for name, column in columns.items():
            if column.shape != (len(points),):
                raise ValueError(f"output '{name}' has the shape {column.shape}, expected ({len(points)},)")
        rows = zip(*(column.tolist() for column in columns.values()), strict=True)
        return [Outcome(dict(zip(columns, row, strict=True))) for row in rows]


Model = DeckModel | BuiltModel | FunctionModel | ManyModel


def _run(study: Study, outputs: Sequence[Output]) -> Outcome:
    results = {}
    status, reason = Status.OK, None
    values = {}
    for output in outputs:
        name = output.test or study.tests[0]
        if name not in results:
            results[name] = study.run_test(name)
            if results[name].status and not status:
                status, reason = results[name].status, f"test '{name}': {results[name].message}"
        values[output.name] = output.of(results[name].rows, not results[name].status)
    return Outcome(values, status, reason)


def run_points(model: Model, runs: Sequence[tuple[int, Point]]) -> list[dict[str, Any]]:
    """Run some points, with their numbers; one row of outputs each, whatever happens to them."""
    if isinstance(model, ManyModel) and len(runs) > 1:
        begun = perf_counter()
        try:
            outcomes = model.of([point for _, point in runs])
        except Exception:  # of one point: they are run one by one below, and it has the reason
            outcomes = []
        seconds = (perf_counter() - begun) / len(runs)
        if outcomes:
            return [row_of(number, outcome, seconds) for (number, _), outcome in zip(runs, outcomes, strict=True)]
    rows = []
    for number, point in runs:
        begun = perf_counter()
        try:
            outcome = model(point)
        except HypofabError as error:
            outcome = Outcome({}, error.status, str(error))
        except Exception as error:  # of the user's function: a reason of this row
            outcome = Outcome({}, Status.INTERNAL_ERROR, f"{type(error).__name__}: {error}")
        rows.append(row_of(number, outcome, perf_counter() - begun))
    return rows


def row_of(number: int, outcome: Outcome, seconds: float) -> dict[str, Any]:
    """The row of a run, without its inputs."""
    end = {"status": int(outcome.status), "reason": outcome.reason, "seconds": seconds}
    return {"run": number, **outcome.values, **end}


@lru_cache(maxsize=64)
def _fabric(
    path: str, particles: str | None, columns: tuple, separator: str, _versions: tuple[tuple[int, int], ...]
) -> tuple[float, ...]:
    count = int(particles) if particles and particles.isdecimal() else particles
    fabric = fabric_of_file(path, particles=count, columns=dict(columns), separator=separator)
    return tuple(fabric.fabric.tolist())


def with_fabrics(deck: Mapping[str, Any], folder: str) -> Mapping[str, Any]:
    """The deck with fabric tensors in the place of contact files, each read once per process."""
    states = deck.get("states")
    if not isinstance(states, Sequence) or isinstance(states, str):
        return deck
    return {**deck, "states": [_with_fabric(state, folder) for state in states]}


def _with_fabric(state: Any, folder: str) -> Any:  # noqa: ANN401 - a part of a deck
    delta = state.get("delta") if isinstance(state, Mapping) else None
    if not isinstance(delta, Mapping) or not isinstance(delta.get("contacts"), str | os.PathLike):
        return state
    rest = dict(delta)
    path = os.path.join(folder, os.fspath(rest.pop("contacts")))
    particles = rest.pop("particles", None)
    if particles is not None:
        particles = str(particles)
        particles = particles if particles.isdecimal() else os.path.join(folder, particles)
    columns = tuple(sorted((str(key), str(value)) for key, value in (rest.pop("columns", None) or {}).items()))
    versions = (_version(path), _version(particles))
    tensor = _fabric(path, particles, columns, str(rest.pop("separator", None) or ""), versions)
    return {**state, "delta": {**rest, "fabric": list(tensor)}}


def _version(path: str | None) -> tuple[int, int]:
    """Time and size of a file: another version of it is read again."""
    try:
        found = os.stat(path or "")
    except OSError:
        return (0, 0)  # reading it says what is wrong
    return (found.st_mtime_ns, found.st_size)
