"""Pivots are chosen among entries that are known."""

from __future__ import annotations

import flint
import numpy as np

from nag.numerics.digits import log_size
from nag.numerics.pivots import pivots


def acb_rows(rows: list[list[complex]]) -> list[list[flint.acb]]:
    return [[flint.acb(v) for v in row] for row in rows]


def test_nothing_is_known_of_a_quotient_by_what_may_be_zero() -> None:
    unknown = flint.acb(1) / flint.acb(flint.arb(0, 1))
    assert log_size(unknown) == np.inf
    assert abs(log_size(flint.acb(10) ** 400) - 400) < 1


def test_rows_of_which_nothing_is_known_elsewhere_give_no_pivot() -> None:
    here = acb_rows([[2, 1], [1, 3]])
    unknown = [[flint.acb(2), flint.acb(1)], [flint.acb(1) / flint.acb(flint.arb(0, 1))] * 2]
    rows, columns = pivots(lambda i: unknown if i else here, 2, 1, -100.0)
    assert (rows, columns) == ([0], [0])


def test_the_regular_block_is_found_whatever_the_order() -> None:
    matrix = acb_rows([[0, 0, 1], [0, 0, 2], [5, 0, 0]])
    rows, columns = pivots(lambda i: matrix, 3, 1, -100.0)
    assert set(zip(rows, columns, strict=True)) == {(2, 0), (1, 2)}
