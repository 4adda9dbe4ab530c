"""One folder per run: manifest, checkpoint, tables. Every file appears whole or not at all."""

import gzip
import json
import os
import platform
import sys
import time
from collections.abc import Iterable
from pathlib import Path

import numpy as np
from yade import Omega


def fail(message: str) -> None:
    """End the script with exit code 2, as `hypofab` does for bad input."""
    sys.stderr.write(f"error: {message}\n")
    sys.stderr.flush()
    os._exit(2)  # YADE turns SystemExit of a script into exit code 1 and a stack trace


def versions() -> dict:
    """The versions that decide whether a run can be repeated to the last bit."""
    import yade.config

    return {"yade": yade.config.version, "python": platform.python_version(), "numpy": np.__version__}


class Folder:
    """The folder of one run.

    A folder belongs to one program with one set of parameters: started again with the same ones it continues, with
    others it refuses.
    """

    def __init__(self, path: str, program: str, parameters: dict) -> None:
        """Open the folder, or make it with a manifest of these parameters."""
        self.path = Path(path)
        self.parameters = parameters
        file = self.path / "manifest.json"
        wanted = {"program": program, "parameters": json.loads(json.dumps(parameters))}
        if file.exists():
            self.manifest = json.loads(file.read_text())
            for key, value in wanted.items():
                if self.manifest.get(key) != value:
                    fail(f"{file}: {key} {self.manifest.get(key)}, but this run has {value}; choose another --out")
        else:
            self.path.mkdir(parents=True, exist_ok=True)
            self.manifest = wanted | {"versions": versions(), "results": {}, "seconds": 0.0, "finished": False}
            self.write_manifest()
        self.started = time.time() - self.manifest["seconds"]

    @property
    def finished(self) -> bool:
        """Whether the run has reached its end."""
        return self.manifest["finished"]

    @property
    def seconds(self) -> float:
        """Wall clock time spent on this run, also before it was interrupted [s]."""
        return time.time() - self.started

    def write(self, name: str, text: str) -> None:
        """Write a text file; a name that ends in .gz is compressed, without a date: equal runs give equal files."""
        data = text.encode()
        if name.endswith(".gz"):
            data = gzip.compress(data, mtime=0)
        path = self.path / name
        temporary = path.with_name(path.name + ".part")
        temporary.write_bytes(data)
        temporary.replace(path)

    def write_json(self, name: str, value: object) -> None:
        """Write a JSON file."""
        self.write(name, json.dumps(value, indent=1) + "\n")

    def write_manifest(self) -> None:
        """Write manifest.json."""
        self.write_json("manifest.json", self.manifest)

    def write_table(
        self, name: str, comments: list[str], columns: list[str], rows: Iterable, formats: list[str]
    ) -> None:
        """Write a text table: comment lines, one line of column names, one line per row."""
        lines = [f"# {comment}" for comment in comments] + ["# " + " ".join(columns)]
        pattern = " ".join(formats)
        lines += [pattern % tuple(row) for row in rows]
        self.write(name, "\n".join(lines) + "\n")

    def save_checkpoint(self, scene: Omega, state: dict) -> None:
        """Save the scene and the state of the script. The two are tied by the name in checkpoint.json."""
        name = f"checkpoint_{scene.iter}.yade.gz"
        scene.save(str(self.path / name))
        self.write_json("checkpoint.json", {"scene": name, "state": state, "seconds": self.seconds})
        for old in self.path.glob("checkpoint_*.yade.gz"):
            if old.name != name:
                old.unlink()

    def load_checkpoint(self, scene: Omega) -> dict | None:
        """Load what the last checkpoint saved; None when there is none."""
        file = self.path / "checkpoint.json"
        if not file.exists():
            return None
        checkpoint = json.loads(file.read_text())
        scene.load(str(self.path / checkpoint["scene"]))
        self.started = time.time() - checkpoint["seconds"]
        return checkpoint["state"]

    def finish(self, results: dict) -> None:
        """Mark the run as finished, record its results and drop the checkpoint."""
        self.manifest.update(results=results, seconds=round(self.seconds, 1), finished=True)
        self.write_manifest()
        (self.path / "checkpoint.json").unlink(missing_ok=True)
        for old in self.path.glob("checkpoint_*.yade.gz"):
            old.unlink()
