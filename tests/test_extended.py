"""The tracker in double-double arithmetic: exact operations, and the ends that doubles find."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from nag.algebra.polynomial import Polynomial
from nag.tracking.compiled import compile_rows
from nag.tracking.double_double import add, multiply
from nag.tracking.extended import track_extended
from nag.tracking.homotopy import Homotopy, straight_line

NUMBERS = st.floats(-1e6, 1e6, allow_subnormal=False).filter(lambda x: x == 0 or abs(x) > 1e-6)


def exact(pair: tuple[float, float]) -> Fraction:
    return Fraction(pair[0]) + Fraction(pair[1])


@settings(deadline=None)
@given(NUMBERS, NUMBERS)
def test_sums_and_products_of_doubles_are_exact(a: float, b: float) -> None:
    assert exact(add(a, 0.0, b, 0.0)) == Fraction(a) + Fraction(b)
    assert exact(multiply(a, 0.0, b, 0.0)) == Fraction(a) * Fraction(b)


@settings(deadline=None)
@given(NUMBERS, NUMBERS, NUMBERS)
def test_products_of_double_doubles_have_thirty_digits(a: float, b: float, c: float) -> None:
    first = multiply(a, 0.0, b, 0.0)
    found = exact(multiply(*first, c, 0.0))
    true = Fraction(a) * Fraction(b) * Fraction(c)
    assert abs(found - true) <= abs(true) * Fraction(1, 10**30)


def track_from_total_degree(equations: list[Polynomial], degree: int) -> tuple[Homotopy, tuple]:
    n = len(equations)
    xs = Polynomial.variables(n)
    target = compile_rows(equations)
    homotopy = straight_line(compile_rows([x**degree - 1 for x in xs]), target, 0.6 + 0.8j)
    roots = np.exp(2j * np.pi * np.arange(degree) / degree)
    grids = np.meshgrid(*[roots] * n, indexing="ij")
    starts = np.stack([np.ones(degree**n), *(g.ravel() for g in grids)], axis=1)
    starts = homotopy.normalized(starts)
    options = {"radius": 0.1, "samples": 8, "max_winding": 8, "levels": 12}
    return homotopy, track_extended(homotopy, starts, threads=2, end_exponent=1, **options)


def test_simple_zeros_are_found_to_rounding() -> None:
    x, y = Polynomial.variables(2)
    _, (points, outcome, winding, *_) = track_from_total_degree(
        [x**2 + y**2 - 5, x * y + y**2 - 6], 2
    )
    assert (outcome > 0).all()
    found = sorted((points[:, 1] / points[:, 0]).real.tolist())
    assert winding.tolist() == [1, 1, 1, 1]
    # x = 1, y = 2 and its negative; the others have y^2 = 9/2, x = y / 3.
    true = sorted([1, -1, np.sqrt(0.5), -np.sqrt(0.5)])
    assert np.allclose(found, true, rtol=0, atol=1e-13)


def test_a_fourfold_zero_and_its_winding_numbers() -> None:
    x, y = Polynomial.variables(2)
    _, (points, outcome, winding, error, *_) = track_from_total_degree([x**2, y**2 - x], 2)
    assert (outcome > 0).all()
    assert winding.tolist() == [4, 4, 4, 4]
    assert np.abs(points[:, 1:] / points[:, :1]).max() < 1e-10
    assert error.max() < 1e-10
