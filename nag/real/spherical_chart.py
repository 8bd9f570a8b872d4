"""Coordinates in which infinity of a joint's variables is a place like any other.

The variables of a joint's turn, or of a body's pose, are ratios: a half-angle's tangent, the three
of a quaternion. They are infinite where their common denominator vanishes, at a half turn of a
spherical joint as of a revolute one. Here the denominator is a coordinate, too, and each group has
the length one of its norm: that of cosine and sine of a half-angle, or of a unit quaternion. A sign
is left free for each group; along a motion it is the one that makes coordinates continuous.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.real.closure import homogeneous_norms

# Denominators of unit vectors that are zero to rounding: variables are not larger than its inverse.
LEAST_DENOMINATOR = 1e-17


@dataclass(frozen=True, eq=False)
class SphericalChart:
    """Variables of a system, those of some groups homogeneous and of length one.

    Coordinates are the variables, in their order, and then the denominators, one a group.

    Attributes:
        n: number of variables.
        groups: their indices, of each group that has a norm.
        norms: these, in the denominator and the group's variables.
    """

    n: int
    groups: tuple[tuple[int, ...], ...]
    norms: tuple[Polynomial, ...]

    @classmethod
    def of(cls, system: PolynomialSystem) -> SphericalChart:
        """That of a system's groups with norms; its other variables are coordinates themselves."""
        own = [(g, norms) for g in system.groups if (norms := homogeneous_norms(system, g))]
        sums = tuple(sum(norms[1:], norms[0]) for _, norms in own)
        return cls(system.n, tuple(g for g, _ in own), sums)

    @property
    def size(self) -> int:
        """Number of coordinates."""
        return self.n + len(self.groups)

    @cached_property
    def columns(self) -> tuple[list[int], ...]:
        """The coordinates of each group, its denominator first."""
        return tuple([self.n + k, *own] for k, own in enumerate(self.groups))

    @cached_property
    def _evaluators(self) -> list[Evaluator]:
        return [Evaluator.of([f], f.n) for f in self.norms]

    def normalise(self, chart: np.ndarray) -> np.ndarray:
        """The same points with groups of length one, shape ``(k, size)``."""
        chart = np.array(chart)
        for columns, norm in zip(self.columns, self._evaluators, strict=True):
            # First by the largest: squares of what is nearly infinite are too large for doubles.
            own = chart[:, columns] / np.abs(chart[:, columns]).max(axis=1, keepdims=True)
            length = np.sqrt(np.maximum(norm.values(own + 0j).real[:, :1], np.finfo(float).tiny))
            chart[:, columns] = own / length
        return chart

    def chart(self, points: np.ndarray) -> np.ndarray:
        """Coordinates of points in the variables, shape ``(k, n)``, with positive denominators."""
        return self.normalise(np.hstack([points, np.ones((len(points), len(self.groups)))]))

    def points(self, chart: np.ndarray) -> np.ndarray:
        """Points in the variables; very large where denominators vanish."""
        points = np.array(chart[:, : self.n])
        for first, *own in self.columns:
            below = chart[:, first]
            small = np.abs(below) < LEAST_DENOMINATOR
            below = np.where(small, np.copysign(LEAST_DENOMINATOR, below), below)
            points[:, own] /= below[:, None]
        return points

    def align_signs(self, chart: np.ndarray, to: np.ndarray) -> np.ndarray:
        """Points with the signs of groups that bring them next to others, or to one."""
        chart = np.array(chart)
        for columns in self.columns:
            away = (chart[:, columns] * to[..., columns]).sum(axis=1) < 0
            chart[np.ix_(away, columns)] *= -1
        return chart

    def make_continuous(self, chart: np.ndarray) -> np.ndarray:
        """Points along a curve with signs of groups that do not jump; those of the first stay."""
        chart = np.array(chart)
        for columns in self.columns:
            own = chart[:, columns]
            jumps = np.where((own[1:] * own[:-1]).sum(axis=1) < 0, -1.0, 1.0)
            chart[1:, columns] *= np.cumprod(jumps)[:, None]
        return chart

    def directions_of_scaling(self, chart: np.ndarray) -> np.ndarray:
        """Unit vectors along which only lengths of groups change, shape ``(k, groups, size)``."""
        found = np.zeros((len(chart), len(self.groups), self.size))
        for k, columns in enumerate(self.columns):
            own = chart[:, columns]
            found[:, k, columns] = own / np.linalg.norm(own, axis=1, keepdims=True)
        return found
