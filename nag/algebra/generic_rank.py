"""The rank that a system's Jacobian has almost everywhere, and what it says of all solution sets.

Where the rank is r, every zero lies on a component of dimension n - r or more, as on every fibre of
a map whose image has dimension r.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import numpy as np

from nag.algebra.polynomial import Polynomial

PRIME = (1 << 61) - 1


def is_dependent(polynomials: Sequence[Polynomial], rng: np.random.Generator) -> bool:
    """Whether the Jacobian of as many polynomials as variables is singular everywhere.

    Then there are no isolated zeros. Said by its rank at a random point modulo a prime, which is
    smaller than elsewhere with a probability below 1e-15; never said of irrational coefficients.
    """
    import flint

    n = len(polynomials)
    terms = [list(f.terms.items()) for f in polynomials]
    if not all(isinstance(c, Fraction) and c.denominator % PRIME for f in terms for _, c in f):
        return False
    point = [int(x) for x in rng.integers(1, PRIME, n)]
    inverse = [pow(x, -1, PRIME) for x in point]
    rows = []
    for f in terms:
        row = [0] * n
        for exponents, c in f:
            value = c.numerator * pow(c.denominator, -1, PRIME) % PRIME
            for x, k in zip(point, exponents, strict=True):
                value = value * pow(x, k, PRIME) % PRIME if k else value
            # The derivative of a monomial is the monomial times k / x.
            for i, k in enumerate(exponents):
                if k:
                    row[i] += value * k * inverse[i]
        rows.append([x % PRIME for x in row])
    return flint.nmod_mat(rows, PRIME).rank() < n
