"""Start systems whose solutions monodromy finds from one of them, all of them by the trace test.

The trace test is that of a pencil. All equations but one have fixed generic coefficients and define
a curve; the last one is ``f + s g`` with both of its support. Points ``(x, s)`` of this curve on
the hyperplane ``s = l(x) + u`` are the solutions of a system with one support enlarged by a
simplex, and the sum of a linear function over all of them is linear in u; over fewer it is not, as
the curve is irreducible. No mixed volume is needed.

References:
    Sommese, Verschelde & Wampler, Symmetric functions applied to decomposing solution sets of
    polynomial systems, 2002; Leykin, Rodriguez & Sottile, Trace test, 2018.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import flint
import numpy as np

from nag.algebra.exact_ranks import LARGE
from nag.errors import StartError
from nag.numerics.digits import bits_of, in_bits
from nag.numerics.doubles import CLEAR
from nag.numerics.precise_point import POINT_DIGITS
from nag.solving.start.coefficient_monodromy import (
    GenericSystem,
    find_by_loops,
    seed_system,
    start_at,
)
from nag.solving.start.mixed_cells import mixed_cells
from nag.solving.start.target import StartSystem, Target, group_degrees, homogenize_rows, unit
from nag.solving.start.total_degree import MOST_PATHS
from nag.tracking.compiled import CompiledRows
from nag.tracking.homotopy import Homotopy, straight_line
from nag.tracking.settings import find_settings
from nag.tracking.track import track_regular

# Decides: Sum of second differences over the points' motion that is rounding in doubles.
ROUNDING = 1e-12
# Decides: The same in 64 digits.
FINE_ROUNDING = 1e-50
# Decides: Second difference of each point alone, in units of those, without which its absence could
# not show.
VISIBLE = 10.0
# Steps of Newton's method from doubles to 64 digits.
STEPS = 5
# Bits of the pencil's random numbers behind the point, and of the coefficients that their products
# are added to: those of all its systems are exact in doubles then, and their points are known to
# any number of digits.
SHORT, LONG = 24, 48


@dataclass(frozen=True, eq=False)
class Pencil:
    """A pencil in one of the equations.

    Attributes:
        supports: of the equations, shape ``(terms, n)``.
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

    For generic coefficients the curve is irreducible in the torus if the differences within the
    supports of any k of the others span more than k dimensions (Khovanskii, Newton polytopes and
    irreducible components of complete intersections, 2016). By Rado's theorem that holds if
    random vectors of their spans, two of any one of them, are independent.
    """
    n = len(supports)
    # A common factor of an equation's monomials, which supports without the origin may have, or
    # their common degree says nothing of the curve.
    differences = [(s - s[:1]).astype(object) for s in supports]

    def in_span(i: int) -> list[int]:
        weights = np.rint(2.0**LONG * rng.normal(size=len(supports[i])))
        return (weights.astype(np.int64).astype(object) @ differences[i]).tolist()

    degrees = [int(s.sum(axis=1).max()) for s in supports]
    # A row of high degree gains the fewest solutions by a form that is linear.
    for row in sorted(range(n), key=lambda i: (-degrees[i], len(supports[i]), i)):
        others = [i for i in range(n) if i != row]
        if all(LARGE.rank([in_span(i) for i in (*others, twice)]) == n for twice in others):
            return row
    return None


def seed_pencil(
    supports: Sequence[np.ndarray], row: int, rng: np.random.Generator
) -> tuple[Pencil, GenericSystem]:
    """A random pencil in one row, and its system at ``u = 0`` with one solution."""
    n = len(supports)
    x = unit(rng, n)
    direction = _round_to_bits(unit(rng, len(supports[row])), SHORT)
    form = _round_to_bits(unit(rng, 1 + n), SHORT)
    coefficients = []
    for i, support in enumerate(supports):
        monomials = np.prod(x[None, :] ** support, axis=1)
        c = unit(rng, len(support))
        value = c @ monomials
        if i == row:
            value += (form[0] + form[1:] @ x) * (direction @ monomials)
        c = c - value / np.vdot(monomials, monomials) * monomials.conj()
        coefficients.append(_round_to_bits(c, LONG) if i == row else c)
    pencil = Pencil(tuple(supports), row, tuple(coefficients), direction, form)
    return pencil, pencil.system(points=np.append(1.0, x)[None] / np.sqrt(1 + n))


def _round_to_bits(z: np.ndarray, bits: int) -> np.ndarray:
    return np.round(z * 2.0**bits) / 2.0**bits


def trace_is_linear(
    pencil: Pencil, points: np.ndarray, rng: np.random.Generator, threads: int
) -> bool:
    """Whether ``points``, solutions at ``u = 0``, are all there are.

    Where the absence of one would be hidden by rounding, beside points that move much more, it is
    decided in 64 digits. False as well if a path is lost.
    """
    n = len(pencil.supports)
    groups = (tuple(range(n)),)
    begin = pencil.system()
    degrees = group_degrees(begin.rows, groups)
    first = homogenize_rows(begin.rows, n, groups, degrees)
    there = [(first, points)]
    shifts = _round_to_bits(unit(rng, 2), SHORT).tolist()
    for shift in shifts:
        second = homogenize_rows(pencil.system(shift).rows, n, groups, degrees)
        homotopy = straight_line(first, second, complex(unit(rng, 1)[0]))
        ends = track_regular(homotopy, points, find_settings("default"), threads).points
        if len(ends) < len(points):
            return False
        there.append((second, ends))
    at = [x[:, 1:] / x[:, :1] for _, x in there]
    slopes = np.array([(x - at[0]) / shift for x, shift in zip(at[1:], shifts, strict=True)])
    motion = np.abs(slopes).max(axis=0).sum(axis=0)
    differences = slopes[0] - slopes[1]
    total = differences.sum(axis=0)
    if _is_sum_linear(differences, total, ROUNDING * motion):
        return True
    if (np.abs(total) > CLEAR * motion).any():
        return False
    return _is_sum_linear(*_second_differences(there, shifts), FINE_ROUNDING * motion)


def _is_sum_linear(differences: np.ndarray, total: np.ndarray, noise: np.ndarray) -> bool:
    """Whether the sum of second differences is zero, and each point's is seen not to be."""
    linear = (np.abs(total) <= noise).all()
    visible = (np.abs(differences) > VISIBLE * noise).any(axis=1)
    straight = len(differences) == 1 and (np.abs(differences) <= noise).all()
    return bool(linear and (visible.all() or straight))


def _second_differences(
    there: Sequence[tuple[CompiledRows, np.ndarray]], shifts: Sequence[complex]
) -> tuple[np.ndarray, np.ndarray]:
    """Of each point, and of all together: worked out in 64 digits, then rounded."""
    from nag.tracking.ends.newton_steps import affine_points, newton_steps

    fine = []
    for rows, points in there:
        homotopy = Homotopy(rows, np.zeros((0, rows.N), dtype=complex))
        fine.append(affine_points(newton_steps(homotopy, points, 4, STEPS)))
    with in_bits(bits_of(POINT_DIGITS)):
        u, v = map(flint.acb, shifts)
        differences = [
            [(b - a) / u - (c - a) / v for a, b, c in zip(*each, strict=True)]
            for each in zip(*fine, strict=True)
        ]
        total = [sum(column, flint.acb(0)) for column in zip(*differences, strict=True)]
    doubles = np.array([[complex(c.mid()) for c in row] for row in differences])
    return doubles, np.array([complex(c.mid()) for c in total])


def monodromy(target: Target, rng: np.random.Generator, threads: int) -> StartSystem:
    """The homotopy from random coefficients, whose solutions come from one of them by loops.

    The search ends when the trace test proves that there are no more; if no equation's pencil
    allows it, at the mixed volume.

    Raises:
        StartError: if there are too many paths, or it is not proven that all solutions were found.
    """
    gamma = complex(unit(rng, 1)[0])
    row = irreducible_row(target.supports, rng)
    if row is None:
        return _up_to_the_mixed_volume(target, gamma, rng, threads)
    pencil, seed = seed_pencil(target.supports, row, rng)
    test = partial(trace_is_linear, pencil, rng=rng, threads=threads)
    system, spent, proven = find_by_loops(seed, MOST_PATHS, rng, threads, test)
    if not proven:
        raise StartError(
            f"monodromy: {len(system.points)} solutions were found, but no trace proves that these "
            "are all"
        )
    detail = f"its solutions by monodromy, {spent} regular paths; all by the trace test"
    return start_at("monodromy", target, system, detail, gamma)


def _up_to_the_mixed_volume(
    target: Target, gamma: complex, rng: np.random.Generator, threads: int
) -> StartSystem:
    volume = mixed_cells(target.supports, rng).mixed_volume
    if volume > MOST_PATHS:
        raise StartError(f"monodromy: {volume} paths; at most {MOST_PATHS} are tracked")
    system, spent = seed_system(target.supports, rng), 0
    if volume:
        system, spent, _ = find_by_loops(system, volume, rng, threads)
    else:
        system = system.holding(system.points[:0], system.errors[:0])
    if len(system.points) != volume:
        raise StartError(
            f"monodromy: {len(system.points)} of the {volume} solutions of the start system were "
            "found"
        )
    detail = f"its solutions by monodromy, {spent} regular paths; the mixed volume says how many"
    return start_at("monodromy", target, system, detail, gamma)
