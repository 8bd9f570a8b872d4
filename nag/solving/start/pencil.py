"""Pencils of systems whose number of solutions the linear trace test proves.

All equations but one have fixed generic coefficients and define a curve; the last one is
``f + s g`` with both of its support. Points ``(x, s)`` of this curve on the hyperplane
``s = l(x) + u`` are the solutions of a system with one support enlarged by a simplex, and the sum
of a linear function over all of them is linear in u; over fewer it is not, as the curve is
irreducible. No mixed volume is needed.

References:
    Sommese, Verschelde & Wampler, Symmetric functions applied to decomposing solution sets of
    polynomial systems, 2002; Leykin, Rodriguez & Sottile, Trace test, 2018.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from nag.solving.start.fibre_monodromy import GenericSystem
from nag.solving.start.target import group_degrees, homogenized, unit
from nag.tracking.homotopy import straight_line
from nag.tracking.settings import named
from nag.tracking.track import track_regular

# What rounding leaves at most of the sum of second differences over all points, in units of the
# points' motion; and how much larger each point's own must be for its absence to show.
ROUNDING, VISIBLE = 1e-12, 10.0


@dataclass(frozen=True, eq=False)
class Pencil:
    """A pencil in one of the equations.

    Attributes:
        supports: of the equations, each with the origin, shape ``(terms, n)``.
        row: the equation that is ``f + s g``.
        coefficients: of all equations, in this one of ``f``.
        direction: coefficients of ``g``.
        form: coefficients of ``l``, the constant one first, shape ``(1 + n,)``.
    """

    supports: tuple[np.ndarray, ...]
    row: int
    coefficients: tuple[np.ndarray, ...]
    direction: np.ndarray
    form: np.ndarray

    def system(self, shift: complex = 0.0, points: np.ndarray | None = None) -> GenericSystem:
        """The system at ``u = shift``, and solutions of it."""
        n = len(self.supports)
        support = self.supports[self.row]
        moved = [support] + [support + unit_vector for unit_vector in np.eye(n, dtype=np.int64)]
        enlarged, place = np.unique(np.concatenate(moved), axis=0, return_inverse=True)
        c = np.zeros(len(enlarged), dtype=np.complex128)
        form = self.form + shift * np.eye(1 + n)[0]
        weights = np.concatenate([w * self.direction for w in form])
        weights[: len(support)] += self.coefficients[self.row]
        np.add.at(c, place.ravel(), weights)
        supports, coefficients = list(self.supports), list(self.coefficients)
        supports[self.row], coefficients[self.row] = enlarged, c
        if points is None:
            points = np.zeros((0, 1 + n), dtype=np.complex128)
        errors = np.zeros(len(points))
        return GenericSystem(tuple(supports), tuple(coefficients), points, errors)


def irreducible_row(supports: Sequence[np.ndarray], rng: np.random.Generator) -> int | None:
    """An equation without which the others define an irreducible curve, if there is one.

    For generic coefficients, and supports with the origin, the curve is irreducible if the
    supports of any k of the others span more than k dimensions (Khovanskii, Newton polytopes and
    irreducible components of complete intersections, 2016). By Rado's theorem that holds if
    random vectors of their spans, two of any one of them, are independent.
    """
    n = len(supports)

    def in_span(i: int) -> np.ndarray:
        return rng.normal(size=len(supports[i])) @ supports[i]

    degrees = [int(s.sum(axis=1).max()) for s in supports]
    # A row of high degree gains the fewest solutions by a form that is linear.
    for row in sorted(range(n), key=lambda i: (-degrees[i], len(supports[i]), i)):
        others = [i for i in range(n) if i != row]
        if all(
            np.linalg.matrix_rank(np.array([in_span(i) for i in (*others, twice)])) == n
            for twice in others
        ):
            return row
    return None


def seeded_pencil(
    supports: Sequence[np.ndarray], row: int, rng: np.random.Generator
) -> tuple[Pencil, GenericSystem]:
    """A random pencil in one row, and its system at ``u = 0`` with one solution."""
    n = len(supports)
    x = unit(rng, n)
    direction = unit(rng, len(supports[row]))
    form = unit(rng, 1 + n)
    coefficients = []
    for i, support in enumerate(supports):
        monomials = np.prod(x[None, :] ** support, axis=1)
        c = unit(rng, len(support))
        value = c @ monomials
        if i == row:
            value += (form[0] + form[1:] @ x) * (direction @ monomials)
        coefficients.append(c - value / np.vdot(monomials, monomials) * monomials.conj())
    pencil = Pencil(tuple(supports), row, tuple(coefficients), direction, form)
    return pencil, pencil.system(points=np.append(1.0, x)[None] / np.sqrt(1 + n))


def trace_is_linear(
    pencil: Pencil, points: np.ndarray, rng: np.random.Generator, threads: int
) -> bool:
    """Whether ``points``, solutions at ``u = 0``, are all there are.

    False as well if a path is lost, or if points are of so different sizes that the absence of one
    of them would be hidden by rounding.
    """
    n = len(pencil.supports)
    groups = (tuple(range(n)),)
    begin = pencil.system()
    degrees = group_degrees(begin.rows, groups)
    slopes = []
    for shift in unit(rng, 2).tolist():
        first, second = (
            homogenized(each.rows, n, groups, degrees) for each in (begin, pencil.system(shift))
        )
        homotopy = straight_line(first, second, complex(unit(rng, 1)[0]))
        ends = track_regular(homotopy, points, named("default"), threads).points
        if len(ends) < len(points):
            return False
        slopes.append((ends[:, 1:] / ends[:, :1] - points[:, 1:] / points[:, :1]) / shift)
    differences = slopes[0] - slopes[1]
    noise = ROUNDING * np.abs(slopes).max(axis=0).sum(axis=0)
    visible = (np.abs(differences) > VISIBLE * noise).any(axis=1)
    straight = (np.abs(differences) <= noise).all()
    linear = (np.abs(differences.sum(axis=0)) <= noise).all()
    return bool(linear and (visible.all() or (len(points) == 1 and straight)))
