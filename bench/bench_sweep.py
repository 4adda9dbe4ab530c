"""What a sweep costs beside its runs: a drained triaxial test of 100 rows, alone, swept here and by processes.

    pip install '.[sweep]'
    python bench/bench_sweep.py [RUNS]

Times are wall-clock; processor time is that of this process and its workers together. Memory is the largest resident
set of this process, and of the largest worker.
"""

import os
import resource
import sys
import tempfile
import time
from collections.abc import Callable

import hypofab

STEP = {"preset": "drained_triaxial_compression", "axis": "z", "until": {"quantity": "eps_zz", "value": -0.1}}
DECK = {
    "materials": [{"name": "sand", "sand": "hochstetten"}],
    "states": [{"name": "start", "material": "sand", "p": 100, "void_ratio": 0.7, "delta": {"zero": True}}],
    "tests": [{"name": "drained", "state": "start", "steps": [STEP]}],
}
INPUTS = {
    "phi_c": {"path": "materials[sand].parameters.phi_c", "uniform": [32, 34]},
    "e": {"path": "states[start].void_ratio", "uniform": [0.68, 0.72]},
}
OUTPUTS = {
    "q_peak": {"quantity": "q", "at": "max"},
    "e_end": {"quantity": "void_ratio"},
    "q": {"quantity": "q", "over": "eps_zz", "to": -0.1, "points": 51},
}


def processor_seconds() -> float:
    """Of this process and of its children that have ended."""
    return sum(sum(resource.getrusage(who)[:2]) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))


def measure(title: str, runs: int, call: Callable[[], object]) -> None:
    """Print what a call takes."""
    wall, processor = time.perf_counter(), processor_seconds()
    call()
    wall, processor = time.perf_counter() - wall, processor_seconds() - processor
    print(f"{title:<42} {wall:8.2f} s {1e3 * wall / runs:8.3f} ms a run {1e3 * processor / runs:8.3f} ms processor")


def main() -> None:
    """Measure and print."""
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000
    design = {"kind": "sobol", "runs": runs}
    function = {name: {"uniform": one["uniform"]} for name, one in INPUTS.items()}
    study = hypofab.Study(DECK)
    hypofab.sweep(sum_of, function, {"kind": "sobol", "runs": 1}, ["y"], workers=1)  # imports

    measure("bare element test", 1000, lambda: [study.run_test("drained") for _ in range(1000)])
    measure("a function that does nothing", runs, lambda: hypofab.sweep(sum_of, function, design, ["y"], workers=1))
    few = {"kind": "sobol", "runs": 1000}
    measure("sweep, this process", 1000, lambda: hypofab.sweep(DECK, INPUTS, few, OUTPUTS, workers=1))
    with tempfile.TemporaryDirectory() as folder:
        into = os.path.join(folder, "sweep")
        measure(
            f"sweep of {runs}, two processes, into a folder",
            runs,
            lambda: hypofab.sweep(DECK, INPUTS, design, OUTPUTS, into=into, workers=2),
        )
        print(f"results.parquet: {os.path.getsize(os.path.join(into, 'results.parquet')) / 2**20:.1f} MiB")
    largest = [resource.getrusage(who).ru_maxrss / 1024 for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    print(f"memory: {largest[0]:.0f} MiB, workers {largest[1]:.0f} MiB each")


def sum_of(point: dict[str, float]) -> float:
    """A function that takes no time."""
    return point["phi_c"] + point["e"]


if __name__ == "__main__":
    main()
