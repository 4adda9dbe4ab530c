"""Figures of stability: where a measure vanishes, and which tests have any."""

from pathlib import Path

import numpy as np
import pytest
from conftest import columns_of_test, write_csv, write_summary

from hypofab.__main__ import main
from hypofab.figures.stability import figure
from hypofab.results.stability import PANELS, read_stability


@pytest.fixture
def directory(tmp_path: Path) -> Path:
    """A test "with" whose measures fall from 1 to -1, and one "without" such columns."""
    columns = columns_of_test(40e3)
    rows = len(columns["time"])
    write_csv(tmp_path / "without.csv", columns)
    write_csv(tmp_path / "with.csv", columns | {name: np.linspace(1, -1, rows) ** 3 for name, _ in PANELS})
    tests = [{"name": name, "file": f"{name}.csv", "steps": []} for name in ("without", "with")]
    write_summary(tmp_path, [*tests, {"name": "not run", "file": None, "steps": []}])
    return tmp_path


def test_only_tests_with_the_columns_are_drawn(directory: Path) -> None:
    (test,) = read_stability(directory)
    assert test.name == "with"
    assert test.first_loss("work2_ratio") == pytest.approx(1e-3)
    drawn = figure([test])
    assert [axes.get_ylabel() for axes in drawn.axes] == [title for _, title in PANELS]
    dot = drawn.axes[0].lines[-1]
    assert dot.get_xdata()[0] == pytest.approx(0.1)  # percent


def test_a_measure_that_stays_positive_is_never_lost(directory: Path) -> None:
    (test,) = read_stability(directory)
    test.columns["control_det"][:] = 1.0
    assert test.first_loss("control_det") is None


def test_plot_writes_the_figure(directory: Path) -> None:
    assert main(["plot", str(directory)]) == 0
    assert (directory / "stability.png").exists()
