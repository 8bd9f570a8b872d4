"""Points on one slice, each with the square system that cuts it, under indices that stay."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from nag.tracking.run import Run
from nag.witness.close_points import (
    CLOSE,
    DIGITS,
    PointInWords,
    close_pairs,
    distance,
    fine_of_balls,
    select_fine,
    zero_from,
)
from nag.witness.cutting import Cut
from nag.witness.exact_points import FEWEST, ExactPoints, exact_points, join_points
from nag.witness.fibres import STEEPER, Fibre, move
from nag.witness.witness import PathCounts


@dataclass(frozen=True, eq=False)
class Points:
    """Points of pure-dimensional sets on a common slice.

    Attributes:
        rows: the slice, shape ``(d, 1 + n)``.
        cuts: square systems that cut them.
        which: for each point, the index of its cut.
        z: each point with the unknowns that deflation added, shape ``(n + aux,)``.
        fine: more digits of points that are close to others, by their indices.
        known: all points in the fewest digits that are of use, where these have been found.
    """

    rows: np.ndarray
    cuts: tuple[Cut, ...] = ()
    which: tuple[int, ...] = ()
    z: tuple[np.ndarray, ...] = ()
    fine: Mapping[int, PointInWords] = field(default_factory=dict)
    known: ExactPoints | None = None

    @classmethod
    def of(cls, fibres: Sequence[Fibre], close: float = CLOSE) -> Points:
        """The points of fibres, in their order; those that are ``close`` in many digits."""
        rows = fibres[0].rows
        which = [k for k, fibre in enumerate(fibres) for _ in range(len(fibre))]
        z = [z for fibre in fibres for z in fibre.points]
        fine, first = {}, 0
        for fibre in fibres:
            fine |= {first + i: each for i, each in fibre.fine.items()}
            first += len(fibre)
        points = cls(rows, tuple(fibre.cut for fibre in fibres), tuple(which), tuple(z), fine)
        return points._with_fine(close)

    def _with_fine(self, close: float) -> Points:
        """With more digits of all points that are close to others, where they can be found."""
        pairs = close_pairs(self.x, close)
        fine = dict(self.with_digits(pairs).fine)
        steepest = {i: each.curvature for i, each in fine.items()}
        for pair in pairs:
            steep = STEEPER * self._size(pair[0]) / max(self._distance_of_pair(pair, fine), 1e-300)
            for i in pair:
                if i in fine:
                    steepest[i] = max(steepest[i], steep)
        fine = {i: replace(each, curvature=steepest[i]) for i, each in fine.items()}
        return replace(self, fine=fine) if fine else self

    def with_digits(self, pairs: Sequence[tuple[int, int]]) -> Points:
        """With more digits of the points of some pairs, where they can be found."""
        fine, nearest = dict(self.fine), dict[int, float]()
        for pair in pairs:
            apart = self._distance_of_pair(pair, fine)
            for i in pair:
                nearest[i] = min(apart, nearest.get(i, np.inf))
        for i in sorted(nearest.keys() - fine.keys()):
            found = self._in_digits(i, nearest[i])
            if found is not None:
                fine[i] = found
        return replace(self, fine=fine) if pairs else self

    def _size(self, i: int) -> float:
        return 1 + float(np.linalg.norm(self.x[i]))

    def _distance_of_pair(self, pair: tuple[int, int], fine: Mapping[int, PointInWords]) -> float:
        i, j = pair
        return distance(self.x[i], fine.get(i), self.x[j], fine.get(j))

    def _in_digits(self, i: int, apart: float) -> PointInWords | None:
        """More digits of a point in doubles that is so far from the next one."""
        steep = STEEPER * self._size(i) / max(apart, 1e-300)
        cut, start = self.cuts[self.which[i]], PointInWords.of_doubles(self.z[i], steep)
        found = zero_from(cut.polynomials, self.rows, start, DIGITS)
        return None if found is None else fine_of_balls(found.centre, steep)

    def __len__(self) -> int:
        return len(self.z)

    @property
    def n(self) -> int:
        return self.rows.shape[1] - 1

    @property
    def dimension(self) -> int:
        return len(self.rows)

    @cached_property
    def x(self) -> np.ndarray:
        """The points without added unknowns, shape ``(P, n)``."""
        return np.array([z[: self.n] for z in self.z]).reshape(len(self), self.n)

    @property
    def sizes(self) -> np.ndarray:
        """Sizes of the homogeneous coordinates ``(1, x)`` of the sets, shape ``(1 + n,)``."""
        return self.cuts[0].sizes if self.cuts else np.ones(1 + self.n)

    def fibres(self, indices: Sequence[int]) -> list[tuple[Fibre, np.ndarray]]:
        """The points of given indices by their cuts, with the indices of those of each."""
        found = []
        which = np.array(self.which, dtype=int)
        indices = np.asarray(indices, dtype=int)
        for k, cut in enumerate(self.cuts):
            own = indices[which[indices] == k]
            if len(own):
                points = np.array([self.z[i] for i in own])
                found.append((Fibre(cut, self.rows, points, select_fine(self.fine, own)), own))
        return found

    def only(self, indices: Sequence[int]) -> Points:
        """Some of the points, in this order."""
        which = tuple(self.which[i] for i in indices)
        z = tuple(self.z[i] for i in indices)
        return Points(self.rows, self.cuts, which, z, select_fine(self.fine, np.asarray(indices)))

    @cached_property
    def exact(self) -> ExactPoints:
        """All points in the fewest digits that are of use, in their order."""
        if self.known is not None:
            return self.known
        fibres = self.fibres(range(len(self)))
        parts = [exact_points(fibre, FEWEST) for fibre, _ in fibres]
        order = np.concatenate([own for _, own in fibres])
        return join_points(parts).only(np.argsort(order))

    def with_point(self, cut: Cut, z: np.ndarray, fine: PointInWords | None = None) -> Points:
        """One point more, at the end."""
        cuts = self.cuts if cut in self.cuts else (*self.cuts, cut)
        known = self.fine if fine is None else {**self.fine, len(self): fine}
        return Points(self.rows, cuts, (*self.which, cuts.index(cut)), (*self.z, z), known)


def with_fine(fibres: Sequence[Fibre], close: float = CLOSE) -> list[Fibre]:
    """Fibres on a common slice with more digits of all points that are close to others."""
    if not close_pairs(np.vstack([fibre.x for fibre in fibres]), close):
        return list(fibres)
    points = Points.of(fibres, close)
    return [fibre for fibre, _ in points.fibres(range(len(points)))]


def move_points(
    points: Points, indices: Sequence[int], target: np.ndarray, gamma: complex, run: Run
) -> tuple[Points, np.ndarray, PathCounts]:
    """Some points when the slice moves to another generic one.

    Returns the points there, and which ones they were; paths that did not end regularly are left
    out.
    """
    counts = PathCounts()
    found: dict[int, tuple[np.ndarray, PointInWords | None]] = {}
    parts = points.fibres(indices)
    fibres, sizes = [fibre for fibre, _ in parts], points.sizes
    moves = move(fibres, target, gamma, run, sizes=sizes)
    for there, (_, own) in zip(moves, parts, strict=True):
        counts += there.counts.judged_elsewhere
        for k in np.flatnonzero(there.regular).tolist():
            found[int(own[k])] = there.points[k], there.fine.get(k)
    origins = np.array(sorted(found), dtype=int)
    which = tuple(points.which[i] for i in origins)
    fine = {k: f for k, i in enumerate(origins.tolist()) if (f := found[i][1]) is not None}
    z = tuple(found[i][0] for i in origins.tolist())
    return Points(target, points.cuts, which, z, fine), origins, counts
