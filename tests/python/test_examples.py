"""The program on the example decks of the demonstration, against the figures of paper 000 and the exact integration."""

import os
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest

from hypofab.__main__ import main
from hypofab.results import paper000, read_envelope, read_run, read_summary
from hypofab.results.secants import secant_stiffness

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("HYPOFAB_PROGRAM")

pytestmark = pytest.mark.skipif(PROGRAM is None, reason="HYPOFAB_PROGRAM does not name the program")


def run_program(command: str, deck: str, directory: Path) -> Path:
    """Run `hypofab COMMAND examples/DECK -o DIRECTORY` and expect success and silence in a pipe."""
    assert PROGRAM is not None
    call = [PROGRAM, command, str(ROOT / "examples" / deck), "-o", str(directory)]
    result = subprocess.run(call, capture_output=True, text=True, timeout=60, check=False)
    assert result.returncode == 0, result.stderr
    assert result.stderr == ""
    return directory


@pytest.fixture(scope="module")
def paper_run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return run_program("run", "directional_stiffness.yaml", tmp_path_factory.mktemp("paper"))


@pytest.fixture(scope="module")
def dem_run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return run_program("run", "directional_stiffness_dem.yaml", tmp_path_factory.mktemp("dem"))


@pytest.fixture(scope="module")
def envelopes(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return run_program("envelope", "response_envelopes.yaml", tmp_path_factory.mktemp("envelopes"))


def test_every_preset_has_an_example() -> None:
    listed = subprocess.run([str(PROGRAM), "presets"], capture_output=True, text=True, timeout=60, check=True).stdout
    names = {line.split()[0] for line in listed.splitlines() if not line.startswith(" ")}
    decks = [path.read_text(encoding="utf-8") for path in (ROOT / "examples").glob("*.yaml")]
    shown = {name for deck in decks for name in re.findall(r"preset: (\w+)", deck)}
    assert "k0_unloading" in names
    assert names - shown == set()


def test_stiffness_is_that_of_the_exact_integration_and_near_the_paper(paper_run: Path) -> None:
    stiffness = secant_stiffness(paper_run)
    assert stiffness == pytest.approx(paper000.EXACT, rel=1e-4)
    assert stiffness == pytest.approx(paper000.ELEMENT_TEST, rel=5e-3)


def test_stiffness_of_the_summary_is_that_of_the_rows(paper_run: Path) -> None:
    for test, name_and_value in zip(read_run(paper_run).tests, secant_stiffness(paper_run).items(), strict=True):
        end = np.flatnonzero(test.step == 1)[-1]
        assert test.eps_q[end] == pytest.approx(1e-3, rel=1e-6)
        assert name_and_value == (test.name, pytest.approx(test.q[end] / test.eps_q[end], rel=1e-6))


def test_loading_ends_at_ten_percent_and_held_stresses_stay_held(paper_run: Path) -> None:
    for test in read_run(paper_run).tests:
        loaded = 0 if test.name.endswith("-90") else 1  # x or y
        held = [component for component in range(6) if component != loaded]
        assert test.strain[-1, loaded] == pytest.approx(-0.1, rel=1e-6)
        assert np.abs(test.stress[:, held] - test.stress[0, held]).max() <= 1e-10 * test.p[0]


def test_measures_of_stress_and_strain_follow_their_definitions(paper_run: Path) -> None:
    weight = np.array([1, 1, 1, 2, 2, 2])  # off-diagonal components count twice
    unit = np.array([1, 1, 1, 0, 0, 0])
    for test in read_run(paper_run).tests:
        p = -test.stress @ unit / 3
        deviator = test.stress + p[:, None] * unit
        eps_v = test.strain @ unit
        deviatoric_strain = test.strain - eps_v[:, None] / 3 * unit
        np.testing.assert_allclose(test.p, p, rtol=1e-8)
        np.testing.assert_allclose(test.q, np.sqrt(1.5 * deviator**2 @ weight), rtol=1e-8, atol=1e-8)
        np.testing.assert_allclose(test.eps_v, eps_v, rtol=1e-8, atol=1e-12)
        np.testing.assert_allclose(test.eps_q, np.sqrt(2 / 3 * deviatoric_strain**2 @ weight), rtol=1e-8, atol=1e-12)


def test_dem_samples_show_the_stiffness_of_their_fabric(dem_run: Path) -> None:
    stiffness = secant_stiffness(dem_run)
    assert set(stiffness) == set(paper000.DEM)
    # Paper 000: stiffest along the dominant contact direction, softest across it, the isotropic sample in between.
    assert stiffness["A-0"] > max(stiffness["I-0"], stiffness["I-90"])
    assert stiffness["A-90"] < min(stiffness["I-0"], stiffness["I-90"])


def test_every_test_of_the_decks_ends_as_asked(paper_run: Path, dem_run: Path) -> None:
    for run in (paper_run, dem_run):
        assert [test["status"] for test in read_summary(run)["tests"]] == [0, 0, 0, 0]


def test_envelopes_differ_by_the_direction_of_delta(envelopes: Path) -> None:
    (path,) = envelopes.glob("*.csv")
    plain, *with_delta = read_envelope(path)
    assert plain.delta == (0, 0)
    assert len(with_delta) >= 2
    for series in with_delta:
        np.testing.assert_array_equal(series.angle, plain.angle)
        direction = np.degrees(np.arctan2(series.delta[1], series.delta[0])) % 360
        turn = np.abs((series.angle - direction + 180) % 360 - 180)
        ratio = np.hypot(series.axial, series.lateral) / np.hypot(plain.axial, plain.lateral)
        # Fully mobilised delta: straight on, the response of the plain model; after a reversal m_R times L.
        assert turn.min() < 1e-6
        assert ratio[turn.argmin()] == pytest.approx(1, rel=1e-6)
        assert ratio[turn.argmax()] > 1.5


def test_figures_of_the_demonstration(paper_run: Path, dem_run: Path, envelopes: Path) -> None:
    directories = [str(directory) for directory in (paper_run, dem_run, envelopes)]
    assert main(["secants", *directories[:2]]) == 0
    assert main(["plot", "--zoom", "0.1", *directories]) == 0
    for directory in (paper_run, dem_run):
        assert (directory / "stress_strain.png").stat().st_size > 10_000
        assert (directory / "volumetric.pdf").stat().st_size > 5_000
    assert len(list(envelopes.glob("*.png"))) == 1
