"""Paths that doubles leave doubtful, followed to their ends in as many digits as these need."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields

import numpy as np

from nag.numerics.array_table import ArrayTable
from nag.numerics.doubles import ROUNDED, SLACK
from nag.numerics.zero_values import NONZERO
from nag.tracking import blocks
from nag.tracking.ends.at_infinity import at_infinity
from nag.tracking.ends.inclusion import prove_end
from nag.tracking.ends.limits import BEYOND, LEAST_EVIDENCE, Limit, Limits, digits_of_evidence
from nag.tracking.ends.runs import CLOSE_ORDER, LAST_STEPS, MAX_STEPS, MOST_STEPS, ORDER, run
from nag.tracking.ends.terms import Terms
from nag.tracking.evaluations import count_evaluations, count_known, count_proof
from nag.tracking.homotopy import Homotopy
from nag.tracking.kernel_arrays import equations
from nag.tracking.newton import refine
from nag.tracking.paths import Ball, PathBranch, Paths, PathStatus, Reason
from nag.tracking.projective import ROUNDING
from nag.tracking.settings import Settings

# Called with numbers of paths: ended, at infinity, failed.
Told = Callable[[int, int, int], None]
# Digits of numbers of as many words.
DIGITS = {2: 32, 4: 64, 8: 120}
# Decides: Residual of a limit over that of the last one, further out: more is rounding, if it may
# be that of a zero, and asks for more digits.
GAINED = 0.1
# Rounding over the wanted residual that asks for more digits as well.
NOISE = 1e-3
# Paths of a block.
BLOCK = 16
# Paths that are followed before it is told how many have ended: a second's work, or less.
STRETCH = 128
# Part of t at which a limit is looked for next, where nothing is known of it, and the least.
FURTHER, FURTHEST = 1e-3, 1e-8


@dataclass(eq=False)
class States:
    """Where the paths are, and what is known of their ends.

    ``where, t``: the last points; ``safe, safe_t``: the last ones that are known well;
    ``found``: regular ends; ``limits``: others, or where they are tried as regular ones first.
    ``straight``: 0 where Newton's method at t = 0 is of no use; ``rough``: 1 where ``safe`` is
    known to the digits of doubles only; ``regular``: where the first trial needs no proof;
    ``last``: the limits that were looked at last; ``affine``: those
    that are infinite only if a variable vanishes there, which is not known; ``most``: steps;
    ``met``: 1 for coordinates that have exceeded their rounding errors;
    ``starts``: points at t = 1, of those that have gone on from others; ``close``: whether other
    paths run beside these.
    """

    where: np.ndarray
    t: np.ndarray
    safe: np.ndarray
    safe_t: np.ndarray
    latest: np.ndarray
    curvature: np.ndarray
    ends: np.ndarray
    tried: np.ndarray
    straight: np.ndarray
    rough: np.ndarray
    regular: np.ndarray
    outcome: np.ndarray
    winding: np.ndarray
    steps: np.ndarray
    digits: np.ndarray
    errors: np.ndarray
    met: np.ndarray
    limits: dict[int, Limit]
    found: dict[int, np.ndarray]
    last: dict[int, Limit]
    affine: dict[int, Limit]
    most: np.ndarray
    starts: np.ndarray | None = None
    close: bool = False

    @classmethod
    def from_start(cls, starts: np.ndarray, curvature: np.ndarray) -> States:
        """Paths at t = 1, at points in words, shape ``(P, N, 2, words)``."""
        P, N, _, words = starts.shape
        states = cls.of(np.zeros((P, N)), np.zeros(P, bool), np.zeros((P, N)), np.ones(P))
        states.where, states.safe, states.ends = starts.copy(), starts.copy(), starts.copy()
        states.t = np.tile(np.eye(1, words), (P, 1))
        states.safe_t = states.t.copy()
        states.curvature, states.most[:], states.close = curvature.copy(), MOST_STEPS, True
        return states

    @classmethod
    def of(cls, ends: np.ndarray, reached: np.ndarray, safe: np.ndarray, t: np.ndarray) -> States:
        P, N = safe.shape
        whole = [np.zeros(P, dtype=np.int64) for _ in range(4)]
        return cls(
            _in_words(safe),
            np.stack([t, np.zeros(P)], axis=1),
            _in_words(safe),
            np.stack([t, np.zeros(P)], axis=1),
            np.ones(P),
            np.ones(P),
            _in_words(ends),
            np.where(reached, 0, 1),
            np.ones(P, dtype=np.int64),
            np.ones(P, dtype=np.int64),
            np.zeros(P, dtype=bool),
            *whole,
            np.zeros((P, N)),
            np.zeros((P, N)),
            {},
            {},
            {},
            {},
            np.full(P, MAX_STEPS),
        )

    def lengthen(self, words: int) -> None:
        """Numbers of so many words; the next arithmetic starts from what is known well.

        How far in a limit is to be looked for was said by points that are left.
        """
        room = ((0, 0), (0, 0), (0, 0), (0, words - self.where.shape[-1]))
        self.ends, self.safe = np.pad(self.ends, room), np.pad(self.safe, room)
        self.safe_t = np.pad(self.safe_t, room[2:])
        self.where, self.t = self.safe.copy(), self.safe_t.copy()
        self.latest[:] = 1.0

    def from_its_start(self, path: int, words: int) -> bool:
        """Put a path to its start, if it was lost where doubles left it: that is no point of it."""
        if self.starts is None or self.safe_t[path, 0] == 1 or self.met[path].any():
            return False
        self.where[path] = self.safe[path] = _in_words(self.starts[[path]], words)[0]
        self.t[path] = self.safe_t[path] = np.eye(1, words)[0]
        self.met[path], self.most[path], self.rough[path] = 0.0, MOST_STEPS, 1
        return True

    def point(self, path: int) -> np.ndarray:
        """Coordinates where the path is, as doubles."""
        parts = self.found.get(path, self.where[path]).sum(axis=-1)
        return parts[:, 0] + 1j * parts[:, 1]

    @property
    def orders(self) -> dict[int, int]:
        """Order of the Taylor coefficients, by words."""
        return CLOSE_ORDER if self.close else ORDER

    def astray(self, path: int) -> bool:
        """Whether a path has gone on from the last point that was known well, in rounding errors.

        Newton's constant, estimated from these, may then seem small, and steps are without end.
        """
        return bool(self.safe_t[path, 0] > self.t[path, 0])

    def known_coordinates(self, path: int) -> np.ndarray:
        """Which coordinates exceed their rounding errors."""
        return np.abs(self.point(path)) > SLACK * self.errors[path]


def _in_words(points: np.ndarray, words: int = 2) -> np.ndarray:
    """Complex doubles as sums of doubles, shape ``(P, N, 2, words)``."""
    result = np.zeros((*points.shape, 2, words))
    result[..., 0, 0], result[..., 1, 0] = points.real, points.imag
    return result


@dataclass(frozen=True, eq=False)
class Unfinished(ArrayTable):
    """Paths as straight runs in doubles left them.

    Attributes:
        ends: where the runs ended, at t = 0 where ``reached``, shape ``(P, N)``.
        regular: which of these ends are known to be regular ones, be they at infinity.
        safe: points of the paths at ``t``, shape ``(P, N)``.
        starts: their points at t = 1, shape ``(P, N)``.
    """

    ends: np.ndarray
    reached: np.ndarray
    regular: np.ndarray
    safe: np.ndarray
    t: np.ndarray
    starts: np.ndarray


def follow(
    homotopy: Homotopy,
    unfinished: Unfinished,
    settings: Settings,
    threads: int = 1,
    told: Told | None = None,
) -> Paths:
    """Follow paths from safe points to their ends.

    Args:
        homotopy: what to track.
        settings: how many digits may be used, and how many are evidence.
        threads: number of threads; the result does not depend on it.
        told: called now and then with how many paths have ended, at infinity, and failed.

    Returns:
        The paths; those whose ends ask for more digits have failed.
    """
    left = unfinished
    states = States.of(left.ends, left.reached, left.safe, left.t)
    states.regular[:], states.starts = left.regular, left.starts
    # An end that must hold to more digits is looked for as much further in.
    asked = digits_of_evidence(homotopy, settings.evidence)[0]
    states.most[:] = MAX_STEPS * asked // LEAST_EVIDENCE
    # What doubles lost on the way may have come close to other paths there.
    states.most[left.t > settings.radius] = MOST_STEPS
    pending = np.arange(len(left.safe))
    count = None if told is None else _Count(told, np.zeros(len(pending), dtype=bool))
    for words, digits in DIGITS.items():
        if not len(pending) or digits > settings.digits:
            break
        pending = _follow_in(homotopy, states, pending, words, settings, threads, count)
    if count is not None:
        count.add(homotopy, states, pending)
    return _paths(homotopy, states)


def follow_doubtful(
    homotopy: Homotopy,
    unfinished: Unfinished,
    settings: Settings,
    threads: int = 1,
    told: Told | None = None,
) -> Paths:
    """The same, in blocks where these are kept or shared."""
    if not blocks.in_blocks():
        return follow(homotopy, unfinished, settings, threads, told)
    columns = [getattr(unfinished, each.name) for each in fields(unfinished)]
    calls = [
        (homotopy, *(column[k : k + BLOCK] for column in columns), settings)
        for k in range(0, len(unfinished.safe), BLOCK)
    ]
    ends = []
    for arrays, here in blocks.work_out(block_of_ends, calls, "ends in more digits", threads):
        if not here:
            number, work = arrays["evaluations"].tolist()
            count_known(number, work)
            used = int(arrays["precision"].max(initial=0))
            for words, digits in DIGITS.items():
                if digits <= used:
                    equations(homotopy, words)
        ends.append(Paths.from_arrays(arrays))
    return Paths.concatenate(ends)


def block_of_ends(
    homotopy: Homotopy,
    ends: np.ndarray,
    reached: np.ndarray,
    regular: np.ndarray,
    safe: np.ndarray,
    t: np.ndarray,
    starts: np.ndarray,
    settings: Settings,
    threads: int = 1,
) -> dict[str, np.ndarray]:
    """A block of paths that doubles left doubtful, and how many evaluations it took."""
    unfinished = Unfinished(ends, reached, regular, safe, t, starts)
    with count_evaluations() as spent:
        found = follow(homotopy, unfinished, settings, threads)
    return {**found.arrays(), "evaluations": np.array([spent.number, spent.work])}


def follow_whole(
    homotopy: Homotopy,
    starts: np.ndarray,
    curvature: np.ndarray,
    settings: Settings,
    threads: int = 1,
) -> Paths:
    """Follow paths from t = 1 on, in the arithmetic that their starts are given in.

    Args:
        starts: points at t = 1 in words, of norms about one, shape ``(P, N, 2, words)``.
        curvature: estimates of Newton's constant there, shape ``(P,)``.

    Returns:
        The paths; those whose ends ask for more digits have failed.
    """
    states = States.from_start(starts, curvature)
    _follow_in(homotopy, states, np.arange(len(starts)), starts.shape[-1], settings, threads)
    return _paths(homotopy, states)


def _follow_in(
    homotopy: Homotopy,
    states: States,
    pending: np.ndarray,
    words: int,
    settings: Settings,
    threads: int,
    count: _Count | None = None,
) -> np.ndarray:
    """Follow paths in one arithmetic; those that need the next one."""
    from nag.tracking.ends import end_run

    if states.where.shape[-1] < words:
        states.lengthen(words)
    if words == max(DIGITS) and not states.close:
        states.most[pending] = states.steps[pending] + LAST_STEPS
    terms = Terms(homotopy)
    limits = Limits(terms, words, states.orders[words])
    needs = [10.0**-digits for digits in digits_of_evidence(homotopy, settings.evidence)]
    more = DIGITS[words] < min(settings.digits, max(DIGITS.values()))
    later: list[int] = []
    while len(pending):
        again: list[int] = []
        for first in range(0, len(pending), STRETCH):
            chosen = pending[first : first + STRETCH]
            found = run(homotopy, states, chosen, words, settings, threads)
            for k, path in enumerate(chosen.tolist()):
                states.digits[path] = DIGITS[words]
                outcome, at_limit = states.outcome[path], path in states.limits
                if at_limit and outcome != end_run.REGULAR:
                    states.outcome[path] = end_run.LIMIT
                elif outcome == end_run.LOST:
                    (again if states.from_its_start(path, words) else later).append(path)
                elif outcome == end_run.TOO_LONG and states.astray(path):
                    later.append(path)
                elif outcome == end_run.LIMIT:
                    verdict = _limit(states, limits, path, found[k], needs)
                    if verdict != end_run.LIMIT:
                        states.outcome[path] = end_run.LOST
                        # A trial at a limit takes one step, and no path is to be lost for that.
                        may_go_on = states.steps[path] < states.most[path] or not states.tried[path]
                        hopeful = verdict == end_run.OPEN and may_go_on
                        (again if hopeful else later).append(path)
                elif outcome == end_run.REGULAR:
                    if not _confirm_end(states, path, terms):
                        # Newton's method converged, but not to a regular zero: go on without it.
                        states.straight[path] = 0
                        states.outcome[path] = end_run.LIMIT if at_limit else end_run.LOST
                        if not at_limit:
                            again.append(path)
                        del states.found[path]
                    elif _ambiguous(homotopy, states, path, needs[0], terms) or (
                        more and _affine_error(homotopy, states, path) > ROUNDED
                    ):
                        states.ends[path], states.tried[path] = states.found.pop(path), 0
                        states.limits.pop(path, None)
                        states.outcome[path] = end_run.LOST
                        later.append(path)
            if count is not None:
                left = [*again, *later] if more else again
                count.add(homotopy, states, np.setdiff1d(chosen, left))
        pending = np.array(again, dtype=np.int64)
    return np.array(sorted(later), dtype=np.int64)


@dataclass
class _Count:
    """Counts paths that have ended, at infinity, and failed, and tells of them."""

    told: Told
    counted: np.ndarray
    infinite: int = 0
    failed: int = 0

    def add(self, homotopy: Homotopy, states: States, ended: np.ndarray) -> None:
        from nag.tracking.ends import end_run

        more = ended[~self.counted[ended]]
        for path in more.tolist():
            known = states.outcome[path] in (end_run.REGULAR, end_run.LIMIT)
            self.failed += not known
            self.infinite += known and not _is_finite(homotopy, states, path)
        self.counted[more] = True
        self.told(int(self.counted.sum()), self.infinite, self.failed)


def _is_finite(homotopy: Homotopy, states: States, path: int) -> bool:
    """Whether the end of a path, which is known, is finite."""
    from nag.tracking.ends import end_run

    infinite = list(homotopy.infinity)
    if states.outcome[path] == end_run.REGULAR:
        return bool(states.known_coordinates(path)[infinite].all())
    return bool((states.limits[path].point[infinite] != 0).all())


def _confirm_end(states: States, path: int, terms: Terms) -> bool:
    """Whether a path's end is a regular zero: as it is known to be, or by a proof, in a box."""
    if states.regular[path] and states.steps[path] == 1:
        return True
    count_proof()
    box = prove_end(terms, states.found[path], states.errors[path])
    if box is not None:
        states.errors[path] = np.minimum(states.errors[path], box)
    return box is not None


def _ambiguous(homotopy: Homotopy, states: States, path: int, need: float, terms: Terms) -> bool:
    """Whether a regular end is at infinity to fewer digits than are needed, or only seems to be."""
    far = [j for j in homotopy.infinity if not states.known_coordinates(path)[j]]
    if not far or float(SLACK * states.errors[path][far].max()) > need:
        return bool(far)
    return not at_infinity(terms, states.found[path], far)


def _affine_error(homotopy: Homotopy, states: States, path: int) -> float:
    """Largest relative error of a coordinate by which others are divided; 0 of an end at infinity.

    A finite end that is far out may be known well as a point of projective space only.
    """
    infinite = list(homotopy.infinity)
    if not states.known_coordinates(path)[infinite].all():
        return 0.0
    sizes = np.abs(states.point(path)[infinite])
    return float((states.errors[path][infinite] / sizes).max(initial=0.0))


def _limit(
    states: States, limits: Limits, path: int, found: np.ndarray, needs: Sequence[float]
) -> int:
    """`LIMIT` if the equations agree, `OPEN` if further in they may, `LOST` in more digits."""
    from nag.tracking.ends import end_run

    known, t, w = states.known_coordinates(path), states.t[path, 0], int(states.winding[path])
    limit = limits.of(states.where[path], found, known, states.t[path], w)
    need = needs[(w & -w).bit_length() - 1]
    if limit is not None and limit.residual <= need and limits.is_affine(limit):
        states.affine[path] = limit
    noise = (states.errors[path][known] / np.abs(states.point(path)[known])).max(initial=0.0)
    before = states.last.get(path)
    if limit is not None and limit.residual <= need and limits.exists(limit, noise):
        if limits.is_believed(limit, before, need):
            states.limits[path] = limit
            states.affine.pop(path, None)
            if limit.winding > 1:
                return end_run.LIMIT
            # No branch point at t = 0: Newton's method is tried at the limit before it counts.
            states.ends[path], states.tried[path] = limit.centre, 0
            return end_run.OPEN
        states.last[path] = limit
        shrink = (need / limit.tail) ** (w / limits.order)
        states.latest[path] = t * min(0.1, max(FURTHEST, shrink))
        return end_run.OPEN
    # Where no digits are gained on the way in, rounding errors are what is left.
    further = np.inf if before is None else before.residual
    residual = np.inf if limit is None else limit.residual
    if limit is not None:
        states.last[path] = limit
    stuck = noise > NOISE * need or GAINED * further < residual < NONZERO
    if stuck and limits.words == 2:
        # Rounding errors do not say how far in a limit is to be looked for.
        return end_run.LOST
    shrink = FURTHER
    if limit is not None:
        # The last term of the series is about the power of r of its order.
        shrink = min(0.1, max(FURTHEST, (need / limit.residual) ** (w / limits.order)))
    states.latest[path] = t * shrink
    return end_run.OPEN


def _paths(homotopy: Homotopy, states: States) -> Paths:
    from nag.tracking.ends import end_run

    P = len(states.t)
    points = np.zeros((P, homotopy.N), dtype=np.complex128)
    status = np.full(P, PathStatus.FAILED, dtype=np.int8)
    accuracy = np.full(P, np.inf)
    balls: dict[int, Ball] = {}
    branches: dict[int, PathBranch] = {}
    for path in range(P):
        points[path] = states.point(path)
        if states.outcome[path] == end_run.REGULAR:
            finite = _is_finite(homotopy, states, path)
            status[path] = PathStatus.REGULAR if finite else PathStatus.AT_INFINITY
            own = float(states.errors[path].max())
            accuracy[path] = max(ROUNDING, own, _affine_error(homotopy, states, path))
            balls[path] = Ball(states.found[path], states.errors[path])
        elif states.outcome[path] == end_run.LIMIT or path in states.affine:
            # Where it is not known whether a variable vanishes, others judge the end as a point.
            open_ended = states.outcome[path] != end_run.LIMIT
            limit = states.affine[path] if open_ended else states.limits[path]
            points[path], states.winding[path] = limit.point, limit.winding
            branches[path] = PathBranch(limit.winding, limit.orders, limit.branch, limit.bends)
            finite = open_ended or _is_finite(homotopy, states, path)
            status[path] = PathStatus.SINGULAR if finite else PathStatus.AT_INFINITY
            accuracy[path] = max(ROUNDING, BEYOND * limit.tail)
        elif path in states.last:
            # Where it seems to lead.
            limit = states.last[path]
            points[path], accuracy[path] = limit.point, max(ROUNDING, BEYOND * limit.tail)
    points = homotopy.normalized(points)
    condition = np.full(P, np.inf)
    regular = np.flatnonzero(status == PathStatus.REGULAR)
    if len(regular):
        condition[regular] = refine(homotopy, None, points[regular], iterations=0).condition
    failed = status == PathStatus.FAILED
    reason = np.where(states.t[:, 0] == 1, Reason.START, Reason.ENDGAME) * failed
    return Paths(
        points,
        status,
        np.where(failed, 0, np.maximum(states.winding, 1)),
        accuracy,
        condition,
        states.steps,
        states.digits.astype(np.int16),
        reason.astype(np.int8),
        states.outcome == end_run.REGULAR,
        balls,
        branches,
    )
