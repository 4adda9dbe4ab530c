"""Descriptors and delta of contacts (docs/descriptors.md): the commands describe and delta as Python calls."""

from hypofab.cli.calls import COLUMNS, delta, describe, series

__all__ = ["COLUMNS", "delta", "describe", "series"]
