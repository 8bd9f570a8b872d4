"""Values of several polynomials at one point in FLINT's balls, each monomial computed once."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from nag.algebra.number import Number
from nag.algebra.polynomial import Exponents, Polynomial


class BallValues:
    """Polynomials, ready to be evaluated in balls.

    Args:
        polynomials: in the same variables.
        convert: a coefficient as FLINT's ``arb``, in the precision of FLINT's context.
    """

    def __init__(self, polynomials: Sequence[Polynomial], convert: Callable[[Number], Any]) -> None:
        self._polynomials, self._convert = tuple(polynomials), convert
        places: dict[Exponents, int] = {}
        # Each monomial is one before it times a variable.
        self._steps: list[tuple[int, int]] = []
        for f in self._polynomials:
            for exponents in f.terms:
                self._place(exponents, places)
        self._places = places
        self._matrices: dict[tuple[int, bool], Any] = {}

    def _place(self, exponents: Exponents, places: dict[Exponents, int]) -> int:
        if exponents not in places:
            last = max((i for i, k in enumerate(exponents) if k), default=-1)
            before = 0
            if last >= 0:
                smaller = (*exponents[:last], exponents[last] - 1, *exponents[last + 1 :])
                before = self._place(smaller, places)
            places[exponents] = len(self._steps)
            self._steps.append((before, last))
        return places[exponents]

    def at(self, point: Sequence[Any]) -> list[Any]:
        """The values at a point of ``acb``."""
        import flint

        return self._sums(flint.acb_mat, point, flint.acb(1), False)

    def sizes_at(self, sizes: Sequence[Any]) -> list[Any]:
        """Sums of the absolute values of the terms where coordinates have these sizes, ``arb``."""
        import flint

        return self._sums(flint.arb_mat, sizes, flint.arb(1), True)

    def _sums(self, matrix: Any, point: Sequence[Any], one: Any, absolute: bool) -> list[Any]:
        monomials: list[Any] = []
        for before, variable in self._steps:
            monomials.append(one if variable < 0 else monomials[before] * point[variable])
        if not monomials:
            return [0 * one for _ in self._polynomials]
        column = matrix(len(monomials), 1, monomials)
        sums = self._coefficients(matrix, absolute) * column
        return [sums[i, 0] for i in range(len(self._polynomials))]

    def _coefficients(self, matrix: Any, absolute: bool) -> Any:
        import flint

        key = flint.ctx.prec, absolute
        if key not in self._matrices:
            entries = [[0] * len(self._steps) for _ in self._polynomials]
            for row, f in zip(entries, self._polynomials, strict=True):
                for exponents, c in f.terms.items():
                    value = self._convert(c)
                    row[self._places[exponents]] = abs(value) if absolute else value
            self._matrices[key] = matrix(entries)
        return self._matrices[key]
