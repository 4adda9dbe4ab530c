"""Synthetic result files with known numbers, in the layout of `hypofab run` and `hypofab envelope`."""

import csv
import json
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import pytest

from hypofab.results import COMPONENTS

ROWS = 41
LAST_EPS_Q = 2e-3
"""The synthetic tests run to eps_q = 0.2 %, with the end of their first step in the middle."""


def write_csv(path: Path, columns: Mapping[str, Sequence]) -> None:
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(columns)
        writer.writerows(zip(*columns.values(), strict=True))


def columns_of_test(stiffness: float) -> dict[str, np.ndarray]:
    """Rows of a linear test with q = stiffness eps_q; tensor number i is 10 i + component index in every row."""
    eps_q = np.linspace(0, LAST_EPS_Q, ROWS)
    columns = {"time": eps_q, "step": 1 + (np.arange(ROWS) > ROWS // 2)}
    for number, prefix in enumerate(("eps", "sig", "delta"), start=1):
        for index, component in enumerate(COMPONENTS):
            columns[f"{prefix}_{component}"] = np.full(ROWS, 10.0 * number + index)
    scalars = {"void_ratio": 0.6, "p": 100.0, "q": stiffness * eps_q, "eps_v": -0.25 * eps_q, "eps_q": eps_q}
    scalars |= {"rho": 1.0, "phi_mob": 0.0, "q_signed": -stiffness * eps_q}
    return columns | {name: np.broadcast_to(value, ROWS) for name, value in scalars.items()}


def write_summary(directory: Path, tests: list[dict], unit: str = "kPa", sign: str = "tension_positive") -> None:
    summary = {"unit": unit, "sign": sign, "tests": tests}
    (directory / "summary.json").write_text(json.dumps(summary))


@pytest.fixture
def run_directory(tmp_path: Path) -> Path:
    """Results of a run with the tests "stiff" (40 MPa) and "soft" (10 MPa)."""
    stiffness = {"stiff": 40e3, "soft": 10e3}
    for name, value in stiffness.items():
        write_csv(tmp_path / f"{name}.csv", columns_of_test(value))
    tests = [
        {"name": name, "file": f"{name}.csv", "steps": [{"reached": True, "secant_stiffness": value}] * 2}
        for name, value in stiffness.items()
    ]
    write_summary(tmp_path, tests)
    return tmp_path


@pytest.fixture
def envelope_file(tmp_path: Path) -> Path:
    """Two circles: "inner" (radius 10 MPa, no delta) and "outer" (30 MPa, delta along the axis), angles descending."""
    angle = np.arange(350, -10, -10)
    rows: dict[str, list] = {
        name: [] for name in ("series", "angle", "response_axial", "response_lateral", "delta_axial", "delta_lateral")
    }
    for name, radius, delta in (("inner", 10e3, 0.0), ("outer", 30e3, -1.0)):
        rows["series"] += [name] * len(angle)
        rows["angle"] += list(angle)
        rows["response_axial"] += list(radius * np.cos(np.radians(angle)))
        rows["response_lateral"] += list(radius * np.sin(np.radians(angle)))
        rows["delta_axial"] += [delta] * len(angle)
        rows["delta_lateral"] += [0.0] * len(angle)
    path = tmp_path / "circles.csv"
    write_csv(path, rows)
    return path
