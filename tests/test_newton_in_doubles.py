"""Newton's method in doubles: what it converges to, and when it does not."""

from __future__ import annotations

import numpy as np
import pytest

from nag.numerics.double_newton import (
    ANYWHERE,
    Stop,
    count_above,
    find_zeros,
    newton_steps,
)

Pair = tuple[np.ndarray, np.ndarray]


def roots_of_unity(x: np.ndarray, which: np.ndarray) -> Pair:
    """``x^3 = 1`` for all points."""
    return x**3 - 1, 3 * x[:, :, None] ** 2


def circle(x: np.ndarray, which: np.ndarray) -> Pair:
    """``x^2 + y^2 = 1``, whose zeros are a curve."""
    return (x**2).sum(axis=1, keepdims=True) - 1, 2 * x[:, None, :]


def test_each_point_goes_to_its_own_zero_to_rounding() -> None:
    zeros = np.exp(2j * np.pi * np.arange(3) / 3)[:, None]
    ends = find_zeros(roots_of_unity, zeros + 0.1)
    assert ends.converged.all() and np.abs(ends.x - zeros).max() < 1e-15
    assert (ends.last < 1e-14).all() and (ends.first > 0.05).all()


def test_points_are_told_by_their_indices() -> None:
    levels = np.array([[1.0], [4.0], [1e4]])

    def squares(x: np.ndarray, which: np.ndarray) -> Pair:
        return x**2 - levels[which], 2 * x[:, :, None]

    ends = find_zeros(squares, np.array([[1.0], [2.1], [101.0]]))
    assert ends.converged.all() and ends.x == pytest.approx(np.sqrt(levels), abs=1e-14)


def test_steps_onto_a_curve_are_the_shortest() -> None:
    start = np.array([[1.2, 1.6], [0.3, -0.4]])
    ends = find_zeros(circle, start, rank=1)
    assert ends.converged.all()
    assert ends.x == pytest.approx(np.array([[0.6, 0.8], [0.6, -0.8]]), abs=1e-14)


def test_equations_too_many_are_met_by_least_squares() -> None:
    def lines(x: np.ndarray, which: np.ndarray) -> Pair:
        matrix = np.array([[1.0, 0.0], [0.0, 1.0], [1.0, 1.0]])
        return x @ matrix.T - [1.0, 1.0, 2.3], np.broadcast_to(matrix, (len(x), 3, 2))

    ends = find_zeros(lines, np.zeros((1, 2)), stop=ANYWHERE)
    assert ends.converged[0] and ends.x[0] == pytest.approx([1.1, 1.1], abs=1e-15)


def test_a_jacobian_that_is_kept_leads_to_the_same_zero_with_fewer_of_them() -> None:
    counted = [0, 0]

    def count(k: int, x: np.ndarray, which: np.ndarray) -> Pair:
        counted[k] += len(x)
        return roots_of_unity(x, which)

    start = np.full((1, 1), 1 + 1e-4)
    one = find_zeros(lambda x, i: count(0, x, i), start)
    other = find_zeros(
        lambda x, i: count(1, x, i), start, values=lambda x, i: roots_of_unity(x, i)[0]
    )
    assert one.converged[0] and other.converged[0] and np.abs(one.x - other.x).max() < 1e-15
    assert counted[1] == 1 < counted[0]


def test_what_does_not_converge_is_said() -> None:
    # No real zero; a singular Jacobian; a value that is no number; a step that is too long.
    def bad(x: np.ndarray, which: np.ndarray) -> Pair:
        values = np.select([which[:, None] == 2], [np.full_like(x, np.nan)], x**2 + 1.0)
        return values, 2 * x[:, :, None]

    start = np.array([[0.7], [0.0], [1.0], [1e-3]])
    ends = find_zeros(bad, start)
    assert not ends.converged.any()
    assert ends.x[1:].tolist() == start[1:].tolist() and np.isinf(ends.last[1:]).all()


def test_steps_that_do_not_shrink_end_where_that_is_asked_for() -> None:
    double = np.full((1, 1), 0.1)

    def square(x: np.ndarray, which: np.ndarray) -> Pair:
        return x**2, 2 * x[:, :, None]

    assert not find_zeros(square, double, stop=Stop(shrinking=0.25)).converged[0]
    assert find_zeros(square, double, 60).converged[0]


def test_coordinates_are_known_beside_their_own_sizes() -> None:
    levels = np.array([1e-40, 1e40])

    def squares(x: np.ndarray, which: np.ndarray) -> Pair:
        return x**2 - levels, 2 * x[:, :, None] ** 2 * np.eye(2)

    ends = find_zeros(squares, np.array([[1.1e-20, 1.1e20]]), units=np.abs)
    assert ends.converged[0] and ends.x[0] / np.sqrt(levels) == pytest.approx([1, 1], abs=1e-15)


def test_one_singular_matrix_leaves_the_steps_of_the_others() -> None:
    matrices = np.array([[[2.0, 0.0], [0.0, 4.0]], [[1.0, 1.0], [1.0, 1.0]]])
    values = np.array([[2.0, 4.0], [1.0, 2.0]])
    steps = newton_steps(values, matrices)
    assert steps[0].tolist() == [1.0, 1.0] and not np.isfinite(steps[1]).any()
    shortest = newton_steps(np.array([[1.0, 1.0]]), matrices[1:], count_above(1e-12))
    assert shortest[0] == pytest.approx([0.5, 0.5])
