"""How many zeros a system has at most, each counted by its multiplicity: modulo two primes.

The polynomials of an ideal I up to degree D that are seen to lie in it, V, make multiples of each
other: V grows until no product of its members with a variable up to degree D lies outside. Where
every monomial of some degree d is, modulo V, a combination of lower ones, the monomials that are
none span the quotient by I, which therefore has as many dimensions at most. If V is closed at a
degree beyond d, the bound is the number of zeros itself. A prime that divides a leading coefficient
of a member of V may bring zeros to infinity (p x - 1 has none modulo p), so that the larger bound
of two primes counts: it is wrong only where both are unlucky.

References:
    Mourrain, A new criterion for normal form algorithms, 1999; Mourrain & Trebuchet, Solving
    projective complete intersection faster, 2000.
"""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum
from itertools import combinations_with_replacement
from math import comb
from typing import NamedTuple

import flint
import numpy as np

from nag.algebra.exact_ranks import PrimeField, fields_with_roots, residues
from nag.algebra.polynomial import Exponents, Polynomial

# Sums of so many products of residues are whole numbers that doubles hold.
LARGEST = 2**21
MOST_STANDARD = 2**11
# Monomials up to degree D beyond which nothing is worked out: some 0.5 s.
MOST_MONOMIALS = 1500


class Completeness(Enum):
    """What a count says of zeros that were found."""

    UNKNOWN = "more there may be"
    ALL = "there are no more"
    MISSING = "there are more"
    TOO_MANY = "there are fewer: a multiplicity is wrong, or a zero counts twice"


class ZeroCount(NamedTuple):
    """No more than ``bound`` zeros; as many, if ``exact``."""

    bound: int
    exact: bool

    def difference(self, zeros: int, sides: int = 1) -> str:
        """What is said where it is not the number of zeros that were found.

        Args:
            sides: 2 where half of all zeros are those of the conjugate equations.
        """
        return f"{zeros // sides} zeros were found, and there are {self.bound // sides}"


def judge_number(zeros: int, count: ZeroCount | None) -> Completeness:
    """What a count says of so many zeros that were found, each counted by its multiplicity."""
    if count is None:
        return Completeness.UNKNOWN
    if count.bound == zeros:
        return Completeness.ALL
    if count.bound < zeros:
        return Completeness.TOO_MANY
    return Completeness.MISSING if count.exact else Completeness.UNKNOWN


def most_zeros(
    polynomials: Sequence[Polynomial], enough: int = -1, patient: bool = True
) -> ZeroCount | None:
    """A bound of the number of common zeros of polynomials whose coefficients are known exactly.

    Args:
        polynomials: not all zero, in the same variables.
        enough: a bound that is as small as this one need not be improved.
        patient: whether to try also where generic equations of these degrees have too many
            monomials: sparse ones may have fewer, but it may take a second to see that they have
            not.

    Returns:
        None where the zeros are not seen to be finitely many within `MOST_MONOMIALS`.
    """
    given = [f for f in polynomials if f]
    if not given or not all(f.algebraic for f in given):
        return None
    if not patient and not _small(given):
        return None
    counts = []
    fields = fields_with_roots(frozenset(g for f in given for g in f.generators), LARGEST)
    if len(fields) < 2:
        return None
    for field in fields:
        count = _modulo(field, given, enough)
        if count is None:
            return None
        counts.append(count)
    bounds = {count.bound for count in counts}
    return ZeroCount(max(bounds), len(bounds) == 1 and all(count.exact for count in counts))


def _modulo(field: PrimeField, given: Sequence[Polynomial], enough: int) -> ZeroCount | None:
    """What one prime says."""
    space = _Quotient(given[0].n, field)
    found = None
    for degree in range(MOST_MONOMIALS):
        if comb(degree + space.n, space.n) > MOST_MONOMIALS:
            return found
        if not space.raised([f for f in given if f.degree == degree]):
            return found
        if degree < max(f.degree for f in given):
            continue
        found = space.count()
        if found is not None and (found.exact or found.bound <= enough):
            return found
    return found


def _small(polynomials: Sequence[Polynomial]) -> bool:
    """Whether generic equations of these degrees leave finitely many zeros within the bound.

    They do at Macaulay's degree, one more than the sum of the degrees less one.
    """
    n = polynomials[0].n
    degrees = sorted(f.degree for f in polynomials)[:n]
    top = sum(degrees) - len(degrees) + 1
    return len(degrees) == n and comb(n + top, n) <= MOST_MONOMIALS


class _Quotient:
    """Polynomials up to a degree modulo V, by the monomials that are no leading ones in V.

    Attributes:
        field: of the prime modulo which everything is.
        prime: that one.
        degrees: of the monomials, which ascend by degree, shape ``(C,)``.
        standard: indices of those that are no leading monomials, shape ``(s,)``.
        forms: each monomial as a combination of those, shape ``(C, s)``.
    """

    def __init__(self, n: int, field: PrimeField) -> None:
        self.n, self.field, self.prime = n, field, field.modulus
        self.top = -1
        self.monomials: list[Exponents] = []
        self.place: dict[Exponents, int] = {}
        self.degrees = np.zeros(0, dtype=np.int64)
        self.standard = np.zeros(0, dtype=np.int64)
        self.forms = np.zeros((0, 0))
        self._multiplied = np.zeros(0, dtype=bool)

    def raised(self, polynomials: Sequence[Polynomial]) -> bool:
        """Go to the next degree, that of ``polynomials``, which lie in the ideal.

        False if there are too many standard monomials.
        """
        below = len(self.monomials)
        self._enlarge()
        if len(self.standard) > MOST_STANDARD:
            return False
        products = [
            np.array([self.place[_times(e, i)] for e in self.monomials[:below]], dtype=np.int64)
            for i in range(self.n)
        ]
        rows = self._residues(polynomials)
        while True:
            leading = np.ones(below, dtype=bool)
            leading[self.standard[self.standard < below]] = False
            todo = np.flatnonzero(leading & ~self._multiplied[:below])
            self._multiplied[todo] = True
            lower = self.standard[self.standard < below]
            tails = self.forms[todo][:, : len(lower)]
            for up in products if len(todo) else ():
                product = self.forms[up[todo]] - np.mod(tails @ self.forms[up[lower]], self.prime)
                rows = np.vstack([rows, np.mod(product, self.prime)])
            if not len(todo) and not len(rows):
                return True
            self._divide_out(rows)
            rows = np.zeros((0, len(self.standard)))

    def count(self) -> ZeroCount | None:
        """What V says of the number of zeros, if anything."""
        degrees = self.degrees[self.standard]
        for d in range(self.top + 1):
            if not (degrees == d).any():
                return ZeroCount(int((degrees < d).sum()), d < self.top)
        return None

    def _enlarge(self) -> None:
        """All monomials of the next degree, as standard ones."""
        self.top += 1
        below = len(self.monomials)
        for places in combinations_with_replacement(range(self.n), self.top):
            e = tuple(places.count(i) for i in range(self.n))
            self.place[e] = len(self.monomials)
            self.monomials.append(e)
        new = len(self.monomials) - below
        forms = np.zeros((below + new, len(self.standard) + new))
        forms[:below, : len(self.standard)] = self.forms
        forms[below:, len(self.standard) :] = np.eye(new)
        self.forms = forms
        self.standard = np.append(self.standard, np.arange(below, below + new))
        self.degrees = np.append(self.degrees, np.full(new, self.top))
        self._multiplied = np.append(self._multiplied, np.zeros(new, dtype=bool))

    def _residues(self, polynomials: Sequence[Polynomial]) -> np.ndarray:
        """Polynomials as combinations of the standard monomials."""
        rows = np.zeros((len(polynomials), len(self.monomials)))
        for row, f in zip(rows, polynomials, strict=True):
            for e, c in residues(f, self.field).items():
                row[self.place[e]] = c
        return np.mod(rows @ self.forms, self.prime)

    def _divide_out(self, rows: np.ndarray) -> None:
        """Combinations of the standard monomials lie in the ideal as well."""
        distinct = {row.tobytes(): i for i, row in enumerate(rows)}
        rows = rows[sorted(distinct.values())]
        rows = rows[rows.any(axis=1)]
        if not len(rows):
            return
        columns = len(self.standard)
        matrix = flint.nmod_mat(len(rows), columns, self.prime)
        # Most entries are zero.
        places = np.nonzero(rows)
        for i, j, c in zip(*(part.tolist() for part in (*places, rows[places])), strict=True):
            matrix[i, columns - 1 - j] = int(c)
        echelon, rank = matrix.rref()
        reduced = np.array(list(map(int, echelon.entries()[: rank * columns])), dtype=np.int64)
        reduced = reduced.reshape(rank, columns)
        pivots = (reduced != 0).argmax(axis=1)
        others = np.delete(np.arange(columns), pivots)[::-1]
        tails = (-reduced[:, others] % self.prime).astype(float)
        kept, gone = columns - 1 - others, columns - 1 - pivots
        self.forms = np.mod(self.forms[:, kept] + self.forms[:, gone] @ tails, self.prime)
        self.standard = self.standard[kept]


def _times(e: Exponents, i: int) -> Exponents:
    return (*e[:i], e[i] + 1, *e[i + 1 :])
