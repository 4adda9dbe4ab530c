"""Many small probes from one state. Each begins with the same saved scene; an interrupted run goes on with the next."""

import json
import time
from collections.abc import Callable

from yade import O

from common.simulation import Simulation

BASE = "base.yade.gz"


def save_base(simulation: Simulation) -> None:
    """Save the state from which all probes begin."""
    simulation.boundary.set_rates([0.0] * 3)
    O.save(str(simulation.folder.path / BASE))


def run_probes(simulation: Simulation, names: list[str], probe: Callable[[str], list[float]]) -> list[list[float]]:
    """Run the probes that have not yet run; the row of each is kept in rows.json, so that it runs only once.

    probe: gets the name, finds the scene as save_base left it and returns a row of numbers.
    """
    folder = simulation.folder
    file = folder.path / "rows.json"
    rows: dict[str, list[float]] = json.loads(file.read_text()) if file.exists() else {}
    started = time.time()
    for number, name in enumerate(names):
        if name in rows:
            continue
        O.load(str(folder.path / BASE))
        simulation.connect()
        simulation.set_reference()
        rows[name] = [float(x) for x in probe(name)]
        folder.write_json("rows.json", rows)
        folder.manifest["seconds"] = round(folder.seconds, 1)
        folder.write_manifest()
        print(f"probe {number + 1} of {len(names)}: {name}, {time.time() - started:.0f} s", flush=True)
    return [rows[name] for name in names]


def clear(simulation: Simulation) -> None:
    """Remove the files that only an interrupted run needs."""
    for name in (BASE, "rows.json"):
        (simulation.folder.path / name).unlink(missing_ok=True)
