"""Exact proofs that the Jacobian of equations has full rank at all their zeros.

Reference:
    Cox, Little & O'Shea, Ideals, Varieties, and Algorithms, chapter 9, section 6.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations
from math import comb

from nag.algebra.groebner import Ideal, UnfinishedBasis, ideal_of
from nag.algebra.polynomial import Polynomial

# Variables, minors, degree of one: what a Groebner basis is asked of.
MOST_VARIABLES, MOST_MINORS, MOST_DEGREE = 8, 60, 6
# Bounds of a basis that is found within half a second, or not: polynomials, terms of one, bits of a
# coefficient.
BOUNDS = (150, 400, 2000)


def is_regular_everywhere(polynomials: Sequence[Polynomial], rank: int) -> bool:
    """Whether the Jacobian certainly has that rank at all complex zeros of exact equations.

    It has if the equations and its minors of that size generate the whole ring. What is too large
    for a quick answer is not proved.
    """
    given = [f for f in polynomials if f]
    if not given or rank == 0:
        return rank == 0
    n = given[0].n
    if n > MOST_VARIABLES or comb(len(given), rank) * comb(n, rank) > MOST_MINORS:
        return False
    degrees = sorted((max(f.degree - 1, 0) for f in given), reverse=True)
    rational = all(isinstance(c, Fraction) for f in given for c in f.terms.values())
    if not rational or sum(degrees[:rank]) > MOST_DEGREE:
        return False
    jacobian = [[f.derivative(i) for i in range(n)] for f in given]
    minors = [
        determinant([[row[j] for j in columns] for row in rows])
        for rows in combinations(jacobian, rank)
        for columns in combinations(range(n), rank)
    ]
    names = [f"x{i}" for i in range(n)]
    try:
        found: Ideal = ideal_of([*given, *(m for m in minors if m)], names, bounds=BOUNDS)
    except UnfinishedBasis:
        return False
    return found.whole


def determinant(matrix: Sequence[Sequence[Polynomial]]) -> Polynomial:
    """By the first row; matrices are small."""
    first, *rest = matrix
    if not rest:
        return first[0]
    total = Polynomial(first[0].n, {})
    for j, entry in enumerate(first):
        if entry:
            minor = determinant([[*row[:j], *row[j + 1 :]] for row in rest])
            total = total + entry * minor * (-1) ** j
    return total
