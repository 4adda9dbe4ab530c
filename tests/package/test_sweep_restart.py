"""Sweeps that are killed, interrupted, continued or changed."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from sweep_models import deck, product, slow

import hypofab

INPUTS = {"x": {"uniform": [0, 1]}}
DESIGN = {"kind": "sobol", "runs": 600}
SCRIPT = """
import sys
import hypofab
from sweep_models import slow

if __name__ == "__main__":
    hypofab.sweep(slow, {"x": {"uniform": [0, 1]}}, {"kind": "sobol", "runs": 600}, ["y"], into=sys.argv[1], workers=2)
"""


def start(folder: Path) -> subprocess.Popen:
    script = folder.parent / "script.py"
    script.write_text(SCRIPT)
    environment = os.environ | {
        "PYTHONPATH": os.pathsep.join([str(Path(__file__).parent), os.environ.get("PYTHONPATH", "")])
    }
    return subprocess.Popen([sys.executable, script, folder], env=environment, stderr=subprocess.PIPE)


def ends(process: Path) -> bool:
    """Does a process of /proc end within a minute? One that has ended may wait for its new parent to take note."""
    for _ in range(6000):
        try:
            if (process / "stat").read_text().rpartition(")")[2].split()[0] == "Z":
                return True
        except OSError:
            return True
        time.sleep(0.01)
    return False


def rows_so_far(folder: Path, process: subprocess.Popen) -> hypofab.SweepResult:
    """What is written when the first rows are."""
    for _ in range(3000):
        assert process.poll() is None, process.stderr.read().decode()
        if list(folder.glob("rows/part-*.parquet")):
            return hypofab.read_sweep(folder)
        time.sleep(0.01)
    raise AssertionError("no rows after half a minute")


def workers_of(process: subprocess.Popen) -> list[Path]:
    """Folders in /proc that are there as long as the workers are; none where a system has no such list."""
    children = Path(f"/proc/{process.pid}/task/{process.pid}/children")
    return [Path(f"/proc/{pid}") for pid in children.read_text().split()] if children.exists() else []


def test_a_killed_sweep_goes_on_and_loses_nothing(tmp_path: Path) -> None:
    folder = tmp_path / "sweep"
    process = start(folder)
    rows_so_far(folder, process)
    with pytest.raises(hypofab.InputError, match="another process works on this sweep"):
        hypofab.sweep(slow, INPUTS, DESIGN, ["y"], into=folder, workers=1)
    workers = workers_of(process)
    os.kill(process.pid, signal.SIGKILL)
    process.communicate()
    before = hypofab.read_sweep(folder)
    assert 0 < len(before) < 600
    (folder / "rows" / "part-000099.parquet.tmp").write_bytes(b"half of a file")
    result = hypofab.sweep(slow, INPUTS, DESIGN, ["y"], into=folder, workers=8)  # they sleep, mostly
    assert np.array_equal(result["run"], np.arange(600))
    assert np.array_equal(result["y"], result["x"] ** 2)
    # What was written was not run again.
    assert np.array_equal(result["seconds"][before["run"]], before["seconds"])
    assert sorted(path.name for path in folder.iterdir()) == ["lock", "manifest.json", "results.parquet"]
    # The workers of the killed process have ended, too.
    assert all(ends(worker) for worker in workers)


@pytest.mark.usefixtures("interruptible")
def test_an_interrupted_sweep_writes_what_has_come(tmp_path: Path) -> None:
    folder = tmp_path / "sweep"
    process = start(folder)
    rows_so_far(folder, process)
    time.sleep(0.3)
    before = hypofab.read_sweep(folder)
    os.kill(process.pid, signal.SIGINT)
    _, error = process.communicate()
    assert b"KeyboardInterrupt" in error
    assert len(hypofab.read_sweep(folder)) > len(before)


def test_a_finished_sweep_is_not_run_again(tmp_path: Path) -> None:
    first = hypofab.sweep(product, {"x": {"values": [1, 2]}, "y": {"values": [3]}}, {"kind": "grid"}, ["z"], into=tmp_path / "s", workers=1)  # fmt: skip  # noqa: E501
    written = (tmp_path / "s" / "results.parquet").stat().st_mtime_ns
    again = hypofab.sweep(product, {"x": {"values": [1, 2]}, "y": {"values": [3]}}, {"kind": "grid"}, ["z"], into=tmp_path / "s", workers=1)  # fmt: skip  # noqa: E501
    assert again.table.equals(first.table)
    assert (tmp_path / "s" / "results.parquet").stat().st_mtime_ns == written


def test_another_sweep_in_the_same_folder_is_refused(tmp_path: Path) -> None:
    folder = tmp_path / "sweep"
    inputs = {"x": {"uniform": [0, 1]}, "y": {"uniform": [0, 1]}}
    hypofab.sweep(product, inputs, {"kind": "halton", "runs": 4}, ["z"], into=folder, workers=1)
    with pytest.raises(hypofab.InputError, match=r"manifest\.json: design\.runs was 4 there and is 5 here"):
        hypofab.sweep(product, inputs, {"kind": "halton", "runs": 5}, ["z"], into=folder, workers=1)
    with pytest.raises(hypofab.InputError, match=r"design\.seed is new"):
        hypofab.sweep(product, inputs, {"kind": "halton", "runs": 4, "seed": 0}, ["z"], into=folder, workers=1)
    other = inputs | {"x": {"uniform": [0, 2]}}
    with pytest.raises(hypofab.InputError, match=r"inputs\.x\.uniform\[1\] was 1 there and is 2 here"):
        hypofab.sweep(product, other, {"kind": "halton", "runs": 4}, ["z"], into=folder, workers=1)
    (folder / "manifest.json").unlink()
    with pytest.raises(hypofab.InputError, match=r"results without manifest\.json"):
        hypofab.sweep(product, inputs, {"kind": "halton", "runs": 4}, ["z"], into=folder, workers=1)


def test_a_table_with_other_content_is_another_sweep(tmp_path: Path) -> None:
    points = tmp_path / "points.csv"
    design = {"kind": "table", "file": str(points)}
    points.write_text("x,y\n1,2\n")
    hypofab.sweep(product, {"x": {}, "y": {}}, design, ["z"], into=tmp_path / "s", workers=1)
    points.write_text("x,y\n1,3\n")
    with pytest.raises(hypofab.InputError, match="points_sha256"):
        hypofab.sweep(product, {"x": {}, "y": {}}, design, ["z"], into=tmp_path / "s", workers=1)


def test_a_file_of_the_deck_with_other_content_makes_another_sweep(tmp_path: Path) -> None:
    (tmp_path / "normals.txt").write_text("nx ny nz\n1 0 0\n0 1 0\n0 0 1\n0.6 0.8 0\n")
    base = deck(delta={"contacts": "normals.txt"})
    inputs = {"c": {"path": "states[start].delta.c", "values": [0.05]}}

    def run() -> hypofab.SweepResult:
        design, outputs = {"kind": "grid"}, {"q": {"quantity": "q"}}
        return hypofab.sweep(base, inputs, design, outputs, folder=tmp_path, into=tmp_path / "s", workers=1)

    assert run().done.all()
    with (tmp_path / "normals.txt").open("a") as file:
        file.write("0 0.6 0.8\n")
    with pytest.raises(hypofab.InputError, match=r"files_sha256\.normals\.txt was"):
        run()
