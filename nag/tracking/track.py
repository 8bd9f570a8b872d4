"""Track all paths of a homotopy from t = 1 to t = 0 and say how each ends.

A straight run in doubles brings most paths to regular ends that Newton's method confirms. The
others are followed from their last safe points in more digits (`nag.tracking.ends`). Only paths
that prove to have jumped are tracked again.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, fields
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from nag.errors import NagError
from nag.numerics.coincidence import LEAST
from nag.numerics.doubles import ARRIVED, ROUGH, ROUNDED, SHARPEST, SLACK
from nag.tracking import blocks, evaluations
from nag.tracking.homotopy import Homotopy
from nag.tracking.jumps import collisions, find_like_branches
from nag.tracking.known import NOTHING, KnownOfPaths
from nag.tracking.newton import refine
from nag.tracking.paths import Paths, PathStatus, Reason
from nag.tracking.settings import Settings, find_settings, tighten
from nag.tracking.starts import StartsByIndex

if TYPE_CHECKING:
    from nag.tracking.ends.follow import Unfinished

# Newton's method may move the end of a path by this part of the smallest singular value there, or
# by what its errors allow.
BASIN = 0.1
# Decides: Homogenising coordinates of finite zeros of such systems.
AT_INFINITY = 1e-10
# Decides, measured: Smallest singular value over the last Newton step of a regular end in doubles.
# Kantorovich's theorem asks for a few times the second derivatives; what fails gets 32 digits.
PROOF = 1e5
# Decides, measured: A homogenising coordinate of a regular end in doubles, residuals in
# double-double, is known to this over the smallest singular value.
RESIDUAL = 1e-29
# Below so many paths a second thread costs more than it brings.
PATHS_PER_THREAD = 64
# Paths of a block in doubles; and so few that they are tracked again in less time than found.
BLOCK, LEAST_BLOCK = 1024, 32


class PathsSoFar(NamedTuple):
    """How far paths are.

    Attributes:
        done, total: paths that are tracked in doubles, of all; where ``in_digits``, doubtful ones
            that are followed to their ends in more digits, of these.
        doubtful: of those in doubles; infinite, failed: of those in more digits.
        paths: those of doubles that were not told of before; the ends of doubtful ones have failed.
    """

    done: int
    total: int
    in_digits: bool = False
    doubtful: int = 0
    infinite: int = 0
    failed: int = 0
    paths: Paths | None = None


Tell = Callable[[PathsSoFar], None]


def track(
    homotopy: Homotopy,
    starts: np.ndarray | StartsByIndex,
    settings: Settings | str = "default",
    threads: int = 1,
    *,
    endgame: bool = True,
    distinct: bool = True,
    known: KnownOfPaths = NOTHING,
    tell: Tell | None = None,
) -> Paths:
    """Track ``starts`` from t = 1 to t = 0.

    Args:
        homotopy: what to track.
        starts: points at t = 1, regular, shape ``(P, N)``; read some at a time.
        settings: `Settings`, or ``"fast"``, ``"default"``, ``"careful"``.
        threads: number of threads; the result does not depend on it.
        endgame: False where every end is known to be regular: a path need not be safe before its
            end, and one that ends otherwise has failed.
        distinct: the starts are pairwise distinct, so that equal regular ends betray a path jump;
            such paths are tracked again with tighter control.
        known: what is known of the paths beforehand; of use where the starts are distinct.
        tell: called now and then with how far the paths are.

    Raises:
        ValueError: if the starts have a wrong shape, or settings an unknown name.
    """
    chosen = find_settings(settings)
    if not isinstance(starts, StartsByIndex):
        starts = np.asarray(starts, dtype=np.complex128)
    if len(starts.shape) != 2 or starts.shape[1] != homotopy.N:
        raise NagError(f"starts have shape {starts.shape}, not (paths, {homotopy.N})")
    before = known if distinct else NOTHING
    paths = _attempt(homotopy, starts, chosen, threads, endgame, before, tell)
    for attempt in range(chosen.retries if distinct else 0):
        jumped = collisions(homotopy, paths)
        if attempt == 0:
            # Branches that begin alike may be two; a jump does not survive shorter steps.
            jumped = np.array(
                sorted({*jumped.tolist(), *find_like_branches(paths).tolist()}), dtype=int
            )
        if not len(jumped):
            return paths
        chosen = tighten(chosen)
        again = _attempt(homotopy, starts[jumped], chosen, threads, endgame)
        paths = paths.track_again(jumped, again)
    return paths.mark_failed(collisions(homotopy, paths)) if distinct else paths


def track_members(
    homotopy: Homotopy,
    starts: np.ndarray,
    member: np.ndarray,
    settings: Settings | str = "default",
    threads: int = 1,
) -> Paths:
    """Track paths of many homotopies of the same rows together, once and in doubles alone.

    Regular ends are proved as those of `track` are. Every other end has failed: paths to it are for
    `track` to follow, in a homotopy of their own, and so are those that lead to one end.

    Args:
        homotopy: with ``members``.
        starts: points at t = 1, shape ``(P, N)``.
        member: whose factors each path has, shape ``(P,)``.
        settings: `Settings`, or their name.
        threads: number of threads; the result does not depend on it.
    """
    chosen = find_settings(settings)
    member = np.ascontiguousarray(member, dtype=np.int64)
    starts = homotopy.normalized(starts)
    raw = run_in_doubles(homotopy, starts, chosen, threads, False, member=member)
    return _judge_ends(homotopy, raw, member)[0]


def find_finished_paths(
    homotopy: Homotopy, starts: np.ndarray, settings: Settings | str = "default", threads: int = 1
) -> np.ndarray:
    """Which paths from ``starts``, shape ``(P, N)``, doubles bring to regular ends: shape ``(P,)``.

    The others are those that `track` follows in more digits.
    """
    begin = homotopy.normalized(starts)
    raw = run_in_doubles(homotopy, begin, find_settings(settings), threads, True)
    return _judge_ends(homotopy, raw)[0].status == PathStatus.REGULAR


class RegularEnds(NamedTuple):
    """Finite regular zeros in which paths ended.

    Attributes:
        points: of unit norm in each group of coordinates, shape ``(Q, N)``.
        paths: which ones led there, shape ``(Q,)``.
        errors: estimated relative errors, shape ``(Q,)``.
    """

    points: np.ndarray
    paths: np.ndarray
    errors: np.ndarray


def track_regular(
    homotopy: Homotopy,
    starts: np.ndarray,
    settings: Settings,
    threads: int = 1,
    weights: np.ndarray | None = None,
) -> RegularEnds:
    """Track once, in doubles, to a system all of whose finite zeros are regular.

    Args:
        homotopy: what to track; with ``weights`` its factors must be those of a fixed system.
        starts: points at t = 1, shape ``(P, N)``.
        settings: settings; nothing is tracked again, and distinct paths may have jumped to one end.
        threads: number of threads; the result does not depend on it.
        weights: where each part is one term: part ``p`` is multiplied by
            ``exp(-weights[path, p] t)``, shape ``(P, parts)``.
    """
    raw = run_in_doubles(homotopy, homotopy.normalized(starts), settings, threads, False, weights)
    ended = np.flatnonzero(raw.reason == Reason.NONE)
    # A row may be small at a point near infinity, so that singular values would say nothing.
    sharp = refine(homotopy, None, raw.points[ended])
    good = (sharp.moved <= SLACK * raw.error[ended] + LEAST) & (sharp.error < ROUGH)
    points = homotopy.normalized(sharp.points)
    good &= np.abs(points[:, list(homotopy.infinity)]).min(axis=1, initial=np.inf) > AT_INFINITY
    return RegularEnds(points[good], ended[good], sharp.error[good])


@dataclass(frozen=True, eq=False)
class StraightRun:
    """Where the paths are after a run in doubles: see `nag.tracking.straight_run.Batch`.

    ``points``: shape ``(P, N)``, at t = 0 where ``reason`` is `Reason.NONE`.
    """

    points: np.ndarray
    safe: np.ndarray
    safe_t: np.ndarray
    error: np.ndarray
    steps: np.ndarray
    reason: np.ndarray


def _attempt(
    homotopy: Homotopy,
    starts: np.ndarray | StartsByIndex,
    settings: Settings,
    threads: int,
    endgame: bool,
    known: KnownOfPaths = NOTHING,
    tell: Tell | None = None,
) -> Paths:
    from nag.tracking.ends.follow import Unfinished, follow_doubtful

    orbits = known.orbits
    chosen = np.arange(len(starts)) if orbits is None else orbits.chosen
    left: list[Unfinished] = []
    paths = Paths.collect(
        _run_by_stretches(homotopy, starts, chosen, settings, threads, endgame, left, tell),
        len(chosen),
    )
    doubtful, unfinished = paths.where(PathStatus.FAILED), Unfinished.concatenate(left)
    if len(doubtful) and settings.digits >= 32:
        every = paths if orbits is None else orbits.expand(paths, homotopy.groups)
        if known.most is not None and _all_are_found(homotopy, every, known.most):
            paths = paths.mark_infinite(doubtful, homotopy)
        else:
            infinite, ends = _infinite(homotopy, paths, doubtful[unfinished.regular])
            if len(infinite):
                paths = paths.track_again(infinite, ends)
                rest = ~np.isin(doubtful, infinite)
                doubtful, unfinished = doubtful[rest], unfinished.select_rows(rest)
            if len(doubtful):
                told = None if tell is None else partial(_tell_in_digits, tell, len(doubtful))
                more = follow_doubtful(homotopy, unfinished, settings, threads, told)
                if not endgame:
                    more = more.mark_failed(more.where(PathStatus.SINGULAR))
                paths = paths.track_again(doubtful, more)
    return paths if orbits is None else orbits.expand(paths, homotopy.groups)


def _tell_in_digits(tell: Tell, total: int, done: int, infinite: int, failed: int) -> None:
    tell(PathsSoFar(done, total, True, infinite=infinite, failed=failed))


def _run_by_stretches(
    homotopy: Homotopy,
    starts: np.ndarray | StartsByIndex,
    chosen: np.ndarray,
    settings: Settings,
    threads: int,
    endgame: bool,
    left: list[Unfinished],
    tell: Tell | None,
) -> Iterator[Paths]:
    """Paths in doubles and their ends, judged, some at a time.

    Of where the others were on their way only that of doubtful ones is kept, in ``left``.
    """
    from nag.tracking.ends.follow import Unfinished

    stretch, total, open_ = BLOCK * blocks.at_once(), len(chosen), 0
    for first in range(0, max(total, 1), stretch):
        begin = homotopy.normalized(starts[chosen[first : first + stretch]])

        def told(done: int, first: int = first, open_: int = open_) -> None:
            if tell is not None:
                tell(PathsSoFar(min(first + done * BLOCK, total), total, doubtful=open_))

        raw = run_in_doubles(homotopy, begin, settings, threads, endgame, told=told)
        paths, regular = _judge_ends(homotopy, raw)
        doubtful = paths.where(PathStatus.FAILED)
        open_ += len(doubtful)
        left.append(
            Unfinished(
                raw.points[doubtful],
                raw.reason[doubtful] == Reason.NONE,
                regular[doubtful],
                raw.safe[doubtful],
                raw.safe_t[doubtful],
                begin[doubtful],
            )
        )
        if tell is not None:
            tell(PathsSoFar(min(first + stretch, total), total, doubtful=open_, paths=paths))
        yield paths


def _infinite(homotopy: Homotopy, paths: Paths, chosen: np.ndarray) -> tuple[np.ndarray, Paths]:
    """Which of the paths ``chosen``, all to regular ends, lead to infinity, and these ends."""
    from nag.tracking.ends.at_infinity import regular_paths

    found, ends = regular_paths(homotopy, paths.points[chosen], paths.condition[chosen])
    return chosen[found], ends


def _all_are_found(homotopy: Homotopy, paths: Paths, most: int) -> bool:
    """Whether there are ``most`` distinct regular finite ends, no coordinate of which vanishes."""
    regular = paths.where(PathStatus.REGULAR)
    if len(regular) != most or len(collisions(homotopy, paths)):
        return False
    sizes = np.abs(paths.points[regular]).min(axis=1)
    return bool((sizes > SLACK * paths.accuracy[regular]).all())


def run_in_doubles(
    homotopy: Homotopy,
    starts: np.ndarray,
    settings: Settings,
    threads: int,
    endgame: bool,
    weights: np.ndarray | None = None,
    member: np.ndarray | None = None,
    told: Callable[[int], None] | None = None,
) -> StraightRun:
    """Track paths once, in doubles alone; nothing is said of their ends.

    With ``member``, shape ``(P,)``, each path has the factors of that one of the homotopy's
    members.
    """
    work = _PathsInDoubles(homotopy, starts, settings, endgame, weights, member)
    if blocks.in_blocks() and len(starts) >= LEAST_BLOCK:
        raw = _run_in_blocks(work, threads, told)
    else:
        raw = _run(work, threads)
    # A step takes two values, and the Taylor coefficients of each order.
    evaluations.count(raw.steps.sum() * (2 + settings.order))
    return raw


class _PathsInDoubles(NamedTuple):
    """What is tracked in doubles, and how; the arguments of `block_in_doubles`."""

    homotopy: Homotopy
    starts: np.ndarray
    settings: Settings
    endgame: bool
    weights: np.ndarray | None
    member: np.ndarray | None

    def block(self, first: int) -> tuple[Any, ...]:
        """Those of a block of paths."""
        rows = slice(first, first + BLOCK)
        weights, member = (None if a is None else a[rows] for a in (self.weights, self.member))
        return self.homotopy, self.starts[rows], self.settings, self.endgame, weights, member


def _run_in_blocks(
    work: _PathsInDoubles, threads: int, told: Callable[[int], None] | None
) -> StraightRun:
    """The same in blocks, each of which may be known already, or be worked out elsewhere."""
    calls = [work.block(k) for k in range(0, len(work.starts), BLOCK)]
    from nag.tracking import kernel_arrays

    # What is made ready for a homotopy is made, and counted, whoever tracks the paths.
    kernel_arrays.equations(work.homotopy, weights=work.weights)
    found = blocks.work_out(block_in_doubles, calls, "paths", threads, told)
    done = [arrays for arrays, _ in found]
    return StraightRun(**{name: np.concatenate([b[name] for b in done]) for name in done[0]})


def block_in_doubles(
    homotopy: Homotopy,
    starts: np.ndarray,
    settings: Settings,
    endgame: bool,
    weights: np.ndarray | None,
    member: np.ndarray | None,
    threads: int = 1,
) -> dict[str, np.ndarray]:
    """A block of paths in doubles, see `StraightRun`."""
    work = _PathsInDoubles(homotopy, starts, settings, endgame, weights, member)
    raw = _run(work, threads)
    return {each.name: getattr(raw, each.name) for each in fields(raw)}


def _run(work: _PathsInDoubles, threads: int) -> StraightRun:
    """Run the kernel."""
    from nag.tracking import kernel_arrays, straight_run

    homotopy, starts, settings, endgame, weights, member = work
    P = len(starts)
    raw = StraightRun(
        points=starts.copy(),
        safe=starts.copy(),
        safe_t=np.ones(P),
        error=np.full(P, np.inf),
        steps=np.zeros(P, dtype=np.int64),
        reason=np.zeros(P, dtype=np.int64),
    )
    if P == 0:
        return raw
    straight_run.track_lanes.prepare()
    arrays = kernel_arrays.equations(homotopy, weights=weights)
    chosen = np.zeros(P, dtype=np.int64) if member is None else member
    batches = max(1, min(threads, P // PATHS_PER_THREAD))

    def batch(first: int) -> None:
        paths = straight_run.Batch(
            starts=starts,
            member=chosen,
            count=P,
            first=first,
            stride=batches,
            points=raw.points,
            safe=raw.safe,
            safe_t=raw.safe_t,
            error=raw.error,
            steps=raw.steps,
            reason=raw.reason,
            order=settings.order,
            max_steps=settings.max_steps,
            radius=settings.radius if endgame else 0.0,
            tolerance=settings.tolerance,
            newton=settings.newton,
            newton_end=settings.newton_end,
            floor=settings.floor,
            radius_factor=settings.radius_factor,
            safety=settings.safety,
            contraction=settings.contraction,
        )
        scratch = kernel_arrays.scratch_table(homotopy, settings.order, weights is not None)
        straight_run.track_lanes(arrays, scratch, paths)

    if batches == 1:
        batch(0)
    else:
        with ThreadPoolExecutor(batches) as pool:
            list(pool.map(batch, range(batches)))
    return raw


def _judge_ends(
    homotopy: Homotopy, raw: StraightRun, member: np.ndarray | None = None
) -> tuple[Paths, np.ndarray]:
    """Finite ends that Newton's method proves regular; the others have failed.

    Also which ends are regular ones of the homogenised system, shape ``(P,)``: whether those that
    seem to lie at infinity do is not for doubles to say.
    """
    P = len(raw.points)
    points = raw.points.copy()
    good, regular = np.zeros(P, dtype=bool), np.zeros(P, dtype=bool)
    accuracy, condition = np.full(P, np.inf), np.full(P, np.inf)
    ended = np.flatnonzero(raw.reason == int(Reason.NONE))
    if len(ended):
        error = np.maximum(raw.error[ended], ROUNDED)
        chosen = None if member is None else member[ended]
        sharp = refine(homotopy, None, points[ended], member=chosen)
        # Newton's method proves a regular zero where its steps are far smaller than the singular
        # values, which hardly change on the way.
        near = (sharp.moved <= SLACK * error + LEAST) | (sharp.moved <= BASIN * sharp.smallest)
        proved = near & (sharp.smallest > 0.5 * sharp.before)
        proved &= (sharp.error < SHARPEST) & (sharp.smallest > PROOF * sharp.error)
        sizes = np.abs(sharp.points[:, list(homotopy.infinity)]).min(axis=1, initial=np.inf)
        known = sizes * np.maximum(sharp.smallest, 1e-300) > RESIDUAL / ARRIVED
        points[ended] = sharp.points
        condition[ended] = sharp.condition
        regular[ended] = proved
        good[ended] = proved & known
        accuracy[ended] = np.where(proved & known, sharp.error, np.inf)
    failed = ~good
    status, digits = np.zeros(P, np.int8), np.full(P, 32, np.int16)
    status[good], status[failed], digits[failed] = PathStatus.REGULAR, PathStatus.FAILED, 16
    reason = raw.reason.astype(np.int8)
    reason[failed & (reason == int(Reason.NONE))] = Reason.ENDGAME
    winding = good.astype(np.int64)
    return Paths(
        points, status, winding, accuracy, condition, raw.steps, digits, reason, good
    ), regular
