"""The program hands the commands of the package to Python: which, with what, and what it says where there is none."""

import os
import subprocess
import sys
import venv
from pathlib import Path

import pytest

PROGRAM = os.environ.get("HYPOFAB_PROGRAM")

pytestmark = pytest.mark.skipif(PROGRAM is None, reason="HYPOFAB_PROGRAM does not name the program")


def program(*arguments: str, cwd: Path, **environment: str) -> subprocess.CompletedProcess[str]:
    kept = {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "HYPOFAB_PYTHON")}
    call = [os.path.abspath(str(PROGRAM)), *arguments]
    return subprocess.run(
        call, capture_output=True, text=True, timeout=60, check=False, cwd=cwd, env=kept | environment
    )


@pytest.fixture
def stand_in(tmp_path: Path) -> Path:
    """A folder with a package `hypofab` that tells what it was called with: whole, so before an installed one."""
    folder = tmp_path / "stand_in" / "hypofab"
    folder.mkdir(parents=True)
    (folder / "__init__.py").touch()
    code = "import sys\ndef main(arguments):\n  print(sys.executable, arguments)\n  return len(arguments)\n"
    (folder / "__main__.py").write_text(code)
    return folder.parent


def test_arguments_and_exit_code_pass_as_they_are(stand_in: Path, tmp_path: Path) -> None:
    arguments = ["plot", "a b", "", "$HOME;*", "--zoom"]
    done = program(*arguments, cwd=tmp_path, HYPOFAB_PYTHON=sys.executable, PYTHONPATH=str(stand_in))
    assert (done.stdout, done.stderr) == (f"{sys.executable} {arguments}\n", "")
    assert done.returncode == len(arguments)


def test_python3_of_the_path_is_taken_where_none_is_named(stand_in: Path, tmp_path: Path) -> None:
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin" / "python3").symlink_to(sys.executable)
    done = program("sweep", cwd=tmp_path, PYTHONPATH=str(stand_in), PATH=f"{tmp_path / 'bin'}:{os.environ['PATH']}")
    assert done.stdout == f"{tmp_path / 'bin' / 'python3'} ['sweep']\n"


def test_a_python_without_the_package_is_one_line(stand_in: Path, tmp_path: Path) -> None:
    venv.create(tmp_path / "bare")
    python = tmp_path / "bare" / "bin" / "python3"
    # In a folder with one named like the package, as beside a checkout: it is not taken for the package.
    done = program("plot", "results", cwd=stand_in, HYPOFAB_PYTHON=str(python))
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.count("\n") == 1
    assert "pip install hypofab" in done.stderr
    assert str(python) in done.stderr


def test_a_python_that_does_not_start_is_one_line(tmp_path: Path) -> None:
    done = program("plot", "results", cwd=tmp_path, HYPOFAB_PYTHON=str(tmp_path / "none"))
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.count("\n") == 1
    assert f"'{tmp_path / 'none'}' does not start" in done.stderr
