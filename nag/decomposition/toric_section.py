"""The section of a set of turns by a slice, all at once and proved whole by counting.

A system in pairs (c, s) on circles is one in an algebraic torus in isotropic coordinates z and w,
z w = r: the equations between turns are linear ones in the z and, conjugate, in their inverses.
With as many slices as it takes there are no more isolated zeros than the mixed volume of the
monomials, and if so many are found, by multiplicity, there is nothing else: no other zero and no
set of larger dimension (Bernshtein, The number of roots of a system of equations, 1975, theorems A
and B). Where links are in general position a planar linkage has so many.

Zeros are found in doubles in z and w, and made zeros of the equations themselves on the slice, with
all their rational coefficients, before they are counted.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from nag.algebra.system import PolynomialSystem
from nag.algebra.turns import Turns, turns_of
from nag.decomposition.reduction import Reduction
from nag.decomposition.superset import Superset
from nag.solving.start.mixed_cells import MixedCells, mixed_cells
from nag.solving.start.polyhedral import polyhedral
from nag.solving.start.target import StartError, Target, Terms
from nag.tracking.compiled import compile_rows
from nag.tracking.homotopy import Homotopy
from nag.tracking.paths import PathStatus
from nag.tracking.settings import named
from nag.tracking.track import track
from nag.witness.cutting import Cut
from nag.witness.fibres import Tracker, homogeneous, moved
from nag.witness.slices import padded, random_rows
from nag.witness.witness import PathCounts


@dataclass(frozen=True, eq=False)
class ToricSection:
    """A system of turns and a slice, in isotropic coordinates of absolute value one.

    Attributes:
        reduction: the system.
        turns: its pairs and the equations between them.
        rows: the slice, in the reduced coordinates, shape ``(d, 1 + n)``.
    """

    reduction: Reduction
    turns: Turns
    rows: np.ndarray

    @classmethod
    def of(cls, reduction: Reduction, flag: np.ndarray) -> ToricSection | None:
        """The section by as many rows of the flag as leave points of the least dimension.

        None if the system is not one of turns, or has more equations than variables, or but one
        loop: these ask for so few paths that finding a start system takes longer.
        """
        system, reduced = reduction.system, reduction.reduced
        turns = None if system.nonzero else turns_of(system)
        if turns is None or len(turns.loops) < 2:
            return None
        if not 0 <= turns.freedoms == reduced.n - len(reduced.polynomials):
            return None
        return cls(reduction, turns, flag[: turns.freedoms])

    @cached_property
    def radii(self) -> np.ndarray:
        """Square roots of the circles' squared radii; the z and w are divided by them."""
        return np.sqrt(np.array([complex(float(r)) for r in self.turns.squares]))

    @cached_property
    def target(self) -> Target:
        """The circles, the equations in z, those in w, and the slice; first the z, then the w."""
        pairs, loops = len(self.turns.pairs), self.turns.loops
        none = np.zeros((len(loops), pairs))
        own, ones = loops[:, :-1] * self.radii, loops[:, -1:]
        across = loops[:, :-1].conj() * self.radii
        linear = [
            *np.hstack([own, none, ones]),
            *np.hstack([none, across, ones.conj()]),
            *self._slices,
        ]
        n = 2 * pairs
        circles = []
        for k in range(pairs):
            product = tuple(int(i % pairs == k) for i in range(n))
            circles.append({product: 1.0, (0,) * n: -1.0})
        return Target(n, (*circles, *map(_terms, linear)), in_torus=True)

    @cached_property
    def _slices(self) -> np.ndarray:
        """The slices' coefficients of the z and w and, last, of one."""
        frame = self.reduction.frame
        own = np.zeros((len(self.rows), self.reduction.system.n), dtype=complex)
        own[:, frame.positions] = self.rows[:, 1:] / frame.scales
        c, s = (own[:, [pair[k] for pair in self.turns.pairs]] for k in (0, 1))
        z, w = (c - 1j * s) / 2 * self.radii, (c + 1j * s) / 2 * self.radii
        return np.hstack([z, w, self.rows[:, :1]])

    def cells(self, rng: np.random.Generator) -> MixedCells:
        """The mixed cells, those of the z alone: where no circle is lifted, w is the inverse of z.

        Raises:
            StartError: if there are too many.
        """
        pairs, supports = len(self.turns.pairs), self.target.supports
        inner = [support[:, :pairs] - support[:, pairs:] for support in supports[pairs:]]
        found = mixed_cells([support - support.min(axis=0) for support in inner], rng)
        circles = np.broadcast_to(np.arange(2), (len(found.edges), pairs, 2))
        return MixedCells(
            supports,
            (*(np.zeros(2) for _ in range(pairs)), *found.lifts),
            np.concatenate([circles, found.edges], axis=1),
            found.volumes,
        )

    def reduced(self, isotropic: np.ndarray) -> np.ndarray:
        """Points given by z and w in the coordinates of the reduced system, shape ``(P, n)``."""
        pairs, frame = len(self.turns.pairs), self.reduction.frame
        z, w = isotropic[:, :pairs] * self.radii, isotropic[:, pairs:] * self.radii
        x = np.zeros((len(z), 2 * pairs), dtype=complex)
        x[:, [c for c, _ in self.turns.pairs]] = (z + w) / 2
        x[:, [s for _, s in self.turns.pairs]] = (z - w) / 2j
        return x[:, frame.positions] / frame.scales


def _terms(linear: Sequence[complex]) -> Terms:
    """The terms of a linear row, the constant last."""
    n = len(linear) - 1
    exponents = [tuple(int(i == j) for j in range(n)) for i in range(n + 1)]
    return {e: complex(c) for e, c in zip(exponents, linear, strict=True) if c}


def section_at_once(
    reduction: Reduction, flag: np.ndarray, rng: np.random.Generator, tracker: Tracker
) -> tuple[Superset | None, PathCounts]:
    """Witness points of a set of turns of the least dimension, if they are proved to be all.

    Also what paths that took. None if the system is not one of turns, or if there are fewer zeros
    than the mixed volume: the set may be one of larger dimension, or meet infinity.
    """
    section = ToricSection.of(reduction, flag)
    if section is None:
        return None, PathCounts()
    try:
        cells = section.cells(rng)
        if not cells.mixed_volume:
            return None, PathCounts()
        begin = polyhedral(section.target, cells, rng, tracker.threads)
    except StartError:
        return None, PathCounts()
    # Ends that take more digits are not all regular ones.
    settings = replace(named(tracker.settings), digits=16)
    paths = track(begin.homotopy, begin.points, settings, tracker.threads, endgame=False)
    counts = PathCounts(len(paths))
    if not (paths.status == PathStatus.REGULAR).all():
        return None, counts
    points = section.reduced(begin.affine(paths.points))
    own = Cut(reduction.n, 0, reduction.reduced.polynomials)
    at_rest = Homotopy(compile_rows(own.polynomials, n=own.n), padded(section.rows, 1 + own.n))
    ends = moved(
        track(at_rest, homogeneous(points), settings, tracker.threads, endgame=False), keep=own.n
    )
    if not ends.regular.all():
        return None, counts
    d = len(section.rows)
    fibre = ends.fibre(own, d, range(len(points)))
    return Superset({d: [fibre]}, flag, PathCounts(), ()), counts


def paths_at_once(system: PolynomialSystem) -> int | None:
    """How many paths `section_at_once` tracks; None if the system is not one of turns."""
    reduction, rng = Reduction.of(system), np.random.default_rng(0)
    section = ToricSection.of(reduction, random_rows(rng, reduction.n, reduction.n))
    try:
        return None if section is None else section.cells(rng).mixed_volume or None
    except StartError:
        return None
