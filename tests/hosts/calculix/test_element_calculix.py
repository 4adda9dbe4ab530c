"""One element in CalculiX against the element test driver.

CalculiX writes seven digits. What the driver repeats is a strain path whose increments carry those rounding errors: of
5e-10 in a strain near 5e-3, which a stiffness of 2e5 kPa turns into 1e-4 kPa, that is 1e-6 of the stress.
"""

import json
import subprocess
from pathlib import Path

import numpy as np
import pytest
from calculix import PROGRAM, Run, run, start_of
from replay import Start, check_beyond_zero_stress, differences_from_path, differences_on_host_strain, preset

TOLERANCE = 1e-5

#: Times at the corners of PATH in path.inp.
CORNERS = (0.51, 0.61, 1.01)


def compare(result: Run, start: Start, folder: Path) -> None:
    """Stress, delta and void ratio of the host are those of the driver on the host's strain path."""
    moving = np.any(result.strain != 0, axis=1)  # nothing moves in the first increment
    differences = differences_on_host_strain(
        PROGRAM, folder, start, result.strain[moving], result.stress[moving], result.statev[moving]
    )
    iterations = [n for n, _ in result.attempts]
    print(f"{len(iterations)} increments and tries, {sum(iterations)} iterations, at most {max(iterations)} in one")
    assert max(differences) < TOLERANCE
    assert np.all(result.strain[~moving] == 0)
    assert np.allclose(result.stress[~moving], start.stress, atol=1e-9), "stress changes where nothing moves"


def difference_from(steps: list[str], result: Run, start: Start, folder: Path) -> float:
    """The largest difference of effective stress from a test the driver controls itself, at the corners of the path."""
    rows = [int(np.abs(result.time - time).argmin()) for time in CORNERS]
    return differences_from_path(
        PROGRAM, folder, start, steps, result.strain[rows], result.stress[rows], result.statev[rows]
    )


def test_drained_triaxial(tmp_path: Path) -> None:
    result, start = run("drained_triaxial", tmp_path), start_of("sand_cube.inp")
    compare(result, start, tmp_path)
    assert np.allclose(result.stress[:, :2], -100, rtol=1e-6)
    # The driver holds the lateral stress all the time, the host at the ends of its increments.
    steps = preset("drained_triaxial_compression", "drained_triaxial_extension")
    assert difference_from(steps, result, start, tmp_path) < 3e-3


def test_undrained_triaxial_with_pore_water_in_the_umat(tmp_path: Path) -> None:
    result, start = run("undrained_triaxial", tmp_path), start_of("sand_cube_undrained.inp")
    compare(result, start, tmp_path)
    assert np.allclose(result.stress[:, :2], -100, rtol=1e-6)
    # The water gives way a little: u/K_w.
    steps = preset("undrained_triaxial_compression", "undrained_triaxial_extension")
    assert difference_from(steps, result, start, tmp_path) < 3e-2


def test_lines_of_hypofab_delta(tmp_path: Path) -> None:
    """What `hypofab delta --format calculix` prints is read as the memory of the sample, shear included."""
    fabric = ["delta", "--N", ".318,.362,.320,.003,-.002,.004", "--R", "1e-4", "--axes", "x,z,-y"]
    lines, plain = (
        subprocess.run([PROGRAM, *fabric, *form], check=True, capture_output=True, text=True).stdout
        for form in (["--format", "calculix", "--points", "8"], ["--json"])
    )
    result, start = run("general_shear", tmp_path, lines), start_of("sand_cube.inp")
    start.delta = np.array(json.loads(plain)["delta"])
    assert np.abs(start.delta[3:]).min() > 1e-6
    compare(result, start, tmp_path)


def test_oedometer(tmp_path: Path) -> None:
    result, start = run("oedometer", tmp_path), start_of("sand_cube.inp")
    compare(result, start, tmp_path)
    steps = preset("oedometer_loading", "oedometer_unloading")
    assert difference_from(steps, result, start, tmp_path) < TOLERANCE


def test_beyond_zero_stress_and_back(tmp_path: Path) -> None:
    path = ("path.inp", "0.51,-0.005,0.61,-0.0045\n1.01,-0.0085", "0.51,0.01\n1.01,-0.002")
    result = run("oedometer", tmp_path, edit=path)
    assert not any(given_up for _, given_up in result.attempts)
    check_beyond_zero_stress(result.strain[:, 2], result.stress, result.statev[:, 12])


def test_plane_strain(tmp_path: Path) -> None:
    result, start = run("biaxial", tmp_path), start_of("sand_square.inp")
    compare(result, start, tmp_path)
    assert np.allclose(result.stress[:, 0], -100, rtol=1e-6)
    assert np.all(result.strain[:, 2] == 0)


def test_order_of_shear_components(tmp_path: Path) -> None:
    result = run("general_shear", tmp_path)
    assert np.min(np.abs(result.strain[-1, 3:])) > 1e-5  # all three shear strains
    compare(result, start_of("sand_cube.inp"), tmp_path)


def test_a_refused_increment_is_cut_and_goes_through(tmp_path: Path) -> None:
    result, start = run("step_cut", tmp_path), start_of("sand_cube_undrained.inp")
    assert "increment size decrease requested by a material user routine" in result.log
    assert [given_up for _, given_up in result.attempts] == [False, True, False, False]
    assert 2 * result.strain[-1, 4] == pytest.approx(2.4, rel=1e-2)
    compare(result, start, tmp_path)
