"""Errors for users: one line each that names what is wrong, where, and what to give instead.

All are `NagError`, which is a ``ValueError``; the six below it say what the line is about.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Self


class NagError(ValueError):
    """An argument makes no sense, or a question has no answer that could be given.

    Those of all kinds can be pickled and copied, whatever they are made of.

    Attributes:
        keyword: the argument that would mend it, where that is another one than what is wrong;
            empty otherwise. Texts say what to do, and a command adds what its option is called.
    """

    keyword: str = ""

    def mended_by(self, keyword: str) -> Self:
        """The same error, which an argument of this name mends."""
        self.keyword = keyword
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        return _restore, (type(self), self.args, vars(self))


def _restore(kind: type[NagError], args: tuple[Any, ...], state: Mapping[str, Any]) -> NagError:
    """The error with these arguments and attributes; what it was made of need not be known."""
    error = kind.__new__(kind, *args)
    vars(error).update(state)
    return error


class InputError(NagError):
    """A file does not say what it should, or cannot be read or written."""


def unreadable(path: object, error: OSError | ValueError) -> str:
    """What to say of a file that cannot be read, one line, the same everywhere."""
    reason = getattr(error, "strerror", None) or error
    return f"{path}: cannot be read ({reason}); give the path of a file that is there"


class MechanismError(NagError):
    """A mechanism that makes no sense.

    Attributes:
        joint: name of the joint that is wrong, or None.
        body: name of the body that is wrong, or None.
        key: the field that is wrong (``type``, ``bodies``, ``axis``, ...), or None.
    """

    def __init__(
        self,
        message: str,
        *,
        joint: str | None = None,
        body: str | None = None,
        key: str | None = None,
    ) -> None:
        super().__init__(message)
        self.message = message
        self.joint = joint
        self.body = body
        self.key = key

    def __str__(self) -> str:
        owner = f"joint {self.joint!r}" if self.joint is not None else ""
        if not owner and self.body is not None:
            owner = f"body {self.body!r}"
        return ": ".join([*filter(None, (owner, self.key)), self.message])


class EquationError(NagError):
    """Equations, symmetries or maps are no exact polynomials, or do not fit each other."""


class StartError(NagError):
    """A start system cannot be used, or would need too many paths."""


class ComponentError(NagError):
    """What was asked of a component was not found, or could not be decided."""


class TimeLimitError(NagError):
    """A time limit was reached before there was an answer.

    Attributes:
        found: what was found by then, an incomplete answer of a part of the work; None if nothing.
    """

    def __init__(self, message: str, found: object = None) -> None:
        super().__init__(message)
        self.message = message
        self.found = found

    def __str__(self) -> str:
        return self.message
