"""Running OpenGeoSys on the files of examples/fe/ogs, and reading what it wrote."""

import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from replay import PARAMETERS, Array, Start

ROOT = Path(__file__).resolve().parents[3]
EXAMPLES = ROOT / "examples" / "fe" / "ogs"
BUILD = Path(os.environ["HYPOFAB_BUILD"])
PROGRAM = BUILD / "cli" / "hypofab"
LIBRARY = BUILD / "umat" / "libhypofab_umat.so"
OGS = Path(os.environ["HYPOFAB_OGS"])


@dataclass(repr=False)
class Step:
    """One try of a time step."""

    time: float
    residuals: list[float]  #: norm of the residual before each Newton iteration, the converged one last
    accepted: bool
    refused: bool  #: by the behaviour


@dataclass(repr=False)
class Run:
    """What a run of the host left. Fields are per time, node and component, in the host's order."""

    times: Array
    points: Array
    fields: dict[str, Array]
    at_points: dict[str, Array]  #: per time, integration point and component
    steps: list[Step]

    def tensors(self, name: str, node: int = 0) -> Array:
        """A symmetric tensor at a node as tensor components xx yy zz xy xz yz, one row per time.

        Internal state variables keep the notation of the behaviour: xx yy zz and sqrt(2) times xy xz yz.
        """
        full = in_own_order(self.fields[name][:, node])
        if name == "delta":
            full[:, 4:] = full[:, [5, 4]]
            full[:, 3:] /= np.sqrt(2)
        return full

    def scalars(self, name: str, node: int = 0) -> Array:
        """A scalar at a node, one per time."""
        return self.fields[name][:, node, 0]


def prepare(folder: Path) -> None:
    """Make a folder with the example files, their meshes and the library, as a user would."""
    shutil.copytree(EXAMPLES, folder, dirs_exist_ok=True)
    subprocess.run([sys.executable, "mesh.py"], cwd=folder, check=True)
    (folder / LIBRARY.name).symlink_to(LIBRARY)


def parameters_of(path: Path) -> dict[str, list[float]]:
    """The constant parameters of a project file, those of the file it includes too."""
    roots = [ElementTree.parse(path).getroot().find("parameters")]
    included = path.with_name("sand_parameters.xml").read_text()
    roots.append(ElementTree.fromstring(f"<parameters>{included}</parameters>"))
    found = {}
    for parameter in (p for root in roots for p in root.findall("parameter")):
        values = parameter.find("values") if parameter.find("values") is not None else parameter.find("value")
        if values is not None:
            found[parameter.findtext("name")] = [float(v) for v in values.text.split()]
    return found


def start_of(path: Path) -> Start:
    """Read material and initial state of a project file."""
    values = parameters_of(path)
    stress, delta = [np.pad(values[name], (0, 6 - len(values[name]))) for name in ("stress", "delta")]
    props = [values[name][0] for name in PARAMETERS]
    return Start(props, stress[[0, 1, 2, 3, 5, 4]].tolist(), delta / [1, 1, 1, *[np.sqrt(2)] * 3], props[-1])


def run(project: Path, arguments: list[str] | None = None) -> Run:
    """Run a project file; results and log go to a folder beside it, named after it."""
    output = project.with_suffix("")
    output.mkdir()
    with open(output / "log", "w") as log:
        command = [OGS, *(arguments or []), "-o", output, project]
        environment = {**os.environ, "OMP_NUM_THREADS": "1"}
        status = subprocess.run(
            command, cwd=project.parent, env=environment, stdout=log, stderr=subprocess.STDOUT, timeout=900
        ).returncode
    text = (output / "log").read_text()
    assert status == 0, f"OpenGeoSys ended with status {status}:\n" + "\n".join(text.splitlines()[-30:])
    sets = ElementTree.parse(next(output.glob("*.pvd"))).getroot().iter("DataSet")
    times, files = zip(*((float(s.get("timestep")), output / s.get("file")) for s in sets), strict=True)
    pieces = [ElementTree.parse(file).getroot().find("UnstructuredGrid") for file in files]
    fields, at_points = (
        stack([arrays(piece, where) for piece in pieces]) for where in ("Piece/PointData", "FieldData")
    )
    points = arrays(pieces[0], "Piece/Points")["Points"]
    return Run(np.array(times), points, fields, at_points, steps_of_log(text))


def arrays(grid: ElementTree.Element, where: str) -> dict[str, Array]:
    """The arrays of numbers in a part of a VTU file in plain text: per point and component."""
    found = {}
    for array in grid.find(where):
        if array.get("type") == "Float64":
            components = int(array.get("NumberOfComponents", "1"))
            found[array.get("Name")] = np.array(array.text.split(), float).reshape(-1, components)
    return found


def stack(tables: list[dict[str, Array]]) -> dict[str, Array]:
    """Arrays over time from those of each time."""
    return {name: np.stack([table[name] for table in tables]) for name in tables[0]}


def in_own_order(values: Array) -> Array:
    """Components xx yy zz xy xz yz from the host's xx yy zz xy yz xz, or xx yy zz xy in the plane; one row per time."""
    full = np.zeros((len(values), 6))
    full[:, : values.shape[1]] = values
    full[:, 4:] = full[:, [5, 4]]
    return full


def steps_of_log(text: str) -> list[Step]:
    """The tries of all steps, from the log of a run with a criterion on the residual."""
    steps: list[Step] = []
    for line in text.splitlines():
        if match := re.search(r"Time step #(\d+) started. Time: (\S+). Step size", line):
            if int(match[1]) > 0:
                steps.append(Step(float(match[2].rstrip(".")), [], True, False))
        elif match := re.search(r"\|r\|=(\S+) \|r0\|", line):
            steps[-1].residuals.append(float(match[1]))
        elif "integration failed with status" in line:
            steps[-1].refused = True
        elif "The nonlinear solver failed" in line:
            steps[-1].accepted = False
    return steps
