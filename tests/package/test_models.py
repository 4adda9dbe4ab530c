"""Materials and states as the library describes them: no name of a parameter or variable is Python's own."""

import pickle
import runpy
from pathlib import Path

import numpy as np
import pytest

import hypofab

ROOT = Path(__file__).resolve().parents[2]


def test_the_stub_names_what_the_models_have() -> None:
    """Otherwise: python scripts/python_stub.py."""
    written = runpy.run_path(str(ROOT / "scripts" / "python_stub.py"))
    assert written["FILE"].read_text(encoding="utf-8") == written["text"](list(hypofab.models().values()))


def test_a_material_has_the_parameters_of_its_description(sand: hypofab.Material) -> None:
    assert list(sand) == list(hypofab.parameters()) == list(sand.model.parameters)
    assert sand.parameters() == {name: getattr(sand, name) for name in sand}
    assert hypofab.Material(**sand) == sand == pickle.loads(pickle.dumps(sand))
    assert len({sand, sand.replace(), sand.replace(h_s=2e6)}) == 2
    assert sand.memory_size == sand.R > 0
    assert sand.without_intergranular_strain().memory_size == 0
    with pytest.raises(AttributeError, match="not to be changed"):
        sand.h_s = 1.0


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda all_of: all_of | {"h": 1.0}, "no parameter 'h' of model 'sand', expected some of phi_c"),
        (lambda all_of: {name: value for name, value in all_of.items() if name != "h_s"}, "'h_s' is missing"),
    ],
)
def test_wrong_parameters_are_named(sand: hypofab.Material, change: object, message: str) -> None:
    with pytest.raises(hypofab.InputError, match=message):
        hypofab.Material(**change(sand.parameters()))
    with pytest.raises(hypofab.InputError, match="no model 'clay_of_mars'"):
        hypofab.Material("clay_of_mars")


def test_a_state_has_the_variables_of_its_description(state: hypofab.State) -> None:
    assert list(state.variables) == list(state.model.variables)
    assert hypofab.State(state.stress, **state.variables) == state == pickle.loads(pickle.dumps(state))
    assert np.array_equal(hypofab.State.isotropic(100, 0.7).delta, np.zeros(6))
    with pytest.raises(hypofab.InputError, match="model 'sand' has no state variable 'sensitivity'"):
        hypofab.State.isotropic(100, 0.7, sensitivity=2.0)
    with pytest.raises(AttributeError, match="not to be changed"):
        state.void_ratio = 1.0
    with pytest.raises(ValueError, match="read-only"):
        state.delta[0] = 1.0
