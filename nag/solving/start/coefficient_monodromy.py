"""All solutions of a system with generic coefficients, by monodromy from some of them.

The solutions without zero coordinates of all systems of the same supports form one irreducible set,
so that loops of coefficients lead from any solution of one system to any other (Duff, Hill, Jensen,
Lee, Leykin & Sommars, Solving polynomial systems via homotopy continuation and monodromy, 2019).
Whatever is found is a solution, even where a path was lost; only how many there are must be known.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np

from nag.solving.start.monodromy_loops import DistinctSolutions, Ends, run_loop
from nag.solving.start.target import (
    StartSystem,
    Target,
    Terms,
    group_degrees,
    homogenize_rows,
    unit,
)
from nag.tracking.homotopy import Homotopy, straight_line
from nag.tracking.projective import coinciding_pairs
from nag.tracking.settings import find_settings
from nag.tracking.track import track_regular

# Loops without a new solution after which the search ends, and loops in all. Every second one
# leads through a system of its own. A random permutation keeps k of n points among themselves with
# a probability of 1 / binomial(n, k), at most 1/2: half as many loops in vain have one of 1e-6.
MOST_IDLE = 40
MOST_LOOPS = 400


@dataclass(frozen=True, eq=False)
class GenericSystem:
    """A system with generic coefficients, and solutions of it.

    Attributes:
        supports: one for each equation, shape ``(terms, n)``.
        coefficients: those of each support's points.
        points: distinct solutions in projective coordinates of unit norm, shape ``(P, 1 + n)``.
        errors: their relative errors, shape ``(P,)``.
    """

    supports: tuple[np.ndarray, ...]
    coefficients: tuple[np.ndarray, ...]
    points: np.ndarray
    errors: np.ndarray

    def holding(self, points: np.ndarray, errors: np.ndarray) -> GenericSystem:
        """The same system with these solutions."""
        return replace(self, points=points, errors=errors)

    @cached_property
    def rows(self) -> tuple[Terms, ...]:
        """The system's terms."""
        return tuple(
            {tuple(e): complex(v) for e, v in zip(s.tolist(), c, strict=True)}
            for s, c in zip(self.supports, self.coefficients, strict=True)
        )


def seed_system(supports: Sequence[np.ndarray], rng: np.random.Generator) -> GenericSystem:
    """Random coefficients of a system with a random zero, no coordinate of which is zero."""
    x = unit(rng, len(supports))
    coefficients = []
    for support in supports:
        monomials = np.prod(x[None, :] ** support, axis=1)
        c = unit(rng, len(support))
        c = c - (c @ monomials) / np.vdot(monomials, monomials) * monomials.conj()
        coefficients.append(c)
    point = np.append(1.0, x)[None] / np.sqrt(1 + len(x))
    return GenericSystem(tuple(supports), tuple(coefficients), point, np.zeros(1))


def distinct_points(points: np.ndarray, errors: np.ndarray, most: int) -> DistinctSolutions:
    """Projective points of unit norm, each once, and at most so many; their radii are errors."""

    def as_keys(x: np.ndarray, off: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        return x, x, off

    distinct = DistinctSolutions(points[:0], points[:0], errors[:0], as_keys, equal_pairs, most)
    distinct.add(points, errors)
    return distinct


def equal_pairs(points: np.ndarray, errors: np.ndarray) -> np.ndarray:
    """Pairs ``i < j`` of projective points of unit norm that are one, shape ``(pairs, 2)``."""
    return coinciding_pairs((range(points.shape[1]),), points, errors)


def find_by_loops(
    system: GenericSystem,
    most: int,
    rng: np.random.Generator,
    threads: int,
    complete: Callable[[np.ndarray], bool] | None = None,
) -> tuple[GenericSystem, int, bool]:
    """The system with further solutions, the number of paths, and whether ``complete`` said so.

    The search ends with ``most`` solutions, or when many loops find no more.

    Args:
        system: at least one of its solutions is known.
        most: how many solutions there are, or how many of them are wanted at most.
        rng: where the other coefficients of the loops come from.
        threads: number of threads.
        complete: tells whether given solutions are all; asked where a loop found no more.
    """
    n = len(system.supports)
    groups = (tuple(range(n)),)
    degrees = group_degrees(system.rows, groups)
    first = homogenize_rows(system.rows, n, groups, degrees)
    here = distinct_points(system.points, system.errors, most)
    spent, idle = 0, 0

    def move(homotopy: Homotopy, points: np.ndarray) -> Ends:
        nonlocal spent
        spent += len(points)
        ends = track_regular(homotopy, points, find_settings("fast"), threads)
        return ends.points, ends.errors

    for _ in range(MOST_LOOPS):
        if len(here.points) >= most or idle >= MOST_IDLE:
            break
        if idle % 2 == 0 and (idle or not spent):
            # On the line through two systems few loops may be of use, be there ever so many.
            other = replace(system, coefficients=tuple(unit(rng, len(s)) for s in system.supports))
            second = homogenize_rows(other.rows, n, groups, degrees)
            there = distinct_points(system.points[:0], system.errors[:0], most)
        known = max(len(here.points), len(there.points))
        gamma = complex(unit(rng, 1)[0])
        out = partial(move, straight_line(first, second, gamma))
        back = partial(move, straight_line(second, first, 1 / gamma))
        run_loop(here, there, out, back)
        idle = 0 if max(len(here.points), len(there.points)) > known else idle + 1
        # The question costs as much as a loop: after 1, 3, 7 loops in vain.
        if idle and not idle & (idle + 1) and complete is not None and complete(here.points):
            return system.holding(here.points, here.radii), spent, True
    return system.holding(here.points, here.radii), spent, False


def start_at(
    name: str, target: Target, system: GenericSystem, detail: str, gamma: complex
) -> StartSystem:
    """The homotopy from ``system``, all of whose solutions are known, to ``target``."""
    groups = (tuple(range(target.n)),)
    degrees = group_degrees(system.rows, groups)
    begin = homogenize_rows(system.rows, target.n, groups, degrees)
    goal = homogenize_rows(target.rows, target.n, groups, degrees)
    return StartSystem(
        name, straight_line(begin, goal, gamma), system.points, groups, detail=detail
    )
