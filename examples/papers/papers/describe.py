"""What `hypofab describe` says of contact lists: the one thing for which the package has the program alone."""

import csv
import io
from pathlib import Path

import numpy as np

from hypofab.cli.launch import run, run_json
from hypofab.results import Array


def describe(contacts: Path, friction: float) -> dict:
    """Everything about one contact list; friction: angle between particles [deg]."""
    return run_json("describe", contacts, "--friction-angle", str(friction))


def describe_plane(lists: list[Path], friction: float) -> dict[str, Array]:
    """Columns by name for lists of a two-dimensional sample, one row per list; NaN where nothing is known."""
    options = ["--plane", "--csv", "--friction-angle", str(friction), "--sliding", "0.9999"]
    rows = list(csv.DictReader(io.StringIO(run("describe", *lists, *options))))
    return {
        name: np.array([float(row[name]) if row[name] else np.nan for row in rows])
        for name in rows[0]
        if name != "file"
    }
