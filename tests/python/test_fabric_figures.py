"""Figures of fabric: that they show the numbers of the program's output, to scale and under the right names."""

import json
from pathlib import Path

import numpy as np
import pytest

from hypofab.__main__ import main
from hypofab.figures import changes as change_figures
from hypofab.figures import fabric as fabric_figures
from hypofab.figures import uncertainty as uncertainty_figures
from hypofab.results import ResultError
from hypofab.results.fabric import Result, read_results, read_series, tensor

FABRIC = [-0.07, 0.14, -0.07, 0.01, 0.0, 0.02]


def result(data: dict, label: str = "sample") -> Result:
    return Result(label, Path(f"{label}.json"), data)


def directions(rings: int = 3) -> dict:
    """`hypofab directions --json` of a sample whose density is 1 + n F n in every bin's middle."""
    bins = []
    for ring in range(rings):
        sectors = 4 * (2 * ring + 1)
        polar = np.degrees(np.arccos(1 - (np.array([ring, ring + 1]) / rings) ** 2))
        for sector in range(sectors):
            azimuth = 360 / sectors * np.array([sector, sector + 1])
            p, a = np.radians(polar.mean()), np.radians(azimuth.mean())
            n = np.array([np.sin(p) * np.cos(a), np.sin(p) * np.sin(a), np.cos(p)])
            density = float(fabric_figures.density(tensor(FABRIC), n))
            bins.append({"polar": polar.tolist(), "azimuth": azimuth.tolist(), "density": density, "contacts": 10})
    return {
        "dimension": 3,
        "contacts": 360,
        "anisotropy": 0.21,
        "deviatoric_fabric": FABRIC,
        "principal_directions": [[0, 1, 0], [1, 0, 0], [0, 0, -1]],
        "bins": bins,
    }


def test_density_has_mean_one_and_its_extremes_at_the_axes() -> None:
    points = fabric_figures.sphere_points(60)
    weights = np.sqrt(np.maximum(0, 1 - points[2] ** 2))[:, :-1]  # sin of the polar angle
    values = fabric_figures.density(tensor([-0.1, 0.2, -0.1, 0, 0, 0]), points)
    assert np.average(values[:, :-1], weights=weights) == pytest.approx(1, abs=1e-3)
    assert values.max() == pytest.approx(1.2, abs=1e-3)
    assert values.min() == pytest.approx(0.9, abs=1e-3)


@pytest.mark.parametrize(("up", "axis"), [("z", 2), ("y", 1), ("x", 0)])
def test_surfaces_have_one_scale_and_the_asked_axis_upright(up: str, axis: int) -> None:
    fabric = [0.0] * 6
    fabric[axis] = 0.4
    samples = [result({"deviatoric_fabric": [0.0] * 6}, "a"), result({"deviatoric_fabric": fabric}, "b")]
    figure = fabric_figures.surfaces(samples, up=up)
    first, second, bar = figure.axes
    assert second.get_zlabel() == up
    assert sorted([second.get_xlabel(), second.get_ylabel(), up]) == ["x", "y", "z"]
    assert first.get_zlim() == second.get_zlim()
    vertices = np.array(second.collections[0]._vec)[:3]  # of the drawn surface
    assert vertices[2].max() == pytest.approx(1.4, abs=3e-3)  # upright: 1 + n F n, on a grid
    assert vertices[0].max() == pytest.approx(1.0, abs=1e-2)
    assert "density" in bar.get_ylabel()
    assert bar.get_ylim()[1] == pytest.approx(1.4, abs=1e-3)


def test_sphere_bins_have_equal_area_and_their_colours_the_density() -> None:
    figure = fabric_figures.sphere(result(directions()))
    counted, fitted, bar = figure.axes
    assert len(counted.patches) == len(fitted.patches) == 36
    areas = [((p.get_y() + p.get_height()) ** 2 - p.get_y() ** 2) * p.get_width() / 2 for p in counted.patches]
    np.testing.assert_allclose(areas, np.pi / 36)
    # Counted and fitted densities are equal here, and so are the colours.
    for left, right in zip(counted.patches, fitted.patches, strict=True):
        assert left.get_facecolor() == right.get_facecolor()
    marks = {text.get_text(): text.xy for text in fitted.texts}
    assert marks["1"] == pytest.approx((np.pi / 2, 1))  # y, at the edge
    assert marks["3"][1] == pytest.approx(0)  # -z is z: the middle
    assert "[-]" in bar.get_ylabel()


def disks(shear: bool = True) -> dict:
    """A sample of two dimensions whose bins follow the harmonics of its fit."""
    middle = 5 + 10 * np.arange(18)
    fit = {"mean_normal_force": 2.0, "a_n": 0.4, "phi_n": 60, "a_f": 0.3, "phi_f": 50, "a_t": 0.15, "phi_t": 40}
    bins = []
    for angle in middle:
        radians = np.radians(angle)
        t = -2.0 * 0.15 * np.sin(2 * np.radians(angle - 40))
        force = [-t * np.sin(radians), t * np.cos(radians), 0.0] if shear else [None] * 3
        bins.append(
            {
                "azimuth": [float(angle - 5), float(angle + 5)],
                "polar": [90, 90],
                "contacts": 10,
                "density": 1 + 0.4 * np.cos(2 * np.radians(angle - 60)),
                "normal_force": 2.0 * (1 + 0.3 * np.cos(2 * np.radians(angle - 50))),
                "shear_force": force,
            }
        )
    return {"dimension": 2, "contacts": 180, "fit": fit, "bins": bins}


def test_roses_follow_their_harmonics_in_size_and_direction() -> None:
    panels = fabric_figures.plane_roses(result(disks())).axes
    assert [axes.get_title().split(",")[0] for axes in panels] == [
        "contacts $E/E_0$",
        "normal force $f/f_0$",
        "shear force $|t|/f_0$",
    ]
    for axes in panels:
        (line,) = axes.lines
        angle, wave = line.get_data()
        # 18 bars, drawn on both sides, positive and negative values apart.
        bars = np.array([(p.get_x() + p.get_width() / 2, p.get_height()) for p in axes.patches])
        assert len(bars) == 72
        tops = {}
        for place, height in bars:
            tops[round(place, 6)] = max(height, tops.get(round(place, 6), 0))
        assert len(tops) == 36
        for place, height in tops.items():
            assert height == pytest.approx(np.interp(place, angle, wave), abs=2e-3)
    hatched = [p for p in panels[2].patches if p.get_hatch() and p.get_height() > 0]
    assert {round(np.degrees(p.get_x() + p.get_width() / 2)) % 180 for p in hatched} == set(range(45, 130, 10))


def test_roses_without_forces_show_contacts_alone() -> None:
    data = disks(shear=False)
    for one in data["bins"]:
        one["normal_force"] = None
    data["fit"] |= {"mean_normal_force": None, "a_f": None, "phi_f": None, "a_t": None, "phi_t": None}
    assert len(fabric_figures.plane_roses(result(data)).axes) == 1


def changes(fitted: bool = True) -> dict:
    """`hypofab changes --json` of probes that follow known coefficients."""
    coefficients = {
        "loss": {"B": 100.0, "C": 70.0, "D": -60.0, "E": 100.0, "G": 90.0},
        "gain": {"B": 40.0, "C": -25.0, "D": -5.0, "E": -20.0, "G": 15.0},
        "reorientation": {"B": 0.0, "C": -1.25, "D": 0.0, "E": 2.5, "G": 0.0},
    }
    response = {m: {k: {"value": v, "error": 1.0} for k, v in one.items()} for m, one in coefficients.items()}
    snapshots = []
    for angle in (180, 0, 45, None, 270):
        snapshot = {"file": f"{angle}.txt", "angle": angle}
        for mechanism, k in coefficients.items():
            snapshot[mechanism] = {"contacts": 6}
            if angle is not None:  # dF = psi_1 1 + psi_2 eps, as in docs/changes.md
                c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
                psi1, psi2 = k["B"] + k["C"] * (c + s) + k["D"] * c * s, k["E"] + k["G"] * (c + s)
                snapshot[mechanism] |= {"dZ": 2 * psi1 + psi2 * (c + s), "dA": psi2 * (s - c)}
            rose = {"bins": 4, "contacts": 8, "count": [1, 4, 3, 0], "anisotropy": 0.5, "direction": 70.0}
            if mechanism == "gain" and angle is None:
                rose = {"bins": 4, "contacts": 0, "count": [0] * 4, "anisotropy": None, "direction": None}
            if mechanism != "reorientation":
                snapshot[mechanism]["rose"] = rose
        snapshots.append(snapshot)
    data = {"contacts_before": 500, "plane": "yx", "strain": 2e-4, "snapshots": snapshots}
    return data | ({"response": response, "no_gain": [18.4, 71.6], "no_loss": [198.4, 251.6]} if fitted else {})


@pytest.mark.parametrize("fitted", [True, False])
def test_rates_show_probes_in_order_and_the_law_through_them(fitted: bool) -> None:
    panels = change_figures.rates(result(changes(fitted))).axes
    assert [axes.get_title() for axes in panels[:3]] == ["contact loss", "contact gain", "reorientation"]
    for axes in panels:
        lines = {line.get_label(): line for line in axes.lines}
        angle, values = lines["probes"].get_data()
        assert list(angle) == [0, 45, 180, 270]  # the hold is none
        assert ("fit" in lines) == fitted
        if fitted:
            np.testing.assert_allclose(np.interp(angle, *lines["fit"].get_data()), values, atol=1e-6)
    assert len(panels[0].patches) == (1 if fitted else 0)  # the grey zone
    assert r"\alpha" in panels[3].get_xlabel()


def test_roses_of_lost_and_gained_contacts() -> None:
    panels = change_figures.roses(result(changes())).axes
    assert len(panels) == 10
    titles = [axes.get_title() for axes in panels]
    assert "8 lost" in titles[0]
    assert any("no strain" in title and "0 gained" in title for title in titles)
    full = next(axes for axes in panels if "8 gained" in axes.get_title())
    assert sorted(p.get_height() for p in full.patches) == [0, 0, 1, 1, 3, 3, 4, 4]
    angle, wave = full.lines[0].get_data()
    assert np.degrees(angle[np.argmax(wave)]) % 180 == pytest.approx(70, abs=1)
    assert wave.max() == pytest.approx(2 * 1.5)  # mean of the bins times 1 + a
    assert [label.get_text() for label in full.get_xticklabels()] == ["y", "x"]


def test_no_probes_no_rates() -> None:
    data = changes()
    for snapshot in data["snapshots"]:
        snapshot["angle"] = None
    with pytest.raises(ResultError, match="no strain probes"):
        change_figures.rates(result(data))


def write_series(path: Path) -> Path:
    path.write_text("file,coordination_number,deviator_fabric,anisotropy,p\na,4,0.1,0.3,\nb,5,0.2,0.1,\n")
    return path


def test_series_over_snapshots_or_a_column(tmp_path: Path) -> None:
    table = read_series(write_series(tmp_path / "s.csv"))
    assert set(table) == {"coordination_number", "deviator_fabric", "anisotropy", "p"}
    panels = fabric_figures.series({"one": table}, ["deviator_fabric", "anisotropy"]).axes
    assert panels[0].lines[0].get_xydata().tolist() == [[1, 0.1], [2, 0.2]]
    assert "deviator fabric" in panels[0].get_ylabel()
    assert panels[1].get_xlabel() == "snapshot"
    (axes,) = fabric_figures.series({"one": table}, ["anisotropy"], over="coordination_number").axes
    assert axes.lines[0].get_xydata().tolist() == [[4, 0.3], [5, 0.1]]
    with pytest.raises(ResultError, match="no numbers in a column p"):
        fabric_figures.series({"one": table}, ["p"])


def intervals(values: list[float]) -> dict:
    return {"lower": [v - 0.2e-4 for v in values], "upper": [v + 0.1e-4 for v in values], "error": [0.1e-4] * 6}


def test_intervals_of_delta_in_units_of_R() -> None:
    delta = [1e-5 * k for k in range(6)]
    data = {"R": 1e-4, "delta": delta, "sign": "tension positive"}
    data |= {"uncertainty": {"delta": intervals(delta), "level": 0.9}}
    figure = uncertainty_figures.delta_intervals([result(data)])
    (axes,) = figure.axes
    line, _, (bars,) = axes.containers[0]
    np.testing.assert_allclose(line.get_ydata(), [0.1 * k for k in range(6)])
    ends = np.array([segment[:, 1] for segment in bars.get_segments()])
    np.testing.assert_allclose(ends[:, 0], np.array(delta) / 1e-4 - 0.2, atol=1e-12)
    np.testing.assert_allclose(ends[:, 1], np.array(delta) / 1e-4 + 0.1, atol=1e-12)
    assert [label.get_text() for label in axes.get_xticklabels()] == ["xx", "yy", "zz", "xy", "xz", "yz"]
    assert "90 %" in figure.legends[0].get_title().get_text()


def test_intervals_of_stiffnesses() -> None:
    tests = [
        {
            "test": name,
            "stiffness": value,
            "relative": value / 50,
            "interval": {"lower": value - 10, "upper": value + 5, "error": 4},
            "relative_interval": {"lower": value / 50 - 0.1, "upper": value / 50 + 0.2, "error": 0.1},
        }
        for name, value in (("A-0", 100.0), ("A-90", 50.0))
    ]
    figure = uncertainty_figures.stiffness_intervals(result({"unit": "MPa", "tests": tests, "level": 0.95}))
    left, right = figure.axes
    assert "[MPa]" in left.get_ylabel()
    assert list(right.containers[0][0].get_ydata()) == [2, 1]
    assert [label.get_text() for label in right.get_xticklabels()] == ["A-0", "A-90"]


def test_command_draws_what_the_files_have(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    files = {"sphere": directions(2), "disks": disks(), "probes": changes()}
    for name, data in files.items():
        (tmp_path / f"{name}.json").write_text(json.dumps(data))
    write_series(tmp_path / "cycles.csv")
    arguments = [str(tmp_path / f"{name}.json") for name in files] + [f"cyclic={tmp_path / 'cycles.csv'}"]
    figures = tmp_path / "new" / "figures"
    assert main(["plot", *arguments, "-o", str(figures)]) == 0
    named = capsys.readouterr().out.split()
    stems = ("fabric_surface", "sphere_sphere", "disks_roses", "probes_rates", "probes_lost_gained", "series")
    assert named == [str(figures / f"{stem}.{suffix}") for stem in stems for suffix in ("png", "pdf")]
    assert all(Path(name).stat().st_size > 4000 for name in named)


@pytest.mark.parametrize("text", ["{}", "[1]", "no JSON", '{"tests": [{}]}'])
def test_other_files_are_refused(tmp_path: Path, text: str, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "other.json"
    path.write_text(text)
    with pytest.raises(ResultError, match=r"other\.json"):
        read_results(path)
    assert main(["plot", str(path)]) == 2
    assert main(["plot", str(path), "-o", str(path)]) == 2
    assert "not a folder" in capsys.readouterr().err
    assert main(["plot", str(tmp_path / "missing.json")]) == 2
    assert "missing.json" in capsys.readouterr().err
