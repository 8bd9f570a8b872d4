"""The words that expressions are made of, and how mistakes in them are reported."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable
from typing import NamedTuple

from nag.errors import EquationError

MAX_LENGTH = 100_000

FUNCTION_NAMES = ("sqrt", "sin", "cos")
RESERVED = frozenset(FUNCTION_NAMES) | {"pi"}
# Names that mostly stand for the imaginary unit: taken for variables only where they are listed.
IMAGINARY_UNITS = ("I", "i", "J", "j")
ONLY_REAL = "only real numbers are read here"

_TOKEN = re.compile(
    r"(?:(?P<number>(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"
    r"|(?P<name>[A-Za-z_][A-Za-z_0-9]*)"
    r"|(?P<operator>\*\*|==|[-+*/^()=]))\s*"
)
_SPACE = re.compile(r"\s*")
_NAME = re.compile(r"[A-Za-z_][A-Za-z_0-9]*")


class ExpressionError(EquationError):
    """Text that is no number or polynomial; one line: where, what is wrong, what would be right."""


class Token(NamedTuple):
    """A word: its kind (number, name, operator, end), and the column it starts in, from 1."""

    kind: str
    text: str
    column: int


def tokenize(text: str) -> list[Token]:
    """The words of ``text``, an empty one of kind ``end`` last.

    Raises:
        ExpressionError: if it is too long, or holds what no expression holds.
    """
    if len(text) > MAX_LENGTH:
        raise ExpressionError(
            f"the expression is {len(text)} characters long; at most {MAX_LENGTH} are read"
        )
    tokens, at = [], _SPACE.match(text).end()
    while at < len(text):
        match = _TOKEN.match(text, at)
        if match is None:
            raise ExpressionError(
                f"column {at + 1}: {quote(text[at])} has no meaning here; "
                "write numbers, names, + - * / ^ and parentheses"
            )
        kind = str(match.lastgroup)
        tokens.append(Token(kind, match[kind], at + 1))
        at = match.end()
    tokens.append(Token("end", "", len(text) + 1))
    return tokens


def names_in(text: str) -> frozenset[str]:
    """Names that occur in ``text``, none if it is no expression at all."""
    try:
        return frozenset(t.text for t in tokenize(text) if t.kind == "name") - RESERVED
    except ExpressionError:
        return frozenset()


def is_name(text: str) -> bool:
    """Whether ``text`` can name a variable or a parameter."""
    return len(text) <= 100 and _NAME.fullmatch(text) is not None and text not in RESERVED


def imaginary_text(name: str, mend: str) -> str:
    """What to say where a name looks like the imaginary unit."""
    return f"{quote(name)} looks like the imaginary unit, but {ONLY_REAL}; {mend}"


def nearest(name: str, known: Iterable[str]) -> str:
    """`` (did you mean ...?)`` with the nearest of the known names, or nothing."""
    match = difflib.get_close_matches(name[:100], sorted(known), n=1, cutoff=0.5)
    return f" (did you mean {match[0]!r}?)" if match else ""


def quote(text: str, width: int = 40) -> str:
    """``text`` in quotes on one line, shortened."""
    return repr(text if len(text) <= width else text[: width - 3] + "...")
