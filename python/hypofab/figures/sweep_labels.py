"""Labels of axes: names with units, from what the sweep tells or from what a quantity is."""

import re
from collections.abc import Mapping
from typing import Any

from hypofab.model.materials import parameters
from hypofab.sweeps.sweep import SweepResult

_STRESSES = re.compile(
    r"(sig|tot)_\w\w|p|q|q_signed|s|t|p_tot|pore_pressure|stress_work|work2|work2_min|stress|h_s|p_t|K_w"
)
_ANGLES = re.compile(r"phi_mob|lode|alpha|band_angle|band_dilatancy|phi_c")


def _unit_of_quantity(name: str, stress: str) -> str:
    if _STRESSES.fullmatch(name):
        return stress
    return "deg" if _ANGLES.fullmatch(name) else "-"


def _unit_of_path(path: str, stress: str) -> str:
    """Of a place in a deck: its last key says it."""
    key = re.sub(r"\[[^\]]*\]", "", path).split(".")[-1]
    if ".parameters." in path:
        unit = parameters()[key].unit if key in parameters() else ""
        return stress if unit == "stress" else unit
    return _unit_of_quantity(key, stress) if key in ("p", "stress", "void_ratio", "c") else ""


def label(result: SweepResult, name: str) -> str:
    """Name and unit of an input or output."""
    told = result.manifest["sweep"]
    deck = told.get("deck")
    stress = deck.get("unit", "kPa") if isinstance(deck, Mapping) else ""
    unit = result.unit(name)
    if not unit and stress and name in told["inputs"]:
        path = told["inputs"][name]["path"]
        unit = _unit_of_path(path if isinstance(path, str) else path[0], stress)
    elif not unit and stress:
        unit = _unit_of_quantity(_quantity(told["outputs"][name]), stress)
    return f"{name} [{unit}]" if unit else name


def abscissa_label(result: SweepResult, name: str) -> str:
    """Of the quantity that a curve is over."""
    told = result.manifest["sweep"]
    over = told["outputs"][name]["over"]
    stress = told["deck"].get("unit", "kPa") if isinstance(told.get("deck"), Mapping) else "stress"
    return f"{over} [{_unit_of_quantity(over, stress)}]"


def _quantity(output: Mapping[str, Any]) -> str:
    return str(output["quantity"])
