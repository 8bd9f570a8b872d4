"""Systems that fall apart exactly: solved and decomposed by branches, joined without repeats."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from systems import system

from nag.algebra.polynomial import Polynomial
from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem
from nag.decomposition import components_through, intersect_components, sample
from nag.decomposition.decompose import decompose
from nag.files.export import read_decomposition, write_decomposition
from nag.files.solutions_export import read_solutions, write_solutions
from nag.solving.solutions import SolveResult
from nag.solving.solve import solve
from nag.witness.frame import expand_orbits
from nag.witness.witness import Decomposition, Status


def product_of(*factors: Polynomial) -> Polynomial:
    result = Polynomial.constant(factors[0].n, 1)
    for f in factors:
        result = result * f
    return result


def kinds(answer: Decomposition) -> Counter[tuple[int, int, int]]:
    assert answer.complete
    assert all(c.status is Status.IRREDUCIBLE for c in answer.components)
    return Counter((c.dimension, c.degree, c.multiplicity) for c in answer.components)


def multiplicities(result: SolveResult) -> Counter[int]:
    assert result.complete
    return Counter(s.multiplicity for s in result.solutions)


FAT = system("x y", "(x - 1)*x^2", "(x - 1)*y^3")
CASES = [
    (system("x y", "(x^2 + y^2 - 1)^12"), {(1, 2, 12): 1}),
    (system("x", "x^13"), {(0, 1, 13): 1}),
    (system("x", "x^60 - 1"), {(0, 1, 1): 60}),
    (system("x y z", "x*y", "x*z"), {(2, 1, 1): 1, (1, 1, 1): 1}),
    (FAT, {(1, 1, 1): 1, (0, 1, 6): 1}),
    (
        system("x y", "(x-1)*(x^2-y^3)", "(x-1)*(y^2-x^3)"),
        {(1, 1, 1): 1, (0, 1, 4): 1, (0, 1, 1): 4},
    ),
    (system("x y", "x*(x - 1)", "(x - 2)*(x - 3)"), {}),
    (system("x y", "x^2*y", "x*y^2"), {(1, 1, 1): 2}),
    (system("x y", "x^2*(x + y^2 + y)", "y*(x - y)"), {(0, 1, 6): 1, (0, 1, 1): 1}),
    (system("x y z", "x*y", "y*z", "x*z*(x - 1)"), {(1, 1, 1): 4}),
    (system("x y z", "x^2*(z - 1)^3", "x*y*(z - 1)^2"), {(2, 1, 2): 1, (2, 1, 1): 1}),
    (system("x y", "sqrt(2)*x*y", "x*(y - 1)"), {(1, 1, 1): 1}),
    (system("x y", "(y - x)*(y + x)", "x - sqrt(2)"), {(0, 1, 1): 2}),
    (system("x y", "(y - x)*(y + x)^2", "(x - sqrt(3)/2)*(y - 1)"), {(0, 1, 1): 2, (0, 1, 2): 2}),
    (system("x y", "(x - 1)*y", "(x - 1)*(x - cos(pi/5))"), {(1, 1, 1): 1, (0, 1, 1): 1}),
    (system("x y", "x*(x - 1)", "y - sqrt(2)*x", "y - sqrt(3)*x"), {(0, 1, 1): 1}),
    (system("x y z", "(x - y)*z", "(x - y)*(z - 1)", "z*(y - sqrt(6))"), {(1, 1, 1): 2}),
    (system("x y", "-2*x*y^3 - 2*x^2 + 3*y - 1/500", "-2*y - 3*y^4/100000"), {(0, 1, 1): 8}),
]


@pytest.mark.parametrize(("of", "expected"), CASES, ids=lambda v: str(v)[:60])
def test_components_are_those_that_are_known(of, expected) -> None:
    assert kinds(decompose(of)) == expected


@pytest.mark.parametrize(("of", "expected"), CASES, ids=lambda v: str(v)[:60])
def test_isolated_solutions_are_the_components_of_dimension_zero(of, expected) -> None:
    result = solve(of)
    points = {kind[2]: count for kind, count in expected.items() if kind[0] == 0}
    assert multiplicities(result) == points
    assert result.positive_dimensional == any(kind[0] > 0 for kind in expected)
    assert all(s.residual < 1e-14 for s in result.solutions)


COEFFICIENTS = {
    "rational": ["0", "1", "-1", "2", "1/2", "-3/2"],
    "square roots": ["0", "1", "-1", "sqrt(2)", "sqrt(3)/2", "-sqrt(2)", "sqrt(6)"],
    "algebraic": ["0", "1", "-1/2", "cos(pi/5)", "cos(2*pi/7)", "sqrt(1 + sqrt(2))"],
}


def random_factored_system(rng: np.random.Generator, numbers: list[str]) -> PolynomialSystem:
    """Products of linear polynomials, each of which vanishes at one of some points.

    Some equations are rational, so that they fall apart, and others need not be.
    """
    n = int(rng.integers(2, 4))
    variables = "xyz"[:n]
    rational = COEFFICIENTS["rational"]
    places = {False: rng.choice(rational, (2, n)), True: rng.choice(numbers, (3, n))}

    def factor(numbers: list[str], points: np.ndarray) -> str:
        point = rng.choice(points)
        only = int(rng.integers(n)) if rng.random() < 0.4 else None
        slopes = ["1" if i == only else "0" for i in range(n)]
        if only is None:
            slopes = list(rng.choice(numbers, n))
        if set(slopes) == {"0"}:
            slopes[0] = "1"
        terms = zip(slopes, variables, point, strict=True)
        return "(" + " + ".join(f"({a})*({v} - ({c}))" for a, v, c in terms) + ")"

    equations = []
    for _ in range(n + int(rng.random() < 0.25)):
        given = bool(rng.random() < 0.5)
        pool = numbers if given else rational
        factors = (factor(pool, places[given]) for _ in range(rng.integers(1, 4)))
        equations.append("*".join(factors))
    return system(" ".join(variables), *equations)


@pytest.mark.parametrize("numbers", COEFFICIENTS.values(), ids=COEFFICIENTS)
def test_solve_and_decompose_find_the_same_points_of_random_products(numbers: list[str]) -> None:
    rng = np.random.default_rng(7)
    for _ in range(8):
        of = random_factored_system(rng, numbers)
        result, answer = solve(of), decompose(of)
        assert result.complete and answer.complete
        points = [(p, c) for c in answer.components if not c.dimension for p in c.points]
        assert len(result.solutions) == len(points)
        for each in result.solutions:
            near = [c for p, c in points if np.allclose(p, each.point, rtol=1e-9, atol=1e-9)]
            assert [c.multiplicity for c in near] == [each.multiplicity]


def test_sixteen_planes_are_sixteen_components() -> None:
    x, y, z = Polynomial.variables(3)
    of = PolynomialSystem(
        tuple("xyz"), (product_of(*(x + y * k - z * 3 + k * k for k in range(16))),)
    )
    assert kinds(decompose(of)) == {(2, 1, 1): 16}


def test_wilkinsons_roots_are_found_with_their_powers() -> None:
    (x,) = Polynomial.variables(1)
    of = PolynomialSystem(
        tuple("x"), (product_of(*((x - k) ** (1 + k % 3) for k in range(1, 31))),)
    )
    found = {round(s.point[0].real): s.multiplicity for s in solve(of).solutions}
    assert found == {k: 1 + k % 3 for k in range(1, 31)}
    assert kinds(decompose(of)) == {(0, 1, m): 10 for m in (1, 2, 3)}


def test_roots_that_doubles_cannot_tell_apart_are_separate_solutions() -> None:
    result = solve(system("x y", "(x - 1)*(x - 1 - 1/10^25)", "y^2 - x"))
    assert multiplicities(result) == {1: 4}
    assert len(np.unique(result.points, axis=0)) == 2


@pytest.mark.parametrize("power", [2, 50, 200])
def test_powers_multiply_to_the_multiplicity(power: int) -> None:
    x, y = Polynomial.variables(2)
    of = PolynomialSystem(tuple("xy"), ((x - 1) ** power, (y - x * x) ** 200))
    assert multiplicities(solve(of)) == {200 * power: 1}


def test_powers_multiply_where_gradients_depend_on_each_other() -> None:
    of = system("x y", "(x^2 - y^3)^3*(x + y)", "(y^2 - x^3)^4")
    origin = 4 * 3 * 4 + 2 * 4
    assert multiplicities(solve(of)) == {origin: 1, 12: 5, 4: 1}
    assert kinds(decompose(of)) == {(0, 1, origin): 1, (0, 1, 12): 5, (0, 1, 4): 1}


def test_a_power_of_a_sphere_has_the_powers_multiplicity() -> None:
    x, y, z = Polynomial.variables(3)
    of = PolynomialSystem(tuple("xyz"), ((x * x + y * y + z * z - 1) ** 9 * (x - y) ** 20,))
    assert kinds(decompose(of)) == {(2, 2, 9): 1, (2, 1, 20): 1}


def test_a_solution_on_a_curve_of_another_branch_is_not_isolated() -> None:
    of = system("x y", "x*(x - 1)*(x + y)", "x*(x - 1)*(x - y)")
    assert solve(of).solutions == ()
    of = system(
        "x y z", "(z - 1)*(x^2 + y^2 - z^2)*z", "x*(x^2 + y^2 - z^2)", "y*(x^2 + y^2 - z^2)"
    )
    result = solve(of)
    assert np.allclose(result.points, [[0, 0, 1]]) and result.complete
    assert kinds(decompose(of)) == {(2, 2, 1): 1, (0, 1, 1): 1}


def test_solutions_where_something_must_not_vanish_are_left_out() -> None:
    of = system("x y", "x*(x - 1)*(y - 3)", "y*(y - 2)", nonzero=("x", "x + y - 3"))
    result = solve(of)
    assert np.allclose(result.points, [[1, 0]])
    assert result.excluded == 3
    assert kinds(decompose(of)) == {(0, 1, 1): 1}


@pytest.mark.parametrize("start", ["total", "polyhedral"])
def test_branches_are_followed_with_the_start_system_that_was_named(start: str) -> None:
    of = system("x y", "(x^2 + y^2 - 5)*(x*y - 2)", "x^3 - y^2 + 1")
    result = solve(of, start=start)
    assert result.start == start and result.paths.tracked >= 11
    assert multiplicities(result) == {1: 11}


def test_orbits_join_over_branches() -> None:
    of = system("x y z", "(x^2 + y^2 - 1)*(x^2 - y)*(y^2 - x)", "(x^2 + y^2 - 1)^2*z^2*(z - 1)")
    swap = SignedPermutation.of_map({"x": "y", "y": "x"}, of.variables)
    answer = decompose(of, symmetries=[swap])
    assert kinds(answer) == {(2, 2, 1): 1, (1, 2, 2): 1, (1, 2, 1): 1}
    assert [c.orbit for c in answer.components] == [1, 2, 2]
    plain = kinds(decompose(of))
    assert kinds(expand_orbits(answer)) == plain == {(2, 2, 1): 1, (1, 2, 2): 2, (1, 2, 1): 2}


def test_points_that_a_symmetry_exchanges_are_one_orbit() -> None:
    of = system("x y", "x^2 - 4", "y^3*(y^2 - x^2)")
    turn = SignedPermutation.of_map({"x": "-x", "y": "-y"}, of.variables)
    answer = decompose(of, symmetries=[turn])
    assert sorted((c.orbit, c.multiplicity) for c in answer.components) == [(2, 1), (2, 1), (2, 3)]


def test_the_same_seed_gives_the_same_answer() -> None:
    of = system("x y z", "(x*y - z)*(x^2 + y^2 - 1)^3", "(x*y - z)*(y - z)")
    assert decompose(of, seed=3) == decompose(of, seed=3, threads=2)


def test_exports_read_back_to_the_same(tmp_path: Path) -> None:
    of = system("x y", "(x^2 + y^2 - 1)^12*(x - 1)", "(x^2 + y^2 - 1)^12*(y - 2)^2")
    answer = decompose(of)
    write_decomposition(answer, tmp_path / "components.json")
    assert read_decomposition(tmp_path / "components.json") == answer
    result = solve(of)
    write_solutions(result, tmp_path / "solutions.json")
    again = read_solutions(tmp_path / "solutions.json").result
    assert [s.multiplicity for s in again.solutions] == [2]
    assert np.array_equal(again.points, result.points) and again.reason == result.reason


def test_multiple_components_can_be_gone_on_from() -> None:
    of = system("x y z", "(x^2 + y^2 - 1)^12*(x - y)", "(x^2 + y^2 - 1)^12*(x + z)^3")
    answer = decompose(of)
    assert kinds(answer) == {(2, 2, 12): 1, (1, 1, 3): 1}
    assert components_through(answer, np.array([1, 0, 5])) == [0]
    cylinder, line = answer.components
    assert len(sample(of, cylinder, count=5).points) == 5
    meeting = intersect_components(of, cylinder, line)
    assert sum(c.degree for c in meeting.components) == 2 and meeting.complete
    assert np.abs(np.vstack([c.points for c in meeting.components])[:, 0] ** 2 - 0.5).max() < 1e-12
