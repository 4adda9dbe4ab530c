"""Servo control: each axis has a strain rate, or a stress that the boundary is moved to reach and hold."""

from dataclasses import asdict, dataclass, field

import numpy as np
from yade import O

import __main__
from common.boundary import Boundary
from common.material import SERVO_PERIOD, Material


@dataclass
class Servo:
    """State of the control. Plain numbers only, so that a checkpoint can hold it. Stress [Pa], compression negative."""

    rate: list[float] = field(default_factory=lambda: [0.0] * 3)
    """Strain rate of axes under strain control [1/s]."""
    target: list[float | None] = field(default_factory=lambda: [None] * 3)
    """Stress of axes under stress control; None: strain control."""
    goal: list[float | None] = field(default_factory=lambda: [None] * 3)
    """Where a moving target ends."""
    speed: float = 0.0
    """How fast a target moves to its goal, in the norm of the stress [Pa/s]; 0: at once."""
    limit: float = 1.0
    """Largest strain rate of axes under stress control [1/s]."""
    relaxation: float = 60.0
    """Steps in which a stress error is to vanish; more than a wave needs to cross a sample between walls."""
    integral: list[float] = field(default_factory=lambda: [0.0] * 3)
    """Strain rate that holds the stress without an error."""
    with_integral: bool = False

    def strain(self, rate: list[float]) -> None:
        """Prescribe all strain rates [1/s]."""
        self.rate, self.target, self.goal = list(rate), [None] * 3, [None] * 3

    def hold(self, stress: list[float | None], limit: float, with_integral: bool = False) -> None:
        """Prescribe stresses [Pa]; axes with None keep their strain rate, which is set to 0."""
        self.target, self.goal, self.rate = list(stress), list(stress), [0.0] * 3
        self.limit, self.with_integral, self.integral = limit, with_integral, [0.0] * 3

    def move(self, goal: list[float | None], speed: float) -> None:
        """Move the stress targets along a straight line to a goal [Pa] with a given speed [Pa/s]."""
        self.goal, self.speed = list(goal), speed

    @property
    def arrived(self) -> bool:
        """Whether the targets are the goals."""
        return self.target == self.goal

    def advance_target(self, time: float) -> None:
        """Move the targets for a time [s]."""
        axes = [i for i in range(3) if self.target[i] is not None]
        distance = np.array([self.goal[i] - self.target[i] for i in axes])
        norm = float(np.linalg.norm(distance))
        fraction = 1.0 if norm <= self.speed * time or self.speed <= 0 else self.speed * time / norm
        for i, step in zip(axes, distance, strict=True):
            self.target[i] = self.goal[i] if fraction == 1.0 else self.target[i] + fraction * step

    def rates(self, stress: np.ndarray, bulk: float, dt: float) -> list[float]:
        """Strain rates of the next steps from the present stress [Pa]."""
        if not self.arrived:
            self.advance_target(SERVO_PERIOD * dt)
        rates = list(self.rate)
        for i, target in enumerate(self.target):
            if target is None:
                continue
            rate = -(stress[i] - target) / bulk / (self.relaxation * dt)
            if self.with_integral:
                integral = self.integral[i] + rate * SERVO_PERIOD / (8 * self.relaxation)
                self.integral[i] = max(-self.limit, min(self.limit, integral))
                rate += self.integral[i]
            rates[i] = max(-self.limit, min(self.limit, rate))
        return rates

    def as_dict(self) -> dict:
        """For a checkpoint."""
        return asdict(self)


def connect(servo: Servo, boundary: Boundary, material: Material) -> None:
    """Make YADE call this servo on this boundary: its engine looks for servo() in the main program."""

    def act() -> None:
        boundary.set_rates(servo.rates(boundary.stress(), material.bulk, O.dt))

    __main__.servo = act
