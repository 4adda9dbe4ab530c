"""Run the scripts of examples/dem in YADE."""

import os
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

SCRIPTS = Path(__file__).parents[2] / "examples" / "dem"

Yade = Callable[..., subprocess.CompletedProcess[str]]


def command(script: str, *arguments: object) -> list[str]:
    """The command line of one script."""
    return ["yade", "-x", "-n", "-j1", str(SCRIPTS / script), *map(str, arguments)]


@pytest.fixture(scope="session")
def yade() -> Yade:
    """Run a script and require success, unless another exit code is expected."""

    def run(script: str, *arguments: object, code: int = 0) -> subprocess.CompletedProcess[str]:
        environment = {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "DISPLAY")}
        words = command(script, *arguments)
        done = subprocess.run(words, capture_output=True, text=True, env=environment, check=False)
        assert done.returncode == code, done.stdout + done.stderr
        return done

    return run


@pytest.fixture(scope="session")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where the samples of this session are kept, so that each is made once."""
    return tmp_path_factory.mktemp("dem")


@pytest.fixture(scope="session")
def sphere_sample(yade: Yade, folder: Path) -> Path:
    """Spheres, compressed with a little lateral strain, then to 100 kPa in all directions."""
    out = folder / "aniso"
    yade("prepare.py", "--out", out, "--particles", 80, "--lateral", 0.4, "--preparation-friction", 5)
    return out


@pytest.fixture(scope="session")
def disc_sample(yade: Yade, folder: Path) -> Path:
    """Discs in a periodic cell."""
    out = folder / "discs"
    discs = ["--dimension", 2, "--diameter", 5, "--spread", 2, "--stiffness", 2e4, "--stiffness-ratio", 1]
    yade("prepare.py", "--out", out, "--particles", 120, "--preparation-friction", 3, "--friction", 26.565, *discs)
    return out


@pytest.fixture(scope="session")
def wall_sample(yade: Yade, folder: Path) -> Path:
    """Discs that fell into a box."""
    out = folder / "deposit"
    options = ["--shape", "disc", "--preparation-friction", 8, "--pressure", 50, "--stiffness", 2e4]
    yade("deposit.py", "--out", out, "--particles", 50, *options)
    return out
