"""Calibrations from Python: the numbers of the program, mappings, figures, laboratory tests."""

import os
from pathlib import Path

import numpy as np
import pytest

import hypofab
from hypofab.__main__ import main
from hypofab.cli.launch import packaged_program
from hypofab.laboratory.calibration import calibration_of
from hypofab.laboratory.catalogue import load_catalogue
from hypofab.results.calibration import read_calibration

LAB_DATA = os.environ.get("HYPOFAB_LAB_DATA")


@pytest.fixture
def example(examples: Path) -> Path:
    path = examples / "calibration" / "sand.yaml"
    if not path.exists():
        pytest.skip("the examples are not here")
    return path


def test_the_example_gives_the_numbers_of_the_program(example: Path, tmp_path: Path) -> None:
    result = hypofab.calibrate(example, directory=tmp_path / "python")
    call = ["hypofab", "calibrate", str(example), "-o", str(tmp_path / "program")]
    assert os.spawnv(os.P_WAIT, packaged_program(), call) == 0
    other = read_calibration(tmp_path / "program")
    assert result.parameters == other.parameters
    assert result.material == other.material
    np.testing.assert_array_equal(result.covariance, other.covariance)
    for mine, its in zip(result.tests, other.tests, strict=True):
        np.testing.assert_array_equal(mine.computed["q"], its.computed["q"])
    truth = hypofab.Material.sand("hochstetten")
    for parameter in result.parameters:
        assert abs(parameter.value - getattr(truth, parameter.name)) < 3 * parameter.standard_error
    assert result["m_R"].start == 3.5
    assert result.converged
    assert result.estimates["phi_c"] == (33.5, "angle of repose")

    assert main(["calibration", str(tmp_path / "python")]) == 0
    for name in ("tests_1.png", "tests_2.png", "residuals.png", "distances.png", "correlations.pdf"):
        assert (tmp_path / "python" / name).stat().st_size > 0


def mapping(tmp_path: Path) -> dict:
    rows = "eps1,q\n0,0\n1,120\n2,180\n4,230\n6,250\n"
    (tmp_path / "one.csv").write_text(rows)
    columns = {"eps1": {"column": "eps1", "factor": 0.01}, "q": {"column": "q"}}
    test = {"name": "one", "kind": "drained_compression", "file": "one.csv", "columns": columns}
    return {
        "calibration": "base",
        "sand": "hochstetten_1999",
        "free": ["alpha", "phi_c"],
        "tests": [test | {"void_ratio": 0.7, "sigma3": 100}],
    }


def test_a_mapping_and_its_distance(tmp_path: Path) -> None:
    calibration = hypofab.Calibration(mapping(tmp_path), folder=tmp_path)
    assert calibration.names == ("alpha", "phi_c")
    assert (calibration.lower < calibration.start).all()
    result = calibration.run()
    found = [parameter.value for parameter in result.parameters]
    assert calibration.distance(found) == pytest.approx(result.distance, rel=1e-9)
    assert calibration.distance(calibration.start) == pytest.approx(result.start_distance, rel=1e-9)
    for shift in (1.02, 0.98):
        assert calibration.distance([found[0] * shift, found[1]]) > result.distance
        assert calibration.distance([found[0], found[1] * shift]) > result.distance
    assert calibration.distances(found).shape == (1,)
    with pytest.raises(hypofab.InputError, match="3 values, expected 2"):
        calibration.distance([1, 2, 3])


def test_a_wrong_calibration_is_an_exception(tmp_path: Path) -> None:
    wrong = mapping(tmp_path) | {"free": ["alpha", "colour"]}
    with pytest.raises(hypofab.InputError, match=r"free\[1\]: 'colour', expected among phi_c"):
        hypofab.calibrate(wrong, folder=tmp_path)
    assert main(["calibration", str(tmp_path)]) == 2


@pytest.mark.skipif(
    LAB_DATA is None, reason="HYPOFAB_LAB_DATA does not name a folder of laboratory tests: NOT CALIBRATED"
)
def test_drained_tests_not_seen_are_met_better_than_by_the_published_set() -> None:
    """Karlsruhe fine sand: every other drained test by void ratio is fitted, with the oedometer tests."""
    names = ["TMD01", "TMD04", "TMD07", "TMD09", "TMD11", "TMD14", "TMD17", "TMD22", "TMD19", "TMD24"]
    catalogue = {test.name: test for test in load_catalogue()}
    tests = [catalogue[name] for name in ("OE02", "OE05", "OE08", "OE11", *names)]
    result = hypofab.calibrate(
        calibration_of(
            tests,
            Path(LAB_DATA),
            title="Karlsruhe fine sand",
            free=["phi_c", "h_s", "n", "alpha", "beta"],
            only_compared=names[1::2],
            sand="karlsruhe_fine",
        )
    )
    unseen = [test for test in result.tests if test.use == "check"]
    assert len(unseen) == 5
    before, after = (
        np.sqrt(np.mean([getattr(test, key) ** 2 for test in unseen])) for key in ("start_distance", "distance")
    )
    assert after < 0.75 * before
