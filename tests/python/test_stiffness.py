"""The table of directional stiffnesses."""

from pathlib import Path

import pytest
from conftest import write_summary

from hypofab.results import ResultError, paper000, read_summary
from hypofab.results.secants import secant_stiffness, table


def test_stiffness_of_each_test(run_directory: Path) -> None:
    assert secant_stiffness(run_directory) == {"stiff": 40e3, "soft": 10e3}


def test_stiffness_is_converted_to_kilopascals(run_directory: Path) -> None:
    write_summary(run_directory, read_summary(run_directory)["tests"], unit="MPa")
    assert secant_stiffness(run_directory) == {"stiff": 40e6, "soft": 10e6}


def test_a_test_stopped_in_its_first_step_has_no_stiffness(run_directory: Path) -> None:
    stiff, soft = read_summary(run_directory)["tests"]
    stiff["steps"] = [stiff["steps"][0] | {"reached": False}]
    write_summary(run_directory, [stiff, soft])
    assert secant_stiffness(run_directory) == {"soft": 10e3}
    write_summary(run_directory, [stiff])
    with pytest.raises(ResultError, match="no test"):
        secant_stiffness(run_directory)


def test_relative_values_refer_to_the_lowest_of_the_column() -> None:
    lines = table({"paper": paper000.ELEMENT_TEST, "partial": {"I-0": 2000.0, "extra": 1000.0}}).splitlines()
    rows = {line.split()[0]: line.split()[1:] for line in lines[3:]}
    # paper 000, Table 4: relative values of the element tests
    assert {name: row[:2] for name, row in rows.items() if name != "extra"} == {
        "A-0": ["114423", "2.15"],
        "A-90": ["53247", "1.00"],
        "I-0": ["57931", "1.09"],
        "I-90": ["57931", "1.09"],
    }
    assert rows["I-0"][2:] == ["2000", "2.00"]
    assert rows["A-0"][2:] == ["-"]
    assert rows["extra"] == ["-", "1000", "1.00"]
    assert len({len(line) for line in lines if not line.rstrip().endswith("-") or set(line) == {"-"}}) == 1
