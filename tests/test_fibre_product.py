"""Degree and genus of curves that are joined in single variables, without a path."""

from __future__ import annotations

import random
from fractions import Fraction
from itertools import product

import numpy as np
import pytest

import nag
from nag.bench.chains import four_bars, parallelograms
from nag.decomposition import genus
from nag.decomposition.fibre_product import FibreProduct, find_fibre_product


def general_equation(rng: random.Random, x: str, y: str, degrees: tuple[int, int]) -> str:
    """All monomials of some degrees in two variables, zero where all variables are one."""
    terms = [f"{x}^{i}*{y}^{j}" for i, j in product(*(range(d + 1) for d in degrees))]
    coefficients = [rng.randint(1, 40) * rng.choice((1, -1)) for _ in terms]
    return " + ".join(
        f"({c})*({t} - 1)" for c, t in zip(coefficients, terms, strict=True) if t != f"{x}^0*{y}^0"
    )


def found(equations: list[str], variables: str) -> FibreProduct | None:
    system = nag.system(equations, variables)
    return find_fibre_product(system, [Fraction(1)] * system.n, np.random.default_rng(0))


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(
    "edges",
    [
        (("x", "y", (2, 2)), ("y", "z", (2, 1))),
        (("x", "y", (1, 3)), ("y", "z", (1, 1)), ("y", "w", (2, 1))),
        (("x", "y", (2, 1)), ("z", "y", (2, 1)), ("z", "w", (1, 1))),
    ],
)
def test_degree_and_genus_are_those_of_the_decomposition(edges, seed: int) -> None:
    rng = random.Random(seed)
    equations = [general_equation(rng, *edge) for edge in edges]
    names = "x y z w"[: 2 * len(edges) + 1]
    known = found(equations, names)
    answer = nag.decompose(equations, names, seed=seed)
    assert known is not None and answer.complete
    (curve,) = answer.components
    assert (curve.dimension, curve.degree) == (1, known.degree)
    assert genus(answer.system, curve).genus == known.genus


def test_curves_with_common_branch_points_are_left_to_others() -> None:
    first = "x^2*y^2 + x^2 + 3*y^2 - x*y - 4"
    again = first.replace("x", "z")
    assert found([first, "2*y^2*z^2 - 2*y^2 + y*z + z^2 - 2"], "x y z") is not None
    # The same curve twice: its diagonal, and the rest.
    assert found([first, again], "x y z") is None
    assert len(nag.decompose([first, again], "x y z").components) == 2
    # Two curves whose branch points a third one leads to each other.
    moved = again.replace("y", "w")
    assert found([first, "y*w - 2*y - 2*w + 3", moved], "x y z w") is not None
    assert found([first, "y - w", moved], "x y z w") is None


def test_singular_curves_circles_and_constants_are_left_to_others() -> None:
    assert found(["y^2 - x^3 - x^2 + 1", "y*z - 1"], "x y z") is None  # regular but at infinity
    assert found(["(x - y)*(x + y - 2)", "y*z - 1"], "x y z") is None  # two factors at the point
    assert found(["x*y - 1", "y*z - 1", "x*z - 1"], "x y z") is None
    assert found(["x*y*z - 1", "y*z - 1"], "x y z") is None
    assert found(["x - 1", "y*z - 1"], "x y z") is None


def test_only_the_factor_at_the_point_counts() -> None:
    known = found(["(2*x*y + x - 3)*(x + 5)", "(y*z - 3*z + 2*y)*(y + z)"], "x y z")
    assert known == FibreProduct(factors=2, sheets=(1, 1, 1), degree=3, genus=0)


def test_variables_that_are_infinite_at_once_leave_the_degree_open() -> None:
    known = found(["x + 2*y - 3", "x*z + z - 2*x"], "x y z")
    assert known == FibreProduct(factors=2, sheets=(1, 1, 1), degree=None, genus=0)


@pytest.mark.parametrize("n", [2, 3])
def test_rows_of_four_bars_are_as_decomposed(n: int) -> None:
    problem = nag.model(four_bars(n), formulation="H")
    known = find_fibre_product(problem.system, problem.reference, np.random.default_rng(1))
    (curve,) = nag.decompose(problem.system).components
    assert known is not None and curve.degree == known.degree == (n + 1) * 2**n


def test_a_row_of_twelve_four_bars_has_its_degree_and_genus_at_once() -> None:
    report = nag.mobility(four_bars(12))
    assert report.components == ((1, 13 * 2**12),) and report.formulation == "formulation H"
    # Riemann and Hurwitz: each cell doubles the sheets, with four branch points in every sheet.
    euler = -2
    for n in range(12):
        euler = 2 * euler + 4 * 2**n
    assert [curve.genus for curve in report.curves] == [euler // 2 + 1]


def test_longer_rows_of_four_bars_keep_to_the_law_of_shorter_ones() -> None:
    # Places that are led along half of the row are 4, doubled by each cell.
    for n in (4, 8, 16):
        problem = nag.model(four_bars(n), formulation="H")
        known = find_fibre_product(problem.system, problem.reference, np.random.default_rng(n))
        assert (known.degree, known.genus) == ((n + 1) * 2**n, (n - 1) * 2**n + 1)


def test_parallelograms_stay_rational() -> None:
    report = nag.mobility(parallelograms(12))
    assert report.components == ((1, 13),) and report.curves[0].genus == 0
