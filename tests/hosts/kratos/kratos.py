"""Running Kratos GeoMechanics on the files of examples/fe/kratos, in a process of its own."""

import csv
import json
import os
import re
import shutil
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from replay import Array, Start

ROOT = Path(__file__).resolve().parents[3]
EXAMPLES = ROOT / "examples" / "fe" / "kratos"
BUILD = Path(os.environ["HYPOFAB_BUILD"])
PROGRAM = BUILD / "cli" / "hypofab"
LIBRARY = BUILD / "umat"
PYTHON = Path(os.environ["HYPOFAB_KRATOS_PYTHON"])


def read_json(path: Path) -> dict:
    """A JSON file with comments, as Kratos allows them."""
    return json.loads(re.sub(r"^\s*//.*$", "", path.read_text(), flags=re.MULTILINE))


@dataclass(repr=False)
class Step:
    """The tries of one step of the host."""

    time: float
    residuals: list[list[float]]  #: per try, the residual norm before each Newton iteration and after the last

    @property
    def cuts(self) -> int:
        """How often the step was repeated at a smaller size."""
        return len(self.residuals) - 1


@dataclass(repr=False)
class Run:
    """What a run of the host left: columns of its table, and its steps."""

    columns: dict[str, Array]
    steps: list[Step] = field(default_factory=list)

    @property
    def strain(self) -> Array:
        """Tensor components xx yy zz xy xz yz of the first point, one row per step."""
        return self._tensor("eps", "gamma", 0.5)

    @property
    def stress(self) -> Array:
        """As strain; total stress where the UMAT holds pore water."""
        return self._tensor("sig", "sig", 1.0)

    @property
    def statev(self) -> Array:
        """STATEV(1..13), one row per step."""
        return np.stack([self.columns[f"statev_{i}"] for i in range(1, 14)], axis=1)

    def _tensor(self, normal: str, shear: str, factor: float) -> Array:
        zero = np.zeros_like(self.columns["time"])
        names = [f"{normal}_{axis}" for axis in ("xx", "yy", "zz")] + [f"{shear}_{axis}" for axis in ("xy", "xz", "yz")]
        scale = np.array([1, 1, 1, factor, factor, factor])
        return np.stack([self.columns.get(name, zero) for name in names], axis=1) * scale


def start_of(parameters: str) -> Start:
    """Read material and initial state of a parameter file in examples/fe/kratos."""
    settings = read_json(EXAMPLES / parameters)
    material = settings["solver_settings"]["material_import_settings"]["materials_filename"]
    variables = read_json(EXAMPLES / material)["properties"][0]["Material"]["Variables"]
    auxiliary = settings["processes"]["auxiliary_process_list"]
    stress = next(p for p in auxiliary if p["python_module"] == "apply_initial_uniform_stress_field")["Parameters"][
        "value"
    ]
    stress = [*stress[:4], stress[5], stress[4]] if len(stress) == 6 else [*stress, 0.0, 0.0]
    props, statev = variables["UMAT_PARAMETERS"], variables["STATE_VARIABLES"]
    delta = np.array(statev[:6]) * [1, 1, 1, 0.5, 0.5, 0.5]
    return Start(props, stress, delta, statev[6] or props[15])


def run(
    script: Path | str,
    arguments: list[str],
    folder: Path,
    edit: list[tuple[str, str, str]] | None = None,
    before: str = "",
) -> Run:
    """Run a Python script of the host in a copy of examples/fe/kratos; the last argument, added here, names its table.

    edit: file name, text to replace, and by what; before: a script to run first.
    """
    work = folder / "kratos"
    shutil.copytree(EXAMPLES, work)
    for name, old, new in edit or []:
        text = (work / name).read_text()
        assert old in text
        (work / name).write_text(text.replace(old, new))
    search = os.pathsep.join(filter(None, [str(LIBRARY), os.environ.get("LD_LIBRARY_PATH")]))
    environment = {**os.environ, "LD_LIBRARY_PATH": search, "PYTHONPATH": str(work)}
    if before:
        subprocess.run([PYTHON, before], cwd=work, env=environment, check=True)
    table, log = folder / "host.csv", folder / "host.log"
    with open(log, "w") as output:
        command = [PYTHON, script, *arguments, table]
        status = subprocess.run(
            command, cwd=work, env=environment, stdout=output, stderr=subprocess.STDOUT, timeout=900
        )
    text = log.read_text()
    assert status.returncode == 0, f"Kratos ended with status {status.returncode}:\n" + "\n".join(
        text.splitlines()[-30:]
    )
    with open(table, newline="") as file:
        rows = list(csv.DictReader(file))
    columns = {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}
    return Run(columns, steps_of_log(text, columns["time"]))


def steps_of_log(text: str, times: Array) -> list[Step]:
    """Residuals of every try of every step, from the log of a run with echo_level 2.

    A line of the criterion comes after each iteration and tells the norm before the first and the present one.
    """
    number = r"([-+.\w]+)"
    events = re.findall(
        rf"cycle:\s+(\d+)|Initial residual norm =\s+{number}; Current residual norm =\s+{number}\]", text
    )
    tries: list[tuple[int, list[float]]] = []
    for cycle, initial, current in events:
        if cycle:
            tries.append((int(cycle), []))
        else:
            residuals = tries[-1][1]
            if not residuals:
                residuals.append(float(initial))
            residuals.append(float(current))
    steps: list[Step] = []
    for cycle, residuals in tries:
        if cycle == 1:
            steps.append(Step(float(times[len(steps)]), []))
        steps[-1].residuals.append(residuals)
    return steps
