"""Paths whose coordinates leave the range of doubles: each coordinate over a power of two.

A word of a number is a double, which is nothing below 1e-308. A product of seven coordinates of
1e-43 has no second word any more, and a row of such products no Jacobian. Over powers of two near
their sizes all coordinates are about one, and so are the rows, over powers of their own; nothing is
rounded by that. In logarithms of the coordinates, that is all that changes.
"""

from __future__ import annotations

import numpy as np

from nag.tracking.ends.records import Equations
from nag.tracking.homotopy import Homotopy

# Binary exponents of doubles, and bits of a word.
EXPONENTS, WORD = 1022, 53


def powers_of_two(homotopy: Homotopy, points: np.ndarray, known: np.ndarray) -> np.ndarray:
    """Binary logarithms of the coordinates of points that leave the range, whole numbers.

    Args:
        points: in words, shape ``(P, N, 2, words)``.
        known: which coordinates are more than rounding errors, shape ``(P, N)``.

    Returns:
        Shape ``(P, N)``; rows are 0 where the point is within the range.
    """
    size = np.hypot(points[:, :, 0, 0], points[:, :, 1, 0])
    logs = np.rint(np.log2(np.where(known & (size > 0), size, 1.0)))
    # Products of two coordinates, and terms, are to have all their words.
    least = -(EXPONENTS - WORD * points.shape[-1])
    beyond = 2 * logs.min(axis=1, initial=0.0) < least
    degree = max((sum(e) for row in homotopy.rows.parts for _, own in row for e in own), default=1)
    doubtful = np.flatnonzero(degree * logs.min(axis=1, initial=0.0) < least)
    if len(doubtful) and len(homotopy.rows):
        exponents, first = _exponents(homotopy)
        rows = np.maximum.reduceat(logs[doubtful] @ exponents.T, first, axis=1)
        beyond[doubtful] |= (rows < least).any(axis=1)
    return np.where(beyond[:, None], logs, 0.0).astype(np.int64)


def _exponents(homotopy: Homotopy) -> tuple[np.ndarray, np.ndarray]:
    """Exponents of the terms of all polynomial rows, and the first of each row."""
    rows = [[e for _, own in row for e in own] for row in homotopy.rows.parts]
    sizes = [len(row) for row in rows]
    return np.array([e for row in rows for e in row], dtype=np.float64), np.cumsum([0, *sizes[:-1]])


def scaled(equations: Equations, homotopy: Homotopy, powers: np.ndarray) -> Equations:
    """The equations in coordinates over powers of two, each row over the power of its largest term.

    Args:
        equations: of ``homotopy``.
        powers: shape ``(N,)``.
    """
    values: list[int] = []
    blocks: list[tuple[int, int, list[int]]] = []
    for r, row in enumerate(homotopy.rows.parts):
        shifts = {e: int(np.dot(e, powers)) for _, terms in row for e in terms}
        most = max(shifts.values())
        for part, terms in row:
            derivatives: dict[int, list[int]] = {}
            for e in sorted(terms, reverse=True):
                values.append(shifts[e] - most)
                for j, k in enumerate(e):
                    if k:
                        derivatives.setdefault(j, []).append(shifts[e] - most)
            blocks += [(r * homotopy.N + j, part, derivatives[j]) for j in sorted(derivatives)]
    blocks.sort(key=lambda block: block[:2])
    A0, A1 = (A.reshape(-1, homotopy.N, 2) for A in (equations.A0, equations.A1))
    largest = np.where((A0 != 0).any(axis=2) | (A1 != 0).any(axis=2), powers, np.iinfo(int).min)
    lines = (powers - largest.max(axis=1, initial=np.iinfo(int).min)[:, None])[:, :, None]
    return equations._replace(
        value=_shifted(equations.value, values),
        jacobian=_shifted(equations.jacobian, [k for _, _, own in blocks for k in own]),
        A0=np.ldexp(A0, np.minimum(lines, 0)).ravel(),
        A1=np.ldexp(A1, np.minimum(lines, 0)).ravel(),
    )


def _shifted(numbers: np.ndarray, shifts: list[int]) -> np.ndarray:
    """Numbers, several words each, times powers of two."""
    if not shifts:
        return numbers
    words = numbers.reshape(len(shifts), -1)
    return np.ldexp(words, np.array(shifts)[:, None]).ravel()
