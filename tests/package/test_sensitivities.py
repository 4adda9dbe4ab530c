"""Sensitivities from Python: the numbers of the program's file, differences of whole tests, figures in one line."""

import csv
from pathlib import Path

import numpy as np
import pytest

import hypofab

LOADING = hypofab.Step(preset="drained_triaxial_compression", axis="z", until=("eps_zz", -0.01), rows=10)


def test_the_numbers_of_the_file(examples: Path, tmp_path: Path) -> None:
    study = hypofab.Study(examples / "sensitivities.yaml")
    study.write(tmp_path)
    for name, result in study.run().items():
        with (tmp_path / f"{name}_sensitivities.csv").open(newline="") as file:
            rows = list(csv.DictReader(file))
        names = [column for column in rows[0] if column.startswith("d") and "/d" in column]
        assert len(names) == sum(len(of_one) for of_one in result.sensitivities.values())
        for number, derivatives in result.sensitivities.items():
            for quantity, values in derivatives.items():
                expected = [float(row[f"d{quantity}/d{number}"]) for row in rows]
                assert np.array_equal(values, expected, equal_nan=True), (name, quantity, number)


@pytest.mark.parametrize("stability", [False, True])
def test_they_are_derivatives(sand: hypofab.Material, state: hypofab.State, stability: bool) -> None:
    def run(h_s: float, numbers: tuple[str, ...] = ()) -> hypofab.TestResult:
        material = hypofab.Material(**(sand.parameters() | {"h_s": h_s}))
        return hypofab.element_test(
            material, state, LOADING, tolerance=1e-11, sensitivities=numbers, stability=stability and bool(numbers)
        ).check()

    result = run(sand.h_s, ("n", "h_s"))
    step = 1e-4 * sand.h_s
    for quantity in ("q", "p", "void_ratio", "delta_xx", "eps_q"):
        difference = (run(sand.h_s + step)[quantity] - run(sand.h_s - step)[quantity]) / (2 * step)
        derivative = result.sensitivities["h_s"][quantity]
        assert np.abs(derivative - difference).max() < 1e-5 * np.abs(difference).max()
    assert list(result.sensitivities) == ["n", "h_s"]
    assert "work2" not in result.sensitivities["n"]
    assert run(sand.h_s).sensitivities == {}


def test_a_figure_in_one_line(sand: hypofab.Material, state: hypofab.State) -> None:
    result = hypofab.element_test(sand, state, LOADING, sensitivities=["phi_c", "void_ratio", "p_t"])
    panels = result.plot("sensitivities", change=0.05).axes
    assert [axes.texts[0].get_text() for axes in panels] == ["phi_c", "void_ratio"]
    with pytest.raises(hypofab.InputError, match="with sensitivities"):
        hypofab.element_test(sand, state, LOADING).plot("sensitivities")


def test_refusals(sand: hypofab.Material, state: hypofab.State) -> None:
    with pytest.raises(hypofab.InputError, match="'phi' is no parameter"):
        hypofab.element_test(sand, state, LOADING, sensitivities=["phi"])
