"""Prepare a two-dimensional sample between four rigid walls (paper 003; paper 002 begins with --method gravity).

    yade -x -n -j1 deposit.py --out out/dep --method gravity --particles 2000

gravity: a loose cloud falls on the bottom and comes to rest. layers: five layers, one upon the other, each pressed by
the top wall to its share of the height. isotropic: four walls close in on a cloud. Then the walls bring both stresses
to the pressure, the friction between particles is set to its final value, and the sample comes to rest.
"""

import argparse
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))

import math
from collections.abc import Callable

import numpy as np
from common import cloud, clump, options, preparation
from common.boundary import WallBox
from common.material import Material, set_friction
from common.simulation import Simulation, Stage
from yade import NewtonIntegrator, O, Vector3, utils

LAYERS = 5
TOP = 3
"""Id of the top wall."""


def parse() -> tuple[argparse.Namespace, dict]:
    """The options of this script."""
    top = preparation.parser(
        __doc__,
        pressure=500.0,
        friction=math.degrees(math.atan(0.5)),
        diameter=5.0,
        spread=2.0,
        stiffness=2e5,
        stiffness_ratio=1.0,
        damping=0.7,
        inertial_number=2e-3,
        quiet=1e-3,
    )
    top.add_argument("--method", choices=("gravity", "layers", "isotropic"), default="gravity")
    top.add_argument("--shape", choices=("disc", "clump"), default="clump", help="clump: two discs, aspect ratio 0.6")
    top.add_argument("--layer-void-ratio", type=options.positive, default=0.25, help="to which a layer is pressed")
    top.add_argument("--aspect", type=options.positive, default=1.0, help="final height over width, roughly")
    top.add_argument(
        "--gravity-pressure", type=options.positive, default=0.3, help="weight of the sample over pressure"
    )
    return options.parse(top)


class Preparation:
    """The stages of one preparation and what they share."""

    def __init__(self, opt: argparse.Namespace, material: Material) -> None:
        """Sizes, rates and stresses that follow from the options."""
        self.opt, self.material = opt, material
        self.random = np.random.default_rng(opt.seed)
        self.diameters = material.diameters(opt.particles, self.random)
        self.solid = material.solid_volume(self.diameters)
        self.width = math.sqrt(self.solid * 1.25 / opt.aspect)
        self.pressure = opt.pressure * 1e3
        self.rate = opt.inertial_number / material.inertial_time(self.pressure)
        clumps = opt.shape == "clump"
        self.outer = clump.circumscribed(self.diameters) if clumps else self.diameters
        self.cloud_void_ratio = 2.4 if clumps else 1.1
        self.target = [-self.pressure, -self.pressure, None]

    def add(
        self, diameters: np.ndarray, outer: np.ndarray, width: float, bottom: float, sideways: float = 0.0
    ) -> float:
        """Add a cloud above a level and return the level of its top [m]."""
        height = self.cloud_height(diameters, outer, width)
        positions = cloud.random_positions(outer, [width, height, 0.0], self.random, periodic=False)
        positions += [sideways, bottom, 0.0]
        if self.opt.shape == "clump":
            angles = self.random.random(len(diameters)) * math.pi
            clump.add_clumps(self.material, diameters, positions, angles)
        else:
            cloud.add_particles(self.material, diameters, positions)
        cloud.note_solid_volume(self.material, diameters)
        return bottom + height

    def cloud_height(self, diameters: np.ndarray, outer: np.ndarray, width: float) -> float:
        """Height of a cloud [m]; particles keep their radius off the walls, which counts in small samples."""
        area = self.material.solid_volume(diameters) * (1 + self.cloud_void_ratio)
        return area / (width - 0.5 * max(outer)) + 0.5 * max(outer)

    def build(self, simulation: Simulation) -> None:
        """A new scene: walls, and for gravity and isotropic compression all particles."""
        self.material.add_to_scene()
        width = self.width
        if self.opt.method == "isotropic":
            width = math.sqrt(self.solid * (1 + self.cloud_void_ratio) / self.opt.aspect)
        height = self.cloud_height(self.diameters, self.outer, width)
        simulation.boundary.create([width, height])
        if self.opt.method != "layers":
            self.add(self.diameters, self.outer, width, 0.0)
        else:
            # The first layer is needed for the time step; later ones are added when it has been pressed.
            part = slice(0, None, LAYERS)
            level = self.add(self.diameters[part], self.outer[part], width, 0.0)
            O.bodies[TOP].state.pos = Vector3(width / 2, level, 0)
        gravity = 0.0
        if self.opt.method == "gravity":
            gravity = self.opt.gravity_pressure * self.pressure * width / (self.solid * self.material.density)
        preparation.start_scene(simulation, gravity)

    # stages

    def begin(self, simulation: Simulation) -> None:
        """Friction while preparing."""
        set_friction(preparation.preparation_friction(self.opt))
        simulation.servo.strain([0.0] * 3)

    def settled(self, simulation: Simulation) -> bool:
        """The particles rest."""
        speeds = [float(body.state.vel.norm()) for body in cloud.particles()]
        return utils.unbalancedForce() < 0.01 and np.mean(speeds) < 1e-3 * self.material.diameter / (1000 * O.dt)

    def end_of_gravity(self, simulation: Simulation) -> None:
        """Bring the top wall to the highest particle; gravity ends."""
        self.top_wall_to_sample()
        for engine in O.engines:
            if isinstance(engine, NewtonIntegrator):
                engine.gravity = Vector3(0, 0, 0)

    def top_wall_to_sample(self) -> None:
        """Put the top wall where it touches the highest particle."""
        top = max(body.state.pos[1] + body.shape.radius for body in cloud.grains())
        O.bodies[TOP].state.pos = Vector3(O.bodies[TOP].state.pos[0], top, 0)

    def press_begin(self, simulation: Simulation) -> None:
        """Move the top wall down; the bottom stays."""
        if simulation.stage_index == 0:
            self.begin(simulation)
        simulation.servo.strain([0.0] * 3)
        self.set_top_speed(3 * self.rate)

    def set_top_speed(self, rate: float) -> None:
        """The servo moves opposite walls; while a layer is pressed only the top wall moves."""
        height = self.width * self.opt.aspect
        O.bodies[TOP].state.vel = Vector3(0, -rate * height, 0)
        O.engines[-1].dead = rate != 0

    def pressed(self, simulation: Simulation) -> bool:
        """The layers so far have their share of the height."""
        share = cloud.solid_volume() * (1 + self.opt.layer_void_ratio) / self.width
        return simulation.boundary.sides()[1] <= share

    def layer(self, number: int) -> Callable[[Simulation], None]:
        """Lift the wall, add layer `number`, bring the wall to it."""

        def begin(simulation: Simulation) -> None:
            part = slice(number, None, LAYERS)
            # Each layer has random numbers of its own, so that a continued run is like one in a single piece.
            self.random = np.random.default_rng([self.opt.seed, number])
            below = max(body.state.pos[1] + body.shape.radius for body in cloud.grains())
            level = self.add(self.diameters[part], self.outer[part], self.width, below)
            O.bodies[TOP].state.pos = Vector3(self.width / 2, level, 0)
            self.press_begin(simulation)

        return begin

    def close_begin(self, simulation: Simulation) -> None:
        """All walls under stress control."""
        if simulation.stage_index == 0:
            self.begin(simulation)
        self.set_top_speed(0.0)
        simulation.servo.hold(self.target, 6 * self.rate if self.opt.method == "isotropic" else self.rate)

    def touching(self, simulation: Simulation) -> bool:
        """The walls feel the sample."""
        return min(abs(simulation.stress()[:2])) > 0.005 * self.pressure

    def hold(self, simulation: Simulation) -> None:
        """All walls under stress control, slowly."""
        simulation.servo.hold(self.target, 0.5 * self.rate)

    def restore(self, simulation: Simulation) -> None:
        """The final friction."""
        set_friction(self.opt.friction)
        self.hold(simulation)

    def near(self, simulation: Simulation) -> bool:
        """The stresses are met."""
        return simulation.is_at(self.target, 0.01, 0.01)

    def quiet(self, simulation: Simulation) -> bool:
        """The stresses are met and the sample rests."""
        return simulation.is_at(self.target, 0.003, self.opt.quiet)

    def stages(self) -> list[Stage]:
        """All stages of the method."""
        result = []
        if self.opt.method == "gravity":
            result.append(
                Stage("fall", self.begin, self.settled, 1000, need=2, end=self.end_of_gravity, longest=300_000)
            )
        elif self.opt.method == "layers":
            for number in range(LAYERS):
                begin = self.press_begin if number == 0 else self.layer(number)
                result.append(Stage(f"layer {number + 1}", begin, self.pressed, 100, record_every=10))
        result.append(Stage("walls", self.close_begin, self.touching, 100, record_every=10))
        result.append(Stage("compression", self.hold, self.near, 250, need=3, record_every=4))
        if self.opt.preparation_friction not in (None, self.opt.friction):
            result.append(Stage("friction", self.restore, self.near, 250, need=3, record_every=4))
        result.append(Stage("quiet", self.hold, self.quiet, 250, need=3, record_every=4, longest=150_000))
        return result


def main() -> None:
    """Prepare one sample."""
    opt, parameters = parse()
    simulation = preparation.start_run("deposit", opt, parameters, 2, WallBox())
    if simulation is None:
        return
    simulation.servo.relaxation = 60 + 3 * math.sqrt(opt.particles)
    steps = Preparation(opt, simulation.material)
    if not simulation.resume():
        steps.build(simulation)
    simulation.run(steps.stages())
    preparation.finish(simulation, f"{opt.method}, {opt.particles} {opt.shape}s, seed {opt.seed}")


main()
