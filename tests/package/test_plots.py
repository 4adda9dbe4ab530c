"""Figures of results in memory show the numbers of the results."""

from pathlib import Path

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import hypofab
from hypofab.figures.memory import KINDS

SAND = hypofab.Material.sand("hochstetten")
START = hypofab.State.isotropic(100, 0.7, [0, 0, -5e-5, 0, 0, 0])
COMPRESSION = hypofab.Step(preset="drained_triaxial_compression", axis="z", until=("eps_zz", -0.02), rows=20)


@pytest.fixture(scope="module")
def test() -> hypofab.TestResult:
    return hypofab.element_test(SAND, START, COMPRESSION)


def line(figure: Figure, label: str) -> np.ndarray:
    return next(one for one in figure.axes[0].lines if one.get_label() == label).get_xydata()


def test_figures_of_a_test(test: hypofab.TestResult) -> None:
    np.testing.assert_allclose(line(test.plot(), "test"), np.column_stack([100 * test["eps_q"], test["q"]]))
    drawn = line(test.plot("volumetric", compression_positive=True), "test")
    np.testing.assert_allclose(drawn[:, 1], -100 * test["eps_v"])
    drawn = line(test.plot("loops"), "test")
    np.testing.assert_allclose(drawn, np.column_stack([-100 * test["eps_zz"], test["q"]]))
    figure = test.plot("compression")
    np.testing.assert_allclose(line(figure, "test"), np.column_stack([test["p"], test["void_ratio"]]))
    assert len(figure.axes[0].texts) == 3  # limiting curves: the material is known
    for kind in KINDS:
        assert hypofab.plot({"a": test, "b": test}, kind).axes


def test_compression_shows_paths_between_limiting_curves(test: hypofab.TestResult) -> None:
    """Bauer's law, theory.md Eq. (6)."""
    axes = test.plot("compression").axes[0]
    assert [text.get_text() for text in axes.texts] == ["$e_i$", "$e_c$", "$e_d$"]
    curves = [line for line in axes.lines if len(line.get_xdata()) == 200]
    for curve, name in zip(curves, ("e_i0", "e_c0", "e_d0"), strict=True):
        p, e = curve.get_data()
        np.testing.assert_allclose(np.log(SAND[name] / e), (3 * p / SAND.h_s) ** SAND.n)
        assert p[0] <= 100 <= p[-1]
    assert not test.plot("compression", limits=False).axes[0].texts


def test_limits_of_two_sands_are_told_apart(test: hypofab.TestResult) -> None:
    other = hypofab.element_test(SAND.replace(phi_c=31.0, e_c0=0.9), START, COMPRESSION)
    axes = hypofab.plot({"a": test, "b": other, "c": test}, "compression").axes[0]
    assert [text.get_text().split("\n")[1] for text in axes.texts] == ["33°"] * 3 + ["31°"] * 3


def test_measured_data_and_labels(test: hypofab.TestResult, tmp_path: Path) -> None:
    file = tmp_path / "lab.csv"
    file.write_text("eps_1,eps_v,q\n0,0,0\n0.01,0.003,40\n")
    figure = hypofab.plot({"dense": test}, measured={"lab": file, "array": {"eps_q": [0.01], "q": [10]}})
    np.testing.assert_allclose(line(figure, "lab"), [[0, 0], [0.9, 40]])
    np.testing.assert_allclose(line(figure, "array"), [[1, 10]])
    assert len(line(figure, "dense")) == len(test.rows)


def test_material_of_each_test_of_a_deck() -> None:
    other = hypofab.Material.sand("toyoura")
    loose = hypofab.State.isotropic(100, 0.8)
    tests = [
        hypofab.Test(material=material, state=state, name=name, steps=[COMPRESSION])
        for name, material, state in (("one", SAND, START), ("two", other, loose), ("three", SAND, START))
    ]
    results = hypofab.run(tests)
    assert [results[name].material.phi_c for name in ("one", "two", "three")] == [SAND.phi_c, other.phi_c, SAND.phi_c]


def test_accumulation_of_cycles(test: hypofab.TestResult) -> None:
    cyclic = hypofab.run(Path(__file__).parents[2] / "examples/undrained_cyclic.yaml")["isochoric"]
    figure = cyclic.plot("accumulation", quantity="eps_zz")
    ends = [float(cyclic["eps_zz"][cyclic["cycle"] == number][-1]) for number in (1, 2, 3)]
    np.testing.assert_allclose(line(figure, "isochoric")[:3, 1], 100 * np.array(ends))
    with pytest.raises(hypofab.InputError, match="no test with cycles"):
        test.plot("accumulation")


def test_classical_envelope_is_to_scale_and_has_the_arrow_of_delta() -> None:
    for axis, component in (("y", 1), ("z", 2)):
        delta = np.zeros(6)
        delta[component] = -SAND.R
        probes = hypofab.envelope(SAND, hypofab.State.isotropic(100, 0.7, delta), n=36, axis=axis)
        axes = probes.plot().axes[0]
        drawn = next(one for one in axes.lines if one.get_label() == "response").get_xydata()[:-1]
        lateral = np.sqrt(2) * probes.response[:, (component + 1) % 3]
        expected = 1e-3 * np.column_stack([lateral, probes.response[:, component]])
        np.testing.assert_allclose(sorted(drawn.tolist()), sorted(expected.tolist()), atol=1e-9)
        (arrow,) = [text for text in axes.texts if text.arrow_patch is not None]
        assert arrow.xy[1] < 0
        assert arrow.xy[0] == pytest.approx(0)


def test_probes_choose_their_figure() -> None:
    plane = hypofab.Subspace.plane([0, 1, 0, 0, 0, 0], [0, 0, 1, 0, 0, 0])
    figure = hypofab.probe(SAND, START, plane.directions(12), impose="strain", size=1e-5).plot()
    assert [axes.get_title() for axes in figure.axes] == ["strain imposed", "stress answering"]
    sphere = hypofab.Subspace.principal().directions(50)
    shaded = hypofab.plot_envelopes({"a": hypofab.probe(SAND, START, sphere), "b": hypofab.probe(SAND, START, sphere)})
    assert [axes.get_title() for axes in shaded.axes] == ["a", "b"]
    everywhere = hypofab.probe(SAND, START, hypofab.Subspace.all_components().directions(40))
    assert "angle between" in everywhere.plot().axes[0].get_xlabel()
    stress = hypofab.probe(SAND, START, sphere, impose="stress", size=1.0, unload=True)
    assert len(stress.plot(what="flow").axes) == 2
    axes = stress.plot(what="stiffness").axes[0]
    np.testing.assert_allclose(axes.lines[0].get_ydata(), 1e-3 * stress.stiffness)


def test_fabric_surface_names_the_anisotropy() -> None:
    fabric = hypofab.fabric_of_tensor([0.318, 0.362, 0.320, 0.001, -0.002, 0])
    (axes, _) = fabric.plot("dense").axes
    assert isinstance(axes, Axes)
    assert axes.get_title() == f"dense, $a$ = {fabric.anisotropy:.3f}"


@pytest.mark.parametrize(
    ("call", "expected"),
    [
        (lambda: hypofab.plot([]), "no test to draw"),
        (lambda: hypofab.plot_envelopes({}), "no probes to draw"),
        (lambda: hypofab.plot_fabrics({}), "no fabric to draw"),
        (lambda: hypofab.envelope(SAND, START).plot(what="rose"), "expected one of envelope, fan, flow, stiffness"),
        (lambda: hypofab.probe(SAND, START, [[1, 0.5, 0, 0, 0, 0]]).plot(), "at least two"),
    ],
)
def test_what_cannot_be_drawn(call: object, expected: str) -> None:
    with pytest.raises(hypofab.InputError, match=expected):
        call()


def test_an_unknown_kind(test: hypofab.TestResult) -> None:
    with pytest.raises(hypofab.InputError, match=r"expected one of stress_strain, .*accumulation"):
        test.plot("strain_stress")
