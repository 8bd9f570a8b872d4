"""Deflation by kernel vectors: exact equations that a singular zero is part of a regular zero of.

To the equations F(x) = 0 are added F'(x) v = 0 and as many linear conditions R v = e_1 as F' has
corank at the zero, in twice as many unknowns; the multiplicity of the zero becomes less, and what
remains singular is deflated again. The new equations are exact like the old ones, so that a simple
zero of as many of them as there are unknowns can be proved by Krawczyk's test.

References:
    Leykin, Verschelde & Zhao, Newton's method with deflation for isolated singularities, 2006;
    Dayton & Zeng, Computing the multiplicity structure in solving polynomial systems, 2005.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import flint
import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.numerics.ball_boxes import BITS, FineBox, box_about, holds_conjugate
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.ball_ranks import regular_block
from nag.numerics.digits import LOG10_2, in_bits, log_norm
from nag.numerics.precise_point import PrecisePoint

# Digits of the arithmetic, more than which nothing is said to vanish to.
MOST_DIGITS = float(int(LOG10_2 * BITS[-1]))
MOST_UNKNOWNS = 64
# Bits of the random weights of conditions.
WEIGHT = 20


@dataclass(frozen=True, eq=False)
class DeflatedZero:
    """A proved simple zero of deflated equations.

    Attributes:
        box: of the zero, in the given variables first.
        rounds: how often the equations were deflated.
        left: number of equations that were not needed for the proof.
        vanishing: decimal digits to which these vanish there.
        real: whether it is proved to be real.
    """

    box: FineBox
    rounds: int
    left: int
    vanishing: float
    real: bool


def deflated_zero(
    polynomials: Sequence[Polynomial],
    slices: np.ndarray,
    zero: PrecisePoint,
    rng: np.random.Generator,
) -> DeflatedZero | None:
    """Prove a zero of deflated equations next to a singular zero; None if that does not succeed.

    Args:
        polynomials: exact, in ``n`` variables.
        slices: further linear equations, rows on ``(1, x)``, whose doubles are exact.
        zero: to about a hundred digits.
    """
    equations, rows = list(polynomials), slices
    with in_bits(BITS[-1]):
        point = zero.balls
        rounds, of_real = 0, not len(slices)
        while len(point) <= MOST_UNKNOWNS:
            system = BallPolynomials.of(equations, rows)
            entries = system.jacobian(point, BITS[-1]).tolist()
            chosen = regular_block(entries, len(point)).rows
            if len(chosen) == len(point):
                return _prove_zero(system, point, chosen, rounds, of_real)
            parts = rng.integers(-(2**WEIGHT), 2**WEIGHT, (2, len(point) - len(chosen), len(point)))
            # Without slices the deflated equations are real, and so is the zero in a box that
            # holds its conjugate.
            conditions = (parts[0] + (0j if of_real else 1j * parts[1])) * 2.0**-WEIGHT
            found = _deflate_equations(equations, rows, entries, point, chosen, conditions)
            if found is None:
                return None
            equations, rows, point = found
            rounds += 1
    return None


def _deflate_equations(
    equations: Sequence[Polynomial],
    slices: np.ndarray,
    jacobian: list[list[flint.acb]],
    point: list[flint.acb],
    chosen: Sequence[int],
    conditions: np.ndarray,
) -> tuple[list[Polynomial], np.ndarray, list[flint.acb]] | None:
    """The equations with a kernel vector as further unknowns, and the zero with it.

    Args:
        conditions: on the kernel vector, the first of which is one there, the others zero: dyadic
            numbers of so many bits that no kernel vector satisfies those without the first.
    """
    n = len(point)
    places = list(range(n))
    lifted = [f.with_variables(2 * n, places) for f in equations]
    v = [Polynomial.variable(2 * n, n + j) for j in range(n)]
    for f in equations:
        slopes = [f.derivative(j).with_variables(2 * n, places) for j in range(n)]
        lifted.append(sum((g * w for g, w in zip(slopes, v, strict=True)), start=v[0] * 0))
    blank = np.zeros((len(slices), n), dtype=complex)
    rows = [np.hstack([slices, blank])]
    rows.append(np.hstack([blank[:, :1], blank, slices[:, 1:]]))
    one = np.zeros((len(conditions), 1 + n), dtype=complex)
    one[:1, 0] = -1.0
    rows.append(np.hstack([one, conditions]))
    matrix = [jacobian[i] for i in chosen]
    matrix += [[flint.acb(complex(c)) for c in row] for row in conditions]
    right = [flint.acb(int(i == len(chosen))) for i in range(n)]
    try:
        kernel = flint.acb_mat(matrix).solve(flint.acb_mat(n, 1, right)).entries()
    except ZeroDivisionError:
        return None
    return [f for f in lifted if f], np.vstack(rows), point + kernel


def _prove_zero(
    system: BallPolynomials,
    point: list[flint.acb],
    chosen: Sequence[int],
    rounds: int,
    of_real: bool,
) -> DeflatedZero | None:
    """Krawczyk's test for the chosen rows, and the values of the others in the box.

    Args:
        of_real: whether all coefficients are real.
    """
    square = system.rows_of(chosen)
    box = box_about(square, point, (BITS[-1],))
    if box is None:
        return None
    rest = [i for i in range(len(system)) if i not in set(chosen)]
    vanishing = vanishing_digits(system.rows_of(rest), box)
    return DeflatedZero(box, rounds, len(rest), vanishing, of_real and holds_conjugate(box))


def vanishing_digits(system: BallPolynomials, box: FineBox) -> float:
    """Decimal digits to which rows vanish at all points of the inner box; 0 if one does not."""
    values = system.values(box.balls, BITS[-1]).entries()
    if not all(z.contains(0) for z in values):
        return 0.0
    return min(MOST_DIGITS, max(0.0, -log_norm(flint.acb(z.abs_upper()) for z in values)))
