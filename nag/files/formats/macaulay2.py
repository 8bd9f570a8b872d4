"""Ideals and lists of polynomials as Macaulay2 takes them: a ring, then polynomials in it."""

from __future__ import annotations

import itertools
import re

from nag.algebra.tokens import quote
from nag.files.case_table import MAX_ENTRIES
from nag.files.formats.source import GivenSystem, Passage, SourceFile, check_names

_COMMENT = re.compile(r"--[^\n]*|-\*.*?(?:\*-|\Z)", re.DOTALL)
# A field may have a name of its own: k = QQ; R = k[x, y].
_NAMED = re.compile(r"\b([A-Za-z]\w*)\s*=\s*(?:QQ|ZZ|RR|CC)(?:_\w+)?\s*[;\n]")
_RING = re.compile(r"\b(QQ|ZZ|RR|CC)(?:_\w+)?[ \t]*\[")
# The field with the imaginary unit, by whatever name: (QQ[i]/(i^2+1))[x, y], or with toField.
_UNIT = re.compile(
    r"(?:\b(?:toField|frac)\b[ \t]*)?(?P<open>\([ \t]*)?"
    r"\bQQ[ \t]*\[[ \t]*(?P<unit>[A-Za-z]\w{0,99})[ \t]*\][ \t]*/[ \t]*(?:ideal\b[ \t]*)?"
    r"\((?P<least>[^()\n]{1,120})\)"
    r"(?(open)[ \t]*\))"
)
_FINITE = re.compile(r"\b(?:ZZ\s*/\s*\w+|GF\b[^\[\n]{0,99})\s*\[")
_OPERATIONS = re.compile(
    r"\b(minors|pfaffians|intersect|saturate|eliminate|radical|quotient|trim|kernel|ker|gens|sum)\b"
)
_SUM = re.compile(r"\bideal\b[^;\n]*\+[ \t]*ideal\b")
_QUOTED = re.compile(r'\bideal\b[ \t(]*"')
# A number as an element of a ring, 0_R.
_IN_RING = re.compile(r"\b([0-9]+)(_[A-Za-z]\w*)\b")
_IDEAL = re.compile(r"\bideal[ \t]*\(")
_NAME = re.compile(r"[A-Za-z]\w*")
_SUMS = "sums of ideals are not read; write one ideal(..., ...)"
_ASSIGNED = re.compile(r"\s*([A-Za-z]\w*)\s*:?=(?!=)\s*")
_OF_LIST = re.compile(r"ideal\b\s*\(?\s*([A-Za-z]\w*)\s*\)?")
_LISTED = re.compile(r"(?:(?:ideal|polySystem|matrix)\b\s*)?([({])")
_SUBSCRIPT = re.compile(r"\b([A-Za-z]\w*)_\(([0-9]+(?:,[0-9]+)*)\)")
_RANGE = re.compile(r"(.+?)\.\.(.+)")
_INDEXED = re.compile(r"([A-Za-z]\w*?)_(?:([0-9]{1,6})|\{([0-9]{1,6}(?:,[0-9]{1,6})*)\})")

# Lists in each other, as a matrix of one row is.
MOST_NESTED = 8


def recognise(text: str) -> bool:
    """Whether a text makes a ring as Macaulay2 does, or an ideal."""
    plain = _COMMENT.sub("", text)
    return bool(_find_ring(plain) or _FINITE.search(plain) or _IDEAL.search(plain))


def _find_ring(text: str) -> re.Match[str] | None:
    """Where a ring begins, over a field by its own name or one that it is given."""
    found = _RING.search(text)
    if found is not None:
        return found
    names = _NAMED.findall(text)
    if not names:
        return None
    return re.search(rf"\b({'|'.join(dict.fromkeys(names))})[ \t]*\[", text)


def read(source: SourceFile) -> GivenSystem:
    """The system of the ring and the one ideal or list in a text for Macaulay2.

    Raises:
        CaseError: if there is no ring, or not one ideal.
    """
    source = source.without(_COMMENT)
    source.refuse_towers()
    # The same length, so that columns stay.
    subscripts = _SUBSCRIPT.sub(lambda m: f"{m[1]}_{{{m[2]}}}", source.text)
    subscripts = _IN_RING.sub(lambda m: m[1] + " " * len(m[2]), subscripts)
    units = [m["unit"] for m in _UNIT.finditer(subscripts) if _is_of_unit(m)]
    plain = _UNIT.sub(lambda m: "QQ".ljust(len(m[0])) if _is_of_unit(m) else m[0], subscripts)
    source = SourceFile(source.file, plain)
    ring = _find_ring(source.text)
    finite = _FINITE.search(source.text)
    if finite:
        source.fail(finite.start(), "a ring over a finite field; write QQ[...]")
    if ring is None:
        source.fail(0, "there is no ring; write R = QQ[x, y]")
    end = _closing(source, ring.end() - 1)
    behind = source.text[end + 1 :].lstrip(" \t")
    if behind.startswith("/"):
        at = len(source.text) - len(behind)
        source.fail(at, "a quotient ring; add its polynomials to the ideal")
    tensor = source.text.find("**", end)
    if tensor >= 0:
        source.fail(tensor, "'**' is a tensor product in Macaulay2; write '^' for a power")
    listed = Passage(source.text[ring.end() : end], ring.end())
    names = [n for item in source.statements(listed, ",") for n in _ring_names(source, item)]
    variables = check_names(source, names)
    definitions, ideals, lists = {}, [], set[str]()
    for statement in _statements(source, end + 1):
        assigned = _ASSIGNED.match(statement.text)
        right = statement.part(assigned.end(), len(statement.text)) if assigned else statement
        polynomials, of_list = _polynomials(source, right), _OF_LIST.fullmatch(right.text)
        if of_list and of_list[1] in lists:
            # The list itself is read.
            continue
        if polynomials is not None:
            ideals.append((statement, polynomials))
            lists |= {assigned[1]} if assigned else set()
        elif assigned and lists & set(_NAME.findall(right.text)):
            # What a program goes on to make of the ideal; another ideal may be the one meant.
            if _IDEAL.search(right.text):
                source.fail(right.offset, _SUMS)
        elif assigned:
            definitions[assigned[1]] = right
    if not ideals:
        _refuse_operations(source, end + 1)
        source.fail(len(source.text.rstrip()), "there is no ideal; write ideal(..., ...)")
    if len(ideals) > 1:
        source.fail(ideals[1][0].offset, "a second ideal or list; leave one in the file")
    return GivenSystem(
        variables, ideals[0][1], {}, definitions, imaginary=(*dict.fromkeys(units), "ii")
    )


def _is_of_unit(field: re.Match[str]) -> bool:
    """Whether a field's generator is a square root of -1."""
    square = f"{field['unit']}^2"
    return re.sub(r"\s", "", field["least"]) in (f"{square}+1", f"1+{square}")


def _refuse_operations(source: SourceFile, start: int) -> None:
    """Refuse an operation that would make an ideal, by its name, and other ways to write one."""
    for pattern, message in (
        (_SUM, _SUMS),
        (_QUOTED, "polynomials in quotes are not read; write ideal(..., ...), with '*' and '^'"),
    ):
        written = pattern.search(source.text, start)
        if written is not None:
            source.fail(written.start(), message)
    found = _OPERATIONS.search(source.text, start)
    if found is not None:
        source.fail(
            found.start(),
            f"{found[1]} is not worked out here; write the polynomials in ideal(..., ...), as "
            "Macaulay2 prints them with toString",
        )


def _closing(source: SourceFile, opening: int) -> int:
    """Where the bracket at ``opening`` is closed."""
    depth = 0
    for i in range(opening, len(source.text)):
        depth += (source.text[i] in "([{") - (source.text[i] in ")]}")
        if depth == 0:
            return i
    source.fail(opening, f"{source.text[opening]!r} is never closed; close it")


def _ring_names(source: SourceFile, item: Passage) -> list[Passage]:
    if "=>" in item.text:
        return []
    ends = _RANGE.fullmatch(item.text)
    if ends is None:
        return [item]
    first, last = ends[1].strip(), ends[2].strip()
    if len(first) == len(last) == 1 and first.isalpha() and first <= last:
        letters = (chr(k) for k in range(ord(first), ord(last) + 1))
        return [Passage(letter, item.offset) for letter in letters]
    low, high = _INDEXED.fullmatch(first), _INDEXED.fullmatch(last)
    if low is None or high is None or low[1] != high[1]:
        source.fail(item.offset, f"the range {quote(item.text)} is not understood; list the names")
    starts = [int(k) for k in (low[2] or low[3]).split(",")]
    stops = [int(k) for k in (high[2] or high[3]).split(",")]
    if len(starts) != len(stops):
        source.fail(item.offset, f"the range {quote(item.text)} has unequal ends; list the names")
    count = 1
    for a, b in zip(starts, stops, strict=True):
        count *= max(0, b - a + 1)
        if count > MAX_ENTRIES:
            source.fail(item.offset, f"more than {MAX_ENTRIES} variables; at most that many")
    ranges = [range(a, b + 1) for a, b in zip(starts, stops, strict=True)]
    pattern = "{0}_{1}" if low[2] else "{0}_{{{1}}}"
    return [
        Passage(pattern.format(low[1], ",".join(map(str, index))), item.offset)
        for index in itertools.product(*ranges)
    ]


def _statements(source: SourceFile, start: int) -> list[Passage]:
    """Statements from ``start``: to a semicolon, or to a line's end outside of brackets."""
    rest = Passage(source.text[start:], start)
    return source.statements(rest, ";\n")


def _polynomials(source: SourceFile, text: Passage) -> tuple[Passage, ...] | None:
    """The entries of ``ideal(...)``, ``ideal {...}``, ``ideal({...})`` or ``{...}``, or None."""
    for _ in range(MOST_NESTED):
        match = _LISTED.match(text.text)
        if match is None or (match.group(0) == "(" and not text.text.startswith("{")):
            return None
        opening = text.offset + match.end() - 1
        end = _closing(source, opening)
        if source.text[end + 1 : text.offset + len(text.text)].strip():
            return None
        text = Passage(source.text[opening + 1 : end], opening + 1).stripped()
        if not (text.text.startswith("{") and text.text.endswith("}")):
            return tuple(source.statements(text, ","))
    source.fail(text.offset, "lists in lists; write their entries in one list")
