"""Confirmation of a witness point in high precision, where doubles could be deceived."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.polynomial import Polynomial
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.precise_point import DIGITS, PrecisePoint, precise_zero
from nag.numerics.singular_point import Place, analyse
from nag.numerics.zero_values import ON, vanish
from nag.witness.close_points import Fine, zero_from
from nag.witness.cutting import Cut
from nag.witness.multiplicity import ACCURACY
from nag.witness.slices import padded

# Above this singular value a zero of as many equations as unknowns needs no confirmation.
REGULAR = 1e-5
# Values in doubles below this, beside their terms, are rounding, if coefficients have no more
# digits.
CERTAIN, ROUND_NUMBERS = 1e-14, 6
NOTHING: Mapping[int, Fine] = MappingProxyType({})


def confirmed(
    cut: Cut,
    equations: Sequence[Polynomial],
    rows: np.ndarray,
    z: np.ndarray,
    fine: Fine | None = None,
) -> bool:
    """Whether the zero of ``cut`` on the slice near ``z`` is one of all ``equations``.

    The square system's zero is computed to 100 digits; there the other equations must vanish too.
    """
    if fine is not None:
        return _at_close_zero(cut, equations, rows, fine) is True
    matrix = np.vstack([cut.evaluator.jacobian(z), padded(rows, 1 + len(z))[:, 1:]])
    # Far out, powers of the coordinates leave the range of doubles.
    finite = np.isfinite(matrix).all()
    smallest = np.linalg.svd(matrix, compute_uv=False).min(initial=np.inf) if finite else 0.0
    if not cut.deflated and len(cut.polynomials) == len(equations) and smallest > REGULAR:
        return True
    return _at_zero(cut, equations, rows, z) is True


def vanishing(
    cut: Cut,
    f: Polynomial,
    rows: np.ndarray,
    points: np.ndarray,
    fine: Mapping[int, Fine] = NOTHING,
) -> list[bool | None]:
    """At which zeros of ``cut`` on the slice, shape ``(P, n + aux)``, ``f`` vanishes.

    ``fine`` are more digits of some of them, by their indices.

    Values that are no rounding errors of their terms are computed to 100 digits: at large points a
    value of one may be small beside its terms, and a small coordinate need not be zero. So are all
    small ones where coefficients are long. None where that does not succeed.
    """
    evaluator, x = Evaluator.of([f], cut.n), points[:, : cut.n]
    small = evaluator.residuals(x)[:, 0] < ON
    if not small.any():
        return [False] * len(x)
    rounding = np.abs(evaluator.values(x)) <= CERTAIN * evaluator.absolute(x)
    if max(g.digits for g in (f, *cut.polynomials)) > ROUND_NUMBERS:
        rounding[:] = False
    rounding[list(fine)] = False
    return [
        bool(near)
        and (
            bool(certain)
            or (
                _at_close_zero(cut, [f], rows, fine[i])
                if i in fine
                else _at_zero(cut, [f], rows, z)
            )
        )
        for i, (near, certain, z) in enumerate(zip(small, rounding[:, 0], points, strict=True))
    ]


def _at_close_zero(
    cut: Cut, equations: Sequence[Polynomial], rows: np.ndarray, fine: Fine
) -> bool | None:
    """Whether equations vanish at a zero that is close to others; None if it was not found."""
    found = zero_in_digits(cut, rows, fine.rounded, fine)
    return None if found is None else vanish(equations, found)


def zero_in_digits(
    cut: Cut, rows: np.ndarray, z: np.ndarray, fine: Fine | None = None
) -> PrecisePoint | None:
    """A regular zero of ``cut`` on the slice, added unknowns included, to `DIGITS` digits.

    Args:
        z: the zero in doubles, shape ``(n + aux,)``.
        fine: more digits of a zero that is close to others; it is then known to as many more as
            these differ by.

    Returns:
        None where Newton's method does not lead to it.
    """
    if fine is None:
        return precise_zero(BallPolynomials.of(cut.polynomials, padded(rows, 1 + len(z))), z)
    more = int(2 * np.log10(max(fine.curvature, 1.0)))
    return zero_from(cut.polynomials, rows, fine, DIGITS + more)


def _at_zero(
    cut: Cut, equations: Sequence[Polynomial], rows: np.ndarray, z: np.ndarray
) -> bool | None:
    """Whether equations vanish at the zero of ``cut`` near ``z``; None if none was found there."""
    found = zero_in_digits(cut, rows, z)
    if found is not None or cut.aux:
        return None if found is None else vanish(equations, found)
    slices = padded(rows, 1 + len(z))
    zero = analyse(cut.polynomials, z, ACCURACY, np.random.default_rng(0), slices)
    if zero.place is not Place.ISOLATED or zero.precise is None:
        return None
    return vanish(equations, zero.precise)
