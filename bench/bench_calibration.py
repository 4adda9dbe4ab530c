"""Calibrations of docs/calibration.md on laboratory tests: distances, unseen tests, time beside differential evolution.

    pip install . && pip install -r python/requirements-bench.txt
    python bench/bench_calibration.py hochstetten DIR [OUT]      both published sets and a fit
    python bench/bench_calibration.py karlsruhe DIR [OUT]        halves of the drained tests, each checked by the other
    python bench/bench_calibration.py evolution DIR              a fit beside scipy's differential evolution
    python bench/bench_calibration.py coverage [SAMPLES]         standard errors by a Monte Carlo on synthetic tests

DIR holds the files of the catalogue of laboratory tests (docs/laboratory.md). OUT: folder for reports and figures.
"""

import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import hypofab
from hypofab.figures.calibration import draw
from hypofab.laboratory.calibration import calibration_of
from hypofab.laboratory.catalogue import LabTest, load_catalogue
from hypofab.results.calibration import CalibrationResult, LabComparison

PLAIN = ("phi_c", "h_s", "n", "alpha", "beta")


def tests_of(material: str, *kinds: str) -> list[LabTest]:
    """Tests of the built-in catalogue."""
    return [test for test in load_catalogue() if test.material == material and test.kind in kinds]


def errors_at_equal_strain(test: LabComparison, columns: dict) -> dict[str, float]:
    """Root mean square of what is left of each quantity at equal axial strain (stress), over its measured range [%]."""
    drive = "sigma1" if test.kind == "oedometer" else "eps1"
    found = {}
    for name in test.scales:
        if name == drive:
            continue
        squares = []
        for leg in np.unique(test.measured["leg"]):
            here, there = test.measured["leg"] == leg, columns["leg"] == leg
            order = np.argsort(columns[drive][there])
            computed = np.interp(test.measured[drive][here], columns[drive][there][order], columns[name][there][order])
            squares.append((test.measured[name][here] - computed) ** 2)
        found[name] = 100 * float(np.sqrt(np.mean(np.concatenate(squares))) / np.ptp(test.measured[name]))
    return found


def table(result: CalibrationResult) -> None:
    """Distances and errors of each test, at the start and found."""
    print(f"{'test':8} {'use':6} {'distance [%]':>20}   rms at equal strain [%], start -> found")
    for test in result.tests:
        before, after = (errors_at_equal_strain(test, columns) for columns in (test.start, test.computed))
        rest = ", ".join(f"{name} {before[name]:.1f} -> {after[name]:.1f}" for name in before)
        print(f"{test.name:8} {test.use:6} {100 * test.start_distance:8.2f} -> {100 * test.distance:8.2f}   {rest}")
    for use in ("fit", "check"):
        chosen = [test for test in result.tests if test.use == use]
        if chosen:
            start, found = (
                np.sqrt(np.mean([getattr(test, key) ** 2 for test in chosen])) for key in ("start_distance", "distance")
            )
            print(f"{'all':8} {use:6} {100 * start:8.2f} -> {100 * found:8.2f}")
    for parameter in result.parameters:
        print(
            f"{parameter.name:8} {parameter.start:12.5g} -> {parameter.value:12.5g} +- {parameter.standard_error:.2g}"
        )
    print(f"{result.iterations} iterations, {result.runs} element tests, {result.seconds:.2f} s")
    for finding in result.findings:
        print(f"note: {finding}")


def fit(mapping: dict, out: Path | None) -> CalibrationResult:
    """Calibrate, print, and draw into a folder if one is given."""
    print(f"\n{mapping['calibration']}")
    result = hypofab.calibrate(mapping, directory=out)
    table(result)
    if out:
        draw(out, lambda figure, stem: figure.savefig(stem.with_suffix(".png"), dpi=120))
    return result


def hochstetten(directory: Path, out: Path | None) -> None:
    """From each published set."""
    tests = tests_of("Hochstetten sand", "oedometer", "drained_compression")
    for sand in ("hochstetten_1999", "hochstetten"):
        mapping = calibration_of(
            tests,
            directory,
            title=f"Hochstetten sand, from {sand}",
            free=PLAIN,
            sand=sand,
        )
        if sand == "hochstetten":
            mapping |= {"free": [*mapping["free"], "m_R", "m_T", "R"]}
        fit(mapping, out and out / f"from_{sand}")


def karlsruhe(directory: Path, out: Path | None) -> None:
    """Every other drained test by void ratio, then the others, then all; the oedometer tests go with each."""
    oedometers = tests_of("Karlsruhe fine sand", "oedometer")
    names = ["TMD01", "TMD04", "TMD07", "TMD09", "TMD11", "TMD14", "TMD17", "TMD22", "TMD19", "TMD24"]
    drained = {test.name: test for test in tests_of("Karlsruhe fine sand", "drained_compression")}
    splits = {"first": names[1::2], "second": names[::2], "all": []}
    for label, unseen in splits.items():
        mapping = calibration_of(
            [*oedometers, *(drained[name] for name in names)],
            directory,
            title=f"Karlsruhe fine sand, fitted half: {label}",
            free=PLAIN,
            only_compared=unseen,
            sand="karlsruhe_fine",
        )
        for entry in mapping["tests"]:  # 25 % of strain: the stiff beginning is a small part of the range
            if entry["kind"] == "drained_compression":
                entry["compare"] = {"eps1": 4, "q": 1, "eps_v": 1}
        fit(mapping, out and out / label)


def evolution(directory: Path) -> None:
    """The same objective, bounds and tests, minimised by differential evolution."""
    from scipy.optimize import differential_evolution

    tests = tests_of("Hochstetten sand", "oedometer", "drained_compression")
    mapping = calibration_of(
        tests,
        directory,
        title="Hochstetten sand",
        free=PLAIN,
        sand="hochstetten_1999",
    )
    calibration = hypofab.Calibration(mapping)
    begin, cpu = time.perf_counter(), time.process_time()
    result = calibration.run()
    wall, used = time.perf_counter() - begin, time.process_time() - cpu
    print(
        f"least squares: distance {result.distance:.6f}, {wall:.2f} s ({used:.2f} s of processor), {result.runs} tests"
    )
    logarithmic = calibration.upper > 20 * calibration.lower
    ends = np.array([calibration.lower, calibration.upper])
    ends = np.where(logarithmic, np.log(np.where(logarithmic, ends, 1.0)), ends)

    def objective(x: np.ndarray) -> float:
        return calibration.distance(np.where(logarithmic, np.exp(np.where(logarithmic, x, 0.0)), x)) ** 2

    begin, cpu = time.perf_counter(), time.process_time()
    found = differential_evolution(objective, list(ends.T), seed=1, tol=1e-6, polish=False, maxiter=300)
    wall, used = time.perf_counter() - begin, time.process_time() - cpu
    runs = found.nfev * len(tests)
    print(f"evolution:     distance {found.fun**0.5:.6f}, {wall:.2f} s ({used:.2f} s of processor), {runs} tests")


def synthetic(folder: Path, generator: np.random.Generator | None, noise: float) -> dict:
    """A calibration mapping on computed tests of Hochstetten sand; noise in all quantities but at the start."""
    sand = hypofab.Material.sand("hochstetten_1999")
    entries = []
    for name, e, p in (("oedometer", 0.85, 0.0), ("loose", 0.82, 100.0), ("dense", 0.65, 200.0)):
        stress = -np.array([4.5, 4.5, 10, 0, 0, 0]) if name == "oedometer" else -p * np.array([1, 1, 1, 0, 0, 0])
        state = hypofab.State(stress=stress, void_ratio=e)
        if name == "oedometer":
            ends = -10 * 100 ** (np.arange(1, 6) / 5)
            steps = [
                {"preset": "oedometer_loading", "axis": "z", "until": {"quantity": "sig_zz", "value": end}, "rows": 10}
                for end in ends
            ]
        else:
            until = {"quantity": "eps_zz", "value": -0.12}
            steps = {"preset": "drained_triaxial_compression", "axis": "z", "until": until, "rows": 50}
        rows = hypofab.element_test(sand, state, steps)
        if name == "oedometer":
            columns = {"sigma1": np.log(-rows["sig_zz"]), "e": rows["void_ratio"]}
            start = {"sigma1": 10, "K0": 0.45}
        else:
            columns = {"eps1": -rows["eps_zz"], "eps_v": -rows["eps_v"], "q": rows["q"]}
            start = {"sigma3": p}
        if generator is not None:
            for values in columns.values():
                values[1:] += noise * np.ptp(values) * generator.standard_normal(len(values) - 1)
        if name == "oedometer":
            columns["sigma1"] = np.exp(columns["sigma1"])
        path = folder / f"{name}.csv"
        np.savetxt(path, np.column_stack(list(columns.values())), delimiter=",", header=",".join(columns), comments="")
        kind = "oedometer" if name == "oedometer" else "drained_compression"
        entries.append(
            {"name": name, "kind": kind, "file": str(path), "void_ratio": e}
            | start
            | {"columns": {key: {"column": key} for key in columns}}
        )
    return {"calibration": "synthetic", "sand": "hochstetten_1999", "free": list(PLAIN), "tests": entries}


def coverage(samples: int) -> None:
    """How often 68 and 95 % intervals hold the truth."""
    generator = np.random.default_rng(5)
    truth = hypofab.Material.sand("hochstetten_1999")
    z = []
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(samples):
            result = hypofab.calibrate(synthetic(Path(folder), generator, 0.01))
            z.append([(p.value - getattr(truth, p.name)) / p.standard_error for p in result.parameters])
    z = np.array(z)
    print(f"{samples} samples, noise of 1 % of each range")
    for name, column in zip(PLAIN, z.T, strict=True):
        inside = [100 * np.mean(np.abs(column) < limit) for limit in (1.0, 1.96)]
        print(
            f"{name:8} bias {column.mean():6.2f} std. errors, scatter {column.std():5.2f}; "
            f"68 %: {inside[0]:5.1f} %, 95 %: {inside[1]:5.1f} %"
        )


def main() -> None:
    """Run one part."""
    if len(sys.argv) < 2 or sys.argv[1] not in ("hochstetten", "karlsruhe", "evolution", "coverage"):
        sys.exit(__doc__)
    part, *rest = sys.argv[1:]
    if part == "coverage":
        coverage(int(rest[0]) if rest else 200)
        return
    if not rest:
        sys.exit(f"{part}: no folder of laboratory tests was given")
    out = Path(rest[1]) if len(rest) > 1 else None
    if part == "evolution":
        evolution(Path(rest[0]))
    else:
        {"hochstetten": hochstetten, "karlsruhe": karlsruhe}[part](Path(rest[0]), out)


if __name__ == "__main__":
    main()
