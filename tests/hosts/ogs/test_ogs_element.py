"""One element in OpenGeoSys, through MGIS, against the element test driver."""

import json
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest
from opengeosys import PROGRAM, Run, run, start_of
from replay import (
    Array,
    Start,
    check_beyond_zero_stress,
    deck,
    norm,
    relative_difference,
    run_driver,
    strain_steps,
    tensor,
)

TOLERANCE = 1e-6

#: The path of most project files: direction, axial strain and time of its corners.
PATH = (("compression", -0.01, 1.0), ("extension", -0.008, 1.2))


def effective_stress(result: Run) -> Array:
    """Stress of the host plus the pore pressure that the behaviour keeps."""
    return result.tensors("sigma") + result.scalars("pore_pressure")[:, None] * [1, 1, 1, 0, 0, 0]


def check_homogeneous(result: Run) -> None:
    """One element: every node tells the same."""
    sigma = result.fields["sigma"]
    assert np.abs(sigma - sigma[:, :1]).max() < 1e-6 * np.abs(sigma).max()


def compare_replayed(result: Run, start: Start, folder: Path, tolerance: float = TOLERANCE) -> None:
    """Stress, delta and void ratio of the host are those of the driver on the host's strain path. Wants every step."""
    check_homogeneous(result)
    reference = run_driver(PROGRAM, folder, deck(start, strain_steps(result.tensors("epsilon")[1:])))
    stress = relative_difference(effective_stress(result)[1:], tensor(reference, "sig"))
    memory = float(norm(result.tensors("delta")[1:] - tensor(reference, "delta")).max() / start.props[11])
    void_ratio = float(np.abs(result.scalars("void_ratio")[1:] - reference["void_ratio"]).max())
    print(f"differences from the driver: stress {stress:.1e}, delta {memory:.1e} R, void ratio {void_ratio:.1e}")
    assert stress < tolerance
    assert memory < TOLERANCE
    assert void_ratio < TOLERANCE


def compare(result: Run, start: Start, steps: list[str], folder: Path) -> None:
    """Effective stress and void ratio at the corners of the path are those of the driver's own test."""
    check_homogeneous(result)
    reference = run_driver(PROGRAM, folder, deck(start, steps))
    corners = [int(np.abs(result.times - time).argmin()) for _, _, time in PATH]
    assert np.allclose(result.times[corners], [time for _, _, time in PATH])
    stress = relative_difference(effective_stress(result)[corners], tensor(reference, "sig"))
    void_ratio = float(np.abs(result.scalars("void_ratio")[corners] - reference["void_ratio"]).max())
    print(f"differences from the driver's own test: stress {stress:.1e}, void ratio {void_ratio:.1e}")
    assert stress < TOLERANCE
    assert void_ratio < TOLERANCE


def preset(compression: str, extension: str, axis: str = "z") -> list[str]:
    """Steps of the driver along the path by presets along an axis."""
    return [
        f"{{preset: {compression if way == 'compression' else extension}, axis: {axis}, "
        f"until: {{quantity: eps_{axis}{axis}, value: {end}}}, rows: 1}}"
        for way, end, _ in PATH
    ]


def test_drained_triaxial(examples: Path, tmp_path: Path) -> None:
    result, start = run(examples / "drained_triaxial.prj"), start_of(examples / "drained_triaxial.prj")
    assert np.allclose(result.tensors("sigma")[:, :2], -100, rtol=1e-9)
    compare(result, start, preset("drained_triaxial_compression", "drained_triaxial_extension"), tmp_path)


def test_undrained_triaxial_with_pore_water_in_the_behaviour(examples: Path, tmp_path: Path) -> None:
    result, start = run(examples / "undrained_triaxial.prj"), start_of(examples / "undrained_triaxial.prj")
    assert np.allclose(result.tensors("sigma")[:, :2], -100, rtol=1e-7)
    assert np.ptp(result.scalars("pore_pressure")) > 20
    compare_replayed(result, start, tmp_path)
    compare(result, start, preset("undrained_triaxial_compression", "undrained_triaxial_extension"), tmp_path)


def test_beyond_zero_stress_and_back(examples: Path) -> None:
    project = examples / "beyond_zero.prj"
    text = (examples / "oedometer.prj").read_text()
    assert "<values>0 -0.01 -0.008</values>" in text
    project.write_text(text.replace("<values>0 -0.01 -0.008</values>", "<values>0 0.01 -0.002</values>"))
    result = run(project)
    assert all(step.accepted for step in result.steps)
    check_beyond_zero_stress(result.tensors("epsilon")[:, 2], result.tensors("sigma"), result.scalars("substep"))


def test_oedometer(examples: Path, tmp_path: Path) -> None:
    result, start = run(examples / "oedometer.prj"), start_of(examples / "oedometer.prj")
    compare_replayed(result, start, tmp_path)
    compare(result, start, preset("oedometer_loading", "oedometer_unloading"), tmp_path)


def test_plane_strain(examples: Path, tmp_path: Path) -> None:
    result, start = run(examples / "biaxial.prj"), start_of(examples / "biaxial.prj")
    assert np.allclose(result.tensors("sigma")[:, 0], -100, rtol=1e-9)
    control = "{{control: {{xx: {{stress_rate: 0}}, yy: {{strain_rate: {rate}}}, zz: {{strain_rate: 0}}}}, "
    control += "until: {{quantity: eps_yy, value: {end}}}, rows: 1}}"
    steps = [control.format(rate=-1 if way == "compression" else 1, end=end) for way, end, _ in PATH]
    compare(result, start, steps, tmp_path)


def test_axial_symmetry(examples: Path, tmp_path: Path) -> None:
    result, start = run(examples / "axisymmetric_triaxial.prj"), start_of(examples / "axisymmetric_triaxial.prj")
    assert np.allclose(result.tensors("sigma")[:, [0, 2]], -100, rtol=1e-9)
    compare(result, start, preset("drained_triaxial_compression", "drained_triaxial_extension", "y"), tmp_path)


def test_order_of_shear_components(examples: Path, tmp_path: Path) -> None:
    result, start = run(examples / "general_strain.prj"), start_of(examples / "general_strain.prj")
    assert len(set(np.round(result.tensors("epsilon")[-1], 6))) == 6  # no two components are alike
    compare_replayed(result, start, tmp_path)


def test_lines_of_hypofab_delta(examples: Path, tmp_path: Path) -> None:
    """What `hypofab delta --format ogs` prints is read as the memory of the sample, shear included."""
    fabric = ["delta", "--N", ".318,.362,.320,.003,-.002,.004", "--R", "1e-4", "--axes", "x,z,-y"]
    lines, plain = (
        subprocess.run([PROGRAM, *fabric, *form], check=True, capture_output=True, text=True).stdout
        for form in (["--format", "ogs"], ["--json"])
    )
    project = examples / "pasted.prj"
    old = r" *<parameter><name>delta</name>.*</parameter>\n"
    text, count = re.subn(old, lambda _: lines, (examples / "general_strain.prj").read_text())
    assert count == 1
    project.write_text(text)
    result, start = run(project), start_of(project)
    start.delta = np.array(json.loads(plain)["delta"])
    assert np.abs(start.delta[3:]).min() > 1e-6
    compare_replayed(result, start, tmp_path)


def test_a_refused_step_is_halved_and_goes_through(examples: Path, tmp_path: Path) -> None:
    result, start = run(examples / "step_cut.prj"), start_of(examples / "step_cut.prj")
    assert [(step.time, step.refused, step.accepted) for step in result.steps] == [
        (1.0, True, False),
        (0.5, False, True),
        (1.0, False, True),
    ]
    assert 2 * result.tensors("epsilon")[-1, 4] == pytest.approx(2.4, rel=1e-9)
    # The tolerance of 1e-6 of the update is one of each substep; here hundreds of them make one increment.
    compare_replayed(result, start, tmp_path, tolerance=2e-5)
