"""A run as a list of stages that can be interrupted at any moment and continued from the last checkpoint."""

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from yade import O, utils

from common import export
from common.boundary import Boundary
from common.folder import Folder
from common.material import Material
from common.servo import Servo, connect

HISTORY_COLUMNS = [
    "stage",
    "step",
    "time_s",
    "eps_x",
    "eps_y",
    "eps_z",
    "sig_x_kPa",
    "sig_y_kPa",
    "sig_z_kPa",
    "void_ratio",
    "unbalanced",
]
HISTORY_FORMATS = ["%d", "%d", "%.6e"] + ["%.6e"] * 3 + ["%.6g"] * 3 + ["%.6f", "%.2e"]
REPORT_EVERY = 5.0
"""Wall clock time between two lines of progress [s]."""


@dataclass
class Stage:
    """One part of a run."""

    name: str
    begin: Callable[["Simulation"], None]
    """Called once, when the stage begins."""
    done: Callable[["Simulation"], bool]
    """Called after every chunk of steps."""
    chunk: int | Callable[["Simulation"], int] = 250
    """Steps between two calls of done()."""
    need: int = 1
    """How often in succession done() must hold: a quiet state can be met in passing."""
    end: Callable[["Simulation"], None] = lambda simulation: None
    """Called once, when the stage has ended."""
    record_every: int = 1
    """Chunks between two rows of the history."""
    longest: int = 2_000_000
    """Steps after which the stage is given up; the manifest then says so."""


class Simulation:
    """What all scripts drive: a folder, a material, a boundary, the servo, the history and notes for the manifest."""

    def __init__(self, folder: Folder, material: Material, boundary: Boundary, checkpoint_every: float) -> None:
        """Begin with nothing; build a scene, load a sample or resume next.

        initial_stress [Pa]: of the sample that a run starts from, compression negative.
        """
        self.folder, self.material, self.boundary = folder, material, boundary
        self.checkpoint_every = checkpoint_every
        self.servo = Servo()
        self.history: list[list[float]] = []
        self.notes: dict = {}
        self.reference = [1.0] * 3
        self.initial_stress = [0.0] * 3
        self.stage_index = self.stage_start = self.counter = 0
        self.first_step = 0
        self._saved = self._reported = time.time()

    # state of the sample

    def strain(self) -> np.ndarray:
        """Logarithmic strains since the reference was set, compression negative."""
        return np.log(self.boundary.sides() / np.array(self.reference))

    def stress(self) -> np.ndarray:
        """Normal stresses [Pa], compression negative."""
        return self.boundary.stress()

    def set_reference(self) -> None:
        """Count strains from the present state."""
        self.reference = [float(side) for side in self.boundary.sides()]

    def is_at(self, stress: list[float | None], tolerance: float, unbalanced: float) -> bool:
        """Whether the stresses [Pa] are met within a share of the largest and the unbalanced force is small."""
        wanted = [(i, s) for i, s in enumerate(stress) if s is not None]
        largest = max(abs(s) for _, s in wanted)
        now = self.stress()
        return all(abs(now[i] - s) < tolerance * largest for i, s in wanted) and utils.unbalancedForce() < unbalanced

    # running

    def connect(self) -> None:
        """Let YADE call the servo."""
        connect(self.servo, self.boundary, self.material)

    def record(self) -> None:
        """Add a row to the history."""
        row = [self.stage_index, O.iter - self.first_step, O.time, *self.strain(), *(self.stress() / 1e3)]
        row += [export.void_ratio(self.boundary), utils.unbalancedForce()]
        self.history.append([float(x) for x in row])

    def report(self, stage: Stage) -> None:
        """Print a line of progress now and then."""
        if time.time() - self._reported > REPORT_EVERY:
            self._reported = time.time()
            s, e = self.stress() / 1e3, self.strain()
            words = [
                f"{self.folder.seconds:7.0f} s  {stage.name:<12} step {O.iter:>9}",
                f"eps {e[0]:+.5f} {e[1]:+.5f} {e[2]:+.5f}",
                f"kPa {s[0]:9.3f} {s[1]:9.3f} {s[2]:9.3f}",
                f"unbalanced {utils.unbalancedForce():.1e}",
            ]
            print("  ".join(words), flush=True)

    def snapshot(self) -> dict:
        """What a checkpoint holds beside the scene."""
        names = ("history", "notes", "reference", "stage_index", "stage_start", "counter", "first_step")
        return {name: getattr(self, name) for name in names} | {"servo": self.servo.as_dict()}

    def resume(self) -> bool:
        """Continue from the checkpoint of the folder, if there is one."""
        state = self.folder.load_checkpoint(O)
        if state is None:
            return False
        self.servo = Servo(**state.pop("servo"))
        for name, value in state.items():
            setattr(self, name, value)
        self.connect()
        print(f"continued at step {O.iter}", flush=True)
        return True

    def save(self) -> None:
        """Write a checkpoint."""
        self.folder.save_checkpoint(O, self.snapshot())
        self._saved = time.time()

    def run(self, stages: list[Stage]) -> None:
        """Run the stages that are not yet done."""
        while self.stage_index < len(stages):
            stage = stages[self.stage_index]
            if self.counter == 0:
                self.stage_start = O.iter
                stage.begin(self)
            met = 0
            while met < stage.need:
                if O.iter - self.stage_start > stage.longest:
                    self.notes[f"{stage.name} given up"] = O.iter - self.stage_start
                    break
                O.run(stage.chunk(self) if callable(stage.chunk) else stage.chunk, True)
                self.counter += 1
                if self.counter % stage.record_every == 0:
                    self.record()
                self.report(stage)
                met = met + 1 if stage.done(self) else 0
                if time.time() - self._saved > self.checkpoint_every:
                    self.save()
            stage.end(self)
            self.notes[f"seconds until the end of {stage.name}"] = round(self.folder.seconds, 1)
            self.stage_index += 1
            self.counter = 0

    def write_history(self, name: str = "history.txt.gz") -> None:
        """Write the history."""
        comments = ["logarithmic strains and stresses: compression negative; one row per record"]
        self.folder.write_table(name, comments, HISTORY_COLUMNS, self.history, HISTORY_FORMATS)
