"""Paper 001: contacts lost and gained in strain probes of two-dimensional isotropic samples.

Runs: every run folder of probe_strain.py that is found, one per sample.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

import hypofab
from hypofab.results import Array, ResultError
from papers import draw, figures_001
from papers.element import fabric_in_space, run_envelopes
from papers.runs import DemRun, file_of, read_dem, read_table

PRESSURE, VOID_RATIO = 100.0, 0.60
"""Of the sand in the element tests [kPa, -]."""


@dataclass(frozen=True)
class Fan:
    """The probes of one sample."""

    run: DemRun
    alpha: Array
    """Directions [deg]."""
    strain: Array
    """Norm of each probe."""
    stress: Array
    """Stress increments along x and y [kPa], shape (probes, 2)."""
    changes: list[hypofab.FabricChange]
    """Of each probe."""
    response: hypofab.FabricResponse
    """Fitted to them."""

    @property
    def coordination(self) -> float:
        """Z of paper 001: trace of F over particles that are no rattlers."""
        fabric = self.changes[0].fabric_before
        return float(fabric[0] + fabric[1])

    @property
    def friction(self) -> float:
        """Friction angle while the sample was prepared [deg]."""
        sample = self.run.parameters["sample_parameters"]
        given = sample["preparation_friction"]
        return sample["friction"] if given is None else given

    @property
    def seed(self) -> int:
        """Of the sample."""
        return self.run.parameters["sample_parameters"]["seed"]

    def rate(self, mechanism: str, which: str) -> Array:
        """dZ* or dA* of a mechanism for each probe."""
        row, column = ("dZ", "dA").index(which), ("loss", "gain", "reorientation").index(mechanism)
        return np.array([change.rates(self.strain.mean())[row, column] for change in self.changes])

    def coefficient(self, mechanism: str, name: str) -> tuple[float, float]:
        """A fitted coefficient and its standard error."""
        entry = getattr(getattr(self.response, mechanism), name)
        return entry.value, entry.error

    def law(self, mechanism: str, which: str, alpha: Array) -> Array:
        """The fitted dZ* or dA* (Eq. 15 with the signs that follow from Eqs. 10 and 11)."""
        b, c, d, e, g = (self.coefficient(mechanism, name)[0] for name in "BCDEG")
        cos, sin = np.cos(np.radians(alpha)), np.sin(np.radians(alpha))
        if which == "dZ":
            return 2 * b + g + (2 * c + e) * (cos + sin) + 2 * (d + g) * cos * sin
        return e * (sin - cos) + g * (sin**2 - cos**2)

    @property
    def linear(self) -> tuple[Array, float]:
        """linear_map of the stress."""
        return linear_map(self.alpha, self.strain, self.stress)


def read_fan(path: Path) -> Fan:
    """Probes of one run folder, compared by their contact lists."""
    run = read_dem(path)
    table = read_table(path, "probes.txt")
    probes = table["alpha"] >= 0
    alpha = table["alpha"][probes]
    strain = np.hypot(table["eps_x"], table["eps_y"])[probes]
    lists = [file_of(path, f"alpha_{angle:05.1f}_contacts.txt") for angle in alpha]
    changes = hypofab.changes(file_of(path, "before_contacts.txt"), lists)
    response = hypofab.fit_fabric_response(alpha, np.array([change.rates(strain.mean()) for change in changes]))
    stress = np.column_stack([table["dsig_x_kPa"], table["dsig_y_kPa"]])[probes]
    return Fan(run, alpha, strain, stress, changes, response)


def linear_map(alpha: Array, strain: Array, stress: Array) -> tuple[Array, float]:
    """The linear map from strain to stress of least squares [kPa], and the error's share of the response.

    alpha: directions [deg]; strain: norm of each probe; stress: increments (probes, 2) [kPa].
    """
    radians = np.radians(alpha)
    probes = np.column_stack([np.cos(radians), np.sin(radians)]) * np.reshape(strain, (-1, 1))
    matrix, *_ = np.linalg.lstsq(probes, stress, rcond=None)
    error = np.linalg.norm(probes @ matrix - stress) / np.linalg.norm(stress)
    return matrix.T, float(error)


@dataclass(frozen=True)
class ElementFan:
    """Strain probes of an element test."""

    title: str
    alpha: Array
    size: float
    stress: Array
    """Stress increments along x and y [kPa], shape (probes, 2)."""

    @property
    def linear(self) -> tuple[Array, float]:
        """linear_map of the stress."""
        return linear_map(self.alpha, np.full(len(self.alpha), self.size), self.stress)


def element_fans(fan: Fan) -> list[ElementFan]:
    """The same probes of a sand with delta from the sample's fabric, smaller ones, and the same without memory."""
    xx, yy, _, xy, _, _ = fan.changes[0].fabric_before / fan.coordination
    fabric = fabric_in_space(xx, yy, xy)
    size = float(fan.strain.mean())
    base = {"material": "sand", "p": PRESSURE, "void_ratio": VOID_RATIO}
    variants = [
        ("fabric", {"fabric": fabric}, size, "delta from fabric"),
        ("zero", {"zero": True}, size, "delta = 0"),
        ("small", {"zero": True}, size / 20, "delta = 0, a twentieth of the size"),
    ]
    plane = {"first": [1, 0, 0, 0, 0, 0], "second": [0, 1, 0, 0, 0, 0]}
    envelopes = [
        {
            "name": name,
            "plane": plane,
            "probes": len(fan.alpha),
            "size": length,
            "series": [{"name": name, "state": name}],
        }
        for name, _, length, _ in variants
    ]
    found = run_envelopes(
        {
            "unit": "kPa",
            "materials": [{"name": "sand", "sand": "paper000"}],
            "states": [base | {"name": name, "delta": delta} for name, delta, _, _ in variants],
            "envelopes": envelopes,
        }
    )
    fans = []
    for name, _, length, title in variants:
        series = found[name].series[0]
        alpha = np.degrees(np.arctan2(series.direction[:, 1], series.direction[:, 0])) % 360
        fans.append(ElementFan(title, alpha, length, length * series.response[:, :2]))
    return fans


def share(counts: Array, zone: Array) -> str:
    """Mean number of changed contacts in a zone, of the largest number in any direction."""
    return f"{counts[zone].mean():.1f} of {counts.max():.0f}" if zone.any() else "no probe there"


def element_table(fans: list[Fan], element: list[ElementFan]) -> str:
    """The linear map from strain to stress and its error, DEM and element tests."""
    rows = []
    for name, (matrix, error) in [(f"DEM, {fan.run.name}", fan.linear) for fan in fans] + [
        (f"element test, {probes.title}", probes.linear) for probes in element
    ]:
        isotropic = (matrix[0, 0] + matrix[1, 1] + matrix[0, 1] + matrix[1, 0]) / 2
        shear = (matrix[0, 0] + matrix[1, 1] - matrix[0, 1] - matrix[1, 0]) / 2
        rows.append([name, f"{isotropic:.0f}", f"{shear:.0f}", f"{isotropic / shear:.2f}", f"{100 * error:.2f} %"])
    head = ["probes", "isotropic stiffness [kPa]", "deviatoric stiffness [kPa]", "their ratio", "error of the map"]
    return draw.table(head, rows)


def summary(fans: list[Fan]) -> str:
    """One row per sample, and the three conditions of incremental linearity."""
    rows, conditions = [], []
    for fan in fans:
        _, error = fan.linear
        table = read_table(fan.run.path, "probes.txt")
        hold = table["alpha"] < 0
        in_gain = (fan.alpha > 18.4) & (fan.alpha < 71.6)
        in_loss = (fan.alpha > 198.4) & (fan.alpha < 251.6)
        gained, lost = table["gained"][~hold], table["lost"][~hold]
        rows.append(
            [
                fan.run.name,
                str(fan.run.results["particles"]),
                f"{fan.coordination:.2f}",
                f"{fan.run.results['void_ratio']:.3f}",
                f"{100 * error:.2f} %",
                share(lost, in_loss),
                share(gained, in_gain),
                f"{int(table['lost'][hold].sum() + table['gained'][hold].sum())}",
            ]
        )

        def number(entry: hypofab.Estimate) -> str:
            return f"{entry.value:.0f} +- {entry.error:.0f}"

        response = fan.response
        conditions.append(
            [
                fan.run.name,
                *(number(entry) for entry in response.linear),
                number(response.loss.dZ_extension),
                number(response.gain.dZ_compression),
                number(response.loss.dZ_shear),
                number(response.gain.dZ_shear),
                f"{response.reorientation.E.value:.2f}",
            ]
        )
    head = ["sample", "N_p", "Z", "e", "stress, error of linear map", "lost in the zone of no loss, of the most"]
    head += ["gained in the zone of no gain, of the most", "changed in a hold"]
    first = draw.table(head, rows)
    head = ["sample", "B^g - B^l", "D^g - D^l", "G^g - G^l + G^r", "loss, extension", "gain, compression"]
    second = draw.table([*head, "loss, shear", "gain, shear", "E^r"], conditions)
    return first + "\n\n" + second


def compare(runs: Path, out: Path) -> str:
    """Figures 2 to 8 and the three conditions (Eq. 18)."""
    folders = sorted(path.parent for path in runs.glob("*/probes.txt*"))
    if not folders:
        raise ResultError(f"{runs}: no run folder of probe_strain.py; examples/dem/README.md says how to make them")
    fans = sorted((read_fan(folder) for folder in folders), key=lambda fan: -fan.coordination)
    element = element_fans(fans[0])
    figures_001.responses(fans, element, out / "001_responses.png")
    figures_001.roses(fans, out / "001_roses.png")
    figures_001.rates(fans, out / "001_rates.png")
    figures_001.trends(fans, out / "001_trends.png")
    return summary(fans) + "\n\n" + element_table(fans, element)
