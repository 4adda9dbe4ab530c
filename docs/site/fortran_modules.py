"""The public side of the Fortran modules as Markdown. FORD parses the sources; the layout is the site's."""

import contextlib
import html
import io
import re
import textwrap
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from ford.fortran_project import Project
from ford.settings import ProjectSettings


def parse(folder: Path) -> Project:
    """What FORD knows of the sources in a folder. It prints while it works."""
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        settings = ProjectSettings(src_dir=[folder], preprocess=False, predocmark=">", docmark="<", quiet=True)
        project = Project(settings)
        project.correlate()
    return project


def plain(declaration: str) -> str:
    """A declaration without FORD's links."""
    return html.unescape(re.sub(r"<[^>]+>", "", declaration))


def prose(lines: Iterable[str]) -> str:
    """A doc comment as it is: marks of Markdown in it are none."""
    text = "\n".join(line.strip() for line in lines).strip()
    text = re.sub(r"^@return\s+", "Returns ", text, flags=re.MULTILINE)
    return re.sub(r"([\\`*_{}\[\]<>#|$])", r"\\\1", text)


def one_line(lines: Iterable[str]) -> str:
    """A doc comment in one line of a table."""
    return " ".join(prose(lines).split())


def of_argument(argument: Any) -> str:  # noqa: ANN401 - classes of FORD
    """Type and attributes of an argument."""
    attributes = [plain(argument.full_type)]
    attributes += [f"intent({argument.intent})"] * bool(argument.intent) + ["optional"] * bool(argument.optional)
    return f"{', '.join(attributes)} :: {argument.name}{argument.dimension or ''}"


def procedure(one: Any) -> str:  # noqa: ANN401
    """A procedure: how it is declared, its comment, its arguments."""
    is_function = one.proctype == "Function"
    head = " ".join([*one.attribs, one.proctype.lower(), f"{one.name}({', '.join(a.name for a in one.args)})"])
    head += f" result({one.retvar.name})" if is_function else ""
    head += f" bind({one.bindC})" if one.bindC else ""
    wrapped = textwrap.wrap(head, 92, subsequent_indent="    ", break_long_words=False)
    lines = [
        *(f"{line} &" for line in wrapped[:-1]),
        wrapped[-1],
        *(f"  {of_argument(argument)}" for argument in one.args),
    ]
    if is_function:
        lines.append(f"  {plain(one.retvar.full_type)} :: {one.retvar.name}{one.retvar.dimension or ''}")
    declared = "\n".join(lines)
    rows = [f"- `{a.name}`: {one_line(a.doc_list)}" for a in one.args if one_line(a.doc_list)]
    arguments = "\n".join(rows)
    return f"### {one.name}\n\n```fortran\n{declared}\n```\n\n{prose(one.doc_list)}\n\n{arguments}"


def derived_type(one: Any) -> str:  # noqa: ANN401
    """A type and its components."""
    rows = [f"| `{plain(v.full_declaration)} :: {v.name}` | {one_line(v.doc_list)} |" for v in one.variables]
    table = "\n".join(["| component | |", "|---|---|", *rows]) if rows else ""
    return f"### type {one.name}\n\n{prose(one.doc_list)}\n\n{table}"


def pages(folder: Path) -> str:
    """Every module of a folder with its public types, procedures and constants, as Markdown sections."""
    parts = []
    for module in sorted(parse(folder).modules, key=lambda one: one.name):
        if module.name.isupper():  # named by the preprocessor, once for each width of registers
            continue
        public = [one for one in (*module.functions, *module.subroutines) if one.permission == "public"]
        types = [one for one in module.types if one.permission == "public"]
        constants = [one for one in module.variables if one.permission == "public"]
        parts.append(f"## {module.name}\n\n{prose(module.doc_list)}")
        if constants:
            rows = [f"| `{plain(v.full_declaration)} :: {v.name}` | {one_line(v.doc_list)} |" for v in constants]
            parts.append("\n".join(["| constant | |", "|---|---|", *rows]))
        parts += [derived_type(one) for one in types] + [procedure(one) for one in public]
    return "\n\n".join(parts)
