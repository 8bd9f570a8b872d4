"""Smallest sets of vectors that sum to zero, among random ones that are known with errors."""

from __future__ import annotations

import numpy as np
import pytest

from nag.decomposition.zero_sums import smallest_zero_sums

WEIGHTS = np.random.default_rng(0).integers(-1000, 1001, (4, 4))


def vectors_in_sets(sizes: list[int], bits: int, error: int, seed: int) -> tuple:
    """Random integer vectors in sets that sum to zero up to errors, in random order."""
    rng = np.random.default_rng(seed)
    order, first, sets = rng.permutation(sum(sizes)).tolist(), 0, []
    vectors = np.zeros((len(order), 4), dtype=object)
    for size in sizes:
        own = order[first : first + size]
        for i in own[1:]:
            vectors[i] = [(int(v) << bits) >> 40 for v in rng.integers(-(2**40), 2**40, 4)]
        noise = [int(v) for v in rng.integers(-error, error + 1, 4)]
        vectors[own[0]] = noise - vectors[own[1:]].sum(axis=0) if size > 1 else noise
        sets.append(sorted(own))
        first += size
    return vectors, sorted(sets)


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("sizes", [[1], [2], [1, 1, 2, 5], [4] * 9, [36], [1, 11, 24], [20, 20]])
def test_sets_that_sum_to_zero_are_found(sizes: list[int], seed: int) -> None:
    vectors, sets = vectors_in_sets(sizes, 80, 100, seed)
    assert smallest_zero_sums(vectors, 100, WEIGHTS) == sets


@pytest.mark.parametrize("seed", range(3))
def test_vectors_of_no_set_are_left_out(seed: int) -> None:
    vectors, sets = vectors_in_sets([3, 7, 12], 80, 100, seed)
    left = sets[1][2]
    shifted = [[i - (i > left) for i in each] for each in sets if left not in each]
    assert smallest_zero_sums(np.delete(vectors, left, axis=0), 100, WEIGHTS) == shifted
    assert smallest_zero_sums(vectors[sets[0][:2]], 100, WEIGHTS) == []


def test_sums_that_are_small_by_accident_leave_it_open() -> None:
    # Of 30 vectors of 2 digits many sets seem to sum to zero.
    vectors, _ = vectors_in_sets([10, 20], 8, 1, 0)
    assert smallest_zero_sums(vectors, 1, WEIGHTS) is None
    assert smallest_zero_sums(vectors[:0], 1, WEIGHTS) == []
