"""Each paper's discrete results beside ours: DEM runs of examples/dem, and element tests of the same samples."""

from collections.abc import Callable
from importlib import import_module
from pathlib import Path

from papers.runs import run_folders

PAPERS = {
    "000": "contact fabric and directional stiffness",
    "001": "strain probes of two-dimensional isotropic samples",
    "002": "fabric in stress cycles",
    "003": "sample preparation and biaxial tests",
    "004": "stress probes at failure",
    "family": "beyond the papers: samples of different anisotropy",
    "convergence": "beyond the papers: size of samples and rate of loading",
}
"""What is compared; docs/papers/README.md names the papers."""


def compare(paper: str, runs: Path, out: Path) -> str:
    """Compare one paper: write figures to `out` and return the text of its tables.

    runs: folder that holds the run folders of examples/dem under the names the paper's module lists, or the packed file
    that `keep` makes of them.
    """
    function: Callable[[Path, Path], str] = import_module(f"papers.paper_{paper}").compare
    out.mkdir(parents=True, exist_ok=True)
    with run_folders(runs) as folder:
        return function(folder, out)
