"""The report of laboratory tests as markdown."""

from collections.abc import Sequence
from pathlib import Path

from hypofab.laboratory.catalogue import LabTest
from hypofab.laboratory.variants import STARTS


def _percent(value: str) -> str:
    return f"{100 * float(value):.1f}"


def _table(rows: Sequence[dict]) -> list[str]:
    lines = [
        "| test | sand | start of delta | e | quantity | R2 | rms error [%] | largest [%] | reached [%] | end |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for row in rows:
        void_ratio = row["void_ratio"] + (" (fitted)" if row["void_ratio_fitted"] == "yes" else "")
        r2 = "-" if row["quantity"] == "cycles" else f"{float(row['r2']):.3f}"
        cells = [row["test"], row["sand"], row["start"], void_ratio, row["quantity"], r2, _percent(row["rms"])]
        cells += [_percent(row["largest"]), _percent(row["covered"]), row["status"]]
        lines.append("| " + " | ".join(cells) + " |")
    return lines


def influence(rows: Sequence[dict]) -> list[str]:
    """How much the start of delta matters: the span of the rms error over the starts, for each test."""
    lines = ["| test | quantity | " + " | ".join(STARTS) + " |", "|---|---|" + "---|" * len(STARTS)]
    for test, quantity, sand in dict.fromkeys((row["test"], row["quantity"], row["sand"]) for row in rows):
        found = {
            row["start"]: _percent(row["rms"])
            for row in rows
            if (row["test"], row["quantity"], row["sand"]) == (test, quantity, sand)
        }
        if "none" not in found:
            lines.append(f"| {test} | {quantity} | " + " | ".join(found.get(start, "-") for start in STARTS) + " |")
    return lines


def write_markdown(tests: Sequence[LabTest], rows: Sequence[dict], missing: Sequence[str], out: Path) -> Path:
    """Write OUT/report.md."""
    lines = [
        "# Laboratory tests",
        "",
        "Errors refer to the range of what was measured: rms is the root mean square over it, largest the greatest.",
        "R2 is 1 - (sum of squared errors)/(sum of squared deviations from the mean): negative is worse than the mean.",
        "`reached` is the part of the measured rows that the computed test reaches; the rest is not in the errors. For",
        "`cycles` the error is that of the number of half cycles before 1 % axial strain.",
        "",
        "![Errors](errors.png)",
        "",
        "Start of the intergranular strain:",
        "",
        *(f"- **{name}**: {meaning}" for name, meaning in STARTS.items()),
        "- **none**: the sand has none",
        "",
    ]
    for material in dict.fromkeys(test.material for test in tests):
        chosen = [row for row in rows if row["material"] == material]
        lines += [f"## {material}", "", *_table(chosen), ""]
        if any(row["start"] != "none" for row in chosen):
            lines += ["rms error [%] by the start of delta:", "", *influence(chosen), ""]
        if any(test.kind == "drained_compression" and test.material == material for test in tests):
            stem = material.lower().replace(" ", "_")
            lines += [f"![Stress and dilatancy]({stem}_stress_dilatancy.png)", ""]
            lines += [f"![Critical states]({stem}_critical_states.png)", ""]
        for test in (test for test in tests if test.material == material):
            lines += [f"### {test.name}: {test.kind.replace('_', ' ')}", ""]
            lines += [test.note[0].upper() + test.note[1:] + ".", ""] if test.note else []
            lines += [f"![{test.name}]({test.name}.png)", ""]
    if missing:
        lines += ["## Not there", "", "Files of the catalogue that were not found: " + ", ".join(missing) + ".", ""]
    path = out / "report.md"
    path.write_text("\n".join(lines), encoding="utf-8")
    return path
