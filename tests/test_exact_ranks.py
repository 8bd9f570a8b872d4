"""Ranks of exact matrices do not depend on how they are told, and have no tolerance."""

from __future__ import annotations

from fractions import Fraction

import flint
import numpy as np
import pytest

from nag.algebra.exact_ranks import (
    FIELDS,
    LARGE,
    are_independent_over,
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
