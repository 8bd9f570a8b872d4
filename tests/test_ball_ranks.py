"""Ranks of numbers with errors: pivots are chosen among entries that are certainly no zeros."""

from __future__ import annotations

import flint
import numpy as np
import pytest
from scipy.linalg import qr

from nag.algebra.evaluation import Evaluator
from nag.algebra.exact_ranks import rank
from nag.algebra.expression import parse_polynomial
from nag.numerics.ball_ranks import Digits, known_zero, regular_block, row_echelon
from nag.numerics.digits import log_size
from nag.numerics.double_ranks import corank_on_component, matrix_corank, pivot_rows


def acb_rows(rows: list[list[complex]]) -> list[list[flint.acb]]:
    return [[flint.acb(v) for v in row] for row in rows]


def test_nothing_is_known_of_a_quotient_by_what_may_be_zero() -> None:
    unknown = flint.acb(1) / flint.acb(flint.arb(0, 1))
    assert log_size(unknown) == np.inf
    assert abs(log_size(flint.acb(10) ** 400) - 400) < 1


def test_rows_of_which_nothing_is_known_elsewhere_give_no_pivot() -> None:
    here = acb_rows([[2, 1], [1, 3]])
    unknown = [[flint.acb(2), flint.acb(1)], [flint.acb(1) / flint.acb(flint.arb(0, 1))] * 2]
    block = regular_block(here, 2, -100.0, [unknown])
    assert (block.rows, block.columns) == ([0], [0])


def test_the_regular_block_is_found_whatever_the_order() -> None:
    matrix = acb_rows([[0, 0, 1], [0, 0, 2], [5, 0, 0]])
    block = regular_block(matrix, 3, -100.0, [matrix])
    assert set(zip(block.rows, block.columns, strict=True)) == {(2, 0), (1, 2)}


@pytest.mark.parametrize("seed", range(3))
def test_radii_digits_doubles_and_fractions_tell_the_same_rank(seed: int) -> None:
    rng = np.random.default_rng(seed)
    whole = rng.integers(-9, 10, (6, 3)) @ rng.integers(-9, 10, (3, 7))
    exact = acb_rows(whole.tolist())
    with flint.ctx.workdps(60):
        error = flint.acb(flint.arb(0, 1e-40), flint.arb(0, 1e-40))
        balls = [[z + error for z in row] for row in exact]
        assert regular_block(balls, 7).rank == regular_block(exact, 7, -40.0).rank == 3
        assert len(row_echelon(exact, -40.0)) == 3
        assert len(Digits(60, -40.0, -20.0).null_space(exact, 7)) == 4
    assert matrix_corank(whole / np.abs(whole).max()) == 7 - rank(whole.tolist()) == 4


def test_a_radius_that_holds_zero_gives_no_rank() -> None:
    wide = flint.acb(flint.arb(1, 2))
    block = regular_block([[wide, flint.acb(1)], [wide, flint.acb(1)]], 2)
    assert (block.rank, block.columns) == (1, [1])
    assert known_zero(block.rest[0], flint.arb(1)) is None
    assert known_zero([flint.acb(flint.arb(0, 0.5))], flint.arb(1)) is True
    assert known_zero([flint.acb(3), wide], flint.arb(1)) is False


def test_an_echelon_form_takes_the_first_columns_that_it_can() -> None:
    with flint.ctx.workdps(60):
        rows = row_echelon(acb_rows([[0, 1e-3, 2, 1], [0, 1, 5, 1], [0, 1e-3, 2, 1]]), -40.0)
        assert [[round(abs(complex(z)), 9) for z in row[:3]] for row in rows] == [
            [0, 1, 0],
            [0, 0, 1],
        ]


@pytest.mark.parametrize("columns", [30, 600])
def test_rows_are_chosen_alike_by_numpy_and_by_lapack(columns: int) -> None:
    rng = np.random.default_rng(columns)
    matrix = rng.normal(size=(20, columns)) * np.logspace(0, 3, 20)[:, None]
    order, lengths = pivot_rows(matrix)
    _, triangle, known = qr(matrix.T, mode="economic", pivoting=True)
    assert order == known.tolist()
    assert np.allclose(lengths, np.abs(np.diag(triangle)))


def test_a_simple_zero_has_corank_zero_however_unequal_its_coordinates() -> None:
    squares = [parse_polynomial(f, ("x", "y")) for f in ("x^2 - 2*10^24", "10^24*y^2 - 3")]
    evaluator, x = Evaluator.of(squares, 2), np.array([2**0.5 * 1e12, 3**0.5 * 1e-12])
    assert matrix_corank(evaluator.balanced_jacobian(x)) == 2
    assert [corank_on_component(evaluator, x, 0, m) for m in (1, 2)] == [0, 2]
