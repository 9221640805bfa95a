"""Exceptions of the package. Their texts are those of the library."""
from __future__ import annotations


class SightlineError(Exception):
    """What all exceptions of this package have in common."""


class BadArgument(SightlineError, ValueError):
    """An argument makes no sense; the text names it."""


class BadInput(SightlineError, ValueError):
    """A file is wrong; the text starts with FILE:LINE where there is one."""


class Unsupported(SightlineError):
    """The map calls for something that the chosen method does not know."""


class OutOfMemory(SightlineError, MemoryError):
    """There is not enough memory."""


class Cancelled(SightlineError):
    """The work was stopped before it was done."""


class FileError(SightlineError, OSError):
    """The system refused to read or write a file."""


class Closed(SightlineError, ValueError):
    """The plan or level was closed before."""


class SightlineWarning(UserWarning):
    """Something about the map is doubtful, and results may not be what was meant."""


# By the status of the library, from 1 on.
BY_STATUS: tuple[type[SightlineError], ...] = (
    BadArgument, BadInput, Unsupported, OutOfMemory, Cancelled, FileError)
