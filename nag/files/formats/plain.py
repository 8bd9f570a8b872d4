"""Plain text: a polynomial a line."""

from __future__ import annotations

import re

from nag.algebra.system import PolynomialSystem
from nag.algebra.tokens import (
    CONSTANTS,
    IMAGINARY_UNITS,
    ExpressionError,
    imaginary_text,
    is_not_finite,
    natural_order,
    not_finite_text,
    taken_text,
    tokenize,
)
from nag.files.formats.source import GivenSystem, Passage, SourceFile, check_names

# Before a polynomial that is no equation, in a comment in the files of all programs.
NONZERO = "must not vanish: "

_COMMENT = re.compile(r"(?:#|//|%|--)[^\n]*")
_HEAD = re.compile(r"(variables?|imaginary)\s*:?\s+", re.IGNORECASE)
# Begun only where the run does: else each of its characters would be tried.
_END = re.compile(r"(?<![\s,;])[\s,;]+$")


def read(source: SourceFile) -> GivenSystem:
    """A system, one polynomial or equation a line; lines may end with a comma or a semicolon.

    A first line ``variables x, y`` gives their order, else it is alphabetical (x2 before x10); a
    first line ``imaginary I`` says what the imaginary unit is called. By itself ``I`` is it where
    variables are given and it is none of them, and in values of parameters.
    Comments begin with ``#``, ``//``, ``%`` or ``--``.

    Raises:
        CaseError: if a line holds what no expression holds.
    """
    source = source.without(_COMMENT)
    lines, offset = [], 0
    for line in source.text.split("\n"):
        lines.append(Passage(_END.sub("", line), offset).stripped())
        offset += len(line) + 1
    lines = [line for line in lines if line.text]
    names: tuple[str, ...] | None = None
    units: tuple[str, ...] | None = None
    letters: list[Passage] = []
    while lines and (head := _HEAD.match(lines[0].text)):
        line = lines.pop(0)
        listed = line.part(head.end(), len(line.text))
        separator = "," if "," in listed.text else " \t"
        passages = source.statements(listed, separator)
        given = check_names(source, passages)
        if head[1].lower() == "imaginary":
            units, letters = given, passages
        else:
            names = given
    for letter in letters:
        if names is not None and letter.text in names:
            source.fail(letter.offset, f"imaginary: {taken_text(letter.text)}")
    if names is None:
        occurring = _occurring(source, lines, units or ())
        names = tuple(sorted(occurring, key=natural_order))
    # An I that no line says what it is does not get here.
    return GivenSystem(names, tuple(lines), imaginary=("I",) if units is None else units)


def _occurring(source: SourceFile, lines: list[Passage], units: tuple[str, ...]) -> set[str]:
    names: set[str] = set()
    for line in lines:
        try:
            tokens = tokenize(line.text)
        except ExpressionError as error:
            source.fail(line.offset + (error.column or 1) - 1, error.reason)
        for token in tokens:
            if token.kind != "name" or token.text in units:
                continue
            if token.text in IMAGINARY_UNITS:
                mend = f"begin with a line 'imaginary {token.text}' if it is, or "
                mend += "'variables ...' that lists it"
                source.fail(line.offset + token.column - 1, imaginary_text(token.text, mend))
            if is_not_finite(token.text):
                mend = "if it is a variable, begin with a line 'variables ...' that lists it"
                source.fail(line.offset + token.column - 1, not_finite_text(token.text, mend))
            if token.text not in CONSTANTS:
                names.add(token.text)
    return names


def write(system: PolynomialSystem, title: str) -> str:
    """The system, one polynomial a line."""
    names, texts = system.variables, system.text()
    unit = []
    if system.imaginary:
        names, texts, unit = names[:-1], texts[:-1], [f"imaginary {names[-1]}"]
    nonzero = [f"# {NONZERO}{f.text(system.variables)}" for f in system.nonzero]
    lines = [f"# {title}", *nonzero, f"variables {', '.join(names)}", *unit, *texts]
    return "\n".join(lines) + "\n"
