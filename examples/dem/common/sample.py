"""Samples as files: the scene that later runs start from, and what they must know about it."""

import argparse
import json
from pathlib import Path

from yade import O

from common import export
from common.boundary import Boundary, PeriodicCell, WallBox
from common.folder import Folder, fail
from common.material import Material
from common.simulation import Simulation

SCENE = "sample.yade.gz"


def boundary_of(kind: str, dimension: int) -> Boundary:
    """The boundary named in a manifest."""
    return WallBox() if kind == WallBox.kind else PeriodicCell(dimension)


def write_sample(simulation: Simulation, title: str) -> dict:
    """Write scene, contacts and particles of a finished preparation; its numbers go to the manifest."""
    folder, boundary, material = simulation.folder, simulation.boundary, simulation.material
    boundary.set_rates([0.0] * 3)
    numbers = export.write_contacts(folder, "sample", boundary, material, title)
    export.write_particles(folder, "sample")
    O.save(str(folder.path / SCENE))
    simulation.write_history()
    return numbers | {"material": material.as_dict(), "boundary": boundary.kind, "notes": simulation.notes}


def finished_manifest(path: str, option: str) -> dict:
    """The manifest of a finished run that an option names."""
    file = Path(path) / "manifest.json"
    if not file.exists():
        fail(f"{file}: no such file; {option} expects the folder of a finished run")
    manifest = json.loads(file.read_text())
    if not manifest["finished"]:
        fail(f"{path}: this run has not finished; start it again to continue it")
    return manifest


def read_manifest(path: str) -> dict:
    """The manifest of a sample."""
    manifest = finished_manifest(path, "--sample")
    if not (Path(path) / SCENE).exists():
        fail(f"{path}: no {SCENE}; --sample expects the folder of a preparation or consolidation")
    return manifest


def dimension_of(path: str) -> int:
    """Of a sample: 2 or 3."""
    return read_manifest(path)["results"]["material"]["dimension"]


def sample_parameters(path: str) -> dict:
    """What the manifest of a run says of its sample: the name of the folder and the parameters of its preparation."""
    return {"sample": Path(path).resolve().name, "sample_parameters": read_manifest(path)["parameters"]}


def start_run(program: str, opt: argparse.Namespace, parameters: dict, **needs: object) -> Simulation | None:
    """The run of `program` from the sample of --sample in the folder of --out; None when it has finished before.

    needs: numbers of the sample's manifest that this program depends on, as dimension=2 or boundary="periodic cell".
    """
    before = read_manifest(opt.sample)["results"]
    found = {"dimension": before["material"]["dimension"], "boundary": before["boundary"]}
    for name, wanted in needs.items():
        if found[name] != wanted:
            fail(f"--sample {opt.sample}: its {name} is {found[name]}; {program} needs {wanted}")
    folder = Folder(opt.out, program, parameters | sample_parameters(opt.sample))
    if folder.finished:
        print(f"{opt.out}: finished before")
        return None
    simulation = load_sample(opt.sample, folder, opt.checkpoint)
    simulation.initial_stress = [1e3 * s for s in before["stress_kPa"]]
    return simulation


def load_sample(path: str, folder: Folder, checkpoint_every: float) -> Simulation:
    """Load a sample, or continue the run of this folder that had begun with it. The sample's strains are zero."""
    results = read_manifest(path)["results"]
    material = Material(**results["material"])
    simulation = Simulation(folder, material, boundary_of(results["boundary"], material.dimension), checkpoint_every)
    if not simulation.resume():
        O.load(str(Path(path) / SCENE))
        simulation.first_step = O.iter
        simulation.boundary.set_rates([0.0] * 3)
        simulation.connect()
        simulation.set_reference()
        O.step()  # forces on walls are not part of a saved scene
        simulation.record()
    return simulation
