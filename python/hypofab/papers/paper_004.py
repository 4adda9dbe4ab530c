"""Paper 004: plastic flow at failure states on radial paths, by stress probes of three-dimensional samples.

Runs: every run folder of probe_stress.py that is found, one per Lode angle.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hypofab.figures import line_style
from hypofab.papers import draw
from hypofab.papers.program import run_json
from hypofab.papers.runs import DemRun, read_dem, read_table
from hypofab.results import Array, ResultError


@dataclass(frozen=True)
class Failure:
    """The probes at one failure state. Principal axes are x, y, z."""

    run: DemRun
    increments: Array
    """Stress increments [kPa], shape (probes, 3)."""
    loaded: Array
    """Strain at the end of each increment."""
    plastic: Array
    """Strain that stays after unloading, less what a rest of equal length brings."""
    described: dict
    """What `hypofab describe` says of the contacts."""

    @property
    def lode(self) -> float:
        """Lode angle of the path [deg]."""
        return float(self.run.parameters["lode"])

    @property
    def stress(self) -> Array:
        """Stress of the probes [kPa]."""
        return np.array(self.run.results["notes"]["stress of the probes [kPa]"])

    @property
    def failure(self) -> Array:
        """Stress at failure [kPa]."""
        return np.array(self.run.results["notes"]["stress at failure [kPa]"])

    @property
    def flow(self) -> tuple[Array, Array]:
        """Principal directions of the plastic strains (rows) and the share of each in their squares.

        The first points so that the plastic strain grows along the largest compression.
        """
        _, values, axes = np.linalg.svd(self.plastic, full_matrices=False)
        deviator = self.stress - self.stress.mean()
        axes[0] *= np.sign(axes[0] @ deviator)
        return axes, values**2 / np.sum(values**2)

    def fabric(self, sliding: bool = False) -> Array:
        """Diagonal of N of all contacts or of sliding ones; NaN when none slides."""
        if not sliding:
            return np.array(self.described["fabric"][:3])
        contacts = read_table(self.run.path / "failure_contacts.txt.gz")
        normals, normal_force, shear = (
            np.column_stack([contacts[f"{name}{axis}"] for axis in "xyz"]) for name in ("n", "Fn", "Fs")
        )
        friction = np.tan(np.radians(self.run.friction))
        slides = np.linalg.norm(shear, axis=1) > 0.99 * friction * np.linalg.norm(normal_force, axis=1)
        return np.mean(normals[slides] ** 2, axis=0) if slides.any() else np.full(3, np.nan)


def read_failure(path: Path) -> Failure:
    """Probes of one run folder."""
    run = read_dem(path)
    rows = read_table(path / "probes.txt.gz")
    real = rows["number"] >= 0

    def vectors(name: str) -> Array:
        return np.column_stack([rows[f"{name}_{axis}"] for axis in "xyz"])

    plastic = vectors("eps_irr")
    plastic = plastic[real] - plastic[~real]
    described = run_json("describe", path / "failure_contacts.txt.gz", "--friction-angle", str(run.friction))
    return Failure(run, vectors("dsig")[real], vectors("eps")[real], plastic, described)


def octahedral(vectors: Array) -> tuple[Array, Array]:
    """Coordinates of vectors (x, y, z) in the deviatoric plane: y upwards, x to the lower left, z to the right."""
    x, y, z = np.moveaxis(np.asarray(vectors), -1, 0)
    return (z - x) / np.sqrt(2), (2 * y - x - z) / np.sqrt(6)


def figure(states: list[Failure], path: Path) -> None:
    """Figures 1, 2 and 4: failure points and plastic flow in the deviatoric plane, stress, fabric, sliding contacts."""
    with draw.panels(path, 3, size=(95, 90)) as (plane, size, fabric):
        for index, state in enumerate(states):
            style = line_style(index)
            color = style["color"]
            label = rf"$\theta$ = {state.lode:.0f}$^\circ$"
            place = np.array(octahedral(-state.stress))
            plane.plot(*place, "o", color=color, label=label)
            steps = np.array(octahedral(-state.plastic)).T
            steps *= 25 / np.max(np.linalg.norm(steps, axis=1))
            for step in steps:
                plane.plot(*np.stack([place, place + step]).T, color=color, linewidth=0.5)
            axes, _ = state.flow
            along = state.increments @ axes[0] / np.linalg.norm(state.increments, axis=1)
            amount = state.plastic @ axes[0]
            size.plot(along, 1e6 * amount / np.linalg.norm(state.increments, axis=1), "o", markersize=3, color=color)
            all_contacts, slid = state.fabric() - 1 / 3, state.fabric(sliding=True) - 1 / 3
            stress = state.stress / state.stress.sum() - 1 / 3
            for values, marker in ((stress, "o"), (all_contacts, "s"), (slid, "^")):
                fabric.plot(
                    *(np.array(octahedral(values))), marker, color=color, fillstyle="none" if marker != "o" else "full"
                )
        plane.plot(0, 0, "+", color="black")
        plane.set(title="failure and plastic flow, deviatoric plane", xlabel="kPa", ylabel="kPa (y upwards)")
        plane.set_aspect("equal", adjustable="datalim")
        plane.legend()
        size.set(
            title="amount of flow",
            xlabel="cosine of increment and flow direction",
            ylabel="plastic strain along it per kPa [1e-6]",
        )
        fabric.plot(0, 0, "+", color="black")
        fabric.set(title="stress (dots), N, sliding N (triangles)")
        fabric.set_aspect("equal", adjustable="datalim")


def ellipsoids(states: list[Failure], path: Path) -> None:
    """Figure 3: the fabric of all contacts as a surface 1 + F:nn."""
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    from hypofab.figures import INCH, STYLE

    u, v = np.meshgrid(np.linspace(0, np.pi, 31), np.linspace(0, 2 * np.pi, 61))
    n = np.stack([np.sin(u) * np.cos(v), np.cos(u), np.sin(u) * np.sin(v)])
    with rc_context(STYLE):
        drawing = Figure(figsize=(70 * len(states) / INCH, 75 / INCH), layout="constrained")
        for index, state in enumerate(states):
            deviator = 7.5 * (state.fabric() - 1 / 3)
            x, y, z = n * (1 + np.einsum("i...,i,i...->...", n, deviator, n))
            axes = drawing.add_subplot(1, len(states), index + 1, projection="3d")
            axes.plot_surface(x, z, y, color="#7FBFE8", edgecolor="#00508C", linewidth=0.2)
            axes.set(xlim=(-1.6, 1.6), ylim=(-1.6, 1.6), zlim=(-1.6, 1.6), xlabel="x", ylabel="z", zlabel="y")
            axes.set_title(rf"$\theta$ = {state.lode:.0f}$^\circ$")
            axes.set_box_aspect((1, 1, 1))
            axes.tick_params(labelsize=6)
        drawing.savefig(path, dpi=110)


def numbers(values: Array, digits: int = 2) -> str:
    """Three numbers in a cell."""
    return " ".join(f"{value:.{digits}f}" for value in values)


def table(states: list[Failure]) -> str:
    """One row per failure state."""
    rows = []
    for state in states:
        axes, shares = state.flow
        stress = state.failure
        deviator = stress - stress.mean()
        q = np.sqrt(1.5 * np.sum(deviator**2))
        flow = axes[0] - axes[0].mean()
        cosine = flow @ deviator / np.linalg.norm(flow) / np.linalg.norm(deviator)
        rows.append(
            [
                f"{state.lode:.0f}",
                f"{q / -stress.mean():.2f}",
                numbers(-state.stress, 1),
                numbers(state.fabric(), 3),
                numbers(state.fabric(sliding=True), 3),
                numbers(axes[0]),
                f"{100 * shares[0]:.1f}",
                f"{np.degrees(np.arccos(np.clip(cosine, -1, 1))):.0f}",
                f"{np.linalg.norm(state.plastic, axis=1).max() / np.linalg.norm(state.loaded, axis=1).max():.2f}",
            ]
        )
    head = ["Lode angle", "q/p at failure", "stress of the probes x y z [kPa]", "N xx yy zz", "N of sliding contacts"]
    head += [
        "flow direction x y z",
        "its share [%]",
        "angle of flow and stress deviator [deg]",
        "plastic over total, largest",
    ]
    return draw.table(head, rows)


def compare(runs: Path, out: Path) -> str:
    """Figures 1 to 4 in kind."""
    folders = sorted(path.parent for path in runs.glob("*/probes.txt.gz"))
    if not folders:
        raise ResultError(f"{runs}: no run folder of probe_stress.py; examples/dem/README.md says how to make them")
    states = sorted((read_failure(folder) for folder in folders), key=lambda state: state.lode)
    figure(states, out / "004_flow.png")
    ellipsoids(states, out / "004_fabric.png")
    return table(states)
