"""From grain contacts to finite elements: hypoplasticity of sand with intergranular strain.

Most names below need the compiled library (`pip install .`); results and figures of files do not.
docs/python.md shows how they are used; __init__.pyi names them to type checkers.
"""

from importlib import import_module

from hypofab.errors import HypofabError, InputError, InternalError, PhysicalError, Status

_HOMES = {
    "calibration.calibrate": ("Calibration", "calibrate"),
    "decks.steps": ("Step", "Test"),
    "decks.stiffness": ("FitOfC", "Stiffness"),
    "decks.study": ("Study", "element_test", "run"),
    "fabric.changes": (
        *("Directions", "Estimate", "FabricChange", "FabricResponse", "MechanismFit", "Rose"),
        *("changes", "directions", "fit_fabric_response"),
    ),
    "fabric.samples": (
        *("Fabric", "InitialDelta", "Significance", "fabric_of_file", "fabric_of_normals", "fabric_of_tensor"),
        "weights",
    ),
    "fabric.uncertainty": ("Interval", "Uncertainty", "bootstrap"),
    "figures.memory": ("plot", "plot_directions", "plot_envelopes", "plot_fabrics"),
    "library": ("version",),
    "model.materials": ("Material", "Sand", "parameters", "sands"),
    "model.points": (
        *("Branch", "Increment", "LinearParts", "Points", "Rate"),
        *("linear_parts", "rate", "update", "update_many"),
    ),
    "model.probing": ("Stability", "Subspace", "envelope", "fit_ellipsoid", "probe", "state_stability", "triangles"),
    "model.registry": ("Model", "Parameter", "Variable", "models"),
    "model.states": ("State",),
    "results.calibration": ("CalibrationResult", "FreeParameter", "LabComparison"),
    "results.element_tests": ("TestResult",),
    "results.probes": ("Ellipsoid", "Probes"),
    "sampling": ("quasi_random",),
    "sweeps.sobol_indices": ("SobolIndices", "sobol", "sobol_indices"),
    "sweeps.sweep": ("SweepResult", "read_sweep", "sweep"),
    "tensors": ("COMPONENTS", "components", "matrix"),
}
_HOME = {name: home for home, names in _HOMES.items() for name in names}

__all__ = ["HypofabError", "InputError", "InternalError", "PhysicalError", "Status", *_HOME]


def __getattr__(name: str) -> object:
    """Load a name when it is asked for: a source tree without the compiled library can be imported all the same."""
    if name not in _HOME:
        raise AttributeError(f"module 'hypofab' has no attribute '{name}'")
    value = getattr(import_module(f"hypofab.{_HOME[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """The public names."""
    return sorted(__all__)
