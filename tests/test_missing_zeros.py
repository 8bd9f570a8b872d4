"""Zeros that paths do not reach: counted, found in digits or by sizes, never taken for infinite."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from fractions import Fraction
from math import log10

import numpy as np
import pytest
from random_small import far_system
from systems import system

import nag
from nag.algebra.evaluation import Evaluator
from nag.algebra.imaginary_unit import as_real
from nag.algebra.polynomial import Polynomial
from nag.decomposition.decompose import decompose
from nag.decomposition.isolated import count_points
from nag.decomposition.method import Task
from nag.numerics.coincidence import conjugates_present
from nag.numerics.system_facts import SystemFacts
from nag.solving.solutions import SolveResult
from nag.solving.solve import solve
from nag.solving.tropical_zeros import tropical_zeros
from nag.witness.cutting import sharpen

# One zero has sizes 10^140.70725, 10^107.55269 and 10^126.77312 (roots of its eliminants).
FAR = (
    "-58000*x*y + 19/10000*y^2 - 6*y*z + 3/10*z^2",
    "-9/10000*x^2*y + 400000*z^3 - 3/5000*x^2 + 1/5000*x + 2000",
    "-7/10000*y^5 - 4/9*x^2*z^2 - 62500*x*z",
)


def multiplicities(result: SolveResult) -> Counter[int]:
    assert result.complete, result.notes
    return Counter(s.multiplicity for s in result.solutions)


@pytest.mark.parametrize("start", ["auto", "total", "multihomogeneous", "polyhedral", "monodromy"])
def test_zeros_beside_infinity_are_found_from_every_start(start: str) -> None:
    equations = ["x^2+y^2-1", "u^2+v^2-4"]
    equations += ["100000000000000003*x+7*u-3", "100000000000000003*y+7*v-1"]
    result = solve(system("u v x y", *equations), start=start)
    assert multiplicities(result) == {1: 2}
    for s in result.solutions:
        assert abs(s.point[0]) == pytest.approx(2.258769757e32, rel=1e-9)


@pytest.mark.parametrize("seed", [0, 1])
def test_a_zero_at_1e126_is_no_end_at_infinity(seed: int) -> None:
    result = solve(system("x y z", *FAR), seed=seed)
    assert multiplicities(result) == {1: 26}
    far = max(result.solutions, key=lambda s: abs(s.point[0]))
    sizes = [log10(abs(c)) for c in far.point]
    assert sizes == pytest.approx([140.70725, 107.55269, 126.77312], abs=1e-5)
    assert far.real and far.residual < 1e-14


def test_points_are_decomposed_as_they_are_solved() -> None:
    answer = nag.decompose(system("x y z", *FAR))
    assert answer.complete and len(answer.components) == 26


def test_tropical_zeros_are_zeros_of_the_equations_and_none_of_the_known_ones() -> None:
    # x y = 10^60 and x = 10^90 + y: one zero near (10^90, 10^-30), one near (-10^-30, -10^90).
    equations = nag.system(["x*y - 10^60", "x - y - 10^90"]).polynomials
    rng = np.random.default_rng(0)
    found = tropical_zeros(equations, np.zeros((0, 2)), np.zeros(0), rng)
    points = sorted((z.point for z in found), key=lambda x: -abs(x[0]))
    assert points[0] == pytest.approx([1e90, 1e-30], rel=1e-14)
    assert points[1] == pytest.approx([-1e-30, -1e90], rel=1e-14)
    known = np.array([[1e90, 1e-30]])
    (other,) = tropical_zeros(equations, known, np.array([1e74]), rng)
    assert other.point == pytest.approx([-1e-30, -1e90], rel=1e-14)


def test_a_double_zero_with_simple_ones_beside_it_needs_no_more_paths() -> None:
    equations = [
        "-200000/3*x*y - 3/50*x + 1/12500*z",
        "-3/50*y*z^2 + 500*x*z - 50000*y^2 + 8/125*y*z + 300*z^2 - 8000/3",
        "-575*x*y*z^3 - 280000*x^3*y + 1/2000*x^2*y^2 - 5700*y*z^3 + 28/5*z^4",
    ]
    assert multiplicities(solve(system("x y z", *equations))) == {1: 12, 2: 2}


def test_zeros_of_one_branch_have_the_multiplicity_that_they_have_there() -> None:
    equations = [
        "1/1000*y^4 + 600000*y^3*z + 200*y^3 - 1/10000*x*y",
        "-9/100000*x^2*z - 3/1000*y^2*z - 53/10*y^2 - 20000",
        "-9/1000*x^3 + 1/8*z^3 + 3/5000*x*z + 8000*z^2",
    ]
    assert multiplicities(solve(system("x y z", *equations))) == {1: 36}
    assert nag.decompose(system("x y z", *equations)).complete


def test_a_path_all_of_whose_coordinates_are_unknown_has_no_limit() -> None:
    equations = [
        "9/10*x^2*y - 41000*x*y*w - 1/100000*x*z*w - 1/8750*y*z*w + 3300*x*y - 3/50",
        "61/1000*x^2 - 1/5000*x*y - 53/100000*x*w + 1/20000*z^2 - 3800*z*w - 9250*y",
        "7000*x^3*y - 7/100000*y^2*z*w + 57/8000*z^3*w + 2/25",
        "-50000*x*z - 9/10*y^2 + 1/4000*z^2 - 1800*y",
    ]
    assert multiplicities(solve(system("x y z w", *equations))) == {1: 30}


def test_an_answer_that_lacks_a_point_is_not_complete() -> None:
    whole = nag.decompose(system("x y", "x^2 + y^2 - 5", "x*y + x - 3"))
    task = Task(SystemFacts(whole.system), (), nag.Run())
    assert whole.complete and count_points(whole, task).complete
    fewer = replace(whole, components=whole.components[1:])
    lacking = count_points(fewer, task)
    assert not lacking.complete
    assert lacking.notes[-1] == "3 zeros were found, and there are 4"
    doubted = replace(whole, complete=False, notes=("a path failed",))
    assert count_points(doubted, task).complete


def test_zeros_that_are_missing_are_counted_on_the_side_of_the_imaginary_unit() -> None:
    both = as_real(nag.system(["x^3 - I*x + y", "y^2 + x - 2*I"], variables=["x", "y"]))
    whole = nag.decompose(both)
    fewer = replace(whole, components=whole.components[2:])
    one_side = Task(SystemFacts(both), (), nag.Run(), sides=2)
    assert count_points(fewer, one_side).notes[-1] == "5 zeros were found, and there are 6"


def test_residuals_and_jacobians_far_out_are_those_of_scaled_equations() -> None:
    f = Polynomial(2, {(3, 0): Fraction(2), (0, 2): Fraction(-3), (1, 1): Fraction(5)})
    near, far = np.array([3.0 + 1j, 2.0 - 1j]), 1e120
    # Only the cubic term counts far out, in directions where it does not vanish.
    evaluator = Evaluator.of([f], 2)
    assert evaluator.residuals(near[None] * far) == pytest.approx(np.array([[1.0]]), abs=1e-12)
    size = np.abs(near).max()
    expected = [6 / 5 * (near[0] / size) ** 2, 0.0]
    assert evaluator.balanced_jacobian(near * far)[0] == pytest.approx(expected, abs=1e-12)


def test_a_point_beyond_the_powers_of_doubles_is_not_sharpened_but_not_an_error() -> None:
    evaluator = Evaluator.of(nag.system(["x^4 - y", "y^3 - x"]).polynomials, 2)
    far = np.array([1e120 + 0j, 1e130])
    with np.errstate(all="ignore"):
        assert not sharpen(evaluator, np.zeros((0, 3)), far).converged


@pytest.mark.parametrize("seed", [0, 1])
def test_two_multiple_zeros_at_what_seems_one_place_are_both_found(seed: int) -> None:
    # Double zeros with y = 7e-7 i and -7e-7 i beside x = -4e5.
    equations = (
        "-1/100000*y*z - 9*y*w + 99/100000*z*w",
        "30000*x^3*z^2 - 1/1250*x^2*w^3 - 5*x*y^3*z + 1600*x^2*y^2 - 5000*y^4 + 1/5*y*w^2 + 1/125",
        "80000*y*w^2 + 83/200000*x + 80*w + 41",
        "7000*x*z^2 + 2000*w^3",
    )
    assert multiplicities(solve(system("x y z w", *equations), seed=seed)) == {1: 31, 2: 4}


def test_points_close_together_are_conjugates_each_of_one() -> None:
    upper = np.array([[1j, 1.0], [1j, 1.0 + 1e-13], [1j, 1.0 - 1e-13]])
    for order in ([0, 1, 2, 3, 4, 5], [0, 3, 1, 2, 4, 5], [3, 0, 4, 5, 1, 2]):
        points = np.vstack([upper, upper.conj()])[order]
        rest = np.full(6, 1e-15), np.ones(6, dtype=int), np.zeros(6, dtype=bool)
        assert conjugates_present(points, *rest)
        assert not conjugates_present(points[:5], *(r[:5] for r in rest))


def test_a_branch_that_lacks_zeros_leaves_the_whole_incomplete() -> None:
    # Two of the 30 zeros lie at 1e25 in all coordinates: paths to them seem to lead to infinity.
    of = far_system(7, 6573).system
    answer = decompose(of)
    found = sum(c.degree * (c.multiplicity or 1) for c in answer.components)
    assert found == 30 or not answer.complete
    assert found == 30 or "zeros were found" in " ".join(answer.notes)
