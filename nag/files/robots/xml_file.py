"""Files in XML as plain data: elements, their attributes and places.

Document types and entities are refused, so that nothing in a file grows or leads to another file.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from decimal import Decimal
from fractions import Fraction
from typing import Any, NoReturn
from xml.parsers import expat

from nag.algebra.tokens import nearest, quote
from nag.files.case_table import CaseError, line_of
from nag.text.table import count_text

MAX_ELEMENTS = 20_000
MAX_DEPTH = 100
MAX_NUMBER = 60

_NUMBER = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]{1,2})?", re.ASCII)


@dataclass(eq=False)
class XmlElement:
    """An element of a file.

    Attributes:
        file: path of the file.
        line: where it begins, from 1.
        column: likewise.
        tag: its name.
        attributes: texts by name.
        children: the elements inside, in order.
    """

    file: str
    line: int
    column: int
    tag: str
    attributes: dict[str, str]
    children: list[XmlElement] = field(default_factory=list)

    @property
    def place(self) -> str:
        """Where it begins, for messages."""
        return _place_text(self.line, self.column)

    def fail(self, message: str, key: str | None = None) -> NoReturn:
        """Raise a `CaseError` about the element, or one of its attributes."""
        name = self.attributes.get("name", "")
        tag = self.tag if len(self.tag) <= 40 else f"{self.tag[:37]}..."
        shown = f"<{tag}>" + (f" {quote(name)}" if name else "")
        raise CaseError(line_of(self.file, self.place, shown, key, message))

    def all(self, tag: str) -> list[XmlElement]:
        """The elements of a name inside."""
        return [child for child in self.children if child.tag == tag]

    def one(self, tag: str) -> XmlElement | None:
        """The only element of a name inside, None if there is none."""
        found = self.all(tag)
        if len(found) > 1:
            found[1].fail(f"is there twice in <{self.tag}>; leave one of them out")
        return found[0] if found else None

    def text(self, key: str) -> str:
        """An attribute that must be there, in one line."""
        if key not in self.attributes:
            self.fail(f'is missing; write {key}="..."', key)
        value = self.attributes[key].strip()
        if not value or not value.isprintable():
            self.fail("is empty or holds a control character; write a name", key)
        return value

    def choice(
        self, key: str, among: Collection[str], default: str, meant: Mapping[str, str] = {}
    ) -> str:
        """An attribute that is one of some words.

        Args:
            meant: which of them others mean, as other formats have them.
        """
        value = self.attributes.get(key, default).strip()
        if value not in among:
            hint = f" (did you mean {meant[value]!r}?)" if value in meant else nearest(value, among)
            self.fail(
                f"{quote(value)} is unknown{hint}; write one of {', '.join(among)}",
                key,
            )
        return value

    def numbers(self, key: str, count: int, default: str | None = None) -> tuple[Fraction, ...]:
        """Decimal numbers with spaces between, exact as they are written."""
        if key not in self.attributes and default is None:
            self.fail(f"is missing; write {count} numbers", key)
        words = self.attributes.get(key, default or "").split()
        if len(words) != count:
            found = count_text(len(words), "entry", "entries")
            apart = ", with blanks between them and no commas" if "," in "".join(words) else ""
            self.fail(f"has {found}; write {count} numbers{apart}", key)
        return tuple(self._number(word, key) for word in words)

    def _number(self, word: str, key: str) -> Fraction:
        if "${" in word or "$(" in word:
            self.fail("is an expression of xacro; expand the file with xacro first", key)
        if len(word) > MAX_NUMBER:
            self.fail(f"{quote(word)} has more than {MAX_NUMBER} places; write fewer", key)
        if _NUMBER.fullmatch(word) is None:
            self.fail(
                f"{quote(word)} is no decimal number; write one like 0.5 or 5e-3, whose exponent "
                "has two digits at the most",
                key,
            )
        return Fraction(Decimal(word))


def _place_text(line: int, column: int) -> str:
    return f"line {line}, column {column}"


def parse_xml(file: str, text: str) -> XmlElement:
    """The element that a text in XML is.

    Raises:
        CaseError: if it is not XML, has a document type or entities, or is too large.
    """
    stack: list[XmlElement] = []
    roots: list[XmlElement] = []
    count = 0
    # The text is decoded already, whatever encoding its first line names.
    parser = expat.ParserCreate("utf-8")

    def here() -> tuple[int, int]:
        return parser.CurrentLineNumber, parser.CurrentColumnNumber + 1

    def fail(message: str) -> NoReturn:
        raise CaseError(line_of(file, _place_text(*here()), message))

    def start(tag: str, attributes: dict[str, str]) -> None:
        nonlocal count
        count += 1
        if count > MAX_ELEMENTS or len(stack) >= MAX_DEPTH:
            fail(f"more than {MAX_ELEMENTS} elements, or {MAX_DEPTH} inside of each other")
        if tag.startswith("xacro:"):
            fail(f"<{tag[:40]}> is a macro of xacro; expand the file with xacro first")
        element = XmlElement(file, *here(), tag, dict(attributes))
        (stack[-1].children if stack else roots).append(element)
        stack.append(element)

    def refuse(*_: Any) -> None:
        fail("a document type or an entity is declared; leave it out, and write what it stands for")

    parser.StartElementHandler = start
    parser.EndElementHandler = lambda _: stack.pop()
    parser.StartDoctypeDeclHandler = refuse
    parser.EntityDeclHandler = refuse
    try:
        parser.Parse(text.encode(), True)
    except expat.ExpatError as error:
        message = expat.ErrorString(error.code)
        place = _place_text(error.lineno, error.offset + 1)
        raise CaseError(
            line_of(file, place, f"is not valid XML: {message}; mend it there")
        ) from None
    return roots[0]
