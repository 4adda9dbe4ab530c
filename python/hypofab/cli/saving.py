"""Names on the command line, and figures as files."""

from pathlib import Path

from hypofab.figures import Figure


def labelled(text: str) -> tuple[str | None, Path]:
    """Parse LABEL=PATH, or PATH alone; a path that exists is none with a label."""
    label, separator, path = text.rpartition("=")
    return (label, Path(path)) if separator and not Path(text).exists() else (None, Path(text))


def save(figure: Figure, stem: Path) -> None:
    """Write a figure as PNG and PDF and print the file names. No date is stored: equal data give equal files."""
    for suffix, metadata in ((".png", {}), (".pdf", {"CreationDate": None})):
        path = stem.with_name(stem.name + suffix)
        figure.savefig(path, dpi=200, metadata=metadata)
        print(path)
