"""A curve that equations give as a graph over one variable: its points are roots, without paths.

Where each variable but one can be solved for as a polynomial, one after the other, the curve is
the line's image under polynomials: irreducible, reduced, and its points on a slice are the zeros
of one polynomial.
"""

from __future__ import annotations

from dataclasses import replace

import flint
import numpy as np

from nag.algebra.elimination import eliminate_linear, linear_variables
from nag.decomposition.final_checks import Examined, check_class, judge_components
from nag.decomposition.hypersurface import NEARER
from nag.decomposition.reduction import Reduction
from nag.decomposition.roots import BITS, ball, points_at_roots, points_in_balls
from nag.decomposition.splitting import Class
from nag.numerics.digits import in_bits
from nag.tracking.run import Run
from nag.witness.cutting import Cut
from nag.witness.slices import random_rows
from nag.witness.witness import Decomposition

# Points of curves of higher degree lie so far out that their powers leave the range of doubles.
MOST_DEGREE = 20


def decompose_rational_curve(
    reduction: Reduction, rng: np.random.Generator, run: Run, scheme: bool
) -> Decomposition | None:
    """The curve that is the zero set of a system.

    Args:
        reduction: of the system.
        scheme: whether its multiplicity in the scheme of the equations is wanted.

    Returns:
        None where the equations do not give it in this way, or its degree is too high.
    """
    reduced, n = reduction.reduced, reduction.n
    exact = all(f.algebraic for f in (*reduced.polynomials, *reduced.nonzero))
    if not exact or n < 3 or len(reduced.polynomials) != n - 1:
        return None
    if not any(map(linear_variables, reduced.polynomials)):
        return None
    graph = eliminate_linear(reduced)
    if graph.system.n != 1 or graph.system.polynomials or not all(graph.system.nonzero):
        return None
    degree = max(image.degree for image in graph.images)
    if degree > MOST_DEGREE:
        return None
    rows = random_rows(rng, n, n, NEARER)[:1]
    with in_bits(BITS):
        images = [
            flint.acb_poly([ball(f.terms.get((k,), 0)) for k in range(f.degree + 1)])
            for f in graph.images
        ]
        first, *weights = map(flint.acb, rows[0].tolist())
        on_slice = sum((w * f for w, f in zip(weights, images, strict=True)), images[0] * 0)
        balls = points_at_roots(on_slice + first, degree, images)
    if balls is None:
        return None
    points = points_in_balls(Cut(n, 0, reduced.polynomials), rows, balls)
    whole = Class(np.arange(degree))
    examined = Examined.of(points, [whole], reduction, rng)
    found, counts = check_class(whole, examined, rng, run, scheme)
    answer = judge_components(reduction.system, [found], counts, run, order=range(n - 1))
    return replace(answer, algebraic=True)
