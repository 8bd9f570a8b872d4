"""Paths along which a coordinate decays far below the square root of the smallest double."""

from __future__ import annotations

import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.tracking.compiled import compile_rows
from nag.tracking.homotopy import Homotopy
from nag.tracking.paths import PathStatus
from nag.tracking.track import track


def test_a_coordinate_that_decays_to_nothing_does_not_stop_the_path() -> None:
    x, y = Polynomial.variables(2)
    rows = compile_rows([x * y])
    first = np.array([[-1, 1, 0.3 + 0.2j]])
    second = np.array([[-2 + 1j, 1, 0.7j]])
    start = np.array([[1, 1e-140 + 1e-141j, 1 / (0.3 + 0.2j)]])
    ends = track(Homotopy(rows, second, first - second), start, endgame=False)
    assert ends.status[0] == PathStatus.REGULAR
    assert abs(ends.points[0, 1]) < 1e-100
