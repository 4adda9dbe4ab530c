"""The commands that the program `hypofab` hands to Python, one row each; cli/main.c repeats them."""

COMMANDS = {
    "plot": "figures as PNG and PDF, written beside the results",
    "secants": "table of secant stiffnesses beside those of paper 000, Table 4",
    "sweep": "many runs of a deck: grids, tables, Monte Carlo, Sobol indices",
    "calibration": "figures of a calibration: tests, residuals, correlations",
    "laboratory": "laboratory tests computed beside what was measured: a report",
    "cycles": "what accumulates in cyclic tests, over the number of cycles",
    "dilatancy": "stress-dilatancy and critical states of drained triaxial tests",
    "contacts": "contacts of HDF5, .npz or VTK XML as the .npy that hypofab reads",
}
"""Purpose of each by its name. Its module of this name here has add_arguments(parser) and run(options)."""
