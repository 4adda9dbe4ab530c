"""Probes of a state and response envelopes, of memory or of `hypofab envelope`'s files.

Tensors have the components xx yy zz xy xz yz (tensor components) in the last axis; units and signs are the deck's.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, Self

import numpy as np
from numpy.typing import NDArray

from hypofab.drawing import draw
from hypofab.results.tables import ResultError, read_columns, read_json
from hypofab.tensors import COMPONENTS, Array

if TYPE_CHECKING:
    from hypofab.drawing import Figure


@dataclass(frozen=True, slots=True, eq=False)
class Ellipsoid:
    """The ellipsoid (in a plane: ellipse) nearest to an envelope: the image of the unit sphere of directions."""

    centre: Array
    semi_axis: Array
    """lengths, largest first"""
    axis: Array
    """(dimension, 6) their directions"""
    distance: float
    """of the points from the ellipsoid, relative: root mean squares"""
    nonlinearity: float
    """the same from the best centred ellipsoid: 0 for an incrementally linear material"""
    direction: Array
    """along which the points scatter most about the origin"""
    straightness: float
    """share of their mean square along it; 1: a straight line"""
    points: int
    """probes used"""
    distances: Array
    """of each point; NaN for probes without answer"""


class ProbedState(Protocol):
    """What is known of a state that was probed."""

    @property
    def stress(self) -> Array:
        """(6,)"""

    @property
    def memory(self) -> Array:
        """Intergranular strain, (6,); zero where there is none."""


@dataclass(frozen=True, slots=True, eq=False)
class Probes:
    """Probes of a state and what answers them, per unit of what is imposed; NaN where the status is not 0."""

    imposed: str
    """strain or stress"""
    direction: Array
    """(n, 6) unit tensors: of strain, or of stress"""
    response: Array
    """(n, 6) stress answer [stress], or strain answer [1/stress]"""
    irrecoverable: Array
    """(n, 6) what of it is left after unloading; NaN without unloading"""
    status: NDArray[np.intc]
    stiffness: Array
    """(n,) stress over strain, by norms [stress]"""
    work: Array
    """second-order work: cosine between stress and strain increment"""
    dilatancy: Array
    """of the flow; NaN where not known"""
    angle_to_stress: Array
    """between deviators of flow and stress [deg]"""
    angle_to_delta: Array
    """between deviators of flow and intergranular strain [deg]"""
    material: Mapping[str, float]
    """parameters by name; in memory the Material"""
    state: ProbedState
    """what was probed"""
    size: float
    """norm of the increment; 0: rates"""

    def __len__(self) -> int:
        """Number of probes."""
        return len(self.direction)

    def __iter__(self) -> Iterator[tuple[Array, Array]]:
        """Pairs of direction and response."""
        return iter(zip(self.direction, self.response, strict=True))

    @property
    def stress(self) -> Array:
        """Of the state probed."""
        return self.state.stress

    @property
    def delta(self) -> Array:
        """Intergranular strain of the state probed; zero where it has none."""
        return self.state.memory

    @property
    def unloaded(self) -> bool:
        """Is the irrecoverable part known?"""
        return not np.isnan(self.irrecoverable).all()

    def plot(self, **options: Any) -> "Figure":  # noqa: ANN401 - of the figure
        """The figure of these probes; several states in one, and options: hypofab.plot_envelopes."""
        return draw("memory.plot_envelopes", {"": self}, **options)


@dataclass(frozen=True, slots=True, eq=False)
class ProbeSeries(Probes):
    """Probes of one state of an envelope."""

    name: str
    basis: Array
    """Orthonormal tensors that span the directions, shape (dimension, 6)."""
    ellipsoid: Ellipsoid | None
    """Fitted to the responses; None where no fit was possible."""

    @classmethod
    def of(cls, probes: Probes, name: str, basis: Array, ellipsoid: Ellipsoid | None) -> Self:
        """Probes as a series of an envelope."""
        return cls(*(getattr(probes, field.name) for field in fields(Probes)), name, basis, ellipsoid)


@dataclass(frozen=True)
class Envelope:
    """One envelope of a deck."""

    name: str
    unit: str
    """Unit of stress: Pa, kPa or MPa."""
    compression_positive: bool
    directions: str
    """axisymmetric, plane, principal or all_components."""
    imposes_stress: bool
    size: float
    """Of the increment imposed; 0: rates."""
    file: Path
    vtk: Path | None
    """The file of surfaces, where the deck asked for it."""
    series: tuple[ProbeSeries, ...]
    """Those that were computed."""


@dataclass(frozen=True)
class _Probed:
    """A state as far as envelopes.json tells it."""

    stress: Array
    memory: Array


def _ellipsoid(summary: dict[str, Any] | None, distances: Array) -> Ellipsoid | None:
    if summary is None:
        return None
    return Ellipsoid(
        centre=np.array(summary["centre"], dtype=float),
        semi_axis=np.array(summary["semi_axes"], dtype=float),
        axis=np.array(summary["axes"], dtype=float),
        distance=float(summary["distance"]),
        nonlinearity=float(summary["nonlinearity"]),
        direction=np.array(summary["direction"], dtype=float),
        straightness=float(summary["straightness"]),
        points=int(summary["points"]),
        distances=distances,
    )


def _series(path: Path, columns: dict[str, list[str]], summary: dict[str, Any], entry: dict[str, Any]) -> ProbeSeries:
    """One series from the rows of a table and its entry in envelopes.json."""
    rows = np.flatnonzero(np.array(columns["series"]) == summary["name"])
    nothing = np.full(len(rows), np.nan)

    def scalar(name: str) -> Array:
        if name not in columns:
            raise ResultError(f"{path}: no column {name}")
        return np.array(columns[name], dtype=float)[rows]

    def tensor(prefix: str) -> Array:
        return np.column_stack([scalar(f"{prefix}_{component}") for component in COMPONENTS])

    probed = {key: np.array(value, dtype=float) for key, value in summary["probed"].items()}
    return ProbeSeries(
        imposed=entry["impose"],
        direction=tensor("T" if entry["impose"] == "stress" else "D"),
        response=tensor("response"),
        irrecoverable=tensor("irrecoverable") if "irrecoverable_xx" in columns else np.full((len(rows), 6), np.nan),
        status=scalar("status").astype(np.intc),
        stiffness=scalar("stiffness"),
        work=scalar("work"),
        dilatancy=scalar("dilatancy") if "dilatancy" in columns else nothing,
        angle_to_stress=scalar("angle_to_stress"),
        angle_to_delta=scalar("angle_to_delta"),
        material=summary["material"],
        state=_Probed(probed["stress"], probed.get("delta", np.zeros(6))),
        size=entry["size"],
        name=summary["name"],
        basis=np.array(summary["basis"], dtype=float),
        ellipsoid=_ellipsoid(summary["ellipsoid"], scalar("distance")),
    )


def read_probes(directory: str | Path) -> list[Envelope]:
    """The envelopes of a folder, in the order of the deck; ResultError when a file is missing or wrong."""
    path = Path(directory) / "envelopes.json"
    summary = read_json(path)
    envelopes = []
    for entry in summary["envelopes"]:
        computed = [series for series in entry["series"] if "probed" in series]
        if entry["file"] is None or not computed:
            continue
        file = path.with_name(entry["file"])
        columns = read_columns(file)
        envelopes.append(
            Envelope(
                name=entry["name"],
                unit=summary["unit"],
                compression_positive=summary["sign"] == "compression_positive",
                directions=entry["directions"],
                imposes_stress=entry["impose"] == "stress",
                size=entry["size"],
                file=file,
                vtk=None if entry["vtk"] is None else path.with_name(entry["vtk"]),
                series=tuple(_series(file, columns, series, entry) for series in computed),
            )
        )
    return envelopes


def has_probes(directory: str | Path) -> bool:
    """Has a folder an envelopes.json?"""
    return (Path(directory) / "envelopes.json").exists()


def is_classical(envelope: Envelope) -> bool:
    """Is this the response envelope of Gudehus (1979): strain probes in the axisymmetric plane?"""
    return envelope.directions == "axisymmetric" and not envelope.imposes_stress
