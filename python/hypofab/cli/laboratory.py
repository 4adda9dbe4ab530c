"""`hypofab laboratory DIR -o OUT`: compute every test of a catalogue and compare."""

import argparse
import csv
from pathlib import Path

import numpy as np

from hypofab.figures import Figure, dilatancy
from hypofab.figures import laboratory as figures
from hypofab.laboratory.catalogue import LabTest, load_catalogue
from hypofab.laboratory.decks import run_deck, write_deck
from hypofab.laboratory.measures import Agreement, agreement, compare, half_cycles, interpolate
from hypofab.laboratory.series import Series, read_measured
from hypofab.laboratory.text import write_markdown
from hypofab.laboratory.variants import STARTS, Computed, Variant, starts_of
from hypofab.model.materials import sands
from hypofab.results.drained import DrainedTest
from hypofab.results.tables import ResultError

FIELDS = (
    *("material", "test", "kind", "sand", "start", "void_ratio", "void_ratio_fitted", "quantity", "rows"),
    *("r2", "rms", "largest", "covered", "status"),
)
"""Columns of errors.csv."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Where the tests are and where the report goes."""
    parser.add_argument("directory", metavar="DIR", type=Path, help="folder with the files of the tests")
    parser.add_argument("-o", "--output", metavar="OUT", type=Path, required=True, help="folder for the report")
    parser.add_argument("--catalogue", metavar="FILE", type=Path, help="tests and their files (default: built in)")


def run(options: argparse.Namespace) -> None:
    """Write the report and print where it is."""
    print(report(options.directory, options.output, options.catalogue))


def _misfit(test: LabTest, measured: Series, run: Computed) -> float:
    """What the fit of an unknown void ratio minimises."""
    if test.kind == "undrained_cyclic":
        return abs(half_cycles(test, run.rows) - half_cycles(test, measured))
    total = 0.0
    for name in ("q", "p"):
        found = agreement(name, measured[name], interpolate(measured["eps1"], run.rows["eps1"], run.rows[name]))
        total += found.rms + (1 - found.covered) if np.isfinite(found.rms) else 10.0
    return total


def _void_ratio(test: LabTest, start: str, measured: Series, out: Path) -> float:
    """The void ratio at the start: as known, or the one of a range that fits best (to 0.002)."""
    if test.void_ratio is not None:
        return test.void_ratio
    if "e" in measured:
        return float(measured["e"][0])
    if test.fit_void_ratio is None:
        raise ResultError(f"{test.file}: no void ratio in the file nor in the catalogue")
    lower, upper = test.fit_void_ratio
    best = 0.5 * (lower + upper)
    for span, number in ((0.5 * (upper - lower), 15), (0.03, 31)):
        values = np.clip(np.linspace(best - span, best + span, number), lower, upper)
        variants = [Variant(test, test.sands[0], start, round(float(value), 4)) for value in np.unique(values)]
        deck = out / f"{test.name}-fit.yaml"
        write_deck(variants, measured, deck)
        runs = run_deck(deck, out / f"{test.name}-fit", variants)
        misfits = [_misfit(test, measured, run) for run in runs]
        # Equal misfits (whole numbers of cycles): the middle of them.
        equal = [run.variant.void_ratio for run, misfit in zip(runs, misfits, strict=True) if misfit == min(misfits)]
        best = equal[len(equal) // 2]
    return best


def compute(test: LabTest, measured: Series, with_memory: set[str], out: Path) -> list[Computed]:
    """Every variant of a test: each sand, and each start of delta where the sand has it."""
    first = next(iter(STARTS)) if test.sands[0] in with_memory else "none"
    void_ratio = _void_ratio(test, first, measured, out)
    variants = [
        Variant(test, sand, start, void_ratio)
        for sand in test.sands
        for start in (starts_of(test) if sand in with_memory else ("none",))
    ]
    deck = out / f"{test.name}.yaml"
    write_deck(variants, measured, deck)
    return run_deck(deck, out / test.name, variants)


def _row(test: LabTest, run: Computed, found: Agreement) -> dict:
    fitted = "e" not in test.columns and test.void_ratio is None
    return {
        "material": test.material,
        "test": test.name,
        "kind": test.kind,
        "sand": run.variant.sand,
        "start": run.variant.start,
        "void_ratio": f"{run.variant.void_ratio:.4f}",
        "void_ratio_fitted": "yes" if fitted else "no",
        "quantity": found.quantity,
        "rows": found.rows,
        "r2": f"{found.r2:.4f}",
        "rms": f"{found.rms:.4f}",
        "largest": f"{found.largest:.4f}",
        "covered": f"{found.covered:.4f}",
        "status": run.status,
    }


def _save(figure: Figure, path: Path) -> None:
    """Write a figure."""
    figure.savefig(path, dpi=160)


def drained(name: str, rows: Series, void_ratio: float, p_0: float) -> DrainedTest:
    """A drained compression test; what the file does not hold follows from the rest."""
    p = rows["p"] if "p" in rows else p_0 + rows["q"] / 3
    e = rows["e"] if "e" in rows else (1 + void_ratio) * np.exp(-rows["eps_v"]) - 1
    return DrainedTest(name, rows["eps1"], rows["eps_v"], rows["q"], p, e)


def _draw_dilatancy(
    material: str, tests: list[tuple[LabTest, Series, list[Computed]]], parameters: dict, out: Path
) -> None:
    """Stress-dilatancy and critical states of the drained tests of a material, for the sand named first."""
    sand = tests[0][0].sands[0]
    measured, computed = [], []
    for test, rows, runs in tests:
        run = next(run for run in runs if run.variant.sand == sand)
        p_0 = float(run.rows["p"][0])
        measured.append(drained(test.name, rows, run.variant.void_ratio, p_0))
        computed.append(drained(test.name, run.rows, run.variant.void_ratio, p_0))
    groups = {"measured": measured, f"computed ({sand})": computed}
    stem = material.lower().replace(" ", "_")
    _save(dilatancy.stress_dilatancy(groups, parameters[sand]["phi_c"]), out / f"{stem}_stress_dilatancy.png")
    _save(dilatancy.critical_states(groups, parameters[sand]), out / f"{stem}_critical_states.png")


def report(directory: Path, out: Path, catalogue: Path | None = None) -> Path:
    """Write OUT/report.md, errors.csv, overlays, figures, decks and results; the path of the report.

    Tests whose file is not there are named in the report and left out.
    """
    tests = load_catalogue(catalogue)
    present = [test for test in tests if (directory / test.file).exists()]
    if not present:
        raise ResultError(f"{directory}: none of the {len(tests)} files of the catalogue, e.g. {tests[0].file}")
    parameters = {name: sand.material for name, sand in sands().items()}
    with_memory = {name for name, material in parameters.items() if material.memory_size}
    out.mkdir(parents=True, exist_ok=True)
    rows: list[dict] = []
    by_material: dict[str, list[tuple[LabTest, Series, list[Computed]]]] = {}
    for test in present:
        measured = read_measured(test, directory)
        runs = compute(test, measured, with_memory, out)
        rows += [_row(test, run, found) for run in runs for found in compare(test, measured, run.rows)]
        _save(figures.overlay(test, measured, runs), out / f"{test.name}.png")
        if test.kind == "drained_compression":
            by_material.setdefault(test.material, []).append((test, measured, runs))
    with (out / "errors.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, FIELDS)
        writer.writeheader()
        writer.writerows(rows)
    _save(figures.errors([row for row in rows if row["quantity"] != "cycles"]), out / "errors.png")
    for material, drained_tests in by_material.items():
        _draw_dilatancy(material, drained_tests, parameters, out)
    missing = [test.file for test in tests if test not in present]
    return write_markdown(present, rows, missing, out)
