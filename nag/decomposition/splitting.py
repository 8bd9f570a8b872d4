"""Points on a slice split into irreducible components: loops join, traces confirm.

A class of points is a component when its trace is linear. Among few points the smallest such
classes are searched for; among many, monodromy loops join points of one component first, and find
points of it that are missing. Permutations of the points by symmetries of the
system are followed: what a loop joins, they join elsewhere as well, and one class of each orbit is
confirmed for all of them.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from nag.decomposition.monodromy import loop
from nag.decomposition.trace import MOST_CLASSES, Trace
from nag.witness.close_points import Fine
from nag.witness.fibres import Tracker
from nag.witness.points import Points
from nag.witness.witness import PathCounts

# Loops that join nothing before symmetries are given up, and then slices near the origin; and loops
# after which to give up: the worst of the measured systems needed 46.
IDLE_LOOPS = 4
MOST_LOOPS = 100

NOT_LINEAR = "its trace is not linear: points are missing, or loops did not join them"
NO_TRACE = "the trace could not be computed"
NO_DIGITS = "whether its trace is linear needs more digits"


@dataclass(frozen=True, eq=False)
class Class:
    """Points of one component, as indices into all points.

    ``reason`` says why they could not be confirmed to be a whole component; empty if they were.
    """

    indices: np.ndarray
    reason: str = ""


@dataclass(frozen=True, eq=False)
class Split:
    """Points, those that loops added included, and their classes, which hold each point once.

    Attributes:
        labels: for each point the smallest index in its class.
    """

    points: Points
    labels: np.ndarray
    classes: tuple[Class, ...]
    counts: PathCounts


@dataclass(eq=False)
class _State:
    """What is known while points are split.

    ``labels``: for each point the smallest index in its class; ``verdicts``: for each label and
    size of a class what its trace said.
    """

    points: Points
    labels: np.ndarray
    permutations: Sequence[np.ndarray]
    orbits: np.ndarray
    trace: Trace | None
    verdicts: dict[tuple[int, int], bool | None]
    counts: PathCounts

    def indices(self, label: int) -> np.ndarray:
        return np.flatnonzero(self.labels == label)

    def verdict(self, label: int) -> bool | None:
        return self.verdicts.get((label, int((self.labels == label).sum())))

    def open_points(self) -> np.ndarray:
        """Points of classes that are not confirmed, nor images of such."""
        labels, orbits = self.labels.tolist(), self.orbits.tolist()
        sure = {k for k, size in Counter(labels).items() if self.verdicts.get((k, size))}
        done = {o for o, k in zip(orbits, labels, strict=True) if k in sure}
        return np.array([i for i, o in enumerate(orbits) if o not in done], dtype=int)

    def forget_symmetries(self) -> None:
        self.permutations, self.orbits = (), np.arange(len(self.labels))


def split(
    points: Points,
    permutations: Sequence[np.ndarray],
    evidence: int,
    rng: np.random.Generator,
    tracker: Tracker,
) -> Split:
    """Split points on a generic slice into irreducible components.

    Args:
        permutations: of the points, by symmetries.
        evidence: digits to which a trace must be linear.
    """
    total = len(points)
    labels = np.arange(total)
    if points.dimension == 0:
        classes = tuple(Class(np.array([i])) for i in range(total))
        return Split(points, labels, classes, PathCounts())
    orbits = np.arange(total)
    for permutation in permutations:
        join(orbits, list(enumerate(permutation)), ())
    state = _State(points, labels, permutations, orbits, None, {}, PathCounts())
    idle = 0
    for _ in range(MOST_LOOPS):
        open_points = state.open_points()
        if tracker.progress is not None:
            number = len(np.unique(state.labels))
            tracker.tell("splitting", number - len(np.unique(state.labels[open_points])), number)
        if len(open_points) and not _tested(state, open_points, evidence, rng, tracker):
            break
        open_points = state.open_points()
        if idle >= IDLE_LOOPS and len(state.permutations):
            state.forget_symmetries()
            idle = 0
            continue
        if len(open_points) and not len(state.permutations):
            _united(state, open_points)
            open_points = state.open_points()
        if not len(open_points):
            break
        scaled = idle >= IDLE_LOOPS
        idle = 0 if _looped(state, open_points, rng, tracker, scaled) else idle + 1
    known = state.points if state.trace is None else state.trace.sharper(state.points)
    return Split(known, state.labels, tuple(_classes(state)), state.counts)


def join(labels: np.ndarray, pairs: Sequence[tuple[int, int]], permutations: Sequence) -> None:
    """Merge classes of points, in place, and with them all their images.

    A class is labelled by its smallest point. ``permutations`` are those of the symmetries; they
    carry points of one component to points of one component.
    """
    waiting = list(pairs)
    while waiting:
        i, j = waiting.pop()
        a, b = sorted((labels[i], labels[j]))
        if a != b:
            labels[labels == b] = a
            waiting += [(p[i], p[j]) for p in permutations]


def _tested(
    state: _State,
    open_points: np.ndarray,
    evidence: int,
    rng: np.random.Generator,
    tracker: Tracker,
) -> bool:
    """Test the traces of open classes, one of each orbit; False if a path fails."""
    chosen, seen = [], set[int]()
    for label in np.unique(state.labels[open_points]).tolist():
        touched = set(state.orbits[state.labels == label].tolist())
        if not touched & seen:
            chosen.append(label)
            seen |= touched
    new = [k for k in chosen if (k, len(state.indices(k))) not in state.verdicts]
    wanted = np.concatenate([state.indices(k) for k in new]) if new else np.zeros(0, dtype=int)
    trace = state.trace or Trace.of(state.points, evidence, rng)
    state.trace, spent = trace.carried(state.points, wanted, tracker)
    state.counts += spent
    if state.trace is None:
        return False
    for label in new:
        own = state.indices(label)
        answer, state.trace = state.trace.linear(state.points, own)
        state.verdicts[label, len(own)] = answer
    return True


def _united(state: _State, open_points: np.ndarray) -> None:
    """Join classes whose traces are linear together, and confirm them."""
    waiting = [np.flatnonzero(state.labels == k) for k in np.unique(state.labels[open_points])]
    if len(waiting) > MOST_CLASSES:
        return
    unions, state.trace = state.trace.smallest_unions(state.points, waiting)
    if not unions:
        _doubted(state, open_points)
    for union in unions:
        joined = np.concatenate([waiting[c] for c in union])
        first = int(state.labels[joined].min())
        state.labels[joined] = first
        state.verdicts[first, len(joined)] = True


def _doubted(state: _State, open_points: np.ndarray) -> None:
    """Open classes again that only seemed to be linear, where the other points are not together.

    All points of a set together have a linear trace; what others bend, these bend as well.
    """
    answer, trace = state.trace.linear(state.points, open_points)
    if answer is not False:
        return
    state.trace = trace.finer(open_points)
    for label in set(state.labels.tolist()) - set(state.labels[open_points].tolist()):
        own = state.indices(label)
        if set(own.tolist()) <= set(state.trace.ends):
            answer, state.trace = state.trace.linear(state.points, own)
            state.verdicts[label, len(own)] = answer


def _looped(
    state: _State,
    open_points: np.ndarray,
    rng: np.random.Generator,
    tracker: Tracker,
    scaled: bool,
) -> bool:
    """Track a random loop from one point of each orbit; whether it joined or found any."""
    start = open_points[np.unique(state.orbits[open_points], return_index=True)[1]]
    found, spent = loop(state.points, start, rng, tracker, scaled)
    state.counts += spent
    if found.places is None or (len(state.permutations) and (found.places < 0).any()):
        return False
    before, hit = state.labels.copy(), found.places >= 0
    pairs = list(zip(found.origins[hit], found.places[hit], strict=True))
    join(state.labels, pairs, state.permutations)
    for k in np.flatnonzero(~hit):
        _add(state, int(found.origins[k]), found.ends.z[k], found.ends.fine.get(int(k)))
    return not np.array_equal(before, state.labels)


def _add(state: _State, origin: int, z: np.ndarray, fine: Fine | None) -> None:
    """A point that a loop from ``origin`` led to."""
    cut = state.points.cuts[state.points.which[origin]]
    state.points = state.points.with_point(cut, z, fine)
    state.labels = np.append(state.labels, state.labels[origin])
    state.orbits = np.append(state.orbits, len(state.orbits))


def _classes(state: _State) -> list[Class]:
    open_points = set(state.open_points().tolist())
    result = []
    for label in np.unique(state.labels).tolist():
        own, reason = state.indices(label), ""
        if label in open_points:
            reason = NO_TRACE
            if (label, len(own)) in state.verdicts:
                reason = NO_DIGITS if state.verdict(label) is None else NOT_LINEAR
        result.append(Class(own, reason))
    return result
