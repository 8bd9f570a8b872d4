"""Exact numbers and systems from what Python has for them.

A number may be an int, `Fraction`, `Decimal`, text (``"5/6"``, ``"sqrt(2)/2"``), a number of
NumPy's or sympy's, or a float. A float is read as the shortest decimal that rounds to it, which is
how it prints: 0.1 is 1/10, not 3602879701896397/36028797018963968.
"""

from __future__ import annotations

import numbers
import re
import sys
from cmath import isfinite
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from decimal import Decimal
from fractions import Fraction
from numbers import Complex, Integral, Rational, Real
from typing import Any

from nag.algebra.bounded import Budget, Value, representable
from nag.algebra.expression import parse_number, parse_polynomial
from nag.algebra.from_sympy import is_sympy, symbol_names, symbols_text, sympy_value
from nag.algebra.given import (
    GRAPH_GIVEN,
    Equations,
    Names,
    check_listed,
    check_type,
    is_a,
    value_text,
)
from nag.algebra.imaginary_unit import (
    adjoin_unit,
    has_imaginary_root,
    name_unit,
    parse_parameter,
    values_with_unit,
    write_out_unit,
)
from nag.algebra.number import ComplexNumber, Number, is_zero
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.algebra.tokens import (
    CONSTANTS,
    IMAGINARY_UNITS,
    ExpressionError,
    imaginary_text,
    is_name,
    is_not_finite,
    list_names,
    names_in,
    natural_order,
    nearest,
    not_finite_text,
    quote,
    taken_text,
)
from nag.errors import NagError

__all__ = ["exact_number", "exact_vector", "system"]

# What iterates, as sequences of equations do, and holds none: results.
RESULTS = ("nag.numerics.read_only", "Several")
# What iterates and is no point: it has no numbers, no order, or gives them once.
NO_POINTS = (str, bytes, bytearray, Set, Iterator)
# What stands between equations of a list; commas in brackets stand between indices.
_SEVERAL = re.compile(r"[,;]\s*\S")
_IN_BRACKETS = re.compile(r"[\[{(][^\[{(\]})]*[\]})]")


def exact_number(value: Any, place: str = "the number") -> Number:
    """The exact number that ``value`` is or spells.

    Raises:
        ExpressionError: if it is none; the message begins with ``place``.
    """
    if isinstance(value, Fraction):
        return value
    try:
        if is_sympy(value):
            number = sympy_value(value, {}, 0, Budget())
            assert not isinstance(number, Polynomial)
            return representable(number)
        return parse_number(plain_number(value))
    except ValueError as error:
        raise ExpressionError(f"{place}: {error}") from None


def real_double(value: Any, place: str = "the number") -> float:
    """The double next to the real number that ``value`` is or spells.

    Raises:
        ExpressionError: if it is none, or too large; the message begins with ``place``.
    """
    try:
        return float(exact_number(value, place))
    except OverflowError:
        raise ExpressionError(
            f"{place}: {value_text(value)} is too large; give numbers up to 1e308"
        ) from None


def plain_number(value: Any) -> Any:
    """NumPy's numbers, and those of others that are registered as numbers, as Python's."""
    if isinstance(value, bool | str | int | float | Fraction):
        return value
    if type(value).__name__ in ("bool", "bool_"):
        return bool(value)
    if isinstance(value, Integral):
        return int(value)
    if isinstance(value, Rational):
        return Fraction(int(value.numerator), int(value.denominator))
    # The shortest decimal of a single is not that of the double which it becomes.
    return str(value) if isinstance(value, Real) else value


def exact_vector(values: Any, place: str) -> tuple[Number, ...]:
    """The exact numbers that a sequence (a tuple, a list, an array) holds.

    Raises:
        ExpressionError: if it is no sequence, or holds something else.
    """
    if isinstance(values, str | bytes | bytearray | Set) or not isinstance(values, Iterable):
        shown = (
            quote(values)
            if isinstance(values, str)
            else f"something of type {type(values).__name__}"
        )
        raise ExpressionError(f"{place}: {shown} is given; give a sequence of numbers")
    return tuple(exact_number(x, f"{place}[{i}]") for i, x in enumerate(values))


def system(
    equations: Equations,
    variables: Names | None = None,
    *,
    parameters: Mapping[Any, Any] | None = None,
    nonzero: Equations = (),
    groups: Iterable[Iterable[Any]] = (),
    imaginary: str | None = None,
) -> PolynomialSystem:
    """The exact polynomial system that equations define.

    Args:
        equations: one or a sequence of them: texts (``"x^2 + y^2 = 1"``; without ``=`` the
            expression is zero), sympy's expressions, ``Eq`` or ``Poly``, or `Polynomial`. A
            `nag.PolynomialSystem` is given back as it is.
        variables: their names, or sympy's symbols, in order; a text of names will do. By default
            all names that occur and are no parameters, in alphabetical order (x2 before x10). A
            variable that is called ``I``, ``i``, ``ii``, ``im``, ``J`` or ``j`` in a text has to
            be given, as it might be meant as the imaginary unit, and one that is called ``π`` or
            ``Pi``, which are ``pi`` else.
        parameters: values of further names, real or complex.
        nonzero: expressions that must not vanish; written like ``equations``.
        groups: groups of variables in which multidegrees are counted, by name or index.
        imaginary: the name of the imaginary unit in texts; ``I``, where variables are given and it
            is none of them. Where coefficients are complex the unit is the last variable, `I`, of
            the system (`nag.algebra.imaginary_unit`).

    Raises:
        ValueError: if something is no polynomial; the message says which argument and what would
            be right.

    Floats in sympy's expressions and in ``parameters`` stand for their shortest decimals.

    >>> import nag
    >>> print(nag.system(["x^2 + y^2 = 1", "x = a*y"], parameters={"a": 0.5}))
    PolynomialSystem of 2 variables (x, y), 2 equations: 1 of degree 1, 1 of degree 2
      x^2 + y^2 - 1 = 0
      x - 1/2*y = 0
    """
    if isinstance(equations, PolynomialSystem):
        asked = (("variables", variables), ("parameters", parameters), ("nonzero", nonzero))
        for name, value in (*asked, ("groups", groups), ("imaginary", imaginary)):
            if value is not None and value != ():
                raise NagError(f"{name}: a nag.PolynomialSystem is given, which has its own")
        return equations
    given, apart = _list_equations(equations, "equations"), _list_equations(nonzero, "nonzero")
    advice = "a dict of values by name"
    check_type({} if parameters is None else parameters, Mapping, "parameters", advice)
    check_listed(groups, "groups", "a list of groups, each a list of variables")
    values = {
        str(name): exact_complex(value, f"parameters[{str(name)!r}]")
        for name, value in (parameters or {}).items()
    }
    occurring = [
        (equation, f"{place}[{i}]")
        for place, equations in (("equations", given), ("nonzero", apart))
        for i, equation in enumerate(equations)
    ]
    _check_symbols(
        *occurring,
        *((name, "variables") for name in _as_list(variables)),
        *((name, "parameters") for name in parameters or ()),
    )
    check_type(imaginary, str | None, "imaginary", "a letter")
    if imaginary is not None and not is_name(imaginary):
        raise ExpressionError(f"imaginary: {quote(str(imaginary))} is no name; write a letter")
    letter = imaginary or ("I" if variables is not None else None)
    names = _names(variables, occurring, values, letter)
    if imaginary in (*names, *values):
        raise ExpressionError(f"imaginary: {taken_text(str(imaginary))}")
    if not given and not names:
        raise NagError("equations: none are given; give texts like 'x^2 + y^2 = 1' in a list")
    unit = letter if letter not in (*names, *values) else None
    is_complex = any(isinstance(value, ComplexNumber) for value in values.values()) or any(
        _is_complex(f, unit, names, values) for f, _ in occurring
    )
    read = _Reader(names, values, unit, name_unit((*names, *values)) if is_complex else None)
    parts = (
        [read.polynomial(f, f"equations[{i}]") for i, f in enumerate(given)],
        [read.polynomial(f, f"nonzero[{i}]") for i, f in enumerate(apart)],
        [_group(group, names, f"groups[{i}]") for i, group in enumerate(groups)],
    )
    return adjoin_unit(read.names, *parts) if is_complex else PolynomialSystem(names, *parts)


def _as_list(given: Any) -> list[Any]:
    """What is given one by one or alone."""
    return [*given] if isinstance(given, list | tuple) else [given]


def _check_symbols(*given: tuple[Any, str]) -> None:
    """Refuse different symbols of one name in a system: they would be one variable.

    Args:
        given: expressions and names, each with its place.

    Raises:
        ExpressionError: if there are such.
    """
    known: dict[str, Any] = {}
    for expression, place in given:
        if is_sympy(expression):
            try:
                own = symbol_names(expression)
            except ExpressionError as error:
                raise ExpressionError(f"{place}: {error}") from None
            for name, symbol in own.items():
                if known.setdefault(name, symbol) != symbol:
                    raise ExpressionError(f"{place}: {symbols_text(name)}")


def exact_complex(value: Any, place: str, units: Sequence[str] = ("I",)) -> Number | ComplexNumber:
    """The exact number that is given, real or complex; ``units`` name the unit in a text.

    Raises:
        ExpressionError: if it is none.
    """
    if isinstance(value, str):
        try:
            return parse_parameter(value, units, {}, Budget())
        except ExpressionError as error:
            raise ExpressionError(f"{place}: {error}") from None
    if is_sympy(value) and value.is_number and value.has(sys.modules["sympy"].I):
        parts = value.expand(complex=True).as_real_imag()
    elif not isinstance(value, Real | Decimal) and isinstance(value, Complex):
        parts = value.real, value.imag
    else:
        return exact_number(value, place)
    real, imaginary = (exact_number(part, place) for part in parts)
    return real if is_zero(imaginary) else ComplexNumber(real, imaginary)


def _is_complex(
    equation: Any, unit: str | None, names: Sequence[str], values: Mapping[str, Any]
) -> bool:
    """Whether the imaginary unit occurs in an equation."""
    if isinstance(equation, str):
        occurs = unit is not None and unit in names_in(equation)
        return occurs or has_imaginary_root(equation, names, values)
    if isinstance(equation, Complex) and not isinstance(equation, Real):
        return bool(equation.imag)
    return is_sympy(equation) and equation.has(sys.modules["sympy"].I)


def _list_equations(equations: Any, place: str) -> list[Any]:
    """Equations as a list; a single one is a list of one."""
    matrix = getattr(equations, "is_Matrix", False)
    if isinstance(equations, str) and _SEVERAL.search(_IN_BRACKETS.sub("", equations)):
        raise ExpressionError(
            f"{place}: several equations in one text; give a list of texts: ['x^2 - 1', 'x - y']"
        )
    if isinstance(equations, str | Polynomial) or (is_sympy(equations) and not matrix):
        return [equations]
    if hasattr(equations, "ravel"):
        return _refuse_numbers(list(equations.ravel()), equations, place)
    if matrix:
        return list(equations)
    answer = is_a(equations, *RESULTS)
    if answer and hasattr(equations, "system"):
        raise ExpressionError(
            f"{place}: a {type(equations).__name__} is given, which is an answer; "
            "its equations are its `system`"
        )
    # What iterates over names: a dict, a table of pandas, but not one of its columns.
    names = hasattr(equations, "keys") and getattr(equations, "ndim", 0) != 1
    if is_a(equations, "networkx", "Graph"):
        raise ExpressionError(f"{place}: {GRAPH_GIVEN}")
    none = isinstance(equations, bytes | bytearray) or names
    if answer or none or not isinstance(equations, Iterable):
        raise ExpressionError(
            f"{place}: something of type {type(equations).__name__} is given; give texts like "
            "'x^2 + y^2 = 1', sympy's expressions or nag.Polynomial, in a list"
        )
    return _refuse_numbers(list(equations), equations, place)


def _refuse_numbers(listed: list[Any], given: Any, place: str) -> list[Any]:
    """The list, unless all in it are numbers: coefficients are meant, which are no equations.

    Zeros are equations that came out empty, unless an array has them.

    Raises:
        ExpressionError: if they are.
    """
    only = all(isinstance(e, numbers.Number) and not is_sympy(e) for e in listed)
    array = hasattr(given, "dtype") or is_a(given, "numpy", "poly1d")
    if listed and only and (array or any(listed)):
        what = "an array" if array else f"a {type(given).__name__}"
        raise ExpressionError(
            f"{place}: {what} of numbers is given; the roots of a polynomial with these "
            "coefficients are those of a text like 'x^2 - 2'"
        )
    return listed


def _names(
    variables: Any,
    equations: Sequence[tuple[Any, str]],
    values: Mapping[str, Any],
    imaginary: str | None,
) -> tuple[str, ...]:
    """The variables' names: those given, else those that occur in the equations."""
    if variables is None:
        if any(isinstance(f, Polynomial) for f, _ in equations):
            raise ExpressionError(
                "variables: a nag.Polynomial has no names in it; give one for each variable"
            )
        listed = (_list_names(f, place, values, imaginary) for f, place in equations)
        found = {name for names in listed for name in names}
        names = tuple(sorted(found - values.keys() - {imaginary}, key=natural_order))
    else:
        names = tuple(list_names(variables))
    for i, name in enumerate(names):
        if not is_name(name):
            raise ExpressionError(
                f"variables: {quote(name)} cannot name a variable; use letters, digits, _ and "
                "indices as in x[1], not a function"
            )
        if name in names[:i]:
            raise ExpressionError(f"variables: {name!r} is there twice; name each variable once")
        if name in values:
            raise ExpressionError(f"variables: {name!r} is a parameter as well; rename one of them")
    return names


def _list_names(
    equation: Any, place: str, values: Mapping[str, Any], imaginary: str | None
) -> Iterable[str]:
    """The names in an equation; sympy's symbols are variables whatever they are called."""
    if not is_sympy(equation):
        names = names_in(equation) if isinstance(equation, str) else frozenset()
        for unit in IMAGINARY_UNITS:
            if unit in names - values.keys() - {imaginary}:
                mend = f"if it is, give imaginary={unit!r} as well, else list all variables, "
                mend += "variables='x y'"
                raise ExpressionError(f"{place}: {imaginary_text(unit, mend)}")
        for name in sorted(filter(is_not_finite, names - values.keys())):
            mend = "if it is a variable, list all variables, variables='x y'"
            raise ExpressionError(f"{place}: {not_finite_text(name, mend)}")
        return names - CONSTANTS
    try:
        return symbol_names(equation)
    except ExpressionError as error:
        raise ExpressionError(f"{place}: {error}") from None


class _Reader:
    """Reads equations in known names."""

    def __init__(
        self,
        names: tuple[str, ...],
        values: Mapping[str, Number | ComplexNumber],
        unit: str | None,
        adjoined: str | None,
    ) -> None:
        self.names = names if adjoined is None else (*names, adjoined)
        variables = Polynomial.variables(len(self.names))
        self.values = values_with_unit(values, self.names)
        if adjoined is not None and unit is not None:
            self.values[unit] = variables[-1]
        self.known: dict[str, Value] = {
            **self.values,
            **dict(zip(names, variables[: len(names)], strict=True)),
        }
        self.unit = variables[-1] if adjoined is not None else None

    def polynomial(self, equation: Any, place: str) -> Polynomial:
        n = len(self.names)
        if isinstance(equation, Polynomial):
            if self.unit is not None and equation.n == n - 1:
                return equation.with_variables(n, range(n - 1))
            if equation.n != n:
                raise ExpressionError(
                    f"{place}: a polynomial in {equation.n} variables; {n} are named"
                )
            return equation
        if isinstance(equation, bool):
            raise ExpressionError(
                f"{place}: a truth value is given, as == of Python gives; write Eq(a, b) of sympy, "
                "or a text, 'a = b'"
            )
        if not isinstance(equation, str) and not is_sympy(equation):
            number = exact_complex(equation, place)
            if isinstance(number, ComplexNumber):
                assert self.unit is not None
                return number.imaginary * self.unit + number.real
            return Polynomial.constant(n, number)
        try:
            if isinstance(equation, str):
                known = {k: v for k, v in self.values.items() if k not in self.names}
                unit = None if self.unit is None else self.names[-1]
                return parse_polynomial(equation, self.names, known, unit=unit)
            symbol_names(equation)
            value = sympy_value(equation, self.known, n, Budget(), self.unit)
        except ValueError as error:
            raise ExpressionError(f"{place}: {error}") from None
        return value if isinstance(value, Polynomial) else Polynomial.constant(n, value)


def _group(group: Iterable[Any], names: tuple[str, ...], place: str) -> tuple[int, ...]:
    if not isinstance(group, Iterable) and not is_sympy(group):
        group = [group]
    return variable_indices(group, names, place)


def variable_indices(
    chosen: Iterable[Any], names: Sequence[str], place: str = "variables"
) -> tuple[int, ...]:
    """Indices of variables that are given by name, as sympy's symbol or by index.

    Raises:
        ExpressionError: if one is unknown.
    """
    if isinstance(chosen, str) or is_sympy(chosen):
        chosen = list_names(chosen)
    if not isinstance(chosen, Iterable):
        raise ExpressionError(
            f"{place}: {value_text(chosen)} is given; give a list of variables, by name or index"
        )
    indices = []
    for item in chosen:
        if isinstance(item, Integral) and not isinstance(item, bool):
            if not 0 <= item < len(names):
                raise ExpressionError(
                    f"{place}: {item} is no index; there are {len(names)} variables, from 0 on"
                )
            indices.append(int(item))
            continue
        if str(item) not in names:
            raise ExpressionError(
                f"{place}: {quote(str(item))} is no variable{nearest(str(item), names)}; "
                f"there are {', '.join(names)}"
            )
        indices.append(list(names).index(str(item)))
    return tuple(indices)


def coordinates(
    point: Any, variables: Sequence[str], imaginary: bool = False
) -> tuple[Number | complex, ...]:
    """A point's coordinates: exact numbers where they are real, others in doubles.

    Args:
        point: a number for each variable, in their order, or a mapping from names to numbers, or a
            series of pandas' with names; or a solution that was found, which is known to doubles.
            Floats of all kinds, sympy's too,
            are doubles: where they are asked to be exact they are their shortest decimals.
        imaginary: whether the last variable is the imaginary unit, which need not be given.

    Raises:
        ValueError: if there are more or fewer than variables, or one is no finite number.
    """
    point = _values_by_name(point, variables[: len(variables) - imaginary])
    units = ("I", *variables[-1:]) if imaginary else ("I",)
    if imaginary and not _names_the_unit(point, variables):
        variables = variables[:-1]
    n = len(variables)
    if isinstance(point, Mapping):
        places = variable_indices(point, variables, "point")
        missing = [name for i, name in enumerate(variables) if i not in places]
        if missing:
            raise NagError(f"point: no value for {missing[0]!r}; give one for each variable")
        by_place = dict(zip(places, point.values(), strict=True))
        values = [by_place[i] for i in range(n)]
    elif isinstance(point, Iterable) and not isinstance(point, NO_POINTS):
        values = list(point)
    else:
        raise NagError(
            f"point: {value_text(point)} is given; give {n} numbers in a list, or a dict of them "
            "by name"
        )
    if len(values) != n:
        are = "coordinate is" if len(values) == 1 else "coordinates are"
        have = "is 1 variable" if n == 1 else f"are {n} variables"
        raise NagError(f"point: {len(values)} {are} given; there {have}: {', '.join(variables)}")
    given = [_coordinate(value, f"point[{i}]", units) for i, value in enumerate(values)]
    return (*given, 1j) if imaginary and units[-1] not in variables else tuple(given)


def _values_by_name(point: Any, variables: Sequence[str]) -> Any:
    """A point by names of its variables, where it has them: a solution, or a series of pandas.

    Raises:
        NagError: if it is a table.
    """
    if getattr(point, "ndim", 1) > 1:
        raise NagError("point: a table is given; give one point, as a row of it")
    if is_a(point, "nag.solving.solutions", "Solution"):
        same = len(point.variables) == len(variables) and {*point.variables} == {*variables}
        if not same or point.variables == tuple(variables):
            return point.point
        return dict(zip(point.variables, point.to_numpy(), strict=True))
    if hasattr(point, "keys") and not isinstance(point, Mapping):
        # The index of a series may be numbers, which are no names.
        names = list(point.keys())
        return dict(point) if all(isinstance(name, str) for name in names) else list(point)
    return point


def _names_the_unit(point: Any, variables: Sequence[str]) -> bool:
    """Whether a point has a coordinate for the imaginary unit, the last variable."""
    if isinstance(point, Mapping):
        return variables[-1] in map(str, point)
    return hasattr(point, "__len__") and len(point) == len(variables)


def spelled_coordinate(text: str, place: str, units: Sequence[str]) -> Number | ComplexNumber:
    """The coordinate of a point that a text spells, as an expression or as points are printed.

    Raises:
        ExpressionError: if it spells none; the message begins with ``place``.
    """
    return exact_complex(write_out_unit(text, units[0]), place, units)


def _coordinate(value: Any, place: str, units: Sequence[str]) -> Number | complex:
    if isinstance(value, str):
        exact = spelled_coordinate(value, place, units)
        return complex(exact) if isinstance(exact, ComplexNumber) else exact
    if is_sympy(value) and isinstance(value, Real) and not isinstance(value, Rational):
        # Of more digits than a double has it is the decimal that it is written as.
        exact = exact_number(value, place)
        value = float(value) if exact == exact_number(float(value), place) else exact
    elif isinstance(value, Real) and not isinstance(value, Rational | float):
        value = float(str(value))
    if not isinstance(value, Complex) or isinstance(value, Rational):
        exact = exact_complex(value, place, units)
        if not isinstance(exact, ComplexNumber):
            return exact
        return complex(exact)
    if not isfinite(complex(value)):
        raise ExpressionError(f"{place}: {value} is no number; give a finite number")
    return value
