"""Laboratory tests beside computed ones: decks, runs, error measures, overlays and a report.

Everything in this package is compression positive, stress in kPa, strain as a ratio (0.01 for 1 %).
"""
