"""Changes, directions, bootstrap, stiffnesses and the fit of c: the same bits as the program prints."""

import json
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

import hypofab
from hypofab.cli.launch import packaged_program

ROOT = Path(__file__).resolve().parents[2]
DATA = ROOT / "examples/data"
SAMPLE = DATA / "aniso_3000_contacts.txt.gz"
ANGLES = (0, 45, 90, 180)
STRAIN = 2.000289e-4


def printed(*arguments: object) -> dict:
    """What the program says."""
    words = [str(packaged_program()), *map(str, arguments), "--json"]
    return json.loads(subprocess.run(words, check=True, capture_output=True, text=True, env=dict(os.environ)).stdout)


def pairs(estimates: dict | list) -> list:
    return [[one["value"], one["error"]] for one in estimates]


def assert_close(found: np.ndarray, expected: list) -> None:
    """To the last digits: contacts are summed in the order in which threads hand them over."""
    np.testing.assert_allclose(found, expected, rtol=1e-11, atol=1e-13)


def test_changes_and_their_fit() -> None:
    probes = DATA / "probes"
    after = [probes / f"{angle:03d}.txt.gz" for angle in ANGLES]
    words = ("--angles", ",".join(map(str, ANGLES)), "--strain", STRAIN, "--probe-axes", "yx")
    expected = printed("changes", probes / "before.txt.gz", *after, *words)
    found = hypofab.changes(probes / "before.txt.gz", after, axes="yx")
    for one, wanted in zip(found, expected["snapshots"], strict=True):
        assert (one.particles, one.contacts_before) == (expected["particles"], expected["contacts_before"])
        assert (one.contacts_after, one.lost, one.gained) == (
            wanted["contacts"], wanted["loss"]["contacts"], wanted["gain"]["contacts"]
        )  # fmt: skip
        assert one.persisting == one.contacts_before - one.lost == one.contacts_after - one.gained
        assert_close(one.fabric_before, expected["fabric_before"])
        assert_close(one.change, wanted["change"])
        np.testing.assert_allclose(one.fabric_before + one.change, one.fabric_after, atol=1e-14)
        loss, gain, turned = one.by_mechanism
        np.testing.assert_allclose(gain - loss + turned, one.change, atol=1e-14)
        assert_close(gain, wanted["gain"]["change"])
        assert one.turn == pytest.approx(wanted["reorientation"]["turn"])
        for rose, name in ((one.lost_rose, "loss"), (one.gained_rose, "gain")):
            np.testing.assert_array_equal(rose.count, wanted[name]["rose"]["count"])
            assert rose.direction == pytest.approx(wanted[name]["rose"]["direction"])
        rates = [[wanted[name][rate] for name in ("loss", "gain", "reorientation")] for rate in ("dZ", "dA")]
        np.testing.assert_allclose(one.rates(STRAIN, "yx"), rates, rtol=1e-12, atol=1e-9)
    response = hypofab.fit_fabric_response(ANGLES, [one.rates(STRAIN, "yx") for one in found])
    wanted = expected["response"]
    for name in ("loss", "gain", "reorientation"):
        fit = getattr(response, name)
        for coefficient in ("B", "C", "D", "E", "G", "dZ_extension", "dZ_shear", "dZ_compression"):
            one = getattr(fit, coefficient)
            close = {"rel": 1e-9, "abs": 1e-9}
            assert (one.value, one.error) == pytest.approx(tuple(wanted[name][coefficient].values()), **close)
        assert fit.r2_dA == pytest.approx(wanted[name]["r2_dA"])
    np.testing.assert_allclose([[one.value, one.error] for one in response.a], pairs(wanted["a"]), rtol=1e-9)


def test_directions_and_their_figures() -> None:
    expected = printed("directions", SAMPLE, "--bins", 36)
    found = hypofab.directions(SAMPLE, bins=36)
    bins = expected["bins"]
    assert found.contacts.tolist() == [one["contacts"] for one in bins]
    np.testing.assert_array_equal(found.polar, [one["polar"] for one in bins])
    np.testing.assert_array_equal(found.azimuth, [one["azimuth"] for one in bins])
    np.testing.assert_array_equal(found.normal_force, [one["normal_force"] for one in bins])
    np.testing.assert_array_equal(found.shear_force, [one["shear_force"] for one in bins])
    assert found.density.mean() == pytest.approx(1)
    assert "6084 contacts" in found.plot("dense").get_suptitle()
    assert len(hypofab.directions(SAMPLE, bins=10000).contacts) == 10000


def test_a_rose_in_the_plane(tmp_path: Path) -> None:
    angles = np.radians(np.arange(0.5, 180) ** 2 / 180)  # more and more apart
    file = tmp_path / "disks.txt"
    np.savetxt(file, np.column_stack([np.cos(angles), np.sin(angles)]), header="nx ny", comments="")
    found = hypofab.directions(file, dimension=2)
    assert found.contacts.sum() == 180
    assert found.contacts[0] > 3 * found.contacts[-1]
    (axes,) = found.plot().axes
    assert len(axes.patches) == 4 * len(found.contacts)  # both senses, positive and (empty) negative bars


def test_bootstrap() -> None:
    expected = printed("delta", SAMPLE, "--R", 1e-4, "--c", 0.05, "--bootstrap", 50, "--seed", 3)["uncertainty"]
    found = hypofab.bootstrap(SAMPLE, R=1e-4, replicates=50, seed=3)
    for name in ("fabric", "deviatoric_fabric", "anisotropy", "corrected_anisotropy", "weight", "delta"):
        interval = getattr(found, name)
        for side in ("lower", "upper", "error"):
            np.testing.assert_array_equal(getattr(interval, side), expected[name][side])
    assert (found.units, found.p_value, found.delta_angle) == (6084, expected["p_value"], expected["delta_angle"])
    assert found.sample.contacts == 6084
    assert found.replicates.shape == (50, 6)
    np.testing.assert_allclose(found.replicates[:, :3].sum(axis=1), 1)
    spread = found.replicates.std(axis=0)
    np.testing.assert_allclose(spread, found.fabric.error, rtol=0.3)  # a replicate is without the noise drawn on top


def test_stiffness_and_fit_of_c() -> None:
    deck = ROOT / "examples/directional_stiffness_dem.yaml"
    study = hypofab.Study(deck)
    expected = printed("stiffness", deck, "--bootstrap", 20)["tests"]
    for name, wanted in zip(study.tests, expected, strict=True):
        one = study.stiffness(replicates=20)[name]
        assert (wanted["test"], one.value, one.relative) == (name, wanted["stiffness"], wanted["relative"])
        assert one.interval.upper == wanted["interval"]["upper"]
        assert one.relative_interval.lower == wanted["relative_interval"]["lower"]
    assert np.isnan(study.stiffness()["A-0"].interval.lower)

    deck = ROOT / "examples/directional_stiffness.yaml"
    given = {"A-0": 28327.0, "A-90": 12707.0, "I-0": 26657.0, "I-90": 26203.0}
    expected = printed("fit-c", deck, "--target", ",".join(f"{name}={value}" for name, value in given.items()))
    found = hypofab.Study(deck).fit_c(given)
    assert (found.c, found.misfit, found.factor) == tuple(expected[name] for name in ("c", "misfit", "factor"))
    assert (found.lower_open, found.upper_open, found.at_lower, found.at_upper) == (True, True, False, False)
    assert found.stiffness == {one["test"]: one["computed"] for one in expected["tests"]}


@pytest.mark.parametrize(
    ("call", "expected"),
    [
        (lambda: hypofab.changes("missing.txt", []), "missing.txt"),
        (lambda: hypofab.changes(SAMPLE, ["missing.txt"]), "missing.txt"),
        (lambda: hypofab.changes(SAMPLE, [], axes="xx"), "axes = 'xx', expected two of x, y, z"),
        (lambda: hypofab.fit_fabric_response([0, 45], np.ones((2, 2, 3))), "3"),
        (lambda: hypofab.fit_fabric_response([0, 45], np.ones((2, 3))), "expected .2, 2, 3."),
        (lambda: hypofab.directions(SAMPLE, bins=20000), "10000"),
        (lambda: hypofab.directions(SAMPLE, walls="through"), "walls = 'through'"),
        (lambda: hypofab.bootstrap(SAMPLE, R=1e-4, replicates=3), "20"),
        (lambda: hypofab.bootstrap(SAMPLE, R=1e-4, units="grains"), "expected one of contacts, blocks, samples"),
        (lambda: hypofab.Study(ROOT / "examples/directional_stiffness.yaml").fit_c({"B-0": 1, "A-0": 2}), "B-0"),
        (lambda: hypofab.Study(ROOT / "examples/directional_stiffness.yaml").fit_c({}), "2 or more"),
    ],
)
def test_what_is_wrong_is_named(call: object, expected: str) -> None:
    with pytest.raises(hypofab.InputError, match=expected):
        call()
