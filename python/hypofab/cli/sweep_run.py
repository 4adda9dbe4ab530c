"""What `hypofab sweep FILE -o DIR` does, and the figures of its results."""

import argparse
import json
import sys
from collections.abc import Iterator
from concurrent.futures import Executor, ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from pathlib import Path

from hypofab.cli.saving import save
from hypofab.errors import InputError, Status
from hypofab.figures.sweeps import figures_of
from hypofab.sweeps.plan import read_plan
from hypofab.sweeps.running import processors
from hypofab.sweeps.sobol_indices import SobolIndices, sobol_indices, sobol_table
from hypofab.sweeps.source import read_yaml
from hypofab.sweeps.store import read_folder
from hypofab.sweeps.sweep import SweepResult, read_sweep, run_plan

DONE, STOPPED = 0, 1


def run(options: argparse.Namespace) -> int:
    """Run a sweep file; the exit code: 0 done, 1 interrupted, or not one run succeeded."""
    with _executor(options) as (executor, serves):
        if serves:
            return DONE
        plan = read_plan(read_yaml(options.file))
        progress = False if options.quiet else None
        try:
            result = run_plan(
                plan, into=options.output, executor=executor, workers=options.workers, progress=progress
            )  # fmt: skip
        except KeyboardInterrupt:
            done = read_folder(options.output, plan.schema).num_rows
            print(f"interrupted: {done} of {plan.points.num_rows} runs are done; the same command goes on")
            return STOPPED
    report(result)
    indices = _write_sobol(result, options.output)
    if options.figures:
        draw(result, options.output, indices)
    return DONE if result.done.any() else STOPPED


@contextmanager
def _executor(options: argparse.Namespace) -> Iterator[tuple[Executor | None, bool]]:
    """The executor that is asked for, None: processes; and whether this process has done its part by serving it."""
    if options.scheduler and options.executor != "dask":
        raise InputError("--scheduler has a meaning with --executor dask alone", Status.BAD_ARGUMENT)
    with ExitStack() as stack:
        executor: Executor | None = None
        serves = False
        if options.executor == "threads":
            executor = stack.enter_context(ThreadPoolExecutor(options.workers or processors()))
        elif options.executor == "dask":
            executor = _dask(options, stack)
        elif options.executor == "mpi":
            executor = _mpi(stack)
            serves = executor is None
        yield executor, serves


def _dask(options: argparse.Namespace, stack: ExitStack) -> Executor:
    from distributed import Client, LocalCluster

    where = options.scheduler
    if not where:
        workers = options.workers or processors()
        where = stack.enter_context(LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=None))
    return stack.enter_context(Client(where)).get_executor(pure=False)


def _mpi(stack: ExitStack) -> Executor | None:
    """On rank 0 the others as an executor; on those None, when there is nothing more to do."""
    from mpi4py import MPI
    from mpi4py.futures import MPICommExecutor

    if MPI.COMM_WORLD.size < 2:
        raise InputError("one rank, expected two or more: mpiexec -n 3 hypofab sweep ...", Status.BAD_ARGUMENT)
    return stack.enter_context(MPICommExecutor(MPI.COMM_WORLD, root=0))


def report(result: SweepResult) -> None:
    """How many runs there are, and why some failed."""
    print(f"{(result.folder or Path()) / 'results.parquet'}: {len(result)} runs, {int(result.done.sum())} done")
    reasons = sorted(result.failures().items(), key=lambda item: -item[1])
    for reason, count in reasons[:10]:
        print(f"  {count} x {reason}")
    if len(reasons) > 10:
        print(f"  and {len(reasons) - 10} more reasons: column reason")


def _write_sobol(result: SweepResult, folder: Path) -> dict[str, SobolIndices] | None:
    if result.manifest["sweep"]["design"]["kind"] != "saltelli":
        return None
    try:
        indices = sobol_indices(result)
    except InputError as error:  # the table stands, whatever the indices
        print(f"no Sobol indices: {error}", file=sys.stderr)
        return None
    path = folder / "sobol.json"
    temporary = path.with_suffix(".tmp")
    temporary.write_text(json.dumps({name: one.mapping() for name, one in indices.items()}, indent=1) + "\n")
    temporary.replace(path)
    print(sobol_table(indices))
    print(path)
    return indices


def draw(result: SweepResult, folder: Path, indices: dict[str, SobolIndices] | None = None) -> None:
    """All figures of a sweep, beside its results."""
    told = result.manifest["sweep"]
    if indices is None and told["design"]["kind"] == "saltelli" and len(result) == told["runs"]:
        indices = sobol_indices(result)
    for name, figure in figures_of(result, indices).items():
        save(figure, folder / name)


def draw_folder(folder: Path) -> None:
    """The same from the results alone."""
    draw(read_sweep(folder), folder)
