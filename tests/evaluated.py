"""Values and Jacobians of homotopies in NumPy, to compare the kernels with."""

from __future__ import annotations

import numpy as np

from nag.tracking.compiled import Tape
from nag.tracking.homotopy import Homotopy


def patch(homotopy: Homotopy, points: np.ndarray) -> np.ndarray:
    """Patch rows: each group's coordinates conjugated, shape ``(P, groups, N)``."""
    rows = np.zeros((len(points), len(homotopy.groups), homotopy.N), dtype=np.complex128)
    for g, indices in enumerate(homotopy.groups):
        rows[:, g, list(indices)] = points[:, list(indices)].conj()
    return rows


def values(homotopy: Homotopy, points: np.ndarray, t: complex | np.ndarray) -> np.ndarray:
    """Values of polynomial and linear rows at points of shape ``(P, N)``."""
    tape, m = homotopy.rows.tape, len(homotopy.rows)
    t = np.broadcast_to(np.asarray(t, dtype=np.complex128), (len(points),))
    slots = _slots(tape, points, tape.value_products)
    result = np.zeros((len(points), m + len(homotopy.A0)), dtype=np.complex128)
    for b, (row, part) in enumerate(zip(tape.value_place, tape.value_part, strict=True)):
        q = slice(tape.value_start[b], tape.value_start[b + 1])
        a, c = homotopy.factors[part]
        result[:, row] += (a + t * c) * (slots[:, tape.value_slot[q]] @ tape.value_coefficient[q])
    result[:, m:] = points @ homotopy.A0.T + t[:, None] * (points @ homotopy.A1.T)
    return result


def jacobian(homotopy: Homotopy, points: np.ndarray, t: complex | np.ndarray) -> np.ndarray:
    """Jacobian of polynomial and linear rows, shape ``(P, rows, N)``."""
    tape, N, m = homotopy.rows.tape, homotopy.N, len(homotopy.rows)
    t = np.broadcast_to(np.asarray(t, dtype=np.complex128), (len(points),))
    slots = _slots(tape, points, len(tape.first))
    result = np.zeros((len(points), m + len(homotopy.A0), N), dtype=np.complex128)
    for b, (place, part) in enumerate(zip(tape.jacobian_place, tape.jacobian_part, strict=True)):
        q = slice(tape.jacobian_start[b], tape.jacobian_start[b + 1])
        total = slots[:, tape.jacobian_slot[q]] @ tape.jacobian_coefficient[q]
        a, c = homotopy.factors[part]
        result[:, place // N, place % N] += (a + t * c) * total
    result[:, m:] = homotopy.A0 + t[:, None, None] * homotopy.A1
    return result


def _slots(tape: Tape, points: np.ndarray, products: int) -> np.ndarray:
    P, N = points.shape
    slots = np.ones((P, N + 1 + products), dtype=np.complex128)
    slots[:, :N] = points
    for k in range(products):
        slots[:, N + 1 + k] = slots[:, tape.first[k]] * slots[:, tape.second[k]]
    return slots
