"""What can go wrong, with the messages of the program (docs/architecture.md, "Errors").

Physics that does not succeed (never peaked, unstable) is no error: Specimen.status says it.
"""
from typing import List, NamedTuple


class Problem(NamedTuple):
    """One thing wrong with the input."""

    where: str  #: "rock.csv:3", or the function; empty: key is an argument
    key: str  #: "matrix.E_c"
    value: str  #: as it was given
    expected: str  #: unit and admissible range
    remedy: str  #: what to do


class Error(Exception):
    """Whatever this package raises by itself."""


class InputError(Error, ValueError):
    """What was given cannot be used; `problems` holds all that was found, not only the first."""

    problems: List[Problem] = []


class IoError(Error, OSError):
    """A file cannot be read or written; nothing half-written stays."""


class InternalError(Error, RuntimeError):
    """A mistake of the program itself: please report it."""
