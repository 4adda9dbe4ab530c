"""Strain probes of equal size in the plane of eps_xx and eps_yy, with contact ids (paper 001).

    yade -x -n -j1 probe_strain.py --out out/probes --sample out/iso2d --directions 24

eps_xx = size cos(alpha), eps_yy = size sin(alpha), compression negative; eps_zz = 0. before_contacts.txt.gz and
alpha_NNN_contacts.txt.gz hold the contacts before and after; hold_contacts.txt.gz those after a rest of equal length,
which shows what changes by itself.
"""

import argparse
import math
import os
import sys
from collections.abc import Callable

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))

import numpy as np
from common import export, options
from common.boundary import PeriodicCell
from common.probing import clear, run_probes, save_base
from common.sample import start_run
from common.simulation import Simulation, Stage
from yade import O, utils

COLUMNS = [
    "alpha",
    "eps_x",
    "eps_y",
    "dsig_x_kPa",
    "dsig_y_kPa",
    "dsig_z_kPa",
    "contacts_before",
    "contacts_after",
    "lost",
    "gained",
    "unbalanced",
]
FORMATS = ["%.1f"] + ["%.6e"] * 5 + ["%d"] * 4 + ["%.1e"]


def parse() -> tuple[argparse.Namespace, dict]:
    """The options of this script."""
    top = options.parser(__doc__)
    top.add_argument("--sample", required=True, help="folder of a finished preparation in a periodic cell")
    top.add_argument("--size", type=options.positive, default=2e-4, help="norm of the strain of a probe")
    top.add_argument("--directions", type=options.whole(1), default=24)
    top.add_argument(
        "--duration", type=options.positive, default=15.0, help="of a probe, in inertial times d sqrt(rho/p)"
    )
    top.add_argument("--quiet", type=options.positive, default=1e-5, help="unbalanced force before the probes")
    top.add_argument(
        "--cycle", type=options.not_negative, default=5e-4, help="shear strain applied and taken back first; 0: none"
    )
    return options.parse(top)


def pairs(rows: np.ndarray) -> set:
    """Contacts by the ids of their particles and the periods between them."""
    return {tuple(row) for row in rows[:, :5].astype(int)}


def main() -> None:
    """Probe one sample."""
    opt, parameters = parse()
    simulation = start_run("probe_strain", opt, parameters, boundary=PeriodicCell.kind)
    if simulation is None:
        return
    folder, material, boundary = simulation.folder, simulation.material, simulation.boundary
    held: list[float | None] = list(simulation.initial_stress)
    pressure = max(abs(s) for s in simulation.initial_stress)
    time_unit = material.inertial_time(pressure)
    steps = int(opt.duration * time_unit / O.dt)
    if material.dimension == 2:
        held[2] = None

    def shear(sense: float) -> Callable[[Simulation], None]:
        """Axial strain +-cycle while the lateral stress is held: triggers what is about to collapse."""

        def begin(simulation: Simulation) -> None:
            simulation.servo.hold([held[0], None, held[2]], 20 * opt.cycle / (5 * opt.duration * time_unit), True)
            simulation.servo.rate[1] = sense * opt.cycle / (5 * opt.duration * time_unit)

        return begin

    def sheared(simulation: Simulation) -> bool:
        return simulation.strain()[1] <= -opt.cycle

    def returned(simulation: Simulation) -> bool:
        return simulation.stress()[1] >= held[1]

    def rest(simulation: Simulation) -> None:
        simulation.servo.hold(held, 1e-3 / time_unit)

    def resting(simulation: Simulation) -> bool:
        return simulation.is_at(held, 1e-3, 10 * opt.quiet)

    def freeze(simulation: Simulation) -> None:
        simulation.servo.strain([0.0] * 3)

    def frozen(simulation: Simulation) -> bool:
        return utils.unbalancedForce() < opt.quiet

    stages = [
        Stage("shear", shear(-1.0), sheared, 200),
        Stage("back", shear(1.0), returned, 100, longest=100 * steps),
        Stage("rest", rest, resting, 250, need=3, longest=100_000),
        Stage("freeze", freeze, frozen, 250, need=3, longest=100_000, end=save_base),
    ]
    if opt.cycle == 0:
        stages = stages[2:]
    if simulation.stage_index < len(stages):
        simulation.run(stages)
        export.write_contacts(folder, "before", boundary, material, f"{folder.path.name}, before the probes")
        simulation.notes["before"] = export.state(boundary, material)
        simulation.save()
    state = simulation.notes["before"]

    first: set = set()

    def probe(name: str) -> list[float]:
        if not first:
            first.update(pairs(export.contacts()))
        stress = boundary.stress()
        direction = [0.0] * 3
        if name != "hold":
            angle = math.radians(float(name))
            direction = [math.cos(angle), math.sin(angle), 0.0]
        # The rate grows over a fifth of the time and falls over a fifth, so that no shock runs through the sample.
        ramp = max(1, steps // 5)
        part = max(5, steps // 20)
        for k in range(0, steps + ramp, part):
            share = min(1.0, (k + part / 2) / ramp, max(0.0, (steps + ramp - k - part / 2) / ramp))
            simulation.servo.strain([opt.size / (steps * O.dt) * share * d for d in direction])
            O.run(part, True)
        simulation.servo.strain([0.0] * 3)
        O.run(max(steps // 2, 500), True)
        rows = export.contacts()
        second = pairs(rows)
        label = "hold" if name == "hold" else f"alpha_{float(name):05.1f}"
        export.write_contacts(folder, label, boundary, material, f"{folder.path.name}, probe {name}", rows, short=True)
        change = (boundary.stress() - stress) / 1e3
        strain = simulation.strain()
        alpha = -1.0 if name == "hold" else float(name)
        return [
            alpha,
            strain[0],
            strain[1],
            *change,
            len(first),
            len(second),
            len(first - second),
            len(second - first),
            utils.unbalancedForce(),
        ]

    names = [f"{360 * k / opt.directions:g}" for k in range(opt.directions)] + ["hold"]
    table = run_probes(simulation, names, probe)
    comments = ["one row per probe; alpha -1: a rest of equal length; compression negative; contacts told by their ids"]
    folder.write_table("probes.txt.gz", comments, COLUMNS, table, FORMATS)
    simulation.write_history()
    clear(simulation)
    folder.finish(state | {"material": material.as_dict(), "boundary": boundary.kind, "notes": simulation.notes})


main()
