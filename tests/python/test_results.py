"""Reading result files."""

from pathlib import Path

import numpy as np
import pytest
from conftest import write_summary

from hypofab.results import ResultError, find_envelopes, read_envelope, read_run, read_summary, read_test


def test_columns_reach_their_fields(run_directory: Path) -> None:
    test = read_test(run_directory / "stiff.csv")
    assert test.name == "stiff"
    np.testing.assert_array_equal(test.strain[0], [10, 11, 12, 13, 14, 15])
    np.testing.assert_array_equal(test.stress[-1], [20, 21, 22, 23, 24, 25])
    np.testing.assert_array_equal(test.delta[3], [30, 31, 32, 33, 34, 35])
    np.testing.assert_allclose(test.q, 40e3 * test.eps_q)
    assert test.step[0] == 1
    assert test.step[-1] == 2


def test_run_keeps_the_order_of_the_deck_its_unit_and_its_sign(run_directory: Path) -> None:
    run = read_run(run_directory)
    assert [test.name for test in run.tests] == ["stiff", "soft"]
    assert (run.unit, run.compression_positive) == ("kPa", False)


def test_a_test_that_did_not_run_is_left_out(run_directory: Path) -> None:
    tests = read_summary(run_directory)["tests"]
    tests[1] |= {"file": None, "steps": []}
    write_summary(run_directory, tests, sign="compression_positive")
    run = read_run(run_directory)
    assert [test.name for test in run.tests] == ["stiff"]
    assert run.compression_positive


def test_envelope_series_in_file_order_and_sorted_by_angle(envelope_file: Path) -> None:
    inner, outer = read_envelope(envelope_file)
    assert (inner.name, outer.name) == ("inner", "outer")
    assert np.all(np.diff(outer.angle) > 0)
    np.testing.assert_allclose(np.hypot(outer.axial, outer.lateral), 30e3)
    assert inner.delta == (0, 0)
    assert outer.delta == (-1, 0)


def test_envelopes_are_told_from_tests(run_directory: Path, envelope_file: Path) -> None:
    assert run_directory == envelope_file.parent
    assert find_envelopes(run_directory) == [envelope_file]


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("", "header"),
        ("time,step\n", "at least one row"),
        ("time,step\n0,0\n1\n", "line 3: 1 fields"),
        ("time,step\n0,0\n", "no column eps_xx"),
        ("time,step\nx,0\n", "column time"),
    ],
)
def test_a_broken_table_is_refused_by_name(tmp_path: Path, content: str, message: str) -> None:
    path = tmp_path / "broken.csv"
    path.write_text(content)
    with pytest.raises(ResultError, match=message) as caught:
        read_test(path)
    assert str(path) in str(caught.value)


def test_missing_files_are_named(tmp_path: Path) -> None:
    with pytest.raises(ResultError, match=r"summary\.json"):
        read_summary(tmp_path)
    with pytest.raises(ResultError, match=r"absent\.csv"):
        read_test(tmp_path / "absent.csv")
