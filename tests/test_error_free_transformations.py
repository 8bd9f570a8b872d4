"""The arithmetics of the kernels, of 32, 64 and 120 digits, against exact fractions."""

from __future__ import annotations

from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nag.algebra.number import square_root
from nag.machine_code.kernel import Kernel
from nag.machine_code.lanes import aligned_zeros, load, store
from nag.machine_code.records import Reals
from nag.tracking.kernel_arrays import words
from nag.tracking.numbers.complex_numbers import ARITHMETICS
from nag.tracking.numbers.error_free import two_product, two_sum


class Pairs(NamedTuple):
    a: Reals
    b: Reals
    result: Reals


def transformations(p: Pairs) -> None:
    """Sum and product of eight pairs of doubles, and their errors."""
    a, b = load(p.a, 0), load(p.b, 0)
    h, low = two_sum(a, b)
    store(p.result, 0, h)
    store(p.result, 1, low)
    h, low = two_product(a, b)
    store(p.result, 2, h)
    store(p.result, 3, low)


def operations(number: Any, p: Pairs) -> None:
    """Sum and product of eight pairs of numbers."""
    a, b = number.read(p.a, 0), number.read(p.b, 0)
    number.write(p.result, 0, number.add(a, b))
    number.write(p.result, 1, number.multiply(a, b))


TRANSFORMATIONS = Kernel(transformations, keep=False)
OPERATIONS = {k: Kernel(operations, z.number, keep=False) for k, z in ARITHMETICS.items()}
moderate = st.floats(min_value=-1e100, max_value=1e100).filter(lambda v: v == 0 or abs(v) > 1e-100)
tail = st.floats(min_value=-0.5, max_value=0.5)


@given(st.lists(st.tuples(moderate, moderate), min_size=8, max_size=8))
def test_transformations_lose_nothing(pairs: list[tuple[float, float]]) -> None:
    a, b, result = aligned_zeros(1), aligned_zeros(1), aligned_zeros(4)
    a[:], b[:] = zip(*pairs, strict=True)
    TRANSFORMATIONS(Pairs(a, b, result))
    exact = [Fraction(v) for v in result]
    for lane, (x, y) in enumerate(pairs):
        assert exact[lane] + exact[8 + lane] == Fraction(x) + Fraction(y)
        assert result[lane] == x + y
        assert exact[16 + lane] + exact[24 + lane] == Fraction(x) * Fraction(y)
        assert result[16 + lane] == x * y


def expansion(leading: float, tails: list[float], count: int) -> list[float]:
    """Doubles of decreasing size, each at most half a unit in the last place of the one before."""
    parts = [leading]
    for t in tails[: count - 1]:
        parts.append(t * float(np.spacing(abs(parts[-1]))) if parts[-1] else 0.0)
    return parts


numbers = st.tuples(moderate, st.lists(tail, min_size=7, max_size=7))


@pytest.mark.parametrize(("count", "bits"), [(2, 99), (4, 203), (8, 411)])
@given(pairs=st.lists(st.tuples(numbers, numbers), min_size=8, max_size=8))
def test_sums_and_products_keep_their_digits(count: int, bits: int, pairs) -> None:
    a, b, result = aligned_zeros(count), aligned_zeros(count), aligned_zeros(2 * count)
    for lane, pair in enumerate(pairs):
        for data, (leading, tails) in zip((a, b), pair, strict=True):
            data[lane::8] = expansion(leading, tails, count)
    OPERATIONS[count](Pairs(a, b, result))
    # Words below the smallest double are lost.
    error, lost = Fraction(1, 2**bits), Fraction(1, 2**1060)
    for lane in range(8):
        x, y = (sum(map(Fraction, data[lane::8])) for data in (a, b))
        total = sum(map(Fraction, result[lane : 8 * count : 8]))
        product = sum(map(Fraction, result[8 * count + lane :: 8]))
        assert abs(total - (x + y)) <= error * abs(x + y)
        assert abs(product - x * y) <= error * abs(x * y) + lost


@pytest.mark.parametrize(("count", "bits"), [(2, 106), (4, 212), (8, 424)])
def test_words_keep_what_a_double_loses(count: int, bits: int) -> None:
    parts = words(Fraction(1, 3), count, Fraction(1, 4))
    assert parts[0] == 1 / 12 and parts[count:] == [0.0] * count
    assert abs(sum(map(Fraction, parts)) - Fraction(1, 12)) < Fraction(1, 2**bits)
    root = sum(map(Fraction, words(square_root(Fraction(2)), count)))
    assert abs(root * root - 2) < Fraction(1, 2 ** (bits - 8))
