"""Results of element tests, of a run in memory or of `hypofab run`'s files.

Tensors are arrays with the components xx yy zz xy xz yz (tensor components, not engineering shear) in the last axis.
Units and signs are those of the deck: tension positive unless it asked for compression positive.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from numpy.typing import NDArray

from hypofab.drawing import draw
from hypofab.errors import PhysicalError, Status
from hypofab.results.tables import ResultError, read_columns, read_numbers, read_summary
from hypofab.tensors import COMPONENTS, Array

if TYPE_CHECKING:
    from hypofab.drawing import Figure

WHOLE = ("step", "event")
"""Columns of whole numbers."""

EXPECTED = (
    *("time", "step"),
    *(f"{tensor}_{component}" for tensor in ("eps", "sig") for component in COMPONENTS),
    *("void_ratio", "p", "q", "eps_v", "eps_q", "phi_mob", "q_signed"),
)
"""Columns that every test has."""


@dataclass(frozen=True, slots=True, eq=False)
class TestResult:
    """What a test led to: one row for each row of its result file, by the same names."""

    name: str
    rows: NDArray[np.void]
    """structured: rows["eps_zz"], rows["q"], ...; "step" counts from 1"""
    status: Status = Status.OK
    """OK, or the physical reason why the test stopped early; the rows up to there are here"""
    message: str = ""
    stopped_in: int | None = None
    """the step it stopped in, from 1"""
    integrator_steps: int = 0
    evaluations: int = 0
    unit: str = "kPa"
    """of stress"""
    sign: int = 1
    """1: tension is positive, -1: compression is"""
    material: Mapping[str, float] | None = None
    """parameters of the model by name, where they are known; of a run in memory the Material"""
    sensitivities: Mapping[str, Mapping[str, Array]] = field(default_factory=dict)
    """derivatives of the rows: sensitivities["h_s"]["q"] is dq/dh_s; empty unless the test asks for them"""

    __test__ = False  # not a test class for pytest

    @classmethod
    def of_columns(cls, name: str, columns: Mapping[str, Array], **known: Any) -> Self:  # noqa: ANN401 - of the fields
        """A test from its columns by name, in their order; known: its other fields."""
        kinds = [(column, np.int64 if column in WHOLE else np.float64) for column in columns]
        rows = np.empty(len(next(iter(columns.values()))), dtype=kinds)
        for column, values in columns.items():
            rows[column] = values
        return cls(name, rows, **known)

    def __getitem__(self, quantity: str) -> Array:
        """A column of the rows."""
        return self.rows[quantity]

    def __getattr__(self, quantity: str) -> Array:
        """The same as an attribute: result.eps_q is result["eps_q"]."""
        if quantity.startswith("_") or quantity not in (self.rows.dtype.names or ()):
            raise AttributeError(f"neither a field nor a column of a test: {quantity}")
        return self.rows[quantity]

    def tensor(self, quantity: str) -> Array:
        """The columns quantity_xx, quantity_yy, ... as an array (rows, 6)."""
        return np.column_stack([self.rows[f"{quantity}_{component}"] for component in COMPONENTS])

    @property
    def strain(self) -> Array:
        """(rows, 6)"""
        return self.tensor("eps")

    @property
    def stress(self) -> Array:
        """(rows, 6)"""
        return self.tensor("sig")

    @property
    def delta(self) -> Array:
        """Intergranular strain, (rows, 6)."""
        return self.tensor("delta")

    @property
    def cycle(self) -> Array:
        """Cycles done, counted in halves; 0 outside of cycles."""
        return self.rows["cycle"] if "cycle" in (self.rows.dtype.names or ()) else np.zeros(len(self.rows))

    def check(self) -> Self:
        """Raise PhysicalError if the test stopped early; the result itself otherwise."""
        if self.status:
            raise PhysicalError(f"test '{self.name}' stopped early: {self.message}", self.status)
        return self

    def plot(self, kind: str = "stress_strain", **options: Any) -> "Figure":  # noqa: ANN401 - of the figure
        """A figure of this test; kinds, several tests in one figure, and options: hypofab.plot."""
        return draw("memory.plot", self, kind, **options)


@dataclass(frozen=True)
class Run:
    """Results of one deck."""

    unit: str
    """Unit of stress: Pa, kPa or MPa."""
    compression_positive: bool
    """Sign of stress, strain and delta."""
    tests: tuple[TestResult, ...]
    """The tests that ran, in the order of the deck."""


def read_test(path: str | Path, **known: Any) -> TestResult:  # noqa: ANN401 - fields of TestResult
    """Read DIR/<test>.csv as `hypofab run` writes it; the name is that of the file. known: what other files tell."""
    path = Path(path)
    texts = read_columns(path)
    columns = {name: read_numbers(path, texts, name) for name in texts}
    missing = [name for name in EXPECTED if name not in columns]
    if missing:
        raise ResultError(f"{path}: no column {missing[0]}")
    return TestResult.of_columns(path.stem, columns, **known)


def read_run(directory: str | Path) -> Run:
    """Results of `hypofab run`: summary.json and the file of each test that ran."""
    summary = read_summary(directory)
    compression_positive = summary["sign"] == "compression_positive"
    of_all = {"unit": summary["unit"], "sign": -1 if compression_positive else 1}
    counts = ("integrator_steps", "evaluations")
    tests = [
        read_test(
            Path(directory) / test["file"],
            material=test.get("material"),
            status=Status(test.get("status", 0)),
            message=test.get("message") or "",
            stopped_in=len(test["steps"]) if test.get("status") else None,
            **of_all,
            **{name: test.get(name, 0) for name in counts},
        )
        for test in summary["tests"]
        if test["file"] is not None
    ]
    return Run(unit=summary["unit"], compression_positive=compression_positive, tests=tuple(tests))
