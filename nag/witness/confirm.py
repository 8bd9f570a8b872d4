"""Confirmation of a witness point in high precision, where doubles could be deceived."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.polynomial import ROUND_NUMBERS, Polynomial
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.coincidence import LEAST
from nag.numerics.double_ranks import NEARLY_SINGULAR
from nag.numerics.doubles import ARRIVED
from nag.numerics.precise_point import POINT_DIGITS, PrecisePoint, precise_zero
from nag.numerics.singular_point import Place, analyse
from nag.numerics.zero_values import ON, all_vanish
from nag.tracking.evaluations import count_zero
from nag.witness.close_points import zero_from
from nag.witness.fibres import Fibre
from nag.witness.slices import pad_rows


def is_confirmed(fibre: Fibre, i: int, equations: Sequence[Polynomial]) -> bool:
    """Whether a point of a fibre is a zero of all ``equations``.

    The square system's zero is computed to 100 digits; there the other equations must vanish too.
    """
    cut, z = fibre.cut, fibre.points[i]
    if i not in fibre.fine:
        matrix = np.vstack([cut.evaluator.jacobian(z), pad_rows(fibre.rows, 1 + len(z))[:, 1:]])
        # Far out, powers of the coordinates leave the range of doubles.
        finite = np.isfinite(matrix).all()
        smallest = np.linalg.svd(matrix, compute_uv=False).min(initial=np.inf) if finite else 0.0
        if (
            not cut.deflated
            and len(cut.polynomials) == len(equations)
            and smallest > NEARLY_SINGULAR
        ):
            return True
    return _vanish_at(fibre, i, equations) is True


def find_vanishing(fibre: Fibre, f: Polynomial) -> list[bool | None]:
    """At which points of a fibre ``f`` vanishes.

    Values that are no rounding errors of their terms are computed to 100 digits: at large points a
    value of one may be small beside its terms, and a small coordinate need not be zero. So are all
    small ones where coefficients are long. None where that does not succeed.
    """
    cut, x = fibre.cut, fibre.x
    evaluator = Evaluator.of([f], cut.n)
    small = evaluator.residuals(x)[:, 0] < ON
    if not small.any():
        return [False] * len(x)
    rounding = np.abs(evaluator.values(x)) <= ARRIVED * evaluator.absolute(x)
    if max(g.digits for g in (f, *cut.polynomials)) > ROUND_NUMBERS:
        rounding[:] = False
    rounding[list(fibre.fine)] = False
    return [
        bool(near) and (bool(certain) or _vanish_at(fibre, i, [f]))
        for i, (near, certain) in enumerate(zip(small, rounding[:, 0], strict=True))
    ]


def zero_in_digits(
    fibre: Fibre, i: int, digits: int = POINT_DIGITS, spare: int = 2
) -> PrecisePoint | None:
    """A point of a fibre, added unknowns included, to so many digits: a regular zero of its cut.

    One that is close to others is known to ``spare`` times as many more as these differ by. None
    where Newton's method does not lead to it, or it is not proved to be simple.
    """
    polynomials, z = fibre.cut.polynomials, fibre.points[i]
    count_zero()
    if i not in fibre.fine:
        exact = BallPolynomials.of(polynomials, pad_rows(fibre.rows, 1 + len(z)))
        return precise_zero(exact, z, digits)
    fine = fibre.fine[i]
    more = int(spare * np.log10(max(fine.curvature, 1.0)))
    return zero_from(polynomials, fibre.rows, fine, digits + more)


def _vanish_at(fibre: Fibre, i: int, equations: Sequence[Polynomial]) -> bool | None:
    """Whether equations vanish at a point of a fibre; None if its zero was not found."""
    found = zero_in_digits(fibre, i)
    if found is not None:
        return all_vanish(equations, found)
    cut, z = fibre.cut, fibre.points[i]
    if cut.aux or i in fibre.fine:
        return None
    slices = pad_rows(fibre.rows, 1 + len(z))
    zero = analyse(cut.polynomials, z, LEAST, np.random.default_rng(0), slices)
    if zero.place is not Place.ISOLATED or zero.precise is None:
        return None
    return all_vanish(equations, zero.precise)
