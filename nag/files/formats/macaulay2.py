"""Ideals and lists of polynomials as Macaulay2 takes them: a ring, then polynomials in it."""

from __future__ import annotations

import itertools
import re
from collections.abc import Sequence
from typing import NoReturn

from nag.algebra.tokens import RESERVED, quote
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
_FINITE_NAMED = re.compile(r"\b([A-Za-z]\w*)\s*=\s*(?:ZZ\s*/\s*\w+|GF\b[^\[\n;]{0,99})[;\n]")
# A name before what it is applied to, and words of programs.
_APPLIED = re.compile(r"""(?<![\w.])([A-Za-z]\w*+)(?<!_)(?=[ \t]*[({"]|[ \t]+[A-Za-z])""")
# What is done to a list of polynomials, so that it is none that is meant to vanish.
_MADE_OF_LIST = ("ideal", "minors", "pfaffians", "det", "jacobian", "permanents", "exteriorPower")
_IDEALS = ("ideal", "polySystem", "matrix")
_SUM = re.compile(r"\+[ \t]*ideal\b")
_QUOTED = re.compile(r'\bideal\b[ \t(]*"')
# A number as an element of a ring, 0_R.
_IN_RING = re.compile(r"\b([0-9]+)(_[A-Za-z]\w*)\b")
_IDEAL = re.compile(r"\bideal[ \t]*\(")
_NAME = re.compile(r"[A-Za-z]\w*")
_SUMS = "sums of ideals are not read; write one ideal(..., ...)"
_IN_QUOTES = "polynomials in quotes are not read; write ideal(..., ...), with '*' and '^'"
_OPERATIONS = (
    "what is made of ideals is not worked out here; write the polynomials, as Macaulay2 prints "
    "them with toString: ideal(..., ...)"
)
_ASSIGNED = re.compile(r"\s*([A-Za-z]\w*)\s*:?=(?!=)\s*")
_OF_LIST = re.compile(r"ideal\b\s*\(?\s*(?:flatten\s+entries\s+)?([A-Za-z]\w*)\s*\)?")
_LISTED = re.compile(r"((?:ideal|polySystem)\b\s*)?(?:matrix\b\s*)?([({])")
# What is made of an ideal by an operator.
_OPERATED = re.compile(r"\)[ \t]*(\^|:|\*)")
_SUBSCRIPT = re.compile(r"\b([A-Za-z]\w*)_\(([0-9]+(?:,[0-9]+)*)\)")
_RANGE = re.compile(r"(.+?)\.\.(.+)")
_INDEXED = re.compile(r"([A-Za-z]\w*?)_(?:([0-9]{1,6})|\{([0-9]{1,6}(?:,[0-9]{1,6})*)\})")

# Lists in each other, as a matrix of one row is.
MOST_NESTED = 8


def recognise(text: str) -> bool:
    """Whether a text makes a ring as Macaulay2 does, or an ideal."""
    plain = _COMMENT.sub("", text)
    return bool(_find_ring(plain) or _FINITE.search(plain) or _IDEAL.search(plain))


def _find_ring(text: str, start: int = 0) -> re.Match[str] | None:
    """Where a ring begins, over a field by its own name or one that it is given."""
    return _RING.search(text, start) or _find_named_ring(text, _NAMED, start)


def _find_named_ring(text: str, named: re.Pattern[str], start: int = 0) -> re.Match[str] | None:
    """Where a ring begins over a field that is given a name by such a statement."""
    names = named.findall(text)
    if not names:
        return None
    return re.compile(rf"\b({'|'.join(dict.fromkeys(names))})[ \t]*\[").search(text, start)


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
    finite = _FINITE.search(source.text) or _find_named_ring(source.text, _FINITE_NAMED)
    if finite:
        source.fail(finite.start(), "a ring over a finite field; write QQ[...]")
    if ring is None:
        source.fail(0, "there is no ring; write R = QQ[x, y]")
    end = _closing(source, ring.end() - 1)
    behind = source.text[end + 1 :].lstrip(" \t")
    at = len(source.text) - len(behind)
    if behind.startswith("/"):
        source.fail(at, "a quotient ring; add its polynomials to the ideal")
    if re.match(r"\)?[ \t]*\[", behind):
        source.fail(ring.start(), "coefficients with unknowns; write one ring QQ[a, x, y]")
    second = _find_ring(source.text, end)
    if second is not None:
        source.fail(second.start(), "a second ring; leave one in the file")
    tensor = source.text.find("**", end)
    if tensor >= 0:
        source.fail(tensor, "'**' is a tensor product in Macaulay2; write '^' for a power")
    listed = Passage(source.text[ring.end() : end], ring.end())
    names = [n for item in source.statements(listed, ",") for n in _ring_names(source, item)]
    variables = check_names(source, names)
    read = _Statements(source, variables)
    for statement in _statements(source, end + 1):
        read.statement(statement)
    return GivenSystem(variables, *read.choose_ideal(), imaginary=(*dict.fromkeys(units), "ii"))


class _Statements:
    """What has a name so far, statement by statement."""

    def __init__(self, source: SourceFile, variables: tuple[str, ...]) -> None:
        self._source, self._variables = source, variables
        # What may be an ideal that is not read.
        self._unread: list[Passage] = []
        self._others: list[Passage] = []
        self._definitions: dict[str, Passage] = {}
        # Where the ideals and lists begin, and their polynomials.
        self._ideals: list[tuple[Passage, tuple[Passage, ...]]] = []
        # Names of ideals, and of lists and matrices of polynomials.
        self._named: dict[str, bool] = {}

    def statement(self, statement: Passage) -> None:
        """Read one; what gives nothing a name, as a command that prints, is left out."""
        assigned = _ASSIGNED.match(statement.text)
        right = statement.part(assigned.end(), len(statement.text)) if assigned else statement
        of_list = _OF_LIST.fullmatch(right.text)
        if of_list and of_list[1] in self._named:
            # The list itself is read.
            return
        polynomials = _polynomials(self._source, right)
        used = {*_NAME.findall(right.text)} & self._named.keys()
        if polynomials is not None:
            self._ideals.append((statement, polynomials))
            if assigned:
                self._named[assigned[1]] = right.text.startswith(("ideal", "polySystem"))
        elif assigned and used:
            self._check_made(right, used)
        elif re.search(r"\bideal\b", right.text):
            self._unread.append(right)
        elif assigned:
            self._others.append(right)
            self._definitions[assigned[1]] = right

    def _check_made(self, right: Passage, used: set[str]) -> None:
        """Leave what a program goes on to make of its ideal; another ideal may be the one meant."""
        if _IDEAL.search(right.text) and "+" in right.text:
            self._source.fail(right.offset, _SUMS)
        made = [m for m in _APPLIED.finditer(right.text) if m[1] not in self._variables]
        of_list = not all(self._named[name] for name in used)
        for call in made:
            if len(used) > 1 or (of_list and call[1] in _MADE_OF_LIST):
                function = next((m for m in made if m[1] not in _IDEALS), call)
                self._refuse(right.offset + function.start(), function[1])
        if len(used) > 1:
            self._source.fail(right.offset, _SUMS if "+" in right.text else _OPERATIONS)

    def choose_ideal(self) -> tuple[tuple[Passage, ...], dict[str, Passage], dict[str, Passage]]:
        """The polynomials of the one ideal or list, no parameters, and what they are made of."""
        source = self._source
        for _, polynomials in self._ideals:
            for each in polynomials:
                self._refuse_calls(each)
        self._refuse_operations(self._unread if self._ideals else [*self._unread, *self._others])
        if not self._ideals:
            source.fail(len(source.text.rstrip()), "there is no ideal; write ideal(..., ...)")
        if len(self._ideals) > 1:
            at = self._ideals[1][0].offset
            source.fail(at, "a second ideal or list; leave one in the file")
        _, polynomials = self._ideals[0]
        needed, front = dict[str, Passage](), list(polynomials)
        while front:
            passage = front.pop()
            self._refuse_calls(passage)
            used = {*_NAME.findall(passage.text)}
            names = {n for n in used if n in self._definitions and n not in needed}
            needed |= {name: self._definitions[name] for name in names}
            front += [self._definitions[name] for name in names]
        kept = {n: text for n, text in self._definitions.items() if n in needed}
        return polynomials, {}, kept

    def _refuse_calls(self, passage: Passage, besides: tuple[str, ...] = ()) -> None:
        """Refuse what would be worked out by a function, by its name."""
        known = {*self._variables, *self._definitions, *RESERVED, *besides}
        for call in _APPLIED.finditer(passage.text):
            if call[1] not in known:
                self._refuse(passage.offset + call.start(), call[1])

    def _refuse(self, offset: int, function: str) -> NoReturn:
        self._source.fail(
            offset,
            f"{function} is not worked out here; write the polynomials that it gives, as Macaulay2 "
            "prints them with toString: ideal(..., ...)",
        )

    def _refuse_operations(self, rights: Sequence[Passage]) -> None:
        """Refuse what would make an ideal, by its name, and other ways to write one."""
        for right in rights:
            first = re.search(r"\bideal\b", right.text)
            behind = len(right.text) if first is None else first.end()
            if first is not None and _SUM.search(right.text, behind):
                self._source.fail(right.offset + first.start(), _SUMS)
            quoted = _QUOTED.search(right.text)
            if quoted is not None:
                self._source.fail(right.offset + quoted.start(), _IN_QUOTES)
            self._refuse_calls(right, _IDEALS)
            operated = _OPERATED.search(right.text, behind)
            if operated is not None:
                self._source.fail(right.offset + operated.start(1), _OPERATIONS)


def _is_of_unit(field: re.Match[str]) -> bool:
    """Whether a field's generator is a square root of -1."""
    square = f"{field['unit']}^2"
    return re.sub(r"\s", "", field["least"]) in (f"{square}+1", f"1+{square}")


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
    """The entries of ``ideal(...)``, ``ideal {...}``, ``{...}`` or a matrix by rows, or None."""
    for _ in range(MOST_NESTED):
        match = _LISTED.match(text.text)
        if match is None or (match.group(0) == "(" and not text.text.startswith("{")):
            return None
        opening = text.offset + match.end() - 1
        end = _closing(source, opening)
        if source.text[end + 1 : text.offset + len(text.text)].strip():
            return None
        text = Passage(source.text[opening + 1 : end], opening + 1).stripped()
        inner = _LISTED.fullmatch(text.text[: 1 + text.text.find("{")])
        if inner is None or not text.text.endswith("}"):
            return tuple(source.statements(text, ","))
        rows = source.statements(text, ",")
        if len(rows) > 1:
            # Those of a matrix.
            inside = [_unwrap_row(source, row) for row in rows]
            return tuple(entry for row in inside for entry in source.statements(row, ","))
    source.fail(text.offset, "lists in lists; write their entries in one list")


def _unwrap_row(source: SourceFile, row: Passage) -> Passage:
    if not (row.text.startswith("{") and row.text.endswith("}")):
        source.fail(row.offset, "lists in lists; write their entries in one list")
    return row.part(1, len(row.text) - 1)
