"""Figures of sensitivities from result files: the linear model, what is drawn, what is refused."""

from pathlib import Path

import numpy as np
import pytest
from conftest import columns_of_test, write_csv, write_summary

from hypofab.__main__ import main
from hypofab.figures.sensitivities import curves
from hypofab.results import ResultError
from hypofab.results.sensitivities import read_sensitivities

MATERIAL = {"phi_c": 30.0, "h_s": 1e6, "p_t": 0.0, "n": 0.3, "e_d0": 0.5, "e_c0": 0.9, "e_i0": 1.1}
NUMBERS = ("phi_c", "h_s", "p_t")


@pytest.fixture
def directory(tmp_path: Path) -> Path:
    """A test "with", q growing by 2 per degree of phi_c and shifted in strain by h_s, and one "without"."""
    columns = columns_of_test(40e3)
    rows = len(columns["time"])
    write_csv(tmp_path / "without.csv", columns)
    write_csv(tmp_path / "with.csv", columns)
    derivatives = {f"d{quantity}/d{number}": np.zeros(rows) for number in NUMBERS for quantity in ("eps_q", "q")}
    derivatives["dq/dphi_c"] = np.full(rows, 2.0)
    derivatives["deps_q/dh_s"] = np.full(rows, 1e-9)
    derivatives |= {"dq/dc": np.ones(rows), "deps_q/dc": np.zeros(rows)}
    write_csv(tmp_path / "with_sensitivities.csv", {"time": columns["time"], "step": columns["step"]} | derivatives)
    tests = [
        {"name": name, "file": f"{name}.csv", "steps": [], "material": MATERIAL, "fabric": {"c": 0.05}, "initial": {}}
        for name in ("without", "with")
    ]
    write_summary(tmp_path, [*tests, {"name": "not run", "file": None, "steps": []}])
    return tmp_path


def test_curves_move_by_the_linear_model(directory: Path) -> None:
    (test,) = read_sensitivities(directory)
    assert test.name == "with"
    assert np.allclose(test.moved("phi_c", "q", 0.1), test.columns["q"] + 0.1 * 30 * 2)
    assert np.allclose(test.moved("h_s", "eps_q", -0.1), test.columns["eps_q"] - 0.1 * 1e-3)
    assert np.allclose(test.moved("c", "q", 0.2), test.columns["q"] + 0.2 * 0.05)


def test_numbers_that_are_zero_are_not_drawn(directory: Path) -> None:
    (test,) = read_sensitivities(directory)
    assert test.drawable() == ["phi_c", "h_s", "c"]
    panels = curves(test).axes
    assert [axes.texts[0].get_text() for axes in panels] == ["phi_c", "h_s", "c"]
    lower, upper, base = panels[0].lines
    assert np.allclose(upper.get_ydata() - base.get_ydata(), 6.0)
    assert np.allclose(lower.get_ydata() - base.get_ydata(), -6.0)
    with pytest.raises(ValueError, match="no sensitivities"):
        curves(test, numbers=[])


def test_plot_writes_the_figure(directory: Path) -> None:
    assert main(["plot", str(directory)]) == 0
    assert (directory / "with_sensitivities.png").exists()
    assert not (directory / "without_sensitivities.png").exists()


def test_another_table_of_this_name_is_refused(directory: Path) -> None:
    write_csv(directory / "without_sensitivities.csv", {"time": np.zeros(2), "other": np.zeros(2)})
    with pytest.raises(ResultError, match="column other"):
        read_sensitivities(directory)
