"""`hypofab dilatancy DIR`: stress-dilatancy and critical states of drained triaxial tests."""

import argparse
from pathlib import Path

from hypofab.cli.saving import save
from hypofab.figures.dilatancy import critical_states, stress_dilatancy
from hypofab.model.materials import Material
from hypofab.results.drained import read_drained


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The folder of results."""
    parser.add_argument("directory", metavar="DIR", type=Path, help="results of hypofab run")


def run(options: argparse.Namespace) -> None:
    """Draw both figures for each material."""
    groups, materials = read_drained(options.directory)
    for number, (name, tests) in enumerate(groups.items()):
        suffix = f"_{number + 1}" if len(groups) > 1 else ""
        ratio = stress_dilatancy({name: tests}, materials[name]["phi_c"])
        save(ratio, options.directory / f"stress_dilatancy{suffix}")
        save(
            critical_states({name: tests}, Material(**materials[name])), options.directory / f"critical_states{suffix}"
        )
