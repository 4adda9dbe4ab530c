"""Stress cycles at constant mean stress s' (paper 002): t grows by --amplitude times s' and returns, many times.

    yade -x -n -j1 cycle.py --out out/T40 --sample out/k069 --amplitude 0.04 --cycles 100

y is the axial direction: sigma_y = s' + t, sigma_x = s' - t. cycles.txt.gz has one row per cycle, for its end.
"""

import argparse
import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))

import numpy as np
from common import export, options
from common.material import SERVO_PERIOD
from common.sample import start_run
from common.simulation import Simulation, Stage
from yade import O

COLUMNS = [
    "cycle",
    "step",
    "eps_x",
    "eps_y",
    "sig_x_kPa",
    "sig_y_kPa",
    "void_ratio",
    "coordination_number",
    "mechanical_coordination_number",
    "deviator_fabric",
    "eps_y_peak",
    "unbalanced",
]
FORMATS = ["%d", "%d", "%.6e", "%.6e", "%.5g", "%.5g", "%.6f", "%.5f", "%.5f", "%.6f", "%.6e", "%.1e"]


def parse() -> tuple[argparse.Namespace, dict]:
    """The options of this script."""
    top = options.parser(__doc__)
    top.add_argument(
        "--sample", required=True, help="folder of a finished preparation or consolidation, two-dimensional"
    )
    top.add_argument("--amplitude", type=options.positive, default=0.04, help="growth of t over s'")
    top.add_argument("--cycles", type=options.whole(1), default=100)
    top.add_argument(
        "--duration", type=options.positive, default=25.0, help="of half a cycle, in inertial times d sqrt(rho/p)"
    )
    cycles = options.ascending(options.whole(0))
    top.add_argument("--snapshots", type=cycles, default=[], metavar="CYCLE,...", help="cycles with contact lists")
    return options.parse(top)


def main() -> None:
    """Cycle one sample."""
    opt, parameters = parse()
    simulation = start_run("cycle", opt, parameters, dimension=2)
    if simulation is None:
        return
    folder, material, boundary = simulation.folder, simulation.material, simulation.boundary
    sig_x, sig_y = simulation.initial_stress[:2]
    s = -(sig_x + sig_y) / 2
    low = [sig_x, sig_y, None]
    high = [sig_x + opt.amplitude * s, sig_y - opt.amplitude * s, None]
    time_unit = material.inertial_time(s)
    speed = math.sqrt(2) * opt.amplitude * s / (opt.duration * time_unit)

    def row(cycle: int, peak: float) -> None:
        state = export.state(boundary, material)
        strain = simulation.strain()
        simulation.notes.setdefault("rows", []).append(
            [
                cycle,
                simulation.history[-1][1],
                strain[0],
                strain[1],
                *state["stress_kPa"][:2],
                state["void_ratio"],
                state["coordination_number"],
                state["mechanical_coordination_number"],
                state["anisotropy"] / 2,
                peak,
                state["unbalanced_force"],
            ]
        )
        if cycle in opt.snapshots:
            export.write_contacts(
                folder, f"cycle_{cycle:05d}", boundary, material, f"{folder.path.name}, after cycle {cycle}"
            )

    def begin(simulation: Simulation) -> None:
        simulation.servo.hold(low, 3e-3 / time_unit, with_integral=True)
        simulation.servo.move(high, speed)
        simulation.notes["cycle"] = 0
        row(0, float("nan"))

    def step(simulation: Simulation) -> bool:
        if not simulation.servo.arrived:
            return False
        simulation.record()
        if simulation.servo.goal == high:
            simulation.notes["peak"] = float(simulation.strain()[1])
            simulation.servo.move(low, speed)
            return False
        simulation.notes["cycle"] += 1
        row(simulation.notes["cycle"], simulation.notes["peak"])
        simulation.servo.move(high, speed)
        strain = abs(simulation.strain()[1])
        if strain > 0.1:
            simulation.notes["failed in cycle"] = simulation.notes["cycle"]
        return simulation.notes["cycle"] >= opt.cycles or strain > 0.1

    def chunk(simulation: Simulation) -> int:
        """To the end of the half cycle."""
        left = np.array([g - t for g, t in zip(simulation.servo.goal[:2], simulation.servo.target[:2], strict=True)])
        return int(np.linalg.norm(left) / (speed * O.dt)) + 2 * SERVO_PERIOD

    simulation.run([Stage("cycles", begin, step, chunk, record_every=10**9, longest=10**9)])
    rows = simulation.notes.pop("rows")
    folder.write_table("cycles.txt.gz", ["state after each cycle; compression negative"], COLUMNS, rows, FORMATS)
    simulation.write_history()
    end = export.state(boundary, material)
    folder.finish(end | {"material": material.as_dict(), "boundary": boundary.kind, "notes": simulation.notes})
    print(f"{len(rows) - 1} cycles, eps_y {np.array(rows)[-1, 3]:+.5f}, {folder.seconds:.0f} s")


main()
