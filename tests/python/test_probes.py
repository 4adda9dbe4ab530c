"""Probes of the example decks: tables, surfaces and figures, against what is known of them."""

from pathlib import Path

import numpy as np
import pytest
from test_examples import PROGRAM, run_program

from hypofab.__main__ import main
from hypofab.figures.probes import deviatoric_coordinates, directional_stiffness, ellipse, fan, flow
from hypofab.figures.surfaces import surfaces
from hypofab.results import ResultError
from hypofab.results.probes import Envelope, read_probes
from hypofab.results.vtp import read_vtp
from hypofab.tensors import contraction, coordinates

needs_program = pytest.mark.skipif(PROGRAM is None, reason="HYPOFAB_PROGRAM does not name the program")


def probe(deck: str, directory: Path) -> dict[str, Envelope]:
    return {envelope.name: envelope for envelope in read_probes(run_program("envelope", deck, directory))}


@pytest.fixture(scope="module")
def strain_probes(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Envelope]:
    return probe("strain_probes.yaml", tmp_path_factory.mktemp("strain"))


@pytest.fixture(scope="module")
def stress_probes(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Envelope]:
    return probe("stress_probes.yaml", tmp_path_factory.mktemp("stress"))


@pytest.fixture(scope="module")
def response_surfaces(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Envelope]:
    return probe("response_surfaces.yaml", tmp_path_factory.mktemp("surfaces"))


@needs_program
def test_fan_of_paper_001(strain_probes: dict[str, Envelope]) -> None:
    for envelope in strain_probes.values():
        for series in envelope.series:
            alpha = np.radians(15 * np.arange(24))
            np.testing.assert_allclose(series.direction[:, 0], np.cos(alpha), atol=1e-14)
            np.testing.assert_allclose(series.direction[:, 1], np.sin(alpha), atol=1e-14)
            # Isotropic state: mirror images about 45 degrees.
            mirror = series.response[(6 - np.arange(24)) % 24][:, [1, 0, 2, 3, 5, 4]]
            scale = np.abs(series.response).max()
            np.testing.assert_allclose(series.response, mirror, atol=1e-8 * scale)
    dense, medium, loose = strain_probes["elastic_range"].series
    assert np.all(dense.stiffness > medium.stiffness)
    assert np.all(medium.stiffness > loose.stiffness)


@needs_program
def test_linear_within_the_elastic_range_and_not_beyond(strain_probes: dict[str, Envelope]) -> None:
    for series in strain_probes["elastic_range"].series:
        assert series.ellipsoid is not None
        assert series.ellipsoid.nonlinearity < 0.02
        curve = ellipse(series, 3601)
        points = coordinates(series.basis, series.response)
        away = np.min(np.linalg.norm(points[:, None, :] - curve[None], axis=2), axis=1)
        assert away.max() < 0.02 * np.linalg.norm(points, axis=1).max()
    for series in strain_probes["beyond"].series:
        assert series.ellipsoid is not None
        assert series.ellipsoid.nonlinearity > 0.1


@needs_program
def test_flow_of_paper_004(stress_probes: dict[str, Envelope]) -> None:
    """Near the limit the irrecoverable strain has one direction; a tangent path turns it towards itself."""
    radial = stress_probes["radial"]
    assert [len(series.direction) for series in radial.series] == [112] * 4
    for series, lode in zip(radial.series, (0, 20, 40, 60), strict=True):
        x, y = deviatoric_coordinates(series.stress)
        assert np.degrees(np.arctan2(-x, y)) == pytest.approx(lode, abs=1e-6)
        assert series.stress[:3].mean() == pytest.approx(100, rel=1e-9)
        assert series.unloaded
        left = series.irrecoverable[:, :3]
        _, values, _ = np.linalg.svd(left)
        assert values[1] < 0.01 * values[0]
        size = np.sqrt(contraction(series.irrecoverable, series.irrecoverable))
        largest = series.irrecoverable[size.argmax()]
        assert largest[1] < 0 < largest[2]  # extension along the least stress, compression along the largest
    base, plus, minus = stress_probes["tangent"].series
    turn = []
    for series in (base, plus, minus):
        assert series.unloaded
        size = np.sqrt(contraction(series.irrecoverable, series.irrecoverable))
        x, y = deviatoric_coordinates(series.irrecoverable[size.argmax()])
        turn.append(np.degrees(np.arctan2(-x, y)))
    assert turn[0] == pytest.approx(0, abs=0.5)
    assert turn[1] > 1  # loaded towards larger sigma_xx
    assert turn[2] == pytest.approx(-turn[1], rel=0.1)


@needs_program
def test_surfaces_are_closed_and_hold_the_answers(response_surfaces: dict[str, Envelope]) -> None:
    envelope = response_surfaces["principal"]
    assert envelope.vtk is not None
    pieces = read_vtp(envelope.vtk)
    assert [(piece.series, piece.irrecoverable) for piece in pieces] == [(0, False), (1, False), (2, False)]
    for piece, series in zip(pieces, envelope.series, strict=True):
        np.testing.assert_allclose(piece.points, series.response[:, :3], rtol=1e-14)
        np.testing.assert_allclose(piece.data["imposed"], series.direction[:, :3], rtol=1e-14, atol=1e-16)
        np.testing.assert_allclose(piece.data["stiffness"], series.stiffness, rtol=1e-14)
        assert not piece.data["status"].any()
        edges = np.concatenate([piece.cells[:, [i, (i + 1) % 3]] for i in range(3)])
        forward = set(map(tuple, edges))
        assert len(forward) == len(edges) == 3 * (2 * len(piece.points) - 4)
        assert forward == {(b, a) for a, b in forward}
    # Of the plain model the surface is an ellipsoid of known volume: 4/3 pi times the semi-axes, from inside.
    corners = pieces[0].points[pieces[0].cells]
    volume = np.linalg.det(corners).sum() / 6
    fit = envelope.series[0].ellipsoid
    assert fit is not None
    exact = 4 / 3 * np.pi * np.prod(fit.semi_axis)
    assert 0.96 * exact < volume < exact


@needs_program
def test_irrecoverable_surfaces(stress_probes: dict[str, Envelope]) -> None:
    envelope = stress_probes["radial"]
    assert envelope.vtk is not None
    pieces = read_vtp(envelope.vtk)
    assert [piece.irrecoverable for piece in pieces] == [False, True] * 4
    for piece, series in zip(pieces[1::2], envelope.series, strict=True):
        assert series.unloaded
        np.testing.assert_allclose(piece.points, series.irrecoverable[:, :3], rtol=1e-14)


@needs_program
def test_responses_are_linear_on_either_side_of_delta(response_surfaces: dict[str, Envelope]) -> None:
    def misfit(chosen: np.ndarray) -> float:
        linear, *_ = np.linalg.lstsq(series.direction[chosen], series.response[chosen])
        return float(np.abs(series.direction[chosen] @ linear - series.response[chosen]).max() / series.stiffness.max())

    without, *with_delta = response_surfaces["general"].series
    for series in with_delta:
        along = contraction(series.direction, series.delta)
        assert misfit(along > 0) < 1e-12
        assert misfit(along <= 0) < 1e-12
        assert misfit(np.isfinite(along)) > 0.05
        assert np.all(series.stiffness[along <= 0] > without.stiffness[along <= 0])


@needs_program
def test_figures_show_the_data(
    strain_probes: dict[str, Envelope], stress_probes: dict[str, Envelope], response_surfaces: dict[str, Envelope]
) -> None:
    for sign, compression in ((1, False), (-1, True)):
        left, right = fan(strain_probes["beyond"], compression_positive=compression).axes
        dense = next(line for line in right.lines if line.get_label() == "dense")
        expected = sign * 2e-4 * strain_probes["beyond"].series[0].response[:, :2]  # kPa
        np.testing.assert_allclose(np.column_stack(dense.get_data()), expected, rtol=1e-12, atol=1e-12)
        assert r"$10^{-4}$" in left.get_xlabel()
        assert "[kPa]" in right.get_ylabel()
    plane, dilatancy = flow(stress_probes["tangent"]).axes
    assert [line.get_label() for line in dilatancy.lines[:3]] == ["A", "A_plus", "A_minus"]
    assert "[kPa]" in plane.get_xlabel()
    assert len(surfaces(response_surfaces["principal"]).axes) == 3
    (axes,) = directional_stiffness(response_surfaces["general"]).axes
    assert [line.get_label() for line in axes.lines] == ["delta_A", "delta_B"]
    assert "[MPa]" in axes.get_ylabel()


@needs_program
def test_plot_draws_what_suits_each_envelope(
    stress_probes: dict[str, Envelope], capsys: pytest.CaptureFixture[str]
) -> None:
    directory = stress_probes["tangent"].file.parent
    assert main(["plot", str(directory)]) == 0
    named = {Path(line).name for line in capsys.readouterr().out.split() if line.endswith(".png")}
    assert named == {"radial_flow.png", "radial_stiffness.png", "tangent_flow.png", "tangent_stiffness.png"}


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("<VTKFile", "syntax|token|well-formed"),
        ("<VTKFile type='ImageData'/>", "poly data"),
        (
            "<VTKFile type='PolyData'><PolyData><Piece NumberOfPoints='1' NumberOfLines='0' NumberOfPolys='0'>"
            "</Piece></PolyData></VTKFile>",
            "without points",
        ),
    ],
)
def test_bad_surfaces_are_refused(tmp_path: Path, text: str, reason: str) -> None:
    path = tmp_path / "bad.vtp"
    path.write_text(text)
    with pytest.raises(ResultError, match=reason):
        read_vtp(path)


def test_a_folder_without_probes_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ResultError, match=r"envelopes\.json"):
        read_probes(tmp_path)
    (tmp_path / "envelopes.json").write_text("{")
    with pytest.raises(ResultError, match=r"envelopes\.json"):
        read_probes(tmp_path)
