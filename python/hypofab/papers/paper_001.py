"""Paper 001: contacts lost and gained in strain probes of two-dimensional isotropic samples.

Runs: every run folder of probe_strain.py that is found, one per sample.
"""

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hypofab.figures import line_style
from hypofab.papers import draw
from hypofab.papers.program import run_json
from hypofab.papers.runs import DemRun, read_dem, read_table
from hypofab.results import Array, ResultError

MECHANISMS = ("loss", "gain", "reorientation")


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
    changes: dict
    """What `hypofab changes` says."""

    @property
    def coordination(self) -> float:
        """Z of paper 001: trace of F over particles that are no rattlers."""
        fabric = self.changes["fabric_before"]
        return fabric[0] + fabric[1]

    def rate(self, mechanism: str, which: str) -> Array:
        """dZ* or dA* of a mechanism for each probe."""
        return np.array([snapshot[mechanism][which] for snapshot in self.changes["snapshots"]])

    def coefficient(self, mechanism: str, name: str) -> tuple[float, float]:
        """A fitted coefficient and its standard error."""
        entry = self.changes["response"][mechanism][name]
        return entry["value"], entry["error"]


def read_fan(path: Path) -> Fan:
    """Probes of one run folder, compared by `hypofab changes`."""
    run = read_dem(path)
    table = read_table(path / "probes.txt.gz")
    probes = table["alpha"] >= 0
    alpha = table["alpha"][probes]
    strain = np.hypot(table["eps_x"], table["eps_y"])[probes]
    lists = [path / f"alpha_{angle:05.1f}_contacts.txt.gz" for angle in alpha]
    changes = run_json(
        "changes",
        path / "before_contacts.txt.gz",
        *lists,
        "--angles",
        ",".join(f"{angle:g}" for angle in alpha),
        "--strain",
        f"{strain.mean():.9g}",
    )
    stress = np.column_stack([table["dsig_x_kPa"], table["dsig_y_kPa"]])[probes]
    return Fan(run, alpha, strain, stress, changes)


def linear_stiffness(fan: Fan) -> tuple[Array, float]:
    """The linear map from strain to stress of least squares [kPa], and the error's share of the response."""
    radians = np.radians(fan.alpha)
    strain = np.column_stack([np.cos(radians), np.sin(radians)]) * fan.strain[:, None]
    matrix, *_ = np.linalg.lstsq(strain, fan.stress, rcond=None)
    error = np.linalg.norm(strain @ matrix - fan.stress) / np.linalg.norm(fan.stress)
    return matrix.T, float(error)


def law(fan: Fan, mechanism: str, which: str, alpha: Array) -> Array:
    """The fitted dZ* or dA* (Eq. 15 with the signs that follow from Eqs. 10 and 11)."""
    b, c, d, e, g = (fan.coefficient(mechanism, name)[0] for name in "BCDEG")
    cos, sin = np.cos(np.radians(alpha)), np.sin(np.radians(alpha))
    if which == "dZ":
        return 2 * b + g + (2 * c + e) * (cos + sin) + 2 * (d + g) * cos * sin
    return e * (sin - cos) + g * (sin**2 - cos**2)


def responses(fans: list[Fan], path: Path) -> None:
    """Figures 2 and 3: probes, stress responses with the linear map's ellipse, responses of the fabric."""
    with draw.panels(path, 2) as (stress, fabric):
        for index, fan in enumerate(fans):
            style = line_style(index)
            stiffness = fan.run.results["material"]["stiffness"] / 1e3
            matrix, _ = linear_stiffness(fan)
            angle = np.linspace(0, 2 * np.pi, 181)
            ellipse = matrix @ np.stack([np.cos(angle), np.sin(angle)]) * fan.strain.mean() / stiffness
            stress.plot(*ellipse, **(style | {"linewidth": 1.0}))
            stress.plot(
                *(fan.stress.T / stiffness),
                "o",
                markersize=3.5,
                color=style["color"],
                label=f"Z = {fan.coordination:.2f}",
            )
            change = np.array([snapshot["change"][:2] for snapshot in fan.changes["snapshots"]])
            closed = [*range(len(change)), 0]
            fabric.plot(*change[closed].T, marker="o", markersize=3, **style)
        stress.set(xlabel=r"$\Delta\sigma_{xx}/k_n$", ylabel=r"$\Delta\sigma_{yy}/k_n$", title="stress; lines: linear")
        fabric.set(xlabel=r"$\Delta F_{xx}$", ylabel=r"$\Delta F_{yy}$", title="fabric")
        for axes in (stress, fabric):
            axes.set_aspect("equal", adjustable="datalim")
        stress.legend()


def rates(fans: list[Fan], path: Path) -> None:
    """Figures 5 and 6: rates of change over the direction of the probe, with the fitted law."""
    fine = np.linspace(0, 360, 181)
    with draw.panels(path, 3, rows=2, size=(85, 65)) as axes:
        for column, mechanism in enumerate(MECHANISMS):
            for row, which in enumerate(("dZ", "dA")):
                panel = axes[3 * row + column]
                if (mechanism, which) == ("reorientation", "dZ"):
                    panel.set_axis_off()  # zero by definition
                    continue
                for index, fan in enumerate(fans):
                    style = line_style(index)
                    label = f"Z = {fan.coordination:.2f}"
                    panel.plot(
                        fan.alpha, fan.rate(mechanism, which), "o", markersize=3, color=style["color"], label=label
                    )
                    panel.plot(fine, law(fan, mechanism, which, fine), **(style | {"linewidth": 1.0}))
                name = {"dZ": r"$\Delta Z^*$", "dA": r"$\Delta A^*$"}[which]
                panel.set(xlim=(0, 360), xticks=range(0, 361, 90), title=f"{name}, {mechanism}")
                if row == 1:
                    panel.set_xlabel(r"direction $\alpha$ [deg]")
                low, high = {"gain": (18.4, 71.6), "loss": (198.4, 251.6)}.get(mechanism, (0, 0))
                panel.axvspan(low, high, color="0.9")
        axes[0].legend()


def roses(fan: Fan, path: Path) -> None:
    """Figure 4: orientations of lost and gained contacts for five directions, with second-order harmonics (Eq. 5)."""
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    from hypofab.figures import INCH, STYLE

    shown = [45, 90, 135, 180, 225]
    with rc_context(STYLE):
        figure = Figure(figsize=(55 * len(shown) / INCH, 110 / INCH), layout="constrained")
        for column, angle in enumerate(shown):
            snapshot = fan.changes["snapshots"][int(np.argmin(np.abs(fan.alpha - angle)))]
            for row, mechanism in enumerate(("loss", "gain")):
                axes = figure.add_subplot(2, len(shown), row * len(shown) + column + 1, projection="polar")
                rose = snapshot[mechanism]["rose"]
                count = np.array(rose["count"], dtype=float)
                pairs = count.reshape(-1, 4).sum(axis=1)  # bins of 30 degrees: contacts are few
                width = math.pi / len(pairs)
                middle = (np.arange(len(pairs)) + 0.5) * width
                for turn in (0.0, math.pi):
                    axes.bar(middle + turn, pairs, width=width, color="#7FBFE8", edgecolor="#00508C", linewidth=0.4)
                theta = np.linspace(0, 2 * np.pi, 181)
                if rose["contacts"] > 0:
                    law = 1 + rose["anisotropy"] * np.cos(2 * (theta - math.radians(rose["direction"])))
                    axes.plot(theta, np.maximum(0, pairs.mean() * law), color="#D55E00", linewidth=1.2)
                axes.set_title(rf"{mechanism}, $\alpha$ = {angle}$^\circ$: {rose['contacts']}", fontsize=8)
                axes.set_xticklabels([])
                axes.tick_params(labelsize=6)
        figure.savefig(path, dpi=110)


def trends(fans: list[Fan], path: Path) -> None:
    """Figures 7 and 8: characteristic rates and a1 to a5 over Z, with standard errors."""
    z = [fan.coordination for fan in fans]
    with draw.panels(path, 3) as (loss, gain, total):
        for axes, mechanism in ((loss, "loss"), (gain, "gain")):
            for index, name in enumerate(("dZ_extension", "dZ_shear", "dZ_compression", "E", "G")):
                values = [fan.coefficient(mechanism, name) for fan in fans]
                style = {key: line_style(index)[key] for key in ("color", "linestyle")}
                label = name.replace("dZ_", "dZ*, ")
                axes.errorbar(
                    z, [v for v, _ in values], [e for _, e in values], marker="o", capsize=2, label=label, **style
                )
            axes.set_title(mechanism)
        for index in range(5):
            values = [
                (fan.changes["response"]["a"][index]["value"], fan.changes["response"]["a"][index]["error"])
                for fan in fans
            ]
            style = {key: line_style(index)[key] for key in ("color", "linestyle")}
            total.errorbar(
                z, [v for v, _ in values], [e for _, e in values], marker="o", capsize=2, label=f"a{index + 1}", **style
            )
        total.set_title("total, Eq. 19")
        for axes in (loss, gain, total):
            axes.set_xlabel("Z before the probes")
            axes.legend(fontsize=7)


def share(counts: Array, zone: Array) -> str:
    """Mean number of changed contacts in a zone, of the largest number in any direction."""
    return f"{counts[zone].mean():.1f} of {counts.max():.0f}" if zone.any() else "no probe there"


def summary(fans: list[Fan]) -> str:
    """One row per sample, and the three conditions of incremental linearity."""
    rows, conditions = [], []
    for fan in fans:
        _, error = linear_stiffness(fan)
        table = read_table(fan.run.path / "probes.txt.gz")
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

        def number(entry: dict) -> str:
            return f"{entry['value']:.0f} +- {entry['error']:.0f}"

        response = fan.changes["response"]
        conditions.append(
            [
                fan.run.name,
                *(number(entry) for entry in response["linear_if_zero"]),
                number(response["loss"]["dZ_extension"]),
                number(response["gain"]["dZ_compression"]),
                number(response["loss"]["dZ_shear"]),
                number(response["gain"]["dZ_shear"]),
                f"{response['reorientation']['E']['value']:.2f}",
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
    folders = sorted(path.parent for path in runs.glob("*/probes.txt.gz"))
    if not folders:
        raise ResultError(f"{runs}: no run folder of probe_strain.py; examples/dem/README.md says how to make them")
    fans = sorted((read_fan(folder) for folder in folders), key=lambda fan: -fan.coordination)
    responses(fans, out / "001_responses.png")
    roses(fans[0], out / "001_roses.png")
    rates(fans, out / "001_rates.png")
    trends(fans, out / "001_trends.png")
    return summary(fans)
