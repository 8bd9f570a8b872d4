"""All solutions of a family for random parameters, up to symmetry, by monodromy from one of them.

One solution comes with its parameters: Newton's method leads from a random point to a zero of the
equations in unknowns and parameters together. If these zeros form one irreducible set, loops of
parameters lead from any solution to any other (Duff, Hill, Jensen, Lee, Leykin & Sommars, 2019).
Solutions that symmetries carry to each other move together, so that one of each class is followed.

Between the same two systems there are as many ways as the family has scalings: the scaled second
system has the scaled solutions. Where it has none, and once nothing new is found, a way leads
through a further system with random parameters.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.family import Family
from nag.algebra.symmetric_family import SymmetricFamily
from nag.errors import StartError
from nag.numerics.double_newton import ANYWHERE, count_above, find_zeros
from nag.numerics.double_ranks import is_regular
from nag.numerics.doubles import ARRIVED, VANISHING
from nag.numerics.newton import STEPS
from nag.solving.parameter_line import parameter_line
from nag.solving.solution_classes import distinct_classes
from nag.solving.start.monodromy_loops import Ends, Way, run_loop
from nag.solving.start.scalings import random_scaling, scaling_weights
from nag.solving.start.target import unit
from nag.solving.start.total_degree import MOST_PATHS
from nag.tracking.paths import PathStatus
from nag.tracking.settings import find_settings
from nag.tracking.track import track

Progress = Callable[[str, int, int], None]

# Loops in vain after which the search ends, if the number of solutions is the known one and if none
# is known; and loops in all.
CONFIRMING, IDLE = 3, 8
MOST_LOOPS = 120
# Random points that are tried for a first solution.
SEEDS = 200
# A loop that loses a path finds it again later, so that nothing is tracked twice. Points that are
# sharper than for other paths save more steps than they cost, and more paths arrive.
SHARP = 1e-9
SETTINGS = replace(find_settings("fast"), retries=0, newton=SHARP)


@dataclass(frozen=True, eq=False)
class FoundByMonodromy:
    """Solutions of a family for random parameters, in inner coordinates.

    Attributes:
        values: the parameters, shape ``(k,)``.
        points: one solution of each class, shape ``(P, n)``.
        loops: how many loops there were; idle: how many of the last ones found nothing new.
        paths, steps: numbers of paths and steps of all loops.
        lost: paths that did not arrive.
    """

    values: np.ndarray
    points: np.ndarray
    loops: int
    idle: int
    paths: int
    steps: int
    lost: int


def random_values(family: Family, rng: np.random.Generator) -> np.ndarray:
    """Random complex parameters of absolute values between 1/2 and 3/2."""
    count = len(family.parameters)
    return unit(rng, count) * (0.5 + rng.random(count))


def first_solution(family: Family, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Parameters and a regular solution for them, from random points by Newton's method.

    Raises:
        StartError: if none is found.
    """
    n, size = family.n, family.n + len(family.parameters)
    evaluator = Evaluator.of(family.polynomials, size)
    slopes = evaluator.placed_derivatives(size)
    for _ in range(SEEDS):
        start = unit(rng, size) * (0.5 + rng.random(size))
        ends = find_zeros(
            lambda z, _: (evaluator.values(z), slopes(z)),
            start[None],
            STEPS,
            count_above(ARRIVED),
            ANYWHERE,
        )
        (z,) = ends.x
        if not np.isfinite(ends.last[0]) or evaluator.residuals(z[None]).max() > VANISHING:
            continue
        if family.imaginary and z[n - 1].imag < 0:
            # The equations are real: the conjugate has i for the unit.
            z = z.conj()
        if is_regular(evaluator.jacobian(z)[:, :n]):
            return z[n:], z[:n]
    raise StartError("parameter: no regular solution was found by Newton's method")


def family_monodromy(
    symmetric: SymmetricFamily,
    rng: np.random.Generator,
    threads: int = 1,
    count: int | None = None,
    progress: Progress | None = None,
) -> FoundByMonodromy:
    """Solutions for random parameters, one of each class, until loops find no more.

    Args:
        symmetric: the family and the symmetries of its solutions.
        rng: where parameters and loops come from.
        threads: number of threads.
        count: number of classes, if it is known; then fewer loops in vain end the search.
        progress: called with a stage, the number of classes and ``count`` or 0.

    Raises:
        StartError: if no first solution is found, or there are too many.
    """
    family = symmetric.family
    values, point = first_solution(family, rng)
    here = distinct_classes(values, symmetric, point[None], np.zeros(1))
    further = random_values(family, rng)
    there = distinct_classes(further, symmetric, point[None][:0], np.zeros(0))
    weights = scaling_weights(family)
    tally = _Tally()
    idle = 0
    while tally.loops < MOST_LOOPS:
        if progress:
            progress("monodromy", len(here.points), count or 0)
        move = partial(tally.move_points, family, threads)
        ways = _ways(family, values, further, weights, idle, move, rng)
        gained = run_loop(here, there, *ways)
        tally.loops += 1
        if len(here.points) * len(symmetric) > MOST_PATHS:
            raise StartError(f"parameter: more than {MOST_PATHS} solutions")
        idle = 0 if gained else idle + 1
        known = count is not None and len(here.points) == len(there.points) == count
        # Where fewer than are known were found, all loops are run.
        if idle >= (CONFIRMING if known else IDLE if count is None else MOST_LOOPS):
            break
    return FoundByMonodromy(
        values, here.points, tally.loops, idle, tally.paths, tally.steps, tally.lost
    )


Move = Callable[[np.ndarray, np.ndarray, np.ndarray], Ends]


def _ways(
    family: Family,
    here: np.ndarray,
    there: np.ndarray,
    weights: np.ndarray,
    idle: int,
    move: Move,
    rng: np.random.Generator,
) -> tuple[Way, Way]:
    """A way between the systems of two values of the parameters, and back.

    Args:
        idle: how many ways before led to nothing new. The longer that lasts, the farther the ways
            lead: where solutions meet may be at larger parameters than the random ones.
    """
    n = family.n
    if len(weights) and not idle:
        scale = random_scaling(weights, rng)
        x, scaled = scale[:n], there * scale[n:]

        def scaled_back(points: np.ndarray) -> Ends:
            ends, errors = move(here, scaled, points)
            return ends / x, errors

        return scaled_back, lambda points: move(scaled, here, points * x)
    by = random_values(family, rng) * 2.0 ** (max(idle - 1, 0) % IDLE)
    return (
        lambda points: move(by, there, move(here, by, points)[0]),
        lambda points: move(by, here, move(there, by, points)[0]),
    )


@dataclass
class _Tally:
    """What the loops have cost so far."""

    loops: int = 0
    paths: int = 0
    steps: int = 0
    lost: int = 0

    def move_points(
        self,
        family: Family,
        threads: int,
        first: np.ndarray,
        second: np.ndarray,
        points: np.ndarray,
    ) -> Ends:
        """Solutions moved from the first parameters to the second but for lost ones, and errors."""
        if not len(points):
            return points, np.zeros(0)
        line = parameter_line(family, first, second)
        paths = track(
            line.homotopy, line.starts(points), SETTINGS, threads, endgame=False, distinct=False
        )
        arrived = paths.where(PathStatus.REGULAR)
        ends = line.affine(paths.points[arrived])
        self.paths += len(points)
        self.steps += int(paths.steps.sum())
        self.lost += len(points) - len(arrived)
        finite = np.isfinite(ends).all(axis=1)
        return ends[finite], paths.accuracy[arrived][finite]
