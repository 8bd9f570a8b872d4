"""Multiplicity of a zero on a slice."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

import nag
from nag.algebra.branch_equations import BranchEquations
from nag.algebra.expression import parse_polynomial
from nag.algebra.factoring import factor_into_irreducibles
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.decomposition.decompose import decompose
from nag.files.cases import read_case
from nag.numerics.double_ranks import Gradients
from nag.numerics.natural_coordinates import shift_polynomial
from nag.witness.multiplicity import multiplicity
from nag.witness.slices import rows_through

CASES = Path(__file__).parents[1] / "cases"


@pytest.mark.parametrize("size", [1, 8, 64])
@pytest.mark.parametrize(
    ("names", "equation", "point", "d", "expected"),
    [
        ("x y", "(y^2 - x^3)^3*y^2", lambda t: (t**2, t**3), 1, 3),
        ("x y", "(y^2 - x^3)^3*y^2", lambda t: (t, 0), 1, 2),
        ("x y z", "(x^2 - y^2*z)^2*x^2", lambda t: (t * (1 + t), t, (1 + t) ** 2), 2, 2),
        ("x y z", "x^2*(y - z^3)", lambda t: (1, t**3, t), 2, 1),
    ],
)
def test_it_does_not_depend_on_how_far_out_the_point_lies(
    names: str, equation: str, point, d: int, expected: int, size: int
) -> None:
    variables = tuple(names.split())
    polynomials = [parse_polynomial(equation, variables)]
    for seed in range(4):
        rng = np.random.default_rng(seed)
        t = size * np.exp(2j * np.pi * rng.random())
        x = np.array(point(t), dtype=complex)
        assert multiplicity(polynomials, rows_through(rng, d, x), x, rng) == expected


def test_a_branch_by_a_linear_factor_has_the_local_ring_of_all_equations() -> None:
    x, y = Polynomial.variables(2)
    circle, line, other = x * x + y * y - 6, x - y, x + 5

    def own(first: Polynomial, branch: tuple[Polynomial, ...]) -> bool:
        equations = [factor_into_irreducibles(first), factor_into_irreducibles(circle)]
        system = PolynomialSystem(("x", "y"), branch)
        return BranchEquations(system, True).is_own_ring(equations, lambda p: p != other)

    assert own(line * other, (line, y * y - 3))
    assert own(line * other, (line, circle))
    assert not own(line * other, (line, y * y - 5))
    assert not own(line * line * other, (line, y * y - 3))


def test_gradients_whose_difference_is_an_error_of_the_point_are_not_independent() -> None:
    x, y = Polynomial.variables(2)
    # At (1, 0) both gradients are (1, 1); the point is known to 1e-4.
    gradients = Gradients.of([x * x + y * 2, x + x * y], 2)
    near = np.array([[1 + 8e-5, 0.0], [1 + 8e-5, 0.0]])
    assert gradients.ranks(near, np.array([[1e-4], [1e-12]])).tolist() == [1, 2]


@pytest.mark.parametrize("seed", range(2))
def test_double_components_far_from_the_origin_are_double(seed: int) -> None:
    plain = read_case(CASES / "planar" / "wunderlich-12-bar.toml").system
    origin = [Fraction(10**6 * (7 + i), 9) for i in range(plain.n)]
    moved = tuple(shift_polynomial(f, origin) for f in plain.polynomials)
    answers = [
        decompose(replace(plain, polynomials=p, nonzero=()), seed=seed)
        for p in (plain.polynomials, moved)
    ]
    here, there = (
        sorted((c.dimension, c.degree, c.multiplicity) for c in answer.components)
        for answer in answers
    )
    assert here == there and sum(m == 2 for _, _, m in here) == 10


@pytest.mark.parametrize("seed", range(3))
def test_a_multiple_zero_near_simple_ones_is_not_taken_for_simple(seed: int) -> None:
    equations = [
        "-49/2*x*y + 140*x*z - 3/100*z*w + 9/100*y",
        "1860*x^2*w - 1/20*z^3",
        "-200*x^2 + 1/100*x*z - 53/60*x*w + 3/10*y*z + 800*y + z",
        "-47/100*y*z*w^3 + 10*y*w^4 - 46*z^4",
    ]
    answer = nag.decompose(equations, "x y z w", seed=seed)
    found = sorted((c.dimension, c.degree, c.multiplicity) for c in answer.components)
    assert found == [(0, 1, 1)] * 22 + [(0, 1, 4), (1, 1, 1)]
    # By w = z^3/(37200 x^2) the last equation begins with z^4 there.
    (multiple,) = (c for c in answer.components if c.multiplicity == 4)
    assert np.allclose(multiple.points[0], [9 / 2450, (9 / 2450) ** 2 / 4, 0, 0], atol=1e-15)


@pytest.mark.parametrize("seed", range(3))
def test_a_multiple_zero_known_to_hundreds_of_digits_is_made_regular_by_deflation(
    seed: int,
) -> None:
    equations = [
        "-1375*x*y + 350*x*(z + 5) + 1/20*(z + 5)*w - 20*y",
        "3/5*x^2*w + 6000*(z + 5)^3",
        "-1/13750*x^2 - 3000/7*x*(z + 5) + 1/25000*x*w - 105/4*y*(z + 5) - 7/850*y"
        " + 1700000/3*(z + 5)",
        "-7/40000*y*(z + 5)*w^3 + 31/8*y*w^3 - 680/3*(z + 5)^3",
    ]
    answer = nag.decompose(equations, "x y z w", seed=seed)
    # By w = -10000 (z + 5)^3 / x^2 the last equation begins with (z + 5)^3 there.
    (multiple,) = (c for c in answer.components if c.multiplicity == 3)
    assert multiple.status is nag.Status.IRREDUCIBLE and not multiple.note
    x = -4 / 275
    assert np.allclose(multiple.points[0], [x, -17 * x**2 / 1925, -5, 0], atol=1e-15)


def test_zeros_of_branches_that_gradients_show_to_be_simple_need_no_local_ring(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def none(*_: object) -> None:
        raise AssertionError

    monkeypatch.setattr("nag.numerics.branch_union.generic_multiplicity", none)
    monkeypatch.setattr(BranchEquations, "is_own_ring", none)
    answer = nag.solve(["x*(x + 2*y - 3)", "y*(3*x - y + 5)"])
    assert [s.multiplicity for s in answer.solutions] == [1, 1, 1, 1]
