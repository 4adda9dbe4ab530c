"""Envelopes over the sphere of principal directions as surfaces in space (paper 004, Figure 2)."""

import math
from collections.abc import Sequence

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from mpl_toolkits.mplot3d.art3d import Poly3DCollection
from mpl_toolkits.mplot3d.axes3d import Axes3D

from hypofab.figures.probes import convention, directional_stiffness, fan, flow, scale
from hypofab.figures.style import INCH, STYLE
from hypofab.results.probes import Envelope, is_classical
from hypofab.results.tables import ResultError
from hypofab.results.vtp import Piece, read_vtp
from hypofab.tensors import Array


def _draw(figure: Figure, place: tuple[int, int, int], points: Array, piece: Piece, cube: Array) -> Axes3D:
    """One surface, shaded by its distance from the origin. cube: lower and upper limits of the axes, shape (2, 3)."""
    axes = figure.add_subplot(*place, projection="3d")
    size = np.linalg.norm(points, axis=1)
    shade = 0.95 - 0.6 * size[piece.cells].mean(axis=1) / max(size.max(), 1e-300)
    faces = Poly3DCollection(points[piece.cells], linewidths=0.12, edgecolors="0.15")
    faces.set_facecolor(np.column_stack([shade, shade, np.minimum(1, shade + 0.08)]))
    axes.add_collection3d(faces)
    for index, name in enumerate("xyz"):
        getattr(axes, f"set_{name}lim")(*cube[:, index])
        getattr(axes, f"set_{name}label")(f"{name}{name}", fontsize=7, labelpad=-6)
        getattr(axes, f"{name}axis").set_major_locator(MaxNLocator(4))
    axes.tick_params(labelsize=6, pad=-3)
    axes.set_box_aspect((1, 1, 1), zoom=0.9)
    axes.plot(0, 0, 0, marker="o", markersize=3, color="black")
    return axes


def _cube(clouds: list[Array]) -> Array:
    """The smallest cube around the middle of all points and the origin."""
    points = np.concatenate([*clouds, np.zeros((1, 3))])
    low, high = points.min(axis=0), points.max(axis=0)
    half = max(1.02 * (high - low).max() / 2, 1e-300)
    return np.stack([(low + high) / 2 - half, (low + high) / 2 + half])


def surfaces(envelope: Envelope, *, compression_positive: bool = False) -> Figure:
    """The surface of the answers of each series and, where the probes were unloaded, of their irrecoverable part.

    Axes are the principal values of the answer; the dot is the origin. Needs the file that `vtk: true` asks for.
    compression_positive: sign in the figure, whatever that of the results.
    """
    if envelope.vtk is None:
        raise ResultError(f"{envelope.file}: no surfaces, expected vtk: true in the deck")
    names = [series.name for series in envelope.series]
    return surfaces_of(envelope, names, read_vtp(envelope.vtk), compression_positive=compression_positive)


def surfaces_of(
    envelope: Envelope, names: Sequence[str], pieces: Sequence[Piece], *, compression_positive: bool = False
) -> Figure:
    """The same from surfaces in memory; the envelope gives sign, size and unit."""
    sign = 1 if compression_positive == envelope.compression_positive else -1
    factor, _, unit = scale(envelope, of_response=True)
    clouds = [sign * factor * piece.points for piece in pieces]
    # Equal axes for equal parts: sizes can be compared.
    cubes = [
        _cube([c for c, p in zip(clouds, pieces, strict=True) if p.irrecoverable == part]) for part in (False, True)
    ]
    parts = 2 if any(piece.irrecoverable for piece in pieces) else 1
    columns = 2 if parts == 2 else min(3, len(pieces))
    rows = math.ceil(len(pieces) / columns)
    with rc_context(STYLE):
        figure = Figure(figsize=(58 * columns / INCH, 62 * rows / INCH))
        figure.subplots_adjust(0.01, 0.04 + 0.06 / rows, 0.95, 0.97 - 0.05 / rows, wspace=0.08, hspace=0.12)
        for index, (piece, points) in enumerate(zip(pieces, clouds, strict=True)):
            axes = _draw(figure, (rows, columns, index + 1), points, piece, cubes[piece.irrecoverable])
            what = "\nirrecoverable" if piece.irrecoverable else "\nwhole answer" if parts == 2 else ""
            axes.set_title(names[piece.series] + what, fontsize=8, pad=-1)
        what = "strain" if envelope.imposes_stress else "stress"
        figure.suptitle(f"{what} [{unit}], {convention(compression_positive)}", fontsize=8, y=0.01, va="bottom")
        return figure


def figures_of(envelope: Envelope, compression_positive: bool) -> dict[str, Figure]:
    """The figures of probes that suit an envelope, by the suffix of their file names."""
    figures: dict[str, Figure] = {}
    if envelope.directions in ("axisymmetric", "plane") and not is_classical(envelope):
        figures["_fan"] = fan(envelope, compression_positive=compression_positive)
    if envelope.directions == "principal" and envelope.imposes_stress:
        figures["_flow"] = flow(envelope)
    fits = [series.ellipsoid for series in envelope.series if series.ellipsoid is not None]
    if envelope.vtk is not None and envelope.directions == "principal" and any(f.straightness < 0.98 for f in fits):
        figures["_surfaces"] = surfaces(envelope, compression_positive=compression_positive)
    if envelope.directions in ("principal", "all_components") and any(np.any(s.delta) for s in envelope.series):
        figures["_stiffness"] = directional_stiffness(envelope)
    return figures
