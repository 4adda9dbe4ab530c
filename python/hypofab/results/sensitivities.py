"""Curves of tests with their derivatives, as tests with `sensitivities` write them (docs/sensitivities.md)."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from hypofab.results.tables import ResultError, read_columns, read_numbers, read_summary
from hypofab.tensors import Array


@dataclass(frozen=True)
class Sensitivities:
    """Curves of one test with their derivatives."""

    name: str
    columns: Mapping[str, Array]
    """quantities by name, one number for each row"""
    derivatives: Mapping[str, Mapping[str, Array]]
    """by the number varied, then by quantity"""
    values: Mapping[str, float]
    """of the numbers varied, as far as they are known"""
    unit: str = "kPa"

    def moved(self, number: str, quantity: str, change: float) -> Array:
        """A quantity after a relative change of a number, by the linear model."""
        return self.columns[quantity] + change * self.values[number] * self.derivatives[number][quantity]

    def drawable(self) -> list[str]:
        """The numbers whose relative change has a meaning: known and not zero."""
        return [name for name in self.derivatives if self.values.get(name)]


def read_sensitivities(directory: str | Path) -> list[Sensitivities]:
    """The tests of a folder of results that were run with `sensitivities`, in the order of the deck."""
    directory = Path(directory)
    summary = read_summary(directory)
    found = []
    for test in summary["tests"]:
        if test["file"] is None:
            continue
        path = directory / test["file"]
        table = path.with_name(f"{path.stem}_sensitivities.csv")
        if table.exists():
            initial, source = test.get("initial", {}), test.get("fabric", {})
            known = {**initial, **test.get("material", {}), **({"c": source["c"]} if "c" in source else {})}
            found.append(_read(test["name"], path, table, known, summary["unit"]))
    return found


def _read(name: str, rows: Path, table: Path, known: Mapping[str, float], unit: str) -> Sensitivities:
    results, columns = read_columns(rows), read_columns(table)
    derivatives: dict[str, dict[str, Array]] = {}
    for column in columns:
        if column in ("time", "step", "event"):
            continue
        quantity, separator, number = column.removeprefix("d").partition("/d")
        if not separator or quantity not in results:
            raise ResultError(f"{table}: column {column}, expected names like dq/dh_s")
        derivatives.setdefault(number, {})[quantity] = read_numbers(table, columns, column)
    quantities = next(iter(derivatives.values()), {})
    values = {quantity: read_numbers(rows, results, quantity) for quantity in quantities}
    return Sensitivities(name, values, derivatives, known, unit)
