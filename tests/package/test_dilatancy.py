"""Stress and dilatancy: closed forms and what the figures show."""

from pathlib import Path

import numpy as np
import pytest

import hypofab
from hypofab.__main__ import main
from hypofab.figures.dilatancy import critical_states, stress_dilatancy
from hypofab.results import ResultError
from hypofab.results.drained import (
    DrainedTest,
    critical_ratio,
    dilatancy_points,
    read_drained,
    rowe,
)

SAND = hypofab.Material.sand("hochstetten").replace(phi_c=30.0)


def drained(slope: float, end: float = 0.2) -> DrainedTest:
    """A test with a constant dilatancy, q = 3 (p - 100) and p from 100 to 200."""
    eps_1 = np.linspace(0, end, 401)
    p = 100 + 100 * eps_1 / end
    return DrainedTest("linear", eps_1, slope * eps_1, 3 * (p - 100), p, 0.7 - slope * eps_1)


def test_points_have_the_slope_and_the_ratio_of_the_rows() -> None:
    points = dilatancy_points(drained(-0.4), levels=(0.01, 0.1, 0.199))
    np.testing.assert_allclose(points.dilatancy, [-0.4, -0.4], atol=1e-12)  # the last level is too near the end
    np.testing.assert_allclose(points.ratio, [15 / 105, 1.0], rtol=1e-10)


def test_rowe_passes_through_the_critical_state_and_isotropic_loading() -> None:
    assert rowe(0.0, 30.0) == pytest.approx(critical_ratio(30.0))
    assert critical_ratio(30.0) == pytest.approx(1.2)
    assert rowe(1 - 1 / 3, 30.0) == pytest.approx(0.0)  # tan^2(60) = 3: s1 = s3
    assert np.all(np.diff(rowe(np.linspace(-1, 0.5, 20), 30.0)) < 0)


def test_open_points_are_not_critical_yet() -> None:
    figure = critical_states({"a": [drained(0.0)], "b": [drained(-0.4)]}, SAND)
    faces = {line.get_label(): line.get_markerfacecolor() for line in figure.axes[0].lines}
    assert faces["a"] != "none"
    assert faces["b"] == "none"


def test_example_reaches_the_critical_state(tmp_path: Path) -> None:
    """Ends of all six tests on the model's own lines; stresses and slopes near Rowe's; undrained tests left out."""
    deck = Path(__file__).resolve().parents[2] / "examples" / "drained_series.yaml"
    hypofab.Study(deck).write(tmp_path)
    ((title, tests),), parameters = read_drained(tmp_path)[0].items(), read_drained(tmp_path)[1]
    assert len(tests) == 6
    for test in tests:
        material = parameters[title]
        assert test.q[-1] / test.p[-1] == pytest.approx(critical_ratio(material["phi_c"]), rel=0.02)
        critical = hypofab.Material(**material).limiting_void_ratios(test.p[-1])[0, 1]
        assert test.void_ratio[-1] == pytest.approx(critical, rel=0.02)
        points = dilatancy_points(test)
        late = np.abs(points.dilatancy) < 0.2
        np.testing.assert_allclose(points.ratio[late], rowe(points.dilatancy[late], material["phi_c"]), rtol=0.05)
    assert main(["dilatancy", str(tmp_path)]) == 0
    assert (tmp_path / "critical_states.png").exists()

    undrained = deck.with_name("undrained_triaxial.yaml")
    hypofab.Study(undrained).write(tmp_path / "u")
    with pytest.raises(ResultError, match="no drained triaxial"):
        read_drained(tmp_path / "u")


def test_stress_dilatancy_has_a_column_for_each_group_and_one_scale() -> None:
    figure = stress_dilatancy({"a": [drained(0.0)], "b": [drained(-0.4), drained(-0.2)]}, 30.0)
    left, right = figure.axes
    assert left.get_ylim() == right.get_ylim()
    assert [len(axis.lines) for axis in figure.axes] == [2, 3]
