"""Points on a slice split into irreducible components: traces decide, loops suggest.

A component is a smallest set of points whose trace is linear. Among points that are not too many
these sets are found from the points alone: by lattice reduction of second differences, or by the
equations that power sums satisfy. Among more, monodromy loops first join points that ought to be of
one component, and they find points of it that are missing. A loop that took one path for another
joins wrongly, so that what it joined can be taken back: parts of a class are looked for, and it has
to be found again without any one of the loops. A loop that joins points of different components is
discarded.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from nag.algebra.symmetry import SignedPermutation
from nag.decomposition.monodromy import run_loop
from nag.decomposition.power_sums import PowerSums
from nag.decomposition.trace import Trace
from nag.numerics.coincidence import group_by_label, join_labels
from nag.tracking.run import Run
from nag.witness.points import Points
from nag.witness.witness import PathCounts

# Loops that join nothing before slices near the origin are given up; and loops after which to give
# up: the worst of the measured systems needed 46.
IDLE_LOOPS = 4
# Decides, measured: Loops before points are left undecided; 23 were the most needed.
MOST_LOOPS = 100
# Up to how many points, or classes of loops, components are found by lattice reduction at once; how
# many it can tell apart where power sums do not; and up to how many these are used: beyond, loops
# take less time. Lattices take 1 ms for 12, 20 ms for 40; power sums 5 ms for 36, 40 ms for 216.
FEW_CLASSES, MOST_IN_LATTICE, MOST_CLASSES = 12, 40, 300

NOT_LINEAR = "its trace is not linear: points are missing, or loops did not join them"
NO_TRACE = "the trace could not be computed"
NO_DIGITS = "whether its trace is linear needs more digits"
LOST = "its power sums are those of a component, its trace is not: a path was lost"
ONE_LOOP = "its points are joined by one loop alone, or traces of parts of it need more digits"


@dataclass(frozen=True, eq=False)
class Class:
    """Points of one component, as indices into all points.

    Attributes:
        reason: why they could not be confirmed to be a whole component; empty if they were.
        carriers: for each other component of its orbit a symmetry that carries this one into it.
    """

    indices: np.ndarray
    reason: str = ""
    carriers: tuple[SignedPermutation, ...] = ()


@dataclass(frozen=True, eq=False)
class Split:
    """Points, those that loops added included, and their classes.

    Attributes:
        labels: for each point the smallest index in its class.
        classes: that hold each point once; up to symmetry, where it is known, one of each orbit.
        discarded: number of loops that were no permutation of points, or that joined points of
            different components.
        notes: what symmetries show to be wrong with the points: where the image of one is not
            among them, some are missing.
    """

    points: Points
    labels: np.ndarray
    classes: tuple[Class, ...]
    counts: PathCounts
    discarded: int = 0
    notes: tuple[str, ...] = ()


@dataclass(eq=False)
class _Splitting:
    """What is known while points are split.

    Attributes:
        trace: None where a path of it failed.
        sums: equations that power sums over components satisfy, by the bytes of points' indices.
        loops: for each the pairs of points that it joins, shape ``(m, 2)``.
        whole: sets of points that are components, as far as is known.
        tested: whether traces of sets are linear, by the bytes of their indices.
        unclear: bytes of the indices of points among which the components were not clear.
        growing: whether the last loop found points: then others are likely to be missing, and only
            classes are looked at that may be whole.
        lost: whether a path of the trace ended at a point of another component.
    """

    points: Points
    rng: np.random.Generator
    trace: Trace | None
    sums: dict[bytes, PowerSums] = field(default_factory=dict)
    loops: list[np.ndarray] = field(default_factory=list)
    whole: list[np.ndarray] = field(default_factory=list)
    tested: dict[bytes, bool | None] = field(default_factory=dict)
    unclear: set[bytes] = field(default_factory=set)
    growing: bool = False
    lost: bool = False
    discarded: int = 0
    counts: PathCounts = field(default_factory=PathCounts)

    def open_points(self) -> np.ndarray:
        """Points of no component that is known."""
        is_open = np.ones(len(self.points), dtype=bool)
        for own in self.whole:
            is_open[own] = False
        return np.flatnonzero(is_open)

    def labels(self, without: int = -1) -> np.ndarray:
        """Labels of the classes that loops join, perhaps without one of them."""
        pairs = [each for k, each in enumerate(self.loops) if k != without]
        return join_labels(len(self.points), pairs)


def split_points(points: Points, evidence: int, rng: np.random.Generator, run: Run) -> Split:
    """Split points on a generic slice into irreducible components.

    Args:
        evidence: digits to which a trace must be linear.
    """
    total = len(points)
    if points.dimension == 0:
        classes = tuple(Class(np.array([i])) for i in range(total))
        return Split(points, np.arange(total), classes, PathCounts())
    state = _Splitting(points, rng, Trace.of(points, evidence, rng))
    idle = 0
    for _ in range(MOST_LOOPS):
        if not _find_components(state, run):
            break
        open_points = state.open_points()
        if not len(open_points) or state.lost:
            break
        idle = 0 if _run_loop(state, open_points, run, idle >= IDLE_LOOPS) else idle + 1
    return _split_of(state)


def split_joined_points(
    points: Points,
    trace: Trace,
    loops: Sequence[np.ndarray],
    rng: np.random.Generator,
    run: Run,
) -> Split:
    """Split points that loops have joined, without any more of them.

    Args:
        trace: of all the points.
        loops: for each the pairs of points that it joins, shape ``(m, 2)``.
    """
    state = _Splitting(points, rng, trace, loops=list(loops))
    _find_components(state, run)
    return _split_of(state)


def _split_of(state: _Splitting) -> Split:
    known = state.points if state.trace is None else state.trace.sharper(state.points)
    pairs = [*state.loops, *(np.column_stack([np.full(len(w), w[0]), w]) for w in state.whole)]
    labels = join_labels(len(known), pairs)
    classes = tuple(_classes(state, labels))
    return Split(known, labels, classes, state.counts, state.discarded)


def _find_components(state: _Splitting, run: Run) -> bool:
    """Find components among open points, as far as traces and loops tell; False if a path fails."""
    while True:
        open_points = state.open_points()
        classes = group_by_label(state.labels(), open_points)
        run.tell("splitting", len(state.whole), len(state.whole) + len(classes))
        state.trace, spent = state.trace.carry(state.points, open_points, run)
        state.counts += spent
        if state.trace is None:
            return False
        found = None if state.growing else _smallest_unions(state, list(open_points[:, None]))
        if found is not None:
            state.whole += found
            break
        if not _take_back_loops(state, classes):
            break
    _doubt_components(state)
    return True


def _take_back_loops(state: _Splitting, classes: Sequence[np.ndarray]) -> bool:
    """Confirm unions of classes of loops; whether loops turned out to be wrong, and are gone."""
    unions = None if state.growing else _smallest_unions(state, classes)
    if unions is None:
        unions = [own for own in classes if _is_linear(state, own)]
    for union in unions:
        parts = _parts(state, union)
        if parts is not None and len(parts) == 1:
            state.whole.append(union)
        elif parts is not None and _discard_loops(state, parts):
            return True
    return False


def _parts(state: _Splitting, points: np.ndarray) -> list[np.ndarray] | None:
    """The components that a set of points with a linear trace is made of.

    They are looked for among the points, if these are few, and else among the classes that each of
    the loops leaves when it is taken away. None if it is not clear which they are.
    """
    parts = _smallest_unions(state, list(points[:, None]))
    if parts:
        return parts
    for k in range(len(state.loops)):
        units = group_by_label(state.labels(without=k), points)
        parts = _smallest_unions(state, units) if len(units) > 1 else [points]
        if not parts or len(parts) > 1:
            return parts or None
    return [points]


def _smallest_unions(state: _Splitting, units: Sequence[np.ndarray]) -> list[np.ndarray] | None:
    """Smallest unions of units with linear traces; None if these are too many, or not clear."""
    key = b"".join(own.tobytes() + b"|" for own in units)
    if not units or key in state.unclear:
        return None if units else []
    unions, count = None, sum(map(len, units))
    # Power sums cost by the points, lattices by the units.
    few = FEW_CLASSES if count <= MOST_CLASSES else MOST_IN_LATTICE
    if few < len(units) <= MOST_CLASSES:
        unions = _unions_by_sums(state, units)
    if unions is None and len(units) <= MOST_IN_LATTICE:
        places, state.trace = state.trace.smallest_unions(state.points, units)
        unions = None if places is None else _union_of_each(units, places)
    if unions is None:
        state.unclear.add(key)
    return unions


def _unions_by_sums(state: _Splitting, units: Sequence[np.ndarray]) -> list[np.ndarray] | None:
    """The same by power sums, where traces confirm them."""
    covered = np.sort(np.concatenate(units))
    key = covered.tobytes()
    if key not in state.sums:
        unknowns = min(len(covered), MOST_CLASSES)
        state.sums[key] = PowerSums.of(state.points.only(covered), unknowns, state.rng)
    places = state.sums[key].smallest_unions([np.searchsorted(covered, own) for own in units])
    if places is None:
        return None
    unions = _union_of_each(units, places)
    bent = [own for own in unions if not _is_linear(state, own)]
    # Power sums are those of the points where they are; traces follow paths.
    state.lost |= any(state.trace.is_surely_bent(own.tolist()) for own in bent)
    return None if bent and not state.lost else [own for own in unions if _is_linear(state, own)]


def _union_of_each(
    units: Sequence[np.ndarray], places: Sequence[Sequence[int]]
) -> list[np.ndarray]:
    return [np.sort(np.concatenate([units[k] for k in own])) for own in places]


def _is_linear(state: _Splitting, indices: np.ndarray) -> bool | None:
    """Whether the trace of points is linear; each set is looked at once."""
    key = indices.tobytes()
    if key not in state.tested:
        state.tested[key], state.trace = state.trace.linear(state.points, indices.tolist())
    return state.tested[key]


def _discard_loops(state: _Splitting, parts: Sequence[np.ndarray]) -> bool:
    """Discard loops that join points of different sets; whether there were any."""
    part = np.full(len(state.points), -1)
    for k, own in enumerate(parts):
        part[own] = k
    kept = [each for each in state.loops if not _joins_parts(*part[each].T)]
    gone = len(state.loops) - len(kept)
    state.loops = kept
    state.discarded += gone
    return bool(gone)


def _joins_parts(first: np.ndarray, second: np.ndarray) -> bool:
    """Whether there are pairs in different parts; those of part -1 do not count."""
    return bool(((first != second) & (first >= 0) & (second >= 0)).any())


def _doubt_components(state: _Splitting) -> None:
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
    state.unclear.clear()
    state.whole = [own for own in state.whole if _is_linear(state, own)]


def _run_loop(state: _Splitting, open_points: np.ndarray, run: Run, scaled: bool) -> bool:
    """Track a random loop from open points; whether it joined some or found any."""
    found, spent = run_loop(state.points, open_points, state.rng, run, scaled)
    state.counts += spent
    new = None if found.places is None else found.places < 0
    if new is None or not np.isin(found.places[~new], open_points).all():
        state.discarded += 1
        state.growing = False
        return False
    state.growing = bool(new.any())
    state.points, pairs = found.join_to(state.points)
    before = state.labels()
    state.loops.append(pairs)
    return not np.array_equal(before, state.labels())


def _classes(state: _Splitting, labels: np.ndarray) -> list[Class]:
    whole = {int(own[0]) for own in state.whole}
    return [
        Class(own, "" if int(own[0]) in whole else _reason(state, own))
        for own in group_by_label(labels, np.arange(len(labels)))
    ]


def _reason(state: _Splitting, own: np.ndarray) -> str:
    """Why an open class is not a component."""
    if state.trace is None or not set(own.tolist()) <= set(state.trace.ends):
        return NO_TRACE
    if state.lost:
        return LOST
    answer = _is_linear(state, own)
    return NO_DIGITS if answer is None else ONE_LOOP if answer else NOT_LINEAR
