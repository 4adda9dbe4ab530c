"""Tests of the installed package: scripts/python_package builds and installs it and runs these with its Python."""

import json
import signal
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import hypofab

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "examples" / "papers"))

if Path(hypofab.__file__).is_relative_to(ROOT / "python"):
    pytest.exit("these tests are for the installed package: scripts/python_package", returncode=4)


@pytest.fixture
def interruptible() -> Iterator[None]:
    """Ctrl-C has its meaning for this process and those it starts. A shell starts jobs in the background without."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture(scope="session")
def examples() -> Path:
    """Example decks and samples."""
    return ROOT / "examples"


@pytest.fixture(scope="session")
def reference() -> dict:
    """Rates and strain paths of 40 digits, computed independently."""
    return json.loads((ROOT / "tests" / "data" / "model.json").read_text())


@pytest.fixture(scope="session")
def sand() -> hypofab.Material:
    """A sand with intergranular strain."""
    return hypofab.Material.sand("hochstetten")


@pytest.fixture(scope="session")
def state() -> hypofab.State:
    """A state with stress deviator and intergranular strain."""
    return hypofab.State([-100, -120, -180, 5, -7, 9], 0.7, [2e-5, 1e-5, -4e-5, 0, 1e-5, 0])
