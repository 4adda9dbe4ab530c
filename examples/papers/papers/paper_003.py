"""Paper 003: two-dimensional samples made in three ways, and their biaxial tests.

Runs: samples of deposit.py under the names of the paper's Table 2 without "TS-" (`D03`: deposition under gravity,
`M09`: layers, `I13`: isotropic), and `bi_` with the same name: load.py with contact lists at some strains. The six
tests of the paper's Figures 6 and 7 must be there, the others may be missing.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hypofab.results import Array, ResultError, TestResult
from papers import draw, figures_003
from papers.describe import describe_plane
from papers.element import fabric_in_space, run_deck
from papers.runs import Curve, DemRun, file_of, read_curve, read_dem

METHODS = {"D": "deposition", "M": "layers", "I": "isotropic"}
"""How a sample is made, by the first letter of its name."""
TABLE_2 = {
    "D01": (0.206, 4.64, 0.167),
    "D02": (0.260, 3.81, 0.022),
    "D03": (0.203, 4.81, 0.159),
    "D04": (0.179, 5.27, 0.184),
    "D05": (0.202, 4.89, 0.158),
    "M06": (0.206, 4.13, 0.215),
    "M07": (0.227, 3.83, 0.210),
    "M08": (0.226, 3.91, 0.196),
    "M09": (0.203, 4.41, 0.205),
    "M10": (0.201, 4.56, 0.201),
    "I11": (0.237, 3.82, 0.034),
    "I12": (0.166, 5.16, 0.038),
    "I13": (0.203, 4.35, 0.041),
    "I14": (0.200, 4.49, 0.040),
}
"""The paper's samples: e0, coordination number, a_n."""
GROUPS = {"500 kPa, e about .20": ("D03", "M09", "I13"), "200 kPa, CN about 3.8": ("D02", "M07", "I11")}
"""The tests of the paper's Figures 6 and 7."""
VOID_RATIO = {500: 0.62, 200: 0.80}
"""Of the sand in the element tests of the two groups: dense and loose of critical at their pressures."""
MIDDLE, LATE = 0.05, 0.8
"""Axial strain up to which a peak is looked for; share of the test after which it is at its end."""


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
    def method(self) -> str:
        """How the sample was made."""
        return METHODS[self.sample.name[0]]

    @property
    def pressure(self) -> float:
        """Confining stress [kPa]."""
        return float(self.sample.parameters["pressure"])

    @property
    def p(self) -> Array:
        """Mean stress (s1 + s3)/2 [kPa]."""
        return -self.curve.stress[:, :2].mean(axis=1)

    def every(self, step: float = 0.004) -> tuple[Array, Array, Array]:
        """Axial strain, q/p and dilatancy d eps_v/d eps_1 (dilation positive), averaged over steps of strain."""
        edges = np.arange(0, self.curve.axial[-1], step)
        middle = (edges[1:] + edges[:-1]) / 2
        volume = np.interp(edges, self.curve.axial, self.curve.eps_v)
        ratio = self.curve.q / self.p
        inside = np.digitize(self.curve.axial, edges)
        mean = np.array([ratio[inside == k].mean() if np.any(inside == k) else np.nan for k in range(1, len(edges))])
        return middle, mean, np.diff(volume) / step

    def peak(self) -> tuple[float, float]:
        """Largest q/p and largest dilatancy, averaged over steps of 1 % of strain."""
        _, ratio, dilatancy = self.every(0.01)
        return float(np.nanmax(ratio)), float(np.nanmax(dilatancy))

    def late(self, values: Array) -> float:
        """Mean of a column of the curve over the last fifth of the test."""
        return float(values[self.curve.axial > LATE * self.curve.axial[-1]].mean())

    @property
    def critical(self) -> float:
        """Mean q/p at the end."""
        return self.late(self.curve.q / self.p)


def read_test(runs: Path, name: str) -> Test:
    """One sample and its biaxial test."""
    folder = runs / f"bi_{name}"
    loaded = read_dem(folder)
    taken = loaded.results["notes"]["snapshots"]
    lists = [file_of(folder, f"{entry['name']}_contacts.txt") for entry in taken]
    axis = "xyz".index(loaded.parameters["axis"])
    strain = np.array([-entry["strain"][axis] for entry in taken])
    return Test(read_dem(runs / name), read_curve(folder), strain, describe_plane(lists, loaded.friction), lists)


def element_tests(tests: dict[str, Test]) -> dict[str, TestResult]:
    """Biaxial element tests in plane strain, with delta from the samples' fabric; compression positive."""
    states, steps = [], []
    for name, test in tests.items():
        a_n, phi = test.micro["a_n"][0], np.radians(test.micro["phi_n"][0])
        turn, shear = a_n / 4 * np.cos(2 * phi), a_n / 4 * np.sin(2 * phi)
        states.append(
            {
                "name": name,
                "material": "sand",
                "p": test.pressure,
                "void_ratio": VOID_RATIO[round(test.pressure)],
                "delta": {"fabric": fabric_in_space(0.5 + turn, 0.5 - turn, shear)},
            }
        )
        step = {"preset": "drained_biaxial_compression", "axis": "y", "normal": "z"}
        small = {"until": {"quantity": "eps_yy", "value": 0.002}, "rows": 100}
        large = {"until": {"quantity": "eps_yy", "value": 0.15}, "rows": 200}
        steps.append({"name": name, "state": name, "steps": [step | small, step | large]})
    deck = {
        "unit": "kPa",
        "sign": "compression_positive",
        "materials": [{"name": "sand", "sand": "paper000"}],
        "states": states,
        "tests": steps,
    }
    return run_deck(deck, may_stop=True)


def plane_measures(test: TestResult) -> tuple[Array, Array, Array]:
    """Axial strain, q/p of the plane and volumetric strain (dilation positive) of an element test."""
    axial, lateral = test.stress[:, 1], test.stress[:, 0]
    return test.strain[:, 1], 2 * (axial - lateral) / (axial + lateral), -test.eps_v


def table(tests: dict[str, Test]) -> str:
    """Table 2 and what the tests show: peaks and ends."""
    rows = []
    for name, test in tests.items():
        r = test.sample.results
        paper = TABLE_2[name]
        ratio, dilatancy = test.peak()
        rows.append(
            [
                name,
                test.method,
                f"{test.pressure:.0f}",
                str(r["contacts"]),
                f"{r['void_ratio']:.3f} ({paper[0]:.3f})",
                f"{r['mechanical_coordination_number']:.2f} ({paper[1]:.2f})",
                f"{r['anisotropy']:.3f} ({paper[2]:.3f})",
                f"{ratio:.2f}",
                f"{dilatancy:.2f}",
                f"{test.critical:.2f}",
                f"{np.degrees(np.arcsin(test.critical / 2)):.1f}",
                f"{test.late(test.curve.void_ratio):.3f}",
            ]
        )
    head = ["test", "sample", "p_0 [kPa]", "contacts", "e (paper)", "mechanical CN (paper)", "a_n (paper)", "peak q/p"]
    head += ["peak dilatancy", "q/p at the end", "phi at the end [deg]", "e at the end"]
    return draw.table(head, rows)


def friction_table(tests: dict[str, Test], at: tuple[float, ...] = (0.01, 0.05, 0.15)) -> str:
    """sin(phi) by Eqs. 8 and 9 against that of the stresses from contacts and from walls, at some strains."""
    rows = []
    for name, test in tests.items():
        walls = np.interp(test.strain, test.curve.axial, test.curve.q / test.p / 2)
        for wanted in at:
            index = int(np.argmin(np.abs(test.strain - wanted)))
            micro = {key: values[index] for key, values in test.micro.items()}
            sum_of_three = micro["a_n"] + micro["a_f"] + micro["a_t"]
            rows.append(
                [
                    name,
                    f"{100 * test.strain[index]:.1f}",
                    *(f"{micro[key]:.3f}" for key in ("a_n", "a_f", "a_t")),
                    " : ".join(f"{100 * micro[key] / sum_of_three:.0f}" for key in ("a_n", "a_f", "a_t")),
                    f"{micro['sin_phi_from_anisotropies']:.3f}",
                    f"{sum_of_three / 2:.3f}",
                    f"{micro['sin_phi']:.3f}",
                    f"{walls[index]:.3f}",
                    f"{micro['sliding_ratio']:.3f}",
                ]
            )
    head = ["test", "strain [%]", "a_n", "a_f", "a_t", "their shares", "sin phi, Eq. 8", "Eq. 9", "of contacts"]
    return draw.table([*head, "of walls", "sliding"], rows)


def statistics(tests: dict[str, Test]) -> str:
    """How well Eq. 8 does, what peaks go with, and how narrow the critical state is, over all tests."""
    loaded = {name: test.strain > 0.004 for name, test in tests.items()}
    eq8 = np.concatenate([t.micro["sin_phi_from_anisotropies"][loaded[n]] for n, t in tests.items()])
    contacts = np.concatenate([t.micro["sin_phi"][loaded[n]] for n, t in tests.items()])
    walls = np.concatenate(
        [np.interp(t.strain, t.curve.axial, t.curve.q / t.p / 2)[loaded[n]] for n, t in tests.items()]
    )
    a_n = np.array([test.sample.results["anisotropy"] for test in tests.values()])
    e = np.array([test.sample.results["void_ratio"] for test in tests.values()])
    peaks = np.array([test.peak() for test in tests.values()])
    ends = np.array([test.critical for test in tests.values()])
    p = np.array([test.late(test.p) for test in tests.values()])
    e_end = np.array([test.late(test.curve.void_ratio) for test in tests.values()])
    slope, intercept = np.polyfit(np.log10(p), e_end, 1)
    scatter = float(np.std(e_end - slope * np.log10(p) - intercept, ddof=2))
    shares = np.array([[test.micro[key][-1] for key in ("a_n", "a_f", "a_t")] for test in tests.values()]).mean(axis=0)

    def correlation(x: Array, y: Array) -> str:
        return f"{np.corrcoef(x, y)[0, 1]:+.2f}"

    def partial(x: Array, y: Array, given: Array) -> str:
        """Correlation of what is left of x and y when a straight line over `given` is taken off."""
        rest = [v - np.polyval(np.polyfit(given, v, 1), given) for v in (x, y)]
        return correlation(*rest)

    error = [f"{np.mean(eq8 - other):+.3f} +- {np.std(eq8 - other):.3f}" for other in (contacts, walls)]
    lines = [
        f"{len(tests)} tests. sin(phi) of Eq. 8 less that of contact forces {error[0]}, less that of walls {error[1]}.",
        f"Correlation with e: of the peak q/p {correlation(e, peaks[:, 0])}, of the peak dilatancy"
        f" {correlation(e, peaks[:, 1])}. With a_n: {correlation(a_n, peaks[:, 0])} and"
        f" {correlation(a_n, peaks[:, 1])}; of what e leaves of both: {partial(a_n, peaks[:, 0], e)} and"
        f" {partial(a_n, peaks[:, 1], e)}.",
        f"At the end: q/p {ends.mean():.2f} +- {ends.std(ddof=1):.2f}; e = {intercept:.3f} {slope:+.4f} log10(p'/kPa),"
        f" scatter {scatter:.4f}. Spread of e at the beginning {e.std(ddof=1):.4f}, at the end"
        f" {e_end.std(ddof=1):.4f}. a_n : a_f : a_t = {' : '.join(f'{100 * x / shares.sum():.0f}' for x in shares)}"
        " (paper 45 : 38 : 17).",
    ]
    return "\n\n".join(lines)


def element_table(tests: dict[str, Test], element: dict[str, TestResult]) -> str:
    """Stiffness at small strain, peak and end, DEM and element test side by side."""
    rows = []
    for name, test in tests.items():
        axial, ratio, volume = plane_measures(element[name])
        small = 1e-3
        dem_small = float(np.interp(small, test.curve.axial, test.curve.q / test.p))
        slope = np.gradient(volume, axial)
        rows.append(
            [
                name,
                f"{test.sample.results['anisotropy']:.3f}",
                f"{dem_small:.3f}",
                f"{np.interp(small, axial, ratio):.3f}",
                f"{test.peak()[0]:.2f}",
                f"{ratio.max():.2f}",
                f"{test.peak()[1]:.2f}",
                f"{slope[axial > 0.002].max():.2f}",
                f"{test.critical:.2f}",
                f"{ratio[-1]:.2f}",
            ]
        )
    head = ["test", "a_n", "q/p at 0.1 %, DEM", "element", "peak q/p, DEM", "element", "peak dilatancy, DEM", "element"]
    return draw.table([*head, "q/p at the end, DEM", "element"], rows)


def compare(runs: Path, out: Path) -> str:
    """Table 2, Figures 6 to 15, 18 (sliding) and 19 in kind, sin(phi) from anisotropies, element tests."""
    tests = {name: read_test(runs, name) for name in TABLE_2 if (runs / f"bi_{name}" / "manifest.json").exists()}
    groups = {title: {name: tests[name] for name in names if name in tests} for title, names in GROUPS.items()}
    missing = [name for names in GROUPS.values() for name in names if name not in tests]
    if missing:
        raise ResultError(f"{runs}: no run bi_{missing[0]}; examples/dem/README.md says how to make it")
    shown = {name: test for group in groups.values() for name, test in group.items()}
    element = element_tests(shown)
    figures_003.macroscopic(groups, out / "003_macroscopic.png")
    figures_003.peaks(tests, out / "003_peaks.png")
    figures_003.microscopic(groups, out / "003_microscopic.png")
    figures_003.shares(tests["I12"] if "I12" in tests else tests["I13"], shown, out / "003_friction.png")
    figures_003.roses(groups["200 kPa, CN about 3.8"], out / "003_roses.png")
    figures_003.critical(tests, out / "003_critical.png")
    figures_003.elements(groups, {n: plane_measures(t) for n, t in element.items()}, out / "003_element.png")
    return "\n\n".join([table(tests), statistics(tests), friction_table(shown), element_table(shown, element)])
