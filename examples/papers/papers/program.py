"""Call the program `hypofab`."""

from hypofab.cli.launch import program, run, run_json

__all__ = ["program", "run", "run_json"]
