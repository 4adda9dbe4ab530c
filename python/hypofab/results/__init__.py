"""Results in memory and from files. Knows neither decks nor the compiled library."""

from hypofab.results.element_tests import (
    COMPONENTS,
    Array,
    EnvelopeSeries,
    ResultError,
    Run,
    TestResult,
    find_envelopes,
    read_columns,
    read_envelope,
    read_numbers,
    read_run,
    read_summary,
    read_test,
)

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
