"""Results in memory and from files. Knows neither decks nor the compiled library."""

from hypofab.results.element_tests import Run, TestResult, read_run, read_test
from hypofab.results.envelopes import EnvelopeSeries, find_envelopes, read_envelope
from hypofab.results.tables import ResultError, read_columns, read_numbers, read_summary
from hypofab.tensors import COMPONENTS, Array

__all__ = [
    "COMPONENTS",
    "Array",
    "EnvelopeSeries",
    "ResultError",
    "Run",
    "TestResult",
    "find_envelopes",
    "read_columns",
    "read_envelope",
    "read_numbers",
    "read_run",
    "read_summary",
    "read_test",
]
