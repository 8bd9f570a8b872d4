"""Track all paths of a homotopy from t = 1 to t = 0 and say how each ends."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace

import numpy as np

from nag.tracking.clusters import neighbours
from nag.tracking.homotopy import Homotopy
from nag.tracking.newton import refine
from nag.tracking.paths import Paths, PathStatus, Reason
from nag.tracking.settings import Settings, named, tighter

STRAIGHT, CAUCHY = 1, 2
# Largest systems that are tracked again in double-double arithmetic.
MOST_COORDINATES = 24
# Smallest homogenising coordinate of a finite zero of a generic system.
AT_INFINITY = 1e-10
# Least ratio of a singular value to a Newton step that proves a regular zero.
PROOF = 1e5
# Below so many paths a second thread costs more than it brings.
PATHS_PER_THREAD = 64


def track(
    homotopy: Homotopy,
    starts: np.ndarray,
    settings: Settings | str = "default",
    threads: int = 1,
    *,
    endgame: bool = True,
    end_exponent: int = 1,
    distinct: bool = True,
) -> Paths:
    """Track ``starts`` from t = 1 to t = 0.

    Args:
        homotopy: what to track.
        starts: points at t = 1, regular, shape ``(P, N)``.
        settings: `Settings`, or ``"fast"``, ``"default"``, ``"careful"``.
        threads: number of threads; the result does not depend on it.
        endgame: False where every end is known to be regular: no endgame is run, and an end that
            does not look regular is failed.
        end_exponent: ``d`` where paths are analytic in ``(t / (1 - t)) ** d`` near t = 0; then the
            last coordinate is taken to turn by ``exp(2 pi i / d)`` and to vanish at t = 0.
        distinct: the starts are pairwise distinct, so that equal regular ends betray a path jump;
            such paths are tracked again with tighter control.

    Raises:
        ValueError: if the starts have a wrong shape, or settings an unknown name.
    """
    chosen = named(settings)
    starts = np.asarray(starts, dtype=np.complex128)
    if starts.ndim != 2 or starts.shape[1] != homotopy.N:
        raise ValueError(f"starts have shape {starts.shape}, not (paths, {homotopy.N})")
    starts = homotopy.normalized(starts)
    paths = _attempt(homotopy, starts, chosen, threads, endgame, end_exponent)
    for attempt in range(chosen.retries):
        if attempt == 1:
            paths = _in_double_double(homotopy, starts, paths, chosen, threads, end_exponent)
        again = set(paths.where(PathStatus.FAILED).tolist())
        if distinct:
            again |= set(collisions(homotopy, paths).tolist())
        if not again:
            break
        chosen = tighter(chosen)
        indices = np.array(sorted(again))
        new = _attempt(homotopy, starts[indices], chosen, threads, endgame, end_exponent)
        paths = _merged(paths, new, indices)
    return _in_high_precision(homotopy, starts, paths, named(settings), endgame, end_exponent)


def track_regular(
    homotopy: Homotopy,
    starts: np.ndarray,
    settings: Settings,
    threads: int = 1,
    weights: np.ndarray | None = None,
) -> tuple[np.ndarray, np.ndarray]:
    """Track once, without an endgame, to a system all of whose finite zeros are regular.

    Args:
        homotopy: what to track; with ``weights`` its factors must be those of a fixed system.
        starts: points at t = 1, shape ``(P, N)``.
        settings: settings; nothing is tracked again, and distinct paths may have jumped to one end.
        threads: number of threads; the result does not depend on it.
        weights: where each part is one term: part ``p`` is multiplied by
            ``exp(-weights[path, p] t)``, shape ``(P, parts)``.

    Returns:
        The normalised finite zeros, shape ``(Q, N)``, and the paths that led there, shape ``(Q,)``.
    """
    raw = _run(homotopy, homotopy.normalized(starts), settings, threads, False, 1, weights)
    ended = np.flatnonzero(raw.outcome > 0)
    # A row may be small at a point near infinity, so that singular values would say nothing.
    sharp = refine(homotopy, None, raw.points[ended])
    good = (sharp.moved <= 1e3 * raw.error[ended] + 1e-11) & (sharp.error < 1e-8)
    points = homotopy.normalized(sharp.points)
    good &= np.abs(points[:, list(homotopy.infinity)]).min(axis=1, initial=np.inf) > AT_INFINITY
    return points[good], ended[good]


@dataclass(frozen=True, eq=False)
class _Raw:
    points: np.ndarray
    outcome: np.ndarray
    winding: np.ndarray
    error: np.ndarray
    steps: np.ndarray
    reason: np.ndarray


def _attempt(
    homotopy: Homotopy,
    starts: np.ndarray,
    settings: Settings,
    threads: int,
    endgame: bool,
    end_exponent: int,
) -> Paths:
    raw = _run(homotopy, starts, settings, threads, endgame, end_exponent)
    return _classified(homotopy, raw, endgame)


def _run(
    homotopy: Homotopy,
    starts: np.ndarray,
    settings: Settings,
    threads: int,
    endgame: bool,
    end_exponent: int,
    weights: np.ndarray | None = None,
) -> _Raw:
    from nag.tracking import jets, kernel
    from nag.tracking.endgame import PATIENCE, endgame_state

    P = len(starts)
    raw = _Raw(
        np.zeros((P, homotopy.N), dtype=np.complex128),
        np.zeros(P, dtype=np.int64),
        np.zeros(P, dtype=np.int64),
        np.full(P, np.inf),
        np.zeros(P, dtype=np.int64),
        np.zeros(P, dtype=np.int64),
    )
    if P == 0:
        return raw
    kernel.track_lanes.prepare()
    arrays = jets.system(homotopy, weights)
    batches = max(1, min(threads, P // PATHS_PER_THREAD))

    def batch(first: int) -> None:
        state = endgame_state(
            homotopy.N,
            end_exponent,
            endgame,
            settings.shortcut,
            PATIENCE if settings.shortcut else 0,
            settings.endgame_radius,
            settings.samples,
            settings.max_winding,
            settings.levels,
        )
        paths = kernel.Batch(
            starts,
            P,
            first,
            batches,
            *(raw.points, raw.outcome, raw.winding, raw.error, raw.steps, raw.reason),
            settings.order,
            settings.max_steps,
            settings.tolerance,
            settings.newton,
            settings.newton_end,
            settings.floor,
            settings.radius_factor,
            settings.safety,
            settings.contraction,
        )
        kernel.track_lanes(arrays, jets.work(homotopy, settings.order), state, paths)

    if batches == 1:
        batch(0)
    else:
        with ThreadPoolExecutor(batches) as pool:
            list(pool.map(batch, range(batches)))
    return raw


def _in_double_double(
    homotopy: Homotopy,
    starts: np.ndarray,
    paths: Paths,
    settings: Settings,
    threads: int,
    end_exponent: int,
) -> Paths:
    """Track again in double-double arithmetic what failed near its end in doubles."""
    failed = paths.where(PathStatus.FAILED)
    failed = failed[paths.reason[failed] != Reason.START]
    # A step costs some N^3 double-double products, a hundred times a step in doubles.
    most = settings.double_double_paths if homotopy.N <= MOST_COORDINATES else 0
    if not 0 < len(failed) <= most:
        return paths
    from nag.tracking.extended import track_extended

    raw = track_extended(
        homotopy,
        starts[failed],
        threads=threads,
        end_exponent=end_exponent,
        radius=settings.endgame_radius,
        samples=settings.samples,
        max_winding=settings.max_winding,
        levels=settings.levels,
    )
    new = _classified(homotopy, _Raw(*raw), endgame=True)
    ended = new.status != PathStatus.FAILED
    precision = np.where(ended, 32, new.precision).astype(np.int16)
    return _merged(paths, replace(new, precision=precision), failed)


def _in_high_precision(
    homotopy: Homotopy,
    starts: np.ndarray,
    paths: Paths,
    settings: Settings,
    endgame: bool,
    end_exponent: int,
) -> Paths:
    """Track again with mpmath what failed in doubles, as many paths as the settings allow."""
    failed = paths.where(PathStatus.FAILED)
    failed = failed[paths.reason[failed] != Reason.START][: settings.high_precision_paths]
    if not len(failed):
        return paths
    from nag.tracking.oracle import track_one

    ends = [
        track_one(
            homotopy,
            starts[i],
            digits=settings.digits,
            tolerance=min(settings.tolerance, 1e-4),
            endgame=endgame,
            end_exponent=end_exponent,
            max_winding=settings.max_winding,
        )
        for i in failed
    ]
    outcome = CAUCHY if endgame else STRAIGHT
    raw = _Raw(
        np.array([end.point for end in ends]),
        np.array([outcome if end.winding else 0 for end in ends]),
        np.array([end.winding for end in ends]),
        np.array([end.error for end in ends]),
        np.array([end.steps for end in ends]),
        np.array([0 if end.winding else Reason.ENDGAME for end in ends]),
    )
    new = _classified(homotopy, raw, endgame)
    return _merged(
        paths, replace(new, precision=np.full(len(ends), settings.digits, np.int16)), failed
    )


def _classified(homotopy: Homotopy, raw: _Raw, endgame: bool) -> Paths:
    P = len(raw.points)
    points = raw.points.copy()
    status = np.full(P, PathStatus.FAILED, dtype=np.int8)
    accuracy = np.full(P, np.inf)
    smallest = np.zeros(P)
    condition = np.full(P, np.inf)
    reason = raw.reason.astype(np.int8)
    precision = np.full(P, 16, dtype=np.int16)
    ended = np.flatnonzero(raw.outcome > 0)
    if len(ended):
        rough = homotopy.normalized(points[ended])
        error = np.maximum(raw.error[ended], 1e-15)
        sharp = refine(homotopy, None, rough)
        steady = sharp.smallest > 0.5 * sharp.before
        near = sharp.moved <= 1e3 * error + 1e-11
        # Newton's method proves a regular zero where its steps are far smaller than the singular
        # values; so does a rough end whose error is.
        proved = steady & (near | (sharp.moved <= 0.1 * sharp.smallest))
        proved &= (sharp.error < 1e-12) & (sharp.smallest > PROOF * sharp.error)
        likely = steady & near & (sharp.error < 1e-8) & (sharp.before > 300 * error)
        regular = (raw.winding[ended] == 1) & (proved | likely)
        points[ended] = np.where(regular[:, None], sharp.points, rough)
        accuracy[ended] = np.where(regular, sharp.error, error)
        smallest[ended] = np.where(regular, sharp.smallest, sharp.before)
        condition[ended] = sharp.size / np.maximum(smallest[ended], 1e-300)
        precision[ended[regular]] = 32
        sizes = np.abs(points[ended][:, list(homotopy.infinity)]).min(axis=1, initial=np.inf)
        limit = np.where(
            regular, np.maximum(1e2 * sharp.error, 1e-14), np.maximum(100 * error, 1e-8)
        )
        far = (sizes <= limit) & endgame
        status[ended] = np.where(
            far, PathStatus.AT_INFINITY, np.where(regular, PathStatus.REGULAR, PathStatus.SINGULAR)
        )
        # A path that ran straight to a singular end has not been judged by an endgame; branches
        # do not meet at a regular zero.
        straight = raw.outcome[ended] == STRAIGHT
        lost = ended[~regular & (straight | (proved & ~far))]
        status[lost] = PathStatus.FAILED
        reason[lost] = Reason.ENDGAME
    winding = np.where(status == PathStatus.FAILED, 0, raw.winding)
    return Paths(
        points, status, winding, accuracy, smallest, condition, raw.steps, precision, reason
    )


def collisions(homotopy: Homotopy, paths: Paths) -> np.ndarray:
    """Indices of the paths with regular ends that coincide with another one's."""
    regular = paths.where(PathStatus.REGULAR)
    if len(regular) < 2:
        return regular[:0]
    points = paths.points[regular]
    # Projectively invariant coordinates: |<v, x>|^2 for a fixed v sorts the points, so that equal
    # ones are neighbours in a window of that coordinate.
    generator = np.random.default_rng(0)
    key = np.zeros(len(regular))
    for indices in homotopy.groups:
        v = generator.normal(size=(2, len(indices)))
        key += np.abs(points[:, list(indices)] @ (v[0] + 1j * v[1])) ** 2
    found: set[int] = set()
    tolerance = np.maximum(1e-10, 1e3 * paths.accuracy[regular])
    for i, j in neighbours(key, np.full(len(key), 1e-6)):
        close = _distances(homotopy, points[i], points[j]) <= np.maximum(tolerance[i], tolerance[j])
        found.update(regular[i[close]].tolist(), regular[j[close]].tolist())
    return np.array(sorted(found), dtype=np.int64)


def _distances(homotopy: Homotopy, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Distances of projective points of unit norm, shape ``(P,)``; the largest of the groups."""
    largest = np.zeros(len(x))
    for indices in homotopy.groups:
        a, b = x[:, list(indices)], y[:, list(indices)]
        product = (b.conj() * a).sum(axis=1, keepdims=True)
        size = np.abs(product)
        turned = b * np.where(size > 0, product / np.where(size > 0, size, 1), 1)
        largest = np.maximum(largest, np.linalg.norm(a - turned, axis=1))
    return largest


def _merged(old: Paths, new: Paths, indices: np.ndarray) -> Paths:
    """``old`` with the paths at ``indices`` replaced; steps add up."""
    fields = {}
    for name in old.__dataclass_fields__:
        array = getattr(old, name).copy()
        values = getattr(new, name)
        array[indices] = array[indices] + values if name == "steps" else values
        fields[name] = array
    return replace(old, **fields)
