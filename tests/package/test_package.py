"""What is in the archives, and what an installed package offers beside its functions."""

import ast
import inspect
import os
import re
import subprocess
import sys
import tarfile
import zipfile
from importlib.metadata import version
from pathlib import Path

import pytest

import hypofab
from hypofab import _core
from hypofab.cli.commands import COMMANDS
from hypofab.cli.launch import packaged_program

PACKAGE = Path(hypofab.__file__).parent
COMMAND = Path(sys.executable).with_name("hypofab")
MAIN = Path(__file__).parents[2] / "cli" / "main.c"


def archive(pattern: str) -> Path:
    folder = os.environ.get("HYPOFAB_DIST")
    if not folder:
        pytest.skip("HYPOFAB_DIST does not name the folder of the archives")
    (found,) = Path(folder).glob(pattern)
    return found


def run(*arguments: str | Path, expected: int = 0) -> str:
    environment = {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "HYPOFAB_PROGRAM")}
    done = subprocess.run(list(map(str, arguments)), capture_output=True, text=True, env=environment, check=False)
    assert done.returncode == expected, done.stderr
    return done.stdout + done.stderr


def test_the_wheel_holds_what_runs_and_nothing_else() -> None:
    names = zipfile.ZipFile(archive("*.whl")).namelist()
    assert {name.split("/")[0].split("-")[0] for name in names} == {"hypofab"}
    for wanted in (
        "py.typed",
        "_core.pyi",
        "__init__.pyi",
        "libhypofab.so.0.1",
        "bin/hypofab",
        "laboratory/catalogue.json",
        "model/described.pyi",
    ):
        assert f"hypofab/{wanted}" in names
    assert sum(name.endswith((".so.0.1", ".so")) for name in names) == 2


def test_the_source_archive_holds_what_builds() -> None:
    with tarfile.open(archive("*.tar.gz")) as file:
        names = {name.split("/", 1)[1] for name in file.getnames() if "/" in name}
    for wanted in (
        "CMakeLists.txt",
        "LICENSE",
        "python/extension/_core.pyf",
        "umat/memory/rate.f90",
        "include/hypofab.h",
    ):
        assert wanted in names
    assert not [name for name in names if name.startswith(("build", "out/", ".venv"))]


def test_versions_agree() -> None:
    assert version("hypofab") == hypofab.version()
    assert hypofab.version() in run(COMMAND, "--version")


def test_types_are_declared_for_every_function_of_the_extension() -> None:
    """f2py puts the call in the first line of the documentation: results = name(arguments)."""
    declarations = ast.parse((PACKAGE / "_core.pyi").read_text())
    found = {node.name: node for node in declarations.body if isinstance(node, ast.FunctionDef)}
    compiled = {name for name in dir(_core) if not name.startswith("_") and callable(getattr(_core, name))}
    assert set(found) == compiled
    for name, node in found.items():
        results, arguments = re.fullmatch(
            r"(?:(.*) = )?\w+\((.*)\)", getattr(_core, name).__doc__.splitlines()[0]
        ).groups()
        assert len(node.args.posonlyargs) == len(arguments.split(",") if arguments else []), name
        returned = ast.unparse(node.returns)
        count = returned.count(",") + 1 if returned.startswith("tuple") else int(returned != "None")
        assert count == len(results.split(",") if results else []), name


def test_types_are_declared_for_every_public_name() -> None:
    declarations = ast.parse((PACKAGE / "__init__.pyi").read_text())
    named = {alias.asname for node in declarations.body if isinstance(node, ast.ImportFrom) for alias in node.names}
    assert named == set(hypofab.__all__)
    for name in hypofab.__all__:
        value = getattr(hypofab, name)
        if inspect.isfunction(value) or inspect.isclass(value):
            assert value.__doc__, name


def test_importing_does_not_load_what_figures_need() -> None:
    code = "import sys, hypofab; hypofab.Material.sand('hostun'); assert 'matplotlib' not in sys.modules"
    run(sys.executable, "-c", code)


def test_the_command_is_the_program_and_the_python_commands(examples: Path, tmp_path: Path) -> None:
    assert "hochstetten" in run(COMMAND, "materials")
    assert "no_such_deck.yaml" in run(COMMAND, "run", "no_such_deck.yaml", expected=2)
    run(COMMAND, "run", examples / "oedometer.yaml", "-o", tmp_path)
    run(COMMAND, "plot", tmp_path)
    assert (tmp_path / "stress_strain.png").stat().st_size > 1000


def test_the_help_of_the_program_lists_the_commands_of_both_once() -> None:
    """And with the purpose that each has in its own help."""
    listed = re.findall(r"^  ([a-z][a-z-]*) +(.+)$", run(packaged_program(), "--help"), flags=re.MULTILINE)
    assert run(COMMAND, "--help") == run(packaged_program(), "--help")
    assert len(dict(listed)) == len(listed)
    assert COMMANDS.items() <= dict(listed).items()
    assert set(COMMANDS) == set(re.findall(r'^    \{"([a-z-]+)", cmd_python,', MAIN.read_text(), flags=re.MULTILINE))


def test_shells_complete_commands_of_python() -> None:
    script = MAIN.parent / "completion" / "hypofab.bash"
    line = 'source "$1"; COMP_WORDS=("$2" sw); COMP_CWORD=1; _hypofab; echo "${COMPREPLY[@]}"'
    assert run("bash", "-c", line, "bash", script, COMMAND) == "sweep\n"
