"""Compress a sample along one axis while the other stresses are held (paper 000; biaxial tests of paper 003).

    yade -x -n -j1 load.py --out out/A-0 --sample out/aniso --axis y --strain 0.1

Loading begins slowly, because the stiffness at small strain depends on the rate, and speeds up after --slow-until.
Contact lists are written at the strains of --snapshots.
"""

import argparse
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))

from common import export, options
from common.folder import fail
from common.sample import dimension_of, start_run
from common.simulation import Simulation, Stage
from yade import O


def parse() -> tuple[argparse.Namespace, dict]:
    """The options of this script."""
    top = options.parser(__doc__)
    top.add_argument("--sample", required=True, help="folder of a finished preparation")
    top.add_argument("--axis", choices=("x", "y", "z"), default="y")
    top.add_argument("--strain", type=options.positive, default=0.1, help="axial compression at the end")
    top.add_argument("--inertial-number", type=options.positive, default=6e-4, help="sets the rate of loading")
    top.add_argument("--slow", type=options.positive, default=8e-5, help="inertial number at small strain")
    top.add_argument(
        "--slow-until", type=options.positive, default=0.002, help="axial strain at which loading speeds up"
    )
    strains = options.ascending(lambda word: options.not_negative(word) / 100)
    top.add_argument("--snapshots", type=strains, default=[], metavar="PERCENT,...", help="strains of contact lists")
    return options.parse(top)


def main() -> None:
    """Load one sample."""
    opt, parameters = parse()
    if opt.axis == "z" and dimension_of(opt.sample) == 2:
        fail(f"--axis z: the sample {opt.sample} has two dimensions; expected x or y")
    simulation = start_run("load", opt, parameters)
    if simulation is None:
        return
    folder, material, boundary = simulation.folder, simulation.material, simulation.boundary
    axis = "xyz".index(opt.axis)
    held = simulation.initial_stress
    time_unit = material.inertial_time(max(abs(s) for s in held))
    slow, fast = opt.slow / time_unit, opt.inertial_number / time_unit

    def compression() -> float:
        return -float(simulation.strain()[axis])

    def rate_at(strain: float) -> float:
        """Slow at first, then growing in proportion to the strain until the final rate."""
        return min(fast, slow * max(1.0, strain / opt.slow_until))

    def begin(simulation: Simulation) -> None:
        free = [s if i != axis and i < material.dimension else None for i, s in enumerate(held)]
        simulation.servo.hold(free, 20 * fast, with_integral=True)
        simulation.servo.rate[axis] = -0.2 * slow

    def step(simulation: Simulation) -> bool:
        strain = compression()
        simulation.servo.rate[axis] = -rate_at(strain) * (0.2 if strain < 0.01 * opt.slow_until else 1.0)
        taken = simulation.notes.setdefault("snapshots", [])
        while len(taken) < len(opt.snapshots) and strain >= opt.snapshots[len(taken)]:
            name = f"strain_{len(taken):02d}"
            numbers = export.write_contacts(
                folder, name, boundary, material, f"{folder.path.name}, axial strain {strain:.5f}"
            )
            taken.append(numbers | {"name": name, "strain": [float(e) for e in simulation.strain()]})
        return strain >= opt.strain

    def chunk(simulation: Simulation) -> int:
        """Rows every 1e-5 of strain at first, then every per cent of the strain reached; at most 400 steps."""
        strain = compression()
        wanted = max(1e-5, 0.01 * strain)
        return max(5, min(400, int(wanted / (abs(simulation.servo.rate[axis]) * O.dt))))

    simulation.run([Stage("load", begin, step, chunk=chunk)])
    simulation.write_history()
    numbers = export.write_contacts(folder, "end", boundary, material, f"{folder.path.name}, end")
    notes = simulation.notes
    folder.finish(numbers | {"material": material.as_dict(), "boundary": boundary.kind, "notes": notes})
    print(f"strain {compression():.4f}, e {numbers['void_ratio']:.4f}, {folder.seconds:.0f} s")


main()
