"""Elimination is reversible, exact, and keeps degrees."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from systems import system

from nag.algebra.elimination import eliminate_linear
from nag.algebra.expression import parse_polynomial
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem

small = st.integers(-3, 3).map(Fraction)
N = 5
linear_forms = st.lists(small, min_size=N + 1, max_size=N + 1).map(
    lambda c: sum(
        (a * x for a, x in zip(c, Polynomial.variables(N), strict=False)),
        Polynomial.constant(N, c[N]),
    )
)
quadrics = st.tuples(linear_forms, linear_forms, linear_forms).map(lambda t: t[0] * t[1] + t[2])
systems = st.builds(
    lambda linear, quadratic: PolynomialSystem(
        tuple(f"x{i}" for i in range(N)), (*linear, *quadratic)
    ),
    st.lists(linear_forms, max_size=4),
    st.lists(quadrics, max_size=3),
)


@given(systems, st.lists(small, min_size=N, max_size=N), st.booleans())
def test_equations_at_a_lifted_point_follow_from_the_reduced_ones(original, values, graphs):
    result = eliminate_linear(original, graphs=graphs)
    point = values[: result.system.n]
    lifted = result.lift(point)
    assert result.project(lifted) == point
    reduced_values = result.system(point)
    original_values = original(lifted)
    if all(v == 0 for v in reduced_values):
        assert all(v == 0 for v in original_values)
    # Every original equation composed with the images is zero or a reduced equation.
    composed = {f.compose(result.images) for f in original.polynomials}
    assert all(
        not f or any(f == g or f == -g or _proportional(f, g) for g in result.system.polynomials)
        for f in composed
    )


def _proportional(f: Polynomial, g: Polynomial) -> bool:
    if f.terms.keys() != g.terms.keys():
        return False
    return len({f.terms[e] / g.terms[e] for e in f.terms}) == 1


@given(systems, st.booleans())
def test_no_degree_rises_and_nothing_linear_is_left(original, graphs):
    result = eliminate_linear(original, graphs=graphs)
    highest = max(original.degrees, default=-1)
    assert all(d <= highest for d in result.system.degrees)
    assert 1 not in result.system.degrees
    if not graphs:
        assert max((image.degree for image in result.images), default=0) <= 1


def test_slider_crank_loses_one_variable():
    crank = system(
        "c1 s1 c2 s2 c3 s3",
        "2*s1 + s2 + s3",
        "c1^2 + s1^2 - 1",
        "c2^2 + s2^2 - 1",
        "c3^2 + s3^2 - 1",
    )
    result = eliminate_linear(crank)
    assert result.system.n == 5
    assert result.system.degrees == (2, 2, 2)
    assert max((image.degree for image in result.images), default=0) <= 1
    lifted = result.lift(result.project([Fraction(x) for x in (0, -1, 0, 1, 0, 1)]))
    assert crank(lifted) == [0, 0, 0, 0]


def test_a_variable_with_a_small_coefficient_is_not_eliminated():
    circle = "x^2 + y^2 - 1"
    for line, kept in (("x/50 + y - z", 0), ("x + y/50 - z/100", 1)):
        result = eliminate_linear(system("x y z", line, circle, "z^2 - z"))
        assert kept in result.kept
        # Points on the circle are as far apart as before, but for small factors.
        slopes = [abs(c) for image in result.images for c in image.terms.values()]
        assert max(slopes) <= 8


def test_a_graph_is_solved_only_when_asked_for():
    curve = system("x y z", "x^2 + y^2 - 1", "z - 4*x^4 - 3*y^3 - x*y - 4")
    solved = eliminate_linear(curve)
    assert solved.system.variables == ("x", "y")
    assert max(image.degree for image in solved.images) == 4
    assert solved.lift([Fraction(1), Fraction(0)]) == [1, 0, 8]
    kept = eliminate_linear(curve, graphs=False)
    assert kept.system == curve


def test_a_graph_that_would_raise_a_degree_stays():
    surface = system("x y z", "z - x^2", "z*y - 1")
    assert eliminate_linear(surface).system == surface


def test_variables_to_keep_are_kept():
    line = system("x y", "x - 2*y")
    assert eliminate_linear(line, keep=[0]).system.variables == ("x",)
    assert eliminate_linear(line, keep=[1]).system.variables == ("y",)
    assert eliminate_linear(line, keep=[0, 1]).system == line


def test_contradictions_stay_and_redundancies_go():
    assert eliminate_linear(system("x", "x", "x - 1")).system.text() == ["-1"]
    result = eliminate_linear(system("x y", "x - y", "2*x - 2*y", "x^2 - y^2"))
    assert result.system.n == 1
    assert result.system.polynomials == ()


def test_equations_that_become_linear_are_solved_too():
    result = eliminate_linear(system("x y z", "x - y", "x^2 - y^2 + z - 3"))
    assert result.system.variables == ("y",)
    assert result.system.polynomials == ()
    assert result.lift([Fraction(2)]) == [2, 2, 3]


def test_conditions_are_carried_along():
    names = ("x", "y", "z")
    condition = parse_polynomial("x^2 + 1", names)
    result = eliminate_linear(system("x y z", "x - y - z", "y*z - 1", nonzero=(condition,)))
    assert result.system.nonzero == (condition.compose(result.images),)


def test_groups_lose_their_eliminated_variables_and_keep_their_degrees():
    grouped = system("x y z", "z - 3", "x*y - z", groups=((0,), (1,), (2,)))
    result = eliminate_linear(grouped)
    assert result.system.groups == ((0,), (1,))
    assert result.system.text() == ["x*y - 3"]
    # Substituting y for x would give the group of y degree 2.
    mixed = system("x y", "x - y", "x*y - 1", groups=((0,), (1,)))
    assert eliminate_linear(mixed).system == mixed


def test_arrays_of_points_are_lifted_at_once():
    result = eliminate_linear(system("x y z", "x - 1", "z - y - 2"))
    lifted = result.lift(np.array([[1j], [2.0]]))
    assert lifted.shape == (2, 3)
    assert np.array_equal(lifted, [[1, 1j - 2, 1j], [1, 0, 2]])
    assert np.array_equal(result.project(lifted), [[1j], [2.0]])
    assert eliminate_linear(system("x", "x - 4")).lift(np.zeros((3, 0))).tolist() == [[4.0]] * 3
