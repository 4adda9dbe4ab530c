"""Which files of the project use which: includes, calls and imports, read from the sources alone.

In C a .c file and its .h of the same name are one unit. A unit uses another one if it includes its header, or names a
function or table that the other one defines. Module-level names in Python stand for their file.
"""

import ast
import re
from collections.abc import Iterable, Mapping
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
C_ROOMS = ("base", "umat", "driver", "fabric2delta", "calibration", "sampling", "deck", "cli", "python/extension")

Uses = Mapping[str, set[str]]


def unit(path: str) -> str:
    """The unit of a C file."""
    return path.rpartition(".")[0]


def c_files() -> dict[str, str]:
    """Text of every C file of the rooms by its path, without comments and strings (but for those of includes)."""
    found = {}
    for room in C_ROOMS:
        for path in sorted((ROOT / room).rglob("*.[ch]")):
            text = re.sub(r"/\*.*?\*/|//[^\n]*", " ", path.read_text(), flags=re.DOTALL)
            lines = [
                line if line.lstrip().startswith("#include") else re.sub(r'"(?:[^"\\]|\\.)*"', '""', line)
                for line in text.splitlines()
            ]
            found[path.relative_to(ROOT).as_posix()] = "\n".join(lines)
    return found


def includes(text: str) -> list[str]:
    """What a C file includes: paths from the root for those of the project, names in <> for others."""
    quoted = re.findall(r'^\s*#\s*include\s+"([^"]+)"', text, re.MULTILINE)
    return quoted + [f"<{name}>" for name in re.findall(r"^\s*#\s*include\s+<([^>]+)>", text, re.MULTILINE)]


def definitions(text: str) -> set[str]:
    """Names of functions and tables that a .c file defines for others. Definitions begin in the first column."""
    functions = re.findall(
        r"^(?!static\b|typedef\b|extern\b|return\b|else\b)\w[\w \*]*?\b(\w+)\([^;{}]*\)\s*\{", text, re.MULTILINE
    )
    tables = re.findall(r"^(?:const\b)[\w \*]*?\b(\w+)(?:\[[^\]]*\])*\s*=", text, re.MULTILINE)
    return set(functions + tables)


def c_uses() -> dict[str, set[str]]:
    """The units that each unit of C uses, itself left out."""
    files = c_files()
    home = {name: unit(path) for path, text in files.items() if path.endswith(".c") for name in definitions(text)}
    uses: dict[str, set[str]] = {unit(path): set() for path in files}
    for path, text in files.items():
        mine = uses[unit(path)]
        mine |= {unit(name) for name in includes(text) if name in files}
        words = set(re.findall(r"\b[a-zA-Z_]\w+\b", text))
        # What a header declares is not used by it.
        if path.endswith(".c"):
            mine |= {home[word] for word in words & home.keys()}
        mine.discard(unit(path))
    return uses


def python_files() -> dict[str, ast.Module]:
    """Syntax tree of every module of the package by its name, "hypofab.decks"."""
    found = {}
    for path in sorted((ROOT / "python/hypofab").rglob("*.py")):
        parts = path.relative_to(ROOT / "python").with_suffix("").parts
        found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = ast.parse(path.read_text())
    return found


def python_imports(tree: ast.Module) -> set[str]:
    """Modules that a module imports, anywhere but for type checkers: "numpy.typing", "hypofab.decks.Step"."""
    skipped: set[int] = set()
    found = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.If) and ast.unparse(node.test).endswith("TYPE_CHECKING"):
            skipped |= {id(inner) for child in node.body for inner in ast.walk(child)}
        if id(node) in skipped:
            continue
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            found |= {f"{node.module}.{alias.name}" for alias in node.names}
    return found


def python_uses() -> dict[str, set[str]]:
    """The modules of the package that each module uses. Importing from a package whose __init__ has the name counts
    as using that __init__.
    """
    files = python_files()
    uses = {}
    for name, tree in files.items():
        used = set()
        for imported in python_imports(tree):
            parent = imported.rpartition(".")[0]
            used |= {imported} & files.keys() or {parent} & files.keys()
        uses[name] = used - {name}
    return uses


def circles(uses: Uses) -> list[list[str]]:
    """Groups of files each of which uses every other one, directly or by way of others (Tarjan)."""
    order: dict[str, int] = {}
    low: dict[str, int] = {}
    stack: list[str] = []
    found: list[list[str]] = []

    def visit(name: str) -> None:
        order[name] = low[name] = len(order)
        stack.append(name)
        for other in uses.get(name, ()):
            if other not in order:
                visit(other)
                low[name] = min(low[name], low[other])
            elif other in stack:
                low[name] = min(low[name], order[other])
        if low[name] == order[name]:
            group = stack[stack.index(name) :]
            del stack[stack.index(name) :]
            if len(group) > 1:
                found.append(sorted(group))

    for name in uses:
        if name not in order:
            visit(name)
    return sorted(found)


def arrows(group: Iterable[str], uses: Uses) -> str:
    """The uses within a group, for messages."""
    members = set(group)
    return "; ".join(f"{one} -> {', '.join(sorted(uses[one] & members))}" for one in sorted(members))
