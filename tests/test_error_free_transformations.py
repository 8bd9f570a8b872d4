"""The double-double arithmetic of the kernels against exact fractions."""

from fractions import Fraction

import numba
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nag.algebra.number import square_root
from nag.tracking.lanes import aligned, load, pointer, store
from nag.tracking.precision import add, multiply, split, two_product, two_sum


@numba.njit
def _run(a, b, result):
    """Results of all four operations on eight pairs of double-doubles."""
    pa, pb, pr = pointer(a), pointer(b), pointer(result)
    ah, al, bh, bl = load(pa, 0), load(pa, 1), load(pb, 0), load(pb, 1)
    h, low = two_sum(ah, bh)
    store(pr, 0, h)
    store(pr, 1, low)
    h, low = two_product(ah, bh)
    store(pr, 2, h)
    store(pr, 3, low)
    h, low = add(ah, al, bh, bl)
    store(pr, 4, h)
    store(pr, 5, low)
    h, low = multiply(ah, al, bh, bl)
    store(pr, 6, h)
    store(pr, 7, low)


@pytest.fixture(scope="module")
def arrays():
    return aligned(2), aligned(2), aligned(8)


moderate = st.floats(min_value=-1e100, max_value=1e100).filter(lambda v: v == 0 or abs(v) > 1e-100)
tail = st.floats(min_value=-0.5, max_value=0.5)


@settings(deadline=None)
@given(st.lists(st.tuples(moderate, tail, moderate, tail), min_size=8, max_size=8))
def test_transformations_lose_nothing_and_operations_keep_32_digits(pairs):
    a, b, result = aligned(2), aligned(2), aligned(8)
    for lane, (x, dx, y, dy) in enumerate(pairs):
        a[lane], b[lane] = x, y
        a[8 + lane], b[8 + lane] = dx * np.spacing(abs(x)), dy * np.spacing(abs(y))
    _run(a, b, result)
    exact = [Fraction(v) for v in result]
    for lane in range(8):
        x, y = Fraction(a[lane]), Fraction(b[lane])
        assert exact[lane] + exact[8 + lane] == x + y
        assert result[lane] == a[lane] + b[lane]
        assert exact[16 + lane] + exact[24 + lane] == x * y
        assert result[16 + lane] == a[lane] * b[lane]
        x, y = x + Fraction(a[8 + lane]), y + Fraction(b[8 + lane])
        error = abs(exact[32 + lane] + exact[40 + lane] - (x + y))
        assert error <= Fraction(1, 2**100) * abs(x + y)
        error = abs(exact[48 + lane] + exact[56 + lane] - x * y)
        assert error <= Fraction(1, 2**99) * abs(x * y)


def test_split_keeps_what_a_double_loses():
    high, low = split(Fraction(1, 3), 4.0)
    exact = Fraction(1, 12)
    assert high == complex(float(exact))
    assert abs(Fraction(high.real) + Fraction(low.real) - exact) < Fraction(1, 2**106)
    high, low = split(square_root(Fraction(2)))
    root = Fraction(high.real) + Fraction(low.real)
    assert abs(root * root - 2) < Fraction(1, 2**100)
