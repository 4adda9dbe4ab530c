"""`hypofab plot DIR...` and `hypofab plot FILE...`: every figure that results have the numbers for."""

import argparse
from pathlib import Path
from typing import Any

from hypofab.cli import fabric_files, sweep
from hypofab.cli.saving import labelled, save
from hypofab.figures import element_tests, paths, sensitivities, stability, surfaces
from hypofab.figures.envelopes import response_envelopes
from hypofab.results.element_tests import read_run
from hypofab.results.envelopes import find_envelopes, read_envelope
from hypofab.results.measured import read_measured
from hypofab.results.probes import has_probes, is_classical, read_probes
from hypofab.results.sensitivities import read_sensitivities
from hypofab.results.stability import read_stability
from hypofab.results.tables import ResultError


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Folders and files, and how to draw them."""
    parser.add_argument(
        "results",
        nargs="+",
        metavar="[LABEL=]PATH",
        type=labelled,
        help="folder of hypofab run, envelope or sweep; JSON of hypofab fabric, delta, describe, directions, changes, "
        "stiffness; CSV of hypofab describe",
    )
    folders = parser.add_argument_group("folders")
    folders.add_argument("--zoom", type=float, metavar="PERCENT", help="inset of q for eps_q from 0 to PERCENT")
    folders.add_argument("--compression-positive", action="store_true", help="signs of soil mechanics in the figures")
    folders.add_argument(
        "--measured",
        nargs="+",
        default=(),
        metavar="[LABEL=]FILE",
        type=labelled,
        help="CSV of measured tests to draw over: columns eps_q (or eps_1), q, eps_v, p, void_ratio",
    )
    fabric_files.add_arguments(parser.add_argument_group("files of fabric"))


def run(options: argparse.Namespace) -> None:
    """Draw what folders hold, beside it, and what files hold, into the folder asked for."""
    files = [(label, path) for label, path in options.results if not path.is_dir()]
    for _, directory in options.results:
        if directory.is_dir():
            _draw_folder(directory, options)
    if files:
        fabric_files.draw(files, options)


def _draw_folder(directory: Path, options: argparse.Namespace) -> None:
    if sweep.is_sweep(directory):
        sweep.draw(directory)
        return
    has_tests = (directory / "summary.json").exists()
    envelopes = find_envelopes(directory)
    if not has_tests and not envelopes:
        raise ResultError(
            f"{directory}: neither a summary.json of `hypofab run` nor a file of `hypofab envelope`, "
            "nor results of a sweep"
        )
    if has_tests:
        _draw_tests(directory, options)
    _draw_envelopes(directory, envelopes, options.compression_positive)


def _draw_tests(directory: Path, options: argparse.Namespace) -> None:
    run = read_run(directory)
    zoom = None if options.zoom is None else options.zoom / 100
    data: dict[str, Any] = {"measured": read_measured({label or path.name: path for label, path in options.measured})}
    positive = options.compression_positive
    save(element_tests.stress_strain(run, zoom=zoom, **data), directory / "stress_strain")
    save(element_tests.volumetric(run, compression_positive=positive, **data), directory / "volumetric")
    save(element_tests.stress_path(run, **data), directory / "stress_path")
    save(paths.compression(run, **data), directory / "compression")
    if any(test.cycle.any() for test in run.tests):
        save(paths.loops(run, **data), directory / "loops")
    measured = [test for test in read_stability(directory) if len(test.eps_q) > 2]
    if measured:
        save(stability.figure(measured), directory / "stability")
    for varied in read_sensitivities(directory):
        if varied.drawable():
            save(sensitivities.curves(varied), directory / f"{varied.name}_sensitivities")


def _draw_envelopes(directory: Path, envelopes: list[Path], positive: bool) -> None:
    probes = {envelope.file: envelope for envelope in read_probes(directory)} if has_probes(directory) else {}
    for path in envelopes:
        stem = path.with_suffix("")
        if path in probes:
            for suffix, figure in surfaces.figures_of(probes[path], positive).items():
                save(figure, stem.with_name(stem.name + suffix))
        if path not in probes or is_classical(probes[path]):
            save(response_envelopes(read_envelope(path), compression_positive=positive), stem)
