"""Calibration files (docs/calibration.md) from a catalogue of laboratory tests."""

from collections.abc import Collection, Sequence
from pathlib import Path
from typing import Any

from hypofab.laboratory.catalogue import LabTest


def _entry(test: LabTest, directory: Path) -> dict[str, Any]:
    entry: dict[str, Any] = {
        "name": test.name,
        "kind": test.kind,
        "file": str((directory / test.file).resolve()),
        "columns": {key: {"column": name, "factor": factor} for key, (name, factor) in test.columns.items()},
    }
    keys = ("void_ratio", "sigma3", "sigma1", "K0")
    entry |= {key: value for key in keys if (value := getattr(test, key)) is not None}
    if test.kind == "oedometer" and test.from_sigma1:
        entry["from_sigma1"] = test.from_sigma1
    if test.fit_void_ratio is not None:
        entry["free_void_ratio"] = list(test.fit_void_ratio)
    return entry


def calibration_of(
    tests: Sequence[LabTest],
    directory: Path,
    *,
    title: str,
    free: Sequence[str],
    only_compared: Collection[str] = (),
    **keys: Any,  # noqa: ANN401 - further keys of a calibration file
) -> dict[str, Any]:
    """The mapping of a calibration file; `only_compared` names the tests that are not fitted."""
    entries = [
        _entry(test, directory) | ({"use": "check"} if test.name in only_compared else {})
        for test in tests
        if (directory / test.file).exists()
    ]
    return {"calibration": title, "free": list(free), "tests": entries} | keys
