"""Figures of results. The only room that imports matplotlib; each function returns a Figure and shows nothing."""

from hypofab.figures.element_tests import (
    COLUMN,
    INCH,
    LINES,
    STYLE,
    legend,
    line_style,
    response_envelopes,
    stress_path,
    stress_strain,
    volumetric,
)

__all__ = [
    "COLUMN",
    "INCH",
    "LINES",
    "STYLE",
    "legend",
    "line_style",
    "response_envelopes",
    "stress_path",
    "stress_strain",
    "volumetric",
]
