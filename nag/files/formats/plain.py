"""Plain text: a polynomial a line."""

from __future__ import annotations

import re

from nag.algebra.system import PolynomialSystem
from nag.algebra.tokens import (
    IMAGINARY_UNITS,
    RESERVED,
    ExpressionError,
    imaginary_text,
    natural_order,
    tokenize,
)
from nag.files.formats.source import GivenSystem, Source, Statement, check_names

_COMMENT = re.compile(r"(?:#|//|%|--)[^\n]*")
_VARIABLES = re.compile(r"\s*variables?\s*[:=]?\s+", re.IGNORECASE)
_END = re.compile(r"[\s,;]+$")


def read(source: Source) -> GivenSystem:
    """A system, one polynomial or equation a line; lines may end with a comma or a semicolon.

    A first line ``variables x, y`` gives their order, else it is alphabetical (x2 before x10).
    Comments begin with ``#``, ``//``, ``%`` or ``--``.

    Raises:
        CaseError: if a line holds what no expression holds.
    """
    source = source.without(_COMMENT)
    lines, offset = [], 0
    for line in source.text.split("\n"):
        lines.append(Statement(_END.sub("", line), offset).stripped())
        offset += len(line) + 1
    lines = [line for line in lines if line.text]
    if lines and (head := _VARIABLES.match(lines[0].text)):
        listed = lines[0].part(head.end(), len(lines[0].text))
        separator = "," if "," in listed.text else " \t"
        names = check_names(source, source.statements(listed, separator))
        return GivenSystem(names, tuple(lines[1:]))
    names = _occurring(source, lines)
    return GivenSystem(tuple(sorted(names, key=natural_order)), tuple(lines))


def _occurring(source: Source, lines: list[Statement]) -> set[str]:
    names: set[str] = set()
    for line in lines:
        try:
            tokens = tokenize(line.text)
        except ExpressionError as error:
            source.fail(line.offset + (error.column or 1) - 1, error.reason)
        for token in tokens:
            if token.kind == "name" and token.text in IMAGINARY_UNITS:
                mend = "rename the variable, or begin with a line 'variables ...' that lists it"
                source.fail(line.offset + token.column - 1, imaginary_text(token.text, mend))
            if token.kind == "name" and token.text not in RESERVED:
                names.add(token.text)
    return names


def write(system: PolynomialSystem, title: str) -> str:
    """The system, one polynomial a line."""
    lines = [f"# {title}", f"variables {', '.join(system.variables)}", *system.text()]
    return "\n".join(lines) + "\n"
