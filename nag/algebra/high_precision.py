"""Zeros in high precision, where doubles could be deceived.

In doubles, two zeros at a distance of 1e-8 look like a double one, and a coefficient of 1e-16 looks
like none.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache
from typing import Any

import flint
import numpy as np
from flint import acb, arb

from nag.algebra.flint_numbers import to_rational
from nag.algebra.number import Number, to_mpf
from nag.algebra.polynomial import Exponents, Polynomial

DIGITS = 100
# Values of equations, beside their terms, that are zero at zeros of so many digits.
VANISHES = 1e-80
# Zeros with larger errors than this are computed to more digits before values there are judged.
SHARP = 1e-85
NEWTON_STEPS = 60
# A point that moves by more than this was not known to the digits that it claims.
NEAR = 1e-9
# Polynomials that are kept ready to be evaluated.
KEPT = 64


class BallValues:
    """Polynomials, ready to be evaluated in balls.

    Args:
        polynomials: in the same variables.
    """

    def __init__(self, polynomials: Sequence[Polynomial]) -> None:
        self._polynomials = tuple(polynomials)
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
        return self._sums(flint.acb_mat, point, flint.acb(1), False)

    def sizes_at(self, sizes: Sequence[Any]) -> list[Any]:
        """Sums of the absolute values of the terms where coordinates have these sizes, ``arb``."""
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
        key = flint.ctx.prec, absolute
        if key not in self._matrices:
            entries = [[0] * len(self._steps) for _ in self._polynomials]
            for row, f in zip(entries, self._polynomials, strict=True):
                for exponents, c in f.terms.items():
                    value = _number(c)
                    row[self._places[exponents]] = abs(value) if absolute else value
            self._matrices[key] = matrix(entries)
        return self._matrices[key]


def _number(c: Number) -> Any:
    if isinstance(c, Fraction):
        return arb(to_rational(c))
    sign, mantissa, exponent, _ = to_mpf(c, DIGITS)._mpf_
    return arb(int(-mantissa if sign else mantissa)) * arb(2) ** int(exponent)


@lru_cache(maxsize=KEPT)
def _values_of(polynomials: tuple[Polynomial, ...]) -> BallValues:
    """The same polynomials are asked about at one point after another."""
    return BallValues(polynomials)


def _middle(z: Any) -> Any:
    return z.mid()


def _relative(f: Polynomial, z: Sequence[Any]) -> Any:
    """The size of ``f(z)`` beside its terms, coordinates below one counted as one."""
    sizes = [max(abs(x).mid(), arb(1)) for x in z]
    values = _values_of((f,))
    bound = abs(values.sizes_at(sizes)[0]).mid()
    return abs(_middle(values.at(z)[0])).mid() / bound if bound else arb(0)


def vanish_at(equations: Sequence[Polynomial], point: Sequence[tuple[str, str]]) -> bool:
    """Whether equations vanish at a point known to `DIGITS` digits.

    Args:
        point: real and imaginary parts of the coordinates as decimals.
    """
    with flint.ctx.workdps(DIGITS + 10):
        z = [_middle(flint.acb(flint.arb(re), flint.arb(im))) for re, im in point]
    return vanish_in_balls(equations, z)


def vanish_in_balls(equations: Sequence[Polynomial], point: Sequence[Any]) -> bool:
    """Whether equations vanish at a point known to `DIGITS` digits, in FLINT's ``acb``."""
    with flint.ctx.workdps(DIGITS + 10):
        vanishing = flint.arb(VANISHES)
        return all(_relative(f, point[: f.n]) < vanishing for f in equations)


def zero_near(
    square: Sequence[Polynomial],
    slices: np.ndarray,
    jacobian: np.ndarray,
    z: np.ndarray,
    digits: int,
) -> tuple[list[Any], float] | None:
    """The zero of a square system near a point, by Newton's method with the Jacobian there.

    Args:
        square: polynomials in ``N`` variables.
        slices: rows on ``(1, z)``, shape ``(N - len(square), 1 + N)``.
        jacobian: of ``square``, each divided by its largest coefficient, at ``z``, shape
            ``(len(square), N)``.
        z: shape ``(N,)``.
        digits: of the numbers computed with.

    Returns:
        The coordinates in FLINT's ``acb`` without radii, and their estimated error; None if there
        is no such zero near ``z``.
    """
    scales = [max(abs(float(c)) for c in f.terms.values()) for f in square]
    balanced = _balanced_inverse(np.vstack([jacobian, slices[:, 1:]]), z)
    if balanced is None:
        return None
    inverse, columns, weights = balanced
    evaluate = _values_of(tuple(square))
    with flint.ctx.workdps(digits):
        point = [acb(complex(x)) for x in z]
        rows = [[acb(complex(c)) for c in row] for row in slices]
        # Values are rounded beside the largest of their terms.
        whole = np.array(scales) * weights[: len(scales)]
        sizes = evaluate.sizes_at([abs(x) for x in point])
        terms = [float(size) / k for size, k in zip(sizes, whole, strict=True)]
        small = arb(10) ** (12 - digits) * arb(max([1.0, *terms]))
        last = None
        for _ in range(NEWTON_STEPS):
            values = [v / s for v, s in zip(evaluate.at(point), scales, strict=True)]
            for row in rows:
                terms = (c * x for c, x in zip(row[1:], point, strict=True))
                values.append(sum(terms, row[0]))
            values = [_middle(v / w) for v, w in zip(values, weights.tolist(), strict=True)]
            size = max((abs(v).mid() for v in values), default=arb(0))
            if size < small:
                break
            step = columns * (inverse @ np.array([complex(v / size) for v in values]))
            point = [_middle(x - size * acb(complex(d))) for x, d in zip(point, step, strict=True)]
            if last is not None and size > last / 2:
                return None
            last = size
        else:
            return None
        moved = max((float(abs(x - complex(y))) for x, y in zip(point, z, strict=True)), default=0)
        if moved > NEAR * (1 + float(np.linalg.norm(z))):
            return None
        return point, float(size) * float((columns * np.abs(inverse).sum(axis=1)).max(initial=0.0))


def _balanced_inverse(
    jacobian: np.ndarray, z: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
    """The inverse of a Jacobian with columns in units of large coordinates, and rows of size one.

    Returns:
        The inverse, these units, shape ``(N,)``, and by what the rows were divided, shape ``(N,)``;
        None if the matrix is singular.
    """
    columns = np.maximum(np.abs(z), 1.0)
    scaled = jacobian * columns
    weights = np.abs(scaled).max(axis=1, initial=0.0)
    if not (weights > 0).all():
        return None
    try:
        inverse = np.linalg.inv(scaled / weights[:, None])
    except np.linalg.LinAlgError:
        return None
    # Pivots below the range of doubles are not said to be zero.
    return (inverse, columns, weights) if np.isfinite(inverse).all() else None


def vanish(
    equations: Sequence[Polynomial],
    square: Sequence[Polynomial],
    slices: np.ndarray,
    jacobian: np.ndarray,
    z: np.ndarray,
) -> bool | None:
    """Whether equations, in the first of the ``N`` variables, vanish at a zero of a square system.

    See `sharp_zero` for the other arguments.

    Returns:
        None if there is no such zero near ``z``.
    """
    found = sharp_zero(square, slices, jacobian, z)
    return None if found is None else vanish_in_balls(equations, found)


def sharp_zero(
    square: Sequence[Polynomial], slices: np.ndarray, jacobian: np.ndarray, z: np.ndarray
) -> list[Any] | None:
    """The zero of a square system near a point to `DIGITS` digits; see `zero_near`."""
    found = zero_near(square, slices, jacobian, z, DIGITS)
    if found is not None and found[1] > SHARP:
        # Near a curve of zeros of a nearby system a zero is known to fewer digits.
        found = zero_near(square, slices, jacobian, z, 2 * DIGITS)
    return None if found is None else found[0]
