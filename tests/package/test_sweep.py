"""Sweeps: each row is what a single run gives; designs; runs that fail; outputs."""

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pyarrow.parquet as parquet
import pytest
from sweep_models import INPUTS, OUTPUTS, deck, end_pressure, product

import hypofab


def single(e: float, phi: float) -> hypofab.TestResult:
    one = deck(void_ratio=e)
    one["materials"][0]["parameters"] = {"phi_c": phi}
    return hypofab.run(one)["drained"]


def test_each_row_has_the_bits_of_a_single_run(tmp_path: Path) -> None:
    result = hypofab.sweep(deck(), INPUTS, {"kind": "sobol", "runs": 12}, OUTPUTS, into=tmp_path / "a", workers=2)
    assert np.array_equal(result["run"], np.arange(12))
    assert result.done.all()
    for row in range(12):
        rows = single(result["e"][row], result["phi"][row]).rows
        assert result["q"][row] == rows["q"][-1]
        # The grid of the curve falls on rows 0, 5, ..., 20, but for the last bits of the strain.
        assert result["curve"][row] == pytest.approx(rows["q"][::5], rel=1e-12)
    table = parquet.read_table(tmp_path / "a" / "results.parquet")
    assert table.equals(result.table)
    assert table.column_names == ["run", "e", "phi", "q", "curve", "status", "reason", "seconds"]
    again = hypofab.read_sweep(tmp_path / "a")
    assert again.table.equals(table)
    assert (again.inputs, again.outputs) == (("e", "phi"), ("q", "curve"))
    assert again.manifest["sweep"]["design"] == {"kind": "sobol", "runs": 12}


def test_a_file_a_mapping_and_a_function_give_the_same(tmp_path: Path) -> None:
    design = {"kind": "halton", "runs": 5, "seed": 3}
    here = hypofab.sweep(deck(), INPUTS, design, OUTPUTS, workers=1)
    (tmp_path / "deck.yaml").write_text(
        "materials: [{name: sand, sand: hochstetten}]\n"
        "states: [{name: start, material: sand, p: 1.0e+2, void_ratio: 7.0e-1, delta: {zero: true}}]\n"
        "tests:\n"
        "  - {name: drained, state: start, steps: [{preset: drained_triaxial_compression, axis: z, rows: 20,\n"
        "     until: {quantity: eps_zz, value: -0.02}}]}\n"
    )
    (tmp_path / "sweep.yaml").write_text(
        "deck: deck.yaml\n"
        "inputs:\n"
        "  e: {path: 'states[0].void_ratio', uniform: [0.6, 0.9]}\n"
        "  phi: {path: 'materials[sand].parameters.phi_c', uniform: [30, 36]}\n"
        "design: {kind: halton, runs: 5, seed: 3}\n"
        "outputs:\n"
        "  q: {quantity: q}\n"
        "  curve: {quantity: q, over: eps_zz, to: -0.02, points: 5}\n"
    )
    from_file = hypofab.sweep(tmp_path / "sweep.yaml", workers=1)

    def build(point: dict[str, float]) -> dict:
        one = deck(void_ratio=point["e"])
        return one | {"materials": [{"name": "sand", "sand": "hochstetten", "parameters": {"phi_c": point["phi"]}}]}

    free = {name: {key: value for key, value in one.items() if key != "path"} for name, one in INPUTS.items()}
    with ThreadPoolExecutor(2) as threads:
        built = hypofab.sweep(build, free, design, OUTPUTS, executor=threads)
    for result in (from_file, built):
        for name in ("e", "phi", "q", "curve"):
            assert np.array_equal(result[name], here[name]), name


def test_a_grid_has_every_combination_the_last_input_fastest() -> None:
    inputs = {"x": {"values": [1, 2]}, "y": {"range": {"from": 1, "to": 100, "count": 3, "spacing": "logarithmic"}}}
    result = hypofab.sweep(product, inputs, {"kind": "grid"}, ["z"], workers=1)
    assert result["x"].tolist() == [1, 1, 1, 2, 2, 2]
    assert result["y"] == pytest.approx([1, 10, 100, 1, 10, 100])
    assert np.array_equal(result["z"], result["x"] * result["y"])


def test_a_table_may_be_a_file_or_columns(tmp_path: Path) -> None:
    inputs = {"x": {}, "y": {}}
    (tmp_path / "points.csv").write_text("x,note,y\n1,a,2.5\n3,b,4.5\n")
    from_file = {"kind": "table", "file": str(tmp_path / "points.csv")}
    for design in (from_file, {"kind": "table", "points": {"x": [1, 3], "y": np.array([2.5, 4.5])}}):
        assert hypofab.sweep(product, inputs, design, ["z"], workers=1)["z"].tolist() == [2.5, 13.5]


def test_words_and_whole_numbers_vary_too() -> None:
    inputs = {
        "sand": {"path": "materials[0].sand", "values": ["hochstetten", "toyoura"]},
        "rows": {"path": "tests[drained].steps[0].rows", "values": [3, 7]},
    }
    delta = {"fabric": [0.3, 0.3, 0.4, 0, 0, 0], "c": 0.05}
    outputs = {"q": {"quantity": "q", "at": "rows"}}
    result = hypofab.sweep(deck(delta=delta), inputs, {"kind": "grid"}, outputs, workers=1)
    assert result.done.all(), result.failures()
    assert [len(rows) for rows in result.table["q"].to_pylist()] == [4, 8, 4, 8]
    ends = [rows[-1] for rows in result.table["q"].to_pylist()]
    assert ends[0] == pytest.approx(ends[1])
    assert abs(ends[0] - ends[2]) > 1


def test_one_input_may_have_several_places_and_c_is_one(examples: Path) -> None:
    delta = {"contacts": "data/aniso_3000_contacts.txt.gz", "particles": "data/aniso_3000_particles.txt.gz", "c": 0.05}
    inputs = {"c": {"path": ["states[start].delta.c"], "values": [0.05, 0.5]}}
    outputs = {"q": {"quantity": "q", "at": "rows"}}
    base = deck(delta=delta)
    result = hypofab.sweep(base, inputs, {"kind": "grid"}, outputs, folder=examples, workers=1)
    rows = hypofab.run(base, folder=examples)["drained"].rows
    # Contacts become their fabric tensor, with the same delta to the last bit.
    first, second = (np.array(curve) for curve in result.table["q"].to_pylist())
    assert np.array_equal(first, rows["q"])
    assert not np.array_equal(first, second)


def test_a_contact_file_that_changes_is_read_again(tmp_path: Path) -> None:
    base = deck(delta={"contacts": "normals.txt"})
    inputs = {"e": {"path": "states[start].void_ratio", "values": [0.7]}}
    found = []
    for third in ("0 0 1", "0.6 0 0.8"):
        (tmp_path / "normals.txt").write_text(f"nx ny nz\n1 0 0\n0 1 0\n{third}\n0.6 0.8 0\n")
        outputs = {"delta": {"quantity": "delta_xz", "at": "start"}}
        found.append(hypofab.sweep(base, inputs, {"kind": "grid"}, outputs, folder=tmp_path, workers=1)["delta"][0])
    assert found[0] == 0
    assert found[1] != 0


def test_correlated_inputs() -> None:
    normal = {"normal": {"mean": 10, "deviation": 2}}
    inputs = {"x": normal, "y": normal | {"unit": "m"}}
    design = {"kind": "sobol", "runs": 4096, "correlation": [["x", "y", -0.6]]}
    result = hypofab.sweep(product, inputs, design, ["z"], workers=1)
    assert np.corrcoef(result["x"], result["y"])[0, 1] == pytest.approx(-0.6, abs=0.01)
    assert result["y"].std() == pytest.approx(2, rel=0.01)


def test_a_run_that_fails_is_a_row_with_its_reason() -> None:
    inputs = {"e": {"path": "states[start].void_ratio", "values": [0.7, -1.0, 0.8]}}
    result = hypofab.sweep(deck(), inputs, {"kind": "grid"}, OUTPUTS, workers=1)
    assert result["status"].tolist() == [0, hypofab.Status.BAD_STATE, 0]
    assert np.isfinite(result["q"]).tolist() == [True, False, True]
    assert np.isnan(result["curve"][1]).all()
    ((reason, count),) = result.failures().items()
    assert count == 1
    assert "void_ratio = -1" in reason


@pytest.mark.parametrize("workers", [1, 2])
def test_many_points_at_once_by_the_batch(workers: int) -> None:
    inputs = {"p": {"values": [50.0, 100.0, 400.0]}, "e": {"values": [*np.linspace(0.6, 0.8, 100), 0.7123]}}
    result = hypofab.sweep(end_pressure, inputs, {"kind": "grid"}, ["p_end"], many=True, workers=workers)
    bad = result["e"] == 0.7123
    assert set(result["status"][bad]) == {hypofab.Status.INTERNAL_ERROR}
    assert result.failures() == {"ValueError: not this one": 3}
    assert result.done.sum() == 300
    sand = hypofab.Material.sand("hochstetten")
    for row in (0, 150, 301):
        start = hypofab.State.isotropic(result["p"][row], result["e"][row])
        assert result["p_end"][row] == pytest.approx(hypofab.update(sand, start, [0, 0, -1e-4, 0, 0, 0]).state.p)
    with pytest.raises(hypofab.InputError, match="with many=True a function of arrays"):
        hypofab.sweep(deck(), INPUTS, {"kind": "sobol", "runs": 2}, OUTPUTS, many=True)


def stopping() -> dict:
    """Compression under stress control beyond the peak: the test stops early at some 250 kPa."""
    one = deck()
    one["tests"][0]["steps"] = [
        {
            "control": {"xx": {"stress_rate": 0}, "yy": {"stress_rate": 0}, "zz": {"stress_rate": -1}},
            "until": {"quantity": "sig_zz", "value": -2000},
        }
    ]
    return one


def test_what_a_test_that_stopped_early_keeps() -> None:
    outputs = {
        "end": {"quantity": "q"},
        "peak": {"quantity": "q", "at": "max", "stopped": True},
        "strain": {"quantity": "eps_zz", "at": {"q": 100}},
        "late": {"quantity": "eps_zz", "at": {"q": 1500}},
        "curve": {"quantity": "eps_zz", "over": "q", "to": 1500, "points": 4},
    }
    inputs = {"e": {"path": "states[0].void_ratio", "values": [0.7]}}
    result = hypofab.sweep(stopping(), inputs, {"kind": "grid"}, outputs, workers=1)
    rows = hypofab.run(stopping())["drained"].rows
    assert result["status"].tolist() == [hypofab.Status.NOT_CONTROLLABLE]
    assert "loss of controllability" in result.table["reason"][0].as_py()
    assert np.isnan([result["end"][0], result["late"][0]]).all()
    assert result["peak"][0] == rows["q"].max()
    assert result["strain"][0] == pytest.approx(np.interp(100, rows["q"], rows["eps_zz"]))
    assert np.isnan(result["curve"][0]).tolist() == [False, True, True, True]


def test_outputs_at_rows() -> None:
    step = {"preset": "drained_triaxial_compression", "axis": "z", "until": {"quantity": "eps_zz", "value": -0.1}}
    one = deck()
    back = step | {"preset": "drained_triaxial_extension", "until": {"quantity": "eps_zz", "value": -0.09}}
    one["tests"][0]["steps"] = [step, back]
    outputs = {
        "start": {"quantity": "p", "at": "start"},
        "peak": {"quantity": "q", "at": "max", "step": 1},
        "at_peak": {"quantity": "eps_zz", "at": {"max": "q"}, "step": 1},
        "least": {"quantity": "eps_v", "at": {"min": "eps_v"}},
        "second": {"quantity": "q", "at": "start", "step": 2},
        "crossing": {"quantity": "q", "at": {"eps_zz": -0.0505}},
    }
    inputs = {"e": {"path": "states[0].void_ratio", "values": [0.65]}}
    result = hypofab.sweep(one, inputs, {"kind": "grid"}, outputs, workers=1)
    rows = hypofab.run(one | {"states": [one["states"][0] | {"void_ratio": 0.65}]})["drained"].rows
    first, second = rows[rows["step"] == 1], rows[rows["step"] == 2]
    expected = {
        "start": 100,
        "peak": first["q"].max(),
        "at_peak": first["eps_zz"][first["q"].argmax()],
        "least": rows["eps_v"].min(),
        "second": second["q"][0],
        "crossing": np.interp(0.0505, -first["eps_zz"], first["q"]),
    }
    assert {name: result[name][0] for name in outputs} == pytest.approx(expected, rel=1e-12)
