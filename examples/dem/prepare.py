"""Prepare a periodic sample of spheres or discs by isotropic or anisotropic compression (papers 000, 001 and 004).

    yade -x -n -j1 prepare.py --out out/iso --particles 2000
    yade -x -n -j1 prepare.py --out out/aniso --particles 2000 --lateral 0

A random cloud is compressed along y until sigma_yy = -p. Meanwhile the lateral strain rate is --lateral times the
vertical one: 0 is the anisotropic compression of paper 000 (no lateral strain); below 0 the sample widens, from the
first contacts on. Then all stresses are brought to -p.
With --lateral iso all axes are under stress control from the beginning: the isotropic compression.
"""

import argparse
import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))

import numpy as np
from common import cloud, export, options, preparation
from common.boundary import PeriodicCell
from common.material import Material, set_friction
from common.simulation import Simulation, Stage


def lateral_ratio(text: str) -> str:
    """Check --lateral."""
    if text != "iso":
        try:
            valid = math.isfinite(float(text))
        except ValueError:
            valid = False
        if not valid:
            raise argparse.ArgumentTypeError(f"{text}: expected iso or a number")
    return text


def parse() -> tuple[argparse.Namespace, dict]:
    """The options of this script."""
    top = preparation.parser(
        __doc__,
        pressure=100.0,
        friction=30.0,
        diameter=0.943,
        spread=1.2,
        stiffness=250e3,
        stiffness_ratio=0.4,
        damping=0.2,
        inertial_number=8e-4,
        quiet=1e-3,
    )
    top.add_argument("--dimension", type=int, choices=(2, 3), default=3)
    top.add_argument("--lateral", type=lateral_ratio, default="iso", help="lateral over vertical strain rate, or iso")
    return options.parse(top)


def build(simulation: Simulation, number: int, seed: int) -> None:
    """A cloud in a new scene."""
    material = simulation.material
    random = np.random.default_rng(seed)
    diameters = material.diameters(number, random)
    edge = cloud.edge(material, diameters, 2.2 if material.dimension == 3 else 0.9)
    positions = cloud.random_positions(
        diameters, [edge] * material.dimension + [0.0] * (3 - material.dimension), random, True
    )
    simulation.boundary.create([edge] * 2 + [edge if material.dimension == 3 else 10 * float(max(diameters))])
    material.add_to_scene()
    cloud.add_particles(material, diameters, positions)
    cloud.note_solid_volume(material, diameters)
    preparation.start_scene(simulation)


def stages(opt: argparse.Namespace, material: Material) -> list[Stage]:
    """Compression, restoring of friction, rest."""
    p = opt.pressure * 1e3
    axes = range(material.dimension)
    all_axes = [-p if i in axes else None for i in range(3)]
    rate = opt.inertial_number / material.inertial_time(p)
    first = "isotropic" if opt.lateral == "iso" else "vertical"

    def compress(simulation: Simulation, limit: float, cloud: bool = False) -> None:
        if opt.lateral == "iso":
            simulation.servo.hold(all_axes, limit)
        else:
            ratio = max(0.0, float(opt.lateral)) if cloud else float(opt.lateral)
            simulation.servo.strain([-limit * ratio if i != 1 else -limit for i in range(3)])

    def begin(simulation: Simulation) -> None:
        set_friction(preparation.preparation_friction(opt))
        compress(simulation, 6 * rate, cloud=True)

    def touching(simulation: Simulation) -> bool:
        return max(abs(simulation.stress())) > 0.005 * p

    def loaded(simulation: Simulation) -> bool:
        stress = simulation.stress()
        if opt.lateral == "iso":
            return simulation.is_at(all_axes, 0.005, 0.01)
        return stress[1] < -p

    def vertical_rest(simulation: Simulation) -> None:
        simulation.servo.hold([None, -p, None], rate)

    def vertical_done(simulation: Simulation) -> bool:
        return simulation.is_at([None, -p, None], 0.005, 0.01)

    def note_vertical(simulation: Simulation) -> None:
        simulation.notes["vertical"] = export.state(simulation.boundary, simulation.material)

    def equal(simulation: Simulation) -> None:
        simulation.servo.hold(all_axes, 0.3 * rate)

    def done(simulation: Simulation) -> bool:
        return simulation.is_at(all_axes, 0.005, 0.01)

    def restore(simulation: Simulation) -> None:
        set_friction(opt.friction)
        equal(simulation)

    def quiet(simulation: Simulation) -> bool:
        return simulation.is_at(all_axes, 0.002, opt.quiet)

    result = [
        Stage("cloud", begin, touching, record_every=10),
        Stage(
            first,
            lambda s: compress(s, rate),
            loaded,
            chunk=100,
            record_every=10,
            need=3 if opt.lateral == "iso" else 1,
        ),
    ]
    if opt.lateral != "iso":
        result.append(Stage("rest", vertical_rest, vertical_done, need=3, record_every=10, end=note_vertical))
        result.append(Stage("lateral", equal, done, need=3, record_every=10))
    if opt.preparation_friction not in (None, opt.friction):
        result.append(Stage("friction", restore, done, need=3, record_every=10))
    result.append(Stage("quiet", equal, quiet, need=3, record_every=10, longest=100_000))
    return result


def main() -> None:
    """Prepare one sample."""
    opt, parameters = parse()
    simulation = preparation.start_run("prepare", opt, parameters, opt.dimension, PeriodicCell(opt.dimension))
    if simulation is None:
        return
    if not simulation.resume():
        build(simulation, opt.particles, opt.seed)
    simulation.run(stages(opt, simulation.material))
    preparation.finish(simulation, f"lateral {opt.lateral}, {opt.particles} particles, seed {opt.seed}")


main()
