"""Read the folders that the scripts of examples/dem write, and the packed files that `keep` makes of them."""

import gzip
import json
import tarfile
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hypofab.results import Array, ResultError


@contextmanager
def run_folders(runs: Path) -> Iterator[Path]:
    """The folder that holds run folders: `runs` itself, or what the packed file `runs` holds, while the block lasts."""
    if runs.is_dir():
        yield runs
        return
    with tempfile.TemporaryDirectory() as folder:
        try:
            with tarfile.open(runs) as packed:
                # As extractall(filter="data"), which Python 3.11 learned late in its life.
                packed.extraction_filter = getattr(tarfile, "data_filter", lambda member, path: member)
                packed.extractall(folder)
        except (OSError, tarfile.TarError) as error:
            raise ResultError(f"{runs}: {error}; examples/dem/README.md says how to make runs") from error
        yield Path(folder)


def file_of(folder: Path, name: str) -> Path:
    """A text file of a run folder: plain, as unpacked, or with .gz behind its name, as the scripts write it."""
    plain = folder / name
    return plain if plain.exists() else folder / f"{name}.gz"


@dataclass(frozen=True)
class DemRun:
    """One run folder."""

    path: Path
    parameters: dict
    results: dict

    @property
    def name(self) -> str:
        """Name of the folder."""
        return self.path.name

    @property
    def contacts(self) -> Path:
        """The contact list of a sample."""
        return file_of(self.path, "sample_contacts.txt")

    @property
    def particles(self) -> Path:
        """The particle list of a sample."""
        return file_of(self.path, "sample_particles.txt")

    @property
    def friction(self) -> float:
        """Friction angle between particles [deg]."""
        return self.results["material"]["friction"]


def read_dem(path: Path) -> DemRun:
    """The manifest of a finished run; ResultError when there is none."""
    file = path / "manifest.json"
    try:
        manifest = json.loads(file.read_text(encoding="utf-8"))
    except OSError as error:
        raise ResultError(f"{file}: {error.strerror}; examples/dem/README.md says how to make it") from error
    except json.JSONDecodeError as error:
        raise ResultError(f"{file}: {error}") from error
    if not manifest.get("finished"):
        raise ResultError(f"{path}: this run has not finished; start its script again to continue it")
    return DemRun(path, manifest["parameters"], manifest["results"])


def read_table(folder: Path, name: str) -> dict[str, Array]:
    """Columns by name of a text table of a run: lines with # in front, the last of which names the columns."""
    path = file_of(folder, name)
    try:
        data = path.read_bytes()
        lines = (gzip.decompress(data) if path.suffix == ".gz" else data).decode().splitlines()
    except OSError as error:
        raise ResultError(f"{path}: {error.strerror}") from error
    head = [line for line in lines if line.startswith("#")]
    rows = [line.split() for line in lines if line and not line.startswith("#")]
    if not head or not rows:
        raise ResultError(
            f"{path}: expected comment lines, the last with the names of the columns, and at least one row"
        )
    names = head[-1].lstrip("# ").split()
    if any(len(row) != len(names) for row in rows):
        raise ResultError(f"{path}: a row has not {len(names)} columns, as its header has")
    try:
        numbers = np.array(rows, dtype=np.float64)
    except ValueError as error:
        raise ResultError(f"{path}: {error}") from error
    return {name: numbers[:, index] for index, name in enumerate(names)}


@dataclass(frozen=True)
class Curve:
    """A loading test: deviatoric stress [kPa] and strains, from the sample's state on. Tension positive."""

    name: str
    axial: Array
    """Axial compression."""
    stress: Array
    """Normal stresses [kPa], shape (rows, 3)."""
    q: Array
    eps_q: Array
    eps_v: Array
    void_ratio: Array

    def secant(self, eps_q: float) -> float:
        """Secant stiffness q/eps_q [kPa] (paper 000, Eq. 8); NaN where the test does not reach it."""
        if self.eps_q[-1] < eps_q:
            return float("nan")
        return float((np.interp(eps_q, self.eps_q, self.q) - self.q[0]) / eps_q)


def read_curve(path: Path) -> Curve:
    """History of a run of load.py; q and eps_q in the measures of von Mises, in two dimensions the differences."""
    run = read_dem(path)
    columns = read_table(path, "history.txt")
    strain = np.column_stack([columns[f"eps_{axis}"] for axis in "xyz"])
    stress = np.column_stack([columns[f"sig_{axis}_kPa"] for axis in "xyz"])
    axis = "xyz".index(run.parameters["axis"])
    if run.results["material"]["dimension"] == 2:
        lateral = 1 - axis
        q = stress[:, lateral] - stress[:, axis]
        eps_q = strain[:, lateral] - strain[:, axis]
    else:
        deviator = stress - stress.mean(axis=1, keepdims=True)
        strain_deviator = strain - strain.mean(axis=1, keepdims=True)
        q = np.sqrt(1.5 * np.sum(deviator**2, axis=1))
        eps_q = np.sqrt(2 / 3 * np.sum(strain_deviator**2, axis=1))
    return Curve(path.name, -strain[:, axis], stress, q, eps_q, strain.sum(axis=1), columns["void_ratio"])
