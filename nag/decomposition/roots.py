"""Points of a set that are known by the roots of one polynomial, isolated in balls."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import flint
import numpy as np

from nag.algebra.number import Exact, Surd
from nag.algebra.polynomial import Polynomial
from nag.numerics.digits import in_bits
from nag.witness.close_points import close_pairs, fine_of_balls
from nag.witness.cutting import Cut
from nag.witness.exact_points import of_balls
from nag.witness.fibres import Fibre
from nag.witness.points import Points

# Bits of the arithmetic, and of the roots behind the point.
BITS, TOLERANCE = 400, 300


def ball(c: Exact) -> Any:
    """An exact number, in the digits of FLINT's context."""
    if isinstance(c, Surd):
        return flint.acb(c.ball(flint.ctx.prec))
    return flint.acb(flint.arb(c.numerator) / c.denominator)


def line(rows: np.ndarray) -> list[Any]:
    """The coordinates on the line of n - 1 slices, in a parameter along it: ``acb_poly``.

    The line is that of the rows themselves: points that are close need all digits of it.
    """
    A = rows[:, 1:]
    n, direction = A.shape[1], np.linalg.svd(A)[2][-1]
    with in_bits(BITS):
        whole = flint.acb_mat(n, n, [complex(c) for c in np.vstack([A, direction]).ravel()])
        right = [c for row in rows[:, 0] for c in (complex(-row), 0)] + [0, 1]
        points = whole.solve(flint.acb_mat(n, 2, right))
        return [flint.acb_poly([points[i, 0], points[i, 1]]) for i in range(n)]


def zeros_on(f: Polynomial, images: Sequence[Any]) -> list[list[Any]] | None:
    """The zeros of f, with exact coefficients, on a line, as many as its degree.

    Args:
        images: the coordinates on the line.

    Returns:
        As `points_at_roots`.
    """
    with in_bits(BITS):
        powers = [[image**k for k in range(f.degree_in([i]) + 1)] for i, image in enumerate(images)]
        restricted = flint.acb_poly([])
        for exponents, c in f.terms.items():
            term = flint.acb_poly([ball(c)])
            for own, k in zip(powers, exponents, strict=True):
                if k:
                    term *= own[k]
            restricted += term
        return points_at_roots(restricted, f.degree, images)


def points_at_roots(f: Any, degree: int, images: Sequence[Any]) -> list[list[Any]] | None:
    """Coordinates, polynomials in one variable as f is, at the roots of f.

    Args:
        f: FLINT's ``acb_poly``, as ``images`` are.
        degree: the number of its roots.

    Returns:
        The coordinates of each point; None where the roots cannot be told apart, or are not as
        many.
    """
    try:
        roots = f.roots(tol=flint.arb(2) ** -TOLERANCE)
    except ValueError:
        return None
    return [[image(root) for image in images] for root in roots] if len(roots) == degree else None


def points_in_balls(cut: Cut, rows: np.ndarray, balls: Sequence[Sequence[Any]]) -> Points:
    """Points on the slice ``rows`` by their coordinates in balls; more digits where any are close.

    How close, the points tell.
    """
    points = np.array([[complex(c) for c in point] for point in balls])
    fine = {i: fine_of_balls(balls[i], 1.0) for pair in close_pairs(points) for i in pair}
    known = of_balls(balls)
    return replace(Points.of([Fibre(cut, rows, points, fine)]), known=known)
