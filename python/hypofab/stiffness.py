"""Table of directional stiffnesses beside the published ones (paper 000, Table 4)."""

from collections.abc import Mapping
from pathlib import Path

from hypofab import paper000
from hypofab.results import ResultError, read_summary

REFERENCES = {
    "paper, element test": paper000.ELEMENT_TEST,
    "exact integration": paper000.EXACT,
    "paper, DEM": paper000.DEM,
}


def secant_stiffness(directory: str | Path) -> dict[str, float]:
    """Secant stiffness q/eps_q at the end of the first step of each test of a run, in the deck's unit of stress.

    A test that stopped before the end of its first step has none and is left out.
    """
    stiffness = {}
    for test in read_summary(directory)["tests"]:
        value = test["steps"][0].get("secant_stiffness") if test["steps"] else None
        if value is not None and (test["status"] == 0 or len(test["steps"]) > 1):
            stiffness[test["name"]] = float(value)
    if not stiffness:
        raise ResultError(f"{directory}: no test reached the end of its first step")
    return stiffness


def table(columns: Mapping[str, Mapping[str, float]]) -> str:
    """A text table: one row per test, for each column the stiffness [kPa] and its ratio to the column's lowest."""
    tests = list(dict.fromkeys(test for column in columns.values() for test in column))
    first_width = max(len("test"), *map(len, tests))
    widths = [max(len(title), 14) for title in columns]
    head = "test".ljust(first_width)
    units = " " * first_width
    for title, width in zip(columns, widths, strict=True):
        head += "  " + title.rjust(width)
        units += "  " + f"{'abs':>{width - 6}}{'rel':>6}"
    lines = [head, units, "-" * len(head)]
    for test in tests:
        line = test.ljust(first_width)
        for column, width in zip(columns.values(), widths, strict=True):
            cell = f"{column[test]:{width - 6}.0f}{column[test] / min(column.values()):6.2f}" if test in column else "-"
            line += "  " + cell.rjust(width)
        lines.append(line)
    return "\n".join(lines)
