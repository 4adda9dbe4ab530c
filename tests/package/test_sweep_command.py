"""The command `hypofab sweep`, and figures of its results."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from sweep_models import INPUTS, OUTPUTS, deck, fragile

import hypofab
from hypofab.__main__ import main
from hypofab.decks.steps import deck_text

SOBOL = {"kind": "saltelli", "base": 8}


def write(folder: Path, **changed: object) -> Path:
    path = folder / "sweep.yaml"
    whole = {"deck": deck(), "inputs": INPUTS, "design": {"kind": "sobol", "runs": 20}, "outputs": OUTPUTS}
    path.write_text(deck_text(whole | changed))
    return path


def test_results_indices_and_figures(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = write(tmp_path, design=SOBOL)
    assert main(["sweep", str(path), "-o", str(tmp_path / "out"), "--workers", "1"]) == 0
    printed = capsys.readouterr()
    assert "32 runs, 32 done" in printed.out
    assert "first order" in printed.out
    assert printed.err == ""  # no terminal, no progress
    indices = json.loads((tmp_path / "out" / "sobol.json").read_text())
    assert indices["q"]["inputs"] == ["e", "phi"]
    assert len(indices["curve"]["total"][0]) == 5
    assert main(["plot", str(tmp_path / "out")]) == 0
    for name in ("scatter", "histograms", "fan_curve", "sobol"):
        assert (tmp_path / "out" / f"{name}.png").stat().st_size > 1000


def test_reasons_are_told_and_counted(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    inputs = {"e": {"path": "states[start].void_ratio", "values": [0.7, -1, 0.8]}}
    path = write(tmp_path, inputs=inputs, design={"kind": "grid"})
    assert main(["sweep", str(path), "-o", str(tmp_path / "out"), "--executor", "threads", "--figures"]) == 0
    printed = capsys.readouterr().out
    assert "3 runs, 2 done" in printed
    assert "  1 x " in printed
    assert "void_ratio = -1" in printed
    assert (tmp_path / "out" / "scatter.png").exists()


def test_bad_input_is_exit_code_2(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["sweep", str(tmp_path / "nothing.yaml"), "-o", str(tmp_path / "out")]) == 2
    assert "nothing.yaml: No such file" in capsys.readouterr().err
    path = write(tmp_path)
    assert main(["sweep", str(path), "-o", str(tmp_path / "out"), "--scheduler", "tcp://x"]) == 2
    assert "--executor dask" in capsys.readouterr().err


@pytest.mark.usefixtures("interruptible")
def test_interrupted_it_says_how_far_it_came(tmp_path: Path) -> None:
    path = write(tmp_path, design={"kind": "sobol", "runs": 100_000})
    command = [sys.executable, "-m", "hypofab", "sweep", path, "-o", tmp_path / "out", "--workers", "2"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        for _ in range(3000):
            if list(tmp_path.glob("out/rows/part-*.parquet")):
                break
            time.sleep(0.01)
        os.kill(process.pid, signal.SIGINT)
        printed, error = process.communicate()
    assert process.returncode == 1, error
    assert printed.startswith("interrupted: ")
    assert "of 100000 runs are done; the same command goes on" in printed
    assert len(hypofab.read_sweep(tmp_path / "out")) == int(printed.split()[1])


def test_progress_tells_what_is_left(capsys: pytest.CaptureFixture[str]) -> None:
    inputs = {"x": {"values": [1, 3]}}
    hypofab.sweep(fragile, inputs, {"kind": "grid"}, ["y"], workers=1, progress=True)
    shown = capsys.readouterr().err
    assert "2/2" in shown
    assert "failed=1" in shown
    hypofab.sweep(fragile, inputs, {"kind": "grid"}, ["y"], workers=1, progress=False)
    assert capsys.readouterr().err == ""


def test_labels_have_units_and_missing_outputs_show() -> None:
    inputs = {"e": {"path": "states[start].void_ratio", "values": [0.7, -1, 0.8]}}
    result = hypofab.sweep(deck(), inputs | {"phi": INPUTS["phi"]}, {"kind": "sobol", "runs": 12}, OUTPUTS, workers=1)
    axes = result.plot().axes
    assert [one.get_xlabel() for one in axes] == ["e [-]", "phi [deg]"]
    assert axes[0].get_ylabel() == "q [kPa]"
    assert "4 of 12 runs without" in result.plot("histograms").axes[0].get_title()
    fan = result.plot("fan", name="curve").axes[0]
    assert (fan.get_xlabel(), fan.get_ylabel()) == ("eps_zz [-]", "curve [kPa]")
    with pytest.raises(hypofab.InputError, match="'q' is no curve"):
        result.plot("fan", name="q")
    with pytest.raises(hypofab.InputError, match="kind = 'pie', expected one of scatter, histograms, fan"):
        result.plot("pie")


def test_the_examples_are_good(examples: Path) -> None:
    from hypofab.sweeps.plan import read_plan
    from hypofab.sweeps.source import read_yaml

    found = sorted((examples / "sweeps").glob("*.yaml"))
    assert [path.stem for path in found] == ["monte_carlo", "sobol_indices"]
    for path in found:
        plan = read_plan(read_yaml(path))
        for point in plan.points.slice(0, 2).to_pylist():
            outcome = plan.model(point)
            assert outcome.status == 0, outcome.reason
