"""Points on a slice split into irreducible components: traces decide, loops suggest.

A component is a smallest set of points whose trace is linear. Among few points these sets are found
from the traces alone. Among many, monodromy loops first join points that ought to be of one
component, and they find points of it that are missing. A loop that took one path for another joins
wrongly, so that what it joined can be taken back: a component has to be found again without any one
of the loops, from the traces, and a loop that joins points of different components is discarded.

Permutations of the points by symmetries of the system are followed: what a loop joins, they join
elsewhere as well, and one class of each orbit is confirmed for all of them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

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
ONE_LOOP = "its points are joined by one loop alone, or traces of parts of it need more digits"


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
        discarded: number of loops that were no permutation of points, or that joined points of
            different components.
    """

    points: Points
    labels: np.ndarray
    classes: tuple[Class, ...]
    counts: PathCounts
    discarded: int = 0


@dataclass(eq=False)
class _State:
    """What is known while points are split.

    Attributes:
        permutations: of the points, by symmetries; orbits: for each point the smallest index in
            its orbit.
        loops: for each the pairs of points that it joins, shape ``(m, 2)``.
        whole: sets of points that are components, as far as is known.
        linear: sets whose trace was found to be linear, or not, as bytes of their indices.
    """

    points: Points
    permutations: Sequence[np.ndarray]
    orbits: np.ndarray
    trace: Trace | None = None
    loops: list[np.ndarray] = field(default_factory=list)
    whole: list[np.ndarray] = field(default_factory=list)
    tested: dict[bytes, bool | None] = field(default_factory=dict)
    discarded: int = 0
    counts: PathCounts = field(default_factory=PathCounts)

    def labels(self, pairs: Sequence[np.ndarray]) -> np.ndarray:
        return joined_labels(len(self.points), pairs, self.permutations)

    def open_points(self) -> np.ndarray:
        """Points of classes that are not confirmed, nor images of such."""
        if not self.whole:
            return np.arange(len(self.points))
        done = np.unique(self.orbits[np.concatenate(self.whole)])
        return np.flatnonzero(~np.isin(self.orbits, done))

    def forget_symmetries(self) -> None:
        self.permutations, self.orbits = (), np.arange(len(self.points))


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
    if points.dimension == 0:
        classes = tuple(Class(np.array([i])) for i in range(total))
        return Split(points, np.arange(total), classes, PathCounts())
    moves = [np.column_stack([np.arange(total), images]) for images in permutations]
    state = _State(points, permutations, joined_labels(total, moves, ()))
    state.trace = Trace.of(points, evidence, rng)
    idle = 0
    for _ in range(MOST_LOOPS):
        if not _found_components(state, tracker):
            break
        open_points = state.open_points()
        if not len(open_points):
            break
        if idle >= IDLE_LOOPS and len(state.permutations):
            state.forget_symmetries()
            idle = 0
            continue
        scaled = idle >= IDLE_LOOPS
        idle = 0 if _looped(state, open_points, rng, tracker, scaled) else idle + 1
    known = state.points if state.trace is None else state.trace.sharper(state.points)
    labels = state.labels([*state.loops, *map(_star, state.whole)])
    classes = tuple(_classes(state, labels))
    return Split(known, labels, classes, state.counts, state.discarded)


def joined_labels(
    total: int, pairs: Sequence[np.ndarray], permutations: Sequence[np.ndarray]
) -> np.ndarray:
    """For each of ``total`` points the smallest one of its class, shape ``(total,)``.

    Args:
        pairs: of points that are in one class, arrays of shape ``(m, 2)``.
        permutations: of the points; they carry classes to classes.
    """
    labels = np.arange(total)
    joined = np.concatenate([np.zeros((0, 2), dtype=int), *pairs])
    while True:
        images = [np.column_stack([p, p[labels]]) for p in permutations]
        first, second = np.concatenate([joined, *images]).T
        least = np.minimum(labels[first], labels[second])
        lower = labels.copy()
        for places in (first, second, labels[first], labels[second]):
            np.minimum.at(lower, places, least)
        lower = lower[lower]
        if np.array_equal(lower, labels):
            return labels
        labels = lower


def _star(indices: np.ndarray) -> np.ndarray:
    """Pairs that join all of some points."""
    return np.column_stack([np.full(len(indices), indices[0]), indices])


def _by_label(labels: np.ndarray, among: np.ndarray) -> list[np.ndarray]:
    """Some points by their labels, smallest first."""
    order = among[np.argsort(labels[among], kind="stable")]
    return np.split(order, np.flatnonzero(np.diff(labels[order])) + 1) if len(order) else []


def _found_components(state: _State, tracker: Tracker) -> bool:
    """Find components among open points, as far as traces and loops tell; False if a path fails."""
    while True:
        open_points = state.open_points()
        everything = _by_label(state.labels(state.loops), open_points)
        done = len(state.whole)
        tracker.tell("splitting", done, done + len(everything))
        units = _units(state, everything)
        if not units:
            return True
        trace, spent = state.trace.carried(state.points, np.concatenate(units), tracker)
        state.counts += spent
        state.trace = trace
        if trace is None:
            return False
        if not _took_back(state, units):
            break
    if not len(state.permutations):
        _doubt(state)
    return True


def _units(state: _State, classes: Sequence[np.ndarray]) -> list[np.ndarray]:
    """What components are to be made of: points, if they are few, else classes of loops.

    One of each orbit of classes.
    """
    if not len(state.permutations) and sum(map(len, classes)) <= MOST_CLASSES:
        return [each[i : i + 1] for each in classes for i in range(len(each))]
    chosen, seen = [], np.zeros(len(state.points), dtype=bool)
    for each in classes:
        orbits = state.orbits[each]
        if not seen[orbits].any():
            chosen.append(each)
            seen[orbits] = True
    return chosen


def _took_back(state: _State, units: Sequence[np.ndarray]) -> bool:
    """Confirm unions that are components; whether loops turned out to be wrong, and are gone."""
    for union in _linear_unions(state, units):
        points = np.sort(np.concatenate([units[k] for k in union]))
        parts = [points] if max(len(units[k]) for k in union) == 1 else _parts(state, points)
        if parts is None:
            continue
        if len(parts) > 1 and _discarded(state, parts):
            return True
        if len(parts) == 1:
            state.whole.append(points)
    return False


def _linear_unions(state: _State, units: Sequence[np.ndarray]) -> list[list[int]]:
    """Smallest unions of units with linear traces; of too many, units that are ones themselves."""
    if len(units) <= MOST_CLASSES:
        unions, state.trace = state.trace.smallest_unions(state.points, units)
        return unions or []
    return [[k] for k, own in enumerate(units) if _is_linear(state, own)]


def _is_linear(state: _State, indices: np.ndarray) -> bool | None:
    """Whether the trace of points is linear; each set is looked at once."""
    key = indices.tobytes()
    if key not in state.tested:
        state.tested[key], state.trace = state.trace.linear(state.points, indices.tolist())
    return state.tested[key]


def _parts(state: _State, points: np.ndarray) -> list[np.ndarray] | None:
    """The components that a set of points with a linear trace is made of.

    They are looked for among few points; among more, among the classes that each of the loops
    leaves when it is taken away. None if those are too many to tell.
    """
    if len(points) <= MOST_CLASSES:
        return _smallest_parts(state, [points[i : i + 1] for i in range(len(points))])
    for k in range(len(state.loops)):
        others = [each for j, each in enumerate(state.loops) if j != k]
        units = _by_label(state.labels(others), points)
        if len(units) > MOST_CLASSES:
            return None
        parts = _smallest_parts(state, units) if len(units) > 1 else [points]
        if parts is None or len(parts) > 1:
            return parts
    return [points]


def _smallest_parts(state: _State, units: Sequence[np.ndarray]) -> list[np.ndarray] | None:
    unions, state.trace = state.trace.smallest_unions(state.points, units)
    if not unions:
        return None
    return [np.concatenate([units[k] for k in union]) for union in unions]


def _discarded(state: _State, parts: Sequence[np.ndarray]) -> bool:
    """Discard loops that join points of different sets; whether there were any."""
    part = np.full(len(state.points), -1)
    for k, own in enumerate(parts):
        part[own] = k
    kept = [each for each in state.loops if not _joins_parts(state.labels([each]), part)]
    gone = len(state.loops) - len(kept)
    state.loops = kept
    state.discarded += gone
    return bool(gone)


def _joins_parts(labels: np.ndarray, part: np.ndarray) -> bool:
    """Whether a class holds points of different parts; those of part -1 do not count."""
    known = np.flatnonzero(part >= 0)
    pairs = np.unique(np.stack([labels[known], part[known]]), axis=1)
    return len(np.unique(pairs[0])) < pairs.shape[1]


def _doubt(state: _State) -> None:
    """Open components again that only seemed to be linear, where the other points are not together.

    All points of a set together have a linear trace; what others bend, these bend as well.
    """
    open_points = state.open_points()
    if not len(open_points) or not state.whole or _is_linear(state, open_points) is not False:
        return
    finer = state.trace.finer(open_points.tolist())
    if finer.evidence == state.trace.evidence:
        return
    state.trace = finer
    state.tested.clear()
    state.whole = [own for own in state.whole if _is_linear(state, own)]


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
        state.discarded += found.places is None
        return False
    new = found.places < 0
    places = np.where(new, len(state.points) + np.cumsum(new) - 1, found.places)
    pairs = np.column_stack([found.origins, places])
    if not np.isin(found.places[~new], open_points).all():
        state.discarded += 1
        return False
    for k in np.flatnonzero(new).tolist():
        _add(state, int(found.origins[k]), found.ends.z[k], found.ends.fine.get(k))
    before = state.labels(state.loops)
    state.loops.append(pairs)
    return not np.array_equal(before, state.labels(state.loops))


def _add(state: _State, origin: int, z: np.ndarray, fine: Fine | None) -> None:
    """A point that a loop from ``origin`` led to."""
    cut = state.points.cuts[state.points.which[origin]]
    state.points = state.points.with_point(cut, z, fine)
    state.orbits = np.append(state.orbits, len(state.orbits))


def _classes(state: _State, labels: np.ndarray) -> list[Class]:
    open_points = set(state.open_points().tolist())
    result = []
    for own in _by_label(labels, np.arange(len(labels))):
        reason = _reason(state, own) if int(own[0]) in open_points else ""
        result.append(Class(np.sort(own), reason))
    return result


def _reason(state: _State, own: np.ndarray) -> str:
    """Why an open class is not a component."""
    if state.trace is None or not set(own.tolist()) <= set(state.trace.ends):
        return NO_TRACE
    answer = _is_linear(state, own)
    return NO_DIGITS if answer is None else ONE_LOOP if answer else NOT_LINEAR
