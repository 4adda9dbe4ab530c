"""Paper 002: fabric and strain of two-dimensional samples in stress cycles at constant s'.

Runs: `c_dep` of deposit.py, `c_k069` and `c_iso` of consolidate.py (with `l_` in front: a looser sample), and every run
folder of cycle.py that is found. The element tests run the same stress cycles in plane strain with Hochstetten sand,
which is not the material of the discs: what is compared is whether strain accumulates or dies out.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hypofab.figures import line_style
from hypofab.papers import draw
from hypofab.papers.element import run_deck
from hypofab.papers.runs import DemRun, read_dem, read_table
from hypofab.results import Array, ResultError

CONSOLIDATIONS = {
    "c_dep": "deposited, 50 kPa",
    "c_iso": "isotropic, s' = 127 kPa",
    "c_k069": "K = 0.69, s' = 127 kPa",
    "l_dep": "loose, deposited",
    "l_k069": "loose, K = 0.69",
}


@dataclass(frozen=True)
class Cycles:
    """One run of cycle.py."""

    run: DemRun
    rows: dict[str, Array]

    @property
    def count(self) -> int:
        """Number of cycles."""
        return int(self.rows["cycle"][-1])


def element_cycles(tests: dict[str, Cycles]) -> dict[str, tuple[Array, Array]]:
    """Cycle number and axial strain (compression negative) after each cycle of the same stress cycles in element tests.

    delta is fully mobilised: along the isotropic consolidation, or along the K path.
    """
    states, steps = {}, []
    for name, test in tests.items():
        sig_x, sig_y = float(test.rows["sig_x_kPa"][0]), float(test.rows["sig_y_kPa"][0])
        mean = -(sig_x + sig_y) / 2
        isotropic = abs(sig_x - sig_y) < 0.02 * mean
        state = "isotropic" if isotropic else "anisotropic"
        states[state] = {
            "name": state,
            "material": "sand",
            "stress": [-sig_x, -sig_y, mean, 0, 0, 0],
            "void_ratio": 0.70,
            "delta": {"mobilised": [1, 1, 1, 0, 0, 0] if isotropic else [-0.3, 1, 0, 0, 0, 0]},
        }
        amplitude = test.run.parameters["amplitude"] * mean
        steps.append(
            {
                "name": name,
                "state": state,
                "tolerance": 1e-6,
                "steps": [
                    {
                        "preset": "constant_s_biaxial_compression",
                        "axis": "y",
                        "normal": "z",
                        "drive": "stress",
                        "cycle": {
                            "quantity": "t",
                            "from_start": [0, amplitude],
                            "count": test.count,
                            "keep": "reversals",
                        },
                    }
                ],
            }
        )
    deck = {
        "unit": "kPa",
        "sign": "compression_positive",
        "materials": [{"name": "sand", "sand": "hochstetten"}],
        "states": list(states.values()),
        "tests": steps,
    }
    results = run_deck(deck, may_stop=True)
    # Rows: the start, then one per reversal; every second is the end of a cycle.
    return {name: (np.arange(len(test.strain[::2])), -test.strain[::2, 1]) for name, test in results.items()}


def consolidation(runs: Path) -> tuple[str, list[float]]:
    """Fabric after deposition and consolidation: a table, and the deviator fabric of each state."""
    rows, values = [], []
    for name, title in CONSOLIDATIONS.items():
        if not (runs / name).exists():
            continue
        r = read_dem(runs / name).results
        values.append(r["anisotropy"] / 2)
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
    return draw.table(head, rows), values


def compare(runs: Path, out: Path) -> str:
    """Figures 3 to 8 in kind, with element tests of the same stress cycles."""
    tests = {
        path.parent.name: Cycles(read_dem(path.parent), read_table(path))
        for path in sorted(runs.glob("*/cycles.txt.gz"))
    }
    if not tests:
        raise ResultError(f"{runs}: no run of cycle.py; examples/dem/README.md says how to make them")
    text, values = consolidation(runs)
    element = element_cycles(tests)
    rows = []
    with draw.panels(out / "002_cycles.png", 4, size=(75, 72)) as (strain, elements, number, fabric):
        for index, (name, test) in enumerate(tests.items()):
            style = line_style(index)
            cycle = test.rows["cycle"]
            axial = -100 * test.rows["eps_y"]
            strain.plot(cycle, axial, label=name, **style)
            count, eps = element[name]
            elements.plot(count, -100 * eps, **style)
            number.plot(cycle, test.rows["coordination_number"], **style)
            fabric.plot(cycle, test.rows["deviator_fabric"], **style)
            tenth = min(10, test.count)
            rows.append(
                [
                    name,
                    str(test.count),
                    f"{test.run.parameters['amplitude']:.2f}",
                    f"{axial[1]:.4f}",
                    f"{axial[-1] - axial[1]:.4f}",
                    f"{(axial[-1] - axial[-1 - tenth]) / tenth:.5f}",
                    f"{-100 * (test.rows['eps_y_peak'][-1] - test.rows['eps_y'][-1]):.4f}",
                    f"{test.rows['coordination_number'][0]:.3f}, {test.rows['coordination_number'][-1]:.3f}",
                    f"{test.rows['deviator_fabric'][0]:.4f}, {test.rows['deviator_fabric'][-1]:.4f}",
                    f"{-100 * eps[-1]:.4f}",
                ]
            )
        strain.set(title="DEM", ylabel="axial compression [%]")
        elements.set(title="element tests", ylabel="axial compression [%]")
        number.set(title="Z = 2 N_c/N_p")
        fabric.set(title=r"deviator fabric $\Phi_1 - \Phi_2$")
        for axes in (strain, elements, number, fabric):
            axes.set_xlabel("cycle")
        for deviator in values:
            fabric.axhline(deviator, color="0.7", linewidth=0.8)
        strain.legend()
    head = ["test", "cycles", "dt/s'", "strain of the first cycle [%]", "from then to the last", "per cycle, last ten"]
    head += ["amplitude [%]", "Z, start and end", "deviator fabric", "element test [%]"]
    return text + "\n\n" + draw.table(head, rows)
