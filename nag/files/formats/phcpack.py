"""Files of PHCpack: the number of polynomials, then each with a semicolon after it.

The grammar is that of PHCpack's manual: a second number is that of unknowns, variables are in the
order of their first occurrence, and what follows the last polynomial (start solutions, titles) is
no part of the system.
"""

from __future__ import annotations

import re

from nag.algebra.tokens import RESERVED, ExpressionError, is_not_finite, not_finite_text, tokenize
from nag.files.case_table import MAX_ENTRIES
from nag.files.formats.source import GivenSystem, Passage, SourceFile, check_names

_HEAD = re.compile(r"\s*([0-9]{1,9})(?:[ \t]+([0-9]{1,9}))?[^\n;]*\n")
# A further polynomial: titles and solutions have colons and no semicolon before them.
_MORE = re.compile(r"\s*([^\s;:=][^;:=]*;)")
IMAGINARY = ("i", "I")


def recognise(text: str) -> bool:
    """Whether a text begins as a file of PHCpack does."""
    return _HEAD.match(text + "\n") is not None and ";" in text


def read(source: SourceFile) -> GivenSystem:
    """The system of a file of PHCpack.

    Raises:
        CaseError: if it has fewer polynomials or other unknowns than it says.
    """
    head = _HEAD.match(source.text)
    if head is None:
        source.fail(0, "a file of PHCpack begins with the number of polynomials; write it")
    count = int(head[1])
    if not 1 <= count <= MAX_ENTRIES:
        source.fail(head.start(1), f"{count} polynomials; from 1 to {MAX_ENTRIES} are read")
    equations, start = [], head.end()
    for k in range(count):
        end = source.text.find(";", start)
        if end < 0:
            message = f"{k} of {count} polynomials end with ';'; write all of them"
            source.fail(len(source.text.rstrip()), message)
        equations.append(Passage(source.text[start:end], start).stripped())
        start = end + 1
    more = _MORE.match(source.text, start)
    if more is not None:
        message = f"more polynomials than the {count} that are said; write their number"
        source.fail(more.start(1), message)
    names = _names_in_order(source, equations)
    unknowns = int(head[2]) if head[2] else None
    if unknowns is not None and unknowns != len(names):
        source.fail(
            head.start(2),
            f"{unknowns} unknowns are said, and {len(names)} occur ({', '.join(names[:9])}); "
            "write their number",
        )
    return GivenSystem(names, tuple(equations), imaginary=IMAGINARY)


def _names_in_order(source: SourceFile, equations: list[Passage]) -> tuple[str, ...]:
    found: dict[str, Passage] = {}
    for equation in equations:
        try:
            tokens = tokenize(equation.text)
        except ExpressionError as error:
            source.fail(equation.offset + (error.column or 1) - 1, error.reason)
        for token in tokens:
            if token.kind == "name" and token.text not in RESERVED | {*IMAGINARY}:
                at = equation.offset + token.column - 1
                if is_not_finite(token.text):
                    source.fail(at, not_finite_text(token.text, "write a number"))
                found.setdefault(token.text, Passage(token.text, at))
    return check_names(source, found.values())
