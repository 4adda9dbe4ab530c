"""What the scripts that make a sample share: options, material, the first scene and the last files."""

import argparse

from yade import O

from common import options
from common.boundary import Boundary
from common.folder import Folder
from common.material import Material
from common.sample import write_sample
from common.simulation import Simulation

ANGLE = options.number(0.0, 90.0)
"""Friction angles [deg]."""

OPTIONS = {
    "pressure": (options.positive, "final stress [kPa]"),
    "friction": (ANGLE, "friction angle between particles [deg]"),
    "diameter": (options.positive, "3D: median diameter, 2D: mean one, of the disc of equal area [mm]"),
    "spread": (options.number(1.0), "3D: d60/d10 of a log-normal law; 2D: largest over smallest diameter"),
    "stiffness": (options.positive, "3D: Young's modulus [kPa]; 2D: k_n/(1 m) [kPa]"),
    "stiffness-ratio": (options.not_negative, "k_s/k_n"),
    "damping": (options.number(0.0, 1.0), "numerical damping"),
    "inertial-number": (options.positive, "sets the rate of compression"),
    "quiet": (options.positive, "unbalanced force of the final state"),
}


def parser(description: str, **defaults: float) -> options.Parser:
    """A parser with the options of all preparations; defaults by name, with _ in place of -."""
    top = options.parser(description, particles=2000)
    for name, (kind, text) in OPTIONS.items():
        top.add_argument(f"--{name}", type=kind, default=defaults[name.replace("-", "_")], help=text)
    top.add_argument(
        "--preparation-friction", type=ANGLE, help="friction angle while preparing [deg]; default: the same"
    )
    return top


def preparation_friction(opt: argparse.Namespace) -> float:
    """Friction angle while preparing [deg]."""
    return opt.friction if opt.preparation_friction is None else opt.preparation_friction


def start_run(
    program: str, opt: argparse.Namespace, parameters: dict, dimension: int, boundary: Boundary
) -> Simulation | None:
    """The preparation in the folder of --out, without a scene yet; None when it has finished before."""
    folder = Folder(opt.out, program, parameters)
    if folder.finished:
        print(f"{opt.out}: finished before")
        return None
    material = Material(
        dimension=dimension,
        diameter=opt.diameter * 1e-3,
        spread=opt.spread,
        stiffness=opt.stiffness * 1e3,
        stiffness_ratio=opt.stiffness_ratio,
        friction=opt.friction,
        damping=opt.damping,
    )
    return Simulation(folder, material, boundary, opt.checkpoint)


def start_scene(simulation: Simulation, gravity: float = 0.0) -> None:
    """Engines, time step and servo, when boundary and first particles are there. gravity [m/s2]: along -y."""
    O.engines = simulation.material.engines(gravity)
    O.dt = simulation.material.time_step()
    simulation.connect()
    simulation.set_reference()


def finish(simulation: Simulation, title: str) -> None:
    """Write the sample, mark the run as finished and print its numbers."""
    folder = simulation.folder
    numbers = write_sample(simulation, title)
    folder.finish(numbers)
    print(
        f"e {numbers['void_ratio']:.4f}  CN {numbers['coordination_number']:.3f}  a {numbers['anisotropy']:.3f}"
        f"  unbalanced {numbers['unbalanced_force']:.1e}  {folder.seconds:.0f} s"
    )
