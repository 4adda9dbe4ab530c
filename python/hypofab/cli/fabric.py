"""`python -m hypofab fabric FILE...`: every figure that the files of the program have the numbers for."""

import argparse
from collections.abc import Callable, Iterator
from pathlib import Path

from matplotlib.figure import Figure

from hypofab.figures import changes as change_figures
from hypofab.figures import fabric as fabric_figures
from hypofab.figures import uncertainty as uncertainty_figures
from hypofab.results import fabric as fabric_results
from hypofab.results.element_tests import ResultError
from hypofab.results.fabric import Result

DEFAULT_COLUMNS = ("coordination_number", "deviator_fabric", "anisotropy")


def labelled_file(text: str) -> tuple[str | None, Path]:
    """Parse LABEL=FILE, or FILE alone."""
    label, separator, file = text.rpartition("=")
    return (label, Path(file)) if separator else (None, Path(text))


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand to the command line."""
    text = "figures of fabric, directions, changes, series and intervals as PNG and PDF"
    fabric = commands.add_parser("fabric", help=text)
    fabric.add_argument(
        "files",
        nargs="+",
        metavar="[LABEL=]FILE",
        type=labelled_file,
        help="JSON of hypofab fabric, delta, describe, directions, changes, stiffness; CSV of hypofab describe",
    )
    fabric.add_argument("-o", "--output", type=Path, default=Path(), metavar="DIR", help="for the figures (here)")
    fabric.add_argument("--up", choices="xyz", default="z", help="upright axis of surfaces (z)")
    fabric.add_argument("--columns", metavar="NAME,...", help=f"of a series ({','.join(DEFAULT_COLUMNS)})")
    fabric.add_argument("--over", metavar="NAME", help="column of a series to draw over (number of the snapshot)")


def figures(options: argparse.Namespace) -> Iterator[tuple[str, Figure]]:
    """The name of each figure and the figure."""
    tables = {label or path.stem: path for label, path in options.files if path.suffix == ".csv"}
    read = (fabric_results.read_json(path, label) for label, path in options.files if path.suffix != ".csv")
    samples = [sample for file in read for sample in file]

    def of(kind: Callable[[dict], bool]) -> list[Result]:
        return [sample for sample in samples if kind(sample.data)]

    fabrics = {(one.label, *one.data["deviatoric_fabric"]): one for one in of(fabric_results.has_fabric)}
    if fabrics:  # a sample may stand in several files
        yield "fabric_surface", fabric_figures.surfaces(list(fabrics.values()), up=options.up)
    for sample in of(fabric_results.has_directions):
        if sample.data["dimension"] == 3:
            yield f"{sample.label}_sphere", fabric_figures.sphere(sample)
        else:
            yield f"{sample.label}_roses", fabric_figures.plane_roses(sample)
    for sample in of(fabric_results.has_changes):
        if sample.data["strain"] is not None:
            yield f"{sample.label}_rates", change_figures.rates(sample)
        yield f"{sample.label}_lost_gained", change_figures.roses(sample)
    if of(fabric_results.has_delta_intervals):
        yield "delta_intervals", uncertainty_figures.delta_intervals(of(fabric_results.has_delta_intervals))
    for sample in of(fabric_results.has_stiffness_intervals):
        yield f"{sample.label}_intervals", uncertainty_figures.stiffness_intervals(sample)
    if tables:
        columns = options.columns.split(",") if options.columns else DEFAULT_COLUMNS
        read_tables = {label: fabric_results.read_series(path) for label, path in tables.items()}
        yield "series", fabric_figures.series(read_tables, columns, over=options.over)


def run(options: argparse.Namespace, save: Callable[[Figure, Path], None]) -> None:
    """Draw and save every figure."""
    if options.output.exists() and not options.output.is_dir():
        raise ResultError(f"{options.output}: not a folder; expected one for the figures")
    options.output.mkdir(parents=True, exist_ok=True)
    for name, figure in figures(options):
        save(figure, options.output / name.replace("/", "_"))
