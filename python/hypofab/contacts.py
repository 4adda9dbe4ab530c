"""Descriptors and delta of contacts (docs/descriptors.md): hypofab.fabric.contacts by a short name."""

from hypofab.fabric.contacts import COLUMNS, delta, describe, series

__all__ = ["COLUMNS", "delta", "describe", "series"]
