"""A strip footing in OpenGeoSys: without memory, and with that of a DEM sample."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from opengeosys import PROGRAM, ROOT, Run, Step, in_own_order, parameters_of, run
from replay import PARAMETERS, Array, Start, deck, relative_difference, run_driver, strain_steps, tensor

DATA = ROOT / "examples" / "data"
RUNS = ("no memory", "DEM sample")

#: Residuals below this may be rounding [kN].
ROUNDING = 1e-10

TOLERANCE = 1e-6


@pytest.fixture(scope="module")
def delta(examples: Path) -> Array:
    """Intergranular strain of the anisotropic DEM sample, c = 0.05, R = 1e-4; the patch delta.xml is written too."""
    files = [DATA / "aniso_3000_contacts.txt.gz", "--particles", DATA / "aniso_3000_particles.txt.gz"]
    command = [PROGRAM, "delta", *files, "--R", "1e-4", "--c", "0.05", "--json"]
    printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    (examples / "delta.json").write_text(printed)
    subprocess.run([sys.executable, "delta_patch.py", "delta.json", "delta.xml"], cwd=examples, check=True)
    return np.array(json.loads(printed)["delta"])


@pytest.fixture(scope="module")
def footings(examples: Path, delta: Array) -> dict[str, Run]:
    """The two runs of footing.prj."""
    plain = run(examples / "footing.prj")
    (examples / "footing").rename(examples / "footing_no_memory")
    return dict(zip(RUNS, (plain, run(examples / "footing.prj", ["-p", "delta.xml"])), strict=True))


def load(footing: Run) -> Array:
    """Load on the whole footing [kN/m] over time, from the first step on."""
    x, y = footing.points[:, 0], footing.points[:, 1]
    under = (y > -1e-9) & (x < 0.5 + 1e-9)
    return 2 * np.abs(footing.fields["NodalForces"][:, under, 1].sum(axis=1))


def order(step: Step) -> float | None:
    """Order of convergence at the end of a step, from its last three residuals above rounding; None: too few."""
    r = [residual for residual in step.residuals if residual > ROUNDING][-3:]
    if len(r) < 3 or not r[0] > r[1] > r[2]:
        return None
    return float(np.log(r[2] / r[1]) / np.log(r[1] / r[0]))


def table(footing: Run) -> str:
    """What happened, step by step, as a table for docs/hosts.md."""
    lines = [
        "| settlement [mm] | load [kN/m] | iterations | cuts | residuals [kN] | order |",
        "|---|---|---|---|---|---|",
    ]
    loads = dict(zip(np.round(footing.times, 9), load(footing), strict=True))
    cuts = 0
    for step in footing.steps:
        if not step.accepted:
            cuts += 1
            continue
        residuals = " ".join(f"{r:.0e}" for r in step.residuals)
        last = order(step)
        shown = "" if last is None else f"{last:.2f}"
        # Iterations solve a linear system each; the last residual needs none.
        iterations = len(step.residuals) - 1
        value = loads[np.round(step.time, 9)]
        lines.append(f"| {step.time:.3f} | {value:.2f} | {iterations} | {cuts} | {residuals} | {shown} |")
        cuts = 0
    return "\n".join(lines)


@pytest.mark.parametrize("name", RUNS)
def test_newton_converges_quadratically(footings: dict[str, Run], name: str) -> None:
    footing = footings[name]
    print(f"\n{name}\n\n{table(footing)}")
    accepted = [step for step in footing.steps if step.accepted]
    iterations = [len(step.residuals) - 1 for step in accepted]
    orders = [value for value in map(order, accepted) if value is not None]
    print(
        f"\n{len(accepted)} steps, {sum(iterations)} iterations, {len(footing.steps) - len(accepted)} cuts, "
        f"order {np.median(orders):.2f} (median of {len(orders)})"
    )
    assert footing.times[-1] == pytest.approx(10)
    assert max(iterations) <= 12
    # The ground beside the edge comes to zero stress; the behaviour answers there and asks for no smaller step.
    assert len(accepted) == len(footing.steps)
    assert len(orders) >= len(accepted) // 2
    assert np.median(orders) > 1.7


def test_start(footings: dict[str, Run], delta: Array) -> None:
    plain, memory = (footings[name] for name in RUNS)
    assert np.all(plain.fields["delta"][0] == 0)
    assert np.allclose(memory.tensors("delta")[0][:4], delta[:4], rtol=1e-9)
    for footing in (plain, memory):
        # In equilibrium before the footing moves: what acts on the nodes of the first step is the settlement alone.
        assert footing.steps[0].residuals[0] < 1


@pytest.mark.parametrize("name", RUNS)
def test_points_under_and_beside_the_footing_follow_the_driver(
    examples: Path, footings: dict[str, Run], delta: Array, tmp_path: Path, name: str
) -> None:
    footing = footings[name]
    strain, stress = footing.at_points["epsilon_ip"], footing.at_points["sigma_ip"]
    parameters = parameters_of(examples / "footing.prj")
    props = [parameters[name][0] for name in PARAMETERS]
    memory = np.where(np.arange(6) < 4, delta, 0) if name == "DEM sample" else np.zeros(6)
    largest = 0.0
    # Evenly through the upper half of the ground, where strains are largest.
    for point in range(0, strain.shape[1] // 2, 97):
        sigma = in_own_order(stress[:, point])
        start = Start(props, sigma[0].tolist(), memory, props[-1])
        reference = run_driver(PROGRAM, tmp_path, deck(start, strain_steps(in_own_order(strain[1:, point]))))
        largest = max(largest, relative_difference(sigma[1:], tensor(reference, "sig")))
    print(f"largest difference of stress from the driver: {largest:.1e}")
    assert largest < TOLERANCE


def test_memory_matters(footings: dict[str, Run]) -> None:
    settlement = np.array([0.1, 1.5, 10.0])
    plain, memory = (np.interp(settlement, footings[name].times, load(footings[name])) for name in RUNS)
    for row in zip(settlement, plain, memory, strict=True):
        print(
            "settlement {:4.1f} mm: load {:6.2f} kN/m without memory, {:6.2f} kN/m with that of the sample".format(*row)
        )
    # Without memory every direction starts m_R times as stiff. The sample remembers vertical extension: the ground
    # under the footing, where that is reversed, starts as stiff; beside it, where the ground is heaved, it does not.
    assert np.all(memory < 0.99 * plain)
