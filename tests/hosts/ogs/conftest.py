"""What the tests in OpenGeoSys share; the helpers of host tests are found above them."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from opengeosys import prepare


@pytest.fixture(scope="session")
def examples(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the example files, their meshes and the library."""
    folder = tmp_path_factory.mktemp("ogs")
    prepare(folder)
    return folder
