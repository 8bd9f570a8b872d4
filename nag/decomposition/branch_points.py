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
from dataclasses import dataclass

import flint
import numpy as np

from nag.errors import ComponentError
from nag.numerics.digits import doubles, log_norm, log_size, middle, number, working
from nag.numerics.exact_system import ExactSystem, value
from nag.numerics.implicit_function import jacobian
from nag.numerics.power_series import Terms
from nag.tracking.run import Run
from nag.witness.fibres import Fibre, move
from nag.witness.slices import unit_complex

DIGITS = 200
# Decimal logarithms: Newton's method has arrived; a pivot of the Loewner matrix is zero.
ARRIVED, NOTHING = -180.0, -90.0
NEWTON_STEPS = 14
# Values that are added at a time.
BATCH = 12


class BranchPointError(ComponentError):
    """Branch points that were not found, with the reason."""


@dataclass(frozen=True, eq=False)
class Sheets:
    """The points of a curve over the value ``base`` of a linear form.

    Attributes:
        fibres: the points with their cuts.
        normal: the form, complex, shape ``(n,)``.
        base: its value.
    """

    fibres: tuple[Fibre, ...]
    normal: np.ndarray
    base: complex

    def rows(self, t: complex) -> np.ndarray:
        """The slice on which the form has the value ``t``."""
        return np.concatenate([[-t], self.normal])[None].astype(complex)

    @property
    def count(self) -> int:
        return sum(map(len, self.fibres))


def branch_points(sheets: Sheets, rng: np.random.Generator, run: Run) -> list[complex]:
    """The finite values at which sheets come together and are exchanged.

    Raises:
        BranchPointError: if paths fail, or no rational function fits the values.
    """
    n = len(sheets.normal)
    weights = rng.normal(size=n) + 1j * rng.normal(size=n)
    size = 1 + max(float(np.abs(f.x @ sheets.normal).max(initial=0.0)) for f in sheets.fibres)
    size = max(size, abs(sheets.base))
    most = sheets.count * (sheets.count - 1)
    at: list[complex] = []
    values: list[flint.acb] = []
    while True:
        for _ in range(BATCH):
            t = complex(size * (0.3 + 1.2 * rng.random()) * unit_complex(rng))
            values.append(_sum_of_squares(sheets, t, weights, rng, run))
            at.append(t)
        with working(DIGITS):
            rank = _rank(_loewner(at, values))
            if rank < len(at) // 2 - 1:
                return _poles(at[: 2 * rank + 1], values[: 2 * rank + 1])
        if len(at) > 2 * most + 2 * BATCH:
            raise BranchPointError("the sum over the sheets has too many poles")


def _sum_of_squares(
    sheets: Sheets, t: complex, weights: np.ndarray, rng: np.random.Generator, run: Run
) -> flint.acb:
    with working(DIGITS):
        total = flint.acb(0)
    for fibre in sheets.fibres:
        gamma = complex(unit_complex(rng))
        (ends,) = move([fibre], sheets.rows(sheets.base), sheets.rows(t), gamma, run)
        if not ends.regular.all():
            raise BranchPointError("paths to another slice failed")
        system = ExactSystem.of(
            fibre.cut.polynomials, ends.points[0], _padded(sheets.rows(t), fibre)
        )
        last = np.concatenate([weights, np.zeros(fibre.cut.aux)])
        with working(DIGITS):
            rows = system.at(DIGITS)
            units = [flint.arb(2) ** k for k in system.scales]
            form = [number(complex(w)) * u for w, u in zip(last, units, strict=True)]
            scale = dict(rows[-1])[(0,) * system.n] / number(-t)
            total = sum((_square(rows, x, units, form, scale) for x in ends.points), total)
    return middle(total)


def _padded(rows: np.ndarray, fibre: Fibre) -> np.ndarray:
    return np.hstack([rows, np.zeros((1, fibre.cut.aux), dtype=complex)])


def _square(
    rows: Sequence[Terms],
    x: np.ndarray,
    units: list[flint.arb],
    form: list[flint.acb],
    scale: flint.acb,
) -> flint.acb:
    """The square of the form's derivative, where the last row is ``scale`` times the slice."""
    y = [middle(number(complex(c)) / u) for c, u in zip(x, units, strict=True)]
    for _ in range(NEWTON_STEPS):
        matrix = flint.acb_mat(jacobian(rows, y))
        right = flint.acb_mat([[value(row, y)] for row in rows])
        step = [middle(c) for (c,) in matrix.solve(right).tolist()]
        y = [middle(a - b) for a, b in zip(y, step, strict=True)]
        if log_norm(step) < ARRIVED:
            break
    else:
        raise BranchPointError("Newton's method does not converge on a slice")
    unit = flint.acb_mat([[0]] * (len(rows) - 1) + [[scale]])
    speed = matrix.solve(unit).tolist()
    derivative = sum((w * v for w, (v,) in zip(form, speed, strict=True)), flint.acb(0))
    return middle(derivative * derivative)


def _loewner(at: Sequence[complex], values: Sequence[flint.acb]) -> list[list[flint.acb]]:
    half = len(at) // 2
    return [
        [
            middle((values[i] - values[j]) / (number(at[i]) - number(at[j])))
            for j in range(half, 2 * half)
        ]
        for i in range(half)
    ]


def _rank(matrix: list[list[flint.acb]]) -> int:
    """Number of pivots that are no zeros, the largest chosen each time."""
    rank = 0
    while matrix and matrix[0]:
        sizes = [[log_size(c) for c in row] for row in matrix]
        i = max(range(len(matrix)), key=lambda k: max(sizes[k]))
        j = max(range(len(matrix[i])), key=sizes[i].__getitem__)
        if sizes[i][j] < NOTHING:
            break
        pivot = matrix.pop(i)
        rest = []
        for row in matrix:
            factor = row[j] / pivot[j]
            reduced = [middle(a - factor * b) for a, b in zip(row, pivot, strict=True)]
            rest.append(reduced[:j] + reduced[j + 1 :])
        matrix, rank = rest, rank + 1
    return rank


def _poles(at: Sequence[complex], values: Sequence[flint.acb]) -> list[complex]:
    """The zeros of the denominator of the function of degree ``len(at) // 2`` with these values."""
    degree = len(at) // 2
    if degree == 0:
        return []
    rows, right = [], []
    for t, v in zip(at, values, strict=True):
        powers = [number(t) ** k for k in range(degree + 1)]
        rows.append([*powers, *(-v * p for p in powers[:degree])])
        right.append([v * powers[degree]])
    solution = flint.acb_mat(rows).solve(flint.acb_mat(right)).tolist()
    denominator = [middle(c) for (c,) in solution[degree + 1 :]] + [flint.acb(1)]
    try:
        roots = flint.acb_poly(denominator).roots()
    except ValueError as reason:
        raise BranchPointError(f"the poles were not separated: {reason}") from None
    return [complex(z) for z in doubles(roots)]
