"""The same sweep by processes, threads, Dask and MPI; a run that takes its process with it."""

import os
import shutil
import subprocess
import sys
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pyarrow.parquet as parquet
import pytest
from sweep_models import INPUTS, OUTPUTS, deck, fragile

import hypofab
from hypofab.decks.steps import deck_text

DESIGN = {"kind": "sobol", "runs": 30}


@pytest.fixture(scope="module")
def alone() -> hypofab.SweepResult:
    """In this process."""
    return hypofab.sweep(deck(), INPUTS, DESIGN, OUTPUTS, workers=1)


def assert_same(result: hypofab.SweepResult, alone: hypofab.SweepResult) -> None:
    for name in (*alone.inputs, "run", "q", "curve", "status"):
        assert np.array_equal(result[name], alone[name]), name


def test_processes(alone: hypofab.SweepResult) -> None:
    assert_same(hypofab.sweep(deck(), INPUTS, DESIGN, OUTPUTS, workers=2), alone)


def test_threads(alone: hypofab.SweepResult, tmp_path: Path) -> None:
    with ThreadPoolExecutor(2) as threads:
        assert_same(hypofab.sweep(deck(), INPUTS, DESIGN, OUTPUTS, executor=threads, into=tmp_path / "s"), alone)


def test_dask_with_two_workers(alone: hypofab.SweepResult, tmp_path: Path) -> None:
    from distributed import Client, LocalCluster

    with (
        LocalCluster(
            n_workers=2, threads_per_worker=1, dashboard_address=None, local_directory=str(tmp_path)
        ) as cluster,
        Client(cluster) as client,
    ):
        assert len(client.scheduler_info()["workers"]) == 2
        with client.get_executor(pure=False) as executor:
            assert_same(hypofab.sweep(deck(), INPUTS, DESIGN, OUTPUTS, executor=executor), alone)


def mpi(ranks: int, *arguments: str) -> subprocess.CompletedProcess:
    """Run `hypofab` on some ranks, also as root and with more ranks than processors."""
    mpiexec = shutil.which("mpiexec")
    if mpiexec is None:
        pytest.skip("no mpiexec: install openmpi-bin")
    allowed = dict.fromkeys(("OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"), "1")
    environment = os.environ | allowed | {"OMPI_MCA_rmaps_base_oversubscribe": "1"}
    command = [mpiexec, "-n", str(ranks), sys.executable, "-m", "hypofab", *arguments]
    return subprocess.run(command, env=environment, capture_output=True, text=True, check=False)


def test_mpi_with_two_ranks(alone: hypofab.SweepResult, tmp_path: Path) -> None:
    sweep = {"deck": deck(), "inputs": INPUTS, "design": DESIGN, "outputs": OUTPUTS}
    (tmp_path / "sweep.yaml").write_text(deck_text(sweep))
    done = mpi(2, "sweep", str(tmp_path / "sweep.yaml"), "-o", str(tmp_path / "out"), "--executor", "mpi")
    assert done.returncode == 0, done.stderr
    assert done.stdout.count("30 runs, 30 done") == 1
    assert_same(hypofab.read_sweep(tmp_path / "out"), alone)


def test_mpi_with_a_wrong_file_ends(tmp_path: Path) -> None:
    (tmp_path / "sweep.yaml").write_text("deck: nothing.yaml\n")
    arguments = ["sweep", str(tmp_path / "sweep.yaml"), "-o", str(tmp_path / "out"), "--executor", "mpi"]
    done = mpi(2, *arguments)
    assert done.returncode == 2
    assert "sweep.yaml: key 'inputs' is missing" in done.stderr


def test_a_function_that_processes_cannot_import() -> None:
    inputs = {"x": {"values": [1, 2]}}
    with pytest.raises(hypofab.InputError, match="processes need a function that can be imported"):
        hypofab.sweep(lambda point: point["x"], inputs, {"kind": "grid"}, ["y"], workers=2)
    assert hypofab.sweep(lambda point: point["x"], inputs, {"kind": "grid"}, ["y"], workers=1)["y"].tolist() == [1, 2]


class Failing(ThreadPoolExecutor):
    """Takes two chunks."""

    taken = 0

    def submit(self, *arguments: object) -> Future:
        """Take one more."""
        self.taken += 1
        if self.taken > 2:
            raise RuntimeError("no more")
        return super().submit(*arguments)


def test_an_executor_that_fails_ends_the_sweep_and_another_goes_on(tmp_path: Path) -> None:
    inputs = {"x": {"values": [0, 1, 2, 4, 6, 8]}}
    with Failing(1) as bad, pytest.raises(hypofab.InternalError, match="the executor failed: RuntimeError: no more"):
        hypofab.sweep(fragile, inputs, {"kind": "grid"}, ["y"], executor=bad, workers=1, into=tmp_path / "s")
    result = hypofab.sweep(fragile, inputs, {"kind": "grid"}, ["y"], workers=1, into=tmp_path / "s")
    assert np.array_equal(result["y"], result["x"])


def test_a_run_that_ends_its_process_is_a_row(tmp_path: Path) -> None:
    inputs = {"x": {"values": list(range(20))}}
    result = hypofab.sweep(fragile, inputs, {"kind": "grid"}, ["y"], into=tmp_path / "s", workers=2)
    assert np.flatnonzero(result["status"]).tolist() == [3, 5]
    reasons = result.table["reason"].to_pylist()
    assert reasons[3] == "ValueError: three is too many"
    assert reasons[5] == "the process that ran it ended (killed, or out of memory)"
    assert np.isnan(result["y"][[3, 5, 7]]).all()
    good = np.delete(np.arange(20), [3, 5, 7])
    assert np.array_equal(result["y"][good], good)
    assert parquet.read_table(tmp_path / "s" / "results.parquet").num_rows == 20
