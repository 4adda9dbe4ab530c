"""Probes, envelopes and stability against the rate equation."""

import numpy as np
import pytest

import hypofab
from hypofab.tensors import norm


def test_probes_by_strain_rates_are_rates(sand: hypofab.Material, state: hypofab.State) -> None:
    directions = hypofab.Subspace.all_components().directions(24)
    np.testing.assert_allclose(norm(directions), 1)
    probes = hypofab.probe(sand, state, directions)
    assert not probes.status.any()
    for direction, response in probes:
        np.testing.assert_allclose(response, hypofab.rate(sand, state, direction).stress, rtol=1e-12, atol=1e-8)
    np.testing.assert_allclose(probes.stiffness, norm(probes.response))


def test_probes_by_stress_are_answered_by_strain_that_gives_it(sand: hypofab.Material, state: hypofab.State) -> None:
    probes = hypofab.probe(sand, state, hypofab.Subspace.principal().directions(20), impose="stress")
    for direction, response in probes:
        np.testing.assert_allclose(hypofab.rate(sand, state, response).stress, direction, atol=1e-9)


def test_the_envelope_of_the_plain_model_is_an_ellipse_around_n(sand: hypofab.Material) -> None:
    plain, state = sand.without_intergranular_strain(), hypofab.State([-100, -100, -200, 0, 0, 0], 0.7)
    envelope = hypofab.envelope(plain, state, n=36, axis="z")
    fit = hypofab.fit_ellipsoid(hypofab.Subspace.axisymmetric("z"), envelope)
    np.testing.assert_allclose(fit.centre, hypofab.linear_parts(plain, state).jump, rtol=1e-9, atol=1e-6)
    assert fit.points == len(envelope) == 36
    assert fit.distance < 1e-9 < fit.nonlinearity
    assert fit.axis.shape == (2, 6)


def test_unloading_leaves_what_is_irrecoverable(sand: hypofab.Material, state: hypofab.State) -> None:
    directions = hypofab.Subspace.plane([1, 0, 0, 0, 0, 0], [0, 1, 0, 0, 0, 0]).directions(8)
    probes = hypofab.probe(sand, state, directions, size=1e-4, unload=True)
    assert np.isfinite(probes.irrecoverable).all()
    assert np.isnan(hypofab.probe(sand, state, directions).irrecoverable).all()


def test_coordinates_are_isometric() -> None:
    space = hypofab.Subspace.principal(np.diag([1.0, 2, 3]))
    directions = space.directions(30)
    np.testing.assert_allclose(np.linalg.norm(space.coordinates(directions), axis=1), norm(directions))
    corners = hypofab.triangles(30)
    assert corners.shape == (56, 3)
    assert set(corners.ravel()) == set(range(30))


def test_the_smallest_second_order_work_is_that_of_its_direction(sand: hypofab.Material, state: hypofab.State) -> None:
    found = hypofab.state_stability(sand, state)
    work = np.sum(hypofab.rate(sand, state, found.work_direction).stress * found.work_direction * [1, 1, 1, 2, 2, 2])
    assert work == pytest.approx(found.work, rel=1e-9)
    for direction in hypofab.Subspace.all_components().directions(200):
        rate = hypofab.rate(sand, state, direction)
        assert np.sum(rate.stress * direction * [1, 1, 1, 2, 2, 2]) >= found.work * (1 - 1e-9)
    assert np.linalg.norm(found.band_normal) == pytest.approx(1)


def test_wrong_arguments_are_refused(sand: hypofab.Material, state: hypofab.State) -> None:
    with pytest.raises(hypofab.InputError, match="axis = 'q', expected x, y or z"):
        hypofab.envelope(sand, state, axis="q")
    with pytest.raises(hypofab.InputError, match="parallel"):
        hypofab.Subspace.plane([1, 0, 0, 0, 0, 0], [2, 0, 0, 0, 0, 0])
    with pytest.raises(hypofab.InputError, match="impose = 'work', expected strain or stress"):
        hypofab.probe(sand, state, np.eye(6), impose="work")
    with pytest.raises(hypofab.InputError):
        hypofab.triangles(3)
