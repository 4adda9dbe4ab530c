"""The structure of the sources: no circles of files, arrows of rooms that point one way, libraries in their place."""

import re

import pytest
from sources import (
    C_ROOMS,
    arrows,
    c_files,
    c_uses,
    circles,
    definitions,
    includes,
    python_files,
    python_imports,
    python_uses,
)

# Rooms whose headers a room may include, beside its own and the public ones.
MAY_USE = {
    "base": set(),
    "umat": {"base"},
    "driver": {"umat", "base"},
    "fabric2delta": {"umat", "base"},
    "calibration": {"driver", "umat", "base"},
    "sampling": {"base"},
    "deck": {"calibration", "driver", "fabric2delta", "base"},
    "cli": {"base"},  # what is in headers alone: libhypofab hides the rest
    "python/extension": {"base"},
}

# A search in the text of a failure, which is for people: hypofab_last_subject() is for programs.
SEARCH = re.compile(
    r"\b(str(n?casecmp|n?cmp|str|r?chr|c?spn|pbrk|tok|sep)|sscanf|regexec)\(\s*[^,;]*(message|status_text)\b"
)
SUNDIALS = re.compile(r"<(sundials|arkode|cvode|ida|nvector|sunmatrix|sunlinsol|sunnonlinsol)/")


def room_of(path: str) -> str:
    return next(room for room in C_ROOMS if path.startswith(room + "/"))


def test_c_files_form_no_circle() -> None:
    uses = c_uses()
    assert len(uses) > 150
    assert [arrows(group, uses) for group in circles(uses)] == []


def test_python_files_form_no_circle() -> None:
    uses = python_uses()
    assert len(uses) > 50
    assert [arrows(group, uses) for group in circles(uses)] == []


def test_rooms_include_what_is_below_them() -> None:
    files = c_files()
    wrong = [
        f"{path} includes {name}"
        for path, text in files.items()
        for name in includes(text)
        if name in files and room_of(name) != room_of(path) and room_of(name) not in MAY_USE[room_of(path)]
    ]
    assert wrong == []


def test_no_message_is_searched() -> None:
    assert SEARCH.search('if (strncmp(r->message, "step", 4))')
    assert SEARCH.search("strchr(hypofab_last_message(), 58)")
    assert [f"{path}: {found[0]}" for path, text in c_files().items() if (found := SEARCH.search(text))] == []


def test_sundials_is_known_in_one_place() -> None:
    files = c_files()
    users = {path.rpartition("/")[0] for path, text in files.items() if any(map(SUNDIALS.match, includes(text)))}
    assert users == {"driver/integrate"}


def test_matplotlib_is_known_to_figures_alone() -> None:
    users = {
        name
        for name, tree in python_files().items()
        if any(module.split(".")[0] == "matplotlib" for module in python_imports(tree))
    }
    assert users
    assert {name for name in users if not name.startswith("hypofab.figures")} == set()


@pytest.mark.parametrize(
    ("uses", "expected"),
    [
        ({"a": {"b"}, "b": {"c"}, "c": set()}, []),
        ({"a": {"b"}, "b": {"c"}, "c": {"a"}, "d": {"a"}}, [["a", "b", "c"]]),
        ({"a": {"b"}, "b": {"a"}, "c": {"d", "a"}, "d": {"c"}}, [["a", "b"], ["c", "d"]]),
    ],
)
def test_circles_are_found(uses: dict[str, set[str]], expected: list[list[str]]) -> None:
    assert circles(uses) == expected


def test_definitions_and_includes_are_found() -> None:
    text = (
        '#include "base/message.h"\n#include <math.h>\n'
        "static int hidden(int a) {\n  return other(a);\n}\n"
        "hypofab_status first(const char *a,\n                     int b) {\n  if (a) return second(b);\n}\n"
        "const char *second(int i) { return 0; }\n"
        "extern const row elsewhere[];\nconst row table[] = {{1}};\nint declared(void);\n"
    )
    assert definitions(text) == {"first", "second", "table"}
    assert includes(text) == ["base/message.h", "<math.h>"]
