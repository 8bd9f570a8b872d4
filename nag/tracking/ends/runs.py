"""Runs of the kernel that follows paths in more digits, over batches of them.

Where coordinates leave the range of doubles, each is taken over a power of two. A word of a number
is a double, which is nothing below 1e-308: a product of seven coordinates of 1e-43 has no second
word any more, and a row of such products no Jacobian. Over powers of two near their sizes all
coordinates are about one, and so are the rows, over powers of their own; nothing is rounded by
that. In logarithms of the coordinates, that is all that changes.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING

import numpy as np

from nag.machine_code.records import Table, replaced
from nag.tracking import evaluations
from nag.tracking.ends import records
from nag.tracking.homotopy import Homotopy
from nag.tracking.settings import Settings

if TYPE_CHECKING:
    from nag.tracking.ends.end_run import EndBatch
    from nag.tracking.ends.follow import States

# Binary exponents of doubles, and bits of a word.
EXPONENTS, WORD = 1022, 53
# Order of the Taylor coefficients, by words. Where 64 digits do not do, other paths are so near
# that a prediction must hold to some 50 digits: twice the order then makes a quarter of the steps.
ORDER = {2: 14, 4: 14, 8: 28}
# The same where paths run so close together that they are followed in more digits throughout.
CLOSE_ORDER = {2: 14, 4: 28, 8: 28}
# Steps to an end that must hold to the least number of digits, and those of a path that is lost on
# the way there.
MAX_STEPS, MOST_STEPS = 300, 3000
# Steps of a path in 120 digits: ends that these decide take ten, and ten more each time that they
# are looked for once more further in; each is some 50 times as dear.
LAST_STEPS = 40
MAX_WINDING = 40
# Expected error of a prediction, and largest contraction of Newton's method after it, as parts of
# those of the settings.
ACCURACY, CONTRACTION = 0.1, 0.3
# Decides: Last terms of a path's power series that is taken to converge, for the winding number in
# question.
TAIL = 1e-11


def run(
    homotopy: Homotopy,
    states: States,
    chosen: np.ndarray,
    words: int,
    settings: Settings,
    threads: int,
) -> np.ndarray:
    """Run the kernel; what it extrapolated for the chosen paths that converged to limits."""
    from nag.tracking.ends import end_run

    compiled = end_run.KERNELS[words]
    compiled.prepare()
    order = states.orders[words]
    system = records.equations(homotopy, words, order)
    limits = np.zeros((len(chosen), homotopy.N, 4, 2, words))
    powers = powers_of_two(homotopy, states.where[chosen], states.met[chosen] > 0)

    def part(places: np.ndarray, own: Table = system, shift: np.ndarray | None = None) -> int:
        batch = _batch(homotopy, states, chosen[places], words, settings, shift)
        compiled(own, records.room(homotopy, words, order), batch)
        _keep(states, chosen[places], batch, shift)
        limits[places] = batch.limits.reshape(len(places), *limits.shape[1:])
        return int(batch.evaluations.sum())

    apart = powers.any(axis=1)
    within = np.flatnonzero(~apart)
    batches = max(1, min(threads, len(within) // 8))
    if batches == 1:
        spent = part(within) if len(within) else 0
    else:
        with ThreadPoolExecutor(batches) as pool:
            spent = sum(pool.map(part, [within[first::batches] for first in range(batches)]))
    for place in np.flatnonzero(apart).tolist():
        own = scale_equations(system, homotopy, powers[place])
        spent += part(np.array([place]), own, powers[place])
    evaluations.count(spent, words)
    return limits


def _batch(
    homotopy: Homotopy,
    states: States,
    own: np.ndarray,
    words: int,
    settings: Settings,
    shift: np.ndarray | None,
) -> EndBatch:
    """Some paths from where they are, and room for where they get to.

    Args:
        shift: binary logarithms over which coordinates are, shape ``(N,)``.
    """
    from nag.tracking.ends.end_run import EndBatch

    count, N = len(own), homotopy.N
    most = states.most[own]
    if words == max(ORDER):
        most = np.maximum(1, most - states.steps[own])
    ends, where, safe = (_over(x[own], shift) for x in (states.ends, states.where, states.safe))
    return EndBatch(
        count=count,
        order=states.orders[words],
        ends=ends.ravel(),
        tried=states.tried[own],
        straight=states.straight[own],
        rough=states.rough[own],
        rough_ends=(states.steps[own] == 0).astype(np.int64),
        starts=where.ravel(),
        t=states.t[own].ravel(),
        latest=states.latest[own],
        outcome=np.zeros(count, dtype=np.int64),
        winding=np.zeros(count, dtype=np.int64),
        steps=np.zeros(count, dtype=np.int64),
        evaluations=np.zeros(count, dtype=np.int64),
        points=where.flatten(),
        safe=safe.ravel(),
        safe_t=states.safe_t[own].ravel(),
        limits=np.zeros(count * N * 4 * 2 * words),
        errors=np.zeros(count * N),
        met=states.met[own].ravel(),
        curvature=states.curvature[own],
        max_steps=np.where([path in states.limits for path in own.tolist()], 0, most),
        max_winding=MAX_WINDING,
        close=int(states.close),
        accuracy=ACCURACY * settings.tolerance,
        contraction=CONTRACTION * settings.contraction,
        tail=TAIL,
        radius_factor=settings.radius_factor,
    )


def _over(points: np.ndarray, shift: np.ndarray | None) -> np.ndarray:
    """Coordinates, shape ``(P, N, 2, words)``, over powers of two.

    Those of points that are elsewhere may leave the range: nothing is then gained by trying these.
    """
    if shift is None:
        return points.copy()
    with np.errstate(over="ignore", under="ignore"):
        return np.ldexp(points, -shift[:, None, None])


def _keep(states: States, own: np.ndarray, batch: EndBatch, shift: np.ndarray | None) -> None:
    """What a run says of its paths."""
    from nag.tracking.ends import end_run

    count = len(own)
    back = None if shift is None else -shift
    shape = (count, *states.where.shape[1:])
    points, safe = (_over(x.reshape(shape), back) for x in (batch.points, batch.safe))
    states.outcome[own], states.winding[own] = batch.outcome, batch.winding
    states.steps[own] += batch.steps
    regular = batch.outcome == end_run.REGULAR
    states.found |= {int(own[k]): points[k] for k in np.flatnonzero(regular)}
    states.where[own[~regular]] = points[~regular]
    errors = batch.errors.reshape(count, -1)
    states.errors[own] = errors if shift is None else np.ldexp(errors, shift)
    states.met[own] = batch.met.reshape(count, -1)
    states.safe[own] = safe
    states.safe_t[own] = batch.safe_t.reshape(count, -1)
    states.t[own], states.curvature[own] = batch.t.reshape(count, -1), batch.curvature
    states.tried[own] = 1
    states.rough[own] = batch.rough


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


def scale_equations(equations: Table, homotopy: Homotopy, powers: np.ndarray) -> Table:
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
    known = equations.record
    A0, A1 = (A.reshape(-1, homotopy.N, 2) for A in (known.A0, known.A1))
    largest = np.where((A0 != 0).any(axis=2) | (A1 != 0).any(axis=2), powers, np.iinfo(int).min)
    lines = (powers - largest.max(axis=1, initial=np.iinfo(int).min)[:, None])[:, :, None]
    return replaced(
        equations,
        value=_shift_numbers(known.value, values),
        jacobian=_shift_numbers(known.jacobian, [k for _, _, own in blocks for k in own]),
        A0=np.ldexp(A0, np.minimum(lines, 0)).ravel(),
        A1=np.ldexp(A1, np.minimum(lines, 0)).ravel(),
    )


def _shift_numbers(numbers: np.ndarray, shifts: list[int]) -> np.ndarray:
    """Numbers, several words each, times powers of two."""
    if not shifts:
        return numbers
    words = numbers.reshape(len(shifts), -1)
    return np.ldexp(words, np.array(shifts)[:, None]).ravel()
