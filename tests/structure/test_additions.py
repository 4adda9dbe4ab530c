"""In how many files an addition is made: docs/architecture.md says a number, an existing sample of each kind shows it.

The files that name the sample, or are named after it, are counted: sources, and what builds them. Tests, documentation,
examples and the completion of shells, which `scripts/completion` writes, are left out.
"""

import re
from functools import cache

import pytest
from sources import ROOT

ROOMS = (
    "base",
    "include",
    "umat",
    "driver",
    "fabric2delta",
    "calibration",
    "sampling",
    "deck",
    "cli",
    "python",
    "cmake",
)
SUFFIXES = {".c", ".h", ".f90", ".F90", ".inc", ".py", ".pyi", ".pyf", ".txt", ".cmake"}

SAMPLES = {
    "a model": r"\bhypofab_sand_model\b",
    "a sand": r"\blausitz\b",
    "a material parameter's bound or description": r"granular hardness",
    "a DEM format": r"\bpfc\b|read_pfc|contact_pfc",
    "an integrator": r"\bida\b|_ida\b|_IDA\b",
    "a set of probe directions": r"\ball_components\b|subspace_all",
    "a measure of probes": r"\bangle_to_delta\b",
    "a weight function f(a)": r"\brational\b",
    "a figure of fabric": r"\bplane_roses\b",
    "a form of delta for an FE code": r"\bogs\b",
    "a parameter's derivative": r"\bi_p_t\b",
    "a measure of stability": r"acoustic\.[ch]|acoustic_(det|minimise)|ACOUSTIC_DET",
    "a test preset": r"\bconstant_q_loading\b",
    "an output quantity": r"\beta_signed|ETA_SIGNED",
    "what changes conditions on the way": r"\bhypofab_turn\b|\bturn\.(on|p|alpha)\b",
    "a key of the deck": r"given->from_start|\*from_start|, from_start\)",
    "a call for Python": r"\bfabric_rotate\b|core_fabric_rotate",
    "a kind of laboratory test": r"\bdrained_cyclic\b|DRAINED_CYCLIC",
    "a key of calibration files": r"\bfrom_sigma1\b",
    "a direct estimate": r"\bestimate_peak\b",
    "a subcommand": r"\bcmd_presets\b",
    "a command of the Python package": r"[\"/.]secants\b",
    "a quasi-random sequence": r"\breverse_halton\b",
    "a distribution of inputs": r"\buniform\b",
    "a figure of sweeps": r"\bsobol_bars\b",
    "an FE host's entry": r"\bvumat\b",
}
"""Sample of each row that is an addition to the sources, as a regular expression."""

ELSEWHERE = {"a kind of DEM run", "a page of documentation"}
"""Rows that are additions to examples and documentation: one file each."""


@cache
def sources() -> dict[str, str]:
    """Text of every file that is counted, by its path."""
    paths = [path for room in ROOMS for path in sorted((ROOT / room).rglob("*")) if path.suffix in SUFFIXES]
    return {path.relative_to(ROOT).as_posix(): path.read_text() for path in [*paths, ROOT / "CMakeLists.txt"]}


def table() -> dict[str, str]:
    """The numbers in the table of additions by what is added."""
    text = (ROOT / "docs/architecture.md").read_text()
    rows = text.partition("| you add |")[2].splitlines()[2:]
    cells = [row.strip("| ").split(" | ") for row in rows[: rows.index("")]]
    return {row[0]: row[-1] for row in cells}


def test_every_row_has_a_sample() -> None:
    assert set(table()) == SAMPLES.keys() | ELSEWHERE


@pytest.mark.parametrize("addition", SAMPLES)
def test_the_number_of_files_is_true(addition: str) -> None:
    naming = [path for path, text in sources().items() if re.search(SAMPLES[addition], f"{path}\n{text}")]
    assert naming
    assert table()[addition] == str(len(naming)), naming
