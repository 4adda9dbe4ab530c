"""Stress probes at a failure state that was reached along a radial path at constant mean stress (paper 004).

    yade -x -n -j1 probe_stress.py --out out/lode20 --sample out/iso --lode 20 --directions 26

The sample is sheared at constant p along a Lode angle (0: sigma_y is the largest compression, 60: sigma_x the smallest)
until the unbalanced force exceeds --failure. It is brought to rest, and then probed by stress increments of equal size
in directions spread evenly over the sphere of principal stresses: loaded, unloaded, and the irrecoverable strain noted.
failure_contacts.txt.gz holds the contacts of the failure state with their forces.

Before the probes the stress can go on: by --tangent kPa at a right angle to the radial path in the deviatoric plane
(points A+ and A- of paper 004), or --tangent-to the state of another run of this script (along the failure surface).
"""

import argparse
import math
import os
import sys
from pathlib import Path

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))

import numpy as np
from common import export, options
from common.folder import fail
from common.probing import clear, run_probes, save_base
from common.sample import finished_manifest, start_run
from common.simulation import Simulation, Stage
from yade import O, utils

COLUMNS = [
    "number",
    "dsig_x",
    "dsig_y",
    "dsig_z",
    "eps_x",
    "eps_y",
    "eps_z",
    "eps_irr_x",
    "eps_irr_y",
    "eps_irr_z",
    "unbalanced",
]
FORMATS = ["%d"] + ["%.6f"] * 3 + ["%.6e"] * 6 + ["%.1e"]


def parse() -> tuple[argparse.Namespace, dict]:
    """The options of this script."""
    top = options.parser(__doc__)
    top.add_argument("--sample", required=True, help="folder of a finished isotropic preparation, three-dimensional")
    top.add_argument(
        "--lode", type=options.number(-360.0, 360.0), default=0.0, help="Lode angle [deg]: 0 compression, 60 extension"
    )
    top.add_argument("--failure", type=options.positive, default=5e-3, help="unbalanced force that tells failure")
    top.add_argument(
        "--back",
        type=options.number(0.0, 1.0, above=True),
        default=0.005,
        help="share of the deviator taken back, again while it flows",
    )
    top.add_argument("--size", type=options.positive, default=0.1, help="norm of a stress increment [kPa]")
    top.add_argument("--directions", type=options.whole(1), default=26)
    top.add_argument("--duration", type=options.positive, default=500.0, help="of shearing by q = p, in inertial times")
    top.add_argument(
        "--probe-duration", type=options.positive, default=4.0, help="of loading, in inertial times d sqrt(rho/p)"
    )
    top.add_argument("--quiet", type=options.positive, default=1e-5, help="unbalanced force before the probes")
    after = top.add_mutually_exclusive_group()
    after.add_argument(
        "--tangent", type=options.number(-1e6, 1e6), help="increment before the probes, to larger Lode angles [kPa]"
    )
    after.add_argument("--tangent-to", metavar="FOLDER", help="run whose stress is gone to before the probes")
    return options.parse(top)


def deviator(lode: float) -> np.ndarray:
    """Unit deviator (x, y, z) with compression negative: y is compressed most, x least (0 to 60 deg)."""
    angle = math.radians(lode)
    return -math.sqrt(2 / 3) * np.array(
        [math.cos(angle + 2 * math.pi / 3), math.cos(angle), math.cos(angle - 2 * math.pi / 3)]
    )


def sphere(number: int) -> np.ndarray:
    """Directions spread evenly over the sphere (Fibonacci lattice)."""
    k = np.arange(number) + 0.5
    z = 1 - 2 * k / number
    turn = math.pi * (1 + math.sqrt(5)) * k
    return np.column_stack([np.sqrt(1 - z**2) * np.cos(turn), np.sqrt(1 - z**2) * np.sin(turn), z])


def main() -> None:
    """Shear and probe one sample."""
    opt, parameters = parse()
    tangent_goal: list[float] = []
    if opt.tangent_to is not None:
        parameters["tangent_to"] = Path(opt.tangent_to).resolve().name
        manifest = finished_manifest(opt.tangent_to, "--tangent-to")
        if manifest["program"] != "probe_stress":
            fail(f"--tangent-to {opt.tangent_to}: a run of {manifest['program']}; expected one of probe_stress")
        tangent_goal = [1e3 * s for s in manifest["results"]["notes"]["stress of the probes [kPa]"]]
    simulation = start_run("probe_stress", opt, parameters, dimension=3)
    if simulation is None:
        return
    folder, material, boundary = simulation.folder, simulation.material, simulation.boundary
    start = np.array(simulation.initial_stress)
    p = -float(np.mean(start))
    time_unit = material.inertial_time(p)
    direction = deviator(opt.lode)
    speed = math.sqrt(2 / 3) * p / (opt.duration * time_unit)

    def shear(simulation: Simulation) -> None:
        simulation.servo.hold(list(start), 2e-3 / time_unit, with_integral=True)
        simulation.servo.move(list(start + 3 * p * direction), speed)

    def failed(simulation: Simulation) -> bool:
        strain = simulation.strain()
        return utils.unbalancedForce() > opt.failure or float(np.max(np.abs(strain))) > 0.05

    def note_failure(simulation: Simulation) -> None:
        """Remember stress and strain at failure, and begin to look for a stress that the sample can bear."""
        simulation.notes["stress at failure [kPa]"] = [float(s) / 1e3 for s in simulation.servo.target]
        simulation.notes["strain at failure"] = [float(e) for e in simulation.strain()]
        retreat(simulation)

    def turn(simulation: Simulation) -> None:
        """Go on along the failure surface."""
        here = np.array(simulation.servo.target)
        if opt.tangent_to is not None:
            goal = np.array(tangent_goal)
        else:
            goal = here + 1e3 * opt.tangent * deviator(opt.lode + 90.0)
        simulation.notes["stress before the tangent [kPa]"] = [float(s) / 1e3 for s in here]
        simulation.servo.hold([float(s) for s in here], 2e-3 / time_unit, with_integral=True)
        simulation.servo.move([float(s) for s in goal], speed)

    def turned(simulation: Simulation) -> bool:
        return simulation.servo.arrived

    def note_turned(simulation: Simulation) -> None:
        simulation.notes["strain of retreat"] = [float(e) for e in simulation.strain()]
        simulation.notes["stress of the probes [kPa]"] = [float(s) / 1e3 for s in simulation.servo.target]

    def retreat(simulation: Simulation) -> None:
        """Hold a little less deviator than before."""
        last = np.array(simulation.servo.target)
        rest = last - opt.back * (last - last.mean())
        simulation.notes["strain of retreat"] = [float(e) for e in simulation.strain()]
        simulation.notes["retreats"] = simulation.notes.get("retreats", 0) + 1
        simulation.notes["stress of the probes [kPa]"] = [float(s) / 1e3 for s in rest]
        simulation.servo.hold([float(s) for s in rest], 1e-3 / time_unit, with_integral=True)

    def resting(simulation: Simulation) -> bool:
        """Whether it rests. A sample that flows by more than 0.2 % instead is given less to bear."""
        flow = simulation.strain() - np.array(simulation.notes["strain of retreat"])
        if float(np.max(np.abs(flow))) > 0.002:
            retreat(simulation)
            return False
        return simulation.is_at(simulation.servo.target, 1e-4, opt.quiet)

    stages = [
        Stage("shear", shear, failed, 250, need=2, longest=1_000_000),
        Stage("rest", note_failure, resting, 250, need=4, record_every=4, longest=200_000),
    ]
    if opt.tangent is not None or opt.tangent_to is not None:
        stages.append(Stage("tangent", turn, turned, 100))
        stages.append(Stage("rest after it", note_turned, resting, 250, need=4, record_every=4, longest=200_000))
    stages[-1].end = save_base
    if simulation.stage_index < len(stages):
        simulation.run(stages)
        simulation.notes["before"] = export.write_contacts(
            folder, "failure", boundary, material, f"{folder.path.name}, failure"
        )
        simulation.save()
    base = np.array(simulation.notes["stress of the probes [kPa]"]) * 1e3
    directions = sphere(opt.directions)
    steps = int(opt.probe_duration * time_unit / O.dt)

    def go_to(goal: np.ndarray) -> np.ndarray:
        """Move to a stress, wait as long again, and return the strain."""
        simulation.servo.move([float(s) for s in goal], opt.size * 1e3 / (steps * O.dt))
        O.run(2 * steps, True)
        return simulation.strain()

    def probe(name: str) -> list[float]:
        unit = np.zeros(3) if name == "hold" else directions[int(name)]
        simulation.servo.hold([float(s) for s in base], 1e-3 / time_unit, with_integral=True)
        loaded = go_to(base + opt.size * 1e3 * unit)
        unloaded = go_to(base)
        number = -1 if name == "hold" else int(name)
        return [number, *(opt.size * unit), *loaded, *unloaded, utils.unbalancedForce()]

    names = [str(k) for k in range(opt.directions)] + ["hold"]
    table = run_probes(simulation, names, probe)
    comments = [
        "one row per probe; number -1: no increment, the same time; stress [kPa] and strain: compression negative",
        "eps: at the end of the increment; eps_irr: after unloading",
    ]
    folder.write_table("probes.txt.gz", comments, COLUMNS, table, FORMATS)
    simulation.write_history()
    clear(simulation)
    state = simulation.notes.pop("before")
    folder.finish(state | {"material": material.as_dict(), "boundary": boundary.kind, "notes": simulation.notes})


main()
