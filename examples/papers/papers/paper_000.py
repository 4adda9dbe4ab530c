"""Paper 000: contact fabric, delta, and the directional stiffness of DEM samples and of element tests.

Runs: `iso` and `aniso` of prepare.py; `A-0`, `A-90`, `I-0`, `I-90` of load.py. With `loose_` in front, these names are
optional: samples with the final friction already while they were prepared, as in the paper.
"""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes

import hypofab
from hypofab.figures import line_style
from hypofab.results import TestResult, paper000
from papers import draw
from papers.element import SMALL, Loading, element_tests, fit_c, secants
from papers.runs import Curve, DemRun, read_curve, read_dem

TESTS = {"A-0": ("aniso", "y"), "A-90": ("aniso", "x"), "I-0": ("iso", "y"), "I-90": ("iso", "x")}
PAPER_STATES = {"iso": (0.642, 2.41, 0.033), "aniso": (0.640, 2.43, 0.324)}
"""Table 1: e, CN, a."""


def states(samples: dict[str, DemRun]) -> str:
    """Table 1 with ours beside the paper's."""
    rows = []
    for name, sample in samples.items():
        r = sample.results
        rows.append(
            [
                name,
                str(r["particles"]),
                f"{r['void_ratio']:.3f}",
                f"{r['coordination_number']:.2f}",
                f"{r['coordination_number'] / 2:.2f}",
                f"{r['anisotropy']:.3f}",
                f"{r['anisotropy_noise']:.3f}",
            ]
        )
    rows += [
        [f"paper, {k}", "20000", f"{e:.3f}", f"{cn:.2f}", "", f"{a:.3f}", ""] for k, (e, cn, a) in PAPER_STATES.items()
    ]
    return draw.table(["sample", "N_p", "e", "2 N_c/N_p", "N_c/N_p", "a", "a of noise"], rows)


def stiffness_table(columns: dict[str, dict[str, float]]) -> str:
    """Table 4: stiffness [kPa] and its ratio to that of A-90."""
    rows = [
        [name, *(f"{column[name]:.0f} ({column[name] / column['A-90']:.2f})" for column in columns.values())]
        for name in TESTS
    ]
    return draw.table(["test", *columns], rows)


def surface(path: Path, samples: dict[str, DemRun]) -> None:
    """Figure 4: the density of contact normals."""
    tensors = {}
    for name, sample in samples.items():
        fabric = hypofab.fabric_of_file(sample.contacts)
        tensors[f"{name}, a = {fabric.anisotropy:.3f}"] = hypofab.matrix(fabric.deviatoric_fabric)
    draw.fabric_surfaces(path, tensors, size=95, limit=1.3)


def _curves(axes: Axes, curves: dict[str, Curve] | dict[str, TestResult], what: str, title: str) -> None:
    """Deviatoric stress or volumetric strain of four tests over eps_q."""
    for index, (name, test) in enumerate(curves.items()):
        y = test.q if what == "q" else 100 * test.eps_v
        axes.plot(100 * test.eps_q, y, label=name, **line_style(index))
    axes.set(xlabel="deviatoric strain [%]", title=title, xlim=(0, None))
    axes.set_ylabel("q [kPa]" if what == "q" else "volumetric strain [%] (dilation positive)")
    axes.legend(loc="lower right" if what == "q" else "upper left")


def _zoom(axes: Axes, curves: dict[str, Curve] | dict[str, TestResult], place: tuple[float, ...]) -> None:
    """An inset up to eps_q = 0.1 %."""
    inset = axes.inset_axes(place)
    top = 0.0
    for index, test in enumerate(curves.values()):
        inset.plot(100 * test.eps_q, test.q, **line_style(index))
        top = max(top, float(np.interp(SMALL, test.eps_q, test.q)))
    inset.set(xlim=(0, 100 * SMALL), ylim=(0, 1.05 * top))
    inset.tick_params(labelsize=7)


def directional(runs: Path, prefix: str) -> tuple[dict[str, DemRun], dict[str, Curve], list[Loading], hypofab.FitOfC]:
    """Samples, DEM curves, element loadings and the fitted c of one set of runs."""
    samples = {name: read_dem(runs / f"{prefix}{name}") for name in ("iso", "aniso")}
    curves = {name: read_curve(runs / f"{prefix}{name}") for name in TESTS}
    loadings = [Loading(name, samples[sample], axis) for name, (sample, axis) in TESTS.items()]
    measured = {name: curve.secant(SMALL) for name, curve in curves.items()}
    return samples, curves, loadings, fit_c(loadings, measured)


def compare(runs: Path, out: Path) -> str:
    """Tables 1 and 4, Figures 4 to 8."""
    text = []
    for prefix in ("", "loose_"):
        if prefix and not (runs / f"{prefix}A-0").exists():
            continue
        samples, curves, loadings, fit = directional(runs, prefix)
        strain = min(0.1, min(float(curve.axial[-1]) for curve in curves.values())) if prefix else 0.1
        element = {c: element_tests(loadings, c, strain) for c in (0.05, fit.c)}
        text += [
            f"{prefix.strip('_') or 'dense'} samples: c = {fit.c:.3g} ({fit.lower:.3g} to {fit.upper:.3g}),"
            f" root-mean-square error of the logarithms of the ratios {fit.misfit:.3f}",
            states(samples),
            stiffness_table(
                {
                    "DEM": {name: curve.secant(SMALL) for name, curve in curves.items()},
                    "element, c = 0.05": secants(element[0.05]),
                    f"element, c = {fit.c:.3g}": secants(element[fit.c]),
                    "paper, DEM": paper000.DEM,
                    "paper, element": paper000.ELEMENT_TEST,
                }
            ),
        ]
        with draw.panels(out / f"000_{prefix}stress_strain.png", 3) as (dem, paper_c, fitted):
            _curves(dem, curves, "q", f"DEM, {samples['iso'].results['particles']} spheres")
            _curves(paper_c, element[0.05], "q", "element tests, c = 0.05")
            _curves(fitted, element[fit.c], "q", f"element tests, c = {fit.c:.3g}")
            if not prefix:
                _zoom(dem, curves, (0.42, 0.12, 0.4, 0.4))
                _zoom(paper_c, element[0.05], (0.42, 0.12, 0.4, 0.4))
                _zoom(fitted, element[fit.c], (0.42, 0.12, 0.4, 0.4))
            for axes in (dem, paper_c, fitted):
                axes.set_ylim(0, 1.25 * axes.get_ylim()[1])
                axes.legend(loc="upper right" if not prefix else "upper left", ncols=2)
        if not prefix:
            surface(out / "000_fabric.png", samples)
            with draw.panels(out / "000_volumetric.png", 3) as (dem, paper_c, fitted):
                _curves(dem, curves, "v", "DEM")
                _curves(paper_c, element[0.05], "v", "element tests, c = 0.05")
                _curves(fitted, element[fit.c], "v", f"element tests, c = {fit.c:.3g}")
    return "\n\n".join(text)
