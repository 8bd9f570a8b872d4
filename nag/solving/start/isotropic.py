"""All zeros of equations of turns, from a polyhedral start system in isotropic coordinates.

A system in pairs (c, s) on circles c^2 + N s^2 = r is one in an algebraic torus in the isotropic
coordinates z = c + i sqrt(N) s and w = c - i sqrt(N) s, whose products are known: the equations
between turns are linear ones in the z and, conjugate, in their inverses. With as many linear
equations more as it takes it has no more isolated zeros than the mixed volume of its monomials, and
if so many are found, by multiplicity, there is nothing else: no other zero and no set of positive
dimension (Bernshtein, The number of roots of a system of equations, 1975, theorems A and B). Planar
linkages with links in general position have so many.

Zeros are found in doubles here. Where they prove to be zeros of the equations themselves, whose
coefficients are rational in c and s but not in z and w, the count is a proof.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from math import sqrt

import numpy as np

from nag.algebra.system import PolynomialSystem
from nag.algebra.turns import Turns, looped_turns
from nag.errors import StartError
from nag.solving.start.mixed_cells import MixedCells, mixed_cells
from nag.solving.start.polyhedral import polyhedral
from nag.solving.start.target import StartSystem, Target, Terms, homogenize_rows
from nag.tracking.homotopy import Homotopy
from nag.tracking.known import KnownOfPaths
from nag.tracking.paths import PathStatus
from nag.tracking.settings import Settings, find_settings
from nag.tracking.track import track


@dataclass(frozen=True, eq=False)
class IsotropicSection:
    """Equations of turns and linear ones, in isotropic coordinates divided by the circles' radii.

    Attributes:
        turns: the pairs and the equations between them.
        slices: more linear equations, generic ones, that act on one and all c and s, complex, shape
            ``(turns.freedoms, 1 + n)``.
    """

    turns: Turns
    slices: np.ndarray

    @cached_property
    def _radii(self) -> np.ndarray:
        return np.sqrt(np.array([complex(float(r)) for r in self.turns.squares]))

    @cached_property
    def target(self) -> Target:
        """The circles, the equations in z, those in w, and the slices; first the z, then the w."""
        pairs, loops = len(self.turns.pairs), self.turns.loops
        none, ones = np.zeros((len(loops), pairs)), loops[:, -1:]
        own, across = loops[:, :-1] * self._radii, loops[:, :-1].conj() * self._radii
        c, s = (self.slices[:, [1 + pair[k] for pair in self.turns.pairs]] for k in (0, 1))
        turned = s * (1j / sqrt(self.turns.weight))
        z, w = (c - turned) / 2 * self._radii, (c + turned) / 2 * self._radii
        linear = [
            *np.hstack([own, none, ones]),
            *np.hstack([none, across, ones.conj()]),
            *np.hstack([z, w, self.slices[:, :1]]),
        ]
        circles = []
        for k in range(pairs):
            product = tuple(int(i % pairs == k) for i in range(2 * pairs))
            circles.append({product: 1.0, (0,) * (2 * pairs): -1.0})
        return Target(2 * pairs, (*circles, *map(_terms, linear)), in_torus=True)

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

    def zeros(
        self, settings: Settings | str, rng: np.random.Generator, threads: int
    ) -> tuple[np.ndarray | None, int]:
        """The c and s of all zeros, in doubles, shape ``(P, n)``; and how many paths were tracked.

        None unless as many regular ones are found as the mixed volume.
        """
        try:
            cells = self.cells(rng)
            if not cells.mixed_volume:
                return None, 0
            begin = polyhedral(self.target, cells, rng, threads)
        except StartError:
            return None, 0
        paths = track(begin.homotopy, begin.points, in_doubles(settings), threads, endgame=False)
        if not (paths.status == PathStatus.REGULAR).all():
            return None, len(paths)
        ends, pairs = begin.affine(paths.points), len(self.turns.pairs)
        z, w = ends[:, :pairs] * self._radii, ends[:, pairs:] * self._radii
        x = np.zeros_like(ends)
        x[:, [c for c, _ in self.turns.pairs]] = (z + w) / 2
        x[:, [s for _, s in self.turns.pairs]] = (z - w) / (2j * sqrt(self.turns.weight))
        return x, len(paths)


def in_doubles(settings: Settings | str) -> Settings:
    """The settings without more digits: where it takes them, not all zeros are regular."""
    return replace(find_settings(settings), digits=16)


def _terms(linear: np.ndarray) -> Terms:
    """The terms of a linear row, the constant last, the largest one of size one.

    None is left out, however small: the bound counts them all.
    """
    n = len(linear) - 1
    exponents = [tuple(int(i == j) for j in range(n)) for i in range(n + 1)]
    kept, size = np.flatnonzero(linear), np.abs(linear).max()
    return {exponents[i]: complex(linear[i] / size) for i in kept.tolist()}


def isotropic(
    system: PolynomialSystem,
    target: Target,
    settings: Settings | str,
    rng: np.random.Generator,
    threads: int,
) -> tuple[StartSystem, str] | None:
    """The target at rest, at all its zeros, and why that; None if these are not found.

    Args:
        target: what is tracked of the system, with the same zeros.
    """
    natural = system if target.natural is None else target.natural.system(system)
    turns = looped_turns(natural)
    if turns is None or turns.freedoms:
        return None
    x, _ = IsotropicSection(turns, np.zeros((0, 1 + system.n))).zeros(settings, rng, threads)
    if x is None:
        return None
    groups = (tuple(range(target.n)),)
    degrees = np.array(target.degrees)[:, None]
    rows = homogenize_rows(target.rows, target.n, groups, degrees)
    points = np.hstack([np.ones((len(x), 1)), x * np.exp2(-np.array(target.scales, dtype=float))])
    start = StartSystem(
        "polyhedral",
        Homotopy(rows, digits=target.digits),
        points,
        groups,
        detail="in isotropic coordinates",
        known=KnownOfPaths(bound=len(x)),
    )
    return start, f"polyhedral, in isotropic coordinates: mixed volume {len(x)}, and as many zeros"
