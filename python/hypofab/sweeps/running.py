"""Runs of a sweep on an executor of concurrent.futures: in chunks, a few ahead, each result handed on as it comes."""

import multiprocessing
import multiprocessing.connection
import os
import pickle
import signal
import threading
import time
from collections import deque
from collections.abc import Callable, Generator, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, ProcessPoolExecutor, wait
from typing import Any

import numpy as np
import pyarrow as pa

from hypofab.errors import InputError, InternalError, Status
from hypofab.sweeps.models import Model, Outcome, Point, row_of, run_points

_CHUNK_SECONDS = 0.25
_LARGEST_CHUNK = 10_000
_AHEAD = 3  # chunks for each worker: one in work, the others waiting
_UNKNOWN_WORKERS = 64
ENDED = "the process that ran it ended (killed, or out of memory)"

Rows = list[dict[str, Any]]
Run = tuple[int, Point]


class _Queue:
    """What is still to run, cut into chunks that take a quarter of a second each, and get small towards the end."""

    def __init__(self, points: pa.Table, pending: np.ndarray, workers: int) -> None:
        self._points, self._pending, self._workers = points, pending, workers
        self._next = 0
        self._seconds = self._runs = 0.0

    def __bool__(self) -> bool:
        return self._next < len(self._pending)

    def learn(self, rows: Rows) -> None:
        self._seconds += sum(row["seconds"] for row in rows)
        self._runs += len(rows)

    def take(self) -> list[Run]:
        left = len(self._pending) - self._next
        fair = -(-left // (self._workers * _AHEAD))
        timely = int(_CHUNK_SECONDS * self._runs / self._seconds) if self._seconds > 0 else 1
        size = max(1, min(timely, fair, _LARGEST_CHUNK))
        numbers = self._pending[self._next : self._next + size]
        self._next += size
        return list(zip(numbers.tolist(), self._points.take(pa.array(numbers)).to_pylist(), strict=True))


def run_here(model: Model, points: pa.Table, pending: np.ndarray) -> Generator[Rows, None, None]:
    """One after the other in this process."""
    queue = _Queue(points, pending, 1)
    while queue:
        rows = run_points(model, queue.take())
        queue.learn(rows)
        yield rows


def run_on(
    executor: Executor, model: Model, points: pa.Table, pending: np.ndarray, workers: int | None
) -> Generator[Rows, None, None]:
    """On an executor of the caller's. workers: how many it has; None: not known."""
    count = workers or _UNKNOWN_WORKERS
    try:
        yield from _drive(_submit(executor, model), _Queue(points, pending, count), count)
    except Exception as error:  # a run does not raise: the executor has lost one, or cannot send it
        raise InternalError(f"the executor failed: {type(error).__name__}: {error}") from error


def run_in_processes(model: Model, points: pa.Table, pending: np.ndarray, workers: int) -> Generator[Rows, None, None]:
    """In processes of this machine. A run that ends its process is a row with that reason, and the others go on."""
    try:
        pickle.dumps(model)
    except Exception as error:
        expected = "a function that can be imported, or workers=1, or threads"
        raise InputError(f"{error}; processes need {expected}", Status.BAD_ARGUMENT) from error
    queue = _Queue(points, pending, workers)
    while queue:
        in_flight: dict[Future, list[Run]] = {}
        pool = _pool(workers)
        try:
            yield from _drive(_submit(pool, model), queue, workers, in_flight)
        except BrokenExecutor:
            for runs in in_flight.values():
                yield from _isolate(model, runs)
        finally:
            pool.shutdown(cancel_futures=True)


def _submit(executor: Executor, model: Model) -> Callable[[Sequence[Run]], Future]:
    return lambda runs: executor.submit(run_points, model, runs)


def _pool(workers: int) -> ProcessPoolExecutor:
    return ProcessPoolExecutor(workers, initializer=_start_worker)


def _start_worker() -> None:
    """Leave Ctrl-C to the parent, which lets workers finish what they have in work; end when the parent is killed."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, name="hypofab parent", daemon=True).start()


def _end_with_parent() -> None:
    if parent := multiprocessing.parent_process():
        multiprocessing.connection.wait([parent.sentinel])
    os._exit(1)


def _isolate(model: Model, runs: list[Run]) -> Generator[Rows, None, None]:
    """Runs of which one may have ended its process, in processes of their own: halved until it is found."""
    begun = time.perf_counter()
    with _pool(1) as pool:
        try:
            yield pool.submit(run_points, model, runs).result()
            return
        except BrokenExecutor:
            pass
    if len(runs) == 1:
        yield [row_of(runs[0][0], Outcome({}, Status.INTERNAL_ERROR, ENDED), time.perf_counter() - begun)]
        return
    half = len(runs) // 2
    yield from _isolate(model, runs[:half])
    yield from _isolate(model, runs[half:])


def _drive(
    submit: Callable[[Sequence[Run]], Future],
    queue: _Queue,
    workers: int,
    in_flight: dict[Future, list[Run]] | None = None,
) -> Generator[Rows, None, None]:
    """Keep the workers busy. in_flight: chunks without result, for who wants to know them after an exception."""
    in_flight = {} if in_flight is None else in_flight
    ready: deque[Future] = deque()
    try:
        while queue or in_flight:
            while queue and len(in_flight) < _AHEAD * workers:
                runs = queue.take()
                try:
                    future = submit(runs)
                except BrokenExecutor:
                    in_flight[Future()] = runs
                    raise
                in_flight[future] = runs
            ready.extend(wait(in_flight, return_when=FIRST_COMPLETED).done)
            while ready:
                future = ready.popleft()
                rows = future.result()
                del in_flight[future]
                queue.learn(rows)
                yield rows
    finally:
        for future in in_flight:
            future.cancel()


def processors() -> int:
    """Processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
