"""The text of a file that knows its lines and columns, and the system that it is read to."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, NoReturn

from nag.algebra.bounded import Budget, Value
from nag.algebra.expression import parse_polynomial
from nag.algebra.from_python import exact_complex
from nag.algebra.imaginary_unit import (
    adjoin_unit,
    has_imaginary_root,
    name_unit,
    parse_parameter,
    values_with_unit,
)
from nag.algebra.number import ComplexNumber, Number
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.algebra.tokens import ExpressionError, is_name, names_in, nearest, quote
from nag.files.case_table import MAX_ENTRIES, CaseError, line_of

# Of more names a message gives the first.
SHOWN = 12
_BRACKETS = {"(": ")", "[": "]", "{": "}"}


@dataclass(frozen=True)
class Passage:
    """A part of a file: its text, and where it begins."""

    text: str
    offset: int

    def stripped(self) -> Passage:
        """Without the blanks around it."""
        start = len(self.text) - len(self.text.lstrip())
        return Passage(self.text.strip(), self.offset + start)

    def part(self, start: int, end: int) -> Passage:
        """The characters from ``start`` to ``end``."""
        return Passage(self.text[start:end], self.offset + start).stripped()


_TOWER = re.compile(r"\^\s*(?:\w+|\([^()]{1,99}\))\s*\^")


@dataclass(frozen=True)
class SourceFile:
    """A file's path and text."""

    file: str
    text: str

    def fail(self, offset: int, message: str) -> NoReturn:
        """Raise a `CaseError` about the place ``offset``."""
        line = self.text.count("\n", 0, offset) + 1
        column = offset - self.text.rfind("\n", 0, offset)
        raise CaseError(line_of(self.file, f"line {line}, column {column}", message))

    def refuse_towers(self) -> None:
        """Refuse powers of powers, which other programs take for (a^b)^c.

        Raises:
            CaseError: if there is one.
        """
        tower = _TOWER.search(self.text)
        if tower is not None:
            self.fail(tower.start(), "a power of a power; write parentheses, (a^b)^c or a^(b^c)")

    def without(self, comment: re.Pattern[str]) -> SourceFile:
        """The same with comments blanked out, so that columns stay."""
        return replace(self, text=comment.sub(_blank, self.text))

    def statements(self, whole: Passage | None = None, separator: str = ";") -> list[Passage]:
        """The parts between separators outside of brackets, without empty ones.

        Raises:
            CaseError: if brackets do not match.
        """
        whole = whole or Passage(self.text, 0)
        parts, open_at, start = [], [], 0
        for i, c in enumerate(whole.text):
            if c in _BRACKETS:
                open_at.append(i)
            elif c in ")]}":
                if not open_at or _BRACKETS[whole.text[open_at[-1]]] != c:
                    self.fail(whole.offset + i, f"{c!r} without its opening bracket; mend one")
                open_at.pop()
            elif c in separator and not open_at:
                parts.append(whole.part(start, i))
                start = i + 1
            elif c == ";" and open_at:
                break
        if open_at:
            self.fail(
                whole.offset + open_at[-1],
                f"{whole.text[open_at[-1]]!r} is never closed; write its "
                f"{_BRACKETS[whole.text[open_at[-1]]]!r}",
            )
        parts.append(whole.part(start, len(whole.text)))
        return [part for part in parts if part.text]


def _blank(match: re.Match[str]) -> str:
    return re.sub(r"[^\n]", " ", match[0])


@dataclass(frozen=True)
class GivenSystem:
    """What a file says a system is.

    Attributes:
        variables: names, in order.
        equations: each one polynomial, or two with ``=`` between them.
        parameters: expressions for numbers that have names, each of names before it.
        definitions: expressions of the variables that have names, each of names before it.
        groups: groups of variables.
        patches: groups of homogeneous variables, for each of which an affine patch is chosen.
        imaginary: names of the imaginary unit.
        nonzero: polynomials that must not vanish at a solution.
        unset: variables that are declared as parameters, and have no value.
    """

    variables: tuple[str, ...]
    equations: tuple[Passage, ...]
    parameters: Mapping[str, Passage] = field(default_factory=dict)
    definitions: Mapping[str, Passage] = field(default_factory=dict)
    groups: tuple[tuple[str, ...], ...] = ()
    patches: tuple[tuple[str, ...], ...] = ()
    imaginary: tuple[str, ...] = ()
    nonzero: tuple[Passage, ...] = ()
    unset: tuple[str, ...] = ()


def check_names(source: SourceFile, names: Iterable[Passage]) -> tuple[str, ...]:
    """The names, if each is one and none is there twice.

    Raises:
        CaseError: otherwise.
    """
    seen: dict[str, None] = {}
    for name in names:
        if not is_name(name.text):
            source.fail(name.offset, f"{quote(name.text)} cannot name a variable; rename it")
        if name.text in seen:
            source.fail(name.offset, f"{quote(name.text)} is there twice; name it once")
        seen[name.text] = None
        if len(seen) > MAX_ENTRIES:
            source.fail(name.offset, f"more than {MAX_ENTRIES} variables; at most that many")
    return tuple(seen)


def read_given(
    source: SourceFile, given: GivenSystem, values: Mapping[str, Any] | None = None
) -> tuple[PolynomialSystem, dict[str, Number | ComplexNumber], tuple[str, ...]]:
    """The exact system that a file gives, the values of its parameters, and those without one.

    Args:
        values: other values of some parameters, and values of unknowns, which are parameters then.

    Raises:
        CaseError: if something in it is no number or polynomial; the line says where.
    """
    budget = Budget()
    given = _with_fixed_unknowns(source, given, values or {})
    given = _define_dependent_parameters(given, given.unset)
    units = [u for u in given.imaginary if u not in _names(given)]
    parameters: dict[str, Number | ComplexNumber] = {}
    for name, text in given.parameters.items():
        if values and name in values:
            try:
                parameters[name] = _given_value(values[name], units, parameters, budget)
            except ExpressionError as error:
                raise CaseError(line_of(source.file, name, str(error))) from None
            continue
        try:
            parameters[name] = parse_parameter(text.text, units, parameters, budget)
        except ExpressionError as error:
            source.fail(text.offset + (error.column or 1) - 1, error.reason)
    unit = _unit_name(given, parameters, units)
    names = given.variables if unit is None else (*given.variables, unit)
    read = _Reading(source, names, values_with_unit(parameters, names), budget, unit)
    if unit is not None:
        variable = Polynomial.variable(len(names), len(names) - 1)
        read.known.update(dict.fromkeys(units, variable))
    for name, text in given.definitions.items():
        read.known[name] = read.polynomial(text)
    if not given.equations:
        raise CaseError(line_of(source.file, "there is no equation in it; write at least one"))
    if len(given.equations) > MAX_ENTRIES:
        at = given.equations[MAX_ENTRIES].offset
        source.fail(at, f"more than {MAX_ENTRIES} equations; at most that many are read")
    equations = [read.polynomial(text) for text in given.equations]
    equations += [_patch(names, group) for group in given.patches]
    if len(given.nonzero) > MAX_ENTRIES:
        at = given.nonzero[MAX_ENTRIES].offset
        source.fail(at, f"more than {MAX_ENTRIES} of these; at most that many are read")
    nonzero = [read.polynomial(text) for text in given.nonzero]
    grouped = {name for group in given.groups for name in group}
    whole = given.groups if grouped == set(given.variables) and len(given.groups) > 1 else ()
    groups = tuple(tuple(given.variables.index(name) for name in group) for group in whole)
    if unit is not None:
        return adjoin_unit(names, equations, nonzero, groups), parameters, given.unset
    system = PolynomialSystem(names, tuple(equations), tuple(nonzero), groups)
    return system, parameters, given.unset


def _with_fixed_unknowns(
    source: SourceFile, given: GivenSystem, values: Mapping[str, Any]
) -> GivenSystem:
    """The same with unknowns as parameters for which there are values.

    Raises:
        CaseError: if there is a value for something else, or no unknown is left.
    """
    homogeneous = {name for group in given.patches for name in group}
    unknowns = [name for name in given.variables if name not in homogeneous]
    for name in values:
        if name not in given.parameters and name not in unknowns:
            known = [*given.parameters, *unknowns]
            have = f"it has {', '.join(known[:SHOWN])}{', ...' if len(known) > SHOWN else ''}"
            reason = f"is no parameter and no unknown{nearest(name, known)}; {have}"
            raise CaseError(line_of(source.file, quote(name), reason))
    fixed = [name for name in unknowns if name in values]
    if not fixed:
        return given
    left = tuple(name for name in given.variables if name not in fixed)
    if not left:
        raise CaseError(line_of(source.file, "every unknown has a value; leave one without"))
    groups = (tuple(name for name in group if name in left) for group in given.groups)
    placed = {name: Passage("0", 0) for name in fixed}
    return replace(
        given,
        variables=left,
        # Others may be made of them.
        parameters={**placed, **given.parameters},
        groups=tuple(group for group in groups if group),
        unset=tuple(name for name in given.unset if name not in fixed),
    )


def _define_dependent_parameters(given: GivenSystem, unknown: Sequence[str]) -> GivenSystem:
    """The same, where parameters that depend on unknown ones are definitions."""
    depending: dict[str, Passage] = {}
    for name, text in given.parameters.items():
        if name not in unknown and names_in(text.text) & {*unknown, *depending}:
            depending[name] = text
    kept = {name: text for name, text in given.parameters.items() if name not in depending}
    return replace(given, parameters=kept, definitions={**depending, **given.definitions})


def _names(given: GivenSystem) -> tuple[str, ...]:
    return (*given.variables, *given.parameters, *given.definitions)


def _unit_name(
    given: GivenSystem, parameters: Mapping[str, Number | ComplexNumber], units: Sequence[str]
) -> str | None:
    """A name for the imaginary unit, if it occurs."""
    complex_ = {n for n, value in parameters.items() if isinstance(value, ComplexNumber)}
    texts = (*given.equations, *given.definitions.values(), *given.nonzero)
    named = any(names_in(text.text) & {*units, *complex_} for text in texts)
    letters = (*given.variables, *given.definitions)
    if not named and not any(has_imaginary_root(t.text, letters, parameters) for t in texts):
        return None
    return name_unit(_names(given))


def _given_value(
    value: Any,
    units: Sequence[str],
    known: Mapping[str, Number | ComplexNumber],
    budget: Budget,
) -> Number | ComplexNumber:
    """The number that was given for a parameter, as text in the file's names or as it is."""
    if isinstance(value, str):
        return parse_parameter(value, units, known, budget)
    return exact_complex(value, "the value")


def free_parameters(source: SourceFile, given: GivenSystem, names: Sequence[str]) -> GivenSystem:
    """The same with parameters as its last variables.

    Raises:
        CaseError: if one is no parameter.
    """
    for name in names:
        if name not in given.parameters and name not in given.unset:
            known = ", ".join((*given.parameters, *given.unset)) or "none"
            raise CaseError(line_of(source.file, quote(name), f"is no parameter; it has {known}"))
    given = _define_dependent_parameters(given, names)
    kept = {name: text for name, text in given.parameters.items() if name not in names}
    unset = tuple(name for name in given.unset if name not in names)
    variables = (*(name for name in given.variables if name not in names), *names)
    return replace(given, variables=variables, parameters=kept, groups=(), unset=unset)


@dataclass(frozen=True)
class _Reading:
    """Reads polynomials on one budget, with the names that are known so far."""

    source: SourceFile
    names: tuple[str, ...]
    known: dict[str, Value]
    budget: Budget
    unit: str | None

    def polynomial(self, text: Passage) -> Polynomial:
        """The polynomial of a statement."""
        try:
            return parse_polynomial(text.text, self.names, self.known, self.budget, unit=self.unit)
        except ExpressionError as error:
            self.source.fail(text.offset + (error.column or 1) - 1, error.reason)


def _patch(names: Sequence[str], group: Sequence[str]) -> Polynomial:
    """A linear form of the group, less 1: the affine patch on which its points are found.

    Which one does not matter but for points on its hyperplane at infinity: coefficients are odd
    and of no pattern, so that no equation that is written by hand has such points.
    """
    n = len(names)
    form = Polynomial.constant(n, -1)
    for k, name in enumerate(group, 1):
        coefficient = (k * 7919) % 101 + 11
        form = form + (-1) ** k * coefficient * Polynomial.variable(n, names.index(name))
    return form
