"""Isolated points that doubles take for points of larger sets, told from these in digits.

A regular zero of the equations on a slice lies on no set of higher dimension, however close: the
slice would meet that in a curve through the point. The zeros that an end may stand for are looked
at in 150 digits.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import flint
import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.coincidence import coincident
from nag.numerics.digits import log_norm, middle, point
from nag.numerics.pivots import pivots
from nag.numerics.singular_point import Place, SingularEnd, analyse
from nag.witness.close_points import in_words, rated
from nag.witness.confirm import zero_in_digits
from nag.witness.cutting import Cut, Equations
from nag.witness.fibres import Fibre
from nag.witness.slices import padded

# Digits in which zeros are looked at, and in which a pivot is none (decimal logarithm); zeros
# nearer to each other than this, relative to one, are the same.
DIGITS, ZERO, SAME = 100, -80.0, -80.0
# How many digits larger slices are made than equations.
FIRST = 40
# Doubles are no more accurate than this, relative to the point; regular ends nearer to a zero than
# this are compared with it in digits.
ROUNDED, CLOSE = 1e-15, 1e-9
# An end is looked at as far about it as so many times its error.
REACH = 10.0


@dataclass(frozen=True, eq=False)
class Meant:
    """What ends may stand for: isolated zeros, each once, and whether that is known of all ends.

    ``located``: whether at least the exact zero is known that each end leads to.
    """

    zeros: tuple[SingularEnd, ...]
    decided: bool
    located: bool


def meant(
    ends: Iterable[tuple[np.ndarray, float]],
    equations: Equations,
    rows: np.ndarray,
    rng: np.random.Generator,
    patience: float = 1.0,
) -> Meant:
    """The isolated zeros on the slice ``rows`` that ends may stand for; others lie on larger sets.

    Args:
        ends: limits in doubles with their errors, relative to each coordinate.
        patience: part of the usual work after which multiple zeros are left undecided.
    """
    zeros: list[SingularEnd] = []
    met: list[list[flint.acb]] = []
    slices, decided, located = padded(rows, 1 + equations.n), True, True
    seen = np.zeros((0, equations.n), dtype=complex)
    # What lies within the error of one end is looked at with it: the least known ones come first.
    for x, accuracy in sorted(ends, key=lambda end: -end[1]):
        error = max(accuracy, ROUNDED)
        if (np.abs(seen - x) <= REACH * error * np.abs(x)).all(axis=1).any():
            continue
        # The coordinates of a limit either vanish or are known each by itself.
        known = error * np.abs(x)
        end = analyse(equations.polynomials, x, known, rng, slices, patience=patience)
        seen = np.vstack([seen, x])
        decided &= end.place is not Place.UNDECIDED
        located &= bool(end.digits)
        for zero in end.nearby or ((end,) if end.place is Place.ISOLATED else ()):
            with flint.ctx.workdps(DIGITS):
                here = point(zero.digits)
                new = not any(_same(here, z) for z in met)
            if new:
                zeros.append(zero)
                met.append(here)
    return Meant(tuple(zeros), decided, located)


def among(zero: SingularEnd, fibres: Sequence[Fibre], rows: np.ndarray) -> bool | None:
    """Whether a zero is one of the points of fibres on ``rows``, in digits; None if left open."""
    unknown = False
    with flint.ctx.workdps(DIGITS):
        here = point(zero.digits)
    for fibre in fibres:
        for i in np.flatnonzero(coincident(fibre.x, zero.point, CLOSE)).tolist():
            there = zero_in_digits(fibre.cut, rows, fibre.points[i], fibre.fine.get(i))
            if there is not None and _same(here, there[: len(here)]):
                return True
            unknown |= there is None
    return None if unknown else False


def _same(x: Sequence[flint.acb], y: Sequence[flint.acb]) -> bool:
    return log_norm(a - b for a, b in zip(x, y, strict=True)) < SAME


def regular_fibre(zero: SingularEnd, equations: Equations, rows: np.ndarray) -> Fibre | None:
    """A regular isolated zero with as many equations as cut it; None if it is multiple."""
    if zero.multiplicity != 1:
        return None
    slices = padded(rows, 1 + equations.n)
    with flint.ctx.workdps(DIGITS):
        x = point(zero.digits)
        chosen = _independent(equations.polynomials, slices, x)
        if chosen is None:
            return None
        subset = tuple(equations.polynomials[i] for i in chosen)
        fine = rated(subset, rows, in_words(x, 1.0))
    return Fibre(Cut(equations.n, 0, subset), len(rows), fine.rounded[None], {0: fine})


def _independent(
    polynomials: Sequence[Polynomial], slices: np.ndarray, x: list[flint.acb]
) -> list[int] | None:
    """Equations that determine a point on slices; None if they do not."""
    n, need = len(x), len(x) - len(slices)
    if len(polynomials) == need:
        return list(range(need))
    jacobian = BallPolynomials.of(polynomials, slices).jacobian(x).tolist()
    matrix = []
    for i, row in enumerate(jacobian):
        size = max((abs(z).mid() for z in row), default=flint.arb(0))
        # The slices are the largest by far, and come first.
        unit = size if i < len(polynomials) else size / flint.arb(10) ** FIRST
        matrix.append([middle(z / unit) if size else middle(z) for z in row])
    chosen, _ = pivots(lambda _: matrix, n, 0, ZERO)
    found = sorted(i for i in chosen if i < len(polynomials))
    return found if len(found) == need and len(chosen) == n else None
