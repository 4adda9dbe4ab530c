"""The compiled library: the extension, if it is there, and what every call of it needs."""

import threading
from collections.abc import Callable
from functools import cache
from types import ModuleType
from typing import TypeVar

import numpy as np

from hypofab.errors import Status, error_of

core: ModuleType
"""The extension: python/extension/_core.pyf."""

try:
    from hypofab import _core as core
except ImportError as failure:
    raise ImportError(
        f"the compiled part of hypofab is not here ({failure}); `pip install .` in the folder of the project builds it"
    ) from failure

T = TypeVar("T")


def text(raw: bytes) -> str:
    """A text that came out of the library."""
    return raw.rstrip(b"\0 ").decode("utf-8", "replace")


@cache
def stability_quantities() -> tuple[str, ...]:
    """Names of the measures of stability: they have no derivatives, and are in results where they are asked for."""
    names: list[str] = []
    while name := text(core.quantity_name(core.first_stability() + len(names))):
        names.append(name)
    return tuple(names)


def last_message() -> str:
    """The message of the last failed call in this thread."""
    return text(core.message())


def check(status: int) -> None:
    """Raise the exception of a status that is not OK, with the message of the call just made."""
    if status:
        # The glue reports a lack of memory of its own without a message.
        message = last_message() if status != Status.NO_MEMORY else ""
        raise error_of(status, message or text(core.status_text(status)))


def interruptible(call: Callable[[np.ndarray], T]) -> T:
    """Make a long call that looks at a flag from time to time; Ctrl-C sets the flag and ends the call.

    Python's signals reach the main thread alone, and only between its own instructions: there the call is made in
    another thread.
    """
    stop = np.zeros(1, dtype=np.intc)
    if threading.current_thread() is not threading.main_thread():
        return call(stop)
    results: list[T] = []
    failures: list[BaseException] = []

    def work() -> None:
        try:
            results.append(call(stop))
        except BaseException as failure:
            failures.append(failure)

    worker = threading.Thread(target=work, name="hypofab")
    worker.start()
    try:
        worker.join()
    except KeyboardInterrupt:
        stop[0] = 1
        worker.join()
        raise
    if failures:
        raise failures[0]
    return results[0]


def version() -> str:
    """Version of the library, "major.minor.patch"."""
    return text(core.version())
