"""Isolated points that doubles take for points of larger sets, told from these in digits.

A regular zero of the equations on a slice lies on no set of higher dimension, however close: the
slice would meet that in a curve through the point. The zeros that an end may stand for are looked
at in 150 digits.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from nag.numerics.coincidence import SPREAD, coincident
from nag.numerics.doubles import ROUNDED
from nag.numerics.precise_point import PrecisePoint
from nag.numerics.singular_point import Place, SingularEnd, analyse
from nag.numerics.zero_values import ZERO
from nag.witness.close_points import CLOSE_AFAR
from nag.witness.confirm import zero_in_digits
from nag.witness.cutting import Equations
from nag.witness.fibres import Fibre
from nag.witness.slices import pad_rows


@dataclass(frozen=True, eq=False)
class NearbyZeros:
    """What ends may stand for: isolated zeros, each once, and whether that is known of all ends.

    ``located``: whether at least the exact zero is known that each end leads to.
    """

    zeros: tuple[SingularEnd, ...]
    decided: bool
    located: bool


def find_nearby_zeros(
    ends: Iterable[tuple[np.ndarray, float]],
    equations: Equations,
    rows: np.ndarray,
    rng: np.random.Generator,
    patience: float = 1.0,
    whole: bool = False,
    most: int | None = None,
) -> NearbyZeros:
    """The isolated zeros on the slice ``rows`` that ends may stand for; others lie on larger sets.

    Args:
        ends: limits in doubles with their errors, relative to each coordinate.
        patience: part of the usual work after which multiple zeros are left undecided.
        whole: whether errors are relative to the point, not to each of its coordinates.
        most: the largest multiplicity that an isolated zero may have there, where there are as many
            equations and rows as variables and that is known.
    """
    zeros: list[SingularEnd] = []
    met: list[PrecisePoint] = []
    slices, decided, located = pad_rows(rows, 1 + equations.n), True, True
    seen = np.zeros((0, equations.n), dtype=complex)
    # What lies within the error of one end is looked at with it: the least known ones come first.
    for x, accuracy in sorted(ends, key=lambda end: -end[1]):
        error = max(accuracy, ROUNDED)
        # The coordinates of a limit either vanish or are known each by itself.
        known = error * (1 + np.full(len(x), np.linalg.norm(x)) if whole else np.abs(x))
        if (np.abs(seen - x) <= SPREAD * known).all(axis=1).any():
            continue
        errors = error if whole else known
        place = equations.polynomials, x, errors, rng, slices
        end = analyse(*place, patience=patience, most=most)
        seen = np.vstack([seen, x])
        decided &= end.place is not Place.UNDECIDED
        located &= end.precise is not None
        for zero in end.nearby or ((end,) if end.place is Place.ISOLATED else ()):
            if zero.precise is not None and not any(are_same(zero.precise, z) for z in met):
                zeros.append(zero)
                met.append(zero.precise)
    return NearbyZeros(tuple(zeros), decided, located)


def is_among_points(zero: SingularEnd, fibres: Sequence[Fibre]) -> bool | None:
    """Whether a zero is one of the points of fibres, in digits; None if left open."""
    if zero.precise is None:
        return None
    return _is_one_of(zero.precise, _find_near(zero.point, CLOSE_AFAR, fibres))


def is_point_of_others(fibre: Fibre, i: int, error: float, others: Sequence[Fibre]) -> bool | None:
    """Whether a point of a fibre is one of those of others; None if left open.

    Doubles tell points apart that are farther from each other than their errors, digits all others:
    sets that are cut by different equations may lie as near to each other as these say.

    Args:
        error: the largest relative error of all these points.
    """
    near = _find_near(fibre.x[i], error, others)
    if not near:
        return False
    here = zero_in_digits(fibre, i)
    return None if here is None else _is_one_of(here.first(fibre.cut.n), near)


def _find_near(x: np.ndarray, error: float, fibres: Sequence[Fibre]) -> list[tuple[Fibre, int]]:
    """The points of fibres that may be the one at ``x`` as far as doubles tell."""
    return [
        (fibre, i)
        for fibre in fibres
        for i in np.flatnonzero(coincident(fibre.x, x, error)).tolist()
    ]


def _is_one_of(here: PrecisePoint, points: Iterable[tuple[Fibre, int]]) -> bool | None:
    """Whether a point is one of some of fibres, in digits; None if left open."""
    unknown = False
    for fibre, i in points:
        there = zero_in_digits(fibre, i)
        if there is not None and are_same(here, there.first(len(here))):
            return True
        unknown |= there is None
    return None if unknown else False


def are_same(x: PrecisePoint, y: PrecisePoint) -> bool:
    """Whether points that are known to a hundred digits are one."""
    return x.log_distance(y) < ZERO
