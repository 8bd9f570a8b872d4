"""Ranks of matrices of doubles: at a gap of singular values, by rows that are far from dependent.

One of three ways to tell a rank; `nag.algebra.exact_ranks` has that of exact matrices, and
`nag.numerics.ball_ranks` that of numbers with radii, which takes over where doubles show no gap.

References:
    Businger & Golub, Linear least squares solutions by Householder transformations, 1965.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.polynomial import Polynomial
from nag.numerics.linear_algebra_threads import limit_scipy

# Decides, measured: Quotient of neighbouring singular values at which a rank is read: others lay
# below 130, ranks above 1e13.
GAP = 1e3
# Decides: Singular values of a balanced Jacobian at a point of a component below which the gap is
# looked for where a rank is read (`GAP`). The second least one, over its median along a circuit, at
# which other motions meet it: where they miss it by d it is the root of d.
SINGULAR = 1e-9
# Decides: The same at a point that is known roughly. Above it a zero of as many equations as
# unknowns needs no confirmation, a joint moves, and a projection keeps a direction; between the
# two, what a joint does is not said.
NEARLY_SINGULAR = 1e-5
# A singular value, beside the largest, of zero.
NOTHING = 1e-17
# Decides: Singular value of gradients of length one that surely are independent; else no bound is
# given. Those of forms at a limit at infinity as well.
INDEPENDENT = 1e-6
# Decides: Least singular value, over the largest, or pivot of rows that are not solved for: of a
# slice, of linear equations, of rows that are to be made orthogonal.
DEPENDENT = 1e-10
# Decides: Errors of derivatives beside their terms.
NOT_ZERO = 1e-7
# Larger matrices are left to LAPACK, which takes longer to load than smaller ones take.
MOST_ENTRIES = 10_000


def numerical_corank(singular: np.ndarray, columns: int, small: float) -> int:
    """Corank of a balanced Jacobian with ``columns`` columns, at the gap of its singular values.

    The widest gap counts whose lower side is below ``small``, and that is at least a factor
    `GAP`. Entries of a balanced matrix are of order one, so a matrix of rank zero shows a gap
    below one.
    """
    s = np.zeros(columns)
    s[: len(singular)] = singular[:columns]
    s = np.maximum(s / max(1.0, s.max(initial=0.0)), NOTHING)
    above, best, corank = 1.0, GAP, 0
    for rank, value in enumerate(s):
        if value < small and above / value > best:
            best, corank = above / value, columns - rank
        above = value
    return corank


def matrix_corank(matrix: np.ndarray, small: float = SINGULAR) -> int:
    """Corank of a balanced matrix of doubles, see `numerical_corank`."""
    singular = np.linalg.svd(matrix, compute_uv=False)
    return numerical_corank(singular, matrix.shape[1], small)


def corank_on_component(
    evaluator: Evaluator, x: np.ndarray, dimension: int, multiplicity: int, small: float = SINGULAR
) -> int:
    """Corank of the Jacobian at a generic point of a component of its zeros.

    Exactly where the component is simple it is the dimension; else it is read at the gap.

    Args:
        multiplicity: 0 if it is not known.
    """
    if multiplicity == 1:
        return dimension
    corank = matrix_corank(evaluator.balanced_jacobian(x), small)
    return max(corank, dimension + 1) if multiplicity else corank


def largest_corank(matrix: np.ndarray, small: float) -> int:
    """A bound of the corank of a balanced matrix, where trials decide which it is.

    All singular values count that may be zero, beside the largest or one.
    """
    singular = np.linalg.svd(matrix, compute_uv=False)
    clear = int(np.sum(singular > small * max(1.0, singular.max(initial=0.0))))
    return int(matrix.shape[1] - clear)


def smallest_share(matrix: np.ndarray) -> float:
    """The least singular value over the largest, the inverse of the condition; 0 if all are 0."""
    singular = np.linalg.svd(matrix, compute_uv=False)
    return float(singular[-1] / singular[0]) if singular.any() else 0.0


def is_regular(matrix: np.ndarray) -> bool:
    """Whether columns are independent, by more than errors of a point known roughly explain."""
    finite = np.isfinite(matrix).all() and len(matrix) >= matrix.shape[1]
    return bool(finite) and smallest_share(matrix) > NEARLY_SINGULAR


def clearly_independent(columns: np.ndarray) -> bool:
    """Whether columns of complex doubles are independent over the reals, by more than rounding.

    Many digits show the same of the numbers that the doubles were rounded from. Those below one
    count as they are: of a column of zeros nothing but rounding is left.

    Args:
        columns: shape ``(rows, columns)``.
    """
    real = np.vstack([columns.real, columns.imag])
    with np.errstate(all="ignore"):
        real = real / np.maximum(np.linalg.norm(real, axis=0), 1.0)
    if len(real) < real.shape[1] or not np.isfinite(real).all():
        return False
    return bool(np.linalg.svd(real, compute_uv=False).min(initial=1.0) > SINGULAR)


def pivot_rows(matrix: np.ndarray, count: int | None = None) -> tuple[list[int], np.ndarray]:
    """Rows one by one, each the longest beside the span of those before, and these lengths.

    Args:
        matrix: shape ``(m, n)``.
        count: how many, at most; all that there can be, ``min(m, n)``, if it is left out.
    """
    most = min(matrix.shape)
    count = most if count is None else min(count, most)
    if matrix.size > MOST_ENTRIES:
        from scipy.linalg import qr

        limit_scipy()

        triangle, order = qr(matrix.T, mode="r", pivoting=True)
        return order[:count].tolist(), np.abs(np.diag(triangle))[:count]
    rest, chosen, lengths = np.array(matrix, dtype=complex), [], np.zeros(count)
    for k in range(count):
        left = np.linalg.norm(rest, axis=1)
        left[chosen] = -1.0
        best = int(left.argmax())
        chosen.append(best)
        lengths[k] = left[best]
        if left[best] > 0:
            unit = rest[best] / left[best]
            # Once more, as rounding errors of the first time count beside small rows.
            for _ in range(2):
                rest = rest - (rest @ unit.conj())[:, None] * unit
    return chosen, lengths


@dataclass(frozen=True, eq=False)
class Gradients:
    """The derivatives of polynomials, to be evaluated at points.

    Attributes:
        rows: number of polynomials.
        derivatives: of each by each variable, one after the other.
        scales: largest coefficient of each derivative.
    """

    rows: int
    derivatives: Evaluator
    scales: np.ndarray

    @classmethod
    def of(cls, polynomials: Sequence[Polynomial], n: int) -> Gradients:
        derivatives = [f.derivative(i) for f in polynomials for i in range(n)]
        scales = [max((abs(float(c)) for c in f.terms.values()), default=1.0) for f in derivatives]
        return cls(len(polynomials), Evaluator.of(derivatives, n), np.array(scales))

    def ranks(self, x: np.ndarray, errors: np.ndarray) -> np.ndarray:
        """How many gradients are certainly independent at each of some points, shape ``(P,)``.

        A singular value counts where it is larger than the sizes of all errors together (Weyl): a
        derivative may be off by rounding of its terms, and by what an error of the coordinates
        explains. Rows and columns are brought to length one, with their errors.

        Args:
            x: the points, shape ``(P, n)``.
            errors: how far, at most, coordinates may be from the exact ones, shape ``(P, n)``.
        """
        points = np.asarray(x, dtype=complex)
        shape = len(points), self.rows, points.shape[1]
        values = self.derivatives.values(points)
        sizes = self.derivatives.absolute(points)
        doubt = self.derivatives.absolute(np.abs(points) + errors) - sizes + NOT_ZERO * sizes
        certain = np.abs(values) > doubt
        gradients = (np.where(certain, values, 0) * self.scales).reshape(shape)
        errors = (np.where(certain, doubt, doubt + np.abs(values)) * self.scales).reshape(shape)
        for axis in (2, 1, 2):
            # Squares of large derivatives leave the range of doubles.
            for order in (np.inf, 2):
                lengths = np.linalg.norm(gradients, ord=order, axis=axis, keepdims=True)
                lengths = np.where(lengths == 0, 1.0, lengths)
                gradients, errors = gradients / lengths, errors / lengths
        off = np.linalg.norm(errors, axis=(1, 2))
        singular_values = np.linalg.svd(gradients, compute_uv=False)
        return np.sum(singular_values > INDEPENDENT + off[:, None], axis=1)


def independent_gradients(
    polynomials: Sequence[Polynomial], x: np.ndarray, error: float | np.ndarray
) -> bool:
    """Whether the gradients of polynomials are certainly independent at a point.

    See `Gradients.ranks`.
    """
    point = np.asarray(x)[None]
    ranks = Gradients.of(polynomials, len(x)).ranks(point, np.broadcast_to(error, point.shape))
    return bool(ranks[0] == len(polynomials))
