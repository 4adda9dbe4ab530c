"""Tiny versions of the scripts of examples/dem: what they prescribe is there, and what they write can be read."""

import json
import os
import signal
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest
from conftest import Yade, command

from hypofab.cli.launch import run_json
from papers.runs import read_curve, read_dem, read_table


def cell(sides: list[float]) -> str:
    return ",".join(f"{side:.9g}" for side in sides)


def test_prepared_sample_carries_the_stress_in_its_contacts(sphere_sample: Path) -> None:
    run = read_dem(sphere_sample)
    assert run.results["stress_kPa"] == pytest.approx([-100] * 3, rel=0.003)
    assert run.results["unbalanced_force"] < 2e-3
    described = run_json("describe", run.contacts, "--particles", run.particles, "--cell", cell(run.results["sides_m"]))
    assert described["contacts"] == run.results["contacts"]
    assert described["coordination_number"] == pytest.approx(run.results["coordination_number"])
    assert np.diag(described["stress"]["total"]) == pytest.approx([-1e5] * 3, rel=0.003)


def test_anisotropy_of_the_manifest_is_that_of_hypofab(sphere_sample: Path) -> None:
    run = read_dem(sphere_sample)
    fabric = run_json("fabric", run.contacts)
    assert fabric["anisotropy"] == pytest.approx(run.results["anisotropy"], abs=1e-5)


def test_vertical_stress_comes_first(sphere_sample: Path) -> None:
    vertical = read_dem(sphere_sample).results["notes"]["vertical"]
    assert vertical["stress_kPa"][1] == pytest.approx(-100, rel=0.005)
    assert max(vertical["stress_kPa"][0], vertical["stress_kPa"][2]) < 0
    assert abs(vertical["stress_kPa"][0] + vertical["stress_kPa"][2]) / 2 < 100


def test_loading_holds_the_lateral_stress(yade: Yade, sphere_sample: Path, folder: Path) -> None:
    out = folder / "A-0"
    yade("load.py", "--out", out, "--sample", sphere_sample, "--strain", 0.002, "--snapshots", "0,0.1")
    curve = read_curve(out)
    assert curve.axial[-1] == pytest.approx(0.002, rel=0.05)
    assert curve.stress[:, [0, 2]] == pytest.approx(-100, rel=0.02)
    assert curve.q[-1] > 20
    assert curve.secant(1e-4) > curve.secant(1e-3) > 0
    changes = run_json("changes", out / "strain_00_contacts.txt.gz", out / "strain_01_contacts.txt.gz")
    assert changes["snapshots"][0]["loss"]["contacts"] < 0.2 * changes["contacts_before"]


def test_interrupted_run_continues(sphere_sample: Path, folder: Path) -> None:
    out = folder / "interrupted"
    words = command("load.py", "--out", out, "--sample", sphere_sample, "--strain", 0.004, "--checkpoint", 1)
    environment = {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "DISPLAY")}
    process = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=environment)
    for _ in range(300):
        time.sleep(0.1)
        if (out / "checkpoint.json").exists() or process.poll() is not None:
            break
    process.send_signal(signal.SIGKILL)
    process.wait()
    step = json.loads((out / "checkpoint.json").read_text())["scene"]
    again = subprocess.run(words, capture_output=True, text=True, env=environment, check=True)
    assert f"continued at step {step.split('_')[1].split('.')[0]}" in again.stdout
    rows = read_table(out, "history.txt")
    assert np.all(np.diff(rows["step"]) > 0)
    assert read_dem(out).results["notes"]
    assert not list(out.glob("checkpoint*"))
    finished = subprocess.run(words, capture_output=True, text=True, env=environment, check=True)
    assert "finished before" in finished.stdout


def test_folder_of_other_parameters_is_refused(yade: Yade, sphere_sample: Path) -> None:
    done = yade("prepare.py", "--out", sphere_sample, "--particles", 99, code=2)
    assert "choose another --out" in done.stderr


def test_sample_that_does_not_exist_is_refused(yade: Yade, folder: Path) -> None:
    done = yade("load.py", "--out", folder / "none", "--sample", folder / "missing", code=2)
    assert "no such file" in done.stderr


@pytest.mark.parametrize(
    ("script", "words", "message"),
    [
        ("prepare.py", ["--particles", 0], "0: expected a whole number of at least 40"),
        ("load.py", ["--sample", "SAMPLE", "--snapshots", "1,0.5"], "1,0.5: expected numbers that grow"),
        ("consolidate.py", ["--sample", "SAMPLE", "--stress", 100], "1 values"),
        ("probe_stress.py", ["--sample", "SAMPLE", "--tangent-to", "SAMPLE"], "expected one of probe_stress"),
    ],
)
def test_bad_options_are_named_and_leave_nothing(
    yade: Yade, sphere_sample: Path, folder: Path, script: str, words: list, message: str
) -> None:
    out = folder / "bad"
    done = yade(script, "--out", out, *(sphere_sample if word == "SAMPLE" else word for word in words), code=2)
    assert message in done.stderr
    assert not out.exists()


def test_stress_probes_at_failure(yade: Yade, sphere_sample: Path, folder: Path) -> None:
    out = folder / "004" / "lode0"
    yade(
        "probe_stress.py", "--out", out, "--sample", sphere_sample, "--directions", 4, "--duration", 60, "--quiet", 1e-4
    )
    run = read_dem(out)
    failure = np.array(run.results["notes"]["stress at failure [kPa]"])
    assert failure.mean() == pytest.approx(-100, rel=1e-3)
    assert failure[1] < failure[0] == pytest.approx(failure[2], rel=0.02)
    rows = read_table(out, "probes.txt")
    assert list(rows["number"]) == [0, 1, 2, 3, -1]
    size = np.sqrt(rows["dsig_x"] ** 2 + rows["dsig_y"] ** 2 + rows["dsig_z"] ** 2)
    assert size[:4] == pytest.approx(0.1, rel=1e-4)
    options = ["--sample", sphere_sample, "--directions", 1, "--duration", 60, "--quiet", 1e-4]
    yade("probe_stress.py", "--out", folder / "tangent", *options, "--tangent", 2)
    notes = read_dem(folder / "tangent").results["notes"]
    before, after = (np.array(notes[f"stress {name} [kPa]"]) for name in ("before the tangent", "of the probes"))
    # To larger Lode angles: x, which becomes the smallest compression, is relieved and z compressed. Where the sample
    # flows it takes back some of its deviator.
    assert (after - before)[[0, 2]] == pytest.approx([np.sqrt(2), -np.sqrt(2)], abs=0.5)
    both = [*options, "--tangent", 2, "--tangent-to", out]
    assert "not allowed with" in yade("probe_stress.py", "--out", folder / "both", *both, code=2).stderr


def test_strain_probes_are_what_was_asked_for(yade: Yade, disc_sample: Path, folder: Path) -> None:
    out = folder / "001" / "probes"
    options = ["--directions", 4, "--duration", 5, "--cycle", 0, "--size", 5e-4]
    yade("probe_strain.py", "--out", out, "--sample", disc_sample, *options)
    rows = read_table(out, "probes.txt")
    assert list(rows["alpha"]) == [0, 90, 180, 270, -1]
    assert np.hypot(rows["eps_x"], rows["eps_y"])[:4] == pytest.approx(5e-4, rel=1e-3)
    assert np.all(rows["dsig_x_kPa"][[0]] > 0)
    assert np.all(rows["dsig_x_kPa"][[2]] < 0)
    hold = rows["alpha"] < 0
    assert abs(rows["dsig_x_kPa"][hold][0]) < 0.01 * rows["dsig_x_kPa"].max()
    lists = [out / f"alpha_{alpha:05.1f}_contacts.txt.gz" for alpha in rows["alpha"][~hold]]
    fan = run_json("changes", out / "before_contacts.txt.gz", *lists, "--angles", "0,90,180,270", "--strain", "5e-4")
    assert [snapshot["angle"] for snapshot in fan["snapshots"]] == [0, 90, 180, 270]
    assert fan["contacts_before"] > 100


def test_layers_of_clumps(yade: Yade, folder: Path) -> None:
    out = folder / "layers"
    yade(
        "deposit.py",
        "--out",
        out,
        "--method",
        "layers",
        "--particles",
        40,
        "--preparation-friction",
        10,
        "--stiffness",
        1e5,
    )
    run = read_dem(out)
    assert run.results["particles"] == 40
    assert run.results["stress_kPa"][:2] == pytest.approx([-500] * 2, rel=0.005)
    assert 0.1 < run.results["void_ratio"] < 0.4


def test_consolidation_and_cycles(yade: Yade, wall_sample: Path, folder: Path) -> None:
    k069 = folder / "k069"
    yade("consolidate.py", "--out", k069, "--sample", wall_sample, "--stress", 103.7, 150.3, "--duration", 60)
    assert read_dem(k069).results["stress_kPa"][:2] == pytest.approx([-103.7, -150.3], rel=0.003)
    out = folder / "T20"
    yade("cycle.py", "--out", out, "--sample", k069, "--amplitude", 0.02, "--cycles", 2, "--duration", 8)
    rows = read_table(out, "cycles.txt")
    assert list(rows["cycle"]) == [0, 1, 2]
    assert rows["sig_x_kPa"] + rows["sig_y_kPa"] == pytest.approx(-254, rel=0.005)
    assert np.all(rows["eps_y_peak"][1:] < rows["eps_y"][1:])
