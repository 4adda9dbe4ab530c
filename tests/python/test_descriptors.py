"""`hypofab describe` against the same numbers computed here with numpy, and against SPAM's fabric tensor."""

import gzip
import importlib.util
import json
import math
import os
import subprocess
import sys
import types
from itertools import combinations_with_replacement
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = Path(os.environ.get("HYPOFAB_PROGRAM", ROOT / "build" / "cli" / "hypofab"))
DATA = ROOT / "examples" / "data"
ONE = np.eye(3)

pytestmark = pytest.mark.skipif(not PROGRAM.exists(), reason=f"no program {PROGRAM}")


def describe(*arguments: str | Path) -> dict:
    done = subprocess.run([PROGRAM, "describe", *arguments, "--json"], check=True, capture_output=True, text=True)
    return json.loads(done.stdout)


def columns(sample: str) -> dict[str, np.ndarray]:
    """The contact list of a sample, by the names in its header."""
    with gzip.open(DATA / f"{sample}_contacts.txt.gz", "rt") as file:
        header = [line for line in file if line.startswith("#")][-1]
    values = np.loadtxt(DATA / f"{sample}_contacts.txt.gz")
    return dict(zip(header.lstrip("# ").split(), values.T, strict=True))


def vectors(table: dict[str, np.ndarray], prefix: str) -> np.ndarray:
    return np.stack([table[prefix + axis] for axis in "xyz"], axis=1)


def rank2(tensor: np.ndarray) -> np.ndarray:
    return tensor[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]


def rank4(tensor: np.ndarray) -> np.ndarray:
    return np.array([tensor[index] for index in combinations_with_replacement(range(3), 4)])


def symmetric(tensor: np.ndarray) -> np.ndarray:
    """Fully symmetric part of a tensor of rank 4."""
    orders = [(i, j, k, 6 - i - j - k) for i in range(4) for j in range(4) for k in range(4)]
    orders = [order for order in orders if sorted(order) == [0, 1, 2, 3]]
    return sum(tensor.transpose(order) for order in orders) / len(orders)


@pytest.fixture(scope="module", params=["iso_3000", "aniso_3000"])
def sample(request: pytest.FixtureRequest) -> tuple[dict, dict[str, np.ndarray]]:
    """A description of a sample and its contacts."""
    name = request.param
    arguments = ["--particles", DATA / f"{name}_particles.txt.gz", "--friction-angle", "30", "--volume", "2e-6"]
    return describe(DATA / f"{name}_contacts.txt.gz", *arguments), columns(name)


def normals(table: dict[str, np.ndarray]) -> np.ndarray:
    n = vectors(table, "n")
    return n / np.linalg.norm(n, axis=1, keepdims=True)


def test_fabric_of_all_kinds(sample: tuple[dict, dict[str, np.ndarray]]) -> None:
    result, table = sample
    n = normals(table)
    force = np.einsum("ci,ci->c", vectors(table, "Fn"), n)
    length = np.linalg.norm(vectors(table, "b"), axis=1)
    for key, w in {"number": np.ones(len(n)), "normal_force": force, "branch_length": length}.items():
        first2 = np.einsum("c,ci,cj->ij", w, n, n) / w.sum()
        first4 = np.einsum("c,ci,cj,ck,cl->ijkl", w, n, n, n, n) / w.sum()
        third2 = 15 / 2 * (first2 - ONE / 3)
        pair, unit = symmetric(np.multiply.outer(ONE, first2)), symmetric(np.multiply.outer(ONE, ONE))
        third4 = 315 / 8 * (first4 - 6 / 7 * pair + 3 / 35 * unit)
        # Kanatani's own form of the second kind, not by way of the third
        second2 = 15 / 2 * (first2 - ONE / 5)
        second4 = 315 / 8 * (first4 - 2 / 3 * pair + 1 / 21 * unit)
        tensors = result["weighted"][key]
        for kind, two, four in (("first", first2, first4), ("second", second2, second4), ("third", third2, third4)):
            assert tensors[f"{kind}_kind"]["rank2"] == pytest.approx(rank2(two), abs=1e-12)
            assert tensors[f"{kind}_kind"]["rank4"] == pytest.approx(rank4(four), abs=1e-11)
        assert tensors["anisotropy"] == pytest.approx(math.sqrt(1.5 * (third2**2).sum()), abs=1e-12)
        assert tensors["principal_values"] == pytest.approx(np.linalg.eigvalsh(first2)[::-1], abs=1e-13)


def test_anisotropy_of_forces(sample: tuple[dict, dict[str, np.ndarray]]) -> None:
    """Moments over directions, and a least-squares fit over contacts by another route for a comparison in size."""
    result, table = sample
    n, shear = normals(table), vectors(table, "Fs")
    force = np.einsum("ci,ci->c", vectors(table, "Fn"), n)
    P = 15 / 2 * (np.einsum("ci,cj->ij", n, n) / len(n) - ONE / 3)
    share = 1 / (1 + np.einsum("ij,ci,cj->c", P, n, n)) / len(n)
    chi = np.einsum("c,ci,cj->ij", share * force, n, n)
    Q = 15 / 2 * (chi / np.trace(chi) - ONE / 3)
    T = 5 * np.einsum("c,ci,cj->ij", share, shear, n) / np.trace(chi)
    T = (T + T.T) / 2
    found = result["forces"]["from_moments"]
    assert found["mean_normal_force"] == pytest.approx(np.trace(chi), rel=1e-12)
    assert found["normal_force_tensor"] == pytest.approx(rank2(Q), abs=1e-11)
    assert found["tangential_force_tensor"] == pytest.approx(rank2(T - ONE * np.trace(T) / 3), abs=1e-11)
    assert found["a_f"] == pytest.approx(math.sqrt(1.5 * (Q**2).sum()), abs=1e-11)
    # f0 + f0 Q:nn on the six functions n_i n_j of the contacts themselves
    functions = np.stack([n[:, i] * n[:, j] * (1 if i == j else 2) for i in range(3) for j in range(i, 3)], axis=1)
    fit = np.linalg.lstsq(functions, force, rcond=None)[0][[0, 3, 5, 1, 2, 4]]
    f0 = fit[:3].sum() / 3
    assert found["normal_force_tensor"] == pytest.approx((fit - f0 * rank2(ONE)) / f0, abs=0.05)
    assert result["forces"]["from_bins"]["normal_force_tensor"] == pytest.approx(found["normal_force_tensor"], abs=0.06)


def test_stress_and_networks(sample: tuple[dict, dict[str, np.ndarray]]) -> None:
    result, table = sample
    n, branch, shear = normals(table), vectors(table, "b"), vectors(table, "Fs")
    force = np.einsum("ci,ci->c", vectors(table, "Fn"), n)
    stress = -np.einsum("ci,cj->ij", force[:, None] * n + shear, branch) / 2e-6
    assert np.array(result["stress"]["total"]) == pytest.approx(stress, rel=1e-12, abs=1e-8)
    # the friction that follows from anisotropies is that of the stress, as far as densities of degree 2 go
    assert result["forces"]["from_moments"]["q_over_p"] == pytest.approx(result["stress"]["q_over_p"], abs=0.01)
    strong = force > force.mean()
    sliding = np.linalg.norm(shear, axis=1) > 0.99 * math.tan(math.radians(30)) * force
    networks = result["networks"]
    assert networks["strong"]["fraction"] == pytest.approx(strong.mean(), abs=1e-15)
    assert networks["sliding"]["fraction"] == pytest.approx(sliding.mean(), abs=1e-15)
    fabric = np.einsum("ci,cj->ij", n[sliding], n[sliding]) / sliding.sum()
    assert networks["sliding"]["fabric"]["first_kind"]["rank2"] == pytest.approx(rank2(fabric), abs=1e-13)


def spam_fabric_tensor() -> types.FunctionType:
    """The function fabricTensor of SPAM: from its one file, which imports scipy for other functions."""
    package = importlib.util.find_spec("spam")
    if package is None:
        pytest.skip("SPAM is not installed: pip install --no-deps --requirement python/requirements-spam.txt")
    path = Path(next(iter(package.submodule_search_locations))) / "orientations" / "analyse.py"
    stand_ins = {}
    if importlib.util.find_spec("scipy") is None:
        for name in ("scipy", "scipy.special", "scipy.stats"):
            stand_ins[name] = types.ModuleType(name)
        stand_ins["scipy.stats"].chi2 = None
    spec = importlib.util.spec_from_file_location("spam_orientations_analyse", path)
    module = importlib.util.module_from_spec(spec)
    sys.modules |= stand_ins
    try:
        spec.loader.exec_module(module)
    finally:
        for name in stand_ins:
            del sys.modules[name]
    return module.fabricTensor


def test_fabric_tensor_of_spam(sample: tuple[dict, dict[str, np.ndarray]]) -> None:
    """SPAM's axes are Z, Y, X."""
    result, table = sample
    N, F, a = spam_fabric_tensor()(vectors(table, "n")[:, ::-1])
    assert result["fabric"] == pytest.approx(rank2(N[::-1, ::-1]), abs=1e-13)
    assert result["deviatoric_fabric"] == pytest.approx(rank2(F[::-1, ::-1]), abs=1e-12)
    assert result["anisotropy"] == pytest.approx(a, abs=1e-12)
