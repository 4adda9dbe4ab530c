"""What is wrong in a sweep is refused with file, line, key, value and what was expected, before anything runs."""

from pathlib import Path

import pytest
from sweep_models import INPUTS, OUTPUTS, deck, product

import hypofab

GOOD = """\
deck: deck.yaml
inputs:
  e:
    path: states[start].void_ratio
    uniform: [0.6, 0.9]
  phi: {path: "materials[sand].parameters.phi_c", values: [30, 33]}
design: {kind: sobol, runs: 4}
outputs:
  q: {quantity: q}
"""

DECK = """\
materials: [{name: sand, sand: hochstetten}]
states: [{name: start, material: sand, p: 100, void_ratio: 0.7, delta: {zero: true}}]
tests:
  - name: drained
    state: start
    steps: [{preset: drained_triaxial_compression, axis: z, until: {quantity: eps_zz, value: -0.02}}]
"""

# What is replaced, by what, and what the message says after the name of the file.
WRONG = (
    ("uniform: [0.6, 0.9]", "uniform: [0.9, 0.6]", r":5: inputs\.e\.uniform: \[0\.9, 0\.6\], expected two numbers"),
    ("uniform: [0.6, 0.9]", "uniform: [a, 0.6]", r":5: inputs\.e\.uniform\[0\]: a, expected two numbers"),
    ("uniform: [0.6, 0.9]", "gauss: [1, 2]", r":5: inputs\.e\.gauss: unknown key, expected one of path, values"),
    ("uniform: [0.6, 0.9]", "log_uniform: [0, 1]", r":5: inputs\.e\.log_uniform: .*, both > 0"),
    (
        "uniform: [0.6, 0.9]",
        "normal: {mean: 1, deviation: 0}",
        r":5: .*deviation: 0, expected a standard deviation > 0",
    ),
    ("uniform: [0.6, 0.9]", "normal: {mean: 1}", r":5: inputs\.e\.normal: key 'deviation' is missing"),
    (
        "uniform: [0.6, 0.9]",
        "values: [1, a]",
        r":5: inputs\.e\.values: .*, expected a list of numbers, or one of words",
    ),
    ("uniform: [0.6, 0.9]", "values: []", r":5: inputs\.e\.values: \[\], expected a list"),
    ("uniform: [0.6, 0.9]", "values: [1, .nan]", r":5: inputs\.e\.values\[1\]: nan, expected a number"),
    ("uniform: [0.6, 0.9]", "range: {from: 0, to: 1, count: 1}", r":5: inputs\.e\.range\.count: 1, expected a whole"),
    ("uniform: [0.6, 0.9]", "unit: m", r":7: design: input 'e' says not how it varies"),
    ("states[start].void_ratio", "states[begin].void_ratio", r":4: inputs\.e\.path: .*states has no entry 'begin'"),
    ("states[start].void_ratio", "states[7].void_ratio", r":4: inputs\.e\.path: .*states has no entry '7'"),
    ("states[start].void_ratio", "states.void_ratio", r":4: inputs\.e\.path: .*states is no mapping"),
    ("states[start].void_ratio", "states[start].void", r":4: inputs\.e\.path: states\[start\]\.void = .*unknown key"),
    ("states[start].void_ratio", "states[start", r":4: inputs\.e\.path: states\[start, expected a path like"),
    ("kind: sobol", "kind: latin", r":7: design\.kind: latin, expected one of grid, table, sobol"),
    ("kind: sobol", "kind: grid", r":7: design\.runs: unknown key, expected one of kind"),
    ("kind: sobol, runs: 4", "kind: grid", r":7: design: kind is grid, and input 'e' has a distribution"),
    ("runs: 4", "runs: 0", r":7: design\.runs: 0, expected a whole number, 1 or more"),
    ("runs: 4", "seed: 1", r":7: design: key 'runs' is missing"),
    ("runs: 4", "runs: 4, seed: -1", r":7: design\.seed: -1, expected a whole number"),
    ("runs: 4", "runs: 4, correlation: [[e, x, 0.5]]", r":7: design\.correlation\[0\]\[1\]: x, expected one of e, phi"),
    ("runs: 4", "runs: 4, correlation: [[e, phi, 1]]", r":7: .*: 1, expected a correlation above -1 and below 1"),
    ("kind: sobol, runs: 4", "kind: table, file: no.csv", r":7: design\.file: .*no\.csv"),
    ("quantity: q", "quantity: Q", r":9: outputs\.q\.quantity: Q, expected one of time, eps_xx"),
    ("quantity: q", "quantity: work2", r":9: outputs\.q\.quantity: work2, expected stability: true in the test"),
    ("quantity: q", "quantity: q, at: last", r":9: outputs\.q\.at: last, expected end, start, max"),
    ("quantity: q", "quantity: q, test: undrained", r":9: outputs\.q\.test: undrained, expected one of drained"),
    ("quantity: q", "quantity: q, over: eps_zz", r":9: outputs\.q: key 'to' is missing"),
    ("quantity: q", "quantity: q, points: 3", r":9: outputs\.q\.points: has a meaning only with over"),
    ("  q: {quantity: q}", "  e: {quantity: q}", r":8: outputs: the name 'e' is taken"),
    ("outputs:", "output:", r":8: output: unknown key, expected one of deck, inputs, design, outputs"),
    ("deck: deck.yaml", "deck: other.yaml", r"other\.yaml"),
    ("runs: 4}", "runs: 4", r":8: "),
)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "deck.yaml").write_text(DECK)
    return tmp_path


def test_the_sweep_that_they_spoil_is_good(folder: Path) -> None:
    (folder / "sweep.yaml").write_text(GOOD)
    assert hypofab.sweep(folder / "sweep.yaml", workers=1).done.all()


@pytest.mark.parametrize(("old", "new", "message"), WRONG, ids=[message for _, _, message in WRONG])
def test_a_wrong_file_is_refused_with_its_place(old: str, new: str, message: str, folder: Path) -> None:
    assert GOOD.count(old) == 1
    (folder / "sweep.yaml").write_text(GOOD.replace(old, new))
    begin = "" if message.startswith("other") else r"sweep\.yaml"
    with pytest.raises(hypofab.InputError, match=begin + message):
        hypofab.sweep(folder / "sweep.yaml", into=folder / "out", workers=1)
    assert not (folder / "out").exists()


def test_a_deck_that_is_wrong_is_refused_with_its_line(folder: Path) -> None:
    (folder / "sweep.yaml").write_text(GOOD)
    (folder / "deck.yaml").write_text(DECK.replace("void_ratio: 0.7", "void_ratio: x"))
    with pytest.raises(hypofab.InputError, match=r"deck\.yaml:2: .*void_ratio"):
        hypofab.sweep(folder / "sweep.yaml", workers=1)


def test_tables_that_do_not_fit(folder: Path) -> None:
    inputs = {"x": {}, "y": {}}
    for text, message in (
        ("x\n1\n", "expected a column 'y'; it has x"),
        ("x,y\n", "expected at least one row"),
        ("x,y\n1,2\n3,\n", "column 'y', row 2 is empty or no number"),
        ("x,y\n1,2\n3\n", "points.csv"),
    ):
        (folder / "points.csv").write_text(text)
        with pytest.raises(hypofab.InputError, match=message):
            hypofab.sweep(product, inputs, {"kind": "table", "file": str(folder / "points.csv")}, ["z"], workers=1)
    design = {"kind": "table", "points": {"x": [1, 2], "y": [1]}}
    with pytest.raises(hypofab.InputError, match=r"design\.points: .*expected columns of equal length"):
        hypofab.sweep(product, inputs, design, ["z"], workers=1)


def test_too_many_inputs_for_a_sequence() -> None:
    inputs = {f"x{index}": {"uniform": [0, 1]} for index in range(13)}
    with pytest.raises(hypofab.InputError, match=r"design: 13 dimensions, expected at most 12 with niederreiter"):
        hypofab.sweep(product, inputs, {"kind": "niederreiter", "runs": 2}, ["z"], workers=1)


def test_arguments_of_the_call() -> None:
    with pytest.raises(hypofab.InputError, match="workers = 0, expected 1 or more"):
        hypofab.sweep(deck(), INPUTS, {"kind": "sobol", "runs": 2}, OUTPUTS, workers=0)
    with pytest.raises(hypofab.InputError, match="sweep: key 'outputs' is missing"):
        hypofab.sweep(deck(), INPUTS, {"kind": "sobol", "runs": 2})
    with pytest.raises(hypofab.InputError, match=r"deck: 7, expected the name of a deck file"):
        hypofab.sweep(7, INPUTS, {"kind": "sobol", "runs": 2}, OUTPUTS)
    with pytest.raises(hypofab.InputError, match=r"inputs\.x\.path: a function takes its inputs by name"):
        hypofab.sweep(product, {"x": {"path": "x", "values": [1]}}, {"kind": "grid"}, ["z"])


def test_values_that_are_not_admissible_are_no_reason_to_refuse() -> None:
    inputs = {"e": {"path": "states[start].void_ratio", "values": [-1, -2]}}
    result = hypofab.sweep(deck(), inputs, {"kind": "grid"}, OUTPUTS, workers=1)
    assert not result.done.any()


def test_no_results_to_read(tmp_path: Path) -> None:
    with pytest.raises(hypofab.InputError, match=r"manifest\.json: No such file"):
        hypofab.read_sweep(tmp_path)
    (tmp_path / "manifest.json").write_text("{}")
    with pytest.raises(hypofab.InputError, match=r"manifest\.json: no manifest of a sweep"):
        hypofab.read_sweep(tmp_path)
