"""Read the result files of `hypofab run` and `hypofab envelope`.

Tensors are arrays with the components xx yy zz xy xz yz (tensor components, not engineering shear) in the last axis.
Units and signs are those of the deck: tension positive unless it asked for compression positive.
"""

import csv
import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

COMPONENTS = ("xx", "yy", "zz", "xy", "xz", "yz")


class ResultError(ValueError):
    """A result file is missing or does not have the expected content; the message names the file."""


@dataclass(frozen=True)
class TestResult:
    """Rows of one element test: scalars of shape (rows,), tensors of shape (rows, 6)."""

    __test__ = False  # not a test class for pytest

    name: str
    time: Array
    step: Array
    strain: Array
    stress: Array
    delta: Array
    void_ratio: Array
    p: Array
    q: Array
    eps_v: Array
    eps_q: Array
    rho: Array
    phi_mob: Array
    q_signed: Array
    cycle: Array
    """Cycles done, counted in halves; 0 outside of cycles."""
    material: Mapping[str, float] | None = None
    """Parameters of the model, where they are known."""


@dataclass(frozen=True)
class Run:
    """Results of one deck."""

    unit: str
    """Unit of stress: Pa, kPa or MPa."""
    compression_positive: bool
    """Sign of stress, strain and delta."""
    tests: tuple[TestResult, ...]
    """The tests that ran, in the order of the deck."""


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


def read_columns(path: Path) -> dict[str, list[str]]:
    """The columns of a CSV file by the names of its header; ResultError when it is no table."""
    try:
        with path.open(newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
    except OSError as error:
        raise ResultError(f"{path}: {error.strerror}") from error
    if len(rows) < 2:
        raise ResultError(f"{path}: expected a header and at least one row")
    header = rows[0]
    for number, row in enumerate(rows[1:], start=2):
        if len(row) != len(header):
            raise ResultError(f"{path}, line {number}: {len(row)} fields where the header has {len(header)}")
    return {name: [row[index] for row in rows[1:]] for index, name in enumerate(header)}


def read_numbers(path: Path, columns: Mapping[str, list[str]], name: str) -> Array:
    """One column as numbers; ResultError when it is missing or holds something else."""
    if name not in columns:
        raise ResultError(f"{path}: no column {name}")
    try:
        return np.array(columns[name], dtype=np.float64)
    except ValueError as error:
        raise ResultError(f"{path}, column {name}: {error}") from error


def read_test(path: str | Path, material: Mapping[str, float] | None = None) -> TestResult:
    """Read DIR/<test>.csv as `hypofab run` writes it; the name is that of the file."""
    path = Path(path)
    columns = read_columns(path)
    if "cycle" not in columns:
        columns["cycle"] = ["0"] * len(next(iter(columns.values())))
    return result_of(path.stem, lambda name: read_numbers(path, columns, name), material)


def result_of(name: str, scalar: Callable[[str], Array], material: Mapping[str, float] | None = None) -> TestResult:
    """A test from its columns, which `scalar` gives by their names."""

    def tensor(prefix: str) -> Array:
        return np.column_stack([scalar(f"{prefix}_{component}") for component in COMPONENTS])

    return TestResult(
        name=name,
        time=scalar("time"),
        step=scalar("step"),
        strain=tensor("eps"),
        stress=tensor("sig"),
        delta=tensor("delta"),
        void_ratio=scalar("void_ratio"),
        p=scalar("p"),
        q=scalar("q"),
        eps_v=scalar("eps_v"),
        eps_q=scalar("eps_q"),
        rho=scalar("rho"),
        phi_mob=scalar("phi_mob"),
        q_signed=scalar("q_signed"),
        cycle=scalar("cycle"),
        material=material,
    )


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


def read_summary(directory: str | Path) -> dict:
    """DIR/summary.json of `hypofab run`."""
    path = Path(directory) / "summary.json"
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise ResultError(f"{path}: {error.strerror}") from error
    except json.JSONDecodeError as error:
        raise ResultError(f"{path}: {error}") from error


def read_run(directory: str | Path) -> Run:
    """Results of `hypofab run`: summary.json and the file of each test that ran."""
    summary = read_summary(directory)
    ran = [test for test in summary["tests"] if test["file"] is not None]
    return Run(
        unit=summary["unit"],
        compression_positive=summary["sign"] == "compression_positive",
        tests=tuple(read_test(Path(directory) / test["file"], test.get("material")) for test in ran),
    )
