"""Sums of products whose words are put in order at the end only agree with ball arithmetic."""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import flint
import numpy as np
import pytest
from test_numbers import ball, random_numbers

from nag.machine_code.kernel import Kernel
from nag.machine_code.lanes import aligned_zeros
from nag.machine_code.records import Reals
from nag.tracking.numbers.complex_numbers import ARITHMETICS, ComplexNumbers

COUNT = 30


class Factors(NamedTuple):
    a: Reals
    b: Reals
    results: Reals


def sums(z: ComplexNumbers, x: Factors) -> None:
    total = z.read(x.a, 0)
    real = total
    for k in range(COUNT):
        b = z.read(x.b, k)
        total = z.gather(total, z.read(x.a, k), b)
        real = z.gather_real(real, z.read(x.a, k), z.number.read(x.b, 2 * k))
    z.write(x.results, 0, z.gathered(total))
    z.write(x.results, 1, z.gathered(real))


KERNELS = {k: Kernel(sums, z, keep=False) for k, z in ARITHMETICS.items()}


@pytest.mark.parametrize("count", ARITHMETICS)
@pytest.mark.parametrize("cancels", [False, True])
def test_sums_are_exact_to_rounding_and_words_do_not_overlap(count: int, cancels: bool) -> None:
    rng = np.random.default_rng(3)
    memory = [aligned_zeros(2 * count * COUNT) for _ in range(2)]
    a, b = (
        np.array([random_numbers(count, rng, 10.0 ** rng.integers(-3, 1)) for _ in range(COUNT)])
        for _ in range(2)
    )
    if cancels:
        a[1::2], b[1::2] = a[::2], -b[::2]
    for place, values in zip(memory, (a, b), strict=True):
        place[:] = values.ravel()
    results = aligned_zeros(4 * count)
    KERNELS[count](Factors(*memory, results))
    results = results.reshape(2, 2 * count, 8)
    with flint.ctx.workprec(900):
        for lane in range(8):
            x, y = ([ball(n[:, lane]) for n in numbers] for numbers in (a, b))
            for k, right in enumerate((y, [w.real for w in y])):
                expected = sum((p * q for p, q in zip(x, right, strict=True)), x[0])
                size = sum((abs(p) * abs(q) for p, q in zip(x, right, strict=True)), abs(x[0]))
                error = abs(ball(results[k, :, lane]) - expected) / size
                assert float(error.mid()) < 32 * ARITHMETICS[count].number.epsilon
    parts = results.reshape(4, count, 8).swapaxes(0, 1)
    for larger, smaller in pairwise(parts):
        assert (np.abs(smaller) <= np.spacing(np.abs(larger))).all()
