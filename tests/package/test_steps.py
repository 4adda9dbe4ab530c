"""Steps as objects: the keys of decks, parameters of presets among them, as the library knows them."""

import pytest

import hypofab
from hypofab.decks.steps import Step

START = hypofab.State.isotropic(100, 0.7)


def test_a_step_is_its_keys() -> None:
    step = Step(
        preset="radial_constant_p", axis="z", lode=30, until=("eps_q", 0.01), rows=None, more={"drive": "strain"}
    )
    expected = {"preset": "radial_constant_p", "axis": "z", "lode": 30, "drive": "strain"}
    assert step.mapping() == expected | {"until": {"quantity": "eps_q", "value": 0.01}}
    assert step == Step(**expected, until={"quantity": "eps_q", "value": 0.01})
    assert step != Step(preset="radial_constant_p")


def test_parameters_reach_the_library_and_wrong_ones_are_refused(sand: hypofab.Material) -> None:
    step = Step(preset="radial_constant_p", axis="z", lode=40, until=("eps_q", 0.01), rows=5)
    assert hypofab.element_test(sand, START, step).rows["lode"][-1] == pytest.approx(40, abs=1e-5)
    with pytest.raises(hypofab.InputError, match="takes no 'b', expected among axis, rate, drive, lode"):
        hypofab.element_test(sand, START, Step(preset="radial_constant_p", axis="z", b=1, until=("eps_q", 0.01)))
    with pytest.raises(hypofab.InputError, match="speed"):
        hypofab.element_test(sand, START, Step(preset="radial_constant_p", axis="z", speed=1, until=("eps_q", 0.01)))
