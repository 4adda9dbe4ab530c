"""Running CalculiX on the decks of examples/fe/calculix; its table (.dat) and its list of increments (.sta)."""

import os
import re
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from replay import Array, Start

ROOT = Path(__file__).resolve().parents[3]
EXAMPLES = ROOT / "examples" / "fe" / "calculix"
BUILD = Path(os.environ["HYPOFAB_BUILD"])
PROGRAM = BUILD / "cli" / "hypofab"
CCX = Path(os.environ["HYPOFAB_CCX"])


@dataclass(repr=False)
class Run:
    """What a run of the host left, at the first point of the element: one row per increment that converged."""

    time: Array
    strain: Array  #: tensor components xx yy zz xy xz yz
    stress: Array  #: the same order; total stress where the UMAT holds pore water
    statev: Array  #: STATEV(1..13)
    attempts: list[tuple[int, bool]]  #: per try of an increment: its Newton iterations, and whether it was given up
    log: str


def start_of(model: str) -> Start:
    """Material and initial state in a model file of examples/fe/calculix."""
    text = (EXAMPLES / model).read_text()

    def data(keyword: str, lines: int) -> list[float]:
        after = text[re.search(rf"^\*{re.escape(keyword)}.*\n", text, flags=re.MULTILINE).end() :]
        return [float(v) for v in ",".join(after.splitlines()[:lines]).split(",")]

    props = data("USER MATERIAL", 2)
    delta = np.array(data("INITIAL CONDITIONS,TYPE=SOLUTION", 1)[2:]) * [1, 1, 1, 0.5, 0.5, 0.5]
    return Start(props, data("INITIAL CONDITIONS,TYPE=STRESS", 1)[2:], delta, props[15])


def run(deck: str, folder: Path, solution: str | None = None, edit: tuple[str, str, str] | None = None) -> Run:
    """Run a deck (its name without .inp) of examples/fe/calculix or of this folder, in a copy of the former.

    solution: lines in place of those of sand_cube.inp that give the state variables at the start; edit: file name, text
    to replace, and by what.
    """
    work = folder / "calculix"
    shutil.copytree(EXAMPLES, work)
    if solution is not None:
        model = work / "sand_cube.inp"
        lines = r"(?:\*INITIAL CONDITIONS,TYPE=SOLUTION\n.*\n)+"
        text, count = re.subn(lines, lambda _: solution, model.read_text())
        assert count == 1
        model.write_text(text)
    if edit is not None:
        name, old, new = edit
        text = (work / name).read_text()
        assert old in text
        (work / name).write_text(text.replace(old, new))
    for extra in Path(__file__).parent.glob("*.inp"):
        shutil.copy(extra, work)
    (work / "libHYPOFAB.so").symlink_to(BUILD / "umat" / "libhypofab_umat.so")
    search = os.pathsep.join(filter(None, [str(work), os.environ.get("LD_LIBRARY_PATH")]))
    environment = {**os.environ, "LD_LIBRARY_PATH": search, "OMP_NUM_THREADS": "1"}
    done = subprocess.run(
        [CCX, deck], cwd=work, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=600
    )
    finished = done.returncode == 0 and "Job finished" in done.stdout
    end_of_log = "\n".join(done.stdout.splitlines()[-30:])
    assert finished, f"CalculiX ended with status {done.returncode}:\n{end_of_log}"
    table = (work / f"{deck}.dat").read_text()
    time = np.array([float(t) for t in re.findall(r"stresses .* time\s+(\S+)", table)])
    attempts = re.findall(r"^\s*\d+\s+\d+\s+\d+(U?)\s+(\d+)\s", (work / f"{deck}.sta").read_text(), flags=re.MULTILINE)
    return Run(
        time,
        rows_of_table(table, "strains"),
        rows_of_table(table, "stresses"),
        rows_of_table(table, "internal state variables"),
        [(int(iterations), given_up == "U") for given_up, iterations in attempts],
        done.stdout,
    )


def rows_of_table(table: str, title: str) -> Array:
    """The values of the first integration point below each title of that name."""
    lines = re.findall(rf"^ {title} .*\n\n\s+1\s+1\s+(.*)$", table, flags=re.MULTILINE)
    return np.array([[float(v) for v in line.split()] for line in lines])
