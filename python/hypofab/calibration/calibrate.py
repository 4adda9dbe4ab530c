"""Material parameters from laboratory tests: calibration files, mappings with the same keys, and their results.

Everything goes the way of `hypofab calibrate` (docs/calibration.md), with the interpreter's lock released.
"""

import json
import os
import weakref
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hypofab.decks.steps import deck_text
from hypofab.errors import InputError, Status
from hypofab.library import check, core, interruptible, text
from hypofab.results.calibration import CalibrationResult, FreeParameter, LabComparison


class Calibration:
    """A calibration file, or a mapping with its keys: read and validated, measured rows included."""

    def __init__(self, file: "str | os.PathLike | Mapping[str, Any]", *, folder: str | os.PathLike = ".") -> None:
        """Load a file; or take a mapping, whose paths are relative to `folder`."""
        if isinstance(file, Mapping):
            name = os.path.normpath(os.path.join(os.fsdecode(folder), "calibration"))
            status, handle = core.calibration_parse(deck_text(file).encode(), os.fsencode(name))
        else:
            status, handle = core.calibration_load(os.fsencode(file))
        check(status)
        self._handle = int(handle[0])
        weakref.finalize(self, core.calibration_free, self._handle)
        count, self._tests = map(int, core.calibration_size(self._handle))
        described = [core.calibration_parameter(self._handle, index) for index in range(count)]
        self.names = tuple(text(name) for _, name in described)
        """names of the free parameters"""
        self.start, self.lower, self.upper = (np.array([numbers[k] for numbers, _ in described]) for k in range(3))

    def distance(self, values: Sequence[float] | NDArray[np.float64]) -> float:
        """Weighted root-mean-square distance of given values of the free parameters: what the fit makes small."""
        return float(self._distances(values)[0][0])

    def distances(self, values: Sequence[float] | NDArray[np.float64]) -> NDArray[np.float64]:
        """The root-mean-square distance of each fitted test."""
        return self._distances(values)[1]

    def _distances(self, values: Sequence[float] | NDArray[np.float64]) -> tuple:
        numbers = np.asarray(values, dtype=np.float64)
        if numbers.shape != self.start.shape:
            raise InputError(f"{numbers.size} values, expected {self.start.size}", Status.BAD_ARGUMENT)
        status, distance, of_tests = core.calibration_distance(self._handle, numbers, self._tests)
        check(status)
        return distance, of_tests

    def run(self, directory: str | os.PathLike | None = None) -> CalibrationResult:
        """Fit. With a folder, write calibration.json and calibration.md as `hypofab calibrate -o` does."""
        interruptible(lambda stop: check(core.calibration_run(self._handle, stop)))
        if directory is not None:
            check(core.calibration_write(self._handle, os.fsencode(directory)))
        status, report = core.calibration_report(self._handle)
        check(status)
        return CalibrationResult.from_report(json.loads(core.report_take(*map(int, report)).tobytes()))


def calibrate(
    file: "str | os.PathLike | Mapping[str, Any]",
    *,
    folder: str | os.PathLike = ".",
    directory: str | os.PathLike | None = None,
) -> CalibrationResult:
    """Material parameters from laboratory tests: Calibration(file, folder=folder).run(directory)."""
    return Calibration(file, folder=folder).run(directory)


__all__ = ["Calibration", "CalibrationResult", "FreeParameter", "LabComparison", "calibrate"]
