"""The tracker's Taylor coefficients solve the homotopy, order by order."""

from __future__ import annotations

import numpy as np
import pytest
from evaluated import values

from nag.algebra.polynomial import Polynomial
from nag.tracking.compiled import compile_rows
from nag.tracking.homotopy import Homotopy, straight_line
from nag.tracking.kernel_arrays import equations, scratch_table
from nag.tracking.straight_run import Batch, track_lanes

ORDER = 5
# More samples of a polynomial than its degree give its coefficients exactly.
SAMPLES = 64


def taylor_coefficients(homotopy: Homotopy, start: np.ndarray) -> np.ndarray:
    """Coefficients of orders 0 to ORDER of the path at t = 1, shape ``(ORDER + 1, N)``."""
    N = homotopy.N
    scratch = scratch_table(homotopy, ORDER)
    # The first step of a path corrects its start; the second one fails, as no more are allowed.
    batch = Batch(
        starts=np.ascontiguousarray(start, dtype=complex),
        member=np.zeros(1, dtype=np.int64),
        count=1,
        first=0,
        stride=1,
        points=np.zeros(N, dtype=complex),
        safe=np.zeros(N, dtype=complex),
        safe_t=np.zeros(1),
        error=np.zeros(1),
        steps=np.zeros(1, dtype=np.int64),
        reason=np.zeros(1, dtype=np.int64),
        order=ORDER,
        max_steps=2,
        radius=0.0,
        tolerance=1e-3,
        newton=1e-7,
        newton_end=1e-12,
        floor=1e-6,
        radius_factor=0.4,
        safety=0.2,
        contraction=0.1,
    )
    track_lanes(equations(homotopy), scratch, batch)
    base = scratch.record.base.reshape(ORDER + 1, N, 2, 8)[..., 0]
    return base[..., 0] + 1j * base[..., 1]


def residual_coefficients(homotopy: Homotopy, coefficients: np.ndarray) -> np.ndarray:
    """Coefficients of ``H(x(1 + h), 1 + h)`` as a polynomial in h, a row for each order."""
    h = np.exp(2j * np.pi * np.arange(SAMPLES) / SAMPLES)
    points = (h[:, None] ** np.arange(ORDER + 1)) @ coefficients
    return np.fft.fft(values(homotopy, points, 1 + h), axis=0) / SAMPLES


def homotopy_and_start(case: str) -> tuple[Homotopy, np.ndarray]:
    x, y, z = Polynomial.variables(3)
    goal = [x * x * y - 2 * y * z + 3, y * y * y + x * z * z - 1, x * y - z * z + x - 2]
    begin = [x * x * x - 1, y * y * y - 1, z * z - 1]
    root = np.exp(2j * np.pi / 3)
    start = np.array([1, root, root**2, -1])
    if case == "quadrics":
        goal = [x * x + y * z - 1, x * y + z * z + y, x * z - y * y + 2]
        begin, start = [v * v - 1 for v in (x, y, z)], np.array([1, -1, 1, 1])
    first, second = compile_rows(begin), compile_rows(goal)
    gamma, start = 0.6 + 0.8j, start / np.linalg.norm(start)
    if case != "slice":
        return straight_line(first, second, gamma), start
    A1 = np.array([[0.3, 1j, -0.4, 0.2 + 0.1j]])
    A0 = np.array([[0.5, 0.1, 0.7j, -1.0]])
    A0[0, 0] -= (A0[0] + A1[0]) @ start / start[0]
    rows = compile_rows(begin[:2]), compile_rows(goal[:2])
    return straight_line(*rows, gamma, A0, A1), start


@pytest.mark.parametrize("case", ["cubics", "quadrics", "slice"])
def test_residual_of_the_series_begins_beyond_its_order(case: str) -> None:
    homotopy, start = homotopy_and_start(case)
    coefficients = taylor_coefficients(homotopy, start)
    assert np.allclose(coefficients[0], start, atol=1e-15)
    # The patch keeps the path orthogonal to where the point is now.
    assert np.abs(coefficients[1:] @ start.conj()).max() < 1e-13
    sizes = np.abs(residual_coefficients(homotopy, coefficients)).max(axis=1)
    assert sizes[: ORDER + 1].max() < 1e-12 * sizes.max()
    assert sizes[ORDER + 1] > 1e-6 * sizes.max()
