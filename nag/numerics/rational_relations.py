"""Linear relations with rational coefficients among columns of numbers of many digits.

Columns are reduced one after the other by the independent ones before them. With balls in place of
numbers a column whose rest contains zero everywhere is a combination of those before it as far as
its digits tell, and the radii say how far that is.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import log10

import flint

# Digits by which an approximation must be better than its size explains.
EVIDENCE = 20
# A rest counts as zero if its balls are smaller than this power of the working precision.
SHARP = 0.4
LOG10_2 = log10(2.0)


class TooFewDigitsError(ArithmeticError):
    """A relation whose coefficients are not recognised in the digits that there are."""


class Echelon:
    """Independent columns of real balls in echelon form, pivots chosen among the rows.

    Attributes:
        digits: of the numbers in the columns.
    """

    def __init__(self, rows: int, digits: int) -> None:
        self.digits = digits
        self._order = list(range(rows))
        self._factors: list[list[flint.arb]] = []
        self._upper: list[list[flint.arb]] = []

    def __len__(self) -> int:
        """Number of independent columns."""
        return len(self._upper)

    def copy(self) -> Echelon:
        """The same columns; adding to the copy leaves these as they are."""
        other = Echelon(0, self.digits)
        other._order = list(self._order)
        other._factors = [list(f) for f in self._factors]
        other._upper = list(self._upper)
        return other

    def add(self, column: Sequence[flint.arb]) -> list[Fraction] | None:
        """Keep a column if it is independent of those kept; else its coefficients in them.

        Raises:
            TooFewDigitsError: if it is dependent and a coefficient is not recognised, or if the
                digits do not tell whether it is dependent.
        """
        tops, rest = self._reduced(column)
        pivot = max(range(len(rest)), key=lambda i: _lower(rest[i]), default=None)
        if pivot is None or rest[pivot].contains(0):
            self._check(column, rest)
            return self._coefficients(tops)
        self._keep(tops, rest, pivot)
        return None

    def relation(self, column: Sequence[flint.arb]) -> list[Fraction] | None:
        """The coefficients of a dependent column; None, and nothing is kept, if it is independent.

        Raises:
            TooFewDigitsError: as `add`.
        """
        tops, rest = self._reduced(column)
        if not all(x.contains(0) for x in rest):
            return None
        self._check(column, rest)
        return self._coefficients(tops)

    def _reduced(self, column: Sequence[flint.arb]) -> tuple[list[flint.arb], list[flint.arb]]:
        rest, tops = [column[i] for i in self._order], []
        for factors in self._factors:
            top, *rest = rest
            tops.append(top)
            rest = [x - f * top for x, f in zip(rest, factors, strict=True)]
        return tops, rest

    def _keep(self, tops: list[flint.arb], rest: list[flint.arb], pivot: int) -> None:
        r = len(self._upper)
        self._order[r], self._order[r + pivot] = self._order[r + pivot], self._order[r]
        for k, factors in enumerate(self._factors):
            i = r - k - 1
            factors[i], factors[i + pivot] = factors[i + pivot], factors[i]
        rest[0], rest[pivot] = rest[pivot], rest[0]
        self._factors.append([x / rest[0] for x in rest[1:]])
        self._upper.append([*tops, rest[0]])

    def _check(self, column: Sequence[flint.arb], rest: Sequence[flint.arb]) -> None:
        size = max((float(abs(x).mid()) for x in column), default=0.0)
        limit = flint.arb(10) ** int(-SHARP * self.digits) * (1 + size)
        if any(x.rad() > limit for x in rest):
            raise TooFewDigitsError(f"{self.digits} digits do not tell whether a column depends")

    def _coefficients(self, tops: list[flint.arb]) -> list[Fraction]:
        """Back substitution; the solution recognised."""
        values = list(tops)
        for k in reversed(range(len(values))):
            upper = self._upper[k]
            values[k] = values[k] / upper[k]
            for i in range(k):
                values[i] = values[i] - upper[i] * values[k]
        return [recognised(x) for x in values]


def recognised(x: flint.arb) -> Fraction:
    """The rational number in a ball, if its size shows that it is there by no accident.

    A ball of radius ``r`` holds a fraction with denominator ``q`` by chance with probability of
    about ``q^2 r``.

    Raises:
        TooFewDigitsError: if there is none.
    """
    radius = _fraction(x.rad())
    digits = _digits(radius) if radius else flint.ctx.dps
    middle = _fraction(x.mid())
    found = middle.limit_denominator(10 ** max(0, int(digits - EVIDENCE) // 2))
    if digits < EVIDENCE or abs(found - middle) > radius:
        raise TooFewDigitsError(f"no rational number is recognised in {digits:.0f} digits")
    return found


def _fraction(x: flint.arb) -> Fraction:
    mantissa, exponent = x.man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)


def _digits(x: Fraction) -> float:
    return (x.denominator.bit_length() - x.numerator.bit_length()) * LOG10_2


def _lower(x: flint.arb) -> flint.arb:
    return x.abs_lower()
