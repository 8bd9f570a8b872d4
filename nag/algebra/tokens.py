"""The words that expressions are made of, and how mistakes in them are reported."""

from __future__ import annotations

import difflib
import re
import unicodedata
from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

from nag.errors import EquationError

MAX_LENGTH = 100_000
# Of more names of variables a message lists the first.
MOST_NAMES = 12

FUNCTION_NAMES = ("sqrt", "sin", "cos")
# What pi is called; but for the first one, where nothing else is declared by that name.
PI_NAMES = ("pi", "π", "Pi")
RESERVED = frozenset(FUNCTION_NAMES) | {PI_NAMES[0]}
# Names that are no variables where these are not listed.
CONSTANTS = RESERVED | {*PI_NAMES}
# Names that mostly stand for the imaginary unit: taken for variables only where they are listed.
IMAGINARY_UNITS = ("I", "i", "J", "j", "ii", "im")
# How programs print what is no finite number, in any case: variables only where they are listed.
NOT_FINITE = ("nan", "inf", "infinity")
ONLY_REAL = "only real numbers are read here"

# A letter of any alphabet and what may follow it: digits, an index as in x_{12} or x[1,2], primes.
# Not superscripts, which are powers.
_WORD = (
    r"[^\W\d\u00b2\u00b3\u00b9\u2070-\u207f][^\W\u00b2\u00b3\u00b9\u2070-\u207f]*"
    r"(?:(?<=_)\{[0-9A-Za-z]+(?:,[0-9A-Za-z]+)*\})?(?:\[[0-9A-Za-z]+(?:,[0-9A-Za-z]+)*\])*'*"
)
_TOKEN = re.compile(
    r"(?:(?P<number>(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"
    rf"|(?P<name>{_WORD})"
    r"|(?P<operator>\*\*|==|[-+*/^()=]))\s*"
)
_SPACE = re.compile(r"\s*")
_NAME = re.compile(_WORD)
_PARTS = re.compile(r"\d+|\D+")
# What stands between names of a list, and in no brackets.
_BETWEEN = re.compile(r"[\s,]+(?![^\[{]*[\]}])")


# Signs of typesetting, and what is written for them.
MEANT = dict.fromkeys("\u00b7\u00d7\u2217\u22c5", "*") | dict.fromkeys("\u2212\u2013", "-")


class ExpressionError(EquationError):
    """Text that is no number or polynomial; one line: where, what is wrong, what would be right.

    Attributes:
        reason: the line without the place.
        column: where in the text, from 1, or None.
    """

    def __init__(self, reason: str, column: int | None = None) -> None:
        super().__init__(reason if column is None else f"column {column}: {reason}")
        self.reason = reason
        self.column = column


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
            mend = MEANT.get(text[at]) or superscript_mend(text[at])
            mend = mend or "numbers, names, + - * / ^ and parentheses"
            raise ExpressionError(f"{quote(text[at])} has no meaning here; write {mend}", at + 1)
        kind = str(match.lastgroup)
        tokens.append(Token(kind, match[kind], at + 1))
        at = match.end()
    tokens.append(Token("end", "", len(text) + 1))
    return tokens


def superscript_mend(sign: str) -> str:
    """The power that a raised digit stands for; empty for any other sign."""
    return f"^{unicodedata.digit(sign)}" if sign.isdigit() and not sign.isdecimal() else ""


def names_in(text: str) -> frozenset[str]:
    """Names that occur in ``text``, none if it is no expression at all."""
    try:
        return frozenset(t.text for t in tokenize(text) if t.kind == "name") - RESERVED
    except ExpressionError:
        return frozenset()


def is_name(text: str) -> bool:
    """Whether ``text`` can name a variable or a parameter."""
    return len(text) <= 100 and _NAME.fullmatch(text) is not None and text not in RESERVED


def is_part_name(text: Any) -> bool:
    """Whether ``text`` can name what variables are named after: ``A`` and ``12``, as in x_A."""
    return isinstance(text, str) and bool(text) and is_name(f"x_{text}")


def part_name_text(name: Any, part: str) -> str:
    """What to say of a name that no variable can be named after."""
    return f"{quote(str(name))} cannot name a {part}; use letters, digits and _"


def list_names(names: Any) -> list[str]:
    """Names that are given one by one, or in a text with commas or blanks between.

    Names may be sympy's symbols as well, and commas in brackets stand between indices.

    >>> list_names("x, y z[1,2]"), list_names(["x", "y"])
    (['x', 'y', 'z[1,2]'], ['x', 'y'])
    """
    if isinstance(names, str):
        return [name for name in _BETWEEN.split(names) if name]
    return [str(name) for name in (names if isinstance(names, Iterable) else [names])]


def natural_order(name: str) -> list[tuple[int, int, str]]:
    """A key that sorts names alphabetically, numbers in them by their values, however long."""
    return [
        (0, len(digits := part.lstrip("0")), digits) if part.isdecimal() else (1, 0, part)
        for part in _PARTS.findall(name)
    ]


def imaginary_text(name: str, mend: str) -> str:
    """What to say where a name looks like the imaginary unit."""
    return f"{quote(name)} looks like the imaginary unit; {mend}"


def is_not_finite(name: str) -> bool:
    """Whether a name is how programs print what is no finite number."""
    return name.lower() in NOT_FINITE


def not_finite_text(name: str, mend: str) -> str:
    """What to say where a name looks like a number that was not finite."""
    return f"{quote(name)} looks like a value that is no finite number; {mend}"


def root_text(degree: int) -> str:
    """What to write for a root of a variable, in which polynomials are none."""
    shown = str(degree) if degree < 10**30 else "k"
    return f"for the root take a variable w, with the equation w^{shown} = x"


def taken_text(unit: str) -> str:
    """What to say where the name that the imaginary unit is given is a variable or a parameter."""
    return f"{quote(unit)} is taken; write a letter of its own"


def unit_called(unit: str) -> str:
    """What to write where something else looks like the imaginary unit."""
    return f"it is called {unit!r} here"


def nearest(name: str, known: Iterable[str]) -> str:
    """`` (did you mean ...?)`` with the nearest of the known names, or nothing."""
    match = difflib.get_close_matches(name[:100], sorted(known), n=1, cutoff=0.5)
    return f" (did you mean {match[0]!r}?)" if match else ""


def shorten_names(names: Sequence[str]) -> str:
    """Names behind each other, of many the first."""
    return ", ".join(names[:MOST_NAMES]) + ", ..." * (len(names) > MOST_NAMES)


def quote(text: str, width: int = 40) -> str:
    """``text`` in quotes on one line, shortened."""
    return repr(text if len(text) <= width else text[: width - 3] + "...")
