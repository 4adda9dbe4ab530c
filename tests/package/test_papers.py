"""The comparisons with the papers, on the DEM runs that the documentation shows."""

import gzip
import json
import runpy
import subprocess
import sys
import tarfile
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import papers
from hypofab.cli.launch import run_json
from hypofab.results import ResultError
from papers import paper_001, paper_003, paper_004
from papers.element import SMALL, Loading, element_tests, fabric_in_space, secants
from papers.flow import flow_of, octahedral_unit
from papers.runs import read_curve, read_dem, run_folders

EXAMPLES = Path(__file__).parents[2] / "examples"
RESULTS = EXAMPLES / "dem" / "results"

Kept = Callable[[str], Path]


@pytest.fixture(scope="module")
def kept() -> Iterator[Kept]:
    """The kept runs of a paper, unpacked once for all tests."""
    with ExitStack() as stack:
        yield cache(lambda paper: stack.enter_context(run_folders(RESULTS / f"{paper}.tar.xz")))


def test_anisotropic_sample_is_stiffest_along_its_contacts_in_dem_and_element_tests(kept: Kept) -> None:
    runs = kept("000")
    dem = {name: read_curve(runs / name).secant(SMALL) for name in ("A-0", "A-90", "I-0", "I-90")}
    assert dem["A-0"] > 1.05 * max(dem["I-0"], dem["I-90"])
    assert dem["A-90"] < min(dem["I-0"], dem["I-90"])
    aniso = read_dem(runs / "aniso")
    element = secants(element_tests([Loading("A-0", aniso, "y"), Loading("A-90", aniso, "x")], 0.05))
    assert element["A-0"] > 1.05 * element["A-90"]


def test_no_contact_is_lost_in_the_zone_of_no_loss(kept: Kept) -> None:
    fan = paper_001.read_fan(kept("001") / "probes_a")
    lost = fan.rate("loss", "dZ")
    gained = fan.rate("gain", "dZ")
    assert np.all(lost[(fan.alpha > 198.4) & (fan.alpha < 251.6)] == 0)
    assert np.all(gained[(fan.alpha > 18.4) & (fan.alpha < 71.6)] == 0)
    assert lost.max() > 100
    # Normals that follow the strain give E = Z/2 (docs/changes.md); the stress response is linear.
    assert fan.coefficient("reorientation", "E")[0] == pytest.approx(fan.coordination / 2, rel=0.1)
    assert fan.linear[1] < 0.02


def test_samples_of_two_seeds_have_the_same_stiffness_but_not_the_same_losses(kept: Kept) -> None:
    first, second = (paper_001.read_fan(kept("001") / name) for name in ("probes_c", "probes_h"))
    assert (first.friction, first.seed, second.seed) == (second.friction, 1, 2)
    assert second.linear[0] == pytest.approx(first.linear[0], abs=0.03 * first.linear[0].max())
    (loss, error), (other, _) = (fan.coefficient("loss", "dZ_extension") for fan in (first, second))
    assert abs(loss - other) > 3 * error


def test_anisotropies_tell_the_friction(kept: Kept) -> None:
    test = paper_003.read_test(kept("003"), "D03")
    loaded = test.strain > 0.004
    predicted, contacts = (test.micro[name][loaded] for name in ("sin_phi_from_anisotropies", "sin_phi"))
    assert predicted == pytest.approx(contacts, abs=0.05)
    walls = np.interp(test.strain, test.curve.axial, test.curve.q / test.p / 2)[loaded]
    assert contacts == pytest.approx(walls, abs=0.05)


def test_plastic_flow_at_failure_has_one_direction(kept: Kept) -> None:
    for lode in (20, 40, 60):
        state = paper_004.read_failure(kept("004") / f"lode{lode}")
        flow = state.flow
        assert flow.share > 0.9
        assert np.argmax(flow.direction) == 0  # extension along x, the direction of the smallest compression
        assert np.argmin(-state.stress) == np.argmin(state.fabric()) == 0


def test_a_tangent_path_turns_the_flow_and_leaves_the_fabric(kept: Kept) -> None:
    states = {name: paper_004.read_failure(kept("004") / name) for name in ("A_minus", "lode0", "A_plus")}
    minus, radial, plus = states.values()
    assert minus.flow.angle + 3 < radial.flow.angle < plus.flow.angle - 3
    assert minus.fabric() == pytest.approx(radial.fabric(), abs=0.004)
    assert plus.fabric() == pytest.approx(radial.fabric(), abs=0.004)
    # Sliding contacts: more of them in the direction to which the flow has turned.
    assert plus.fabric(sliding=True)[0] > radial.fabric(sliding=True)[0] > minus.fabric(sliding=True)[0]
    element = paper_004.element_probes(states)
    assert element["A_minus"].flow.angle + 2 < element["lode0"].flow.angle < element["A_plus"].flow.angle - 2


def test_flow_has_the_lode_angle_of_its_stress_where_both_are_aligned() -> None:
    for angle in (0, 20, 50):
        unit = octahedral_unit(angle)
        flow = flow_of(np.outer([1.0, 2.0, 0.5], unit), unit - 1)
        assert flow.angle == pytest.approx(angle)
        assert flow.share == pytest.approx(1)
        assert flow.direction == pytest.approx(unit)


def test_a_planar_isotropic_fabric_is_isotropic_in_space() -> None:
    assert fabric_in_space(0.5, 0.5, 0.0) == pytest.approx([1 / 3, 1 / 3, 1 / 3, 0, 0, 0])
    assert sum(fabric_in_space(0.6, 0.4, 0.1)[:3]) == pytest.approx(1)


def test_biaxial_tests_end_on_one_line_whatever_the_preparation(kept: Kept) -> None:
    tests = [paper_003.read_test(kept("003"), name) for name in ("D02", "I12", "M07")]  # 200 kPa
    start = [test.curve.void_ratio[0] for test in tests]
    end = [test.late(test.curve.void_ratio) for test in tests]
    assert np.ptp(start) > 0.09
    assert np.ptp(end) < 0.015
    assert np.ptp([test.critical for test in tests]) < 0.1


@pytest.mark.parametrize("paper", ["002", "003", "004", "convergence"])
def test_every_paper_has_a_table_and_figures(paper: str, tmp_path: Path) -> None:
    assert papers.compare(paper, RESULTS / f"{paper}.tar.xz", tmp_path).count("|") > 50
    assert list(tmp_path.glob(f"{paper}*.png"))


def test_kept_contact_lists_say_what_the_whole_ones_say(tmp_path: Path) -> None:
    keep = runpy.run_path(str(RESULTS.parent / "keep"))
    rows = ["9 8 0 0 1 0.6000004 0.7999997 1e-12 1.23456e-3 2e-3 1e-20 30.000001 40.000002 1e-9 4 -3 0 1e-6 0 0 0"]
    rows.append("2 3 0 0 0 1 0 0 1e-3 0 0 5 0 0 0 1 0 1e-6 0 0 0")
    names = "id1 id2 cellDist_x cellDist_y cellDist_z nx ny nz bx by bz Fnx Fny Fnz Fsx Fsy Fsz penetration cpx cpy cpz"
    whole, short = tmp_path / "whole.txt", tmp_path / "short.txt"
    whole.write_text("\n".join(["# title", f"# {names}", *rows]) + "\n")
    short.write_text(keep["contacts"]("003", whole.read_text()))
    assert "penetration" not in short.read_text()
    assert short.read_text().splitlines()[2].startswith("2 3 ")
    before, after = (run_json("describe", file, "--plane", "--friction-angle", "26.565") for file in (whole, short))
    for key in ("contacts", "particles", "anisotropy", "mean_normal_force", "mean_shear_force", "mean_branch_length"):
        assert after[key] == pytest.approx(before[key], rel=1e-3)
    assert before["contacts"] == 2


def test_packed_runs_are_those_of_the_folders(tmp_path: Path) -> None:
    dem = tmp_path / "dem"
    dem.mkdir()
    (dem / "results").mkdir()
    (dem / "keep").write_text((RESULTS.parent / "keep").read_text())

    def keep(name: str, finished: bool = True) -> subprocess.CompletedProcess[str]:
        folder = tmp_path / name / name
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "manifest.json").write_text(json.dumps({"program": "load", "finished": finished}))
        (folder / "history.txt.gz").write_bytes(gzip.compress(f"# {name}\n".encode()))
        (folder / "sample.yade.gz").write_bytes(b"scene")
        words = [sys.executable, str(dem / "keep"), "000", str(tmp_path / name)]
        return subprocess.run(words, capture_output=True, text=True, check=False)

    assert keep("first").returncode == keep("second").returncode == 0
    packed = dem / "results" / "000.tar.xz"
    before = packed.read_bytes()
    assert keep("second").returncode == 0
    assert packed.read_bytes() == before
    assert "not finished" in keep("third", finished=False).stderr
    assert packed.read_bytes() == before
    with tarfile.open(packed) as tar:
        assert tar.getnames() == [
            f"{run}/{file}" for run in ("first", "second") for file in ("history.txt", "manifest.json")
        ]
    with run_folders(packed) as folder:
        assert (folder / "first" / "history.txt").read_text() == "# first\n"


def test_script_prints_the_tables(tmp_path: Path) -> None:
    words = [sys.executable, str(EXAMPLES / "papers" / "paper.py"), "family", "--out", str(tmp_path)]
    done = subprocess.run(words, capture_output=True, text=True, check=True)
    page = (EXAMPLES.parent / "docs" / "papers" / "family.md").read_text()
    assert done.stdout.strip() in page
    refused = subprocess.run([*words, "--runs", "nowhere"], capture_output=True, text=True, check=False)
    assert refused.returncode == 1
    assert "nowhere" in refused.stderr
    assert "examples/dem/README" in refused.stderr


def test_missing_runs_are_named(tmp_path: Path) -> None:
    with pytest.raises(ResultError, match="examples/dem/README"):
        papers.compare("000", tmp_path, tmp_path / "out")


def test_unfinished_run_is_refused(tmp_path: Path) -> None:
    (tmp_path / "manifest.json").write_text('{"parameters": {}, "results": {}, "finished": false}')
    with pytest.raises(ResultError, match="not finished"):
        read_dem(tmp_path)
