"""Make one folder equal to another, touching only files that differ: a build then sees what is new.

Usage: mirror.py FROM TO.
"""

import filecmp
import shutil
import sys
from pathlib import Path


def files_of(folder: Path) -> set[Path]:
    """Paths of all files, relative to the folder."""
    return {path.relative_to(folder) for path in folder.rglob("*") if path.is_file()}


def mirror(source: Path, target: Path) -> None:
    """Copy what differs, remove what is not in the source."""
    wanted = files_of(source)
    for path in wanted:
        if (target / path).is_file() and filecmp.cmp(source / path, target / path, shallow=False):
            continue
        (target / path).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source / path, target / path)
        shutil.copymode(source / path, target / path)
    for path in files_of(target) - wanted:
        (target / path).unlink()


if __name__ == "__main__":
    mirror(*map(Path, sys.argv[1:]))
