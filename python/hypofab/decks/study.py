"""Element tests: decks from a file, from a mapping or from objects; results as structured arrays.

A mapping has the keys of a deck file (docs/deck.md). Objects become such a mapping, and every deck goes the way of the
program's: the same bits as `hypofab run`. Rows are in the sign and unit of the deck; objects are tension positive.
"""

import os
import weakref
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hypofab.decks.steps import Step, Test, deck_of, deck_text
from hypofab.decks.stiffness import FitOfC, Stiffness, stiffnesses
from hypofab.errors import InputError, Status
from hypofab.fabric.uncertainty import units_and_replicates
from hypofab.library import check, core, interruptible, last_message, stability_quantities, text
from hypofab.model.materials import Material
from hypofab.model.states import State
from hypofab.results.element_tests import WHOLE, TestResult


class Study:
    """A validated deck, with its contact lists and tables read.

    deck: path of a file, a mapping, or tests as objects. folder: that of the paths in a mapping (default: here).
    """

    def __init__(
        self,
        deck: "str | os.PathLike | Mapping[str, Any] | Test | Iterable[Test]",
        *,
        folder: str | os.PathLike = ".",
    ) -> None:
        """Read and check; InputError names file, line, key, value and what was expected."""
        if isinstance(deck, str | os.PathLike):
            status, handle = core.study_load(os.fsencode(deck))
        else:
            mapping = deck if isinstance(deck, Mapping) else deck_of([deck] if isinstance(deck, Test) else deck)
            name = os.path.normpath(os.path.join(os.fsdecode(folder), "deck"))
            status, handle = core.study_parse(deck_text(mapping).encode(), os.fsencode(name))
        check(status)
        self._handle = int(handle[0])
        weakref.finalize(self, core.study_free, self._handle)
        tests, envelopes, states, self.sign = map(int, core.study_size(self._handle))
        self.unit = text(core.study_unit(self._handle))
        """unit of stress"""
        self.tests, self.envelopes, self.states = (
            tuple(text(core.study_name(self._handle, kind, index)) for index in range(count))
            for kind, count in enumerate((tests, envelopes, states))
        )
        """names"""

    def state(self, name: str) -> tuple[Material, State]:
        """A state of the deck and its material, tension positive; delta of contact lists included."""
        status, material, state = core.study_state(self._handle, self._index(self.states, name, "state"))
        check(status)
        found = Material.from_numbers(material)
        return found, State.from_numbers(state, found.model.name)

    def run_test(self, name: str) -> TestResult:
        """Run one test in memory. A physical end before the last step is in the result, and no exception."""
        return interruptible(lambda stop: self._run(self._index(self.tests, name, "test"), stop))

    def run(self) -> dict[str, TestResult]:
        """Run every test in memory."""
        return {name: self.run_test(name) for name in self.tests}

    def write(self, directory: str | os.PathLike) -> None:
        """Run every test into files as `hypofab run -o` does; then PhysicalError if one stopped early."""
        self._into(core.study_run, directory)

    def write_envelopes(self, directory: str | os.PathLike) -> None:
        """Compute every envelope into files as `hypofab envelope -o` does."""
        self._into(core.study_envelopes, directory)

    def stiffness(
        self,
        *,
        replicates: int = 0,
        seed: int = 1,
        blocks: int = 0,
        level: float = 0.95,
        corrected: bool = False,
    ) -> dict[str, Stiffness]:
        """Directional stiffness of every test, as `hypofab stiffness` prints it.

        replicates: of a bootstrap of the states' contact lists, 20 or more (0: none); blocks: drawn in so many cubes
        along each edge instead of contact by contact. corrected: deltas from fabrics without noise.
        """
        options = (*units_and_replicates("blocks" if blocks else "contacts", replicates, seed, blocks), int(corrected))
        count = len(self.tests)

        def call(stop: NDArray[np.intc]) -> NDArray[np.float64]:
            status, numbers = core.study_stiffness(self._handle, options, level, stop, count)
            check(status)
            return numbers

        return dict(zip(self.tests, stiffnesses(interruptible(call)), strict=True))

    def fit_c(
        self,
        stiffness: Mapping[str, float],
        *,
        lower: float = 0.0,
        upper: float = 0.0,
        level: float = 0.95,
        error: float = 0.0,
        corrected: bool = False,
    ) -> FitOfC:
        """The c that matches given stiffnesses of tests best, in ratio, as `hypofab fit-c` does.

        lower, upper: c is sought between them (0: 1e-3 and 10). error: relative standard error of each given stiffness
        (0: from the residuals).
        """
        names = b"\x1f".join(name.encode() for name in stiffness)
        given = np.array(list(stiffness.values()), dtype=np.float64)
        if not len(given):
            raise InputError("no stiffness given, expected 2 or more", Status.BAD_ARGUMENT)
        options = (lower, upper, level, error, float(corrected))
        status, numbers, computed, ends = core.study_fit_c(self._handle, names, given, options)
        check(status)
        found = dict(zip(stiffness, map(float, computed), strict=True))
        return FitOfC(*map(float, numbers), found, *map(bool, ends))

    def _into(self, call: Any, directory: str | os.PathLike) -> None:  # noqa: ANN401 - a function of the extension
        interruptible(lambda stop: check(call(self._handle, os.fsencode(directory), stop)))

    @staticmethod
    def _index(names: tuple[str, ...], name: str, what: str) -> int:
        if name not in names:
            raise InputError(f"no {what} '{name}', expected one of {', '.join(names)}", Status.BAD_ARGUMENT)
        return names.index(name)

    def _run(self, index: int, stop: NDArray[np.intc]) -> TestResult:
        status, rows, report = core.study_test_run(self._handle, index, stop)
        message = last_message() if status else ""
        count, width, step, integrator_steps, evaluations, varied = map(int, report)
        if status >= Status.BAD_MATERIAL:
            check(status)
        try:
            numbers = core.rows_take(int(rows[0]), count, width)
            derivatives = self._derivatives(index, int(rows[0]), varied, count, width) if varied else {}
        finally:
            core.rows_free(int(rows[0]))
        return TestResult.of_columns(
            self.tests[index],
            self._columns(index, numbers),
            status=Status(status),
            message=message,
            stopped_in=step + 1 if status else None,
            integrator_steps=integrator_steps,
            evaluations=evaluations,
            unit=self.unit,
            sign=self.sign,
            sensitivities=derivatives,
            material=self.state(self.states[core.study_test_state(self._handle, index)])[0],
        )

    def _quantities(self, index: int, width: int) -> list[str]:
        """Names of the quantities in rows of `width` numbers, of which the last are step and event."""
        return [text(core.study_column(self._handle, index, place)) for place in range(width - len(WHOLE))]

    def _columns(self, index: int, numbers: NDArray[np.float64]) -> dict[str, NDArray[np.float64]]:
        """Rows of the extension by the names of result files, in their order: time, step, ..., event."""
        names = self._quantities(index, numbers.shape[1])
        found = dict(zip([*names, *WHOLE], numbers.T, strict=True))
        return {name: found[name] for name in (names[0], WHOLE[0], *names[1:], WHOLE[1])}

    def _derivatives(
        self, index: int, rows: int, varied: int, count: int, width: int
    ) -> dict[str, dict[str, NDArray[np.float64]]]:
        """By the number varied, then by quantity; those of stability have none."""
        quantities = [name for name in self._quantities(index, width) if name not in stability_quantities()]
        values = core.derivatives_take(rows, varied, len(quantities), count)
        names = (text(core.study_sensitivity_name(self._handle, index, k)) for k in range(varied))
        return {name: dict(zip(quantities, of_all, strict=True)) for name, of_all in zip(names, values, strict=True)}


def run(
    deck: "str | os.PathLike | Mapping[str, Any] | Test | Iterable[Test]", *, folder: str | os.PathLike = "."
) -> dict[str, TestResult]:
    """Run the tests of a deck file, a mapping or objects in memory: Study(deck).run()."""
    return Study(deck, folder=folder).run()


def element_test(
    material: Material,
    state: State,
    steps: Step | Mapping[str, Any] | Sequence[Step | Mapping[str, Any]],
    *,
    name: str = "test",
    integrator: str | None = None,
    tolerance: float | None = None,
    stability: bool = False,
    sensitivities: Sequence[str] = (),
) -> TestResult:
    """Run one element test; arguments as in Test."""
    several = [steps] if isinstance(steps, Step | Mapping) else steps
    test = Test(
        material=material,
        state=state,
        steps=several,
        name=name,
        integrator=integrator,
        tolerance=tolerance,
        stability=stability,
        sensitivities=sensitivities,
    )
    return Study(test).run_test(test.name)
