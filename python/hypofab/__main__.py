"""Commands of the package, which the program hands on: `hypofab plot ...` draws figures."""

import argparse
import os
import shutil
import sys
from pathlib import Path

from matplotlib.figure import Figure

from hypofab import papers
from hypofab.cli import fabric as fabric_command
from hypofab.cli import sweep_options as sweep_command
from hypofab.cli.laboratory import report as laboratory
from hypofab.cli.launch import packaged_program
from hypofab.errors import HypofabError, InputError
from hypofab.fabric import contact_files
from hypofab.figures import calibration as calibration_figures
from hypofab.figures import cycles, dilatancy
from hypofab.figures import element_tests as figures
from hypofab.figures import paths as path_figures
from hypofab.figures import sensitivities as sensitivity_figures
from hypofab.figures import stability as stability_figures
from hypofab.figures import surfaces as probe_surfaces
from hypofab.laboratory.catalogue import CatalogueError
from hypofab.results import secants as stiffness
from hypofab.results.element_tests import ResultError, find_envelopes, read_envelope, read_run
from hypofab.results.measured import read_measured
from hypofab.results.probes import has_probes, is_classical, read_probes


def labelled_directory(text: str) -> tuple[str, Path]:
    """Parse LABEL=DIR, or DIR with its last part as the label."""
    label, separator, directory = text.rpartition("=")
    return (label, Path(directory)) if separator else (Path(text).name, Path(text))


def save(figure: Figure, stem: Path) -> None:
    """Write a figure as PNG and PDF and print the file names. No date is stored: equal data give equal files."""
    for suffix, metadata in ((".png", {}), (".pdf", {"CreationDate": None})):
        path = stem.with_name(stem.name + suffix)
        figure.savefig(path, dpi=200, metadata=metadata)
        print(path)


def plot(directory: Path, options: argparse.Namespace) -> None:
    """Draw the figures of every test and envelope found in a folder of results, beside the CSV files."""
    if sweep_command.is_sweep(directory):
        sweep_command.draw(directory, save)
        return
    has_tests = (directory / "summary.json").exists()
    envelopes = find_envelopes(directory)
    if not has_tests and not envelopes:
        raise ResultError(
            f"{directory}: neither a summary.json of `hypofab run` nor a file of `hypofab envelope`, "
            "nor results of a sweep"
        )
    if has_tests:
        run = read_run(directory)
        zoom = None if options.zoom is None else options.zoom / 100
        data = {"measured": read_measured(dict(options.measured))}
        positive = options.compression_positive
        save(figures.stress_strain(run, zoom=zoom, **data), directory / "stress_strain")
        save(figures.volumetric(run, compression_positive=positive, **data), directory / "volumetric")
        save(figures.stress_path(run, **data), directory / "stress_path")
        save(path_figures.compression(run, **data), directory / "compression")
        if any(test.cycle.any() for test in run.tests):
            save(path_figures.loops(run, **data), directory / "loops")
        tests = [test for test in stability_figures.read_stability(directory) if len(test.eps_q) > 2]
        if tests:
            save(stability_figures.figure(tests), directory / "stability")
        for varied in sensitivity_figures.read_sensitivities(directory):
            if varied.drawable():
                save(sensitivity_figures.curves(varied), directory / f"{varied.name}_sensitivities")
    probes = {envelope.file: envelope for envelope in read_probes(directory)} if has_probes(directory) else {}
    for path in envelopes:
        stem = path.with_suffix("")
        if path in probes:
            for suffix, figure in probe_surfaces.figures_of(probes[path], options.compression_positive).items():
                save(figure, stem.with_name(stem.name + suffix))
        if path not in probes or is_classical(probes[path]):
            figure = figures.response_envelopes(read_envelope(path), compression_positive=options.compression_positive)
            save(figure, stem)


def default_program() -> str:
    """The program: HYPOFAB_PROGRAM, or that of the package, or hypofab on the path, or the one built here."""
    built = Path(__file__).resolve().parents[2] / "build" / "cli" / "hypofab"
    found = os.environ.get("HYPOFAB_PROGRAM") or packaged_program() or shutil.which("hypofab") or built
    return str(found)


def parser() -> argparse.ArgumentParser:
    """The command line's parser."""
    top = argparse.ArgumentParser(prog="hypofab", description="Tables and figures from results of hypofab.")
    commands = top.add_subparsers(dest="command", required=True)

    table = commands.add_parser("stiffness", help="table of secant stiffnesses beside those of paper 000, Table 4")
    table.add_argument("runs", nargs="+", metavar="[LABEL=]DIR", type=labelled_directory, help="results of hypofab run")

    draw = commands.add_parser("plot", help="figures as PNG and PDF, written beside the results")
    draw.add_argument("directories", nargs="+", metavar="DIR", type=Path, help="results of hypofab run or envelope")
    draw.add_argument("--zoom", type=float, metavar="PERCENT", help="inset of q for eps_q from 0 to PERCENT")
    draw.add_argument("--compression-positive", action="store_true", help="signs of soil mechanics in the figures")
    draw.add_argument(
        "--measured",
        nargs="+",
        default=(),
        metavar="[LABEL=]FILE",
        type=labelled_directory,
        help="CSV of measured tests to draw over: columns eps_q (or eps_1), q, eps_v, p, void_ratio",
    )

    calibration = commands.add_parser("calibration", help="figures of a calibration: tests, residuals, correlations")
    calibration.add_argument("directory", metavar="DIR", type=Path, help="results of hypofab calibrate")

    fabric_command.add_parser(commands)
    sweep_command.add_parser(commands)

    source = Path(__file__).parents[2]
    paper = commands.add_parser("paper", help="DEM runs of examples/dem and element tests beside a paper's results")
    paper.add_argument("paper", choices=papers.PAPERS, help="; ".join(f"{k}: {v}" for k, v in papers.PAPERS.items()))
    paper.add_argument("--runs", type=Path, metavar="DIR", help="run folders (examples/dem/results/PAPER)")
    paper.add_argument(
        "--out", type=Path, default=source / "docs/papers/figures", metavar="DIR", help="for the figures"
    )

    cyclic = commands.add_parser("cycles", help="what accumulates in cyclic tests, over the number of cycles")
    cyclic.add_argument("directory", metavar="DIR", type=Path, help="results of hypofab run")
    cyclic.add_argument("--quantity", default="eps_zz", metavar="NAME", help="a result column (default: %(default)s)")
    cyclic.add_argument("--tests", nargs="+", default=(), metavar="TEST", help="only these of the deck")
    cyclic.add_argument("--log", action="store_true", help="logarithm of the number of cycles")
    cyclic.add_argument("--last", type=float, metavar="N", help="draw up to this cycle")
    cyclic.add_argument("--name", default="cycles", help="of the figures, written to DIR (default: %(default)s)")

    drained = commands.add_parser("dilatancy", help="stress-dilatancy and critical states of drained triaxial tests")
    drained.add_argument("directory", metavar="DIR", type=Path, help="results of hypofab run")

    laboratory = commands.add_parser("laboratory", help="laboratory tests computed beside what was measured: a report")
    laboratory.add_argument("directory", metavar="DIR", type=Path, help="folder with the files of the tests")
    laboratory.add_argument("-o", "--output", metavar="OUT", type=Path, required=True, help="folder for the report")
    laboratory.add_argument("--catalogue", metavar="FILE", type=Path, help="tests and their files (default: built in)")
    laboratory.add_argument(
        "--program", default=default_program(), metavar="PATH", help="hypofab (default: %(default)s)"
    )

    contacts = commands.add_parser("contacts", help="contacts of HDF5, .npz or VTK XML as the .npy that hypofab reads")
    contacts.add_argument("source", metavar="FILE", type=Path, help="ends in " + ", ".join(contact_files.OPENERS))
    contacts.add_argument("target", metavar="OUT.npy", type=Path)
    contacts.add_argument("--group", help="HDF5: group or dataset; .npz: arrays; .npy without names: names of columns")
    return top


def main(arguments: list[str] | None = None) -> int:
    """Run one command; 0 when done, 2 when a result file is missing or wrong."""
    options = parser().parse_args(arguments)
    try:
        if options.command == "stiffness":
            columns = {label: stiffness.secant_stiffness(directory) for label, directory in options.runs}
            print(stiffness.table(columns | stiffness.REFERENCES))
        elif options.command == "calibration":
            calibration_figures.draw(options.directory, save)
        elif options.command == "fabric":
            fabric_command.run(options, save)
        elif options.command == "sweep":
            return sweep_command.run(options, save)
        elif options.command == "paper":
            runs = options.runs or Path(__file__).parents[2] / "examples/dem/results" / options.paper
            print(papers.compare(options.paper, runs, options.out))
        elif options.command == "cycles":
            tests = cycles.read_accumulations(options.directory, options.quantity, options.tests)
            print(cycles.table(tests, options.quantity))
            figure = cycles.figure(tests, options.quantity, logarithmic=options.log, last=options.last)
            save(figure, options.directory / options.name)
        elif options.command == "dilatancy":
            groups, materials = dilatancy.read_drained(options.directory)
            for number, (name, tests) in enumerate(groups.items()):
                suffix = f"_{number + 1}" if len(groups) > 1 else ""
                ratio = dilatancy.stress_dilatancy({name: tests}, materials[name]["phi_c"])
                save(ratio, options.directory / f"stress_dilatancy{suffix}")
                ends = dilatancy.critical_states({name: tests}, materials[name])
                save(ends, options.directory / f"critical_states{suffix}")
        elif options.command == "contacts":
            print(f"{contact_files.convert(options.source, options.target, options.group)} contacts")
        elif options.command == "laboratory":
            print(laboratory(options.directory, options.output, options.program, options.catalogue))
        else:
            for directory in options.directories:
                plot(directory, options)
    except (ResultError, CatalogueError, contact_files.ContactFileError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    except HypofabError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2 if isinstance(error, InputError) else 3
    return 0


if __name__ == "__main__":
    sys.exit(main())
