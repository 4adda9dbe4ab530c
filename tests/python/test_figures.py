"""Figures: what they show, with which sign, and that nothing covers the data."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from hypofab.__main__ import main
from hypofab.figures import LINES, response_envelopes, stress_path, stress_strain, volumetric
from hypofab.results import read_envelope, read_run


def test_stress_strain_shows_each_test_in_percent_and_stress(run_directory: Path) -> None:
    (axes,) = stress_strain(read_run(run_directory)).axes
    stiff, soft = axes.lines
    assert [line.get_label() for line in axes.lines] == ["stiff", "soft"]
    np.testing.assert_allclose(stiff.get_ydata(), 400 * stiff.get_xdata())  # 40 MPa per 1, 400 kPa per percent
    assert stiff.get_linestyle() != soft.get_linestyle()
    assert "[%]" in axes.get_xlabel()
    assert "[kPa]" in axes.get_ylabel()


def test_zoom_covers_the_range_asked_for_and_all_curves_in_it(run_directory: Path) -> None:
    run = read_run(run_directory)  # to eps_q = 0.2 %
    (axes,) = stress_strain(run, zoom=1e-4).axes
    (inset,) = axes.child_axes
    assert inset.get_xlim() == (0, 0.01)
    assert inset.get_ylim() == pytest.approx((0, 1.05 * 4))  # 40 MPa times 0.01 %
    (axes,) = stress_strain(run, zoom=1e-3).axes
    assert not axes.child_axes  # would cover half of the curves


@pytest.mark.parametrize("wanted", [False, True])
@pytest.mark.parametrize("in_file", [False, True])
def test_volumetric_sign(run_directory: Path, wanted: bool, in_file: bool) -> None:
    run = replace(read_run(run_directory), compression_positive=in_file)
    axes = volumetric(run, compression_positive=wanted).axes[0]
    curve = next(line for line in axes.lines if line.get_label() == "stiff")
    expected = -0.25 * curve.get_xdata() * (1 if wanted == in_file else -1)
    np.testing.assert_allclose(curve.get_ydata(), expected)
    assert ("contraction positive" if wanted else "dilation positive") in axes.get_ylabel()


@pytest.mark.parametrize(("compression_positive", "sign"), [(False, 1), (True, -1)])
def test_envelopes_are_closed_to_scale_and_signed(envelope_file: Path, compression_positive: bool, sign: int) -> None:
    axes = response_envelopes(read_envelope(envelope_file), compression_positive=compression_positive).axes[0]
    outer = next(line for line in axes.lines if line.get_label() == "outer")
    x, y = outer.get_data()
    assert (x[0], y[0]) == (x[-1], y[-1])
    np.testing.assert_allclose(np.hypot(x, y), 30)  # MPa
    assert y[0] == pytest.approx(sign * 30)  # angle 0: axial extension
    assert axes.get_aspect() == 1
    # One arrow, for the one state with delta; it points along the axis, to compression.
    (arrow,) = [text for text in axes.texts if text.arrow_patch is not None]
    assert arrow.xy == pytest.approx((0, -sign * 15))


def test_stress_path_shows_extension_below_zero(run_directory: Path) -> None:
    (axes,) = stress_path(read_run(run_directory)).axes
    stiff = next(line for line in axes.lines if line.get_label() == "stiff")
    assert stiff.get_xdata() == pytest.approx([100.0] * len(stiff.get_xdata()))
    assert stiff.get_ydata()[-1] == pytest.approx(-40e3 * 2e-3)
    assert axes.get_xlim()[0] == 0


def test_line_styles_differ_without_colour() -> None:
    assert len({(style["linestyle"], style["linewidth"]) for style in LINES}) == len(LINES)


def test_plot_command_writes_png_and_pdf_and_names_them(
    run_directory: Path, envelope_file: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["plot", "--zoom", "0.1", str(run_directory)]) == 0
    named = capsys.readouterr().out.split()
    stems = ("stress_strain", "volumetric", "stress_path", "compression", envelope_file.stem)
    assert named == [str(run_directory / f"{stem}.{suffix}") for stem in stems for suffix in ("png", "pdf")]
    assert Path(named[0]).read_bytes().startswith(b"\x89PNG")
    assert Path(named[1]).read_bytes().startswith(b"%PDF")


def test_equal_data_give_equal_files(run_directory: Path) -> None:
    assert main(["plot", str(run_directory)]) == 0
    first = {path.name: path.read_bytes() for path in run_directory.glob("*.p??")}
    assert main(["plot", str(run_directory)]) == 0
    assert first == {path.name: path.read_bytes() for path in run_directory.glob("*.p??")}


def test_a_folder_without_results_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["plot", str(tmp_path)]) == 2
    assert str(tmp_path) in capsys.readouterr().err
