"""A strip footing in Kratos GeoMechanics, on sand with and without the memory of its fabric."""

import json
import subprocess

import numpy as np
import pytest
from kratos import EXAMPLES, PROGRAM, ROOT, Run, Step, read_json, run

#: Below this part of the first residual of a step, rounding shows.
FLOOR = 1e-13


def orders(step: Step) -> list[float]:
    """Observed orders of convergence of the last try: ln(r3/r2)/ln(r2/r1) once the residual falls tenfold at a time."""
    r = step.residuals[-1]
    return [
        float(np.log(c / b) / np.log(b / a))
        for a, b, c in zip(r, r[1:], r[2:], strict=False)
        if b < 0.1 * a and c > FLOOR * r[0]
    ]


def iterations(steps: list[Step]) -> list[int]:
    """Newton iterations of each step's last try."""
    return [len(step.residuals[-1]) - 1 for step in steps]


@pytest.fixture(scope="module")
def runs(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Run]:
    """The footing on each of the two sands."""
    results = {}
    for sand in ("sand_fabric", "sand_no_memory"):
        folder = tmp_path_factory.mktemp(sand)
        edit = [("strip_footing.json", "sand_fabric.json", f"{sand}.json")]
        results[sand] = run("run.py", ["strip_footing.json"], folder, edit=edit, before="strip_footing_mesh.py")
    return results


def test_delta_is_that_of_the_sample() -> None:
    data = ROOT / "examples" / "data"
    contacts, particles = (data / f"aniso_3000_{what}.txt.gz" for what in ("contacts", "particles"))
    answer = subprocess.run(
        [PROGRAM, "delta", contacts, "--particles", particles, "--R", "1e-4", "--c", "0.05", "--json"],
        check=True, capture_output=True,
    )  # fmt: skip
    expected = np.array(json.loads(answer.stdout)["delta"]) * [1, 1, 1, 2, 2, 2]
    statev = read_json(EXAMPLES / "sand_fabric.json")["properties"][0]["Material"]["Variables"]["STATE_VARIABLES"]
    assert np.allclose(statev[:6], expected, rtol=0, atol=1e-10)


def test_newton_iterations(runs: dict[str, Run]) -> None:
    print("| run | steps | cuts | iterations | most in a step | median order |")
    print("|---|---|---|---|---|---|")
    for name, result in runs.items():
        counts = iterations(result.steps)
        order = np.median([p for step in result.steps for p in orders(step)[-1:]])
        cuts = sum(step.cuts for step in result.steps)
        print(f"| {name} | {len(counts)} | {cuts} | {sum(counts)} | {max(counts)} | {order:.2f} |")
    print("\n| run | settlement [mm] | residual [kN/m] before each iteration and after the last |")
    print("|---|---|---|")
    for name, result in runs.items():
        for step in (result.steps[0], result.steps[len(result.steps) // 2], result.steps[-1]):
            residuals = " ".join(f"{r:.1e}" for r in step.residuals[-1])
            print(f"| {name} | {10 * step.time:g} | {residuals} |")
    for result in runs.values():
        last_orders = [p for step in result.steps for p in orders(step)[-1:]]
        assert np.median(last_orders) > 1.7, "the convergence is not quadratic"
        assert max(iterations(result.steps)) <= 10


def test_fabric_decides_the_settlement(runs: dict[str, Run]) -> None:
    """Without a memory every direction of strain is answered by m_R, with one only the full reversal is."""
    forces = {name: result.columns["footing_force"] for name, result in runs.items()}
    times = {name: result.columns["time"] for name, result in runs.items()}
    print("| settlement [mm] | " + " | ".join(f"force, {name} [kN/m]" for name in runs) + " |\n|---|---|---|")
    for time in (0.05, 0.1, 0.25, 0.5, 1.0):
        values = [np.interp(time, times[name], forces[name]) for name in runs]
        print(f"| {10 * time:g} | " + " | ".join(f"{2 * v:.1f}" for v in values) + " |")
    start = 100.0  # on half of the footing, under the stress at the start
    fabric, none = (np.interp(0.05, times[name], forces[name]) - start for name in runs)
    assert 0.8 * none < fabric < 0.95 * none
