"""The element test driver as a reference for finite element hosts: it repeats the strain of a point of a host.

A host holds the direction of the strain rate within a step, so the strain path of a test that prescribes stresses is a
polygon whose corners the host has found. The driver runs the same polygon by its own integrator (another method, with a
tolerance of 1e-10), one step of strain control per increment.
"""

import csv
import subprocess
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: Names of PROPS(1..16).
PARAMETERS = ("phi_c", "p_t", "h_s", "n", "e_d0", "e_c0", "e_i0", "alpha", "beta")
PARAMETERS += ("m_R", "m_T", "R", "beta_r", "chi", "K_w", "e_0")
AXES = ("xx", "yy", "zz", "xy", "xz", "yz")

#: Corners of the path that the tests of every host follow: direction and axial strain.
PATH = (("compression", -0.005), ("extension", -0.0045), ("compression", -0.0085))


def numbers(values: list[float] | Array) -> str:
    """Numbers as a YAML list that loses no digit."""
    return "[" + ", ".join(repr(float(v)) for v in values) + "]"


@dataclass(repr=False)
class Start:
    """Material and state at the start of a test."""

    props: list[float]  #: PROPS(16) of the UMAT
    stress: list[float]  #: effective stress xx yy zz xy xz yz
    delta: Array  #: tensor components, the same order
    void_ratio: float


def deck(start: Start, steps: list[str]) -> str:
    """The deck of one test named `test`; steps: YAML mappings. The driver knows effective stress only, no K_w."""
    names = zip(PARAMETERS, start.props, strict=True)
    parameters = ", ".join(f"{name}: {float(v)!r}" for name, v in names if name not in ("K_w", "e_0"))
    return "\n".join(
        [
            "materials:",
            f"  - {{name: sand, parameters: {{{parameters}}}}}",
            "states:",
            f"  - {{name: start, material: sand, stress: {numbers(start.stress)}, void_ratio: {start.void_ratio!r},",
            f"     delta: {{components: {numbers(start.delta)}}}}}",
            "tests:",
            "  - name: test",
            "    state: start",
            "    tolerance: 1.0e-10",
            "    steps:",
            *(f"      - {step}" for step in steps),
            "",
        ]
    )


def run_driver(program: Path, folder: Path, text: str) -> dict[str, Array]:
    """Run a deck of one test in a folder; the columns of its result file at the ends of the steps."""
    path = folder / "reference.yaml"
    path.write_text(text)
    subprocess.run([program, "run", path, "-o", folder / "reference"], check=True, stdout=subprocess.DEVNULL)
    with open(folder / "reference" / "test.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    ends = [row for row, after in zip(rows, [*rows[1:], {"step": None}], strict=True) if row["step"] != after["step"]]
    return {name: np.array([float(row[name]) for row in ends]) for name in rows[0]}


def strain_steps(strain: Array) -> list[str]:
    """Steps of a deck that run through strains (one row each, tensor components), starting from zero."""
    steps = []
    for k, increment in enumerate(np.diff(strain, axis=0, prepend=np.zeros((1, 6))), start=1):
        control = ", ".join(f"{axis}: {{strain_rate: {float(v)!r}}}" for axis, v in zip(AXES, increment, strict=True))
        steps.append(f"{{control: {{{control}}}, until: {{quantity: time, value: {k}}}, rows: 1}}")
    return steps


def tensor(columns: dict[str, Array], name: str) -> Array:
    """Six components of a tensor of a result, one row per result row."""
    return np.stack([columns[f"{name}_{axis}"] for axis in AXES], axis=1)


def norm(tensors: Array) -> Array:
    """Frobenius norms of tensors, one row each."""
    return np.sqrt((tensors**2 * [1, 1, 1, 2, 2, 2]).sum(axis=1))


def relative_difference(values: Array, reference: Array) -> float:
    """The largest difference of two histories of a tensor, relative to the reference's norm at the same place."""
    return float((norm(values - reference) / norm(reference)).max())


def preset(loading: str, unloading: str) -> list[str]:
    """Steps of the driver along the path of all hosts by presets along z."""
    names = {"compression": loading, "extension": unloading}
    return [f"{{preset: {names[way]}, axis: z, {until(end)}}}" for way, end in PATH]


def straight(lateral: float) -> list[str]:
    """Steps of the driver along the path of all hosts, with a ratio of lateral to axial strain rate."""
    steps = []
    for way, end in PATH:
        axial = -1.0 if way == "compression" else 1.0
        side = f"{{strain_rate: {lateral * axial}}}"
        steps.append(f"{{control: {{xx: {side}, yy: {side}, zz: {{strain_rate: {axial}}}}}, {until(end)}}}")
    return steps


def until(axial_strain: float) -> str:
    """The end of a step of the driver, without rows in between."""
    return f"until: {{quantity: eps_zz, value: {axial_strain}}}, rows: 1"


def effective_stress(stress: Array, statev: Array) -> Array:
    """STRESS of the UMAT plus the pore pressure in STATEV(8)."""
    return stress + statev[:, 7:8] * [1, 1, 1, 0, 0, 0]


def differences_on_host_strain(
    program: Path, folder: Path, start: Start, strain: Array, stress: Array, statev: Array
) -> tuple[float, float, float]:
    """The largest differences from the driver on the host's strain path: of stress, delta (over R) and void ratio.

    strain, stress: tensor components xx yy zz xy xz yz; statev: STATEV(1..13); one row per step of the host.
    """
    reference = run_driver(program, folder, deck(start, strain_steps(strain)))
    assert len(reference["time"]) == len(strain)
    differences = (
        relative_difference(effective_stress(stress, statev), tensor(reference, "sig")),
        float(norm(statev[:, :6] * [1, 1, 1, 0.5, 0.5, 0.5] - tensor(reference, "delta")).max() / start.props[11]),
        float(np.abs(statev[:, 6] - reference["void_ratio"]).max()),
    )
    print("differences from the driver: stress {:.1e}, delta {:.1e} R, void ratio {:.1e}".format(*differences))
    return differences


def differences_from_path(
    program: Path, folder: Path, start: Start, steps: list[str], strain: Array, stress: Array, statev: Array
) -> float:
    """The largest relative difference of effective stress from a test that the driver controls itself.

    Arguments as of differences_on_host_strain, with the rows at the corners of the path alone.
    """
    assert np.allclose(strain[:, 2], [end for _, end in PATH])
    reference = run_driver(program, folder, deck(start, steps))
    difference = relative_difference(effective_stress(stress, statev), tensor(reference, "sig"))
    print(f"difference from the driver's own test: {difference:.1e}")
    return difference


def check_beyond_zero_stress(axial_strain: Array, stress: Array, mark: Array) -> None:
    """An oedometer extended by 1 % and compressed again, from 100 kPa: the host goes on at zero stress and back.

    mark: STATEV(13), negative where the stress is at or beyond zero.
    """
    beyond = axial_strain > 0.7 * axial_strain.max()
    print(f"largest stress beyond zero: {np.abs(stress[beyond]).max():.1e} kPa")
    assert np.isfinite(stress).all()
    assert np.abs(stress[beyond]).max() < 1e-2
    assert np.all(mark[beyond] < 0)
    assert mark[-1] > 0
    assert np.all(stress[-1, :3] < -20)
    # The grains meet again where they parted.
    peak = int(axial_strain.argmax())
    parted, met = (
        float(np.interp(1.0, -part, strain))
        for part, strain in (
            (stress[peak::-1, 2], axial_strain[peak::-1]),
            (stress[peak:, 2], axial_strain[peak:]),
        )
    )
    assert abs(parted - met) < 2e-3
