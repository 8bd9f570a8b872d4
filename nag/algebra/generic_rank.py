"""The rank that a system's Jacobian has almost everywhere, and what it says of all solution sets.

Where the rank is r, every zero lies on a component of dimension n - r or more, as on every fibre of
a map whose image has dimension r.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.algebra.prime_field import LARGE


def is_dependent(polynomials: Sequence[Polynomial], rng: np.random.Generator) -> bool:
    """Whether the Jacobian of as many polynomials as variables is singular everywhere.

    Then there are no isolated zeros. Said by its rank at a random point modulo a prime, which is
    smaller than elsewhere with a probability below 1e-15; never said of irrational coefficients.
    """
    n, p = len(polynomials), LARGE.modulus
    if not all(f.exact for f in polynomials):
        return False
    try:
        residues = [[(e, LARGE.of(c)) for e, c in f.terms.items()] for f in polynomials]
    except ZeroDivisionError:
        return False
    point = [int(x) for x in rng.integers(1, p, n)]
    inverse = [pow(x, -1, p) for x in point]
    rows = []
    for terms in residues:
        row = [0] * n
        for exponents, value in terms:
            for x, k in zip(point, exponents, strict=True):
                value = value * pow(x, k, p) % p if k else value
            # The derivative of a monomial is the monomial times k / x.
            for i, k in enumerate(exponents):
                if k:
                    row[i] += value * k * inverse[i]
        rows.append(row)
    return LARGE.rank(rows) < n
