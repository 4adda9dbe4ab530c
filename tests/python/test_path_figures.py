"""Void ratio over log p with limiting curves, loops of cycles, and measured data over computed."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from hypofab.__main__ import main
from hypofab.figures import stress_path, stress_strain, volumetric
from hypofab.figures.paths import axial_component, compression, loops
from hypofab.results import COMPONENTS, ResultError, read_run
from hypofab.results.measured import quantity, read_measured


def test_compression_shows_paths_over_the_logarithm_of_mean_stress(run_directory: Path) -> None:
    (axes,) = compression(read_run(run_directory)).axes
    assert axes.get_xscale() == "log"
    paths = [line for line in axes.lines if line.get_label() in ("stiff", "soft")]
    np.testing.assert_allclose(paths[0].get_ydata(), 0.6)
    assert not axes.texts  # the material is not known


@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize("compression_positive", [False, True])
def test_loops_are_drawn_over_the_axial_strain_in_compression(
    run_directory: Path, axis: int, compression_positive: bool
) -> None:
    run = replace(read_run(run_directory), compression_positive=compression_positive)
    sign = 1 if compression_positive else -1
    test = run.tests[0]
    stress, strain = np.full_like(test.stress, sign * 50.0), np.zeros_like(test.strain)
    strain[:, axis] = sign * np.linspace(0, 0.01, len(strain))
    stress[:, axis] += sign * 1e4 * np.linspace(0, 0.01, len(strain))
    rows = test.rows.copy()
    for index, component in enumerate(COMPONENTS):
        rows[f"sig_{component}"], rows[f"eps_{component}"] = stress[:, index], strain[:, index]
    rows["q_signed"] = 1e4 * np.linspace(0, 0.01, len(strain))
    test = replace(test, rows=rows)
    assert axial_component(test) == axis
    data = {"lab": {"eps_1": np.array([0.0, sign * 0.02]), "q": np.array([0.0, 200.0])}}
    drawn = {line.get_label(): line for line in loops(replace(run, tests=(test,)), measured=data).axes[0].lines}
    for line in (drawn["stiff"], drawn["lab"]):
        np.testing.assert_allclose(line.get_ydata(), 100 * line.get_xdata())


def test_measured_columns_by_their_other_names() -> None:
    columns = {"eps_1": np.array([0.0, 0.03]), "eps_v": np.array([0.0, -0.03]), "q": np.array([0.0, -5.0]), "e": [0.7]}
    np.testing.assert_allclose(quantity(columns, "eps_q"), [0, 0.04])
    np.testing.assert_allclose(quantity(columns, "q"), [0, 5])
    np.testing.assert_allclose(quantity(columns, "q_signed"), [0, -5])
    assert quantity(columns, "void_ratio") == [0.7]
    assert quantity(columns, "p") is None


def test_measured_data_are_drawn_where_they_have_the_columns(run_directory: Path, tmp_path: Path) -> None:
    file = tmp_path / "lab.csv"
    file.write_text("eps_q,q,eps_v,remark\n0,0,0,start\n0.001,30,-0.002,\n")
    data = read_measured({"lab": file})
    run = read_run(run_directory)
    drawn = {line.get_label(): line for line in stress_strain(run, measured=data).axes[0].lines}
    np.testing.assert_allclose(drawn["lab"].get_xydata(), [[0, 0], [0.1, 30]])
    assert drawn["lab"].get_linestyle() == "None"
    drawn = {line.get_label(): line for line in volumetric(run, compression_positive=True, measured=data).axes[0].lines}
    np.testing.assert_allclose(drawn["lab"].get_ydata(), [0, 0.2])
    assert "lab" not in [line.get_label() for line in stress_path(run, measured=data).axes[0].lines]
    with pytest.raises(ResultError, match="no_such"):
        read_measured({"lab": tmp_path / "no_such.csv"})


def test_plot_command_draws_measured_data(run_directory: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = run_directory / "stiff.csv"
    assert main(["plot", str(run_directory)]) == 0
    before = (run_directory / "stress_strain.png").read_bytes()
    assert main(["plot", str(run_directory), "--measured", f"laboratory={file}"]) == 0
    assert (run_directory / "stress_strain.png").read_bytes() != before
    assert main(["plot", str(run_directory), "--measured", "missing.csv"]) == 2
    assert "missing.csv" in capsys.readouterr().err
