"""Taylor coefficients in the logarithm of t are those of the same path."""

from __future__ import annotations

from math import comb, factorial

import numpy as np
import pytest

from nag.algebra.expression import parse_polynomial
from nag.tracking.compiled import compile_rows
from nag.tracking.homotopy import straight_line
from nag.tracking.logarithm import composition
from nag.tracking.settings import Settings
from nag.tracking.track import track


@pytest.mark.parametrize("order", [1, 4, 7])
def test_powers_of_the_exponential(order: int) -> None:
    table = composition(order)
    # (exp(h) - 1)^m = sum_j (-1)^(m - j) binomial(m, j) exp(j h)
    for m in range(1, order + 1):
        for k in range(1, order + 1):
            whole = sum((-1) ** (m - j) * comb(m, j) * j**k for j in range(m + 1))
            assert table[m - 1, k - 1] == pytest.approx(whole / factorial(k), abs=1e-15)


@pytest.mark.parametrize("winding", [2, 3, 5, 8, 13])
def test_steps_round_a_cycle_do_not_shorten_with_t(winding: int) -> None:
    """Eight samples a turn, one step or two to each, for x^w = t (1 + x) and two radii at most."""
    names = ["x"]
    start = compile_rows([parse_polynomial(f"x^{winding} - 1 - x", names)])
    target = compile_rows([parse_polynomial(f"x^{winding}", names)])
    homotopy = straight_line(start, target, 1.0)
    roots = np.roots([1, *[0] * (winding - 2), -1, -1])
    starts = np.stack([np.ones(winding), roots], axis=1)
    paths = track(homotopy, starts, Settings(retries=0))
    assert (paths.winding == winding).all()
    assert np.abs(paths.points[:, 1] / paths.points[:, 0]).max() < 1e-10
    assert paths.steps.max() < 60 + 3 * 8 * winding
