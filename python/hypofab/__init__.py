"""Figures and tables from the result files of the program `hypofab`."""
