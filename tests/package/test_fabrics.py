"""Fabric and delta of arrays, files and tensors, against paper 000 and numpy."""

import gzip
import json
from pathlib import Path

import numpy as np
import pytest

import hypofab


def test_delta_is_that_of_the_paper() -> None:
    """Paper 000, Tables 1 to 3."""
    fabric = hypofab.fabric_of_tensor([0.318, 0.362, 0.320, 0.001, -0.002, 0])
    assert fabric.anisotropy == pytest.approx(0.324, abs=5e-4)
    delta = fabric.delta(R=1e-4, c=0.05).delta
    np.testing.assert_allclose(delta, np.array([-4.288, 8.183, -3.721, 0.283, -0.567, 0]) * 1e-5, atol=6e-9)
    assert fabric.delta(1e-4, 0.05, weight="tanh").weight == pytest.approx(np.tanh(fabric.anisotropy / 0.05))
    assert hypofab.weights()["exponential"] == "1 - exp(-a/c)"


def sample(examples: Path) -> np.ndarray:
    with gzip.open(examples / "data" / "aniso_3000_contacts.txt.gz", "rt") as file:
        header = [line for line in file if line.startswith("#")][-1].lstrip("# ").split()
    values = np.loadtxt(examples / "data" / "aniso_3000_contacts.txt.gz")
    return dict(zip(header, values.T, strict=True))


def test_arrays_and_files_give_the_same_fabric(examples: Path) -> None:
    table = sample(examples)
    normals = np.stack([table[f"n{axis}"] for axis in "xyz"], axis=1)
    ids = (table["id1"].astype(int), table["id2"].astype(int))
    summary = json.loads((examples / "data" / "aniso_3000_summary.json").read_text())
    particles = examples / "data" / "aniso_3000_particles.txt.gz"
    from_file = hypofab.fabric_of_file(examples / "data" / "aniso_3000_contacts.txt.gz", particles=particles)
    from_arrays = hypofab.fabric_of_normals(normals, ids=ids, particles=from_file.particles)
    for name in ("contacts", "particles", "rattlers", "coordination_number"):
        assert getattr(from_arrays, name) == getattr(from_file, name), name
    np.testing.assert_allclose(from_arrays.fabric, from_file.fabric, rtol=1e-12)
    assert summary
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    expected = (normals / lengths).T @ (normals / lengths) / len(normals)
    np.testing.assert_allclose(hypofab.matrix(from_file.fabric), expected, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(from_file.principal_values, np.linalg.eigvalsh(expected)[::-1], rtol=1e-9)
    assert from_file.significance().p_value < 0.05
    assert from_file.without_noise().anisotropy < from_file.anisotropy


def test_a_turned_fabric_turns_its_delta(examples: Path) -> None:
    fabric = hypofab.fabric_of_file(examples / "data" / "aniso_3000_contacts.txt.gz")
    angle = np.radians(30)
    turn = np.array([[np.cos(angle), np.sin(angle), 0], [-np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
    turned = hypofab.matrix(fabric.rotated(turn).delta(1e-4).delta)
    np.testing.assert_allclose(turned, turn @ hypofab.matrix(fabric.delta(1e-4).delta) @ turn.T, rtol=0, atol=1e-16)


def test_disks_have_a_fabric_in_the_plane() -> None:
    angles = np.radians(np.arange(0, 180, 5))
    normals = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    np.testing.assert_allclose(hypofab.fabric_of_normals(normals).fabric, [0.5, 0.5, 0, 0, 0, 0], atol=1e-14)
    one = hypofab.fabric_of_normals([[0.0, 0, 1]], ids=([3], [8]))
    assert (one.contacts, one.particles) == (1, 2)
    assert hypofab.fabric_of_normals([[0.0, 0, 1]]).particles == 0


def test_columns_and_wrong_contacts_are_options(tmp_path: Path) -> None:
    path = tmp_path / "kontakte.csv"
    path.write_text("a;b;u;v;w\n1;2;1;0;0\n2;3;0;1;0\n3;1;0;0;2\n")
    options = {"columns": {"id1": "a", "id2": "b", "nx": "u", "ny": "v", "nz": "w"}, "separator": ";"}
    with pytest.raises(hypofab.InputError, match=r"kontakte\.csv") as bad:
        hypofab.fabric_of_file(path, **options)
    assert bad.value.status is hypofab.Status.BAD_FILE
    assert hypofab.fabric_of_file(path, wrong="skip", **options).contacts == 2
    assert hypofab.fabric_of_file(path, normalise=True, **options).contacts == 3
    with pytest.raises(hypofab.InputError, match=r"wrong = 'keep', expected one of refuse, skip"):
        hypofab.fabric_of_file(path, wrong="keep")
    with pytest.raises(hypofab.InputError, match=r"columns: \['x'\], expected some of id1"):
        hypofab.fabric_of_file(path, columns={"x": 1})


@pytest.mark.parametrize("normals", [np.zeros((0, 3)), np.zeros((4, 4)), np.full((3, 3), 0.5), np.full((3, 3), np.nan)])
def test_wrong_normals_are_refused(normals: np.ndarray) -> None:
    with pytest.raises(hypofab.InputError):
        hypofab.fabric_of_normals(normals)
