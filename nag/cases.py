"""Case files: a polynomial system or a mechanism, and what is known about it, in TOML.

A case file is data: nothing in it is evaluated as code, and its size and the work that its
expressions ask for are bounded before they are spent.
"""

from __future__ import annotations

import os
import re
import tomllib
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from decimal import Decimal
from graphlib import CycleError, TopologicalSorter
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal, NoReturn

from nag.algebra.expression import (
    Budget,
    ExpressionError,
    is_name,
    names_in,
    nearest,
    parse_number,
    parse_polynomial,
    quote,
)
from nag.algebra.number import Number
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem

if TYPE_CHECKING:
    from nag.mechanism.graph import Mechanism

MAX_BYTES = 500_000
MAX_ENTRIES = 500
# The TOML reader takes quadratic time over the parts of a dotted key.
MAX_KEY_PARTS = 50

_KINDS = ("system", "mechanism")
_KEYS = {
    "system": ("title", "kind", "variables", "equations", "groups", "parameters", "point", "truth"),
    "mechanism": ("title", "kind", "ground", "parameters", "joint", "body", "truth"),
}
_TRUTH_KEYS = (
    "dimension",
    "degree",
    "count",
    "multiplicity",
    "multidegree",
    "formulation",
    "source",
)
_QUOTED = re.compile(r"\"[^\"\n]*\"|'[^'\n]*'|[0-9]\.[0-9]")


class CaseError(ValueError):
    """A case file that cannot be read: "file: table: key: what is wrong; what would be right"."""


@dataclass(frozen=True)
class NamedPoint:
    """A point of interest, one coordinate for each variable of the system."""

    name: str
    at: tuple[Number, ...]


@dataclass(frozen=True)
class Truth:
    """``count`` irreducible components over the complex numbers that are known to be there.

    Attributes:
        dimension: of each.
        degree: of each, in the variables of the system.
        count: how many there are.
        multiplicity: of each.
        multidegree: of each in the system's variable groups, nested by dimension, or None.
        formulation: formulation of the mechanism for which this holds, or None for a system.
        source: where it is known from.
    """

    dimension: int
    degree: int
    count: int = 1
    multiplicity: int = 1
    multidegree: tuple[Any, ...] | None = None
    formulation: str | None = None
    source: str = ""


@dataclass(frozen=True)
class Case:
    """A case file, read and checked. Either `system` or `mechanism` is there, as `kind` says."""

    title: str
    kind: Literal["system", "mechanism"]
    path: Path
    parameters: Mapping[str, Number]
    system: PolynomialSystem | None = None
    mechanism: Mechanism | None = None
    points: tuple[NamedPoint, ...] = ()
    truth: tuple[Truth, ...] = ()


def read_case(path: str | os.PathLike[str]) -> Case:
    """Read the case file at ``path``.

    Raises:
        CaseError: if it cannot be read or makes no sense.
    """
    path = Path(path)
    top = _Table(str(path), "", _read_toml(path))
    kind = top.text("kind")
    if kind not in _KINDS:
        top.fail("kind", f"{quote(kind)} is no kind of case; write 'system' or 'mechanism'")
    top.allow(_KEYS[kind])
    title = top.text("title")
    budget = Budget()
    parameters = _read_parameters(top.table("parameters"), budget)
    numbers = _Numbers(parameters, budget)
    truth = _read_truth(top, kind)
    if kind == "mechanism":
        mechanism = _read_mechanism(top, numbers)
        return Case(title, "mechanism", path, parameters, mechanism=mechanism, truth=truth)
    system = _read_system(top, numbers)
    points = _read_points(top, system, numbers)
    return Case(title, "system", path, parameters, system=system, points=points, truth=truth)


@dataclass(frozen=True)
class _Numbers:
    """Reads numbers and polynomials with the parameters of the case, on one budget."""

    parameters: Mapping[str, Number]
    budget: Budget

    def number(self, value: Any) -> Number:
        return parse_number(value, self.parameters, self.budget)

    def polynomial(self, text: str, variables: Sequence[str]) -> Polynomial:
        return parse_polynomial(text, variables, self.parameters, self.budget)


@dataclass(frozen=True)
class _Table:
    """A TOML table that knows where it stands and complains about its keys."""

    file: str
    place: str
    values: Mapping[str, Any]

    def fail(self, key: str | None, message: str) -> NoReturn:
        places = [p for p in (self.file, self.place, key) if p]
        raise CaseError(": ".join([*places, message]))

    @contextmanager
    def at(self, key: str) -> Iterator[None]:
        """Put this table and ``key`` in front of what is wrong with an expression."""
        try:
            yield
        except ExpressionError as error:
            self.fail(key, str(error))

    def allow(self, keys: Collection[str]) -> None:
        for key in self.values:
            if key not in keys:
                self.fail(
                    _shown(key),
                    f"unknown key{nearest(key, keys)}; the keys here are {', '.join(keys)}",
                )

    def get(self, key: str, kinds: type | tuple[type, ...], wanted: str) -> Any:
        if key not in self.values:
            self.fail(key, f"is missing; write {wanted}")
        value = self.values[key]
        if not isinstance(value, kinds) or (isinstance(value, bool) and bool not in (kinds,)):
            self.fail(key, f"is {_kind(value)}; write {wanted}")
        return value

    def text(self, key: str) -> str:
        wanted = f'a text in quotes: {key} = "..."'
        value = self.get(key, str, wanted)
        if not value.strip():
            self.fail(key, f"is empty; write {wanted}")
        return value

    def count(self, key: str, least: int, default: int | None = None) -> int:
        if default is not None and key not in self.values:
            return default
        wanted = f"a whole number from {least} up"
        value = self.get(key, int, wanted)
        if not least <= value < 10**9:
            shown = value if abs(value) < 10**30 else "a very large number"
            self.fail(key, f"is {shown}; write {wanted}")
        return value

    def items(self, key: str, what: str, length: int | None = None) -> list[Any]:
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
        values = self.items(key, what, length)
        for i, value in enumerate(values, 1):
            if not isinstance(value, str):
                self.fail(f"{key} {i}", f"is {_kind(value)}; write {what} in quotes")
        return values

    def vector(self, key: str, length: int, numbers: _Numbers) -> tuple[Number, ...]:
        read = []
        for i, value in enumerate(self.items(key, "numbers", length), 1):
            with self.at(f"{key} {i}"):
                read.append(numbers.number(value))
        return tuple(read)

    def table(self, key: str) -> _Table:
        values = self.get(key, dict, f"a table [{key}]") if key in self.values else {}
        if len(values) > MAX_ENTRIES:
            self.fail(key, f"has {len(values)} entries; at most {MAX_ENTRIES} are read")
        return _Table(self.file, f"{self.place}[{key}]", values)

    def tables(self, key: str, prefix: str = "") -> list[_Table]:
        if key not in self.values:
            return []
        name = f"[[{prefix}{key}]]"
        values = self.items(key, f"tables {name}")
        for value in values:
            if not isinstance(value, dict):
                self.fail(key, f"holds {_kind(value)}; write tables {name}")
        return [_Table(self.file, f"{name} {i}", value) for i, value in enumerate(values, 1)]

    def called(self, name: str) -> _Table:
        return _Table(self.file, f"{self.place} {quote(name)}", self.values)


def _shown(key: str) -> str:
    return key if is_name(key) else quote(key)


def _kind(value: Any) -> str:
    names = {
        str: "a text",
        bool: "a truth value",
        int: "a whole number",
        Decimal: "a decimal number",
        list: "a list",
        dict: "a table",
    }
    return names.get(type(value), "a date or time")


def _read_toml(path: Path) -> dict[str, Any]:
    def fail(message: str) -> NoReturn:
        raise CaseError(f"{path}: {message}")

    try:
        with open(path, "rb") as file:
            content = file.read(MAX_BYTES + 1)
    except OSError as error:
        fail(f"cannot be read ({error.strerror}); give the path of a case file")
    except ValueError as error:
        raise CaseError(f"{str(path)!r}: {error}; give the path of a case file") from None
    if len(content) > MAX_BYTES:
        fail(f"is longer than {MAX_BYTES} bytes; a case file is shorter")
    try:
        text = content.decode("utf-8")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        fail(f"line {line}: byte {error.object[error.start]:#04x} is not UTF-8; save it as UTF-8")
    for number, line in enumerate(text.split("\n"), 1):
        if line.count(".") > MAX_KEY_PARTS and _QUOTED.sub("", line).count(".") > MAX_KEY_PARTS:
            fail(f"line {number}: more than {MAX_KEY_PARTS} dots outside of texts; shorten the key")
    try:
        return tomllib.loads(text, parse_float=Decimal)
    except RecursionError:
        fail("lists or tables are nested too deep; write them flat")
    except tomllib.TOMLDecodeError as error:
        fail(f"is not valid TOML: {' '.join(str(error).split())[:200]}; mend the file there")
    except ValueError:
        fail("holds a number of more than 4300 digits; write a shorter one")


def _read_parameters(table: _Table, budget: Budget) -> Mapping[str, Number]:
    """Values of the parameters, which may refer to each other in any order but not in circles."""
    uses = {}
    for name, value in table.values.items():
        if not is_name(name):
            table.fail(
                _shown(name), "cannot name a parameter; use letters, digits and _, not a function"
            )
        if not isinstance(value, str | int | Decimal) or isinstance(value, bool):
            table.fail(name, f'is {_kind(value)}; write a number or an expression like "5/6"')
        uses[name] = sorted(names_in(value) & table.values.keys()) if isinstance(value, str) else []
    try:
        order = list(TopologicalSorter(uses).static_order())
    except CycleError as error:
        circle = [str(name) for name in error.args[1]]
        table.fail(circle[0], f"refers to itself: {' -> '.join(circle[:10])}; break the circle")
    values: dict[str, Number] = {}
    for name in order:
        with table.at(name):
            values[name] = parse_number(table.values[name], values, budget)
    return MappingProxyType({name: values[name] for name in table.values})


def _read_system(top: _Table, numbers: _Numbers) -> PolynomialSystem:
    variables = top.texts("variables", "names of variables")
    for i, name in enumerate(variables, 1):
        if not is_name(name):
            top.fail(
                f"variables {i}",
                f"{quote(name)} cannot name a variable; use letters, digits and _, not a function",
            )
        if name in variables[: i - 1]:
            top.fail(f"variables {i}", f"{quote(name)} is there twice; name each variable once")
        if name in numbers.parameters:
            top.fail(f"variables {i}", f"{quote(name)} is a parameter as well; rename one of them")
    equations = []
    for i, text in enumerate(top.texts("equations", "equations"), 1):
        with top.at(f"equations {i}"):
            equations.append(numbers.polynomial(text, variables))
    return PolynomialSystem(tuple(variables), tuple(equations), groups=_read_groups(top, variables))


def _read_groups(top: _Table, variables: list[str]) -> tuple[tuple[int, ...], ...]:
    if "groups" not in top.values:
        return ()
    groups, seen = [], set()
    for i, group in enumerate(top.items("groups", "lists of variables"), 1):
        if not isinstance(group, list) or not group or not all(isinstance(g, str) for g in group):
            top.fail(f"groups {i}", "is no list of names; write a list of variables")
        for name in group:
            if name not in variables:
                top.fail(
                    f"groups {i}",
                    f"unknown variable {quote(name)}{nearest(name, variables)}; "
                    "write names from 'variables'",
                )
            if name in seen:
                top.fail(f"groups {i}", f"{name!r} is in a group already; write it in one only")
            seen.add(name)
        groups.append(tuple(variables.index(name) for name in group))
    missing = [name for name in variables if name not in seen]
    if missing:
        top.fail("groups", f"{missing[0]!r} is in no group; write every variable in one group")
    return tuple(groups)


def _read_points(
    top: _Table, system: PolynomialSystem, numbers: _Numbers
) -> tuple[NamedPoint, ...]:
    points: list[NamedPoint] = []
    for table in top.tables("point"):
        table.allow(("name", "at"))
        name = table.text("name")
        table = table.called(name)
        if any(name == p.name for p in points):
            table.fail("name", "another point has that name; give each a name of its own")
        coordinates = _Table(
            table.file, f"{table.place}: at", table.get("at", dict, "{ variable = number, ... }")
        )
        coordinates.allow(system.variables)
        at = []
        for variable in system.variables:
            if variable not in coordinates.values:
                coordinates.fail(variable, "is missing; give a number for every variable")
            with coordinates.at(variable):
                at.append(numbers.number(coordinates.values[variable]))
        points.append(NamedPoint(name, tuple(at)))
    return tuple(points)


def _read_truth(top: _Table, kind: str) -> tuple[Truth, ...]:
    known = top.table("truth")
    known.allow(("component",))
    return tuple(_read_component(t, kind) for t in known.tables("component", "truth."))


def _read_component(table: _Table, kind: str) -> Truth:
    table.allow(_TRUTH_KEYS)
    formulation = None
    if "formulation" in table.values:
        if kind == "system":
            table.fail("formulation", "a system has no formulation; leave it out")
        formulation = table.text("formulation")
        if formulation not in ("E", "H"):
            table.fail("formulation", f"{quote(formulation)} is unknown; write 'E' or 'H'")
    multidegree = None
    if "multidegree" in table.values:
        multidegree = _read_multidegree(table, table.items("multidegree", "whole numbers"))
    return Truth(
        dimension=table.count("dimension", 0),
        degree=table.count("degree", 1),
        count=table.count("count", 1, default=1),
        multiplicity=table.count("multiplicity", 1, default=1),
        multidegree=multidegree,
        formulation=formulation,
        source=table.text("source"),
    )


def _read_multidegree(table: _Table, values: list[Any]) -> tuple[Any, ...]:
    def is_degree(value: Any) -> bool:
        return isinstance(value, int) and not isinstance(value, bool) and 0 <= value < 10**9

    if not all(is_degree(v) or isinstance(v, list) for v in values):
        table.fail("multidegree", "holds something else; write whole numbers from 0 up")
    return tuple(_read_multidegree(table, v) if isinstance(v, list) else v for v in values)


def _read_mechanism(top: _Table, numbers: _Numbers) -> Mechanism:
    from nag.mechanism.graph import Body, Joint, Mechanism, MechanismError

    ground = top.text("ground")
    if "joint" not in top.values:
        top.fail("joint", "is missing; write a table [[joint]] for every joint")
    joint_tables = [(t.text("name"), t) for t in top.tables("joint")]
    body_tables = [(t.text("name"), t) for t in top.tables("body")]
    try:
        joints = [_read_joint(name, t.called(name), numbers, Joint) for name, t in joint_tables]
        bodies = [_read_body(name, t.called(name), numbers, Body) for name, t in body_tables]
        return Mechanism(ground, tuple(joints), tuple(bodies))
    except MechanismError as error:
        # The last table of a name, as a repeated name is the fault of the later one.
        for culprit, tables in ((error.joint, joint_tables), (error.body, body_tables)):
            for name, table in reversed(tables):
                if name == culprit:
                    table.called(name).fail(error.key, str(error))
        top.fail(error.key, str(error))


def _read_joint(name: str, table: _Table, numbers: _Numbers, joint: Any) -> Any:
    table.allow(("name", "type", "bodies", "point", "axis"))
    return joint(
        name=name,
        type=table.text("type"),
        bodies=tuple(table.texts("bodies", "names of bodies", 2)),
        point=table.vector("point", 3, numbers),
        axis=table.vector("axis", 3, numbers),
    )


def _read_body(name: str, table: _Table, numbers: _Numbers, body: Any) -> Any:
    table.allow(("name", "orientation"))
    orientation = None
    if "orientation" in table.values:
        orientation = table.vector("orientation", 4, numbers)
    return body(name=name, orientation=orientation)
