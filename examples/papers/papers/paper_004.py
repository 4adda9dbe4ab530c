"""Paper 004: plastic flow at failure states, by stress probes of three-dimensional samples, and in element tests.

Runs: `lode0`, `lode20`, ... of probe_stress.py, one per Lode angle; optional are `A_plus` and `A_minus` (a tangent path
of some kPa from lode0 before the probes) and `tangent20` (a path along the failure surface to the stress of lode20).
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hypofab.results import Array, ResultError
from papers import draw, figures_004
from papers.describe import describe
from papers.element import run_deck, run_envelopes
from papers.flow import Flow, amount_of, flow_of, octahedral, octahedral_unit, range_of
from papers.runs import DemRun, file_of, read_dem, read_table

PRESSURE, VOID_RATIO = 100.0, 0.70
"""Of the sand in the element tests [kPa, -]."""
BEFORE_PEAK = 0.97
"""Share of the largest q of the radial path at which element tests are probed."""


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
    def tangent(self) -> bool:
        """Whether a tangent path came before the probes."""
        return any(self.run.parameters.get(key) is not None for key in ("tangent", "tangent_to"))

    @property
    def stress(self) -> Array:
        """Stress of the probes [kPa]."""
        return np.array(self.run.results["notes"]["stress of the probes [kPa]"])

    @property
    def failure(self) -> Array:
        """Stress at failure [kPa]."""
        return np.array(self.run.results["notes"]["stress at failure [kPa]"])

    @property
    def flow(self) -> Flow:
        """Direction of the plastic strains."""
        return flow_of(self.plastic, self.stress)

    @property
    def amount(self) -> tuple[Array, Array]:
        """Cosine of each increment with the flow direction, and the plastic strain along it per stress."""
        return amount_of(self.increments, self.plastic, self.flow)

    def fabric(self, sliding: bool = False) -> Array:
        """Diagonal of N of all contacts or of sliding ones; NaN when none slides."""
        if not sliding:
            return np.array(self.described["fabric"][:3])
        contacts = read_table(self.run.path, "failure_contacts.txt")
        normals, normal_force, shear = (
            np.column_stack([contacts[f"{name}{axis}"] for axis in "xyz"]) for name in ("n", "Fn", "Fs")
        )
        friction = np.tan(np.radians(self.run.friction))
        slides = np.linalg.norm(shear, axis=1) > 0.99 * friction * np.linalg.norm(normal_force, axis=1)
        return np.mean(normals[slides] ** 2, axis=0) if slides.any() else np.full(3, np.nan)


def read_failure(path: Path) -> Failure:
    """Probes of one run folder."""
    run = read_dem(path)
    rows = read_table(path, "probes.txt")
    real = rows["number"] >= 0

    def vectors(name: str) -> Array:
        return np.column_stack([rows[f"{name}_{axis}"] for axis in "xyz"])

    plastic = vectors("eps_irr")
    plastic = plastic[real] - plastic[~real]
    described = describe(file_of(path, "failure_contacts.txt"), run.friction)
    return Failure(run, vectors("dsig")[real], vectors("eps")[real], plastic, described)


@dataclass(frozen=True)
class ElementProbes:
    """The same probes in an element test."""

    stress: Array
    """State of the probes [kPa], tension positive, shape (3,)."""
    increments: Array
    plastic: Array

    @property
    def flow(self) -> Flow:
        """Direction of the plastic strains."""
        return flow_of(self.plastic, self.stress)


def element_probes(states: dict[str, Failure]) -> dict[str, ElementProbes]:
    """Radial paths to 97 % of the peak, tangent paths as in the DEM runs, and stress probes with unloading."""
    sand = [{"name": "sand", "sand": "paper000"}]
    start = {"name": "compressed", "material": "sand", "p": PRESSURE, "void_ratio": VOID_RATIO}
    start["delta"] = {"mobilised": [1, 1, 1, 0, 0, 0]}  # isotropic compression before
    head = {"unit": "kPa", "sign": "compression_positive", "materials": sand, "states": [start]}

    def radial(lode: float, until: dict) -> dict:
        # y is compressed most, x least, as in the DEM runs.
        return {"preset": "radial_constant_p", "axis": "y", "lode": lode, "until": until, "rows": 400}

    lodes = sorted({state.lode for state in states.values()} | {0.0, 20.0})
    far = {"quantity": "eps_q", "value": 0.1}
    peaks = run_deck(
        head
        | {
            "tests": [
                {"name": f"lode{lode:.0f}", "state": "compressed", "steps": [radial(lode, far)]} for lode in lodes
            ]
        },
        may_stop=True,
    )
    tests = []
    ends = {}
    for lode in lodes:
        peak = peaks[f"lode{lode:.0f}"]
        reached = BEFORE_PEAK * float(peak.q.max())
        row = int(np.argmax(peak.q >= reached))
        ends[lode] = peak.stress[row, :3]
        steps = [radial(lode, {"quantity": "q", "value": reached})]
        tests.append({"name": f"lode{lode:.0f}", "state": "compressed", "steps": steps})
    for name, state in states.items():
        if state.run.parameters.get("tangent") is not None:
            path = -state.run.parameters["tangent"] * octahedral_unit(90.0)
        elif state.run.parameters.get("tangent_to") is not None:
            path = ends[20.0] - ends[0.0]
        else:
            continue
        axis = int(np.argmax(np.abs(path)))
        until = {"quantity": f"sig_{'xyz'[axis] * 2}", "value": float(ends[0.0][axis] + path[axis])}
        tangent = {"preset": "proportional_stress", "direction": [*map(float, path), 0, 0, 0], "until": until}
        steps = [*tests[lodes.index(0.0)]["steps"], tangent]
        tests.append({"name": name, "state": "compressed", "steps": steps})
    size = float(np.linalg.norm(next(iter(states.values())).increments[0]))
    envelope = {"name": "probes", "principal": "xyz", "impose": "stress", "size": size, "unload": True, "probes": 112}
    envelope["series"] = [{"name": test["name"], "after": test["name"]} for test in tests]
    found = run_envelopes(head | {"tests": tests, "envelopes": [envelope]})["probes"].series
    return {
        series.name: ElementProbes(
            -series.stress[:3], -size * series.direction[:, :3], -size * series.irrecoverable[:, :3]
        )
        for series in found
        if series.irrecoverable is not None
    }


def numbers(values: Array, digits: int = 2) -> str:
    """Three numbers in a cell."""
    return " ".join(f"{value:.{digits}f}" for value in values)


def table(states: dict[str, Failure], element: dict[str, ElementProbes]) -> str:
    """One row per state."""
    rows = []
    for name, state in states.items():
        flow, stress = state.flow, state.failure
        q = np.sqrt(1.5 * np.sum((stress - stress.mean()) ** 2))
        ratio = np.linalg.norm(state.plastic, axis=1).max() / np.linalg.norm(state.loaded, axis=1).max()
        rows.append(
            [
                name,
                f"{state.run.results['particles']}, {np.linalg.norm(state.increments[0]):.1f}",
                f"{q / -stress.mean():.2f}",
                numbers(-state.stress, 1),
                numbers(state.fabric(), 3),
                numbers(state.fabric(sliding=True), 3),
                numbers(flow.direction),
                f"{100 * flow.share:.1f}",
                f"{np.degrees(np.arctan2(*octahedral(-state.stress))):.0f}",
                "{:.0f} ({:.0f} to {:.0f})".format(flow.angle, *range_of(state.plastic)),
                f"{ratio:.2f}",
                numbers(element[name].flow.direction),
                f"{100 * element[name].flow.share:.1f}",
                "{:.0f} ({:.0f} to {:.0f})".format(element[name].flow.angle, *range_of(element[name].plastic)),
            ]
        )
    head = [
        "state",
        "spheres, increment [kPa]",
        "q/p at failure",
        "stress of the probes x y z [kPa]",
        "N xx yy zz",
        "N of sliding contacts",
    ]
    head += [
        "flow x y z",
        "its share [%]",
        "Lode angle of stress",
        "of flow (over increments)",
        "plastic over total, largest",
    ]
    return draw.table(
        [*head, "flow x y z, element", "its share [%]", "Lode angle of flow, element (over increments)"], rows
    )


def read_states(runs: Path) -> dict[str, Failure]:
    """All states that are found: radial paths by their Lode angles, then the tangent ones."""
    folders = sorted(path.parent for path in runs.glob("*/probes.txt*"))
    states = [read_failure(folder) for folder in folders]
    if not any(state.lode == 0 for state in states):
        raise ResultError(f"{runs}: no run lode0 of probe_stress.py; examples/dem/README.md says how to make it")
    states.sort(key=lambda state: (state.tangent, state.lode))
    return {state.run.name: state for state in states}


def compare(runs: Path, out: Path) -> str:
    """Figures 1 to 4 in kind."""
    states = read_states(runs)
    element = element_probes(states)
    figures_004.envelopes(states, element, out / "004_envelopes.png")
    figures_004.principal(states, element, out / "004_principal.png")
    figures_004.ellipsoids(states, out / "004_fabric.png")
    if "A_plus" in states and "A_minus" in states:
        figures_004.tangents(states, element, out / "004_tangent.png")
    return table(states, element)
