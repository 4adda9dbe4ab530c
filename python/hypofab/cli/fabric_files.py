"""Figures of the JSON and CSV that the program prints of fabric: what `hypofab plot FILE...` draws."""

import argparse
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from hypofab.cli.saving import save
from hypofab.figures import Figure
from hypofab.figures import changes as change_figures
from hypofab.figures import fabric as fabric_figures
from hypofab.figures import uncertainty as uncertainty_figures
from hypofab.results import fabric as fabric_results
from hypofab.results.fabric import Result
from hypofab.results.tables import ResultError

DEFAULT_COLUMNS = ("coordination_number", "deviator_fabric", "anisotropy")


def add_arguments(parser: "argparse._ArgumentGroup") -> None:
    """How to draw files of fabric."""
    parser.add_argument("-o", "--output", type=Path, default=Path(), metavar="DIR", help="for the figures (here)")
    parser.add_argument("--up", choices="xyz", default="z", help="upright axis of surfaces (z)")
    parser.add_argument("--columns", metavar="NAME,...", help=f"of a series ({','.join(DEFAULT_COLUMNS)})")
    parser.add_argument("--over", metavar="NAME", help="column of a series to draw over (number of the snapshot)")


def figures(files: Sequence[tuple[str | None, Path]], options: argparse.Namespace) -> Iterator[tuple[str, Figure]]:
    """The name of each figure and the figure."""
    tables = {label or path.stem: path for label, path in files if path.suffix == ".csv"}
    read = (fabric_results.read_results(path, label) for label, path in files if path.suffix != ".csv")
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


def draw(files: Sequence[tuple[str | None, Path]], options: argparse.Namespace) -> None:
    """Draw and save every figure of labelled files."""
    if options.output.exists() and not options.output.is_dir():
        raise ResultError(f"{options.output}: not a folder; expected one for the figures")
    options.output.mkdir(parents=True, exist_ok=True)
    for name, figure in figures(files, options):
        save(figure, options.output / name.replace("/", "_"))
