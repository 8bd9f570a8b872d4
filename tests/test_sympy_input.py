"""Sympy's expressions are read exactly, without sympy's arithmetic."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
import pytest

import nag
from nag.algebra.expression import parse_number
from nag.algebra.from_python import exact_number, system
from nag.algebra.number import cosine, square_root

sympy = pytest.importorskip("sympy")
x, y, a = sympy.symbols("x y a")


@pytest.mark.parametrize(
    ("value", "exact"),
    [
        (sympy.Integer(3), Fraction(3)),
        (sympy.Rational(1, 3), Fraction(1, 3)),
        (sympy.sqrt(2) / 2, square_root(Fraction(1, 2))),
        (sympy.cos(sympy.pi / 5), cosine(parse_number("pi/5"))),
        (sympy.Float(0.1), Fraction(1, 10)),
        (sympy.Float("0.1", 40), Fraction(1, 10)),
        (1 / sympy.sqrt(3), square_root(Fraction(1, 3))),
    ],
)
def test_numbers(value: Any, exact: Any) -> None:
    assert exact_number(value) == exact


@pytest.mark.parametrize(
    ("equation", "text"),
    [
        (sympy.Eq(x**2 + y**2, 1), "x^2 + y^2 - 1"),
        ((x + y) ** 3 - x * y / 3, "(x + y)^3 - x*y/3"),
        (sympy.Poly(x * y - 1, x, y), "x*y - 1"),
        (0.5 * x + sympy.pi * y, "x/2 + pi*y"),
        (sympy.sqrt(2) * x * (y - sympy.Rational(1, 7)), "sqrt(2)*x*(y - 1/7)"),
        (sympy.horner(x**30 + sum(x**k for k in range(30)) + y), None),
    ],
)
def test_equations(equation: Any, text: str | None) -> None:
    text = text or " + ".join(f"x^{k}" for k in range(31)) + " + y"
    assert system([equation], [x, y]) == system([text], "x y")


def test_equations_may_be_mixed_in_lists_arrays_and_matrices() -> None:
    wanted = system(["x - 1", "x*y"], "x y")
    for given in (
        [x - 1, "x*y"],
        np.array([x - 1, x * y]),
        sympy.Matrix([x - 1, x * y]),
        sympy.ImmutableMatrix([x - 1, x * y]),
    ):
        assert system(given) == wanted


@pytest.mark.parametrize(
    ("equation", "message"),
    [
        (sympy.sin(x), "make the sine and the cosine variables"),
        (1 / x, "no negative power"),
        (sympy.sqrt(x), "the exponent '1/2' is not whole"),
        (sympy.exp(x), "is no polynomial"),
        (sympy.oo + x, "is no finite real number"),
        (sympy.Eq(x, x), "always holds"),
        (x < 1, "is no polynomial"),
        (x + sympy.Symbol("x", real=True), "two symbols are named 'x'"),
        (x**2000, "the exponent 2000 is too large"),
    ],
)
def test_what_is_no_polynomial_is_refused(equation: Any, message: str) -> None:
    with pytest.raises(ValueError, match=rf"^equations\[1\]: .*{message}"):
        system([x, equation])


def test_a_system_of_sympys_is_solved_and_decomposed() -> None:
    roots = nag.solve([sympy.Eq(x**2 + y**2, 2), x - y])
    assert sorted(s.point[0].real.round(12) for s in roots.solutions) == [-1, 1]
    curve = nag.decompose(sympy.Eq(x**2 + y**2, a), [x, y, a]).components[0]
    assert (curve.dimension, curve.degree) == (2, 2)
    assert curve.contains({x: sympy.sqrt(2), y: 0, a: 2})
    assert not curve.contains({x: sympy.sqrt(2), y: 0, a: sympy.Rational(21, 10)})


def test_a_symbol_may_have_any_name() -> None:
    unit = sympy.Symbol("I")
    assert system([x**2 + unit]).variables == ("I", "x")


def test_floats_of_sympys_are_taken_as_pythons_are_in_points() -> None:
    circle = nag.decompose("x^2 + y^2 - 1")
    plain, given = (0.6, 0.8), (sympy.Float(0.6), sympy.Float(0.8))
    named = dict(zip(sympy.symbols("x y"), given, strict=True))
    for point in (given, named, (np.float32(0.6), np.float32(0.8))):
        assert nag.member(circle, point).on
        assert nag.local(circle.system, point) == nag.local(circle.system, plain)
        found = nag.local_dimension(circle.system, point)
        assert found == nag.local_dimension(circle.system, plain)
    # More digits than a double has are a decimal.
    long = sympy.Float("0.6", 40), sympy.Float("0.8", 40)
    assert nag.local_dimension(circle.system, long).dimension == 1
    assert nag.member(circle, long).on
