"""Which program's a file is, told by its content, and the system in it."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from nag.algebra.number import ComplexNumber, Number
from nag.algebra.system import PolynomialSystem
from nag.files.formats import bertini, julia, macaulay2, phcpack, plain, singular
from nag.files.formats.source import (
    GivenSystem,
    Passage,
    SourceFile,
    free_parameters,
    read_given,
)

READERS: Mapping[str, Callable[[SourceFile], GivenSystem]] = {
    "bertini": bertini.read,
    "phc": phcpack.read,
    "m2": macaulay2.read,
    "singular": singular.read,
    "hc": julia.read,
    "text": plain.read,
}
_RECOGNISED: Mapping[str, Callable[[str], bool]] = {
    "bertini": bertini.recognise,
    "singular": singular.recognise,
    "m2": macaulay2.recognise,
    "hc": julia.recognise,
    "phc": phcpack.recognise,
}

_NONZERO = re.compile(rf"^[ \t]*(?:%|#|//|--)?[ \t]*{plain.NONZERO}([^\n]*)", re.MULTILINE)


def recognise_format(text: str) -> str:
    """The name of the format of a text, ``text`` where it is none of a program's."""
    return next((name for name, is_one in _RECOGNISED.items() if is_one(text)), "text")


def read_system_text(
    file: str,
    text: str,
    format: str,
    values: Mapping[str, str | Number] | None = None,
    *,
    freed: Sequence[str] = (),
) -> tuple[PolynomialSystem, dict[str, Number | ComplexNumber], tuple[str, ...]]:
    """The system that a text in one of `READERS` gives, and the values of its parameters.

    Parameters without a value are named besides; they are its last variables.

    Args:
        values: other values of some parameters.
        freed: parameters that are its last variables instead.

    Raises:
        CaseError: if it cannot be read; one line says where, and what would be right.
    """
    source = SourceFile(file, text.replace("\r\n", "\n").replace("\r", "\n"))
    given = READERS[format](source)
    nonzero = [Passage(m[1], m.start(1)).stripped() for m in _NONZERO.finditer(source.text)]
    given = replace(given, nonzero=tuple(nonzero))
    if freed:
        given = free_parameters(source, given, freed)
    return read_given(source, given, values)
