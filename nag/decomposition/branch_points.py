"""The branch points of a curve over the values of a linear form, as poles of a rational function.

On each sheet over t the form l' of the curve, in which nothing special happens, has a derivative
dl'/dt; the sum of its squares over all sheets is a rational function of t, bounded at infinity.
Where e sheets come together, dl'/dt is of order 1/e - 1, so that the sum of squares, a series in
integer powers, has a simple pole at most; where sheets only cross each other it has none. In many
digits its poles are found from values alone: their number is the rank of the Loewner matrix.

References:
    Antoulas & Anderson, On the scalar rational interpolation problem, 1986 (Loewner matrix).
"""

from __future__ import annotations

from collections.abc import Sequence

import flint
import numpy as np

from nag.errors import ComponentError
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.ball_ranks import regular_block
from nag.numerics.digits import bits_of, doubles, in_bits, middle, to_ball
from nag.numerics.newton import find_zero, inverse_of
from nag.numerics.sharpening import ZERO
from nag.tracking.run import Run
from nag.witness.fibres import Fibre, move
from nag.witness.slices import pad_rows, unit_complex

# Bits of values, 200 digits, and the digits that points are worked out to.
BITS, ARRIVED = bits_of(200), 180
# Values that are added at a time.
BATCH = 12


class BranchPointError(ComponentError):
    """Branch points that were not found, with the reason."""


def parallel_row(row: np.ndarray, t: complex) -> np.ndarray:
    """The slice on which the form of a slice of one row has the value ``t``."""
    return np.concatenate([[-t], row[0, 1:]])[None].astype(complex)


def branch_points(sheets: Sequence[Fibre], rng: np.random.Generator, run: Run) -> list[complex]:
    """The finite values of a form at which the sheets of a curve come together and are exchanged.

    Args:
        sheets: the points over one value of the form, which is that of their slice.

    Raises:
        BranchPointError: if paths fail, or no rational function fits the values.
    """
    form, count = sheets[0].rows[0], sum(map(len, sheets))
    n = len(form) - 1
    weights = rng.normal(size=n) + 1j * rng.normal(size=n)
    size = 1 + max(float(np.abs(fibre.x @ form[1:]).max(initial=0.0)) for fibre in sheets)
    size = max(size, abs(complex(form[0])))
    most = count * (count - 1)
    at: list[complex] = []
    values: list[flint.acb] = []
    while True:
        for _ in range(BATCH):
            t = complex(size * (0.3 + 1.2 * rng.random()) * unit_complex(rng))
            values.append(_sum_of_squares(sheets, t, weights, rng, run))
            at.append(t)
        with in_bits(BITS):
            rank = regular_block(_loewner(at, values), len(at) // 2, ZERO).rank
            if rank < len(at) // 2 - 1:
                return _poles(at[: 2 * rank + 1], values[: 2 * rank + 1])
        if len(at) > 2 * most + 2 * BATCH:
            raise BranchPointError("the sum over the sheets has too many poles")


def _sum_of_squares(
    sheets: Sequence[Fibre], t: complex, weights: np.ndarray, rng: np.random.Generator, run: Run
) -> flint.acb:
    squares, row = [], parallel_row(sheets[0].rows, t)
    for fibre in sheets:
        gamma = complex(unit_complex(rng))
        (ends,) = move([fibre], row, gamma, run)
        if not ends.regular.all():
            raise BranchPointError("paths to another slice failed")
        form = np.concatenate([weights, np.zeros(fibre.cut.aux)])
        system = BallPolynomials.of(fibre.cut.polynomials, pad_rows(row, 1 + len(form)))
        squares += [_square(system, x, form) for x in ends.points]
    with in_bits(BITS):
        return middle(sum(squares, flint.acb(0)))


def _square(system: BallPolynomials, x: np.ndarray, form: np.ndarray) -> flint.acb:
    """The square of a form's derivative by the value that the slice, the last row, has."""
    zero = find_zero(system, [flint.acb(complex(c)) for c in x], ARRIVED)
    slopes = None if zero is None else inverse_of(system.jacobian(zero.point, BITS), BITS)
    if slopes is None:
        raise BranchPointError("Newton's method does not converge on a slice")
    with in_bits(BITS):
        speeds = (slopes[i, len(x) - 1] for i in range(len(x)))
        derivative = sum((flint.acb(complex(w)) * v for w, v in zip(form, speeds, strict=True)), 0)
        return middle(derivative * derivative)


def _loewner(at: Sequence[complex], values: Sequence[flint.acb]) -> list[list[flint.acb]]:
    half = len(at) // 2
    return [
        [
            middle((values[i] - values[j]) / (to_ball(at[i]) - to_ball(at[j])))
            for j in range(half, 2 * half)
        ]
        for i in range(half)
    ]


def _poles(at: Sequence[complex], values: Sequence[flint.acb]) -> list[complex]:
    """The zeros of the denominator of the function of degree ``len(at) // 2`` with these values."""
    degree = len(at) // 2
    if degree == 0:
        return []
    rows, right = [], []
    for t, v in zip(at, values, strict=True):
        powers = [to_ball(t) ** k for k in range(degree + 1)]
        rows.append([*powers, *(-v * p for p in powers[:degree])])
        right.append([v * powers[degree]])
    solution = flint.acb_mat(rows).solve(flint.acb_mat(right)).tolist()
    denominator = [middle(c) for (c,) in solution[degree + 1 :]] + [flint.acb(1)]
    try:
        roots = flint.acb_poly(denominator).roots()
    except ValueError as reason:
        raise BranchPointError(f"the poles were not separated: {reason}") from None
    return [complex(z) for z in doubles(roots)]
