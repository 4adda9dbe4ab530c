"""Paper 003: two-dimensional samples made in three ways, and their biaxial tests.

Runs: `dep`, `mult`, `iso` of deposit.py (gravity, layers, isotropic) and `bi_dep`, `bi_mult`, `bi_iso` of load.py with
contact lists at some strains.
"""

import csv
import io
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure

from hypofab.figures import INCH, STYLE, line_style
from hypofab.papers import draw
from hypofab.papers.program import run as call
from hypofab.papers.runs import Curve, DemRun, read_curve, read_dem, read_table
from hypofab.results import Array

METHODS = {"dep": "deposition", "mult": "layers", "iso": "isotropic"}
PAPER = {"dep": (0.203, 4.81, 0.159), "mult": (0.203, 4.41, 0.205), "iso": (0.203, 4.35, 0.041)}
"""Table 2, tests at 500 kPa: e0, coordination number, a_n."""


@dataclass(frozen=True)
class Test:
    """One biaxial test: its sample, its curve, and what `hypofab describe` says of its contact lists."""

    __test__ = False  # not a test class for pytest

    sample: DemRun
    curve: Curve
    strain: Array
    """Axial compression at the contact lists."""
    micro: dict[str, Array]
    """Columns of `hypofab describe --csv`, one row per contact list."""
    lists: list[Path]

    @property
    def p(self) -> Array:
        """Mean stress (s1 + s3)/2 [kPa]."""
        return -self.curve.stress[:, :2].mean(axis=1)

    def every(self, step: float = 0.004) -> tuple[Array, Array, Array]:
        """Axial strain, q/p and dilatancy -d eps_v/d eps_1, averaged over steps of strain."""
        edges = np.arange(0, self.curve.axial[-1], step)
        middle = (edges[1:] + edges[:-1]) / 2
        volume = np.interp(edges, self.curve.axial, self.curve.eps_v)
        ratio = self.curve.q / self.p
        inside = np.digitize(self.curve.axial, edges)
        mean = np.array([ratio[inside == k].mean() if np.any(inside == k) else np.nan for k in range(1, len(edges))])
        return middle, mean, np.diff(volume) / step

    @property
    def critical(self) -> float:
        """Mean q/p over the last fifth of the test."""
        late = self.curve.axial > 0.8 * self.curve.axial[-1]
        return float((self.curve.q / self.p)[late].mean())


def read_test(runs: Path, method: str) -> Test:
    """One method's sample and biaxial test."""
    folder = runs / f"bi_{method}"
    loaded = read_dem(folder)
    taken = loaded.results["notes"]["snapshots"]
    lists = [folder / f"{entry['name']}_contacts.txt.gz" for entry in taken]
    options = ["--plane", "--csv", "--friction-angle", str(loaded.friction), "--sliding", "0.9999"]
    rows = list(csv.DictReader(io.StringIO(call("describe", *lists, *options))))
    micro = {
        name: np.array([float(row[name]) if row[name] else np.nan for row in rows])
        for name in rows[0]
        if name != "file"
    }
    axis = "xyz".index(loaded.parameters["axis"])
    strain = np.array([-entry["strain"][axis] for entry in taken])
    return Test(read_dem(runs / method), read_curve(folder), strain, micro, lists)


def table(tests: dict[str, Test]) -> str:
    """Table 2 and what the tests show: peaks and ends."""
    rows = []
    for name, test in tests.items():
        r = test.sample.results
        _, ratio, dilatancy = test.every()
        paper = PAPER[name]
        rows.append(
            [
                METHODS[name],
                f"{r['particles']} ({r['contacts']})",
                f"{r['void_ratio']:.3f} ({paper[0]:.3f})",
                f"{r['mechanical_coordination_number']:.2f} ({paper[1]:.2f})",
                f"{r['anisotropy']:.3f} ({paper[2]:.3f})",
                f"{np.nanmax(ratio):.2f}",
                f"{np.nanmax(dilatancy):.2f}",
                f"{test.critical:.2f}",
                f"{np.degrees(np.arcsin(test.critical / 2)):.1f}",
            ]
        )
    head = ["sample", "particles (contacts)", "e (paper)", "mechanical CN (paper)", "a_n (paper)", "peak q/p"]
    return draw.table([*head, "peak dilatancy", "q/p at the end", "phi at the end [deg]"], rows)


def friction_table(tests: dict[str, Test]) -> str:
    """Figure 13 in numbers: sin(phi) by Eq. 8 against that of the stresses from contacts and from walls."""
    rows = []
    for name, test in tests.items():
        walls = np.interp(test.strain, test.curve.axial, test.curve.q / test.p / 2)
        for index, strain in enumerate(test.strain):
            micro = {key: values[index] for key, values in test.micro.items()}
            rows.append(
                [
                    METHODS[name],
                    f"{100 * strain:.2f}",
                    *(f"{micro[key]:.3f}" for key in ("a_n", "a_f", "a_t")),
                    f"{micro['sin_phi_from_anisotropies']:.3f}",
                    f"{micro['sin_phi']:.3f}",
                    f"{walls[index]:.3f}",
                    f"{micro['sliding_ratio']:.3f}",
                ]
            )
    head = ["sample", "strain [%]", "a_n", "a_f", "a_t", "sin phi, Eq. 8", "of contacts", "of walls", "sliding"]
    return draw.table(head, rows)


def macroscopic(tests: dict[str, Test], path: Path) -> None:
    """Figures 6 and 9: q, volumetric strain, q/p and dilatancy; stress over dilatancy with Rowe's line."""
    with draw.panels(path, 3, rows=2, size=(80, 65)) as (q, volume, ratio, dilatancy, rowe, ends):
        for index, (name, test) in enumerate(tests.items()):
            style = line_style(index)
            label = METHODS[name]
            strain = 100 * test.curve.axial
            q.plot(strain, test.curve.q, label=label, **style)
            volume.plot(strain, 100 * test.curve.eps_v, **style)
            middle, mean, rate = test.every()
            ratio.plot(100 * middle, mean, **style)
            dilatancy.plot(100 * middle, rate, **style)
            rowe.plot(rate, mean, "o", markersize=3, color=style["color"])
            a_n = test.sample.results["anisotropy"]
            ends.plot(a_n, np.nanmax(mean), "s", color=style["color"])
            ends.plot(a_n, np.nanmax(rate), "o", color=style["color"], fillstyle="none")
        phi = np.arcsin(np.mean([test.critical for test in tests.values()]) / 2)
        rates = np.linspace(-0.4, 0.8, 50)
        major = (1 + rates) * np.tan(np.pi / 4 + phi / 2) ** 2
        line = 2 * (major - 1) / (major + 1)
        rowe.plot(rates, line, color="0.4", linewidth=1, label=f"Rowe, {np.degrees(phi):.1f} deg")
        q.set(ylabel="q [kPa]")
        q.legend()
        volume.set(ylabel="volumetric strain [%]")
        ratio.set(ylabel="q/p", xlabel="axial strain [%]")
        dilatancy.set(ylabel=r"$-d\varepsilon_v/d\varepsilon_1$", xlabel="axial strain [%]")
        rowe.set(xlabel="dilatancy", ylabel="q/p")
        rowe.legend()
        ends.set(
            xlabel="$a_n$ of the sample", ylabel="peak q/p (squares), dilatancy (rings)", xlim=(0, None), ylim=(0, None)
        )


def microscopic(tests: dict[str, Test], path: Path) -> None:
    """Figures 10, 12 to 14 and 18: anisotropies, coordination number, sin(phi), sliding contacts over strain."""
    panels = {
        "a_n": "$a_n$",
        "a_f": "$a_f$",
        "a_t": "$a_t$",
        "mechanical_coordination_number": "mechanical coordination number",
        "sliding_ratio": "share of sliding contacts",
    }
    with draw.panels(path, 3, rows=2, size=(80, 65)) as axes:
        for index, (name, test) in enumerate(tests.items()):
            style = line_style(index)
            for panel, (key, title) in zip(axes, panels.items(), strict=False):
                panel.plot(100 * test.strain, test.micro[key], marker="o", markersize=3, label=METHODS[name], **style)
                panel.set(
                    title=title,
                    xlabel="axial strain [%]",
                    ylim=(0, None) if key != "mechanical_coordination_number" else None,
                )
            axes[5].plot(100 * test.curve.axial, test.curve.q / test.p / 2, **(style | {"linewidth": 0.8}))
            axes[5].plot(
                100 * test.strain, test.micro["sin_phi_from_anisotropies"], "o", color=style["color"], markersize=4
            )
        axes[5].set(title=r"$\sin\varphi$: walls (lines), Eq. 8 (points)", xlabel="axial strain [%]", ylim=(0, None))
        axes[0].legend()


def roses(tests: dict[str, Test], path: Path) -> None:
    """Figure 11: density of contact normals before and after the test, with 1 + a_n cos 2(phi - phi_n)."""
    with rc_context(STYLE):
        figure = Figure(figsize=(60 * len(tests) / INCH, 120 / INCH), layout="constrained")
        for column, (name, test) in enumerate(tests.items()):
            for row, index in enumerate((0, len(test.lists) - 1)):
                axes = figure.add_subplot(2, len(tests), row * len(tests) + column + 1, projection="polar")
                data = read_table(test.lists[index])
                angle = np.arctan2(data["ny"], data["nx"]) % np.pi
                count, edges = np.histogram(angle, bins=18, range=(0, np.pi))
                density = count / count.mean()
                middle = (edges[1:] + edges[:-1]) / 2
                for turn in (0.0, np.pi):
                    axes.bar(
                        middle + turn, density, width=np.pi / 18, color="#7FBFE8", edgecolor="#00508C", linewidth=0.4
                    )
                theta = np.linspace(0, 2 * np.pi, 181)
                a_n, phi_n = test.micro["a_n"][index], np.radians(test.micro["phi_n"][index])
                axes.plot(theta, 1 + a_n * np.cos(2 * (theta - phi_n)), color="#D55E00", linewidth=1.2)
                axes.set_title(f"{METHODS[name]}, {100 * test.strain[index]:.0f} %: a_n = {a_n:.2f}", fontsize=8)
                axes.set(xticklabels=[], yticks=[0.5, 1, 1.5], ylim=(0, 1.9))
                axes.tick_params(labelsize=6)
        figure.savefig(path, dpi=110)


def compare(runs: Path, out: Path) -> str:
    """Table 2, Figures 6 and 8 to 14 and 18 in kind, sin(phi) from anisotropies."""
    tests = {method: read_test(runs, method) for method in METHODS}
    macroscopic(tests, out / "003_macroscopic.png")
    microscopic(tests, out / "003_microscopic.png")
    roses(tests, out / "003_roses.png")
    return table(tests) + "\n\n" + friction_table(tests)
