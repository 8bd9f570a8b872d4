"""Laws of exact polynomials."""

from __future__ import annotations

import pickle
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from nag.algebra.expression import parse_polynomial
from nag.algebra.number import square_root
from nag.algebra.polynomial import Polynomial, find_nonzero_variables
from nag.algebra.system import PolynomialSystem

N = 3
NAMES = ("x", "y", "z")

coefficients = st.fractions(min_value=-20, max_value=20, max_denominator=12)
exponents = st.tuples(*[st.integers(0, 3)] * N)
polynomials = st.dictionaries(exponents, coefficients, max_size=5).map(lambda t: Polynomial(N, t))
points = st.lists(coefficients, min_size=N, max_size=N)


@given(polynomials, polynomials, polynomials)
def test_ring_laws(f, g, h):
    assert f * (g + h) == f * g + f * h
    assert (f * g) * h == f * (g * h)
    assert f * g == g * f
    assert f - f == Polynomial(N, {})


@given(polynomials, polynomials, points)
def test_evaluation_is_a_ring_homomorphism(f, g, p):
    assert (f * g)(p) == f(p) * g(p)
    assert (f + g)(p) == f(p) + g(p)
    assert (f**3)(p) == f(p) ** 3


@given(polynomials, st.lists(polynomials, min_size=N, max_size=N), points)
def test_composition_evaluates_at_the_images(f, images, p):
    assert f.compose(images)(p) == f([g(p) for g in images])


@given(polynomials, polynomials)
def test_derivative_obeys_the_product_rule(f, g):
    for i in range(N):
        assert (f * g).derivative(i) == f.derivative(i) * g + f * g.derivative(i)


@given(polynomials)
def test_text_reads_back_to_the_same_polynomial(f):
    assert parse_polynomial(f.text(NAMES), NAMES) == f


@given(polynomials)
def test_no_zero_coefficient_is_kept_and_pickling_keeps_the_polynomial(f):
    assert all(c != 0 for c in f.terms.values())
    copy = pickle.loads(pickle.dumps(f))
    assert copy == f and hash(copy) == hash(f)


@given(polynomials, polynomials)
def test_degrees_add_under_multiplication(f, g):
    if f and g:
        assert (f * g).degree == f.degree + g.degree
        assert (f * g).degree_in((0, 2)) == f.degree_in((0, 2)) + g.degree_in((0, 2))


@given(polynomials, points)
def test_identified_variables_take_the_same_value(f, p):
    identified = f.with_variables(2, (1, 0, 1))
    assert identified([p[0], p[1]]) == f([p[1], p[0], p[1]])


@given(st.lists(polynomials, max_size=3), st.lists(st.integers(-3, 3), min_size=N, max_size=N))
def test_variables_that_equations_keep_from_zero_vanish_at_no_zero(rows, p):
    found = find_nonzero_variables((f.terms for f in rows), N)
    assert list(found) == sorted(set(found))
    if all(f(p) == 0 for f in rows):
        assert all(p[i] for i in found)


def test_a_variable_is_kept_from_zero_by_a_constant_and_multiples_of_it() -> None:
    x, y, z = Polynomial.variables(N)
    assert find_nonzero_variables([(x * y * (x + z) - 1).terms], N) == (0, 1)
    assert find_nonzero_variables([(x * y).terms, (y * z + x - 1).terms, {}], N) == ()
    assert find_nonzero_variables([(z + z * x - 2).terms, (x * z + 1).terms], N) == (0, 2)
    assert find_nonzero_variables([Polynomial.constant(N, 1).terms], N) == ()


def test_degree_of_constants_and_of_zero():
    assert Polynomial.constant(2, 5).degree == 0
    assert Polynomial(2, {}).degree == -1
    assert Polynomial(0, {(): Fraction(3)})([]) == 3


def test_support():
    x, _, z = Polynomial.variables(3)
    f = x * z - 2 * z + 7
    assert f.support == {0, 2}


def test_irrational_coefficients_cancel_exactly_and_are_marked():
    root = square_root(3)
    (x,) = Polynomial.variables(1)
    f = (x - root) * (x + root)
    assert f == x**2 - 3
    assert f.exact
    assert not (root * x).exact


def test_float_points_are_evaluated_in_floats():
    x, y = Polynomial.variables(2)
    assert (x * y - Fraction(1, 2))([0.5, 2j]) == 1j - 0.5


def test_polynomials_are_read_only():
    (x,) = Polynomial.variables(1)
    with pytest.raises(TypeError):
        x.terms[(0,)] = Fraction(1)


def test_mixing_different_numbers_of_variables_is_refused():
    with pytest.raises(ValueError, match="do not mix"):
        Polynomial.variable(1, 0) + Polynomial.variable(2, 0)
    with pytest.raises(ValueError, match="images are needed"):
        Polynomial.variable(2, 0).compose([Polynomial.variable(1, 0)])
    with pytest.raises(ValueError, match="negative power"):
        Polynomial.variable(1, 0) ** -1
    with pytest.raises(ZeroDivisionError):
        Polynomial.variable(1, 0) / 0


def test_system_refuses_what_does_not_fit_together():
    x, y = Polynomial.variables(2)
    with pytest.raises(ValueError, match="same name"):
        PolynomialSystem(("x", "x"), (x,))
    with pytest.raises(ValueError, match="1 variables in a system of 2"):
        PolynomialSystem(("x", "y"), (Polynomial.variable(1, 0),))
    with pytest.raises(ValueError, match="partition"):
        PolynomialSystem(("x", "y"), (x + y,), groups=((0,),))


def test_jacobian_of_a_system():
    x, y = Polynomial.variables(2)
    system = PolynomialSystem(("x", "y"), (x**2 + y**2 - 1, x * y))
    assert system.jacobian == ((2 * x, 2 * y), (y, x))
    assert system.degrees == (2, 2)
    assert system([Fraction(3, 5), Fraction(4, 5)]) == [0, Fraction(12, 25)]


def test_values_at_fractions_are_those_of_the_terms_one_by_one() -> None:
    f = parse_polynomial("3/7*x^3*y - 5*y^2*z + 1/11*z^4 - 2/3", ("x", "y", "z"))
    x, y, z = Fraction(-2, 5), Fraction(0), Fraction(7, 3)
    at = Fraction(3, 7) * x**3 * y - 5 * y**2 * z + Fraction(1, 11) * z**4 - Fraction(2, 3)
    assert f((x, y, z)) == at
    assert type(f((x, y, z))) is Fraction
    assert Polynomial(3, {})((x, y, z)) == 0
    assert Polynomial.constant(0, Fraction(3, 4))(()) == Fraction(3, 4)
