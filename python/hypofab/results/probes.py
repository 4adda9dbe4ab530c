"""Read the probes of `hypofab envelope`: DIR/envelopes.json and the table of each envelope.

Tensors have the components xx yy zz xy xz yz (tensor components) in the last axis; units and signs are the deck's.
"""

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hypofab.results.element_tests import COMPONENTS, Array, ResultError, read_columns

SHEAR_TWICE = np.array([1.0, 1.0, 1.0, 2.0, 2.0, 2.0])
"""Weights of the components in a double contraction."""


@dataclass(frozen=True)
class Ellipsoid:
    """The ellipsoid nearest to an envelope: the image of the unit sphere of directions."""

    centre: Array
    """Tensor, shape (6,)."""
    semi_axes: Array
    """Lengths, shape (dimension,), the largest first."""
    axes: Array
    """Their directions, unit tensors, shape (dimension, 6)."""
    distance: float
    """Of the responses from the ellipsoid, relative root mean square."""
    nonlinearity: float
    """The same from the best ellipsoid around the origin: 0 for an incrementally linear material."""
    straightness: float
    """1: the envelope is a straight line."""
    direction: Array
    """Unit tensor along which the responses scatter most, shape (6,)."""


@dataclass(frozen=True)
class ProbeSeries:
    """Probes of one state."""

    name: str
    stress: Array
    """The state probed, shape (6,)."""
    delta: Array
    """Its intergranular strain, shape (6,)."""
    basis: Array
    """Orthonormal tensors that span the directions, shape (dimension, 6)."""
    direction: Array
    """What was imposed: unit tensors, shape (probes, 6)."""
    response: Array
    """What answered, per unit of what was imposed, shape (probes, 6); NaN without answer."""
    irrecoverable: Array | None
    """What of it is left after unloading."""
    stiffness: Array
    """Stress over strain by norms, shape (probes,)."""
    ellipsoid: Ellipsoid | None
    """Fitted to the responses; None where no fit was possible."""


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


def contraction(a: Array, b: Array) -> Array:
    """Double contraction a:b over the last axis."""
    return (SHEAR_TWICE * a * b).sum(axis=-1)


def coordinates(basis: Array, tensors: Array) -> Array:
    """Coordinates of tensors (..., 6) in the space of a basis (dimension, 6): shape (..., dimension)."""
    return (SHEAR_TWICE * tensors) @ basis.T


def _ellipsoid(summary: dict | None) -> Ellipsoid | None:
    if summary is None:
        return None
    arrays = {key: np.array(summary[key], dtype=float) for key in ("centre", "semi_axes", "axes", "direction")}
    numbers = {key: float(summary[key]) for key in ("distance", "nonlinearity", "straightness")}
    return Ellipsoid(**arrays, **numbers)


def _series(path: Path, columns: dict[str, list[str]], summary: dict, imposed: str) -> ProbeSeries:
    """One series from the rows of a table and its entry in envelopes.json."""
    rows = np.flatnonzero(np.array(columns["series"]) == summary["name"])

    def tensor(prefix: str) -> Array:
        names = [f"{prefix}_{component}" for component in COMPONENTS]
        missing = [name for name in names if name not in columns]
        if missing:
            raise ResultError(f"{path}: no column {missing[0]}")
        return np.array([columns[name] for name in names], dtype=float).T[rows]

    return ProbeSeries(
        name=summary["name"],
        stress=np.array(summary["probed"]["stress"], dtype=float),
        delta=np.array(summary["probed"]["delta"], dtype=float),
        basis=np.array(summary["basis"], dtype=float),
        direction=tensor(imposed),
        response=tensor("response"),
        irrecoverable=tensor("irrecoverable") if "irrecoverable_xx" in columns else None,
        stiffness=np.array(columns["stiffness"], dtype=float)[rows],
        ellipsoid=_ellipsoid(summary["ellipsoid"]),
    )


def read_probes(directory: str | Path) -> list[Envelope]:
    """The envelopes of a folder, in the order of the deck; ResultError when a file is missing or wrong."""
    path = Path(directory) / "envelopes.json"
    try:
        summary = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise ResultError(f"{path}: {error.strerror}") from error
    except json.JSONDecodeError as error:
        raise ResultError(f"{path}: {error}") from error
    envelopes = []
    for entry in summary["envelopes"]:
        computed: Sequence[dict] = [series for series in entry["series"] if "probed" in series]
        if entry["file"] is None or not computed:
            continue
        file = path.with_name(entry["file"])
        columns = read_columns(file)
        imposed = "T" if entry["impose"] == "stress" else "D"
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
                series=tuple(_series(file, columns, series, imposed) for series in computed),
            )
        )
    return envelopes


def has_probes(directory: str | Path) -> bool:
    """Has a folder an envelopes.json?"""
    return (Path(directory) / "envelopes.json").exists()


def is_classical(envelope: Envelope) -> bool:
    """Is this the response envelope of Gudehus (1979): strain probes in the axisymmetric plane?"""
    return envelope.directions == "axisymmetric" and not envelope.imposes_stress
