"""The double-double arithmetic of the kernels against exact fractions."""

from fractions import Fraction
from typing import NamedTuple

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from nag.algebra.number import square_root
from nag.machine_code.kernel import Kernel
from nag.machine_code.lanes import aligned, load, store
from nag.machine_code.records import Reals
from nag.tracking.precision import add, multiply, split, two_product, two_sum


class Pairs(NamedTuple):
    a: Reals
    b: Reals
    result: Reals


def all_operations(p: Pairs) -> None:
    """Results of all four operations on eight pairs of double-doubles."""
    ah, al, bh, bl = load(p.a, 0), load(p.a, 1), load(p.b, 0), load(p.b, 1)
    h, low = two_sum(ah, bh)
    store(p.result, 0, h)
    store(p.result, 1, low)
    h, low = two_product(ah, bh)
    store(p.result, 2, h)
    store(p.result, 3, low)
    h, low = add(ah, al, bh, bl)
    store(p.result, 4, h)
    store(p.result, 5, low)
    h, low = multiply(ah, al, bh, bl)
    store(p.result, 6, h)
    store(p.result, 7, low)


_run = Kernel(all_operations, None)


moderate = st.floats(min_value=-1e100, max_value=1e100).filter(lambda v: v == 0 or abs(v) > 1e-100)
tail = st.floats(min_value=-0.5, max_value=0.5)


@settings(deadline=None)
@given(st.lists(st.tuples(moderate, tail, moderate, tail), min_size=8, max_size=8))
def test_transformations_lose_nothing_and_operations_keep_32_digits(pairs):
    a, b, result = aligned(2), aligned(2), aligned(8)
    for lane, (x, dx, y, dy) in enumerate(pairs):
        a[lane], b[lane] = x, y
        a[8 + lane], b[8 + lane] = dx * np.spacing(abs(x)), dy * np.spacing(abs(y))
    _run(Pairs(a, b, result))
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
