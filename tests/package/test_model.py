"""Rates, increments, tangents and many points, against the reference and against each other."""

import pickle
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import hypofab
from hypofab.tensors import norm


def material_of(case: dict, reference: dict) -> hypofab.Material:
    material = hypofab.Material(**reference["materials"][case["material"]])
    return material if case["intergranular"] else material.without_intergranular_strain()


def state_of(case: dict) -> hypofab.State:
    return hypofab.State(case["stress"], case["void_ratio"], case["intergranular_strain"])


def test_rates_are_those_of_the_reference(reference: dict) -> None:
    for case in reference["rates"]:
        rate = hypofab.rate(material_of(case, reference), state_of(case), case["stretching"])
        assert norm(rate.stress - case["stress_rate"]) <= 1e-12 * norm(case["stress_rate"])
        assert rate.void_ratio == pytest.approx(case["void_ratio_rate"], rel=1e-12)
        if case["intergranular"]:
            expected = case["intergranular_strain_rate"]
            assert norm(rate.delta - expected) <= 1e-12 * max(norm(expected), norm(case["stretching"]))
            assert rate.branch != hypofab.Branch.PLAIN


def test_increments_are_those_of_the_reference(reference: dict) -> None:
    for case in reference["strain_paths"]:
        material, state = material_of(case, reference), state_of(case)
        for leg, end in zip(case["strain_legs"], case["ends"], strict=True):
            state = hypofab.update(material, state, leg, tangent=False, tolerance=1e-10).state
            assert norm(state.stress - end["stress"]) <= 1e-6 * norm(end["stress"])
            assert state.void_ratio == pytest.approx(end["void_ratio"], abs=1e-8)


def test_linear_parts_add_up_to_the_rate(sand: hypofab.Material, state: hypofab.State) -> None:
    parts = hypofab.linear_parts(sand, state)
    for stretching in np.random.default_rng(1).normal(size=(20, 6)):
        along = np.sum(parts.direction * stretching * [1, 1, 1, 2, 2, 2])
        expected = parts.reversal @ stretching + parts.jump * max(along, 0)
        np.testing.assert_allclose(hypofab.rate(sand, state, stretching).stress, expected, rtol=1e-10, atol=1e-6)


def test_the_tangent_is_the_derivative_of_the_increment(sand: hypofab.Material, state: hypofab.State) -> None:
    strain = np.array([1e-4, 5e-5, -4e-4, 2e-5, 0, -3e-5])
    tangent = hypofab.update(sand, state, strain, tolerance=1e-10).tangent
    step = 1e-8
    for column in range(6):
        change = step * np.eye(6)[column]
        ends = [
            hypofab.update(sand, state, strain + way * change, tolerance=1e-12, tangent=False).state.stress
            for way in (1, -1)
        ]
        np.testing.assert_allclose(tangent[:, column], (ends[0] - ends[1]) / (2 * step), rtol=0, atol=2e-3 * 1e5)
    assert hypofab.update(sand, state, strain, tangent=False).tangent is None


def test_matrices_are_taken_in_place_of_components(sand: hypofab.Material, state: hypofab.State) -> None:
    matrix = hypofab.matrix(state.stress)
    assert matrix[0, 1] == matrix[1, 0] == state.stress[3]
    assert matrix[2, 1] == state.stress[5]
    assert hypofab.State(matrix, 0.7, hypofab.matrix(state.delta)) == state
    stretching = np.array([1, 2, -3, 0.5, 0.2, -0.1])
    given = hypofab.rate(sand, state, stretching)
    turned = hypofab.rate(sand, state, hypofab.matrix(stretching))
    assert np.array_equal(given.stress, turned.stress)
    with pytest.raises(hypofab.InputError, match="not symmetric"):
        hypofab.rate(sand, state, np.arange(9.0).reshape(3, 3))
    with pytest.raises(hypofab.InputError, match=r"stretching has the shape \(5,\), expected six components"):
        hypofab.rate(sand, state, np.zeros(5))


def random_points(n: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    random = np.random.default_rng(7)
    stress = -100 * np.array([1, 1, 1, 0, 0, 0]) + 15 * random.normal(size=(n, 6))
    delta = 1e-5 * random.normal(size=(n, 6))
    return stress, random.uniform(0.6, 0.8, n), 2e-4 * random.normal(size=(n, 6)), delta


@pytest.mark.parametrize("threads", [1, 2])
def test_many_points_are_updated_as_each_alone(sand: hypofab.Material, threads: int) -> None:
    stress, void_ratio, strain, delta = random_points(300)
    given = stress.copy()
    points = hypofab.update_many(sand, stress, void_ratio, strain, delta, threads=threads)
    assert np.array_equal(given, stress)
    for i in range(len(stress)):
        alone = hypofab.update(sand, hypofab.State(stress[i], void_ratio[i], delta[i]), strain[i], tangent=False).state
        assert norm(points.stress[i] - alone.stress) <= 1e-9 * norm(alone.stress)
        assert norm(points.delta[i] - alone.delta) <= 1e-9 * sand.R
        assert points.void_ratio[i] == pytest.approx(alone.void_ratio, rel=1e-10)
    turned = hypofab.update_many(sand, hypofab.matrix(stress), void_ratio, hypofab.matrix(strain), delta)
    assert np.array_equal(turned.stress, points.stress)


def test_one_bad_point_leaves_the_others_alone(sand: hypofab.Material) -> None:
    stress, void_ratio, strain, delta = random_points(5)
    stress[3, :3] = 10
    with pytest.raises(hypofab.HypofabError, match=r"1 of 5 points failed; the first is point 3"):
        hypofab.update_many(sand, stress, void_ratio, strain, delta)
    points = hypofab.update_many(sand, stress, void_ratio, strain, delta, check_points=False)
    assert list(points.status.astype(bool)) == [False, False, False, True, False]
    assert np.array_equal(points.stress[3], stress[3])
    assert not np.array_equal(points.stress[2], stress[2])
    assert len(hypofab.update_many(sand, np.zeros((0, 6)), 0.7, strain[0]).stress) == 0
    with pytest.raises(hypofab.InputError, match="strain is of 4 points, stress of 5"):
        hypofab.update_many(sand, stress, void_ratio, strain[:4], delta)


def test_errors_carry_status_and_message(sand: hypofab.Material, state: hypofab.State) -> None:
    with pytest.raises(hypofab.InputError, match="phi_c") as bad:
        hypofab.Material(**(dict(sand.parameters()) | {"phi_c": -3.0})).check()
    assert bad.value.status is hypofab.Status.BAD_MATERIAL
    assert isinstance(bad.value, ValueError)
    copy = pickle.loads(pickle.dumps(bad.value))
    assert (str(copy), copy.status) == (str(bad.value), bad.value.status)
    with pytest.raises(hypofab.InputError, match="void_ratio") as bad:
        hypofab.State(state.stress, -0.1).check(sand)
    assert bad.value.status is hypofab.Status.BAD_STATE
    with pytest.raises(hypofab.InputError, match="expected one of paper000, hochstetten"):
        hypofab.Material.sand("sahara")
    with pytest.raises(hypofab.PhysicalError) as stopped:
        hypofab.update(sand, hypofab.State.isotropic(10, 0.7), [0.5, 0.5, 0.5, 0, 0, 0])
    assert stopped.value.status is hypofab.Status.OUT_OF_DOMAIN


def test_messages_belong_to_their_thread(sand: hypofab.Material) -> None:
    def message_of(value: float) -> str:
        with pytest.raises(hypofab.InputError) as bad:
            hypofab.Material(**(dict(sand.parameters()) | {"phi_c": value})).check()
        return str(bad.value)

    values = [-float(i) for i in range(1, 200)]
    with ThreadPoolExecutor(4) as executor:
        for value, message in zip(values, executor.map(message_of, values), strict=True):
            assert f"{value:g}" in message


def test_objects_cannot_be_changed(sand: hypofab.Material, state: hypofab.State) -> None:
    with pytest.raises(AttributeError, match="not to be changed"):
        sand.h_s = 1.0
    with pytest.raises(ValueError, match="read-only"):
        state.stress[0] = 1.0
    assert pickle.loads(pickle.dumps(state)) == state
    assert pickle.loads(pickle.dumps(sand)) == sand
    assert state.p == pytest.approx(400 / 3)
    assert hypofab.Material.from_numbers(sand.numbers()) == sand


def test_sands_and_parameters_are_described() -> None:
    assert {"hochstetten", "karlsruhe_fine", "paper000"} <= set(hypofab.sands())
    for sand in hypofab.sands().values():
        assert sand.description
        assert sand.source
        sand.material.check()
        for name, parameter in hypofab.parameters().items():
            if sand.material.m_R == 0 and name in ("m_T", "R", "beta_r", "chi"):
                continue
            assert parameter.lower <= getattr(sand.material, name) <= parameter.upper
