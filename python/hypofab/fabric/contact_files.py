"""Contact files that the program does not read itself - HDF5, .npz, VTK XML - turned into the .npy it reads.

Rows are moved in blocks, so memory does not grow with the file (except for VTK, which its library reads whole).
Columns keep their names; vectors become `name[0]`, `name[1]`, `name[2]`, except for those in VECTORS, which become the
columns the program looks for. The signs and senses of docs/contact_files.md hold.
"""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from numpy.lib.format import open_memmap

from hypofab.results.tables import ResultError

BLOCK = 1 << 18
"""Rows moved at a time."""

VECTORS = {
    "normal": ("nx", "ny", "nz"),
    "branch": ("bx", "by", "bz"),
    "position": ("px", "py", "pz"),
    "force": ("fx", "fy", "fz"),
    "normal_force": ("fnx", "fny", "fnz"),
    "fn": ("fnx", "fny", "fnz"),
    "shear_force": ("fsx", "fsy", "fsz"),
    "fs": ("fsx", "fsy", "fsz"),
    "cell": ("cell_x", "cell_y", "cell_z"),
    "cellDist": ("cell_x", "cell_y", "cell_z"),
    "x1": ("x1", "y1", "z1"),
    "x2": ("x2", "y2", "z2"),
}
"""Names of vectors, and of the columns their components become."""

WHOLE = ("id1", "id2", "cell_x", "cell_y", "cell_z")
"""Columns of whole numbers, whatever kind of number the file holds."""


class ContactFileError(ResultError):
    """A contact file is not what it should be; the message says what was expected."""


Columns = Mapping[str, Callable[[int, int], np.ndarray]]
"""For each column a function that gives its rows from `begin` to `end`."""


def _of_field(array: np.ndarray, field: str, part: tuple) -> Callable[[int, int], np.ndarray]:
    return lambda begin, end: array[begin:end][field][part]


def _of_vector(array: np.ndarray, i: int) -> Callable[[int, int], np.ndarray]:
    return lambda begin, end: array[begin:end, i]


def _columns_of_array(name: str, array: np.ndarray) -> dict[str, Callable[[int, int], np.ndarray]]:
    """Columns of an array, or of anything that is sliced like one: records, a vector per row, a number per row."""
    if array.dtype.names:
        columns: dict[str, Callable[[int, int], np.ndarray]] = {}
        for field in array.dtype.names:
            shape = array.dtype[field].shape
            if shape and shape != (3,):
                raise ContactFileError(f"{field}: {shape} numbers per contact; expected one, or a vector of three")
            names = VECTORS.get(field, tuple(f"{field}[{i}]" for i in range(3))) if shape else (field,)
            for i, column in enumerate(names):
                part = (slice(None), i) if shape else (slice(None),)
                columns[column] = _of_field(array, field, part)
        return columns
    if array.ndim == 1:
        return {name: lambda begin, end: array[begin:end]}
    if array.ndim == 2 and array.shape[1] == 3:
        names = VECTORS.get(name, tuple(f"{name}[{i}]" for i in range(3)))
        return {column: _of_vector(array, i) for i, column in enumerate(names)}
    raise ContactFileError(f"{name}: an array of shape {array.shape}; expected one number or three per contact")


def _columns_of_arrays(arrays: Mapping[str, np.ndarray], path: Path) -> tuple[Columns, int]:
    """Columns of several arrays, all with one row per contact."""
    lengths = {name: array.shape[0] if array.ndim else 0 for name, array in arrays.items()}
    if not arrays or len(set(lengths.values())) != 1:
        told = ", ".join(f"{name} {length}" for name, length in lengths.items()) or "none"
        raise ContactFileError(f"{path}: arrays of unequal length ({told}); expected one row per contact in each")
    columns: dict[str, Callable[[int, int], np.ndarray]] = {}
    for name, array in arrays.items():
        columns |= _columns_of_array(name, array)
    return columns, next(iter(lengths.values()))


@contextmanager
def _open_npy(path: Path, group: str | None) -> Iterator[tuple[Columns, int]]:
    """A .npy in any byte order and layout; a table of numbers without names needs `group`, its names with commas."""
    array = np.load(path, mmap_mode="r")
    if array.ndim == 2 and not array.dtype.names:
        names = group.split(",") if group else []
        if len(names) != array.shape[1]:
            raise ContactFileError(
                f"{path}: {array.shape[1]} columns without names; expected their names, nx,ny,nz,..."
            )
        arrays = {name: array[:, i] for i, name in enumerate(names)}
    else:
        arrays = {"column": array}
    yield _columns_of_arrays(arrays, path)


@contextmanager
def _open_npz(path: Path, group: str | None) -> Iterator[tuple[Columns, int]]:
    """An .npz with an array for each quantity. Packed arrays are unpacked whole, one after the other."""
    with np.load(path) as archive:
        names = group.split(",") if group else archive.files
        yield _columns_of_arrays({name: archive[name] for name in names}, path)


@contextmanager
def _open_hdf5(path: Path, group: str | None) -> Iterator[tuple[Columns, int]]:
    """A dataset of records, or the datasets of a group."""
    import h5py

    with h5py.File(path, "r") as file:
        place = file[group] if group else file
        if isinstance(place, h5py.Dataset):
            yield _columns_of_arrays({place.name.rsplit("/", 1)[-1]: place}, path)
            return
        datasets = {name: item for name, item in place.items() if isinstance(item, h5py.Dataset)}
        if not datasets:
            raise ContactFileError(f"{path}: no datasets in {place.name}; its groups: {', '.join(place)}")
        yield _columns_of_arrays(datasets, path)


@contextmanager
def _open_vtk(path: Path, group: str | None) -> Iterator[tuple[Columns, int]]:
    """VTK XML or binary legacy VTK: contacts are lines of two points (cell data), or points (point data)."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOLegacy import vtkPolyDataReader
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

    reader = vtkPolyDataReader() if path.suffix == ".vtk" else vtkXMLPolyDataReader()
    if path.suffix == ".vtk":
        for read_all in (reader.ReadAllScalarsOn, reader.ReadAllVectorsOn, reader.ReadAllFieldsOn):
            read_all()
    reader.SetFileName(str(path))
    reader.Update()
    data = reader.GetOutput()
    n_lines, n_points = data.GetNumberOfLines(), data.GetNumberOfPoints()
    if n_points == 0:
        raise ContactFileError(f"{path}: no points; expected a VTK file of poly data (.vtp or .vtk) with contacts")
    attributes = data.GetCellData() if n_lines else data.GetPointData()
    arrays = {
        attributes.GetArrayName(i): vtk_to_numpy(attributes.GetArray(i)) for i in range(attributes.GetNumberOfArrays())
    }
    if "forceN" in arrays and "absForceT" in arrays:
        raise ContactFileError(
            f"{path}: contacts written by YADE's VTKRecorder, which loses contacts and shifts values in periodic "
            "cells; expected a file of VTKExporter.exportInteractions"
        )
    points = vtk_to_numpy(data.GetPoints().GetData())
    if n_lines:
        ends = vtk_to_numpy(data.GetLines().GetConnectivityArray())
        if ends.size != 2 * n_lines:
            raise ContactFileError(f"{path}: {ends.size} points on {n_lines} lines; expected two for each contact")
        arrays |= {"x1": points[ends[0::2]], "x2": points[ends[1::2]]}
    else:
        arrays["position"] = points
    del group
    yield _columns_of_arrays(arrays, path)


OPENERS = {
    ".npy": _open_npy,
    ".npz": _open_npz,
    ".h5": _open_hdf5,
    ".hdf5": _open_hdf5,
    ".vtp": _open_vtk,
    ".vtk": _open_vtk,
}
"""How to open a file, by its ending."""


def _whole(values: np.ndarray, column: str, path: Path, begin: int) -> np.ndarray:
    """Values as 64-bit whole numbers, or an error that names the first that is none."""
    if values.dtype.kind in "iu":
        return values.astype(np.int64)
    rounded = np.rint(values)
    wrong = np.flatnonzero(~(rounded == values))
    if wrong.size:
        row = int(wrong[0])
        raise ContactFileError(f"{path}: contact {begin + row + 1}: {column} is {values[row]}; expected a whole number")
    return rounded.astype(np.int64)


def convert(source: Path | str, target: Path | str, group: str | None = None) -> int:
    """Write the contacts of a file as a .npy of records, which the program reads; returns their number.

    `group`: of HDF5, the group or dataset; of .npz, the arrays wanted; of a .npy without names, those of its columns.
    The target appears whole or not at all.
    """
    source, target = Path(source), Path(target)
    if source.suffix not in OPENERS:
        raise ContactFileError(f"{source}: an ending of '{source.suffix}'; expected one of {', '.join(OPENERS)}")
    if not source.exists():
        raise ContactFileError(f"{source}: no such file")
    partial = target.with_name(f".{target.name}.part")
    try:
        with OPENERS[source.suffix](source, group) as (columns, count):
            kinds = [(name, "<i8" if name in WHOLE else "<f8") for name in columns]
            rows = open_memmap(partial, mode="w+", dtype=np.dtype(kinds), shape=(count,))
            for begin in range(0, count, BLOCK):
                end = min(begin + BLOCK, count)
                for name, read in columns.items():
                    values = np.asarray(read(begin, end))
                    rows[name][begin:end] = _whole(values, name, source, begin) if name in WHOLE else values
            rows.flush()
            del rows
        partial.replace(target)
    except (OSError, KeyError, ValueError) as error:
        raise ContactFileError(f"{source}: {error}") from error
    finally:
        partial.unlink(missing_ok=True)
    return count
