"""Dual spaces of local rings, modulo a prime and in many digits; truncated power series."""

from __future__ import annotations

import flint
import pytest
from singular_zeros import polynomials

from nag.algebra.exact_ranks import PrimeField
from nag.numerics.ball_ranks import Digits, Field, UnclearRank
from nag.numerics.dual_space import DualSpace, dual_space
from nag.numerics.implicit_function import eliminate
from nag.numerics.power_series import Series, SeriesRing, compose_series, derivatives, evaluate

PRIME = 4611686018427387847
FIELDS = [PrimeField(PRIME), Digits(60, -40.0, -20.0)]


def number(field: Field, c):
    if isinstance(field, PrimeField):
        return field.of(c)
    return flint.acb(flint.arb(flint.fmpq(*c.as_integer_ratio())))


def at_origin(field: Field, variables: str, equations: str, highest: int) -> DualSpace:
    rows = polynomials(variables, *equations.split(", "))
    n = rows[0].n

    def series(order: int) -> tuple[SeriesRing, list[Series]]:
        ring = SeriesRing(n, order, field.modulus)
        terms = [[(e, number(field, c)) for e, c in f.terms.items()] for f in rows]
        return ring, compose_series(terms, [{ring.unit(i): 1} for i in range(n)], ring)

    with flint.ctx.workdps(60):
        return dual_space(field, n, series, highest, lambda hilbert: False)


@pytest.mark.parametrize("field", FIELDS)
@pytest.mark.parametrize(
    ("variables", "equations", "hilbert"),
    [
        ("x y", "x^3, y^4", (1, 2, 3, 3, 2, 1)),
        ("x y", "x^2 + y^3, x*y", (1, 2, 1, 1)),
        ("x y z", "x^3 - y*z, y^3 - x*z, z^3 - x*y", (1, 3, 3, 3, 1)),
        ("x y z", "x^2 + y^2, x^2 - z^2, x*y, y*z, x*z", (1, 3, 1)),
    ],
)
def test_a_finite_local_ring_has_its_hilbert_function(
    field: Field, variables: str, equations: str, hilbert: tuple[int, ...]
) -> None:
    space = at_origin(field, variables, equations, 20)
    assert space.finite
    assert space.hilbert == hilbert


@pytest.mark.parametrize("field", FIELDS)
def test_the_dual_space_at_a_point_of_a_line_grows_for_ever(field: Field) -> None:
    space = at_origin(field, "x y", "x*y, x^2", 12)
    assert not space.finite
    assert space.hilbert == (1, 2) + (1,) * 11


def test_a_number_that_may_be_zero_or_not_is_no_rank() -> None:
    with flint.ctx.workdps(60), pytest.raises(UnclearRank):
        Digits(60, -40.0, -20.0).null_space([[flint.acb("1e-30")]], 1)


def test_null_spaces_of_badly_scaled_matrices_are_right() -> None:
    with flint.ctx.workdps(60):
        small = flint.acb("1e-15")
        rows = [[flint.acb(1), flint.acb(1), flint.acb(0)], [flint.acb(1), 1 + small, small]]
        (vector,) = Digits(60, -40.0, -20.0).null_space(rows, 3)
        for row in rows:
            total = sum((a * b for a, b in zip(row, vector, strict=True)), flint.acb(0))
            assert abs(total) < 1e-40


def test_products_of_series_end_at_their_order() -> None:
    ring = SeriesRing(2, 3)
    x_plus_y = {ring.unit(0): 1, ring.unit(1): 1}
    square = ring.multiply(x_plus_y, x_plus_y)
    assert {ring.exponents(k): c for k, c in square.items()} == {(2, 0): 1, (1, 1): 2, (0, 2): 1}
    assert ring.multiply(square, square) == {}
    assert evaluate(square, ring, [2, 5]) == 49


def test_derivatives_are_divided_by_factorials() -> None:
    ring = SeriesRing(2, 4)
    derived = derivatives([{ring.key((3, 1)): 2}, {}], ring, 2)
    assert derived == [[], [((2, 0), 6)], [((1, 1), 6)], [], [], []]


def test_the_implicit_function_of_a_circle_is_a_square_root() -> None:
    rows = [[((2, 0), 1), ((0, 2), 1), ((0, 0), PRIME - 1)]]
    found = eliminate(rows, [0, 1], [0], [1], 6, PRIME)
    assert found is not None
    coefficients = [found.images[1].get(found.ring.key((k,)), 0) for k in range(7)]
    half, eighth, sixteenth = (pow(k, -1, PRIME) for k in (2, 8, 16))
    assert coefficients == [1, 0, PRIME - half, 0, PRIME - eighth, 0, PRIME - sixteenth]


@pytest.mark.parametrize("field", FIELDS, ids=["prime", "digits"])
def test_solved_equations_vanish_along_their_series(field: Field) -> None:
    rows = polynomials("x y u v", "x + u*y - v^2", "2*y + x^2*u + u^3 - x*v", "x*y + u*v - y^3")
    terms = [[(e, number(field, c)) for e, c in f.terms.items()] for f in rows]
    with flint.ctx.workdps(60):
        found = eliminate(terms, [0, 0, 0, 0], [0, 1], [0, 1], 7, field.modulus)
        assert found is not None
        *solved, rest = compose_series(terms, found.images, found.ring)
        assert all(field.is_zero(c) for s in solved for c in s.values())
        [known] = found.rest
        for key in rest.keys() | known.keys():
            difference = rest.get(key, 0) - known.get(key, 0)
            assert field.is_zero(difference % PRIME if field.modulus else flint.acb(difference))
