"""The regular part of equations solved for as many variables, by power series in the others.

References:
    Krantz & Parks, The implicit function theorem, 2002;
    the reduction is Lyapunov's and Schmidt's.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain
from typing import Any

import flint

from nag.numerics.digits import log_norm, middle
from nag.numerics.power_series import Series, SeriesRing, Terms, composed, product_of

# Newton steps for the values at the centre, which may not be zero yet.
CONSTANT_STEPS = 2


@dataclass(frozen=True, eq=False)
class Reduction:
    """Equations in the variables that are left.

    Attributes:
        ring: of series in these variables.
        images: all variables as such series.
        rest: the equations that were not solved.
        inverse: decimal logarithm of the largest entry of the solved block's inverse.
    """

    ring: SeriesRing
    images: list[Series]
    rest: list[Series]
    inverse: float


def jacobian(rows: Sequence[Terms], centre: Sequence[Any], modulus: int = 0) -> list[list[Any]]:
    """The derivatives of polynomials at a point, a list for each polynomial."""
    n = len(centre)
    result: list[list[Any]] = []
    if not any(centre):
        for row in rows:
            gradient: list[Any] = [0] * n
            for e, c in row:
                if sum(e) == 1:
                    gradient[e.index(1)] = c
            result.append(gradient)
        return result
    ring = SeriesRing(n, 1, modulus)
    images = [{0: c, ring.unit(i): 1} for i, c in enumerate(centre)]
    for value in composed(rows, images, ring):
        result.append([value.get(ring.unit(i), 0) for i in range(n)])
    return result


def _inverse(block: list[list[Any]], modulus: int) -> list[list[Any]] | None:
    try:
        if modulus:
            found = flint.nmod_mat(len(block), len(block), list(chain(*block)), modulus).inv()
            return [[int(c) for c in row] for row in found.tolist()]
        found = flint.acb_mat([[flint.acb(c) for c in row] for row in block]).inv()
        return [[middle(c) for c in row] for row in found.tolist()]
    except ZeroDivisionError:
        return None


def eliminate(
    rows: Sequence[Terms],
    centre: Sequence[Any],
    solved: Sequence[int],
    columns: Sequence[int],
    order: int,
    modulus: int = 0,
) -> Reduction | None:
    """Solve the equations ``solved`` for the variables ``columns`` as series in the others.

    Args:
        rows: polynomials in ``n`` variables.
        centre: the point at which the series are made, ``n`` numbers. The equations need not
            vanish there; the values of ``columns`` are corrected so that they do.
        solved, columns: as many indices of rows as of variables.
        order: of the series.
        modulus: a prime, for arithmetic modulo it.

    Returns:
        None if the block of the Jacobian is singular.
    """
    free = [i for i in range(len(centre)) if i not in columns]
    ring = SeriesRing(len(free), order if free else 0, modulus)
    images: list[Series] = [{0: c} if c else {} for c in centre]
    for place, i in enumerate(free):
        images[i][ring.unit(place)] = 1
    chosen = [rows[i] for i in solved]
    size = -float("inf")
    if columns:
        gradients = jacobian(chosen, centre, modulus)
        inverse = _inverse([[g[j] for j in columns] for g in gradients], modulus)
        if inverse is None:
            return None
        size = 0.0 if modulus else log_norm(c for row in inverse for c in row)
        for degree in [0] * CONSTANT_STEPS + list(range(1, ring.order + 1)):
            truncated = SeriesRing(ring.m, degree, modulus)
            values = composed(chosen, images, truncated)
            for j, step in zip(columns, product_of(inverse, values, modulus), strict=True):
                ring.add(images[j], step, -1)
    rest = composed([row for i, row in enumerate(rows) if i not in solved], images, ring)
    return Reduction(ring, images, rest, size)
