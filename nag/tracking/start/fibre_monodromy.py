"""All solutions of a system with generic coefficients, by monodromy from one of them.

For supports that hold the origin the solutions of all systems form one irreducible set, so that
loops of coefficients lead from any solution of one system to any other (Duff, Hill, Jensen, Lee,
Leykin & Sommars, Solving polynomial systems via homotopy continuation and monodromy, 2019).
Whatever is found is a solution, even where a path was lost; only how many there are must be known.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from nag.tracking.homotopy import Homotopy, straight_line
from nag.tracking.paths import PathStatus
from nag.tracking.settings import Settings
from nag.tracking.start.target import Terms, group_degrees, homogenized, unit
from nag.tracking.track import track

# Loops without a new solution after which the search ends, and loops in all.
MOST_IDLE = 12
MOST_LOOPS = 200
# Projective distance of points that are one.
SAME = 1e-7


def _coefficients(
    supports: Sequence[np.ndarray], x: np.ndarray, rng: np.random.Generator
) -> list[np.ndarray]:
    """Random coefficients of systems with the zero ``x``, no coordinate of which is zero."""
    result = []
    for support in supports:
        monomials = np.prod(x[None, :] ** support, axis=1)
        c = unit(rng, len(support))
        result.append(c - (c @ monomials) / np.vdot(monomials, monomials) * monomials.conj())
    return result


def _rows(supports: Sequence[np.ndarray], coefficients: Sequence[np.ndarray]) -> tuple[Terms, ...]:
    return tuple(
        {tuple(e): complex(v) for e, v in zip(s.tolist(), c, strict=True)}
        for s, c in zip(supports, coefficients, strict=True)
    )


class _Fibre:
    """Distinct projective points, found again by a projection that sorts them."""

    def __init__(self, N: int, most: int) -> None:
        self.points = np.zeros((0, N), dtype=np.complex128)
        self.most = most
        self._weights = np.exp(1j * np.arange(N) ** 2)

    def _key(self, points: np.ndarray) -> np.ndarray:
        return np.abs(points @ self._weights) ** 2

    def add(self, points: np.ndarray) -> int:
        """Add those that are new; returns how many."""
        everything = np.concatenate([self.points, points])
        key = self._key(everything)
        order = np.argsort(key, kind="stable")
        old = len(self.points)
        known = np.zeros(len(everything), dtype=bool)
        for a, i in enumerate(order):
            for j in order[a + 1 :]:
                if key[j] - key[i] > 10 * SAME:
                    break
                later, earlier = max(i, j), min(i, j)
                if later >= old and not known[earlier]:
                    overlap = abs(np.vdot(everything[earlier], everything[later]))
                    if 1 - overlap**2 < SAME**2 + 1e-14:
                        known[later] = True
        new = np.flatnonzero(~known[old:])[: self.most - old]
        self.points = np.concatenate([self.points, points[new]])
        return len(new)

    def missing_from(self, points: np.ndarray) -> np.ndarray:
        """Those of the fibre that are not among ``points``."""
        other = _Fibre(self.points.shape[1], 1 << 60)
        other.points = points
        count = len(points)
        other.add(self.points)
        return other.points[count:]


def generic_solutions(
    supports: Sequence[np.ndarray],
    expected: int,
    rng: np.random.Generator,
    settings: Settings | str,
    threads: int,
) -> tuple[tuple[Terms, ...], np.ndarray, int]:
    """A system with these supports and random coefficients, and its solutions.

    Args:
        supports: one for each equation, each with the origin, shape ``(terms, n)``.
        expected: how many solutions there are; the search ends there, or when loops find no more.

    Returns:
        The system's rows, the projective solutions, shape ``(P, 1 + n)``, and the number of paths.
    """
    n = len(supports)
    groups = (tuple(range(n)),)
    x = unit(rng, n)
    here = _rows(supports, _coefficients(supports, x, rng))
    there = _rows(supports, [unit(rng, len(s)) for s in supports])
    degrees = group_degrees(here, groups)
    first, second = (homogenized(rows, n, groups, degrees) for rows in (here, there))
    fibre, other = _Fibre(n + 1, expected), _Fibre(n + 1, expected)
    fibre.add(_unit_norm(np.append(1.0, x)[None]))
    spent, idle = 0, 0
    for _ in range(MOST_LOOPS):
        if len(fibre.points) >= expected or idle >= MOST_IDLE:
            break
        gamma = complex(unit(rng, 1)[0])
        forward = straight_line(first, second, gamma)
        backward = straight_line(second, first, 1 / gamma)
        ends = _moved(forward, fibre.points, settings, threads)
        spent += len(fibre.points)
        gained = other.add(ends)
        # The way is one to one: what it did not reach leads back to solutions that are new.
        left = other.missing_from(ends)
        gained += fibre.add(_moved(backward, left, settings, threads))
        spent += len(left)
        idle = 0 if gained else idle + 1
    return here, fibre.points, spent


def _unit_norm(points: np.ndarray) -> np.ndarray:
    return points / np.linalg.norm(points, axis=1, keepdims=True)


def _moved(
    homotopy: Homotopy, points: np.ndarray, settings: Settings | str, threads: int
) -> np.ndarray:
    if not len(points):
        return points
    paths = track(homotopy, points, settings, threads, endgame=False)
    return _unit_norm(paths.points[paths.where(PathStatus.REGULAR)])
