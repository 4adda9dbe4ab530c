"""Materials and states as the library describes them: no name of a parameter or variable is Python's own."""

import json
import pickle
import runpy
import subprocess
import sys
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


def test_a_material_without_parameters_of_the_memory_has_none() -> None:
    eight = {"phi_c": 33, "h_s": 1e6, "n": 0.25, "e_d0": 0.55, "e_c0": 0.95, "e_i0": 1.05, "alpha": 0.25, "beta": 1.5}
    assert hypofab.Material(**eight).memory_size == 0
    assert hypofab.Material(**eight, m_R=5).memory_size == 1e-4


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


TINY = """
import ctypes, json, sys
from pathlib import Path
import numpy as np
import hypofab
library = ctypes.CDLL(str(next(Path(hypofab.__file__).parent.glob("libhypofab.so*"))), ctypes.RTLD_GLOBAL)
tiny = ctypes.CDLL(sys.argv[1])
assert library.hypofab_model_register(ctypes.byref(ctypes.c_char.in_dll(tiny, "tiny_model"))) == 0
material = hypofab.Material("tiny", **json.loads(sys.argv[2]))
assert (material.memory_size, list(hypofab.sands())[-1]) == (0, "putty")
start = hypofab.State.isotropic(100, 0.8, model="tiny", age=0.5)
rate = hypofab.rate(material, start, [0, 0, -1, 0, 0, 0])
assert abs(rate.age - 1) < 1e-14 and np.allclose(rate.origin, [0, 0, -1, 0, 0, 0])
end = hypofab.update(material, start, [0, 0, -1e-3, 0, 0, 0]).state
assert abs(end.age - 0.501) < 1e-12
many = hypofab.update_many(material, np.tile(start.stress, (3, 1)), 0.8, [0, 0, -1e-3, 0, 0, 0], age=0.5)
assert many.instructions == "scalar" and np.allclose(many.stress, end.stress) and np.allclose(many.age, end.age)
assert not hypofab.probe(material, start, np.eye(6)).status.any()
until = ("eps_zz", -0.01)
loading = hypofab.Step(preset="drained_triaxial_compression", axis="z", until=until)
result = hypofab.element_test(material, start, loading).check()
assert np.allclose(result["origin_zz"][-1], -0.01, rtol=1e-6), result.rows.dtype.names
result.plot(), hypofab.plot(result, "compression")
hypofab.state_stability(material, start)
"""


def test_a_model_that_python_has_never_heard_of(tmp_path: Path) -> None:
    """One of the C tests, registered in a process of its own, with names of its own."""
    library = tmp_path / "tiny.so"
    source = ROOT / "tests" / "support" / "tiny_model.c"
    flags = ["-shared", "-fPIC", f"-I{ROOT}", f"-I{ROOT / 'include'}", f"-I{ROOT / 'tests'}"]
    subprocess.run(["cc", *flags, str(source), "-o", str(library)], check=True)
    done = subprocess.run(
        [sys.executable, "-c", TINY, str(library), json.dumps({"E": 1e4, "fade": 1.0})],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
