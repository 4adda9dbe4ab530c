"""Figures of results. The only room that imports matplotlib; each function returns a Figure and shows nothing."""

from matplotlib.figure import Figure

from hypofab.figures.element_tests import stress_path, stress_strain, volumetric
from hypofab.figures.envelopes import response_envelopes
from hypofab.figures.style import COLUMN, INCH, LINES, STYLE, legend, line_style

__all__ = [
    "COLUMN",
    "INCH",
    "LINES",
    "STYLE",
    "Figure",
    "legend",
    "line_style",
    "response_envelopes",
    "stress_path",
    "stress_strain",
    "volumetric",
]
