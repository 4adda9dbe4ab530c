"""The examples of pages of the documentation run, one after the other."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.mark.parametrize(
    ("page", "blocks", "printed"),
    [
        ("python.md", 5, "OUT_OF_DOMAIN a principal stress became tensile"),
        ("sensitivities.md", 1, "[ 0. "),
        ("sweeps.md", 3, "(40, 21) {}"),
    ],
)
def test_the_examples_of_the_documentation_run(
    page: str, blocks: int, printed: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(ROOT)
    text = (ROOT / "docs" / page).read_text()
    found = re.findall(r"^```python\n(.*?)^```", text, flags=re.MULTILINE | re.DOTALL)
    assert len(found) >= blocks
    names: dict[str, object] = {"__name__": "documentation"}
    for block in found:
        exec(compile(block, f"docs/{page}", "exec"), names)
    assert printed in capsys.readouterr().out
