"""Ends that doubles leave doubtful: balls, proofs, limits and their evidence."""

from __future__ import annotations

from fractions import Fraction
from itertools import product
from math import factorial
from types import SimpleNamespace
from typing import Annotated, NamedTuple

import flint
import numpy as np
import pytest
from random_small import far_system

import nag
from nag.algebra.polynomial import Polynomial
from nag.machine_code.lanes import scratch
from nag.machine_code.records import Reals
from nag.tracking.compiled import compile_rows
from nag.tracking.ends import end_run
from nag.tracking.ends.at_infinity import at_infinity
from nag.tracking.ends.follow import Unfinished, follow
from nag.tracking.ends.inclusion import prove_end
from nag.tracking.ends.initial_forms import FINE, InitialForms
from nag.tracking.ends.limits import Limits, digits_of_evidence
from nag.tracking.ends.records import composition
from nag.tracking.ends.runs import MAX_WINDING, TAIL
from nag.tracking.ends.terms import Terms
from nag.tracking.homotopy import Homotopy, straight_line
from nag.tracking.paths import NEVER, Paths, PathStatus
from nag.tracking.settings import Settings

GAMMA = complex(np.exp(2j))


def homotopy_of(polynomials: list[Polynomial]) -> tuple[Homotopy, np.ndarray]:
    """From roots of unity, and the start points."""
    x = Polynomial.variables(polynomials[0].n)
    degrees = [f.degree for f in polynomials]
    start = compile_rows([v**d - 1 for v, d in zip(x, degrees, strict=True)])
    roots = [[np.exp(2j * np.pi * k / d) for k in range(d)] for d in degrees]
    starts = np.array([(1, *point) for point in product(*roots)])
    homotopy = straight_line(start, compile_rows(polynomials), GAMMA)
    return homotopy, homotopy.normalized(starts)


def followed(polynomials: list[Polynomial], settings: Settings | None = None) -> Paths:
    """All paths, followed from t = 1 on in more digits than doubles have."""
    homotopy, starts = homotopy_of(polynomials)
    reached = np.zeros(len(starts), dtype=bool)
    ones = np.ones(len(starts))
    unfinished = Unfinished(starts, reached, reached, starts, ones, starts)
    return follow(homotopy, unfinished, settings or Settings())


def test_regular_ends_are_balls_that_hold_the_zeros() -> None:
    (x,) = Polynomial.variables(1)
    paths = followed([x**3 - 2])
    assert (paths.status == PathStatus.REGULAR).all()
    for ball in paths.balls.values():
        (a, b), (c, d) = ball.fractions()
        size = a * a + b * b
        re, im = (c * a + d * b) / size, (d * a - c * b) / size
        cube = (re**3 - 3 * re * im**2, 3 * re**2 * im - im**3)
        assert abs(cube[0] - 2) < Fraction(1, 10**28)
        assert abs(cube[1]) < Fraction(1, 10**28)


def test_an_end_far_out_gets_the_digits_that_it_needs_after_division() -> None:
    x, y = Polynomial.variables(2)
    paths = followed([x - y - 1 - y * Fraction(1, 10**24), x - 4 * x + y * 3 - 7])
    assert (paths.status == PathStatus.REGULAR).all()
    ball = paths.balls[0]
    (a, b), (c, d) = ball.fractions()[:2]
    exact = Fraction(-10 * 10**24 - 7, 3)
    affine = complex(c, d) / complex(a, b)
    assert abs(affine / float(exact) - 1) < 1e-13
    assert float(ball.radii[0] / abs(complex(a, b))) < 1e-15
    assert paths.accuracy[0] < 1e-14


@pytest.mark.parametrize(("a", "b"), [(2, 1), (3, 2), (4, 1), (5, 3)])
def test_orders_of_branches_to_infinity_are_rational(a: int, b: int) -> None:
    # x^a y^b = 1 and x = 1: all paths but b go to infinity.
    x, y = Polynomial.variables(2)
    paths = followed([x**a * y**b - 1, x - 1])
    assert len(paths.where(PathStatus.REGULAR)) == b
    assert len(paths.where(PathStatus.AT_INFINITY)) == a
    assert len(paths.where(PathStatus.FAILED)) == 0


class _OneSeries(NamedTuple):
    logs: Annotated[Reals, "2 terms"]
    base_sizes: Annotated[Reals, "1"]
    base_weights: Annotated[Reals, "1"]
    measures: Annotated[Reals, "2"]


@pytest.mark.parametrize("small", [1.0, 1e-9, 1e-12])
@pytest.mark.parametrize("w", [1, 2, 3, 5, 7])
def test_fractional_powers_with_small_coefficients_still_make_the_winding_number(
    w: int, small: float
) -> None:
    order, lanes, number = 14, 8, 60
    t = 10.0 ** -np.arange(9.0, 9 + lanes)
    exponents = np.arange(1, number) / w
    sizes = np.where(exponents % 1 == 0, 1.0, small)
    phases = np.exp(2j * np.pi * np.random.default_rng(1).random(number - 1))
    room = scratch(_OneSeries, terms=order + 1).record
    for k in range(order + 1):
        # Taylor coefficients of the sum in the logarithm of t.
        terms = sizes * phases * exponents**k / factorial(k) * t[:, None] ** exponents
        room.logs[2 * lanes * k :][:lanes] = terms.sum(axis=1).real
        room.logs[2 * lanes * k + lanes :][:lanes] = terms.sum(axis=1).imag
    room.base_sizes[:], room.base_weights[:] = 1.0, 0.5
    equations = SimpleNamespace(N=1, logarithm=composition(order).ravel())
    batch = SimpleNamespace(order=order, tail=TAIL, max_winding=MAX_WINDING)
    end_run._best_winding(equations, room, batch)
    tails, found = room.measures[:lanes], room.measures[lanes : 2 * lanes]
    assert (tails < TAIL).all()
    if small > 1e-12:
        assert (found == w).all()
    else:
        # What is left out of a series in t is no more than its tail would be.
        assert set(found.tolist()) <= {1.0, float(w)}


@pytest.mark.parametrize("m", [2, 3, 5])
def test_winding_numbers_are_those_of_the_branches(m: int) -> None:
    (x,) = Polynomial.variables(1)
    paths = followed([(x - Fraction(1, 3)) ** m * (x + 2)])
    singular = paths.where(PathStatus.SINGULAR)
    assert len(singular) == m
    assert (paths.winding[singular] == m).all()
    points = paths.points[singular]
    error = np.abs(points[:, 1] / points[:, 0] - 1 / 3)
    assert (error <= 3 * paths.accuracy[singular]).all()


@pytest.mark.parametrize("power", [6, 12, 18, 25])
def test_solutions_far_out_are_not_taken_for_ends_at_infinity(power: int) -> None:
    x, y = Polynomial.variables(2)
    small = Fraction(1, 10**power)
    paths = followed([x * y - 1 + x * x * small, x + y - 3 + y * y * small])
    assert (paths.status == PathStatus.REGULAR).all()
    assert len(paths.balls) == 4


@pytest.mark.parametrize("power", [100, 160, 200, 240])
def test_zeros_so_small_that_squares_of_terms_leave_the_range_are_regular(power: int) -> None:
    x, y = Polynomial.variables(2)
    paths = followed([x**4 - Fraction(1, 10**power), y - x**2 - x])
    finite = paths.points[paths.status == PathStatus.REGULAR]
    zeros = finite[:, 1] / finite[:, 0]
    assert np.allclose(np.abs(zeros), 10.0 ** (-power / 4), rtol=1e-9, atol=0)
    assert len({complex(np.round(z * 10.0 ** (power / 4), 6)) for z in zeros}) == 4


def test_paths_that_were_lost_on_the_way_may_take_more_steps_than_an_end() -> None:
    # x^3 = (y^2 + e) ((y - 1/10)^2 + e) .. for y = t - 1/20: the zeros meet, but for e, each time.
    x, y = Polynomial.variables(2)
    cube, e = Polynomial.constant(2, 1), Fraction(1, 10**16)
    for k in range(10):
        cube = cube * ((y - Fraction(k, 10)) ** 2 + e)
    homotopy = Homotopy(
        compile_rows([x**3 - cube * 10**9]), np.array([[0.05, 0, 1]]), np.array([[-1.0, 0, 0]])
    )
    start, end = (float(cube((0, Fraction(y)))) ** (1 / 3) for y in ("19/20", "-1/20"))
    starts = homotopy.normalized(np.array([[1, 1e3 * start, 0.95]]))
    no = np.zeros(1, dtype=bool)
    paths = follow(homotopy, Unfinished(starts, no, no, starts, np.ones(1), starts), Settings())
    assert paths.status[0] == PathStatus.REGULAR
    assert paths.steps[0] > 300
    assert abs(paths.points[0, 1] / paths.points[0, 0] - 1e3 * end) < 1e-9 * end


def test_paths_go_on_from_their_starts_where_doubles_left_no_point_of_them() -> None:
    (x,) = Polynomial.variables(1)
    homotopy, starts = homotopy_of([x**3 - 2])
    no = np.zeros(3, dtype=bool)
    # Far from all zeros at t = 1/10, where Newton's method overshoots.
    lost = homotopy.normalized(np.tile([1, 1e-4], (3, 1)))
    unfinished = Unfinished(lost, no, no, lost, np.full(3, 0.1), starts)
    paths = follow(homotopy, unfinished, Settings())
    assert (paths.status == PathStatus.REGULAR).all()
    expected = followed([x**3 - 2]).points
    assert np.allclose(paths.points[:, 1] / paths.points[:, 0], expected[:, 1] / expected[:, 0])


def test_zeros_that_are_not_regular_are_not_proved() -> None:
    (x,) = Polynomial.variables(1)
    centre = np.zeros((2, 2, 2))
    centre[:, 0, 0] = 1.0
    errors = np.full(2, 1e-30)
    double, starts = homotopy_of([(x - 1) ** 2])
    simple, _ = homotopy_of([(x - 1) * (x + 1)])
    assert prove_end(Terms(double), centre, errors) is None
    assert prove_end(Terms(simple), centre, errors) is not None
    assert len(starts) == 2


def test_no_more_digits_are_asked_for_near_a_double_zero() -> None:
    (x,) = Polynomial.variables(1)
    centre = np.zeros((2, 2, 2))
    centre[:, 0, 0], centre[1, 0, 1] = 1.0, 1e-18
    double, _ = homotopy_of([(x - 1) ** 2])
    terms = Terms(double)
    assert prove_end(terms, centre, np.full(2, 1e-18)) is None
    assert "finer" not in vars(terms)


@pytest.mark.parametrize("k", [8, 12, 14, 20, 24])
def test_the_radii_of_close_ends_hold_one_zero_each(k: int) -> None:
    # Zeros at 1/3 +- 10^-k.
    (x,) = Polynomial.variables(1)
    paths = followed([(x - Fraction(1, 3)) ** 2 - Fraction(1, 10 ** (2 * k))])
    assert (paths.status == PathStatus.REGULAR).all()
    signs = set()
    for ball in paths.balls.values():
        (a, b), (c, d) = ball.fractions()
        real, imaginary = (a * c + b * d) / (a * a + b * b), (a * d - b * c) / (a * a + b * b)
        sign = 1 if real > Fraction(1, 3) else -1
        error = 4 * Fraction(ball.radii.max())
        assert abs(real - Fraction(1, 3) - sign * Fraction(1, 10**k)) < error < Fraction(1, 10**k)
        assert abs(imaginary) < error
        signs.add(sign)
    assert signs == {1, -1}


def test_a_box_without_a_zero_is_not_proved() -> None:
    (x,) = Polynomial.variables(1)
    homotopy, _ = homotopy_of([x**2 - 2])
    centre = np.zeros((2, 2, 2))
    centre[0, 0, 0], centre[1, 0, 0] = 1.0, 1.4142135623730951
    assert prove_end(Terms(homotopy), centre, np.full(2, 1e-30)) is None
    assert prove_end(Terms(homotopy), centre, np.full(2, 1e-15)) is not None


def test_evidence_grows_with_the_digits_of_the_coefficients() -> None:
    (x,) = Polynomial.variables(1)
    few, _ = homotopy_of([x**2 - 2])
    many, _ = homotopy_of([x**2 - Fraction(123456789012347, 10**14)])
    assert set(digits_of_evidence(few, 0)) == {14}
    assert digits_of_evidence(many, 0)[:4] == (23, 23, 32, 41)
    assert set(digits_of_evidence(few, 60)) == {58}


@pytest.mark.parametrize("k", [30, 60, 90])
def test_forms_that_are_small_but_have_no_zero_do_not_vanish(k: int) -> None:
    x, y = Polynomial.variables(2)
    far = [x**2 - y**2 + x - 1, x - y - y * Fraction(1, 10**k) + 2]
    point = [flint.acb(1)] * 3
    for equations, infinite in ((far, False), ([far[0], x - y + 2], True)):
        homotopy, _ = homotopy_of(equations)
        # Along x : y = 1 : 1, where only the homogenising coordinate is smaller.
        forms = InitialForms(Terms(homotopy), FINE)
        assert forms.residual((1, 0, 0), 1, point) < 10.0 ** (1 - k)
        assert forms.vanish((1, 0, 0), 1, point, 1e-20) is infinite


def test_what_was_asked_for_in_few_bits_is_right_in_many() -> None:
    x, y = Polynomial.variables(2)
    homotopy, _ = homotopy_of([(x**2 - y**2) / 3 + x - 1, x - y - y * Fraction(1, 10**60) + 2])
    terms, point = Terms(homotopy), [flint.acb(1)] * 3
    assert InitialForms(terms, 64).residual((1, 0, 0), 1, point) < 1e-15
    assert not InitialForms(terms, FINE).vanish((1, 0, 0), 1, point, 1e-20)


def test_where_coordinates_vanish_in_all_terms_nothing_is_left_to_vanish() -> None:
    x, y = Polynomial.variables(2)
    homotopy = Homotopy(compile_rows([x * y - x, x**2 + x * y]), np.zeros((0, 3)))
    forms = InitialForms(Terms(homotopy), FINE)
    point = [flint.acb(1), flint.acb(0), flint.acb(2)]
    assert forms.vanish((0, NEVER, 0), 1, point, 1e-20)


def test_a_multiple_zero_of_forms_is_told_from_a_constant() -> None:
    x, y = Polynomial.variables(2)
    for gap, infinite in ((Fraction(0), True), (Fraction(1, 10**30), False)):
        # Both touch the line at infinity there, or the second only all but touches it.
        equations = [(x - y) ** 2 + x - 1, (x - y) ** 2 + (x - y) * y * 2 + gap * y**2 + y]
        homotopy, _ = homotopy_of(equations)
        point = [flint.acb(1), flint.acb(1), flint.acb(1 + 1e-12)]
        assert InitialForms(Terms(homotopy), FINE).vanish((1, 0, 0), 1, point, 1e-11) is infinite


def test_orders_that_are_no_rational_numbers_give_no_limit() -> None:
    (x,) = Polynomial.variables(1)
    homotopy, _ = homotopy_of([x**2 - 2])
    limits = Limits(Terms(homotopy), 2, 14)
    point, found = np.zeros((2, 2, 2)), np.zeros((2, 4, 2, 2))
    point[:, 0, 0] = 1.0
    found[1, 0, 0, 0] = np.sqrt(2) / 3
    assert limits.of(point, found, np.ones(2, dtype=bool), np.array([1e-3, 0.0]), 1) is None


@pytest.mark.parametrize(
    "equations",
    [
        ["x^2 - 2*y^2 + x - 1", "x - sqrt(2)*y - 1"],
        ["3*x^2 - y^2 + y - 7", "sqrt(3)*x*y - y^2 + x"],
    ],
)
def test_irrational_coefficients_have_zeros_at_infinity(equations: list[str]) -> None:
    found = nag.solve(equations, start="total")
    assert found.complete
    assert found.paths.at_infinity == 1


@pytest.mark.parametrize("digits", [None, 40, 100])
def test_a_zero_is_at_infinity_only_if_the_exact_equations_put_it_there(digits: int | None) -> None:
    # x = y - 1 and e y^2 = 2 y: the second zero has size 2 / e.
    e = Fraction(1, 10**digits) if digits else Fraction(0)
    x, y = Polynomial.variables(2)
    homotopy, _ = homotopy_of([x**2 - (1 - e) * y**2 - 1, x - y + 1])
    centre = np.zeros((3, 2, 2))
    centre[1:, 0, 0] = 1.0
    assert at_infinity(Terms(homotopy), centre, [0]) == (digits is None)


def test_solutions_of_size_1e80_are_found() -> None:
    found = nag.solve(
        [
            "10^-80*u^2 + u*v + 2*x - 1",
            "3*10^-80*v^2 + v*x - u + 2",
            "10^-80*x^2 - x*u + 5*v + 2",
        ]
    )
    assert len(found.solutions) == 8
    assert found.complete
    assert np.abs(found.points).max() > 1e79


def test_a_zero_beside_a_multiple_one_at_infinity_is_not_taken_for_a_branch_of_it() -> None:
    # From 1e-4 away seven branches lead to the point at infinity; from 1e-17 away six do, and the
    # seventh to a zero of size 1e40.
    system = far_system(7, 15647).system
    answer = nag.solve(system, settings=Settings(digits=64))
    assert len(answer.points) == 14 or not answer.complete


def test_a_box_smaller_than_doubles_can_be_proves_nothing() -> None:
    (x,) = Polynomial.variables(1)
    homotopy, _ = homotopy_of([x**2 - 2 * x])
    centre = np.zeros((2, 2, 2))
    centre[0, 0, 0], centre[1, 0, 0] = 1.0, 1e-305
    assert prove_end(Terms(homotopy), centre, np.zeros(2)) is None


def test_a_step_in_more_digits_between_two_close_branch_points_leads_to_no_other_path() -> None:
    # The paths are x = +-sqrt((t - m)^2 + gap^2): a prediction from far away sees them cross at m.
    x, y = Polynomial.variables(2)
    gap = Fraction(1, 5000)
    for m in (Fraction(k, 100) for k in range(11, 95, 24)):
        rows = compile_rows([x**2 - (y - m) ** 2 - gap**2])
        homotopy = Homotopy(rows, np.array([[0, 0, 1]]), np.array([[-1.0, 0, 0]]))
        far, near = (float((t - m) ** 2 + gap**2) ** 0.5 for t in (1, 0))
        starts = homotopy.normalized(np.array([[1, far, 1], [1, -far, 1]]))
        no = np.zeros(2, dtype=bool)
        paths = follow(homotopy, Unfinished(starts, no, no, starts, np.ones(2), starts), Settings())
        assert (paths.status == PathStatus.REGULAR).all()
        ends = paths.points[:, 1] / paths.points[:, 0]
        assert np.abs(ends - [near, -near]).max() < 1e-12
