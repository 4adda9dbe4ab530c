"""Response envelopes in the axisymmetric plane, as `hypofab envelope` writes them."""

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hypofab.results.tables import ResultError, read_columns, read_numbers
from hypofab.tensors import Array


@dataclass(frozen=True)
class EnvelopeSeries:
    """Response envelope of one state: probes in the axisymmetric plane, in the order of their angle."""

    name: str
    angle: Array
    """Direction of the strain rate [deg], shape (probes,)."""
    axial: Array
    """Axial stress response, shape (probes,)."""
    lateral: Array
    """sqrt(2) times the mean lateral stress response, shape (probes,): the plane is isometric."""
    delta: tuple[float, float]
    """Axial and lateral part of delta/R of the state, in the same isometric measure; (0, 0) without delta."""
    unit: str = "kPa"
    """Unit of stress: Pa, kPa or MPa."""
    compression_positive: bool = False
    """Sign of stress, strain and delta."""


def read_envelope(path: str | Path) -> list[EnvelopeSeries]:
    """Read DIR/<envelope>.csv as `hypofab envelope` writes it: its series in the order of the file."""
    path = Path(path)
    columns = read_columns(path)
    if "series" not in columns:
        raise ResultError(f"{path}: no column series")
    names = np.array(columns["series"])
    angle, axial, lateral, delta_axial, delta_lateral = (
        read_numbers(path, columns, name)
        for name in ("angle", "response_axial", "response_lateral", "delta_axial", "delta_lateral")
    )
    series = []
    for name in dict.fromkeys(columns["series"]):
        rows = np.flatnonzero(names == name)
        rows = rows[np.argsort(angle[rows], kind="stable")]
        delta = (float(delta_axial[rows[0]]), float(delta_lateral[rows[0]]))
        unit = columns["unit"][rows[0]] if "unit" in columns else "kPa"
        opposite = "sign" in columns and columns["sign"][rows[0]] == "compression_positive"
        series.append(EnvelopeSeries(name, angle[rows], axial[rows], lateral[rows], delta, unit, opposite))
    return series


def find_envelopes(directory: str | Path) -> list[Path]:
    """The CSV files of a folder that hold response envelopes, told by their column `series`."""
    paths = []
    for path in sorted(Path(directory).glob("*.csv")):
        with path.open(newline="", encoding="utf-8") as file:
            if "series" in next(csv.reader(file), []):
                paths.append(path)
    return paths
