"""Pairs of variables on circles, and the complex equations between them."""

from __future__ import annotations

from fractions import Fraction
from math import sqrt

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nag.algebra.evaluation import Evaluator
from nag.algebra.expression import parse_polynomial
from nag.algebra.number import square_root
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.algebra.turns import turns_of

numbers = st.fractions(-9, 9, max_denominator=7)
factors = numbers.filter(bool)
weights = st.sampled_from([Fraction(1), Fraction(2), Fraction(3, 7)])


def system(variables: str, *equations: str) -> PolynomialSystem:
    names = tuple(variables.split())
    return PolynomialSystem(names, tuple(parse_polynomial(text, names) for text in equations))


def test_a_loop_closes_in_one_complex_equation() -> None:
    found = turns_of(
        system(
            "c1 s1 c2 s2", "c1^2 + s1^2 - 1", "3*c2^2 + 3*s2^2 - 6", "2*c1 - s2 - 1", "2*s1 + c2"
        )
    )
    assert found is not None
    assert found.pairs == ((0, 1), (2, 3))
    assert found.squares == (1, 2)
    assert found.weight == 1
    assert found.loops.tolist() == [[2, 1j, -1]]
    assert found.freedoms == 0


@given(
    st.lists(st.tuples(numbers, numbers), min_size=2, max_size=3),
    numbers,
    numbers,
    factors,
    weights,
)
def test_loops_are_the_equations_in_isotropic_coordinates(plates, x, y, factor, weight) -> None:
    if not any(a or b for a, b in plates):
        return
    n = 2 * len(plates)
    v = Polynomial.variables(n)
    pairs = list(zip(v[::2], v[1::2], strict=True))
    real, imaginary = v[0] * 0 + x, v[0] * 0 + y
    for (c, s), (a, b) in zip(pairs, plates, strict=True):
        real, imaginary = real + c * a - s * (weight * b), imaginary + s * a + c * b
    imaginary = imaginary * factor
    circles = [c * c + s * s * weight - 1 for c, s in pairs]
    names = tuple(f"x{i}" for i in range(n))
    found = turns_of(PolynomialSystem(names, (real, *circles, imaginary)))
    assert found is not None
    assert found.weight == weight
    rng = np.random.default_rng(0)
    point = rng.standard_normal(n) + 1j * rng.standard_normal(n)
    j = 1j * sqrt(weight)
    z, w = point[::2] + j * point[1::2], point[::2] - j * point[1::2]
    first, second = _value(real, point), _value(imaginary, point) / float(factor)
    (row,) = found.loops
    near = {"rel": 1e-11, "abs": 1e-11}
    assert row[:-1] @ z + row[-1] == pytest.approx(first + j * second, **near)
    assert row[:-1].conj() @ w + row[-1].conj() == pytest.approx(first - j * second, **near)


def _value(f: Polynomial, point: np.ndarray) -> complex:
    size = max(map(abs, f.doubles), default=0.0)
    return complex(Evaluator.of([f], f.n).values(point[None])[0, 0]) * size


@pytest.mark.parametrize(
    "equations",
    [
        ["c^2 - s^2 - 1"],
        ["c^2 + s^2"],
        ["c^2 + 2*s^2 - 1", "c + 3*s", "s - 3*c"],
        ["c^2 + s^2 - 1", "c + s - 1"],
        ["c^2 + s^2 - 1", "c - 2*s + 1", "3*c + s - 1"],
        ["c^2 + s^2 - 1", "c*s - 1"],
        ["c^2 + s^2 - 1", "c^2 + s^2 - 2"],
        ["c^2 + s^2 - pi"],
        ["c - s", "c + s"],
    ],
)
def test_other_equations_are_none_of_turns(equations: list[str]) -> None:
    assert turns_of(system("c s", *equations)) is None


def test_circles_and_loops_with_square_roots_are_turns() -> None:
    found = turns_of(
        system(
            "c s x y",
            *("c^2 + s^2 - sqrt(2)", "x^2 + y^2 - 1"),
            *("sqrt(3)*c + s + x - 2", "sqrt(3)*s - c + y"),
        )
    )
    assert found is not None
    assert found.squares == (square_root(2), 1)
    # (sqrt(3) - i) (c + i s) + (x + i y) - 2.
    assert found.loops == pytest.approx(np.array([[3**0.5 - 1j, 1, -2]]), abs=1e-15)


def test_circles_of_different_kinds_are_none_of_turns() -> None:
    assert turns_of(system("c s x y", "c^2 + s^2 - 1", "x^2 + 2*y^2 - 1")) is None


def test_a_variable_on_no_circle_is_none_of_turns() -> None:
    assert turns_of(system("c s x", "c^2 + s^2 - 1", "c - x", "s + 1")) is None


@pytest.mark.parametrize("extreme", [Fraction(1, 10**400), Fraction(10**400)])
def test_numbers_that_doubles_do_not_hold_are_left_alone(extreme: Fraction) -> None:
    c, s = Polynomial.variables(2)
    for circle, first in (
        (c * c + s * s - 1, c * extreme + 1),
        (c * c + s * s - extreme, c * 2 + 1),
        (c * c + s * s * extreme - 1, c + 1),
    ):
        second = Polynomial(2, {(0, 1): first.terms[1, 0]})
        assert turns_of(PolynomialSystem(("c", "s"), (circle, first, second))) is None
    assert turns_of(PolynomialSystem(("c", "s"), (c * c + s * s - 1, c * 2 + 1, s * 2))) is not None
