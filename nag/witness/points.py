"""Points on one slice, each with the square system that cuts it, under indices that stay."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from nag.numerics.coincidence import coincident
from nag.witness.cutting import Cut
from nag.witness.fibres import Fibre, Tracker, move
from nag.witness.witness import PathCounts

# Relative error that ends of paths may have.
ERROR = 1e-10


@dataclass(frozen=True, eq=False)
class Points:
    """Points of pure-dimensional sets on a common slice.

    Attributes:
        rows: the slice, shape ``(d, 1 + n)``.
        cuts: square systems that cut them.
        which: for each point, the index of its cut.
        z: each point with the unknowns that deflation added, shape ``(n + aux,)``.
    """

    rows: np.ndarray
    cuts: tuple[Cut, ...] = ()
    which: tuple[int, ...] = ()
    z: tuple[np.ndarray, ...] = ()

    @classmethod
    def of(cls, fibres: Sequence[Fibre], rows: np.ndarray) -> Points:
        """The points of fibres, in their order."""
        which = [k for k, fibre in enumerate(fibres) for _ in range(len(fibre))]
        z = [z for fibre in fibres for z in fibre.points]
        return cls(rows, tuple(fibre.cut for fibre in fibres), tuple(which), tuple(z))

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

    def fibres(self, indices: Sequence[int]) -> tuple[list[Fibre], np.ndarray]:
        """The points of given indices by their cuts, and the indices in that order."""
        found, order = [], []
        which = np.array(self.which, dtype=int)
        indices = np.asarray(indices, dtype=int)
        for k, cut in enumerate(self.cuts):
            own = indices[which[indices] == k]
            if len(own):
                found.append(Fibre(cut, self.dimension, np.array([self.z[i] for i in own])))
                order.append(own)
        return found, np.concatenate(order) if order else np.zeros(0, dtype=int)

    def with_point(self, cut: Cut, z: np.ndarray) -> Points:
        """One point more, at the end."""
        cuts = self.cuts if cut in self.cuts else (*self.cuts, cut)
        return Points(self.rows, cuts, (*self.which, cuts.index(cut)), (*self.z, z))

    def place(self, x: np.ndarray) -> int | None:
        """The index of the point at ``x``, if there is one."""
        if not len(self):
            return None
        near = coincident(self.x, x, ERROR)
        return int(near.argmax()) if near.any() else None


def moved_points(
    points: Points, indices: Sequence[int], target: np.ndarray, gamma: complex, tracker: Tracker
) -> tuple[dict[int, np.ndarray], PathCounts]:
    """Ends of some points when the slice moves to another generic one.

    Returns them by the points' indices; paths that did not end regularly are left out.
    """
    counts, ends = PathCounts(), {}
    fibres, order = points.fibres(indices)
    first = 0
    for fibre in fibres:
        own, first = order[first : first + len(fibre)], first + len(fibre)
        there = move(fibre, points.rows, target, gamma, tracker)
        counts += there.counts.repeatable
        ends.update({int(i): there.points[k] for k, i in enumerate(own) if there.regular[k]})
    return ends, counts
