"""Fabric, descriptors and delta of contacts, in files or in arrays: the commands describe and delta as Python calls.

    from hypofab.contacts import describe, delta
    found = describe("contacts.txt.gz", particles="particles.txt.gz", friction_angle=30)
    found = describe({"normal": n, "normal_force": f_n, "shear_force": f_t, "branch": l}, volume=1e-6)
    found["forces"]["from_moments"]["a_f"], delta({"normal": n}, c=0.05)["delta"]

What the keys of the results mean: docs/descriptors.md and docs/fabric2delta.md.
"""

import csv
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from hypofab.cli.launch import run, run_json
from hypofab.fabric.contact_files import convert
from hypofab.results.tables import ResultError
from hypofab.tensors import Array

Contacts = str | Path | Mapping[str, Array]
"""A contact file, or arrays with one row per contact (see COLUMNS)."""

CONVERTED = (".h5", ".hdf5", ".npz", ".vtp")
"""Endings of files that the program does not read itself: contact_files converts them first."""

COLUMNS = {
    "id1": ("id1",),
    "id2": ("id2",),
    "normal": ("nx", "ny", "nz"),
    "branch": ("bx", "by", "bz"),
    "position": ("cpx", "cpy", "cpz"),
    "normal_force": ("Fn",),
    "shear_force": ("Fsx", "Fsy", "Fsz"),
    "area": ("area",),
}
"""Arrays of contacts and the columns they become. Vectors point from particle 1 to 2, forces act on particle 2, a
normal force is positive in compression; vectors have the shape (n, 3), or (n, 2) in the plane."""


def describe(contacts: Contacts, **options: object) -> dict:
    """Everything that contacts tell of a sample: what `hypofab describe --json` prints.

    Options are those of the command: particles=FILE or number, volume=V, friction=MU, plane=True, ...
    """
    return _of("describe", contacts, options)


def delta(contacts: Contacts, **options: object) -> dict:
    """The initial intergranular strain of a sample: what `hypofab delta --json` prints. Options: R, c, weight, ..."""
    return _of("delta", contacts, options)


def series(files: Sequence[str | Path], **options: object) -> dict[str, list[str] | Array]:
    """Descriptors of a series of contact files by column, as `hypofab describe --csv` prints them; NaN: not known."""
    rows = list(csv.DictReader(run("describe", *files, "--csv", *_words(options)).splitlines()))
    columns: dict[str, list[str] | Array] = {"file": [row["file"] for row in rows]}
    for name in rows[0]:
        if name != "file":
            columns[name] = np.array([float(row[name] or "nan") for row in rows])
    return columns


def _words(options: Mapping[str, object]) -> list[str]:
    """Options as words of a command line: friction_angle=30 is --friction-angle=30, plane=True is --plane."""
    words = []
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        if value is True:
            words.append(option)
        elif value is not None and value is not False:
            if isinstance(value, Sequence | np.ndarray) and not isinstance(value, str):
                value = ",".join(map(str, value))
            words.append(f"{option}={value}")
    return words


def _of(command: str, contacts: Contacts, options: Mapping[str, object]) -> dict:
    if not isinstance(contacts, Mapping) and Path(contacts).suffix not in CONVERTED:
        return run_json(command, contacts, *_words(options))
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "contacts.npy"
        if isinstance(contacts, Mapping):
            np.save(path, _records(contacts))
        else:
            convert(contacts, path)
        return run_json(command, path, *_words(options))


def _records(contacts: Mapping[str, Array]) -> np.ndarray:
    """The arrays as records, one per contact, with the names that contact files have."""
    fields: dict[str, Array] = {}
    for key, values in contacts.items():
        if key not in COLUMNS:
            raise ResultError(f"contacts have no '{key}'; expected some of {', '.join(COLUMNS)}")
        names, array = COLUMNS[key], np.asarray(values)
        array = array.reshape(len(array), -1)
        if len(names) == 3 and array.shape[1] == 2:
            array = np.column_stack([array, np.zeros(len(array))])
        if array.shape[1] != len(names):
            raise ResultError(f"contacts: '{key}' has {array.shape[1]} columns; expected {len(names)}")
        fields |= dict(zip(names, array.T, strict=True))
    lengths = {name: len(values) for name, values in fields.items()}
    if len(set(lengths.values())) != 1:
        raise ResultError(f"contacts: arrays of different lengths: {lengths}")
    kinds = [(name, "<i8" if name in ("id1", "id2") else "<f8") for name in fields]
    records = np.empty(next(iter(lengths.values())), dtype=kinds)
    for name, values in fields.items():
        records[name] = values
    return records
