"""The arithmetics in lanes agree with ball arithmetic to rounding."""

from __future__ import annotations

from fractions import Fraction
from typing import NamedTuple

import flint
import numpy as np
import pytest

from nag.machine_code import plain
from nag.machine_code.kernel import Kernel
from nag.machine_code.lanes import aligned_zeros, store
from nag.machine_code.processor import processor
from nag.machine_code.records import Reals
from nag.tracking.ends.records import weights
from nag.tracking.kernel_arrays import words
from nag.tracking.numbers.complex_numbers import ARITHMETICS, ComplexNumbers


class Operands(NamedTuple):
    a: Reals
    b: Reals
    inverses: Reals
    results: Reals


def operations(z: ComplexNumbers, x: Operands) -> None:
    a = z.read(x.a, 0)
    b = z.read(x.b, 0)
    z.write(x.results, 0, z.add(a, b))
    z.write(x.results, 1, z.multiply(a, b))
    z.write(x.results, 2, z.inverse(a))
    z.write(x.results, 3, z.add(a, z.negative(b)))
    z.write(x.results, 4, z.exponential(a, x.inverses))


def small_operations(z: ComplexNumbers, x: Operands) -> None:
    a = z.read(x.a, 0)
    z.write(x.results, 0, z.inverse(a))
    store(x.results, 2 * z.number.words, z.magnitude(a))


KERNELS = {k: Kernel(operations, z, keep=False) for k, z in ARITHMETICS.items()}
SMALL = {k: Kernel(small_operations, z, keep=False) for k, z in ARITHMETICS.items()}


def ball(parts: np.ndarray) -> flint.acb:
    """The number in one lane, shape ``(2 words,)``."""
    half = len(parts) // 2
    sums = [sum(map(flint.arb, p.tolist()), flint.arb(0)) for p in (parts[:half], parts[half:])]
    return flint.acb(*sums)


def computed(count: int, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Results of the operations, shape ``(5, 2 words, 8)``."""
    memory = [aligned_zeros(2 * count) for _ in range(2)]
    for place, values in zip(memory, (a, b), strict=True):
        place[:] = values.ravel()
    results = aligned_zeros(10 * count)
    KERNELS[count](Operands(*memory, weights(14, count)["inverses"], results))
    return results.reshape(5, 2 * count, 8)


def random_numbers(count: int, rng: np.random.Generator, size: float) -> np.ndarray:
    """Eight complex numbers with all their words in use, shape ``(2 words, 8)``."""
    lanes = np.zeros((2 * count, 8))
    for lane in range(8):
        for part in range(2):
            digits = "".join(map(str, rng.integers(0, 10, 160)))
            value = Fraction(int(digits), 10**160) * Fraction(size) * int(rng.choice([-1, 1]))
            lanes[part * count : (part + 1) * count, lane] = words(value, count)[:count]
    return lanes


@pytest.mark.parametrize("count", ARITHMETICS)
@pytest.mark.parametrize("size", [1e-3, 1.0, 30.0])
def test_operations_are_exact_to_rounding(count: int, size: float) -> None:
    rng = np.random.default_rng(3)
    a, b = random_numbers(count, rng, size), random_numbers(count, rng, size)
    results = computed(count, a, b)
    with flint.ctx.workprec(600):
        for lane in range(8):
            x, y = ball(a[:, lane]), ball(b[:, lane])
            expected = (x + y, x * y, 1 / x, x - y, x.exp())
            scales = (abs(x) + abs(y), abs(x * y), abs(1 / x), abs(x) + abs(y), abs(x.exp()))
            for k, (value, scale) in enumerate(zip(expected, scales, strict=True)):
                # Halving and squaring an exponential's argument loses a few digits.
                factor = 2**16 if k == 4 else 32
                error = abs(ball(results[k, :, lane]) - value) / scale
                assert float(error.mid()) < factor * ARITHMETICS[count].number.epsilon


@pytest.mark.parametrize("count", ARITHMETICS)
@pytest.mark.parametrize("size", [1e-140, 1e-160, 1e-180])
def test_numbers_whose_squares_leave_the_range_have_sizes_and_inverses(count: int, size) -> None:
    memory, results = aligned_zeros(2 * count), aligned_zeros(2 * count + 1)
    memory[:8], memory[8 * count : 8 * count + 8] = 3 * size, -4 * size
    SMALL[count](Operands(memory, memory, memory, results))
    values = results.reshape(2 * count + 1, 8)
    with flint.ctx.workprec(600):
        for lane in range(8):
            expected = 1 / flint.acb(flint.arb(3 * size), flint.arb(-4 * size))
            error = abs(ball(values[: 2 * count, lane]) - expected) / abs(expected)
            # What is left of the last words are whole multiples of the smallest double.
            least = 5e-324 / size * 100
            assert float(error.mid()) < max(32 * ARITHMETICS[count].number.epsilon, least)
            assert values[-1, lane] == pytest.approx(5 * size, rel=1e-15)


@pytest.mark.parametrize("count", ARITHMETICS)
def test_plain_python_makes_the_same_words(count: int) -> None:
    rng = np.random.default_rng(7)
    a, b = random_numbers(count, rng, 1.0), random_numbers(count, rng, 1.0)
    memory = [aligned_zeros(2 * count) for _ in range(2)]
    for place, values in zip(memory, (a, b), strict=True):
        place[:] = values.ravel()
    results = aligned_zeros(10 * count)
    operands = Operands(*memory, weights(14, count)["inverses"], results)
    plain.run(operations, operands, constants=(ARITHMETICS[count],))
    if "fma" in processor()[2] or processor()[0].startswith(("aarch64", "arm64")):
        assert np.array_equal(results.reshape(5, 2 * count, 8), computed(count, a, b))


@pytest.mark.parametrize("count", ARITHMETICS)
def test_words_do_not_overlap(count: int) -> None:
    rng = np.random.default_rng(5)
    results = computed(count, random_numbers(count, rng, 1.0), random_numbers(count, rng, 1.0))
    parts = results[:2].reshape(4, count, 8)
    for larger, smaller in zip(parts.swapaxes(0, 1)[:-1], parts.swapaxes(0, 1)[1:], strict=True):
        assert (np.abs(smaller) <= np.spacing(np.abs(larger))).all()


def test_words_of_a_rational_number_add_up_to_it() -> None:
    third = words(Fraction(1, 3), 4)
    assert abs(sum(map(Fraction, third[:4])) - Fraction(1, 3)) < Fraction(1, 2**210)
    assert third[4:] == [0.0] * 4
    assert words(0.1 + 2j, 2, Fraction(3)) == [*words(Fraction(0.1) * 3, 2)[:2], 6.0, 0.0]
