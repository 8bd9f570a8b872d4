"""Tables of a case file that know where they stand, to report a mistake in one line.

Their numbers may use the parameters of the case: names for numbers, which may refer to each other.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from decimal import Decimal, InvalidOperation
from fractions import Fraction
from graphlib import CycleError, TopologicalSorter
from pathlib import Path
from typing import Any, NoReturn

from nag.algebra.bounded import Budget
from nag.algebra.expression import parse_number
from nag.algebra.fixed_mapping import FixedMapping
from nag.algebra.from_python import exact_complex
from nag.algebra.given import check_type
from nag.algebra.imaginary_unit import parse_parameter
from nag.algebra.number import ComplexNumber, Irrational, Number, Surd
from nag.algebra.tokens import (
    CONSTANTS,
    IMAGINARY_UNITS,
    ONLY_REAL,
    ExpressionError,
    imaginary_text,
    is_name,
    names_in,
    nearest,
    quote,
    unit_called,
)
from nag.errors import InputError, unreadable
from nag.text.table import join_words

ReadNumber = Callable[[Any], Number]

MAX_BYTES = 500_000
MAX_ENTRIES = 500
# A message shows what is in a file, and remains a line that is read.
MOST_LETTERS = 900
# The TOML reader takes quadratic time over the parts of a dotted key.
MAX_KEY_PARTS = 50

# A file has the first three, Python the others besides.
PARAMETER_TYPES = (str, int, Decimal, Fraction, Surd, Irrational, ComplexNumber)

_QUOTED = re.compile(r"\"[^\"\n]*\"|'[^'\n]*'|[0-9]\.[0-9]")


class CaseError(InputError):
    """A case file that cannot be read: "file: table: key: what is wrong; what would be right"."""


def line_of(file: str, *parts: str | None) -> str:
    """A file's name and the parts of a message in one line that can be printed."""
    said = ": ".join(p for p in parts if p)
    said = said if len(said) <= MOST_LETTERS else f"{said[: MOST_LETTERS - 3]}..."
    text = f"{file}: {said}" if said else file
    return "".join(c if c.isprintable() else "?" for c in text)


@dataclass(frozen=True)
class CaseTable:
    """A TOML table that knows where it stands and complains about its keys.

    Attributes:
        file: path of the case file.
        place: name of the table in it, empty at the top.
        values: what it holds.
    """

    file: str
    place: str
    values: Mapping[str, Any]

    def fail(self, key: str | None, message: str) -> NoReturn:
        """Raise a `CaseError` about ``key``."""
        raise CaseError(line_of(self.file, self.place, key, message))

    @contextmanager
    def at(self, key: str) -> Iterator[None]:
        """Put this table and ``key`` in front of what is wrong with an expression."""
        try:
            yield
        except ExpressionError as error:
            self.fail(key, str(error))

    def allow(self, keys: Collection[str]) -> None:
        """Complain about any other key."""
        for key in self.values:
            if key not in keys:
                self.fail(
                    key_text(key),
                    f"unknown key{nearest(key, keys)}; the keys here are {', '.join(keys)}",
                )

    def require(self, wanted: Mapping[str, str], hint: str = "") -> None:
        """Complain about all keys at once that are not there.

        Args:
            wanted: what to write, by the keys.
            hint: what would help besides.
        """
        missing = [key for key in wanted if key not in self.values]
        if missing:
            verb = "is" if len(missing) == 1 else "are"
            texts = "; ".join(dict.fromkeys(wanted[key] for key in missing))
            self.fail(join_words(missing), f"{verb} missing; write {texts}{hint}")

    def get(self, key: str, kind: type, wanted: str) -> Any:
        """The value, which must be there and of that type."""
        if key not in self.values:
            self.fail(key, f"is missing; write {wanted}")
        value = self.values[key]
        if not isinstance(value, kind) or isinstance(value, bool):
            self.fail(key, f"is {kind_of(value)}; write {wanted}")
        return value

    def text(self, key: str) -> str:
        """A text that is not empty and fits in a line."""
        wanted = wanted_text(key)
        value = self.get(key, str, wanted)
        if not value.strip():
            self.fail(key, f"is empty; write {wanted}")
        if not value.isprintable():
            self.fail(key, "holds a line break or a control character; write it in one line")
        return value

    def count(self, key: str, least: int, default: int | None = None) -> int:
        """A whole number, not below ``least``."""
        if default is not None and key not in self.values:
            return default
        wanted = f"a whole number from {least} up"
        value = self.get(key, int, wanted)
        if not least <= value < 10**9:
            found = value if abs(value) < 10**30 else "a very large number"
            self.fail(key, f"is {found}; write {wanted}")
        return value

    def items(self, key: str, what: str, length: int | None = None) -> list[Any]:
        """A list that is not empty, of the given length."""
        wanted = f"a list of {what}" if length is None else f"a list of {length} {what}"
        values = self.get(key, list, wanted)
        if length is not None and len(values) != length:
            self.fail(key, f"has {len(values)} entries; write {wanted}")
        if not values:
            self.fail(key, f"is empty; write {wanted}")
        if len(values) > MAX_ENTRIES:
            self.fail(key, f"has {len(values)} entries; at most {MAX_ENTRIES} are read")
        return values

    def texts(self, key: str, what: str, length: int | None = None) -> list[str]:
        """A list of texts."""
        values = self.items(key, what, length)
        for i, value in enumerate(values, 1):
            if not isinstance(value, str):
                self.fail(f"{key} {i}", f"is {kind_of(value)}; write {what} in quotes")
        return values

    def vector(self, key: str, length: int, read: Callable[[Any], Number]) -> tuple[Number, ...]:
        """A list of numbers, each read by ``read``."""
        numbers = []
        for i, value in enumerate(self.items(key, "numbers", length), 1):
            with self.at(f"{key} {i}"):
                numbers.append(read(value))
        return tuple(numbers)

    def table(self, key: str) -> CaseTable:
        """The table inside, empty if it is not there."""
        values = self.get(key, dict, f"a table [{key}]") if key in self.values else {}
        if len(values) > MAX_ENTRIES:
            self.fail(key, f"has {len(values)} entries; at most {MAX_ENTRIES} are read")
        return CaseTable(self.file, f"{self.place}[{key}]", values)

    def tables(self, key: str, prefix: str = "") -> list[CaseTable]:
        """The array of tables inside, empty if it is not there; names of them start with prefix."""
        if key not in self.values:
            return []
        name = f"[[{prefix}{key}]]"
        values = self.items(key, f"tables {name}")
        for value in values:
            if not isinstance(value, dict):
                self.fail(key, f"holds {kind_of(value)}; write tables {name}")
        return [CaseTable(self.file, f"{name} {i}", value) for i, value in enumerate(values, 1)]

    def called(self, name: str) -> CaseTable:
        """The same table, its name shown in messages."""
        return CaseTable(self.file, f"{self.place} {quote(name)}", self.values)


def wanted_text(key: str) -> str:
    """What to write for a key that is a text."""
    return f'a text in quotes: {key} = "..."'


def key_text(key: str) -> str:
    """A key as messages show it."""
    return key if is_name(key) else quote(key)


def kind_of(value: Any) -> str:
    """The TOML type of ``value`` in words."""
    names = {
        str: "a text",
        bool: "a truth value",
        int: "a whole number",
        Decimal: "a decimal number",
        list: "a list",
        dict: "a table",
    }
    return names.get(type(value), "a date or time")


class ExportGiven(CaseError):
    """An export where a case is wanted."""


_EXPORT = re.compile(rb"\s*\{\s*\"format\"\s*:\s*\"([a-z-]{1,40})\"")
# Bytes in which an export says what it is.
MOST_OF_A_HEAD = 200


def format_of_export(content: bytes) -> str:
    """The format of an export that begins so; empty if it does not say it there."""
    known = _EXPORT.match(content)
    return known[1].decode() if known else ""


def export_text_of(content: bytes) -> str:
    """What to say of a file that begins so where a case is wanted; empty if it is no JSON."""
    if not content.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"{"):
        return ""
    known = format_of_export(content)
    what = f"an export ({known})" if known else "JSON, as exports are"
    return f"is {what}, and no case; `nag show` says what it holds; give the case file"


def read_case_text(path: Path) -> str:
    """The text of a file.

    Raises:
        ExportGiven: if it is JSON, however long.
        CaseError: if it cannot be read, is too long, or is not UTF-8.
    """

    def fail(message: str) -> NoReturn:
        raise CaseError(line_of(str(path), message))

    try:
        with open(path, "rb") as file:
            content = file.read(MAX_BYTES + 1)
    except (OSError, ValueError) as error:
        raise CaseError(unreadable(path, error)) from None
    said = export_text_of(content[:MOST_OF_A_HEAD])
    if said:
        raise ExportGiven(line_of(str(path), said))
    if len(content) > MAX_BYTES:
        fail(f"is longer than {MAX_BYTES} bytes; a case file is shorter")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        fail(f"line {line}: byte {error.object[error.start]:#04x} is not UTF-8; save it as UTF-8")


def parse_toml(path: Path, text: str) -> dict[str, Any]:
    """What a text in TOML holds; decimals are kept as they are written, as `decimal.Decimal`.

    Raises:
        CaseError: if it is not TOML.
    """

    def fail(message: str) -> NoReturn:
        raise CaseError(line_of(str(path), message))

    for number, line in enumerate(text.split("\n"), 1):
        if line.count(".") > MAX_KEY_PARTS and _QUOTED.sub("", line).count(".") > MAX_KEY_PARTS:
            fail(f"line {number}: more than {MAX_KEY_PARTS} dots outside of texts; shorten the key")
    try:
        return tomllib.loads(text, parse_float=Decimal)
    except RecursionError:
        fail("lists or tables are nested too deep; write them flat")
    except tomllib.TOMLDecodeError as error:
        fail(f"is not valid TOML: {' '.join(str(error).split())[:200]}; mend the file there")
    except InvalidOperation:
        fail("holds a decimal number whose exponent has too many digits; write a smaller one")
    except ValueError:
        fail("holds a number of more than 4300 digits; write a shorter one")


def read_parameters(
    table: CaseTable, budget: Budget, unit: str | None = None
) -> Mapping[str, Number | ComplexNumber]:
    """Values of the parameters, which may refer to each other in any order but not in circles.

    Args:
        unit: the name of the imaginary unit where they may be complex.
    """
    unit = None if unit in table.values else unit
    known = {*table.values, *([unit] if unit is not None else ())}
    uses = {}
    for name, value in table.values.items():
        if not is_name(name):
            table.fail(
                key_text(name), "cannot name a parameter; use letters, digits and _, not a function"
            )
        if not isinstance(value, PARAMETER_TYPES) or isinstance(value, bool):
            table.fail(name, f'is {kind_of(value)}; write a number or an expression like "5/6"')
        if unit is None and isinstance(value, ComplexNumber):
            table.fail(name, f"{value} is complex; {ONLY_REAL}")
        names = names_in(value) if isinstance(value, str) else frozenset()
        for unknown in sorted(names - known - CONSTANTS):
            if unit is not None and unknown in IMAGINARY_UNITS:
                mend = f"{unit_called(unit)}; write imaginary = {unknown!r} if it is that"
                table.fail(name, imaginary_text(unknown, mend))
            table.fail(
                name,
                f"unknown name {quote(unknown)}{nearest(unknown, table.values)}; write numbers, "
                "other parameters, sqrt, sin, cos or pi",
            )
        uses[name] = sorted(names & table.values.keys())
    try:
        order = list(TopologicalSorter(uses).static_order())
    except CycleError as error:
        circle = [str(name) for name in reversed(error.args[1])]
        table.fail(circle[0], f"refers to itself: {' -> '.join(circle[:10])}; break the circle")
    values: dict[str, Number | ComplexNumber] = {}
    for name in order:
        with table.at(name):
            values[name] = _parameter(table.values[name], values, budget, unit)
    return FixedMapping({name: values[name] for name in table.values})


def _parameter(
    value: Any, known: Mapping[str, Number | ComplexNumber], budget: Budget, unit: str | None
) -> Number | ComplexNumber:
    if isinstance(value, ComplexNumber):
        return value
    if unit is None or not isinstance(value, str):
        return parse_number(value, known, budget)  # type: ignore[arg-type]
    return parse_parameter(value, [unit], known, budget)


def with_values(table: CaseTable, values: Mapping[str, Any]) -> CaseTable:
    """The table of parameters with other values for some of them."""
    check_type(values, Mapping, "set", "a dict of numbers or expressions by name")
    for name in values:
        if name not in table.values:
            known = (
                f"the parameters are {', '.join(table.values)}" if table.values else "it has none"
            )
            table.fail(
                key_text(name), f"is no parameter of the case{nearest(name, table.values)}; {known}"
            )
    given = {
        name: value if isinstance(value, str) else exact_complex(value, f"set[{name!r}]")
        for name, value in values.items()
    }
    return replace(table, values={**table.values, **given})
