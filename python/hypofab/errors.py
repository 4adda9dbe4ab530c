"""Why a call failed: a status of the library as an exception, with the library's message."""

from enum import IntEnum


class Status(IntEnum):
    """Outcome of a call, as in hypofab.h. 1 to 99: a physical finding; 100 to 199: bad input; from 200: internal."""

    OK = 0
    NOT_CONTROLLABLE = 1
    NOT_UNIQUE = 2
    OUT_OF_DOMAIN = 3
    STEP_LIMIT = 4
    TARGET_NOT_REACHED = 5
    INTERRUPTED = 6
    LIQUEFACTION = 7
    BAD_MATERIAL = 100
    BAD_STATE = 101
    BAD_ARGUMENT = 102
    BAD_FILE = 103
    NO_MEMORY = 200
    IO_ERROR = 201
    INTERNAL_ERROR = 202


class HypofabError(Exception):
    """A call that failed. `status` says how, the text what was found and what was expected."""

    def __init__(self, message: str, status: Status = Status.INTERNAL_ERROR) -> None:
        """Keep message and status."""
        super().__init__(message)
        self.status = status

    def __reduce__(self) -> tuple:
        """Pickle with the status, so that the exception comes back from another process."""
        return type(self), (str(self), self.status)


class PhysicalError(HypofabError):
    """The model has no answer: loss of controllability or uniqueness, a state outside the domain, ..."""


class InputError(HypofabError, ValueError):
    """A material, a state, an argument or a file is wrong."""


class InternalError(HypofabError):
    """Memory, result files, or the library itself."""


def error_of(status: int, message: str) -> HypofabError:
    """The exception of a status that is not OK."""
    kind = PhysicalError if status < Status.BAD_MATERIAL else InputError if status < Status.NO_MEMORY else InternalError
    return kind(message, Status(status))
