"""Run a sweep: what is already in its folder is kept, the rest is run on some executor and written as it comes."""

import os
from collections import Counter
from collections.abc import Callable, Generator, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import closing, nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pyarrow as pa
from tqdm import tqdm

from hypofab.drawing import draw
from hypofab.errors import InputError, Status
from hypofab.sweeps.plan import Plan, read_plan
from hypofab.sweeps.running import Rows, processors, run_here, run_in_processes, run_on
from hypofab.sweeps.source import Source, read_yaml
from hypofab.sweeps.store import Store, read_folder, read_manifest, table_of
from hypofab.tensors import Array

if TYPE_CHECKING:
    from hypofab.drawing import Figure


class _Bar(tqdm):
    """Without the thread that tqdm watches slow bars by: processes are forked beside it."""

    monitor_interval = 0


@dataclass(frozen=True, eq=False)
class SweepResult:
    """The table of a sweep: one row per run."""

    table: pa.Table
    """columns run, inputs, outputs, status (0: done), reason, seconds; `.to_pandas()` where pandas is installed"""
    manifest: Mapping[str, Any]
    """what was run"""
    folder: Path | None = None

    def __len__(self) -> int:
        """Number of runs."""
        return self.table.num_rows

    def __getitem__(self, name: str) -> Array:
        """A column as an array; a curve over a quantity as (runs, points)."""
        column = self.table[name]
        if not pa.types.is_list(column.type):
            return column.to_numpy()
        width = self.manifest["sweep"]["outputs"][name].get("points")
        if width is None:
            raise InputError(f"'{name}' has rows of different lengths: table['{name}'] has them", Status.BAD_ARGUMENT)
        missing = [np.nan] * int(width)
        return np.array([missing if curve is None else curve for curve in column.to_pylist()], dtype=np.float64)

    @property
    def inputs(self) -> tuple[str, ...]:
        """Names of what varies."""
        return tuple(self.manifest["sweep"]["inputs"])

    @property
    def outputs(self) -> tuple[str, ...]:
        """Names of what was kept."""
        return tuple(self.manifest["sweep"]["outputs"])

    @property
    def done(self) -> np.ndarray:
        """True for the runs that came to their end."""
        return self["status"] == 0

    def failures(self) -> dict[str, int]:
        """Reasons of runs that failed or stopped early, and how often each occurred."""
        return dict(Counter(self.table["reason"].drop_null().to_pylist()))

    def plot(self, kind: str = "scatter", **options: Any) -> "Figure":  # noqa: ANN401 - of the figure
        """A figure: "scatter" (outputs over inputs), "histograms", or "fan" of a curve (name="q").

        Options are those of the function of this name in hypofab.figures.sweeps.
        """
        kinds = ("scatter", "histograms", "fan")
        if kind not in kinds:
            raise InputError(f"kind = '{kind}', expected one of {', '.join(kinds)}", Status.BAD_ARGUMENT)
        return draw(f"sweeps.{kind}", self, **options)

    def unit(self, name: str) -> str:
        """The unit that an input or output was told to have, "" if none."""
        told = self.manifest["sweep"]
        entry = told["inputs"].get(name) or (told["outputs"][name] if isinstance(told["outputs"], Mapping) else {})
        return entry.get("unit", "")


def sweep(
    deck: str | os.PathLike | Mapping[str, Any] | Callable[[dict[str, Any]], Any],
    inputs: Mapping[str, Any] | None = None,
    design: Mapping[str, Any] | None = None,
    outputs: Mapping[str, Any] | Sequence[str] | None = None,
    *,
    many: bool = False,
    into: str | os.PathLike | None = None,
    folder: str | os.PathLike | None = None,
    executor: Executor | None = None,
    workers: int | None = None,
    progress: bool | None = None,
) -> SweepResult:
    """Run a deck, or a function, at many points; docs/sweeps.md.

    deck: a deck file, a deck as a mapping, a function of the point (a dict of the inputs) that gives a deck, tests or,
    where `outputs` is a list of names, the outputs themselves; alone: a sweep file.
    inputs, design, outputs: as in sweep files.
    many: the function takes arrays of the inputs of many points, and gives arrays: a mapping, a tuple in the order of
    the outputs, or one array. For what hypofab.update_many computes.
    into: folder for the results, where an interrupted sweep goes on; None: results stay in memory.
    folder: that of the paths in a mapping (default: here).
    executor: any of concurrent.futures; None: processes of this machine.
    workers: how many processes (default: one per processor; 1: in this process), or how many the executor has.
    progress: a bar on stderr (default: when that is a terminal).
    A run that fails is a row with its status and reason. Ctrl-C writes what has come and ends the sweep.
    """
    if inputs is None and design is None and outputs is None and isinstance(deck, str | os.PathLike):
        source = read_yaml(deck)
    else:
        given = {"deck": deck, "inputs": inputs, "design": design, "outputs": outputs}
        source = Source({key: value for key, value in given.items() if value is not None})
    return run_plan(
        read_plan(source, folder, many=many), into=into, executor=executor, workers=workers, progress=progress
    )


def run_plan(
    plan: Plan,
    *,
    into: str | os.PathLike | None = None,
    executor: Executor | None = None,
    workers: int | None = None,
    progress: bool | None = None,
) -> SweepResult:
    """Run what is left of a plan; arguments as of sweep()."""
    if workers is not None and workers < 1:
        raise InputError(f"workers = {workers}, expected 1 or more", Status.BAD_ARGUMENT)
    points = plan.points
    store = None if into is None else Store(Path(into), plan.manifest, points, plan.schema)
    kept: Rows = []
    with store or nullcontext():
        done = store.done() if store else np.zeros(0, dtype=np.int64)
        pending = np.setdiff1d(np.arange(points.num_rows), done)
        hidden = None if progress is None else not progress
        with (
            closing(_runs(plan, pending, executor, workers)) as runs,
            _Bar(total=points.num_rows, initial=len(done), unit="run", disable=hidden, smoothing=0.1) as bar,
        ):
            failed = 0
            for rows in runs:
                store.add(rows) if store else kept.extend(rows)
                failed += sum(row["status"] != 0 for row in rows)
                if failed:
                    bar.set_postfix(failed=failed, refresh=False)
                bar.update(len(rows))
        table = store.finish() if store else table_of(kept, points, plan.schema).sort_by("run")
    return SweepResult(table, plan.manifest, None if into is None else Path(into))


def _runs(
    plan: Plan, pending: np.ndarray, executor: Executor | None, workers: int | None
) -> Generator[Rows, None, None]:
    if executor is not None:
        return run_on(executor, plan.model, plan.points, pending, workers)
    count = min(workers or processors(), max(1, len(pending)))
    if count == 1:
        return run_here(plan.model, plan.points, pending)
    return run_in_processes(plan.model, plan.points, pending, count)


def read_sweep(folder: str | os.PathLike) -> SweepResult:
    """Results of a sweep from its folder; while it runs, or after it was interrupted, those that there are."""
    folder = Path(folder)
    manifest = read_manifest(folder)
    return SweepResult(read_folder(folder), manifest, folder)
