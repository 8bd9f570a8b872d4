"""Ranks of exact matrices do not depend on how they are told, and have no tolerance."""

from __future__ import annotations

from fractions import Fraction

import flint
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nag.algebra.exact_ranks import (
    FIELDS,
    LARGE,
    are_independent_over,
    fields_with_roots,
    first_independent_rows,
    independent_polynomials,
    null_space,
    primes_below,
    rank,
    row_echelon,
)
from nag.algebra.number import Number, square_root
from nag.algebra.polynomial import Polynomial

ROOT = square_root(2)


def random_rows(seed: int, rows: int, columns: int, of_rank: int) -> list[list[Fraction]]:
    rng = np.random.default_rng(seed)
    left, right = (rng.integers(-9, 10, shape) for shape in ((rows, of_rank), (of_rank, columns)))
    return [[Fraction(int(c), 7) for c in row] for row in left @ right]


@pytest.mark.parametrize("seed", range(4))
def test_an_irrational_factor_changes_no_rank_and_no_pivot(seed: int) -> None:
    rows = random_rows(seed, 5, 6, 3)
    scaled: list[list[Number]] = [[c * ROOT for c in row] for row in rows]
    assert row_echelon(scaled) == row_echelon(rows)
    assert rank(scaled) == rank(rows) == LARGE.rank([[LARGE.of(c) for c in row] for row in rows])
    assert first_independent_rows(scaled) == first_independent_rows(rows)


def test_what_differs_in_the_last_digit_is_independent() -> None:
    rows = [[Fraction(1), Fraction(1)], [Fraction(1), 1 + Fraction(1, 10**300)]]
    assert rank(rows) == 2
    assert rank([rows[0], [2 * c for c in rows[0]]]) == 1


def test_a_null_space_is_annihilated() -> None:
    rows = random_rows(1, 4, 6, 3)
    basis = null_space(rows, 6)
    assert len(basis) == 3
    for row in rows:
        assert all(sum(a * b for a, b in zip(row, v, strict=True)) == 0 for v in basis)


def test_the_first_polynomials_stay_where_others_are_their_combinations() -> None:
    x, y = Polynomial.variables(2)
    given = [x + y, x - y, x, y * ROOT, x * y]
    assert independent_polynomials(given) == [x + y, x - y, x * y]


def test_rows_over_a_number_field_may_depend_with_irrational_factors() -> None:
    minimal = flint.fmpq_poly([-2, 0, 1])
    one, root = flint.fmpq_poly([1]), flint.fmpq_poly([0, 1])
    assert are_independent_over([[one, root], [root, one]], minimal)
    assert not are_independent_over([[one, root], [root, 2 * one]], minimal)


def test_all_primes_are_chosen_in_one_way() -> None:
    first, second = (field.modulus for field in FIELDS)
    assert LARGE.modulus == first > second > 2**61
    assert next(primes_below(12)) == 11
    assert list(primes_below(11)) == [7, 3]


@given(seed=st.integers(0, 2**32 - 1), roots=st.sampled_from([(3,), (2, 3), (6, 10), (2, 3, 5, 7)]))
def test_a_matrix_of_roots_has_the_rank_that_it_is_made_with(
    seed: int, roots: tuple[int, ...]
) -> None:
    rng = np.random.default_rng(seed)

    def entry() -> Number:
        weights = [Fraction(int(c), 3) for c in rng.integers(-3, 4, 1 + len(roots))]
        parts = (w * square_root(r) for w, r in zip(weights, (1, *roots), strict=True))
        return sum(parts, Fraction(0))

    left, right = ([[entry() for _ in range(n)] for _ in range(m)] for m, n in ((3, 2), (2, 4)))
    rows = [
        [
            sum((a * b for a, b in zip(row, column, strict=True)), Fraction(0))
            for column in zip(*right, strict=True)
        ]
        for row in left
    ]
    echelon, pivots = row_echelon(rows)
    assert rank(rows) == len(echelon) == len(pivots) <= 2
    for k, row in enumerate(echelon):
        assert [row[p] for p in pivots] == [int(k == i) for i in range(len(pivots))]
        assert not any(row[: pivots[k]])
    # Each row is the combination of the echelon's rows that its entries at the pivots are.
    for row in rows:
        weights = [row[p] for p in pivots]
        for j, c in enumerate(row):
            assert c == sum((w * e[j] for w, e in zip(weights, echelon, strict=True)), Fraction(0))
    field = fields_with_roots(frozenset({2, 3, 5, 7}))[0]
    assert field.rank([[field.of(c) for c in row] for row in rows]) == len(pivots)
