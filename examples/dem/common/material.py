"""Particles and contact law."""

import math
import statistics
from dataclasses import asdict, dataclass

import numpy as np
from yade import (
    Bo1_Sphere_Aabb,
    Bo1_Wall_Aabb,
    ForceResetter,
    FrictMat,
    Ig2_Sphere_Sphere_ScGeom,
    Ig2_Wall_Sphere_ScGeom,
    InsertionSortCollider,
    InteractionLoop,
    Ip2_FrictMat_FrictMat_FrictPhys,
    Law2_ScGeom_FrictPhys_CundallStrack,
    MatchMaker,
    NewtonIntegrator,
    O,
    PyRunner,
    Sphere,
)

SERVO_PERIOD = 5
"""Steps between two calls of the servo control."""


@dataclass(frozen=True)
class Material:
    """A granular material: linear contacts with Coulomb friction (Cundall and Strack 1979).

    In two dimensions particles are discs of `thickness` 1 m whose stiffnesses do not depend on their size.
    """

    dimension: int
    diameter: float
    """Median (3D) or mean (2D) diameter [m]."""
    spread: float
    """3D: d60/d10 of a log-normal distribution by mass. 2D: largest over smallest diameter, uniform by number."""
    stiffness: float
    """3D: Young's modulus of YADE, k_n = 2 E r1 r2/(r1 + r2) [Pa]. 2D: k_n [N/m]."""
    stiffness_ratio: float
    """k_s/k_n."""
    friction: float
    """Friction angle between particles [deg]."""
    damping: float
    """Local damping of Cundall, without unit."""
    density: float = 2650.0
    """Of the grains [kg/m3]."""

    def as_dict(self) -> dict:
        """For the manifest."""
        return asdict(self)

    @property
    def bulk(self) -> float:
        """Rough stiffness of a dense sample, for the servo [Pa]."""
        return 0.12 * self.stiffness if self.dimension == 3 else 0.5 * self.stiffness

    def diameters(self, number: int, random: np.random.Generator) -> np.ndarray:
        """Diameters of `number` particles, stratified so that small samples have the distribution, too."""
        u = (random.permutation(number) + random.random(number)) / number
        if self.dimension == 2:
            small = 2 * self.diameter / (1 + self.spread)
            return small * (1 + (self.spread - 1) * u)
        # Log-normal by mass, cut at its 1 and 99 % quantiles; the number of particles of a size goes with size^-3,
        # which shifts the mean of the logarithm by -3 s^2 (Hatch and Choate 1929).
        normal = statistics.NormalDist()
        s = math.log(self.spread) / (normal.inv_cdf(0.6) - normal.inv_cdf(0.1))
        low, high = (normal.cdf(normal.inv_cdf(p) + 3 * s) for p in (0.01, 0.99))
        return self.diameter * np.exp([s * (normal.inv_cdf(low + (high - low) * x) - 3 * s) for x in u])

    def solid_volume(self, diameters: np.ndarray) -> float:
        """Volume of the grains; in two dimensions of discs of 1 m length [m3]."""
        d = np.asarray(diameters)
        return float(np.sum(math.pi / 6 * d**3) if self.dimension == 3 else np.sum(math.pi / 4 * d**2))

    def inertial_time(self, pressure: float) -> float:
        """D sqrt(rho/p): a strain rate times this is the inertial number [s]."""
        return self.diameter * math.sqrt(self.density / pressure)

    def time_step(self) -> float:
        """3D: half of YADE's P-wave time step (paper 000). 2D: 0.25 sqrt(m/k) of the lightest particle [s]."""
        spheres = [body for body in O.bodies if isinstance(body.shape, Sphere)]
        if self.dimension == 3:
            return 0.5 * min(body.shape.radius for body in spheres) / math.sqrt(self.stiffness / self.density)
        owners = [O.bodies[body.clumpId] if body.isClumpMember else body for body in spheres]
        return 0.25 * math.sqrt(min(body.state.mass for body in owners) / self.stiffness)

    def add_to_scene(self) -> None:
        """The materials `grains` and `walls` (without friction, as in paper 003)."""
        young = self.stiffness
        O.materials.append(
            FrictMat(
                young=young,
                poisson=self.stiffness_ratio,
                frictionAngle=math.radians(self.friction),
                density=self.density,
                label="grains",
            )
        )
        O.materials.append(
            FrictMat(young=young, poisson=self.stiffness_ratio, frictionAngle=0.0, density=self.density, label="walls")
        )

    def engines(self, gravity: float = 0.0) -> list:
        """The engines of a simulation; servo() of this program is called every few steps."""
        if self.dimension == 3:
            physics = Ip2_FrictMat_FrictMat_FrictPhys()
        else:
            physics = Ip2_FrictMat_FrictMat_FrictPhys(
                kn=MatchMaker(algo="val", val=self.stiffness),
                ks=MatchMaker(algo="val", val=self.stiffness * self.stiffness_ratio),
            )
        return [
            ForceResetter(),
            InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=-0.12),
            InteractionLoop(
                [Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
                [physics],
                [Law2_ScGeom_FrictPhys_CundallStrack()],
            ),
            NewtonIntegrator(damping=self.damping, gravity=(0, -gravity, 0)),
            PyRunner(command="servo()", iterPeriod=SERVO_PERIOD, label="servo_engine"),
        ]


def set_friction(angle: float) -> None:
    """Give grains, and the contacts between them, another friction angle [deg]."""
    material = O.materials["grains"]
    material.frictionAngle = math.radians(angle)
    for contact in O.interactions:
        if all(isinstance(O.bodies[i].shape, Sphere) for i in (contact.id1, contact.id2)) and contact.isReal:
            contact.phys.tangensOfFrictionAngle = math.tan(math.radians(angle))
