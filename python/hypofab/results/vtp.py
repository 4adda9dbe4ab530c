"""Read the VTK poly data files (.vtp, XML with text arrays) that `hypofab envelope` writes."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from hypofab.results.tables import ResultError
from hypofab.tensors import Array


@dataclass(frozen=True)
class Piece:
    """One surface or line: the envelope of one series, whole response or irrecoverable part."""

    points: Array
    """Coordinates, shape (points, 3)."""
    cells: NDArray[np.int64]
    """Corners of triangles (cells, 3) or of segments (cells, 2)."""
    data: dict[str, Array]
    """Arrays on the points by name, shape (points,) or (points, 3)."""

    @property
    def series(self) -> int:
        """Number of the series in the deck."""
        return int(self.data["series"][0])

    @property
    def irrecoverable(self) -> bool:
        """Is this the irrecoverable part?"""
        return bool(self.data["part"][0])


def _array(path: Path, element: ElementTree.Element, count: int | None) -> NDArray[Any]:
    """A DataArray of so many tuples."""
    width = int(element.get("NumberOfComponents", "1"))
    kind = np.int64 if element.get("type", "").startswith("Int") else np.float64
    values = np.array((element.text or "").split(), dtype=kind)
    if count is not None and len(values) != count * width:
        raise ResultError(f"{path}: {element.get('Name')} has {len(values)} numbers, expected {count * width}")
    return values if width == 1 else values.reshape(-1, width)


def _piece(path: Path, element: ElementTree.Element) -> Piece:
    n_points, n_lines, n_polys = (int(element.attrib[f"NumberOf{name}"]) for name in ("Points", "Lines", "Polys"))
    points = element.find("Points/DataArray")
    cells = element.find("Polys" if n_polys else "Lines")
    if points is None or cells is None:
        raise ResultError(f"{path}: a piece without points or cells")
    arrays = {array.get("Name"): array for array in cells.iter("DataArray")}
    n_cells, corners = (n_polys, 3) if n_polys else (n_lines, 2)
    offsets = _array(path, arrays["offsets"], n_cells)
    if not np.array_equal(offsets, corners * np.arange(1, n_cells + 1)):
        raise ResultError(f"{path}: cells of other than {corners} corners")
    connectivity = _array(path, arrays["connectivity"], corners * n_cells)
    if n_cells and not (connectivity.min() >= 0 and connectivity.max() < n_points):
        raise ResultError(f"{path}: a cell with a corner that is no point")
    data = {array.attrib["Name"]: _array(path, array, n_points) for array in element.iterfind("PointData/DataArray")}
    return Piece(_array(path, points, n_points), connectivity.reshape(-1, corners).astype(np.int64), data)


def read_vtp(path: str | Path) -> list[Piece]:
    """The pieces of a file; ResultError when it is not as `hypofab envelope` writes it."""
    path = Path(path)
    try:
        root = ElementTree.parse(path).getroot()
    except OSError as error:
        raise ResultError(f"{path}: {error.strerror}") from error
    except ElementTree.ParseError as error:
        raise ResultError(f"{path}: {error}") from error
    if root.tag != "VTKFile" or root.get("type") != "PolyData":
        raise ResultError(f"{path}: not a VTK file of poly data")
    return [_piece(path, element) for element in root.iterfind("PolyData/Piece")]
