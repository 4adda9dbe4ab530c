"""The folder of a sweep: manifest, rows as they come, and one Parquet table in the end.

Rows are written to whole Parquet files in DIR/rows, by a temporary file that is renamed: a process that is killed
leaves only whole files behind, and what it had not written is run again. In the end they become DIR/results.parquet,
in the order of the runs.
"""

import fcntl
import json
import os
import time
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, Self

import numpy as np
import pyarrow as pa
import pyarrow.parquet as parquet

from hypofab.errors import InputError, InternalError, Status
from hypofab.sweeps.outputs import Output

RESERVED = ("run", "status", "reason", "seconds")
_SHORTEST, _LONGEST, _SHARE = 1.0, 60.0, 0.01  # between two writings: [s], [s], of the time so far


def schema_of(points: pa.Table, outputs: Sequence[Output | str]) -> pa.Schema:
    """Columns of the results: run, inputs, outputs (numbers; curves as lists), status, reason, seconds."""
    number, curve = pa.float64(), pa.list_(pa.float64())
    kinds = [
        (one, number) if isinstance(one, str) else (one.name, curve if one.is_curve else number) for one in outputs
    ]
    last = [("status", pa.int32()), ("reason", pa.string()), ("seconds", pa.float64())]
    return pa.schema([pa.field("run", pa.int64()), *points.schema, *kinds, *last])


def table_of(rows: Sequence[Mapping[str, Any]], points: pa.Table, schema: pa.Schema) -> pa.Table:
    """Rows with the inputs of their points. Numbers that a row does not have are NaN."""
    inputs = points.take(pa.array([row["run"] for row in rows], pa.int64()))
    columns = []
    for field in schema:
        if field.name in points.column_names:
            columns.append(inputs[field.name].cast(field.type))
            continue
        absent = np.nan if field.type == pa.float64() else None
        columns.append(pa.array([row.get(field.name, absent) for row in rows], field.type))
    return pa.table(columns, schema=schema)


def write_whole(path: Path, table: pa.Table) -> None:
    """Write a Parquet file that appears whole or not at all, and survives a loss of power."""
    temporary = path.with_name(path.name + ".tmp")
    try:
        with temporary.open("wb") as file:
            parquet.write_table(table, file, compression="zstd")
            file.flush()
            os.fsync(file.fileno())
        temporary.replace(path)
    except OSError as error:
        temporary.unlink(missing_ok=True)
        raise InternalError(f"{path}: {error.strerror}", Status.IO_ERROR) from error


class Store:
    """The folder of one sweep, held by one process at a time."""

    def __init__(self, folder: Path, manifest: Mapping[str, Any], points: pa.Table, schema: pa.Schema) -> None:
        """Open or make the folder; InputError when it holds another sweep or another process has it."""
        self.folder, self.points = folder, points
        self.schema = schema.with_metadata({"hypofab": json.dumps(manifest)})
        self.results, self._rows = folder / "results.parquet", folder / "rows"
        try:
            folder.mkdir(parents=True, exist_ok=True)
            self._lock = (folder / "lock").open("w")
        except OSError as error:
            raise InternalError(f"{error.filename}: {error.strerror}", Status.IO_ERROR) from error
        try:
            fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            self._lock.close()
            raise InputError(f"{folder}: another process works on this sweep", Status.BAD_ARGUMENT) from error
        try:
            self._check_manifest(manifest)
            for left in self._rows.glob("*.tmp"):
                left.unlink()
            if not self.results.exists():
                self._rows.mkdir(exist_ok=True)
        except OSError as error:
            self._lock.close()
            raise InternalError(f"{error.filename}: {error.strerror}", Status.IO_ERROR) from error
        except BaseException:
            self._lock.close()
            raise
        self._buffer: list[Mapping[str, Any]] = []
        self._begun = self._written = time.monotonic()

    def __enter__(self) -> Self:
        """Use in a `with`: rows that have come are written whatever happens."""
        return self

    def __exit__(self, *_: object) -> None:
        """Write what has come, and let go of the folder."""
        try:
            self.flush()
        finally:
            self._lock.close()

    def _check_manifest(self, manifest: Mapping[str, Any]) -> None:
        path = self.folder / "manifest.json"
        # As JSON has it, so that tuples and lists are the same.
        wanted = json.loads(json.dumps(manifest))
        if path.exists():
            place = first_difference(read_manifest(self.folder)["sweep"], wanted["sweep"])
            if place is not None:
                raise InputError(f"{path}: {place}; expected the same sweep, or another folder", Status.BAD_ARGUMENT)
            return
        if self.results.exists() or self._rows.exists():
            raise InputError(
                f"{self.folder}: results without manifest.json, expected a new folder", Status.BAD_ARGUMENT
            )
        temporary = path.with_suffix(".tmp")
        temporary.write_text(json.dumps(wanted, indent=1) + "\n", encoding="utf-8")
        temporary.replace(path)

    def done(self) -> np.ndarray:
        """Numbers of the runs that are written."""
        if self.results.exists():
            return np.arange(self.points.num_rows)
        tables = [parquet.read_table(path, columns=["run"]) for path in self.parts()]
        return np.unique(pa.concat_tables(tables)["run"].to_numpy()) if tables else np.zeros(0, dtype=np.int64)

    def parts(self) -> list[Path]:
        """Files with rows, in the order of writing."""
        return sorted(self._rows.glob("part-*.parquet"))

    def add(self, rows: Sequence[Mapping[str, Any]]) -> None:
        """Take rows; they are written within a second at first, a hundredth of the time so far later, or a minute."""
        self._buffer += rows
        now = time.monotonic()
        if now - self._written >= min(max(_SHARE * (now - self._begun), _SHORTEST), _LONGEST):
            self.flush()

    def flush(self) -> None:
        """Write the rows that have come."""
        if self._buffer:
            parts = self.parts()
            number = int(parts[-1].stem.removeprefix("part-")) + 1 if parts else 0
            write_whole(self._rows / f"part-{number:06d}.parquet", table_of(self._buffer, self.points, self.schema))
            self._buffer = []
        self._written = time.monotonic()

    def finish(self) -> pa.Table:
        """One table of all runs, in their order."""
        self.flush()
        if not self.results.exists():
            table = self.read()
            if not np.array_equal(table["run"].to_numpy(), np.arange(self.points.num_rows)):
                raise InternalError(f"{self.folder}: rows are missing or twice there", Status.INTERNAL_ERROR)
            write_whole(self.results, table)
        for part in self.parts():
            part.unlink()
        with suppress(OSError):
            self._rows.rmdir()
        return parquet.read_table(self.results)

    def read(self) -> pa.Table:
        """What is written so far, in the order of the runs."""
        return read_folder(self.folder, self.schema)


def read_manifest(folder: Path) -> Mapping[str, Any]:
    """What the sweep in a folder is."""
    path = folder / "manifest.json"
    try:
        manifest = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}", Status.BAD_FILE) from error
    except ValueError as error:
        raise InputError(f"{path}: {error}", Status.BAD_FILE) from error
    if not isinstance(manifest, dict) or "sweep" not in manifest:
        raise InputError(f"{path}: no manifest of a sweep", Status.BAD_FILE)
    return manifest


def read_folder(folder: Path, schema: pa.Schema | None = None) -> pa.Table:
    """The results in a folder, or what there is of them so far."""
    if (folder / "results.parquet").exists():
        return parquet.read_table(folder / "results.parquet")
    try:
        tables = [parquet.read_table(path) for path in sorted((folder / "rows").glob("part-*.parquet"))]
    except FileNotFoundError:  # the sweep has just come to its end
        return parquet.read_table(folder / "results.parquet")
    if tables:
        return pa.concat_tables(tables).sort_by("run")
    if schema is None:
        raise InputError(f"{folder}: no results of a sweep", Status.BAD_FILE)
    return schema.empty_table()


def first_difference(found: Any, wanted: Any, place: str = "") -> str | None:  # noqa: ANN401 - JSON
    """Where two JSON values differ first, in words; None if nowhere."""
    if isinstance(found, dict) and isinstance(wanted, dict):
        for key in [*wanted, *(key for key in found if key not in wanted)]:
            inside = f"{place}.{key}" if place else key
            if key not in found:
                return f"{inside} is new, it was not there"
            if key not in wanted:
                return f"{inside} is not there any more"
            difference = first_difference(found[key], wanted[key], inside)
            if difference:
                return difference
        return None
    if isinstance(found, list) and isinstance(wanted, list) and len(found) == len(wanted):
        pairs = enumerate(zip(found, wanted, strict=True))
        differences = (first_difference(a, b, f"{place}[{index}]") for index, (a, b) in pairs)
        return next(filter(None, differences), None)
    same = found == wanted and isinstance(found, bool) == isinstance(wanted, bool)
    return None if same else f"{place} was {_short(found)} there and is {_short(wanted)} here"


def _short(value: object) -> str:
    text = json.dumps(value)
    return text if len(text) <= 40 else text[:37] + "..."
