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

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf

import flint
import numpy as np

from nag.numerics.descent import Point, Round
from nag.numerics.digits import BITS, in_bits, log_norm, middle
from nag.numerics.double_ranks import INDEPENDENT
from nag.numerics.exact_system import ExactSystem
from nag.numerics.newton import step_by_doubles, subtract_step
from nag.numerics.sharpening import FURTHEST_STEP, GAIN, NEWTON_STEPS, ZERO

# Decimal logarithm of the step of difference quotients: they lose as many of 150 digits, and are
# known to as many, beyond what doubles ask for.
QUOTIENT_STEP = -40


@dataclass(frozen=True, eq=False)
class _Blocks:
    """A Jacobian about a regular block: the Schur complement, ``A^-1 B``, and ``C A^-1``."""

    complement: flint.acb_mat
    right: flint.acb_mat
    left: flint.acb_mat


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
                slopes = np.vstack(
                    [_rounded(jacobian), _slopes(system, x, jacobian, block, blocks)]
                )
                if not np.isfinite(slopes).all():
                    return None
                inverse = np.linalg.pinv(slopes, rcond=INDEPENDENT)
            _, length, step = step_by_doubles(inverse, left)
            if length > min(FURTHEST_STEP, last - GAIN):
                return None
            last, x = length, subtract_step(x, step, BITS)
    return None


def _divide(jacobian: flint.acb_mat, block: Round) -> _Blocks | None:
    """The parts of a Jacobian about a block; None where this may be singular."""
    below, beside = _others(jacobian, block)
    try:
        a = _part(jacobian, block.rows, block.columns)
        right = a.solve(_part(jacobian, block.rows, beside)).mid()
        c = _part(jacobian, below, block.columns)
        left = a.transpose().solve(c.transpose()).transpose().mid()
    except ZeroDivisionError:
        return None
    complement = (_part(jacobian, below, beside) - c * right).mid()
    return _Blocks(complement, right, left)


def _slopes(
    system: ExactSystem, x: Point, jacobian: flint.acb_mat, block: Round, blocks: _Blocks
) -> np.ndarray:
    """The derivatives of the Schur complement, row by row, by quotients of differences."""
    below, beside = _others(jacobian, block)
    rows, columns = np.eye(jacobian.nrows())[below] + 0j, np.eye(system.n)[:, beside] + 0j
    rows[:, list(block.rows)] = -_rounded(blocks.left)
    columns[list(block.columns)] = -_rounded(blocks.right)
    h = flint.arb(10) ** flint.arb(QUOTIENT_STEP)
    changes = []
    for direction in columns.T.tolist():
        moved = [middle(a + h * flint.acb(v)) for a, v in zip(x, direction, strict=True)]
        change = (system.functions.jacobian(moved, BITS) - jacobian) * flint.acb(1 / h)
        changes.append(rows @ _rounded(change.mid()))
    return np.stack(changes, axis=1).reshape(-1, system.n)


def _others(jacobian: flint.acb_mat, block: Round) -> tuple[list[int], list[int]]:
    """The rows and the columns that are not those of a block."""
    below = [i for i in range(jacobian.nrows()) if i not in block.rows]
    return below, [j for j in range(jacobian.ncols()) if j not in block.columns]


def _part(matrix: flint.acb_mat, rows: Sequence[int], columns: Sequence[int]) -> flint.acb_mat:
    return flint.acb_mat(len(rows), len(columns), [matrix[i, j] for i in rows for j in columns])


def _rounded(matrix: flint.acb_mat) -> np.ndarray:
    """A matrix as complex doubles."""
    entries = [complex(c) for c in matrix.entries()]
    return np.array(entries).reshape(matrix.nrows(), matrix.ncols())
