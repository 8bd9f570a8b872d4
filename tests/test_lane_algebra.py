"""Linear algebra in lanes against NumPy."""

from typing import NamedTuple

import numpy as np

from nag.machine_code.kernel import Kernel
from nag.machine_code.lanes import aligned_zeros
from nag.machine_code.records import Reals
from nag.tracking.linear_algebra import factorize, substitute, substitute_adjoint
from nag.tracking.numbers.doubles import DOUBLES, ComplexDoubles


class Equations(NamedTuple):
    n: int
    matrix: Reals
    pivots: Reals
    right: Reals
    adjoint: bool


def solve(z: ComplexDoubles, e: Equations) -> None:
    factorize(z, e.n, e.matrix, e.pivots)
    if e.adjoint:
        substitute_adjoint(z, e.n, e.matrix, e.pivots, e.right)
    else:
        substitute(z, e.n, e.matrix, e.pivots, e.right)


_solve = Kernel(solve, DOUBLES, keep=False)


def _in_lanes(array):
    """Eight complex arrays, real and imaginary parts in turn, the lane last."""
    vectors = aligned_zeros(2 * array[0].size)
    flat = array.reshape(8, -1).T
    vectors.reshape(-1, 2, 8)[:] = np.stack([flat.real, flat.imag], axis=1)
    return vectors


def _solutions(matrices, right, adjoint):
    n = right.shape[1]
    vector = _in_lanes(right)
    _solve(Equations(n, _in_lanes(matrices), aligned_zeros(n), vector, adjoint))
    parts = vector.reshape(n, 2, 8)
    return (parts[:, 0] + 1j * parts[:, 1]).T


def _random(seed, n):
    generator = np.random.default_rng(seed)
    parts = generator.normal(size=(2, 8, n, n + 1))
    both = parts[0] + 1j * parts[1]
    return both[:, :, :n].copy(), both[:, :, n].copy()


def test_each_lane_solves_its_own_system():
    for n in (1, 2, 4, 5, 13):
        matrices, right = _random(n, n)
        for adjoint in (False, True):
            a = matrices.conj().transpose(0, 2, 1) if adjoint else matrices
            expected = np.linalg.solve(a, right[:, :, None])[:, :, 0]
            scale = np.linalg.cond(a).max()
            assert np.allclose(_solutions(matrices, right, adjoint), expected, rtol=1e-14 * scale)


def test_zero_pivots_are_exchanged_in_their_lane_alone():
    matrices, right = _random(7, 3)
    matrices[2] = [[0, 1, 0], [0, 0, 2], [3, 0, 0]]
    matrices[5] = [[0, 0, 1], [1, 0, 0], [0, 1, 0]]
    solutions = _solutions(matrices, right, False)
    assert np.allclose(solutions[2], [right[2, 2] / 3, right[2, 0], right[2, 1] / 2])
    assert np.array_equal(solutions[5], [right[5, 1], right[5, 2], right[5, 0]])


def test_a_singular_lane_does_not_touch_the_others():
    matrices, right = _random(11, 4)
    expected = _solutions(matrices, right, False)
    matrices[3, :, 1] = 0
    solutions = _solutions(matrices, right, False)
    others = [0, 1, 2, 4, 5, 6, 7]
    assert np.array_equal(solutions[others], expected[others])
    assert not np.isfinite(solutions[3]).all()
