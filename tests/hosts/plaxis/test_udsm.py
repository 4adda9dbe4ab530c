"""One element in Kratos GeoMechanics through the interface of PLAXIS' user-defined soil models, against the driver."""

import csv
import json
import os
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest
from replay import Array, Start, differences_on_host_strain

ROOT = Path(__file__).resolve().parents[3]
EXAMPLES = ROOT / "examples" / "fe"
BUILD = Path(os.environ["HYPOFAB_BUILD"])
TOLERANCE = 1e-6
START = [-100.0, -100.0, -100.0, 0.0, 0.0, 0.0]  #: effective stress at the start of the examples

#: From xx yy zz xy yz zx, engineering shear, to tensor components xx yy zz xy xz yz.
ORDER = [0, 1, 2, 3, 5, 4]
TENSOR = np.array([1, 1, 1, 0.5, 0.5, 0.5])


def material(name: str = "sand.json") -> dict:
    """A materials file of the example, which has comments."""
    text = (EXAMPLES / "plaxis" / name).read_text()
    return json.loads(re.sub(r"^\s*//.*$", "", text, flags=re.MULTILINE))


def parameters_of(materials: dict) -> list[float]:
    """The 22 parameters of a materials file."""
    return materials["properties"][0]["Material"]["Variables"]["UMAT_PARAMETERS"]


def host(folder: Path, script: Path, *arguments: str) -> dict[str, Array]:
    """Run a script in the environment of Kratos; its last argument, the table, is added here."""
    table, log = folder / "host.csv", folder / "host.log"
    environment = {
        **os.environ,
        "LD_LIBRARY_PATH": os.pathsep.join(filter(None, [str(BUILD / "umat"), os.environ.get("LD_LIBRARY_PATH")])),
        "PYTHONPATH": str(EXAMPLES / "kratos"),
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    command = [os.environ["HYPOFAB_KRATOS_PYTHON"], script, *arguments, table]
    with open(log, "w") as output:
        status = subprocess.run(
            command, cwd=folder, env=environment, stdout=output, stderr=output, timeout=600
        ).returncode
    assert status == 0, f"Kratos ended with status {status}:\n" + "\n".join(log.read_text().splitlines()[-30:])
    with open(table, newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def tensor_of(columns: dict[str, Array], names: list[str], factor: Array) -> Array:
    """Six columns in PLAXIS' order as tensor components xx yy zz xy xz yz; those that plane strain lacks are zero."""
    zero = np.zeros_like(columns["time"])
    return np.stack([columns.get(names[i], zero) for i in ORDER], axis=1) * factor


def strain_of(columns: dict[str, Array]) -> Array:
    """Tensor components of the strain."""
    names = ["eps_xx", "eps_yy", "eps_zz", "gamma_xy", "gamma_yz", "gamma_xz"]
    return tensor_of(columns, names, TENSOR)


def compare(columns: dict[str, Array], parameters: list[float], folder: Path) -> None:
    """Stress, delta and void ratio of the host are those of the driver on the host's strain path."""
    delta = np.array(parameters[16:])[ORDER] * TENSOR
    stress = tensor_of(columns, [f"sig_{axes}" for axes in ("xx", "yy", "zz", "xy", "yz", "xz")], np.ones(6))
    statev = np.stack([columns[f"statev_{i + 1}"] for i in [*ORDER, *range(6, 13)]], axis=1)  # order of the UMAT
    start = Start(parameters[:16], START, delta, parameters[15])
    differences = differences_on_host_strain(
        BUILD / "cli" / "hypofab", folder, start, strain_of(columns), stress, statev
    )
    print(f"Newton iterations per step: at most {columns['iterations'].max():.0f}")
    assert max(differences) < TOLERANCE
    assert np.all(columns["statev_8"] == 0)  # pore pressure is the host's
    assert np.all(columns["statev_10"] >= 0)  # no increment was dropped
    assert columns["cycles"].max() == 1  # no step was repeated


def test_drained_triaxial_with_unloading(tmp_path: Path) -> None:
    columns = host(tmp_path, EXAMPLES / "plaxis" / "run_udsm.py", "drained_triaxial.json")
    compare(columns, parameters_of(material()), tmp_path)
    assert np.allclose(columns["sig_xx"], -100, rtol=1e-9)
    assert np.any(np.diff(columns["eps_zz"]) > 0)  # there and back
    assert columns["iterations"].max() <= 6  # the stiffness is that of the stress


def test_oedometer_with_unloading(tmp_path: Path) -> None:
    columns = host(tmp_path, EXAMPLES / "plaxis" / "run_udsm.py", "oedometer.json")
    compare(columns, parameters_of(material()), tmp_path)
    assert np.all(np.abs(columns["eps_xx"]) < 1e-15)
    assert np.any(np.diff(columns["eps_zz"]) > 0)


def test_plane_strain(tmp_path: Path) -> None:
    columns = host(tmp_path, EXAMPLES / "plaxis" / "run_udsm.py", "biaxial.json")
    compare(columns, parameters_of(material("sand_plane_strain.json")), tmp_path)
    assert np.allclose(columns["sig_xx"], -100, rtol=1e-9)
    assert np.all(columns["eps_zz"] == 0)


def test_order_and_shear_of_strain_stress_and_initial_delta(tmp_path: Path) -> None:
    materials = material()
    parameters = parameters_of(materials)
    parameters[16:] = [-4e-5, 3e-5, 2e-5, 5e-5, -8e-5, 3e-5]
    path = tmp_path / "materials.json"
    path.write_text(json.dumps(materials))
    columns = host(tmp_path, Path(__file__).parents[1] / "general_shear.py", str(path))
    assert np.abs(strain_of(columns)[-1]).min() > 1e-5
    compare(columns, parameters, tmp_path)


def test_parameters_that_cannot_be_used_stop_the_analysis(tmp_path: Path) -> None:
    materials = material()
    parameters_of(materials)[0] = 90.0  # friction angle
    path = tmp_path / "materials.json"
    path.write_text(json.dumps(materials))
    with pytest.raises(AssertionError, match="UDSM returns an error"):
        host(tmp_path, Path(__file__).parents[1] / "general_shear.py", str(path))
