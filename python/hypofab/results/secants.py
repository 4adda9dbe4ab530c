"""Table of directional stiffnesses beside the published ones (paper 000, Table 4)."""

from collections.abc import Mapping
from pathlib import Path

from hypofab.results import paper000
from hypofab.results.tables import ResultError, read_summary

REFERENCES = {
    "paper, element test": paper000.ELEMENT_TEST,
    "exact integration": paper000.EXACT,
    "paper, DEM": paper000.DEM,
}


KILOPASCALS = {"Pa": 1e-3, "kPa": 1.0, "MPa": 1e3}


def secant_stiffness(directory: str | Path) -> dict[str, float]:
    """Secant stiffness q/eps_q [kPa] at the end of the first step of each test of a run.

    A test without one is left out: it stopped before the end of its first step, or had no deviatoric strain there.
    """
    summary = read_summary(directory)
    first_steps = {test["name"]: test["steps"][0] for test in summary["tests"] if test["steps"]}
    factor = KILOPASCALS[summary["unit"]]
    stiffness = {
        name: factor * step["secant_stiffness"]
        for name, step in first_steps.items()
        if step["reached"] and step["secant_stiffness"] is not None  # null: no deviatoric strain
    }
    if not stiffness:
        raise ResultError(f"{directory}: no test has a secant stiffness at the end of its first step")
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
