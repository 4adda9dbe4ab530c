"""Write strip_footing.mdpa: half of the soil under a strip footing, 5 m wide and 4 m deep, in 20 x 16 squares.

python strip_footing_mesh.py

x = 0 is the plane of symmetry, y = 0 the surface. The footing covers 0 <= x <= 1 (half its width of 2 m).
"""

from collections.abc import Callable, Iterable
from pathlib import Path

WIDTH, DEPTH, HALF_FOOTING = 5.0, 4.0, 1.0
COLUMNS, ROWS = 20, 16


def node(i: int, j: int) -> int:
    """Number of the node in column i from the left and row j from below."""
    return 1 + i + (COLUMNS + 1) * j


def block(name: str, lines: Iterable[str]) -> str:
    """A block of a .mdpa file."""
    return "\n".join([f"Begin {name}", *lines, f"End {name.split()[0]}", ""])


def part(
    name: str, nodes: Iterable[int], elements: Iterable[int] = (), loads: Iterable[int] = (), table: str = ""
) -> str:
    """A sub model part: a named group of nodes, elements and loads, and a table its conditions may use."""
    groups = {"Tables": [table] if table else [], "Nodes": nodes, "Elements": elements, "Conditions": loads}
    return block(f"SubModelPart {name}", [block(f"SubModelPart{kind}", map(str, ids)) for kind, ids in groups.items()])


def mesh() -> str:
    """The text of the file."""
    x = [WIDTH * i / COLUMNS for i in range(COLUMNS + 1)]
    y = [-DEPTH + DEPTH * j / ROWS for j in range(ROWS + 1)]
    grid = [(i, j) for j in range(ROWS + 1) for i in range(COLUMNS + 1)]

    def where(inside: Callable[[float, float], bool]) -> list[int]:
        return [node(i, j) for i, j in grid if inside(x[i], y[j])]

    cells = [(i, j) for j in range(ROWS) for i in range(COLUMNS)]
    corners = [(node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)) for i, j in cells]
    # The surface beside the footing, walked from right to left: the soil is on the left hand.
    edges = [(node(i + 1, ROWS), node(i, ROWS)) for i in range(COLUMNS) if x[i] >= HALF_FOOTING]
    return "\n".join(
        [
            block("Properties 1", []),
            "// Settlement of the footing: 10 mm, that is half a per cent of its width.",
            block("Table 1 TIME DISPLACEMENT_Y", ["0.0 0.0", "1.0 -0.01"]),
            block("Nodes", [f"{node(i, j)} {x[i]} {y[j]} 0" for i, j in grid]),
            block(
                "Elements UPwSmallStrainElement2D4N",
                [f"{k} 1 " + " ".join(map(str, c)) for k, c in enumerate(corners, start=1)],
            ),
            block(
                "Conditions UPwNormalFaceLoadCondition2D2N",
                [f"{k} 1 {a} {b}" for k, (a, b) in enumerate(edges, start=1)],
            ),
            part("Soil", where(lambda x, y: True), range(1, len(cells) + 1)),
            part("Sides", where(lambda x, y: x in (0, WIDTH))),
            part("Bottom", where(lambda x, y: y == -DEPTH)),
            part("Surface", where(lambda x, y: y == 0 and x >= HALF_FOOTING), loads=range(1, len(edges) + 1)),
            part("Footing", where(lambda x, y: y == 0 and x <= HALF_FOOTING), table="1"),
        ]
    )


if __name__ == "__main__":
    Path("strip_footing.mdpa").write_text(mesh())
