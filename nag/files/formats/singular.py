"""Ideals as Singular takes them: a ring of characteristic 0, then polynomials in it."""

from __future__ import annotations

import itertools
import re
from collections.abc import Container

from nag.algebra.tokens import quote
from nag.files.case_table import MAX_ENTRIES
from nag.files.formats.source import GivenSystem, Passage, SourceFile, check_names

_COMMENT = re.compile(r"//[^\n]*|/\*.*?(?:\*/|\Z)", re.DOTALL)
_RING = re.compile(r"\s*ring\s+\w+\s*=\s*")
_RECOGNISED = re.compile(r"^[ \t]*ring\s+\w+\s*=", re.MULTILINE)
_DEFINED = re.compile(r"\s*(poly|number|ideal)\s+(\w+)\s*=\s*")
_ASSIGNMENT = re.compile(r"[^=<>!]=[^=]")
_PARAMETER = re.compile(r"\(\s*0\s*,\s*([A-Za-z]\w*)\s*\)")
_MINPOLY = re.compile(r"minpoly\s*=\s*(.*)", re.DOTALL)
_INDEXED = re.compile(r"\b(\w+)((?:\([0-9]{1,6}(?:\.\.[0-9]{1,6})?\))+)")
_BOUNDS = re.compile(r"\(([0-9]+)(?:\.\.([0-9]+))?\)")
# 3x2y stands for 3*x^2*y where all variables are single letters.
_SHORT = re.compile(r"(?<![\w.])([0-9]*)((?:[A-Za-z][0-9]*)+)(?!\w)")
_LETTER = re.compile(r"([A-Za-z])([0-9]*)")


def recognise(text: str) -> bool:
    """Whether a text makes a ring as Singular does."""
    return _RECOGNISED.search(_COMMENT.sub("", text)) is not None


def read(source: SourceFile) -> GivenSystem:
    """The system of the ring and the one ideal in a text for Singular.

    Raises:
        CaseError: if the ring is not of characteristic 0, or there is not one ideal.
    """
    source = source.without(_COMMENT)
    source.refuse_towers()
    statements = source.statements()
    rings = [(s, m) for s in statements if (m := _RING.match(s.text))]
    if not rings:
        source.fail(0, "there is no ring; write ring r = 0, (x, y), dp;")
    if len(rings) > 1:
        source.fail(rings[1][0].offset, "a second ring; leave one in the file")
    minpolys = [s for s in statements if _MINPOLY.match(s.text)]
    names, bases, units = _read_ring(
        source, rings[0][0].part(rings[0][1].end(), len(rings[0][0].text)), minpolys
    )
    definitions, ideals = {}, []
    single = (*names, *units)
    letters = all(len(name) == 1 for name in single)
    for statement in statements:
        defined = _DEFINED.match(statement.text)
        if defined is None:
            known = _RING.match(statement.text) or statement in minpolys
            if _ASSIGNMENT.search(statement.text) and not known:
                message = f"{quote(statement.text)} is not read; write 'ideal i = ..., ...;'"
                source.fail(statement.offset, message)
            continue
        right = statement.part(defined.end(), len(statement.text))
        texts = [_names_indexed(t, bases) for t in source.statements(right, ",")]
        texts = [_write_out(t, single, definitions) for t in texts] if letters else texts
        if defined[1] == "ideal":
            ideals.append((statement, tuple(texts)))
        elif len(texts) == 1:
            definitions[defined[2]] = texts[0]
        else:
            message = f"{quote(defined[2])} is {len(texts)} polynomials; write one"
            source.fail(right.offset, message)
    if not ideals:
        source.fail(len(source.text.rstrip()), "there is no ideal; write ideal i = ..., ...;")
    if len(ideals) > 1:
        source.fail(ideals[1][0].offset, "a second ideal; leave one in the file")
    return GivenSystem(names, ideals[0][1], {}, definitions, imaginary=units)


def _read_ring(
    source: SourceFile, ring: Passage, minpolys: list[Passage]
) -> tuple[tuple[str, ...], frozenset[str], tuple[str, ...]]:
    """The variables of a ring, the names before their indices, and the imaginary unit."""
    parts = source.statements(ring, ",")
    if len(parts) < 2:
        source.fail(ring.offset, "a ring has a characteristic and variables; write 0, (x, y), dp")
    field = parts[0].text
    unit = _read_unit(source, parts[0], minpolys)
    plain = field in ("0", "QQ", "real", "complex") or field.startswith(("(real", "(complex"))
    if unit is None and not plain:
        message = (
            f"a ring over {quote(field)}; characteristic 0 without parameters is read, and with "
            "the imaginary unit: (0, i), minpoly = i^2 + 1;"
        )
        source.fail(parts[0].offset, message)
    listed = parts[1]
    if listed.text.startswith("(") and listed.text.endswith(")"):
        listed = listed.part(1, len(listed.text) - 1)
    names, bases = [], set()
    for item in source.statements(listed, ","):
        match = _INDEXED.fullmatch(item.text)
        if match is None:
            names.append(item)
            continue
        bases.add(match[1])
        bounds = [(int(b[1]), int(b[2] or b[1])) for b in _BOUNDS.finditer(match[2])]
        count = 1
        for low, high in bounds:
            count *= max(0, high - low + 1)
            if count > MAX_ENTRIES:
                source.fail(item.offset, f"more than {MAX_ENTRIES} variables; at most that many")
        for index in itertools.product(*(range(low, high + 1) for low, high in bounds)):
            names.append(Passage(match[1] + "".join(f"[{k}]" for k in index), item.offset))
    if unit is not None:
        return check_names(source, names), frozenset(bases), (unit,)
    parts = [part.strip() for part in field.rstrip(")").split(",")[1:]]
    units = tuple(part for part in parts if not part.isdigit()) or ("i",)
    is_complex = field.lstrip("(").startswith("complex")
    return check_names(source, names), frozenset(bases), units if is_complex else ()


def _read_unit(source: SourceFile, field: Passage, minpolys: list[Passage]) -> str | None:
    """The imaginary unit of a field (0, i) with its minimal polynomial; None of another field."""
    if not minpolys:
        return None
    if len(minpolys) > 1:
        source.fail(minpolys[1].offset, "a second minpoly; leave one in the file")
    name = _PARAMETER.fullmatch(field.text)
    match = _MINPOLY.match(minpolys[0].text)
    least = re.sub(r"[\s()^]", "", match[1]) if match else ""
    if name is None or least not in (f"{name[1]}2+1", f"1+{name[1]}2"):
        source.fail(
            minpolys[0].offset,
            f"{quote(minpolys[0].text)}; of fields with a root that with the imaginary unit is "
            "read: (0, i), minpoly = i^2 + 1;",
        )
    return name[1]


def _names_indexed(text: Passage, bases: frozenset[str]) -> Passage:
    """The same with ``x[1]`` for ``x(1)``, of the same length, so that columns stay."""

    def indexed(match: re.Match[str]) -> str:
        if match[1] not in bases:
            return match[0]
        return match[1] + match[2].replace("(", "[").replace(")", "]")

    return Passage(_INDEXED.sub(indexed, text.text), text.offset)


def _write_out(text: Passage, names: tuple[str, ...], defined: Container[str]) -> Passage:
    """The same with all products and powers written, where all variables are letters.

    A monomial is one name to Singular: xy^2 is (xy)^2, and 3x^2 is (3x)^2. Names that are defined
    come first.
    """

    def product(match: re.Match[str]) -> str:
        letters = _LETTER.findall(match[2])
        if match[2] in defined or not all(letter in names for letter, _ in letters):
            return match[0]
        if not match[1] and match[2] in names:
            return match[0]
        factors = [f"{letter}^{power}" if power else letter for letter, power in letters]
        whole = "*".join([match[1], *factors] if match[1] else factors)
        behind = text.text[match.end() : match.end() + 2].lstrip()
        return f"({whole})" if behind.startswith("^") else whole

    return Passage(_SHORT.sub(product, text.text), text.offset)
