"""The element test driver as a reference for finite element hosts: it repeats the strain of a point of a host.

A host holds the direction of the strain rate within a step, so the strain path of a test that prescribes stresses is a
polygon whose corners the host has found. The driver runs the same polygon by its own integrator (another method, with a
tolerance of 1e-10), one step of strain control per increment.
"""

import csv
import subprocess
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: Names of PROPS(1..16).
PARAMETERS = ("phi_c", "p_t", "h_s", "n", "e_d0", "e_c0", "e_i0", "alpha", "beta")
PARAMETERS += ("m_R", "m_T", "R", "beta_r", "chi", "K_w", "e_0")
AXES = ("xx", "yy", "zz", "xy", "xz", "yz")


def numbers(values: list[float] | Array) -> str:
    """Numbers as a YAML list that loses no digit."""
    return "[" + ", ".join(repr(float(v)) for v in values) + "]"


def deck(props: list[float], stress: list[float], delta: Array, void_ratio: float, steps: list[str]) -> str:
    """The deck of one test named `test`.

    props: PROPS(16) of the UMAT; stress: effective stress [kPa] and delta: tensor components, xx yy zz xy xz yz; steps:
    YAML mappings. K_w is left out: the driver knows effective stress only.
    """
    parameters = ", ".join(
        f"{k}: {float(v)!r}" for k, v in zip(PARAMETERS, props, strict=True) if k not in ("K_w", "e_0")
    )
    return "\n".join(
        [
            "materials:",
            f"  - {{name: sand, parameters: {{{parameters}}}}}",
            "states:",
            f"  - {{name: start, material: sand, stress: {numbers(stress)}, void_ratio: {void_ratio!r},",
            f"     delta: {{components: {numbers(delta)}}}}}",
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
    """Run a deck of one test in a folder; the columns of its result file."""
    path = folder / "reference.yaml"
    path.write_text(text)
    subprocess.run([program, "run", path, "-o", folder / "reference"], check=True, stdout=subprocess.DEVNULL)
    with open(folder / "reference" / "test.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def strain_steps(strain: Array) -> list[str]:
    """Steps of a deck that run through strains (one row each, tensor components), starting from zero."""
    steps = []
    for k, increment in enumerate(np.diff(strain, axis=0, prepend=np.zeros((1, 6))), start=1):
        control = ", ".join(f"{axis}: {{strain_rate: {float(v)!r}}}" for axis, v in zip(AXES, increment, strict=True))
        steps.append(f"{{control: {{{control}}}, until: {{quantity: time, value: {k}}}, rows: 1}}")
    return steps


def ends_of_steps(columns: dict[str, Array]) -> Array:
    """Indices of the last rows of the steps of a result."""
    step = columns["step"]
    return np.flatnonzero(np.append(step[1:] != step[:-1], True))


def tensor(columns: dict[str, Array], name: str) -> Array:
    """Six components of a tensor of a result, one row per result row."""
    return np.stack([columns[f"{name}_{axis}"] for axis in AXES], axis=1)


def norm(tensors: Array) -> Array:
    """Frobenius norms of tensors, one row each."""
    return np.sqrt((tensors**2 * [1, 1, 1, 2, 2, 2]).sum(axis=1))


def relative_difference(values: Array, reference: Array) -> float:
    """The largest difference of two histories of a tensor, relative to the reference's norm at the same place."""
    return float((norm(values - reference) / norm(reference)).max())
