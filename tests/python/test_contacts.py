"""Descriptors and delta from Python: files and arrays, in space and in the plane, and what is refused."""

import math
import os
from pathlib import Path

import numpy as np
import pytest

from hypofab.contacts import delta, describe, series
from hypofab.results import ResultError

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = Path(os.environ.get("HYPOFAB_PROGRAM", ROOT / "build" / "cli" / "hypofab"))
DATA = ROOT / "examples" / "data"

pytestmark = pytest.mark.skipif(not PROGRAM.exists(), reason=f"no program {PROGRAM}")


def test_file_with_options() -> None:
    found = describe(
        DATA / "iso_3000_contacts.txt.gz", particles=DATA / "iso_3000_particles.txt.gz", friction_angle=30, bins=36
    )
    assert found["harmonics"]["bins"] == 36
    assert found["particles"] == 3000
    assert found["networks"]["sliding"]["fraction"] > 0


def test_arrays_in_the_plane() -> None:
    """Paper 003's densities on equally spaced directions: they come back, with the friction of Eq. 8 for a_n = 0."""
    phi = 2 * np.pi * (np.arange(3600) + 0.5) / 3600
    normal = np.stack([np.cos(phi), np.sin(phi)], axis=1)
    force = 2 * (1 + 0.3 * np.cos(2 * (phi - 1)))
    shear = -2 * 0.1 * np.sin(2 * (phi - 1))[:, None] * np.stack([-np.sin(phi), np.cos(phi)], axis=1)
    arrays = {"normal": normal, "branch": normal, "normal_force": force, "shear_force": shear}
    found = describe(arrays, plane=True, volume=10.0, duplicates="keep")
    forces = found["forces"]["from_moments"]
    assert forces["a_f"] == pytest.approx(0.3, abs=1e-12)
    assert forces["a_t"] == pytest.approx(0.1, abs=1e-12)
    assert forces["phi_f"] == pytest.approx(math.degrees(1), abs=1e-9)
    assert forces["sin_phi"] == pytest.approx(0.2, abs=1e-12)
    assert found["stress"]["sin_phi"] == pytest.approx(0.2, abs=1e-12)
    assert len(found["component_order"]) == 3


def test_delta_of_arrays() -> None:
    """All contacts along y."""
    found = delta({"normal": np.tile([0.0, 1.0, 0.0], (5, 1))}, c=0.05, R=1e-4, weight="exponential")
    assert found["anisotropy"] == pytest.approx(7.5)
    assert found["delta"] == pytest.approx(np.array([-1, 2, -1, 0, 0, 0]) * 1e-4 / math.sqrt(6), abs=1e-12)


def test_archive_of_arrays(tmp_path: Path) -> None:
    """A file that the program does not read itself gives what its arrays give."""
    normal = np.array([[1.0, 0, 0], [0, 0.6, 0.8], [0, 1, 0]])
    np.savez(tmp_path / "contacts.npz", normal=normal)
    found = describe(tmp_path / "contacts.npz")
    assert found["fabric"] == describe({"normal": normal})["fabric"]
    assert found["contacts"] == 3


def test_ids_and_series(tmp_path: Path) -> None:
    found = describe({"id1": [0, 1], "id2": [1, 2], "normal": [[1, 0, 0], [0, 0, 1]]}, particles=4)
    assert found["coordination_number"] == 1
    assert found["sample"]["rattlers"] == 3
    for name, rows in (("a", "1 0 0\n0 1 0\n"), ("b", "1 0 0\n1 0 0\n")):
        (tmp_path / f"{name}.txt").write_text("nx ny nz\n" + rows)
    table = series([tmp_path / "a.txt", tmp_path / "b.txt"], plane=True)
    assert table["deviator_fabric"] == pytest.approx([0, 1])
    assert np.isnan(table["a_f"]).all()


def test_refusals() -> None:
    with pytest.raises(ResultError, match="no 'force'; expected some of id1"):
        describe({"force": [1.0]})
    with pytest.raises(ResultError, match="'normal' has 4 columns; expected 3"):
        describe({"normal": np.ones((2, 4))})
    with pytest.raises(ResultError, match="different lengths"):
        describe({"normal": np.eye(3), "area": [1.0]})
    with pytest.raises(ResultError, match="not of unit length"):
        describe({"normal": 2 * np.eye(3)})
    with pytest.raises(ResultError, match=r"none\.txt"):
        describe("none.txt")
