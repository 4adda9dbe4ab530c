"""Sphinx extension: what the program, its schema and the package say of themselves, put where a page asks for it.

A line `<!-- generated: NAME -->` of a page is replaced before the page is read.
"""

import json
import os
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import fortran_modules
from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment

import hypofab

PROGRAM = Path(hypofab.__file__).parent / "bin" / "hypofab"
PLACE = re.compile(r"^<!-- generated: (.+) -->$", flags=re.MULTILINE)
LINK = re.compile(r"\[([^\]\[]*)\]\((\.\./[^)#]*)\)")
ROOT = Path(__file__).resolve().parents[2]


def output(*command: str | Path) -> str:
    """What a command prints, at the width of a page."""
    environment = os.environ | {
        "COLUMNS": "100",
        "ARGP_HELP_FMT": "rmargin=100",
        "NO_COLOR": "1",
        "HYPOFAB_PYTHON": sys.executable,
    }
    return subprocess.run(command, check=True, capture_output=True, text=True, env=environment).stdout


def fenced(text: str) -> str:
    """A text as it is."""
    return f"```text\n{text.rstrip()}\n```"


def commands(_: Sphinx) -> str:
    """Every command of the program, those that it hands to Python among them, with its help."""
    overview = output(PROGRAM, "--help")
    names = re.findall(r"^  ([a-z][a-z-]*) +\S", overview, flags=re.MULTILINE)
    parts = ["## hypofab", fenced(overview)]
    parts += [f"### hypofab {name}\n\n{fenced(output(PROGRAM, name, '--help'))}" for name in names]
    return "\n\n".join(parts)


def kind(schema: dict[str, Any]) -> str:
    """What values a schema admits, in words."""
    if "enum" in schema:
        return ", ".join(f"`{value}`" for value in schema["enum"])
    if "const" in schema:
        return f"`{schema['const']}`"
    for word in ("anyOf", "oneOf"):
        if word in schema:
            return " or ".join(dict.fromkeys(kind(one) for one in schema[word]))
    of = schema.get("type", "anything")
    if of == ["string", "number"]:
        return "text"
    if of == "array":
        least, most = schema.get("minItems", 0), schema.get("maxItems")
        count = f"{least} " if least and least == most else f"at least {least} " if least else ""
        return f"list of {count}{kind(schema.get('items', {}))}"
    if isinstance(of, list):
        return " or ".join(kind({"type": one}) for one in of)
    return {"object": "mapping", "boolean": "`true` or `false`", "string": "text"}.get(of, of)


def mappings(schema: dict[str, Any], path: str) -> Iterator[tuple[str, dict[str, Any]]]:
    """The mappings within a schema, with the path of each."""
    for word in ("anyOf", "oneOf"):
        for one in schema.get(word, ()):
            yield from mappings(one, path)
    if "items" in schema:
        yield from mappings(schema["items"], f"{path}[]")
    if "properties" in schema:
        yield path, schema
        for key, value in schema["properties"].items():
            yield from mappings(value, f"{path}.{key}".lstrip("."))


def deck_keys(_: Sphinx) -> str:
    """A table for each mapping of a deck."""
    parts = []
    for path, mapping in mappings(json.loads(output(PROGRAM, "schema")), ""):
        rows = [
            f"| `{key}` | {kind(value)} | {'required' if key in mapping.get('required', ()) else ''} |"
            for key, value in mapping["properties"].items()
        ]
        title = f"`{path}`" if path else "The whole deck"
        parts.append("\n".join([f"## {title}\n", "| key | value | |", "|---|---|---|", *rows]))
    return "\n\n".join(parts)


def python_names(_: Sphinx) -> str:
    """Every public name, by the module that it lives in."""
    parts = []
    for module, names in hypofab._HOMES.items():
        lines = [f".. automodule:: hypofab.{module}", "   :no-members:", ""]
        for name in names:
            value = getattr(hypofab, name)
            directive = "autoclass" if isinstance(value, type) else "autofunction" if callable(value) else "autodata"
            lines += [f".. {directive}:: hypofab.{module}.{name}"]
            lines += ["   :members:", "   :undoc-members:"] * (directive == "autoclass") + [""]
        parts.append(f"## hypofab.{module}\n\n```{{eval-rst}}\n" + "\n".join(lines) + "```")
    lines = [".. automodule:: hypofab.errors", "   :members:", ""]
    parts.append("## hypofab.errors\n\n```{eval-rst}\n" + "\n".join(lines) + "```")
    return "\n\n".join(parts)


def other_pages(app: Sphinx) -> str:
    """A table of contents with the pages of docs/ that the index does not name."""
    text = (Path(app.srcdir) / "index.md").read_text(encoding="utf-8")
    rest = sorted(name for name in app.env.found_docs if "/" not in name and name != "index")
    pages = [name for name in rest if not re.search(rf"^{name}$", text, flags=re.MULTILINE)]
    return "\n".join(["```{toctree}", ":caption: How to", ":maxdepth: 1", "", *pages, "```"])


def fortran(app: Sphinx) -> str:
    """The modules of the model."""
    for source in (ROOT / "umat").rglob("*.[fF]90"):
        app.env.note_dependency(str(source))
    return fortran_modules.pages(ROOT / "umat")


def c_headers(app: Sphinx) -> str:
    """The public headers, as hypofab.h includes them."""
    header = (ROOT / "include/hypofab.h").read_text(encoding="utf-8")
    app.env.note_dependency(str(ROOT / "include/hypofab.h"))
    parts = ["hypofab.h", *re.findall(r'^#include "(\w+\.h)"', header, flags=re.MULTILINE)]
    return "\n\n".join(f"## {part}\n\n```{{doxygenfile}} {part}\n```" for part in parts)


GENERATORS: dict[str, Callable[[Sphinx], str]] = {
    "commands": commands,
    "deck keys": deck_keys,
    "python names": python_names,
    "other pages": other_pages,
    "fortran modules": fortran,
    "c headers": c_headers,
}


def fill(app: Sphinx, page: str, source: list[str]) -> None:
    """Put generated text in its places, and names in the place of links to folders, which a site does not have."""
    here = app.env.doc2path(page).parent

    def name_of_folder(link: re.Match) -> str:
        return f"`{(here / link[2]).resolve().relative_to(ROOT)}`" if (here / link[2]).is_dir() else link[0]

    text = PLACE.sub(lambda place: GENERATORS[place[1]](app), source[0])
    source[0] = LINK.sub(name_of_folder, text)


def outdated(app: Sphinx, env: BuildEnvironment, *_: set[str]) -> list[str]:
    """What depends on the package: the index; generated pages and notebooks, when the package is newer."""
    package = Path(hypofab.__file__).parent
    newest = max(path.stat().st_mtime for path in package.rglob("*") if path.is_file())
    before, env.hypofab_package = getattr(env, "hypofab_package", None), newest
    dependent = [name for name in env.found_docs if name.startswith(("site/", "notebooks/"))]
    return ["index", *(dependent if before != newest else ())]


def plain_text(_: Sphinx, __: str, ___: str, ____: object, _____: object, lines: list[str]) -> None:
    """Doc comments are plain text: what would be a mark of reStructuredText in them is none."""
    marks = re.compile(r"(``?[^`]*``?)|([|*\\]|(?<=\w)_(?!\w))")
    lines[:] = [marks.sub(lambda found: found[1] or f"\\{found[2]}", line) for line in lines]


def setup(app: Sphinx) -> dict[str, bool]:
    """Connect to Sphinx."""
    app.connect("source-read", fill)
    app.connect("env-get-outdated", outdated)
    app.connect("autodoc-process-docstring", plain_text)
    return {"parallel_read_safe": True}
