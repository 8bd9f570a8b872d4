"""Witness sets asked with what users have at hand: a generator, exact or rounded points."""

from __future__ import annotations

import numbers
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.from_python import coordinates
from nag.algebra.given import check_whole
from nag.algebra.number import Irrational, is_zero
from nag.algebra.system import PolynomialSystem
from nag.errors import NagError
from nag.tracking.run import Run
from nag.witness.given_component import rounded
from nag.witness.membership import Membership, UndecidedError, memberships
from nag.witness.sampling import sample
from nag.witness.witness import Decomposition, PathCounts, WitnessSet

# A point that satisfies the equations so well, relative to their terms, is taken for a rounded one.
ROUNDED = 1e-9
# Relative error of an exact point that is rounded to doubles, and least one of others.
EXACT, INEXACT = 1e-15, 1e-12


def sampled(
    system: PolynomialSystem,
    component: WitnessSet,
    rng: np.random.Generator | int,
    count: int,
    run: Run,
) -> np.ndarray:
    """Points of a component, see `WitnessSet.sample`."""
    check_whole(count, "count")
    if isinstance(rng, numbers.Integral) and not isinstance(rng, bool) and rng >= 0:
        seed = int(rng)
    elif isinstance(rng, np.random.Generator):
        seed = int(rng.integers(2**63))
    else:
        raise NagError(f"rng: {rng!r} is given; give numpy.random.default_rng(), or a seed")
    found = sample(system, component, int(count), run=replace(run, seed=seed))
    return found.points


def rounded_error(system: PolynomialSystem, at: np.ndarray) -> float | None:
    """The relative error that a zero known to rounding may have; None if the point is none."""
    evaluator = Evaluator.of(system.polynomials, system.n)
    residual = float(evaluator.residuals(at[None]).max(initial=0.0))
    return max(INEXACT, 10 * residual) if residual < ROUNDED else None


def contains(
    system: PolynomialSystem,
    component: WitnessSet,
    point: Any,
    accuracy: float | None,
    run: Run,
) -> bool:
    """Whether a point lies on a component, see `WitnessSet.contains`."""
    entries = coordinates(point, system.variables)
    exact = all(isinstance(e, Fraction | Irrational) for e in entries)
    at = rounded(entries)
    if exact:
        if not all(is_zero(value) for value in system(entries)):
            return False
        accuracy = EXACT
    else:
        evaluator = Evaluator.of(system.polynomials, system.n)
        residual = float(evaluator.residuals(at[None]).max(initial=0.0))
        if residual > max(ROUNDED, accuracy or 0.0):
            return False
        accuracy = max(INEXACT, 10 * residual) if accuracy is None else accuracy
    alone = Decomposition(system, (component,), PathCounts(), 0, "default", (), False)
    known = entries if exact else ()
    (answer,) = memberships(alone, at, accuracy=accuracy, exact=known, run=run)
    if answer is Membership.UNDECIDED:
        raise UndecidedError([], [0])
    return answer is Membership.MEMBER
