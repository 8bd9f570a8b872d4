"""Zeros that are algebraic numbers: all of them, exact, with their multiplicities."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from systems import system

from nag.algebra.algebraic_zeros import algebraic_zeros
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem


def multiplicities(of: PolynomialSystem) -> Counter[int]:
    zeros = algebraic_zeros(of)
    assert zeros is not None
    assert all(z.vanishes(f) for z in zeros for f in of.polynomials)
    return Counter(z.multiplicity for z in zeros)


@pytest.mark.parametrize(
    ("of", "expected"),
    [
        (system("x", "x^13"), {13: 1}),
        (system("x", "x^60 - 1"), {1: 60}),
        (system("x", "(x - 1)*(x - 1 - 1/10^25)"), {1: 2}),
        (system("x", "x^2 - 1", "x^3 - 1"), {1: 1}),
        (system("x", "x", "x - 1"), {}),
        (system("x y", "y", "y - x^13"), {13: 1}),
        (system("x y", "y - x^2", "x^2 + y^2 - 1"), {1: 4}),
        (system("x y", "x^2 + y^3", "y^2 - x^3"), {4: 1, 1: 5}),
        (system("x y", "x^2 - 2", "y^2 - 2"), {1: 4}),
        (system("x y", "x*y - 1", "x*y - 2"), {}),
        (system("x y", "x*y + x^3 + y^3", "x^2 + y^3/10^6"), {5: 1, 1: 4}),
        (system("x y", "x*y - 1 + (x^3+y^3)/10^15", "x^2*y - 2*x + 3*y + x^4/10^15"), {1: 12}),
        (system("x y", "-2*x*y^3 - 2*x^2 + 3*y - 1/500", "-2*y - 3*y^4/100000"), {1: 8}),
        (system("x y z", "z - x*y", "x^2 + z - y", "y^3 - z^2 + x"), {1: 7}),
    ],
    ids=str,
)
def test_zeros_are_as_many_as_is_known(of, expected) -> None:
    assert multiplicities(of) == expected


@pytest.mark.parametrize(
    "of",
    [
        system("x y", "x - 1"),
        system("x y", "x*y - 1", "x^2*y - x"),
        system("x", "x^2 - sqrt(2)"),
        system("x y z", "x*y - 1", "y*z - 2", "z^2*x - 3*y^2"),
    ],
    ids=str,
)
def test_other_systems_are_left_to_other_methods(of) -> None:
    assert algebraic_zeros(of) is None


def test_wilkinsons_roots_are_integers() -> None:
    (x,) = Polynomial.variables(1)
    f = Polynomial.constant(1, 1)
    for k in range(1, 31):
        f = f * (x - k)
    zeros = algebraic_zeros(PolynomialSystem(("x",), (f,)))
    assert sorted(z.point[0] for z in zeros) == list(range(1, 31))
    assert all(z.real for z in zeros)


def test_small_coordinates_keep_all_their_digits() -> None:
    zeros = algebraic_zeros(system("x y", "x - y/10^20 - y^2", "(y - 1/10^20)*(y^2 + y + 1)"))
    (small,) = [z for z in zeros if abs(z.point[1]) < 1e-3]
    assert small.point == pytest.approx([2e-40, 1e-20], rel=1e-15)


def test_roots_closer_than_doubles_remain_two() -> None:
    first, second = algebraic_zeros(system("x", "(x - 1)*(x - 1 - 1/10^25)"))
    assert first.point == second.point == 1
    f = Polynomial(1, {(1,): Fraction(1), (0,): Fraction(-1)})
    assert [first.vanishes(f), second.vanishes(f)].count(True) == 1


def test_independence_of_gradients_is_decided_exactly() -> None:
    of = system("x y", "x^2 - 2", "y^2 - x*y - 1")
    touching = system("x y", "x^2 + y^2 - 4", "x - y - (x^2 - y^2)/100", "x + y", "x^2 + y^2")
    circle, other, line, cone = touching.polynomials
    for zero in algebraic_zeros(of):
        assert zero.independent(of.polynomials)
        assert zero.independent([circle]) and zero.independent([circle, other])
        assert not zero.independent([circle, cone])
        assert not zero.independent([circle, other, line])
    (origin,) = algebraic_zeros(system("x y", "x", "y"))
    assert origin.independent([line, other]) and not origin.independent([cone])


@given(
    st.lists(st.tuples(st.integers(-3, 3), st.integers(1, 3)), min_size=1, max_size=2),
    st.lists(st.tuples(st.integers(-3, 3), st.integers(1, 2)), min_size=1, max_size=2),
    st.integers(-2, 2),
)
@settings(max_examples=25)
def test_grids_of_fat_points_have_the_product_of_the_multiplicities(xs, ys, k) -> None:
    x, y = Polynomial.variables(2)
    f, g = Polynomial.constant(2, 1), Polynomial.constant(2, 1)
    at: list[Counter[int]] = [Counter(), Counter()]
    for root, power in xs:
        f *= (x - root) ** power
        at[0][root] += power
    for root, power in ys:
        g *= (y - k * x - root) ** power
        at[1][root] += power
    wanted = {(a, b + k * a): m * n for (a, m), (b, n) in product(at[0].items(), at[1].items())}
    zeros = algebraic_zeros(PolynomialSystem(("x", "y"), (f, g)))
    assert {tuple(np.real(z.point)): z.multiplicity for z in zeros} == wanted
