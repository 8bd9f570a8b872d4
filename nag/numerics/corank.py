"""Zeros at which the Jacobian is of a given corank, by Newton's method.

A block ``A`` of the Jacobian is regular; ``B`` beside it, ``C`` below it and ``D`` are the rest. It
is of corank ``c`` where the Schur complement ``S = D - C A^-1 B``, c by c, vanishes. With rows
``U = (-C A^-1, 1)`` and columns ``V = (-A^-1 B; 1)`` it is ``U J V``, and what it changes by is
``U dJ V``. The equations and ``S`` together are more equations than unknowns. Where the zeros of
that corank are a smooth set, their derivatives are of constant rank there, and Newton's method
converges to one near the point, whether they are isolated or not, and without a word of what order
the zero is of, as deflation needs.

References:
    Rabier & Reddien, Characterization and computation of singular points with maximum rank
    deficiency, SIAM J. Numer. Anal. 23 (1986); Govaerts, Numerical Methods for Bifurcations of
    Dynamical Equilibria, 2000, section 3.3.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import inf

import flint
import numpy as np

from nag.numerics.ball_ranks import regular_block
from nag.numerics.descent import Point, Round, descend
from nag.numerics.digits import BITS, DIGITS, doubles, in_bits, log_norm, log_size, middle
from nag.numerics.double_ranks import INDEPENDENT
from nag.numerics.exact_system import ExactSystem
from nag.numerics.newton import step_by_doubles, subtract_step
from nag.numerics.sharpening import FURTHEST_STEP, GAIN, NEWTON_STEPS, ZERO

# Decimal logarithm of the step of difference quotients: they lose as many of 150 digits, and are
# known to as many, beyond what doubles ask for.
QUOTIENT_STEP = -40
# Decides: Decimal logarithm of a quotient that is zero: ten digits of its error.
NOTHING = QUOTIENT_STEP + 10.0
# The order of the series that tell what terms of higher order are.
CUBIC = 3
# Decides: Decimal logarithm of what a shift makes, beside its length, of terms of higher order,
# where equations are of size one: three derivatives of a cubic one, and a digit.
SHIFTED = 1.5


@dataclass(frozen=True, eq=False)
class _Blocks:
    """A Jacobian about a regular block.

    Attributes:
        complement: the Schur complement.
        rows, columns: the matrices U and V, whose product with the Jacobian between them it is.
        inverse: decimal logarithm of the largest entry of the block's inverse.
    """

    complement: flint.acb_mat
    rows: flint.acb_mat
    columns: flint.acb_mat
    inverse: float


def find_zero_of_corank(
    system: ExactSystem, point: Sequence[flint.acb], block: Round
) -> tuple[Point, float] | None:
    """The zero next to a point where the Jacobian's rank is the size of a block that is regular.

    Args:
        system: equations, exact.
        point: in the system's scaled variables, about as good as doubles.
        block: rows and columns; the block is regular at the point.

    Returns:
        The zero, and the decimal logarithm of what is left there of what vanishes, below `ZERO`;
        None if Newton's method does not converge.
    """
    functions, x, last = system.functions, list(map(middle, point)), inf
    with in_bits(BITS):
        inverse: np.ndarray | None = None
        for _ in range(NEWTON_STEPS):
            jacobian = functions.jacobian(x, BITS)
            blocks = _divide(jacobian, block)
            if blocks is None:
                return None
            left = functions.values(x, BITS).mid().entries() + blocks.complement.entries()
            size = log_norm(left)
            if size < ZERO:
                return x, size
            if inverse is None:
                changes = [blocks.rows * each for each in _changes(system, x, jacobian, blocks)]
                count = blocks.complement.nrows()
                bending = [doubles(each.entries()).reshape(count, system.n) for each in changes]
                plain = doubles(jacobian.entries()).reshape(-1, system.n)
                slopes = np.vstack([plain, np.stack(bending, axis=1).reshape(-1, system.n)])
                if not np.isfinite(slopes).all():
                    return None
                inverse = np.linalg.pinv(slopes, rcond=INDEPENDENT)
            _, length, step = step_by_doubles(inverse, left)
            if length > min(FURTHEST_STEP, last - GAIN):
                return None
            last, x = length, subtract_step(x, step, BITS)
    return None


def may_hide_others(
    system: ExactSystem, point: Sequence[flint.acb], block: Round, reach: float
) -> bool:
    """Whether zeros may lie within ``reach`` of one that are on no set with it.

    A block of the Jacobian is regular at the zero, and the Schur complement vanishes. Within a
    reach in which the block may become singular nothing is said of others. Nor is it where a
    combination of the equations that remain has quadratic terms that are not zero, but no larger
    than what such a shift makes of terms of higher order: these decide then what lies beside.

    Args:
        reach: decimal logarithm.
    """
    with in_bits(BITS):
        x = list(map(middle, point))
        jacobian = system.functions.jacobian(x, BITS)
        blocks = _divide(jacobian, block)
        if blocks is None:
            return True
        shadow = reach + SHIFTED + max(0.0, blocks.inverse)
        if shadow > 0:
            return True
        changes = [
            (blocks.rows * each * blocks.columns).mid().tolist()
            for each in _changes(system, x, jacobian, blocks)
        ]
        count = blocks.complement.nrows()
        quadratic = [[c for each in changes for c in each[i]] for i in range(count)]
        if not _are_small(quadratic, shadow, NOTHING):
            return False
    # What terms of higher order are in fact takes longer to say.
    descent = descend(system, DIGITS, x, [block], CUBIC)
    if descent is None:
        return True
    ring, series = descent.ring, descent.remaining
    keys = sorted({k for one in series for k in one if ring.degree(k) == CUBIC - 1})
    quadratic = [[one.get(k, flint.acb(0)) for k in keys] for one in series]
    cubic = [log_size(c) for one in series for k, c in one.items() if ring.degree(k) == CUBIC]
    return _are_small(quadratic, max(cubic, default=-inf) + reach + SHIFTED, ZERO)


def _are_small(rows: list[list[flint.acb]], limit: float, nothing: float) -> bool:
    """Whether a combination of rows is not nothing, but no larger than a limit (logarithms)."""
    columns = len(rows[0]) if rows else 0
    if not columns or limit <= nothing:
        return False
    with in_bits(BITS):
        ranks = [regular_block(rows, columns, size).rank for size in (limit, nothing)]
    return ranks[0] < ranks[1]


def _divide(jacobian: flint.acb_mat, block: Round) -> _Blocks | None:
    """The parts of a Jacobian about a block; None where this may be singular."""
    rows, columns = jacobian.nrows(), jacobian.ncols()
    below = [i for i in range(rows) if i not in block.rows]
    beside = [j for j in range(columns) if j not in block.columns]
    try:
        inverse = _part(jacobian, block.rows, block.columns).inv().mid()
    except ZeroDivisionError:
        return None
    right = (inverse * _part(jacobian, block.rows, beside)).mid()
    left = (_part(jacobian, below, block.columns) * inverse).mid()
    u = _place_part(left, below, block.rows, rows)
    v = _place_part(right.transpose(), beside, block.columns, columns).transpose()
    complement = (u * _part(jacobian, range(rows), beside)).mid()
    return _Blocks(complement, u, v, log_norm(inverse.entries()))


def _place_part(
    part: flint.acb_mat, own: Sequence[int], others: Sequence[int], width: int
) -> flint.acb_mat:
    """Rows of length ``width`` with one at ``own``, one in each, and minus a part at ``others``."""
    placed = flint.acb_mat(len(own), width)
    for i, place in enumerate(own):
        placed[i, place] = 1
        for j, other in enumerate(others):
            placed[i, other] = -part[i, j]
    return placed


def _changes(
    system: ExactSystem, x: Point, jacobian: flint.acb_mat, blocks: _Blocks
) -> Iterator[flint.acb_mat]:
    """How the Jacobian changes along each column of V, by quotients of differences."""
    h = flint.arb(10) ** flint.arb(QUOTIENT_STEP)
    for direction in blocks.columns.transpose().tolist():
        moved = [middle(a + h * v) for a, v in zip(x, direction, strict=True)]
        yield ((system.functions.jacobian(moved, BITS) - jacobian) * flint.acb(1 / h)).mid()


def _part(matrix: flint.acb_mat, rows: Sequence[int], columns: Sequence[int]) -> flint.acb_mat:
    return flint.acb_mat(len(rows), len(columns), [matrix[i, j] for i in rows for j in columns])
