"""One element in Kratos GeoMechanics against the element test driver."""

import json
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest
from kratos import EXAMPLES, PROGRAM, Run, run, start_of
from replay import (
    Start,
    check_beyond_zero_stress,
    differences_from_path,
    differences_on_host_strain,
    preset,
    straight,
)

TOLERANCE = 1e-6
#: Of increments of half a unit of strain: each is one call, which may err by the tolerance of the UMAT, 1e-6.
TOLERANCE_OF_LARGE_INCREMENTS = 3e-6

#: Times at the corners of table 1 in cube.mdpa.
CORNERS = (0.5, 0.6, 1.0)


def host(parameters: str, folder: Path, edit: list[tuple[str, str, str]] | None = None) -> Run:
    """Run a parameter file of examples/fe/kratos; edit as of kratos.run."""
    return run("run.py", [parameters], folder, edit=edit)


def compare(result: Run, start: Start, folder: Path, tolerance: float = TOLERANCE) -> None:
    """Stress, delta and void ratio of the host are those of the driver on the host's strain path."""
    differences = differences_on_host_strain(PROGRAM, folder, start, result.strain, result.stress, result.statev)
    assert max(differences) < tolerance


def difference_from(steps: list[str], result: Run, start: Start, folder: Path) -> float:
    """The largest difference of effective stress from a test the driver controls itself, at the corners of the path."""
    rows = [int(np.abs(result.columns["time"] - time).argmin()) for time in CORNERS]
    return differences_from_path(
        PROGRAM, folder, start, steps, result.strain[rows], result.stress[rows], result.statev[rows]
    )


def test_drained_triaxial(tmp_path: Path) -> None:
    result, start = host("drained_triaxial.json", tmp_path), start_of("drained_triaxial.json")
    compare(result, start, tmp_path)
    assert np.allclose(result.stress[:, :2], -100, rtol=1e-9)


def test_undrained_triaxial_with_pore_water_in_the_umat(tmp_path: Path) -> None:
    result, start = host("undrained_triaxial.json", tmp_path), start_of("undrained_triaxial.json")
    compare(result, start, tmp_path)
    assert np.allclose(result.stress[:, :2], -100, rtol=1e-7)
    volume = result.strain[:, :3].sum(axis=1)
    assert np.allclose(result.statev[:, 7], -start.props[14] * volume, rtol=1e-6, atol=1e-6)


@pytest.mark.parametrize(("drainage", "steps"), [("drained", 4000), ("undrained", 8000)])
def test_small_steps_reach_the_test_that_the_driver_controls_itself(drainage: str, steps: int, tmp_path: Path) -> None:
    """The driver holds the lateral stress all the time, the host at the ends of its steps: hence thousands of them.

    Water with the bulk modulus of sand_undrained.json gives way by u/K_w: make it stiffer.
    """
    name = f"{drainage}_triaxial"
    edit = [
        (f"{name}.json", '"time_step": 0.01', f'"time_step": {1 / steps}'),
        ("sand_undrained.json", " 2e6,", " 1e11,"),
    ]
    result, start = host(f"{name}.json", tmp_path, edit), start_of(f"{name}.json")
    assert len(result.strain) >= steps
    assert difference_from(preset(f"{name}_compression", f"{name}_extension"), result, start, tmp_path) < TOLERANCE


def test_constant_volume_triaxial(tmp_path: Path) -> None:
    result, start = host("constant_volume_triaxial.json", tmp_path), start_of("constant_volume_triaxial.json")
    compare(result, start, tmp_path)
    assert difference_from(straight(-0.5), result, start, tmp_path) < TOLERANCE


def test_lines_of_hypofab_delta(tmp_path: Path) -> None:
    """What `hypofab delta --format kratos` prints is read as the memory of the sample, shear included."""
    fabric = ["delta", "--N", ".318,.362,.320,.003,-.002,.004", "--R", "1e-4", "--axes", "x,z,-y"]
    line, plain = (
        subprocess.run([PROGRAM, *fabric, *form], check=True, capture_output=True, text=True).stdout
        for form in (["--format", "kratos", "--void-ratio", "0.62"], ["--json"])
    )
    old = re.search(r'"STATE_VARIABLES": \[.*\]', (EXAMPLES / "sand.json").read_text()).group()
    result = host("drained_triaxial.json", tmp_path, [("sand.json", old, line.strip())])
    start = start_of("drained_triaxial.json")
    start.delta, start.void_ratio = np.array(json.loads(plain)["delta"]), 0.62
    compare(result, start, tmp_path)


def test_oedometer(tmp_path: Path) -> None:
    result, start = host("oedometer.json", tmp_path), start_of("oedometer.json")
    compare(result, start, tmp_path)
    assert difference_from(preset("oedometer_loading", "oedometer_unloading"), result, start, tmp_path) < TOLERANCE


def test_beyond_zero_stress_and_back(tmp_path: Path) -> None:
    path = ("cube.mdpa", "0.5 -0.0050\n0.6 -0.0045\n1.0 -0.0085", "0.5 0.01\n1.0 -0.002")
    result = host("oedometer.json", tmp_path, [path])
    assert sum(step.cuts for step in result.steps) == 0
    check_beyond_zero_stress(result.strain[:, 2], result.stress, result.statev[:, 12])


def test_plane_strain(tmp_path: Path) -> None:
    result, start = host("biaxial.json", tmp_path), start_of("biaxial.json")
    compare(result, start, tmp_path)
    assert np.allclose(result.stress[:, 0], -100, rtol=1e-9)
    assert np.all(result.strain[:, 2] == 0)


def test_order_of_shear_components(tmp_path: Path) -> None:
    result = run(Path(__file__).parents[1] / "general_shear.py", ["sand.json"], tmp_path)
    assert np.min(np.abs(result.strain[-1, 3:])) > 1e-5  # all three shear strains
    compare(result, start_of("oedometer.json"), tmp_path)


def test_a_refused_increment_is_cut_and_goes_through(tmp_path: Path) -> None:
    result, start = host("step_cut.json", tmp_path), start_of("step_cut.json")
    first = result.steps[0]
    assert first.cuts >= 1
    assert np.all(np.isnan(first.residuals[0])), "the UMAT did not refuse the whole step"
    assert np.isfinite(first.residuals[-1]).all()
    assert result.columns["time"][-1] == pytest.approx(1)
    assert 2 * result.strain[-1, 4] == pytest.approx(2.4, rel=1e-2)
    compare(result, start, tmp_path, TOLERANCE_OF_LARGE_INCREMENTS)
