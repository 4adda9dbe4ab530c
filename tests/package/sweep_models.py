"""What the tests of sweeps run: a deck, and functions that other processes can import."""

import math
import os
import signal
import time
from collections.abc import Mapping
from typing import Any

import numpy as np

import hypofab


def deck(**state: Any) -> dict[str, Any]:  # noqa: ANN401 - parts of a deck
    """A short drained triaxial test; state: keys to add to its state."""
    start = {"name": "start", "material": "sand", "p": 100, "void_ratio": 0.7, "delta": {"zero": True}}
    step = {
        "preset": "drained_triaxial_compression",
        "axis": "z",
        "until": {"quantity": "eps_zz", "value": -0.02},
        "rows": 20,
    }
    return {
        "materials": [{"name": "sand", "sand": "hochstetten"}],
        "states": [start | state],
        "tests": [{"name": "drained", "state": "start", "steps": [step]}],
    }


INPUTS = {
    "e": {"path": "states[start].void_ratio", "uniform": [0.6, 0.9]},
    "phi": {"path": "materials[sand].parameters.phi_c", "uniform": [30, 36]},
}
OUTPUTS = {
    "q": {"quantity": "q"},
    "curve": {"quantity": "q", "over": "eps_zz", "to": -0.02, "points": 5},
}


def product(point: Mapping[str, float]) -> float:
    """Of the inputs x and y."""
    return point["x"] * point["y"]


def end_pressure(points: Mapping[str, np.ndarray]) -> np.ndarray:
    """Of many states after one increment, by the batch; refuses all when one has e = 0.7123."""
    if (points["e"] == 0.7123).any():
        raise ValueError("not this one")
    stress = np.outer(points["p"], [-1, -1, -1, 0, 0, 0])
    end = hypofab.update_many(hypofab.Material.sand("hochstetten"), stress, points["e"], [0, 0, -1e-4, 0, 0, 0])
    return -end.stress[:, :3].mean(axis=1)


def slow(point: Mapping[str, float]) -> float:
    """Two hundredths of a second."""
    time.sleep(0.02)
    return point["x"] ** 2


def fragile(point: Mapping[str, float]) -> float:
    """Fails in three ways."""
    if point["x"] == 3:
        raise ValueError("three is too many")
    if point["x"] == 5:
        os.kill(os.getpid(), signal.SIGKILL)
    if point["x"] == 7:
        return math.nan
    return point["x"]


def ishigami(point: Mapping[str, float]) -> float:
    """Ishigami and Homma (1990) with a = 7, b = 0.1."""
    x, y, z = point["x"], point["y"], point["z"]
    return math.sin(x) + 7 * math.sin(y) ** 2 + 0.1 * z**4 * math.sin(x)


def linear(point: Mapping[str, float]) -> tuple[float, float]:
    """A sum with weights 1, 2, 3, and a constant."""
    return point["x"] + 2 * point["y"] + 3 * point["z"], 5.0
