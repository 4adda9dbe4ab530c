"""Accumulation over cycles: synthetic rows, and the program."""

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
from conftest import write_csv, write_summary

from hypofab.__main__ import main
from hypofab.figures.cycles import figure
from hypofab.results import ResultError
from hypofab.results.cycles import accumulation, read_accumulations, table

PROGRAM = os.environ.get("HYPOFAB_PROGRAM")


def write_cycles(path: Path, growth: float) -> None:
    """A monotonic step, then ten cycles that end at k growth and turn at 1 above; rows between reversals too."""
    cycle, value, step = [0.0, 0.0], [0.0, 0.5], [1, 1]
    for number in range(1, 11):
        start = (number - 1) * growth
        cycle += [number - 1, number - 1, number - 0.5, number - 0.5, number]
        value += [start + 0.2, start + 0.7, start + 1, start + 0.4, number * growth]
        step += [2] * 5
    write_csv(path, {"cycle": cycle, "step": step, "eps_zz": value, "q": value})


def test_values_at_reversals(tmp_path: Path) -> None:
    write_cycles(tmp_path / "a.csv", 0.01)
    found = accumulation(tmp_path / "a.csv", "eps_zz")
    assert found is not None
    np.testing.assert_array_equal(found.cycle, np.arange(1, 11))
    np.testing.assert_allclose(found.returned[:-1], 0.01 * found.cycle[:-1] + 0.7)  # the last row of each number
    assert found.returned[-1] == pytest.approx(0.1)
    np.testing.assert_allclose(found.turned, 0.01 * (found.cycle - 1) + 0.4)


def test_tests_without_cycles_are_left_out_and_wrong_names_refused(tmp_path: Path) -> None:
    write_cycles(tmp_path / "a.csv", 0.01)
    write_csv(tmp_path / "b.csv", {"cycle": [0.0, 0.0], "step": [1, 1], "eps_zz": [0.0, 0.1], "q": [0, 1]})
    write_summary(tmp_path, [{"name": name, "file": f"{name}.csv"} for name in ("a", "b", "c")][:2])
    assert [test.name for test in read_accumulations(tmp_path, "eps_zz")] == ["a"]
    with pytest.raises(ResultError, match="no test with cycles"):
        read_accumulations(tmp_path, "eps_zz", ["b"])
    with pytest.raises(ResultError, match="no test x"):
        read_accumulations(tmp_path, "eps_zz", ["x"])


def test_figure_shows_strain_in_percent_up_to_the_cycle_asked_for(tmp_path: Path) -> None:
    write_cycles(tmp_path / "a.csv", 0.01)
    found = accumulation(tmp_path / "a.csv", "eps_zz")
    axes = figure([found], "eps_zz", last=4).axes[0]
    np.testing.assert_allclose(axes.lines[0].get_ydata(), 100 * found.returned[:4])
    assert "[%]" in axes.get_ylabel()
    assert "[%]" not in figure([found], "q").axes[0].get_ylabel()
    assert "a  " in table([found], "eps_zz")


@pytest.mark.skipif(PROGRAM is None, reason="HYPOFAB_PROGRAM does not name the program")
def test_more_amplitude_accumulates_more(tmp_path: Path) -> None:
    """The programme of paper 002 with 60 cycles instead of 5,000, by two integrators."""
    deck = Path(__file__).resolve().parents[2] / "examples" / "stress_cycles.yaml"
    text = deck.read_text().replace("count: 5000", "count: 60").replace("every: 10", "every: 1")
    grown = {}
    for integrator in ("erk", "cvode"):
        path = tmp_path / f"{integrator}.yaml"
        path.write_text(text.replace("    tolerance: 1.0e-7", f"    integrator: {integrator}"))
        out = tmp_path / integrator
        subprocess.run([PROGRAM, "run", str(path), "-o", str(out)], check=True, capture_output=True)
        assert main(["cycles", str(out)]) == 0
        assert (out / "cycles.png").exists()
        grown[integrator] = {test.name: test.grown for test in read_accumulations(out, "eps_zz")}
    names = ["T40_hochstetten", "T20", "T30", "T40"]
    # After the first cycles the growth rises with the amplitude; the first ones take up what the consolidation left.
    late = {test.name: test.returned[-1] - test.returned[39] for test in read_accumulations(tmp_path / "erk", "eps_zz")}
    assert sorted(names, key=late.__getitem__) == names
    for name, value in grown["erk"].items():
        assert grown["cvode"][name] == pytest.approx(value, abs=1e-6 * 3e-3)  # 1e-6 of the strain
