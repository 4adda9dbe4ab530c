"""Bring a sample to other stresses along a straight path (paper 002: isotropic, or K = sigma_x/sigma_y = 0.69).

yade -x -n -j1 consolidate.py --out out/k069 --sample out/dep --stress 103.7 150.3
"""

import argparse
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))

import numpy as np
from common import options
from common.folder import fail
from common.sample import dimension_of, start_run, write_sample
from common.simulation import Simulation, Stage


def parse() -> tuple[argparse.Namespace, dict]:
    """The options of this script."""
    top = options.parser(__doc__)
    top.add_argument("--sample", required=True, help="folder of a finished preparation")
    top.add_argument(
        "--stress",
        type=options.positive,
        nargs="+",
        required=True,
        help="along x, y (and z), compression positive [kPa]",
    )
    top.add_argument(
        "--duration", type=options.positive, default=300.0, help="of the path, in inertial times d sqrt(rho/p)"
    )
    top.add_argument("--quiet", type=options.positive, default=1e-4, help="unbalanced force of the final state")
    return options.parse(top)


def main() -> None:
    """Consolidate one sample."""
    opt, parameters = parse()
    dimension = dimension_of(opt.sample)
    if len(opt.stress) != dimension:
        fail(f"--stress has {len(opt.stress)} values, but the sample {opt.sample} has {dimension} dimensions")
    simulation = start_run("consolidate", opt, parameters)
    if simulation is None:
        return
    folder = simulation.folder
    start = simulation.initial_stress
    goal = [-1e3 * s for s in opt.stress] + [None] * (3 - dimension)
    time_unit = simulation.material.inertial_time(1e3 * max(opt.stress))

    def begin(simulation: Simulation) -> None:
        path = np.array(goal[:dimension]) - np.array(start[:dimension])
        simulation.servo.hold(start[:dimension] + [None] * (3 - dimension), 3e-3 / time_unit, with_integral=True)
        simulation.servo.move(goal, float(np.linalg.norm(path)) / (opt.duration * time_unit))

    def arrived(simulation: Simulation) -> bool:
        return simulation.servo.arrived

    def quiet(simulation: Simulation) -> bool:
        return simulation.is_at(goal, 0.002, opt.quiet)

    simulation.run(
        [
            Stage("path", begin, arrived, 100),
            Stage("quiet", lambda s: None, quiet, 250, need=3, longest=150_000),
        ]
    )
    title = "consolidated to " + " ".join(f"{s:g}" for s in opt.stress) + " kPa"
    numbers = write_sample(simulation, title)
    folder.finish(numbers)
    print(f"e {numbers['void_ratio']:.4f}  CN {numbers['coordination_number']:.3f}  a {numbers['anisotropy']:.3f}")


main()
