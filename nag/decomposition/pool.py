"""Some points of components on a common slice, and how loops complete them.

Monodromy loops find further points and join those of one component; the trace test says when a
component's are complete (Sommese, Verschelde & Wampler 2002).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from nag.decomposition.monodromy import carried
from nag.decomposition.superset import Progress
from nag.decomposition.trace import is_linear, second_differences
from nag.witness.cutting import Cut
from nag.witness.fibres import Fibre, Tracker, move
from nag.witness.slices import random_rows, unit_complex
from nag.witness.witness import PathCounts

# Loops after which a fibre that is not full is left undecided: 23 was the worst that was needed.
MOST_LOOPS = 60
# Points of a fibre nearer than this, relative to their size, are one.
SAME = 1e-8


@dataclass(frozen=True, eq=False)
class Pool:
    """Points of one dimension on a common slice, and which of them are known to belong together.

    Attributes:
        cuts: square systems that cut them.
        which: for each point, the index of its cut.
        points: with the unknowns that deflation added.
        labels: for each point, the smallest index of a point of the same component.
        hits: for each point, the number of starting points that led to it.
    """

    cuts: tuple[Cut, ...] = ()
    which: tuple[int, ...] = ()
    points: tuple[np.ndarray, ...] = ()
    labels: tuple[int, ...] = ()
    hits: tuple[int, ...] = ()

    def place(self, x: np.ndarray) -> int | None:
        """The index of the point at ``x``."""
        if not self.points:
            return None
        known = np.array([z[: len(x)] for z in self.points])
        distances = np.linalg.norm(known - x, axis=1)
        nearest = int(distances.argmin())
        return nearest if distances[nearest] < SAME * (1 + np.linalg.norm(x)) else None

    def arrived(self, cut: Cut, z: np.ndarray) -> Pool:
        """The pool after a starting point led to ``z``."""
        place = self.place(z[: cut.n])
        if place is not None:
            hits = [h + (i == place) for i, h in enumerate(self.hits)]
            return replace(self, hits=tuple(hits))
        cuts = self.cuts if cut in self.cuts else (*self.cuts, cut)
        return self.extended(cuts, cuts.index(cut), z, len(self.points), 1)

    def extended(
        self, cuts: tuple[Cut, ...], which: int, z: np.ndarray, label: int, hits: int
    ) -> Pool:
        """The pool with one more point."""
        return Pool(
            cuts,
            (*self.which, which),
            (*self.points, z),
            (*self.labels, label),
            (*self.hits, hits),
        )

    def joined(self, i: int, j: int) -> Pool:
        """The pool with the classes of two points made one."""
        low, high = sorted((self.labels[i], self.labels[j]))
        return replace(self, labels=tuple(low if k == high else k for k in self.labels))

    def fibres(self, indices: Sequence[int], d: int) -> tuple[list[Fibre], np.ndarray]:
        """The points of given indices by their cuts, and the indices in that order."""
        found, order = [], []
        for k, cut in enumerate(self.cuts):
            own = [i for i in indices if self.which[i] == k]
            if own:
                found.append(Fibre(cut, d, np.array([self.points[i] for i in own])))
                order += own
        return found, np.array(order, dtype=int)


def _looped(
    pool: Pool,
    active: Sequence[int],
    rows: np.ndarray,
    rng: np.random.Generator,
    tracker: Tracker,
) -> tuple[Pool, PathCounts]:
    """The pool after a random loop: ends are new points, or join two classes."""
    counts = PathCounts()
    middle = random_rows(rng, len(rows), rows.shape[1] - 1)
    out, back = unit_complex(rng, 2)
    fibres, order = pool.fibres(active, len(rows))
    first = 0
    for fibre in fibres:
        own, first = order[first : first + len(fibre)], first + len(fibre)
        there = move(fibre, rows, middle, complex(out), tracker)
        half = Fibre(fibre.cut, fibre.dimension, there.points[there.regular])
        again = move(half, middle, rows, complex(back), tracker)
        counts += there.counts.repeatable + again.counts.repeatable
        origins = own[there.regular][again.regular]
        for i, z in zip(origins, again.points[again.regular], strict=True):
            place = pool.place(z[: fibre.cut.n])
            if place is None:
                pool = pool.extended(pool.cuts, pool.which[i], z, pool.labels[i], 0)
            else:
                pool = pool.joined(i, place)
    return pool, counts


def _linear_classes(
    pool: Pool, active: Sequence[int], rows: np.ndarray, rng: np.random.Generator, tracker: Tracker
) -> tuple[set[int], PathCounts]:
    """Labels of the classes among ``active`` whose trace is linear, here and elsewhere."""
    fibres, order = pool.fibres(active, len(rows))
    labels = np.array(pool.labels)[order]
    passed = set(labels.tolist())
    counts = PathCounts()
    for elsewhere in (False, True):
        here, at = fibres, rows
        if elsewhere:
            at = random_rows(rng, len(rows), rows.shape[1] - 1)
            here, spent = carried(fibres, rows, at, complex(unit_complex(rng)), tracker)
            counts += spent
            if here is None:
                return set(), counts
        differences, spent = second_differences(here, at, rng, tracker)
        counts += spent
        if differences is None:
            return set(), counts
        passed = {label for label in passed if is_linear(differences[labels == label])}
        if not passed:
            break
    return passed, counts


def completed(
    pool: Pool,
    rows: np.ndarray,
    rng: np.random.Generator,
    tracker: Tracker,
    progress: Progress | None,
) -> tuple[Pool, set[int], PathCounts]:
    """The pool with all points of its components, and the labels of those that are complete."""
    counts, complete = PathCounts(), set[int]()
    if len(rows) == 0:
        return pool, set(pool.labels), counts
    for _k in range(MOST_LOOPS):
        if progress is not None:
            progress("completing", len(complete), len(set(pool.labels)))
        active = [i for i, label in enumerate(pool.labels) if label not in complete]
        if not active:
            break
        before = pool
        pool, spent = _looped(pool, active, rows, rng, tracker)
        counts += spent
        changed = set(pool.labels[len(before.labels) :])
        changed |= {new for old, new in zip(before.labels, pool.labels, strict=False) if old != new}
        idle = [i for i in active if pool.labels[i] not in changed]
        if idle:
            passed, spent = _linear_classes(pool, idle, rows, rng, tracker)
            counts += spent
            complete |= passed
    return pool, complete, counts
