"""Newton's method in doubles, for many points at once: until its steps are rounding.

A step at a point x solves ``F'(x) s = F(x)``: by least squares where there are more equations than
unknowns, and the shortest one where the Jacobian's rank is less than the number of unknowns, as it
is on sets of zeros. It is Gauss's method then. Steps are rounding where they are as short as
doubles let them be, and where short ones no longer shrink, as at badly conditioned points.

Whether a zero is regular, and how well it is known, is for the caller to see. From afar steps are
damped (`nag.witness.gauss_newton`); balls have a method of their own (`nag.numerics.newton`), and
paths have one in their kernels.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from nag.numerics.doubles import ARRIVED, NEWTON_STEPS, SHARP

# Part of the one before that a step is which rounding keeps from shrinking.
STALLED = 0.5
# The same of a step after which a Jacobian need not be worked out anew.
SHRUNK = 1e-3

# Values and Jacobians at points, shapes ``(k, m)`` and ``(k, m, n)``. The second argument says
# which of all points these are, by their indices.
Equations = Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]]
Values = Callable[[np.ndarray, np.ndarray], np.ndarray]
# How many singular values count, shape ``(k,)``, of which in falling order, shape ``(k, r)``.
Ranks = Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True, eq=False)
class Stop:
    """Which steps are the last, by their lengths beside the point's, or beside one.

    Attributes:
        arrived: those below are rounding.
        rounding: those below are that hardly shrink; a number, or one for each point.
        longest: those above lead nowhere.
        shrinking: those lead nowhere, too, that are more than this times the one before, unless
            they are rounding.
    """

    arrived: float = ARRIVED
    rounding: float | np.ndarray = SHARP
    longest: float = 1.0
    shrinking: float = np.inf


ROUNDING = Stop()
# Zeros are looked for wherever steps lead.
ANYWHERE = Stop(longest=np.inf)


@dataclass(frozen=True, eq=False)
class NewtonEnds:
    """Where Newton's method has led to from each of some points.

    Attributes:
        x: the points, shape ``(P, n)``; of one that went astray, the last one before.
        converged: whether steps became rounding, shape ``(P,)``.
        first, last: lengths of the first and of the last step, shape ``(P,)``; the last is infinite
            where it leads nowhere.
    """

    x: np.ndarray
    converged: np.ndarray
    first: np.ndarray
    last: np.ndarray


def count_above(share: float) -> Ranks:
    """How many singular values are larger than a share of the largest."""
    return lambda s: np.asarray((s > share * s[:, :1]).sum(axis=1))


@np.errstate(all="ignore")
def find_zeros(
    equations: Equations,
    x: np.ndarray,
    steps: int = NEWTON_STEPS,
    rank: int | Ranks | None = None,
    stop: Stop = ROUNDING,
    units: Callable[[np.ndarray], np.ndarray] | None = None,
    values: Values | None = None,
) -> NewtonEnds:
    """Where Newton's method leads to from points, by so many steps at most.

    Args:
        equations: values and Jacobians.
        x: the points, shape ``(P, n)``.
        rank: of Jacobians, or what tells it from their singular values; all columns if left out.
        stop: which steps are the last.
        units: of the coordinates at points, shape ``(k, n)``, if each is to be known beside its
            own. Jacobians and the lengths of steps are in these, but for the longest.
        values: those of the equations alone. With them a Jacobian is kept, by its pseudo-inverse,
            after steps that shrank by much.
    """
    x = np.array(x)
    first, last = np.zeros(len(x)), np.full(len(x), np.inf)
    converged, rounding = np.zeros(len(x), dtype=bool), np.zeros(len(x)) + stop.rounding
    left, kept = np.arange(len(x)), np.zeros(len(x), dtype=bool)
    inverses: np.ndarray | None = None
    for k in range(steps):
        if not len(left):
            break
        here, before = x[left], last[left]
        if values is None:
            step = _solve(*equations(here, left), rank)
        else:
            new = ~kept[left]
            if new.any():
                value, jacobians = equations(here[new], left[new])
                back, scales, adjoint = _factor_inverses(jacobians, rank)
                found = back @ (scales * adjoint)
                if inverses is None:
                    inverses = np.empty((len(x), *found.shape[1:]), dtype=found.dtype)
                inverses[left[new]] = found
            assert inverses is not None
            if not new.all():
                value = values(here, left)
            step = (inverses[left] @ value[:, :, None])[:, :, 0]
        size, lengths, moved = np.maximum(1.0, _lengths(here)), _lengths(step), step
        if units is None:
            beside = ways = lengths / size
        else:
            moved = units(here) * step
            beside, ways = lengths, _lengths(moved) / size
        near = (ways <= stop.longest) & (lengths < np.inf)
        x[left[near]] = (here - moved)[near]
        small, short = beside < stop.arrived, beside < rounding[left]
        if stop.shrinking < np.inf:
            near &= (lengths <= stop.shrinking * before) | small | short
        converged[left] = rests = near & (small | (short & (lengths > STALLED * before)))
        if k == 0:
            first = lengths
        last[left] = np.where(near, lengths, np.inf)
        if values is not None:
            kept[left] = lengths <= SHRUNK * before
        left = left[near > rests]
    return NewtonEnds(x, converged, first, last)


@np.errstate(all="ignore")
def newton_steps(
    values: np.ndarray, jacobians: np.ndarray, rank: int | Ranks | None = None
) -> np.ndarray:
    """Newton's steps at points, to be subtracted, shape ``(P, n)``; not finite where singular.

    Args:
        values, jacobians: shapes ``(P, m)`` and ``(P, m, n)``.
        rank: see `find_zeros`.
    """
    return _solve(values, jacobians, rank)


def _lengths(rows: np.ndarray) -> np.ndarray:
    return np.asarray(np.sqrt(np.einsum("pi,pi->p", rows, rows.conj()).real))


def _solve(values: np.ndarray, jacobians: np.ndarray, rank: int | Ranks | None) -> np.ndarray:
    if rank is not None:
        back, scales, adjoint = _factor_inverses(jacobians, rank)
        return np.asarray((back @ (scales * (adjoint @ values[:, :, None])))[:, :, 0])
    if jacobians.shape[1] == jacobians.shape[2]:
        try:
            return np.asarray(np.linalg.solve(jacobians, values[:, :, None])[:, :, 0])
        except np.linalg.LinAlgError:
            # One of them is singular, the others may not be.
            pass
    q, r = np.linalg.qr(jacobians)
    products = q.conj().transpose(0, 2, 1) @ values[:, :, None]
    safe = np.abs(np.diagonal(r, axis1=1, axis2=2)).min(axis=1, initial=np.inf) > 0
    steps = np.full(products.shape[:2], np.nan, dtype=products.dtype)
    if safe.any():
        steps[safe] = np.linalg.solve(r[safe], products[safe])[:, :, 0]
    return steps


def _factor_inverses(
    jacobians: np.ndarray, rank: int | Ranks | None
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Factors, the second one of scales, whose product takes values to the shortest steps."""
    finite = np.isfinite(jacobians)
    broken = None if finite.all() else ~finite.all(axis=(1, 2))
    if broken is not None:
        jacobians = np.where(broken[:, None, None], 0, jacobians)
    u, s, vh = np.linalg.svd(jacobians, full_matrices=False)
    scales = 1 / s
    if callable(rank):
        scales[np.arange(s.shape[1]) >= rank(s)[:, None]] = 0
    elif rank is not None:
        scales[:, rank:] = 0
    if broken is not None:
        scales[broken] = np.nan
    return vh.conj().transpose(0, 2, 1), scales[:, :, None], u.conj().transpose(0, 2, 1)
