"""Ideals as Singular takes them: a ring of characteristic 0, then polynomials in it."""

from __future__ import annotations

import itertools
import re
from collections.abc import Container
from dataclasses import replace
from typing import NoReturn

from nag.algebra.tokens import names_in, quote
from nag.files.case_table import MAX_ENTRIES
from nag.files.formats.source import GivenSystem, Passage, SourceFile, check_names

_COMMENT = re.compile(r"//[^\n]*|/\*.*?(?:\*/|\Z)", re.DOTALL)
_RING = re.compile(r"\s*ring\s+\w+\s*=\s*")
_RECOGNISED = re.compile(r"^[ \t]*ring\s+\w+\s*=", re.MULTILINE)
# What Singular prints of an ideal: an entry a line, numbered from 1, without a semicolon; of a
# long one the next lines begin, or the last ones end, with an operator.
_PRINTED = re.compile(
    r"^[ \t]*([A-Za-z_]\w*(?:\([0-9]{1,6}\))*)\[([0-9]{1,6})\][ \t]*=(?!=)[ \t]*"
    r"((?:[^\n;]|(?<=[-+*/^(,])\n|\n(?=[ \t]*[-+*/^),;]))++)$",
    re.MULTILINE,
)
_DECLARED = re.compile(r"\s*(poly|number|ideal)\s+(.+)", re.DOTALL)
# What is not read, and left alone where no polynomial is made of it.
_OTHER = re.compile(
    r"\s*(?:list|int|bigint|intvec|intmat|string|matrix|module|vector|map|resolution|def)\s+"
    r"([A-Za-z]\w*)\b"
)
_WHOLE = re.compile(r"\s*(?:int|bigint)\s+[A-Za-z]\w*\s*=\s*-?[0-9]+\s*")
# Where a statement is not ended before the next line begins another one.
_UNENDED = re.compile(
    r"(?<=\S)[ \t]*\n\s*+(?:(?:ring|poly|number|ideal|list|int)[ \t]+\w+[ \t(,;=]"
    r"|[A-Za-z]\w*[ \t]*=(?!=))"
)
# p = ..., p(1) = ..., and I[1] = ..., an entry of an ideal.
_ASSIGNED = re.compile(r"\s*([A-Za-z]\w*(?:\([0-9]{1,6}\))*)(?:\[([0-9]{1,6})\])?\s*=(?!=)\s*")
_ASSIGNMENT = re.compile(r"[^=<>!]=[^=]")
# What Singular's answers look like, not what they are.
_SHOWN = re.compile(r"\s*(?:short|printlevel|echo|timer|rtimer|TRACE)\s*=")
# Words of programs, which make what they make where Singular runs them.
_PROGRAM = re.compile(r"(?:^|[;{}])\s*(for|while|if|proc)\b")
_CALL = re.compile(r"([A-Za-z]\w*)\s*\(")
# Names, and those of which entries are named; not an entry itself.
_NAME = re.compile(r"(?<!\w)([A-Za-z]\w*(?:\([0-9]{1,6}\))*)(?![\w\[])")
_ENTRY = re.compile(r"(?<!\w)([A-Za-z]\w*(?:\([0-9]{1,6}\))*)\[")
# Calls in calls.
MOST_NESTED = 8
# What makes other generators of the same ideal.
_SAME_IDEAL = ("std", "slimgb", "groebner", "interred", "ideal")
_PARAMETER = re.compile(r"\(\s*0\s*,\s*([A-Za-z]\w*)\s*\)")
_MINPOLY = re.compile(r"minpoly\s*=\s*(.*)", re.DOTALL)
_INDEXED = re.compile(r"\b(\w+)((?:\([0-9]{1,6}(?:\.\.[0-9]{1,6})?\))+)")
_BOUNDS = re.compile(r"\(([0-9]+)(?:\.\.([0-9]+))?\)")
# 3x2y stands for 3*x^2*y where all variables are single letters.
_SHORT = re.compile(r"(?<![\w.])([0-9]*)((?:[A-Za-z][0-9]*)+)(?!\w)")
_LETTER = re.compile(r"([A-Za-z])([0-9]*)")


def recognise(text: str) -> bool:
    """Whether a text makes a ring as Singular does, or is an ideal as Singular prints it."""
    text = _COMMENT.sub("", text)
    return _RECOGNISED.search(text) is not None or _is_printed(text)


def _is_printed(text: str) -> bool:
    """Whether every line is an entry of one ideal, ``I[1]=x2-1``, numbered from 1 on.

    Entries say nothing of entries, and not all are numbers: ``x[1] = 2`` gives an unknown a value.
    """
    text = "\n".join(line.rstrip(" \t\r;") for line in text.split("\n"))
    found = [*_PRINTED.finditer(text)]
    if not found or _PRINTED.sub("", text).strip():
        return False
    numbered = [(m[1], int(m[2])) for m in found]
    right = [m[3] for m in found]
    in_order = numbered == [(found[0][1], k) for k in range(1, len(found) + 1)]
    return in_order and not any("[" in t for t in right) and any(map(names_in, right))


def read(source: SourceFile) -> GivenSystem:
    """The system of the ring and the one ideal in a text for Singular.

    An ideal may be written entry by entry (``I[1] = ...;``), be printed by Singular (the same
    without semicolons, an entry a line), be another one's standard basis, or the sum of others;
    where several are there, it is the one that no other is made of.

    Raises:
        CaseError: if the ring is not of characteristic 0, or there is not one ideal.
    """
    source = source.without(_COMMENT)
    source.refuse_towers()
    program = _PROGRAM.search(source.text)
    if program is not None:
        message = f"{quote(program[1])} is not run here; write the polynomials that Singular prints"
        source.fail(program.start(1), message)
    source, printed = _take_printed(source)
    statements = source.statements()
    for statement in statements:
        unended = _UNENDED.search(statement.text)
        if unended is not None:
            source.fail(statement.offset + unended.start(), "';' is missing here; write it")
    rings = [(s, m) for s in statements if (m := _RING.match(s.text))]
    if not rings and printed:
        # Without it x2 may be x^2, and how many unknowns there are is not said.
        name, _, _ = printed[0]
        source.fail(
            name.offset,
            f"{quote(name.text)}: an ideal that Singular printed, without its ring; write the ring "
            f"before it: ring r = 0, (x, y), dp; or, if {quote(name.text)} is an unknown, begin "
            "with a line 'variables ...'",
        )
    if not rings:
        source.fail(0, "there is no ring; write ring r = 0, (x, y), dp;")
    if len(rings) > 1:
        source.fail(rings[1][0].offset, "a second ring; leave one in the file")
    minpolys = [s for s in statements if _MINPOLY.match(s.text)]
    names, bases, units = _read_ring(
        source, rings[0][0].part(rings[0][1].end(), len(rings[0][0].text)), minpolys
    )
    read = _Definitions(source, names, bases, units)
    for statement in statements:
        known = _RING.match(statement.text) or _SHOWN.match(statement.text) or statement in minpolys
        if not known:
            read.statement(statement)
    for entry in printed:
        read.read_printed_entry(*entry)
    read.refuse_others()
    if not read.ideals:
        source.fail(len(source.text.rstrip()), "there is no ideal; write ideal i = ..., ...;")
    last = [name for name in read.ideals if name not in read.used]
    if len(last) > 1:
        source.fail(read.places[last[1]], "a second ideal; leave one in the file")
    chosen = last[0] if last else list(read.ideals)[-1]
    entries = read.ideals[chosen]
    equations = tuple(entries[k] for k in sorted(entries))
    return GivenSystem(names, equations, {}, read.definitions, imaginary=units)


Printed = tuple[Passage, int, Passage]


def _take_printed(source: SourceFile) -> tuple[SourceFile, list[Printed]]:
    """The text without entries that Singular printed, and these: ideal, number and polynomial.

    A line that belongs to a statement, as it has something of one before it, is none.
    """
    found: list[Printed] = []
    text, end = source.text, 0
    for match in _PRINTED.finditer(source.text):
        before = text[end : match.start()].rstrip()
        if before and not before.endswith(";"):
            continue
        whole = Passage(source.text, 0)
        name = whole.part(match.start(1), text.index("]", match.end(1)) + 1)
        found.append((name, int(match[2]), whole.part(*match.span(3))))
        text = text[: match.start()] + " " * len(match[0]) + text[match.end() :]
        end = match.end()
    return replace(source, text=text), found


class _Definitions:
    """What has a name so far, statement by statement.

    Attributes:
        definitions: polynomials and numbers by their names.
        ideals: entries of ideals by their numbers, from 1.
        places: where the ideals begin.
        used: names of the ideals that others are made of.
    """

    def __init__(
        self,
        source: SourceFile,
        names: tuple[str, ...],
        bases: frozenset[str],
        units: tuple[str, ...],
    ) -> None:
        self._source, self._bases, self._single = source, {*bases}, (*names, *units)
        self._letters = all(len(name) == 1 for name in self._single)
        self._kinds: dict[str, str] = {}
        self._with_entries = set(_ENTRY.findall(source.text))
        self._depth = 0
        self._others: dict[str, Passage] = {}
        self.definitions: dict[str, Passage] = {}
        self.ideals: dict[str, dict[int, Passage]] = {}
        self.places: dict[str, int] = {}
        self.used: set[str] = set()

    def statement(self, statement: Passage) -> None:
        """Read one; what gives nothing a name, as a command that prints, is left out."""
        declared = _DECLARED.match(statement.text)
        if _WHOLE.fullmatch(statement.text):
            # A whole number is a number.
            declared = re.fullmatch(r"\s*(\w+)\s+(.+)", statement.text, re.DOTALL)
        elif other := _OTHER.match(statement.text):
            self._others[other[1]] = statement
            return
        kind, rest = "", statement
        if declared is not None:
            kind, rest = declared[1], statement.part(declared.start(2), len(statement.text))
        assigned = _ASSIGNED.match(rest.text)
        if assigned is None:
            if _ASSIGNMENT.search(statement.text):
                self._refuse(statement)
            if kind:
                for name in self._source.statements(rest, ","):
                    match = _INDEXED.fullmatch(name.text)
                    listed = [name] if match is None else _list_indexed(self._source, name, match)
                    for each in listed:
                        self._declare(kind, each.text)
            return
        name, index = assigned[1], assigned[2]
        if kind:
            self._declare(kind, name)
        right = rest.part(assigned.end(), len(rest.text))
        if not right.text:
            self._source.fail(right.offset, f"{quote(name)} is nothing; write what it is")
        name = _with_brackets(name)
        kind = self._kinds.get(name, "")
        if kind == "ideal":
            self._assign_ideal(name, statement.offset, index, right)
        elif kind and index is None:
            self.definitions[name] = self._polynomial(name, right)
        elif index is not None and not kind:
            self._source.fail(rest.offset, f"{quote(name)} is no ideal; write ideal {name}; before")
        else:
            self._refuse(statement)

    def refuse_others(self) -> None:
        """Refuse what is not read where polynomials are made of it, or nothing else is read."""
        texts = [*self.definitions.values(), *(e for i in self.ideals.values() for e in i.values())]
        names = {name.partition("[")[0] for text in texts for name in names_in(text.text)}
        for name, statement in self._others.items():
            if name in names or not self.ideals:
                self._refuse(statement)

    def read_printed_entry(self, name: Passage, number: int, polynomial: Passage) -> None:
        """Read an entry of an ideal that Singular printed, which need not be declared."""
        ideal = _with_brackets(name.text[: name.text.rindex("[")])
        self._kinds.setdefault(ideal, "ideal")
        self._assign_ideal(ideal, name.offset, str(number), polynomial)

    def _refuse(self, statement: Passage) -> NoReturn:
        message = f"{quote(statement.text)} is not read; write 'ideal i = ..., ...;'"
        self._source.fail(statement.offset, message)

    def _declare(self, kind: str, name: str) -> None:
        name = _with_brackets(name)
        self._kinds[name] = kind
        if "[" in name:
            self._bases.add(name[: name.index("[")])

    def _assign_ideal(self, name: str, place: int, index: str | None, right: Passage) -> None:
        """An ideal, or one entry of it."""
        if index is None:
            if name in self.ideals and name not in self._ideals_in(right.text):
                self._source.fail(place, f"a second ideal {quote(name)}; leave one in the file")
            entries = dict(enumerate(self._entries(right, name), 1))
            self.ideals[name] = entries
        elif int(index) < 1:
            self._source.fail(place, f"entry {index} of an ideal; entries are counted from 1")
        else:
            entries = {int(index): self._polynomial(f"{name}[{index}]", right)}
            self.ideals.setdefault(name, {}).update(entries)
        self.places.setdefault(name, place)
        if name in self._with_entries:
            self.definitions |= {f"{name}[{k}]": entry for k, entry in entries.items()}

    def _ideals_in(self, text: str) -> set[str]:
        """The ideals that are named in a text."""
        return {_with_brackets(name) for name in _NAME.findall(text)} & self.ideals.keys()

    def _polynomial(self, name: str, right: Passage) -> Passage:
        texts = self._entries(right, "")
        if len(texts) != 1:
            message = f"{quote(name)} is {len(texts)} polynomials; write one"
            self._source.fail(right.offset, message)
        return texts[0]

    def _entries(self, whole: Passage, own: str) -> list[Passage]:
        """The polynomials of a list, ideals in it by what they consist of.

        Args:
            own: the ideal that they are those of; empty where these are no ideal's.
        """
        self._depth += 1
        if self._depth > MOST_NESTED:
            self._source.fail(whole.offset, "lists in lists; write their entries in one list")
        found: list[Passage] = []
        if own:
            named = {_with_brackets(name) for name in _ENTRY.findall(whole.text)}
            self.used |= named & self.ideals.keys() - {own}
        for text in self._source.statements(whole, ","):
            ideal = self._ideal(text, own)
            if ideal is not None:
                found += ideal
                continue
            for each in _in_range(self._source, text, self._bases):
                indexed = _names_indexed(each, self._bases)
                written = _write_out(indexed, self._single, self.definitions)
                found.append(written if self._letters else indexed)
            self._check_count(found, text)
        self._depth -= 1
        return found

    def _check_count(self, found: list[Passage], place: Passage) -> None:
        if len(found) > MAX_ENTRIES:
            message = f"more than {MAX_ENTRIES} polynomials; at most that many are read"
            self._source.fail(place.offset, message)

    def _ideal(self, text: Passage, own: str) -> list[Passage] | None:
        """The polynomials of an ideal that is named, worked out, or a sum; None of a polynomial."""
        name = _with_brackets(text.text)
        if name in self.ideals:
            self.used |= {name} - {own}
            entries = self.ideals[name]
            return [entries[k] for k in sorted(entries)]
        call = _CALL.match(text.text)
        if call and call[1] not in (*self._bases, *self._single):
            if call[1] not in _SAME_IDEAL:
                self._source.fail(
                    text.offset,
                    f"{quote(call[1])} is not worked out here; write the polynomials that Singular "
                    "prints",
                )
            if text.text.endswith(")") and _closes_at_end(text.text):
                return self._entries(text.part(call.end(), len(text.text) - 1), own)
        if not self._ideals_in(text.text):
            return None
        parts, found = self._source.statements(text, "+"), []
        for part in parts:
            ideal = self._ideal(part, own) if len(parts) > 1 else None
            if ideal is None:
                message = f"{quote(text.text)} is not worked out here; write its polynomials"
                self._source.fail(text.offset, message)
            found += ideal
            self._check_count(found, text)
        return found


def _closes_at_end(text: str) -> bool:
    """Whether the first bracket of a text is closed by its last character."""
    depth = 0
    for i, c in enumerate(text):
        depth += (c == "(") - (c == ")")
        if c == ")" and not depth:
            return i == len(text) - 1
    return False


def _with_brackets(name: str) -> str:
    """``p[1]`` for ``p(1)``."""
    return name.replace("(", "[").replace(")", "]")


def _in_range(source: SourceFile, text: Passage, bases: Container[str]) -> list[Passage]:
    """``p(1)``, ``p(2)`` and so on for ``p(1..3)``; anything else as it is."""
    match = _INDEXED.fullmatch(text.text)
    if match is None or match[1] not in bases or ".." not in match[2]:
        return [text]
    return _list_indexed(source, text, match)


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
        names += _list_indexed(source, item, match)
    if unit is not None:
        return check_names(source, names), frozenset(bases), (unit,)
    parts = [part.strip() for part in field.rstrip(")").split(",")[1:]]
    units = tuple(part for part in parts if not part.isdigit()) or ("i",)
    is_complex = field.lstrip("(").startswith("complex")
    return check_names(source, names), frozenset(bases), units if is_complex else ()


def _list_indexed(source: SourceFile, item: Passage, match: re.Match[str]) -> list[Passage]:
    """``x[1]``, ``x[2]`` and so on for ``x(1..3)``, which the match is of."""
    bounds = [(int(b[1]), int(b[2] or b[1])) for b in _BOUNDS.finditer(match[2])]
    count = 1
    for low, high in bounds:
        count *= max(0, high - low + 1)
        if count > MAX_ENTRIES:
            source.fail(item.offset, f"more than {MAX_ENTRIES} names; at most that many")
    return [
        Passage(match[1] + "".join(f"[{k}]" for k in index), item.offset)
        for index in itertools.product(*(range(low, high + 1) for low, high in bounds))
    ]


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


def _names_indexed(text: Passage, bases: Container[str]) -> Passage:
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
