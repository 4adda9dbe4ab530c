"""Paper 002: fabric and strain of two-dimensional samples in stress cycles at constant s'.

Runs: `c_dep` of deposit.py, `c_k069` and `c_iso` of consolidate.py (with `s_` in front: k_n/k_s = 1.5; `l_`: a looser
sample), and every run folder of cycle.py that is found. The element tests run the same stress cycles in plane strain
with Hochstetten sand, which is not the material of the discs: what is compared is whether strain accumulates or dies
out.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

import hypofab
from hypofab.figures import line_style
from hypofab.results import Array, ResultError
from papers import draw
from papers.element import fabric_in_space, run_deck
from papers.runs import DemRun, read_dem, read_table

CONSOLIDATIONS = {
    "c_dep": "deposited, 50 kPa",
    "c_iso": "isotropic, s' = 127 kPa",
    "c_k069": "K = 0.69, s' = 127 kPa",
    "s_dep": "k_n/k_s = 1.5, deposited",
    "s_iso": "k_n/k_s = 1.5, isotropic",
    "s_k069": "k_n/k_s = 1.5, K = 0.69",
    "l_dep": "loose, deposited",
    "l_k069": "loose, K = 0.69",
}
GROUPS = {
    "consolidation": ("T40", "T41", "T400", "T401"),
    "amplitude": ("T20", "T30", "T40"),
    "other": ("T40_loose", "T150"),
}
"""The tests of the paper's Figures 3 to 5, of its Figures 6 to 8, and ours."""
SHOWN = 1000
"""Cycles of the element tests at most."""


@dataclass(frozen=True)
class Cycles:
    """One run of cycle.py."""

    run: DemRun
    rows: dict[str, Array]
    sample: DemRun

    @property
    def count(self) -> int:
        """Number of cycles."""
        return int(self.rows["cycle"][-1])

    @property
    def axial(self) -> Array:
        """Axial compression after each cycle [%]."""
        return -100 * self.rows["eps_y"]

    @property
    def isotropic(self) -> bool:
        """Whether the sample was consolidated isotropically."""
        sig_x, sig_y = self.rows["sig_x_kPa"][0], self.rows["sig_y_kPa"][0]
        return bool(abs(sig_x - sig_y) < 0.01 * abs(sig_x + sig_y))


def memory(test: Cycles, kind: str) -> dict:
    """Delta of the state before the cycles: mobilised along the consolidation, or from the contacts of the sample."""
    if kind == "path":
        return {"mobilised": [1, 1, 1, 0, 0, 0] if test.isotropic else [-0.3, 1, 0, 0, 0, 0]}
    xx, yy, _, xy, _, _ = hypofab.fabric_of_file(test.sample.contacts).fabric
    return {"fabric": fabric_in_space(xx, yy, xy)}


def element_cycles(tests: dict[str, Cycles], kind: str) -> dict[str, tuple[Array, Array]]:
    """Cycle number and axial compression [%] after each cycle of the same stress cycles in element tests."""
    states, steps = [], []
    for name, test in tests.items():
        sig_x, sig_y = float(test.rows["sig_x_kPa"][0]), float(test.rows["sig_y_kPa"][0])
        mean = -(sig_x + sig_y) / 2
        states.append(
            {
                "name": name,
                "material": "sand",
                "stress": [-sig_x, -sig_y, mean, 0, 0, 0],
                "void_ratio": 0.70,
                "delta": memory(test, kind),
            }
        )
        cycle = {
            "quantity": "t",
            "from_start": [0, test.run.parameters["amplitude"] * mean],
            "count": min(test.count, SHOWN),
            "keep": "reversals",
        }
        preset = {"preset": "constant_s_biaxial_compression", "axis": "y", "normal": "z", "drive": "stress"}
        steps.append({"name": name, "state": name, "tolerance": 1e-6, "steps": [preset | {"cycle": cycle}]})
    deck = {
        "unit": "kPa",
        "sign": "compression_positive",
        "materials": [{"name": "sand", "sand": "hochstetten"}],
        "states": states,
        "tests": steps,
    }
    results = run_deck(deck, may_stop=True)
    # Rows: the start, then one per reversal; every second is the end of a cycle.
    return {name: (np.arange(len(test.strain[::2])), 100 * test.strain[::2, 1]) for name, test in results.items()}


def consolidation(runs: Path) -> str:
    """Fabric after deposition and consolidation."""
    rows = []
    for name, title in CONSOLIDATIONS.items():
        if not (runs / name).exists():
            continue
        r = read_dem(runs / name).results
        rows.append(
            [
                title,
                str(r["particles"]),
                f"{r['void_ratio']:.3f}",
                f"{r['coordination_number']:.3f}",
                f"{r['mechanical_coordination_number']:.3f}",
                f"{r['anisotropy'] / 2:.4f}",
                f"{r['anisotropy_noise'] / 2:.4f}",
            ]
        )
    head = ["state", "discs", "e", "Z = 2 N_c/N_p", "mechanical CN", "deviator fabric", "of noise"]
    return draw.table(head, rows)


def figure(tests: dict[str, Cycles], element: dict[str, dict[str, tuple[Array, Array]]], path: Path) -> None:
    """Axial strain in DEM and element tests, coordination number and deviator fabric over the number of cycles."""
    with draw.panels(path, 4, size=(75, 72)) as (strain, elements, number, fabric):
        for index, (name, test) in enumerate(tests.items()):
            style = line_style(index)
            cycle = test.rows["cycle"] + 1
            strain.plot(cycle, test.axial, label=name, **style)
            for kind, width in (("path", style["linewidth"]), ("fabric", 0.6)):
                count, axial = element[kind][name]
                elements.plot(count + 1, axial, **(style | {"linewidth": width}))
            number.plot(cycle, test.rows["coordination_number"], **style)
            fabric.plot(cycle, test.rows["deviator_fabric"], **style)
        strain.set(title="DEM", ylabel="axial compression [%]")
        elements.set(title="element tests (thin: delta from fabric)", ylabel="axial compression [%]")
        number.set(title="Z = 2 N_c/N_p")
        fabric.set(title=r"deviator fabric $\Phi_1 - \Phi_2$")
        for axes in (strain, elements, number, fabric):
            axes.set(xlabel="cycles + 1", xscale="log")
        strain.legend()


def table(tests: dict[str, Cycles], element: dict[str, dict[str, tuple[Array, Array]]]) -> str:
    """What each test kept."""
    rows = []
    for name, test in tests.items():
        axial, tenth = test.axial, max(1, test.count // 10)
        rows.append(
            [
                name,
                str(test.count),
                f"{test.run.parameters['amplitude']:.2f}",
                f"{axial[1]:.4f}",
                f"{axial[-1] - axial[1]:.4f}",
                f"{axial[-1] - axial[-1 - tenth]:.4f}",
                f"{-100 * (test.rows['eps_y_peak'][-1] - test.rows['eps_y'][-1]):.4f}",
                *(f"{test.rows[key][0]:.3f}, {test.rows[key][-1]:.3f}" for key in ("coordination_number",)),
                f"{test.rows['deviator_fabric'][0]:.4f}, {test.rows['deviator_fabric'][-1]:.4f}",
                *(f"{one[name][1][1]:.3f}, {one[name][1][-1]:.3f}" for one in element.values()),
            ]
        )
    head = ["test", "cycles", "dt/s'", "strain of the first cycle [%]", "from then to the last", "in the last tenth"]
    head += ["amplitude [%]", "Z, start and end", "deviator fabric, start and end"]
    return draw.table([*head, "element, delta along the path: first, last [%]", "element, delta from fabric"], rows)


def compare(runs: Path, out: Path) -> str:
    """Figures 3 to 8 in kind, with element tests of the same stress cycles."""
    tests = {}
    for path in sorted(runs.glob("*/cycles.txt*")):
        run = read_dem(path.parent)
        tests[path.parent.name] = Cycles(
            run, read_table(path.parent, "cycles.txt"), read_dem(runs / run.parameters["sample"])
        )
    if not tests:
        raise ResultError(f"{runs}: no run of cycle.py; examples/dem/README.md says how to make them")
    element = {kind: element_cycles(tests, kind) for kind in ("path", "fabric")}
    for group, names in GROUPS.items():
        shown = {name: tests[name] for name in names if name in tests}
        if shown:
            figure(shown, element, out / f"002_{group}.png")
    return consolidation(runs) + "\n\n" + table(tests, element)
