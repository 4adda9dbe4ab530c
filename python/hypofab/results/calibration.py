"""What a calibration found: the report of `hypofab calibrate` (calibration.json) as dataclasses."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from hypofab.results.tables import ResultError

Columns = Mapping[str, NDArray[np.float64]]
"""Arrays of equal length by name: eps1, eps_v, q, p, e, sigma1 (NaN: not measured), leg. Compression positive."""


@dataclass(frozen=True, slots=True)
class FreeParameter:
    """A number that was fitted: a material parameter, or the void ratio at the start of a test."""

    name: str
    value: float
    standard_error: float
    """NaN at a bound, and where the data determine nothing."""
    start: float
    lower: float
    upper: float
    at_bound: int
    """-1: at its lower bound, 1: at its upper, else 0."""


@dataclass(frozen=True, slots=True)
class LabComparison:
    """A laboratory test as measured and as computed."""

    name: str
    kind: str
    use: str
    """"fit", or "check" for a test that was only compared."""
    weight: float
    status: str
    """How the computed test ended."""
    distance: float
    """Root-mean-square distance of the measured points from the curve, in shares of the measured range."""
    start_distance: float
    """The same for the parameters the fit began with."""
    scales: Mapping[str, tuple[float, bool]]
    """Compared quantity -> what a distance of one is in it, and whether its logarithm counts."""
    measured: Columns
    """The rows that were compared."""
    nearest: Columns
    """The nearest points of the computed curve."""
    distances: NDArray[np.float64]
    computed: Columns
    start: Columns
    """The curve of the parameters the fit began with."""


@dataclass(frozen=True, slots=True)
class CalibrationResult:
    """Parameters from laboratory tests, and how well these determine them."""

    title: str
    unit: str
    material: Mapping[str, float]
    """All parameters by name, in the unit of the file."""
    parameters: tuple[FreeParameter, ...]
    correlation: NDArray[np.float64]
    covariance: NDArray[np.float64]
    eigenvalues: NDArray[np.float64]
    """Of the Hessian with unit diagonal, smallest first: a small one is a combination that is not determined."""
    eigenvectors: NDArray[np.float64]
    distance: float
    """Weighted root-mean-square distance of the fitted tests, in shares of the measured range."""
    start_distance: float
    findings: tuple[str, ...]
    """What the data cannot determine, in words."""
    converged: bool
    iterations: int
    fit_distances: tuple[float, ...]
    runs: int
    """Element tests computed."""
    seconds: float
    estimates: Mapping[str, tuple[float, str]]
    """Direct estimates by parameter, and what they come from."""
    tests: tuple[LabComparison, ...]

    def __getitem__(self, name: str) -> FreeParameter:
        """A free parameter by name."""
        return next(parameter for parameter in self.parameters if parameter.name == name)

    @classmethod
    def from_report(cls, report: Mapping[str, Any]) -> Self:
        """From the object in calibration.json."""
        return cls(
            material=report["material"],
            parameters=tuple(FreeParameter(**_numbers(entry)) for entry in report["parameters"]),
            correlation=_array(report["correlation"]),
            covariance=_array(report["covariance"]),
            eigenvalues=_array(report["eigenvalues"]),
            eigenvectors=_array(report["eigenvectors"]),
            findings=tuple(report["findings"]),
            fit_distances=tuple(report["fit_distances"]),
            estimates={name: (item["value"], item["source"]) for name, item in (report["estimates"] or {}).items()},
            tests=tuple(_test(entry) for entry in report["tests"]),
            **{
                key: report[key]
                for key in ("title", "unit", "distance", "start_distance", "converged", "iterations", "runs", "seconds")
            },
        )


def read_calibration(directory: Path) -> CalibrationResult:
    """The result that `hypofab calibrate` wrote to a folder."""
    path = directory / "calibration.json"
    try:
        return CalibrationResult.from_report(json.loads(path.read_text(encoding="utf-8")))
    except OSError as error:
        raise ResultError(f"{path}: {error.strerror}; expected results of `hypofab calibrate`") from error
    except (json.JSONDecodeError, KeyError, TypeError) as error:
        raise ResultError(f"{path}: {error}; expected results of `hypofab calibrate`") from error


def _array(values: list) -> NDArray[np.float64]:
    return np.array(values, dtype=np.float64)  # None becomes NaN


def _numbers(entry: Mapping[str, Any]) -> dict[str, Any]:
    return {key: np.nan if value is None else value for key, value in entry.items()}


def _columns(entry: Mapping[str, list]) -> dict[str, NDArray[np.float64]]:
    return {name: _array(values) for name, values in entry.items()}


def _test(entry: Mapping[str, Any]) -> LabComparison:
    curves: dict[str, Any] = {name: _columns(entry[name]) for name in ("measured", "nearest", "computed", "start")}
    rest = {key: entry[key] for key in ("name", "kind", "use", "weight", "status", "distance", "start_distance")}
    return LabComparison(
        scales={name: (item["scale"], item["log"]) for name, item in entry["quantities"].items()},
        distances=_array(entry["distances"]),
        **curves,
        **_numbers(rest),
    )
