"""Write the meshes of the OpenGeoSys examples: python mesh.py [FOLDER]

OpenGeoSys wants one mesh file for the body and one for each part of its boundary that carries a condition; the arrays
bulk_node_ids and bulk_element_ids of the latter say which node and element of the body each of theirs is. Here:

cube.vtu      one hexahedron with edges of length 1, and its faces cube_x0 (at x = 0), cube_x1, ... cube_z1
square.vtu    one quadrilateral with edges of length 1, and its edges square_x0 ... square_y1
footing.vtu   the right half of the ground under a strip footing, fine near the footing's edge, and its boundary
"""

import sys
from dataclasses import dataclass
from pathlib import Path

# Numbers by which VTK calls the shapes of cells.
LINE, QUADRILATERAL, HEXAHEDRON, QUADRATIC_LINE, QUADRATIC_QUADRILATERAL = 3, 9, 12, 21, 23

Point = tuple[float, float, float]


@dataclass
class Mesh:
    """Points, and cells of one shape as lists of point numbers."""

    points: list[Point]
    cells: list[list[int]]
    shape: int


def data_array(kind: str, name: str, values: list, components: int = 1) -> str:
    """One array of a VTU file, as text."""
    of = f' NumberOfComponents="{components}"' if components > 1 else ""
    return f'<DataArray type="{kind}" Name="{name}"{of} format="ascii">{" ".join(map(str, values))}</DataArray>'


def write(path: Path, mesh: Mesh, point_data: str = "", cell_data: str = "") -> None:
    """Write a mesh as a VTU file in plain text."""
    offsets = [len(mesh.cells[0]) * (i + 1) for i in range(len(mesh.cells))]
    lines = [
        '<?xml version="1.0"?>',
        '<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">',
        f'<UnstructuredGrid><Piece NumberOfPoints="{len(mesh.points)}" NumberOfCells="{len(mesh.cells)}">',
        f"<PointData>{point_data}</PointData>",
        f"<CellData>{cell_data}</CellData>",
        "<Points>" + data_array("Float64", "Points", [x for point in mesh.points for x in point], 3) + "</Points>",
        "<Cells>",
        data_array("Int64", "connectivity", [node for cell in mesh.cells for node in cell]),
        data_array("Int64", "offsets", offsets),
        data_array("UInt8", "types", [mesh.shape] * len(mesh.cells)),
        "</Cells></Piece></UnstructuredGrid></VTKFile>",
    ]
    path.write_text("\n".join(lines) + "\n")


def write_body(folder: Path, name: str, mesh: Mesh) -> None:
    """Write a body; MaterialIDs number the media of the project file."""
    write(folder / f"{name}.vtu", mesh, cell_data=data_array("Int32", "MaterialIDs", [0] * len(mesh.cells)))


def write_boundary(folder: Path, name: str, body: Mesh, shape: int, sides: list[tuple[int, list[int]]]) -> None:
    """Write a part of the boundary of a body: for each side the element it belongs to and its nodes."""
    nodes = sorted({node for _, side in sides for node in side})
    mesh = Mesh([body.points[i] for i in nodes], [[nodes.index(node) for node in side] for _, side in sides], shape)
    write(
        folder / f"{name}.vtu",
        mesh,
        data_array("UInt64", "bulk_node_ids", nodes),
        data_array("UInt64", "bulk_element_ids", [element for element, _ in sides]),
    )


def write_cube(folder: Path) -> None:
    """One hexahedron."""
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    body = Mesh([(float(x), float(y), float(z)) for x, y, z in corners], [list(range(8))], HEXAHEDRON)
    write_body(folder, "cube", body)
    faces = {
        "x0": [0, 4, 7, 3],
        "x1": [1, 2, 6, 5],
        "y0": [0, 1, 5, 4],
        "y1": [3, 7, 6, 2],
        "z0": [0, 3, 2, 1],
        "z1": [4, 5, 6, 7],
    }
    for name, face in faces.items():
        write_boundary(folder, f"cube_{name}", body, QUADRILATERAL, [(0, face)])


def write_square(folder: Path) -> None:
    """One quadrilateral."""
    body = Mesh([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.0)], [[0, 1, 2, 3]], QUADRILATERAL)
    write_body(folder, "square", body)
    for name, edge in {"x0": [3, 0], "x1": [1, 2], "y0": [0, 1], "y1": [2, 3]}.items():
        write_boundary(folder, f"square_{name}", body, LINE, [(0, edge)])


def graded(start: float, size: float, growth: float, count: int) -> list[float]:
    """Coordinates from a start in steps that grow by a factor; size is that of the first step, negative: downwards."""
    values = [start]
    for i in range(count):
        values.append(values[-1] + size * growth**i)
    return values


def write_footing(folder: Path) -> None:
    """Quadrilaterals of eight nodes, half a footing of half width 0.5 at the origin; y points upwards."""
    x = [0.1 * i for i in range(5)] + graded(0.5, 0.1, 1.18, 14)
    y = graded(0.0, -0.1, 1.15, 13)
    columns, rows = len(x) - 1, len(y) - 1
    points: list[Point] = []
    number: dict[tuple[int, int], int] = {}  # by position on a grid of half elements
    for j in range(2 * rows + 1):
        for i in range(2 * columns + 1):
            if i % 2 and j % 2:
                continue  # elements of eight nodes have none in the middle
            number[i, j] = len(points)
            across = 0.5 * (x[i // 2] + x[(i + 1) // 2])
            points.append((across, 0.5 * (y[j // 2] + y[(j + 1) // 2]), 0.0))

    def element(i: int, j: int) -> list[int]:
        """Corners counter-clockwise from the lower left, then the middles of the edges; rows are counted downwards."""
        left, right, top, bottom = 2 * i, 2 * i + 2, 2 * j, 2 * j + 2
        corners = [(left, bottom), (right, bottom), (right, top), (left, top)]
        middles = [(left + 1, bottom), (right, bottom - 1), (left + 1, top), (left, bottom - 1)]
        return [number[position] for position in corners + middles]

    cells = [element(i, j) for j in range(rows) for i in range(columns)]
    body = Mesh(points, cells, QUADRATIC_QUADRILATERAL)
    write_body(folder, "footing", body)
    top = [(i, [cells[i][3], cells[i][2], cells[i][6]]) for i in range(columns)]
    under, beside = top[:5], top[5:]
    lowest = columns * (rows - 1)
    bottom = [(lowest + i, [cells[lowest + i][k] for k in (0, 1, 4)]) for i in range(columns)]
    left = [(columns * j, [cells[columns * j][k] for k in (3, 0, 7)]) for j in range(rows)]
    right = [(columns * j + columns - 1, [cells[columns * j + columns - 1][k] for k in (1, 2, 5)]) for j in range(rows)]
    for name, sides in {"under": under, "beside": beside, "bottom": bottom, "left": left, "right": right}.items():
        write_boundary(folder, f"footing_{name}", body, QUADRATIC_LINE, sides)


def main(folder: Path) -> None:
    """Write every mesh."""
    write_cube(folder)
    write_square(folder)
    write_footing(folder)


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "."))
