"""Which laboratory tests there are: what their files hold and from which state they began."""

import json
from dataclasses import dataclass, field
from pathlib import Path

from hypofab.results.tables import ResultError

KINDS = (
    "oedometer",
    "drained_compression",
    "undrained_compression",
    "undrained_extension",
    "undrained_cyclic",
)
"""Kinds of tests; all but the first are triaxial, from an isotropic state."""


class CatalogueError(ResultError):
    """A catalogue does not say what is needed; the message names the entry."""


@dataclass(frozen=True)
class LabTest:
    """One test of a catalogue. What the file holds in its first row need not be given."""

    name: str
    file: str
    kind: str
    material: str
    """Name of the material in figures and tables."""
    sands: tuple[str, ...]
    """Built-in sands to compute it with."""
    columns: dict[str, tuple[str, float]]
    """Quantity (eps1, eps_v, q, p, e, sigma1) -> column of the file and factor to ratio, kPa, compression positive."""
    void_ratio: float | None = None
    sigma3: float | None = None
    """Cell pressure, effective [kPa]."""
    sigma1: float | None = None
    """Initial axial stress of an oedometer test [kPa]."""
    K0: float | None = None
    """Initial ratio of lateral to axial stress of an oedometer test."""
    from_sigma1: float = 0.0
    """Rows of an oedometer test below this axial stress are left out [kPa]."""
    amplitude: float | None = None
    """Of q in cyclic tests [kPa]."""
    fit_void_ratio: tuple[float, float] | None = None
    """Range to look for the void ratio in, when the file has none."""
    note: str = field(default="")


def load_catalogue(path: Path | None = None) -> list[LabTest]:
    """The tests of a catalogue: a JSON list of objects with the fields of LabTest; None: the built-in one."""
    path = path or Path(__file__).with_name("catalogue.json")
    try:
        entries = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, json.JSONDecodeError) as error:
        raise CatalogueError(f"{path}: {error}") from error
    tests = []
    for number, entry in enumerate(entries, start=1):
        try:
            columns = {key: (str(name), float(factor)) for key, (name, factor) in entry["columns"].items()}
            lists = {key: tuple(entry[key]) for key in ("sands", "fit_void_ratio") if key in entry}
            test = LabTest(**(entry | lists | {"columns": columns}))
        except (KeyError, TypeError, ValueError) as error:
            raise CatalogueError(f"{path}, entry {number}: {error}") from error
        if test.kind not in KINDS:
            raise CatalogueError(f"{path}, entry {number}: kind '{test.kind}', expected one of {', '.join(KINDS)}")
        tests.append(test)
    return tests
