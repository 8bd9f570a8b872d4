"""Components in other coordinates: those in which the equations look as if chosen for them.

With ``x = s y + c`` for exact scales and an exact origin, equations go there without rounding. So
do slices, points, error radii and what cuts them where the scales are powers of two and the origin
stays; else each number of a slice is rounded once, beside the sizes that it has there, and the
points are found anew on the slice that is meant: those that are close to others follow it in all
their digits. An operation on components begins by going to `comparable_coordinates` and ends by
coming back, so that nothing in between needs to know of sizes or of far origins: distances, ranks
and errors that are relative to the whole point see all of its coordinates.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np

from nag.algebra.system import PolynomialSystem
from nag.errors import NagError
from nag.numerics.digits import bits_of, change_units
from nag.numerics.doubles import EPS
from nag.numerics.natural_coordinates import NaturalCoordinates, comparable_coordinates
from nag.witness.close_points import (
    CLOSE,
    CLOSE_AFAR,
    DIGITS,
    PointInWords,
    close_pairs,
    fine_of_balls,
    follow_slice,
)
from nag.witness.cutting import Cut
from nag.witness.exact_points import sharpen_points
from nag.witness.fibres import Fibre
from nag.witness.points import Points, with_fine
from nag.witness.slices import to_slice
from nag.witness.witness import Decomposition, Slice, WitnessSet

# Cuts whose images are kept.
KEPT = 64


def coordinates_of(system: PolynomialSystem) -> NaturalCoordinates:
    """The coordinates in which components of a system are worked with."""
    return comparable_coordinates(system.polynomials, system.n)


def carry_component(
    component: WitnessSet,
    natural: NaturalCoordinates,
    system: PolynomialSystem | None,
    cut: Slice | None = None,
    back: bool = False,
) -> WitnessSet:
    """A component in ``x`` as one in ``y``.

    Args:
        system: what it is a component of, in ``y``.
        cut: its slice in ``y``, where it is known better than by that in ``x``.
        back: whether ``y`` are the coordinates that were given, where nothing is tracked.
    """
    if natural.is_identity:
        same = component.system is system and cut is None
        cut = component.slice if cut is None else cut
        return component if same else replace(component, slice=cut, system=system)
    rows = natural.rows(component.slice.rows) if cut is None else cut.rows
    if not np.isfinite(rows).all():
        raise NagError("slice: its numbers leave the range of doubles in other units")
    points, radii = carry_points(component.points, component.radii, natural)
    digits = component.digits
    fibres = carry_fibres(component.fibres, natural, rows, back)
    if not natural.is_exact_in_doubles and fibres:
        sharp = sharpen_points(fibres)
        good, fibres = np.isfinite(sharp.radii).all(axis=1), list(sharp.fibres)
        points = np.where(good[:, None], sharp.x, points)
        radii = np.where(good[:, None], sharp.radii, radii)
        digits = np.where(good, sharp.digits, digits)
    return replace(
        component,
        slice=to_slice(rows) if cut is None else cut,
        points=points,
        radii=radii,
        digits=digits,
        fibres=tuple(fibres),
        system=system,
    )


def carry_points(
    x: np.ndarray, radii: np.ndarray, natural: NaturalCoordinates
) -> tuple[np.ndarray, np.ndarray]:
    """Points and errors of their coordinates; what is rounded on the way is one more."""
    y, errors = natural.points(x), radii / natural.sizes
    if natural.is_exact_in_doubles:
        return y, errors
    return y, errors + EPS * np.abs(y)


def carry_decomposition(whole: Decomposition, natural: NaturalCoordinates) -> Decomposition:
    """A decomposition with its components in ``y``."""
    if natural.is_identity:
        return whole
    system = natural.system(whole.system)
    components = tuple(carry_component(c, natural, system) for c in whole.components)
    return replace(whole, system=system, components=components)


def carry_fibres(
    fibres: Sequence[Fibre],
    natural: NaturalCoordinates,
    there: np.ndarray | None = None,
    back: bool = False,
) -> list[Fibre]:
    """Fibres on a slice of ``x`` as ones of ``y``.

    Unknowns that deflation added stay as they are. Where something is rounded, points are as near
    to the slice as doubles were, and those that are close to others on it.

    Args:
        there: the slice in ``y``; the image of that in ``x`` if none is given.
        back: whether ``y`` are the coordinates that were given, where nothing is tracked.
    """
    if natural.is_identity or not fibres:
        return list(fibres)
    target = natural.rows(fibres[0].rows) if there is None else there
    if natural.is_exact_in_doubles:
        return [_carry_fibre(fibre, natural, target) for fibre in fibres]
    before, after = (CLOSE, CLOSE_AFAR) if back else (CLOSE_AFAR, CLOSE)
    points = Points.of(fibres, before)
    moved = natural.points(points.x)
    if back:
        # Where points are asked about: in the units that are given.
        points = points.with_digits(close_pairs(natural.inverse.without_scales.points(moved)))
    points = points.with_digits(close_pairs(moved, after))
    own = [fibre for fibre, _ in points.fibres(range(len(points)))]
    return with_fine([_carry_fibre(fibre, natural, target) for fibre in own], after)


def _carry_fibre(fibre: Fibre, natural: NaturalCoordinates, rows: np.ndarray) -> Fibre:
    """A fibre, its close points on the slice ``rows`` of ``y``."""
    cut, points = _carry_cut(fibre.cut, natural), natural.points(fibre.points)
    fine = {i: _carry_fine(each, natural) for i, each in fibre.fine.items()}
    if not natural.is_exact_in_doubles:
        fine = {i: follow_slice(cut.polynomials, rows, each) for i, each in fine.items()}
        for i, each in fine.items():
            points[i] = each.rounded
        fine = {i: each for i, each in fine.items() if each.curvature * CLOSE > 1}
    return Fibre(cut, rows, points, fine)


@lru_cache(maxsize=KEPT)
def _carry_cut(cut: Cut, natural: NaturalCoordinates) -> Cut:
    """The equations of ``y``; components and operations share them, ready to be evaluated."""
    polynomials = tuple(natural.polynomial(f) for f in cut.polynomials)
    return Cut(cut.n, cut.aux, polynomials)


def _carry_fine(point: PointInWords, natural: NaturalCoordinates) -> PointInWords:
    """A point in all its digits; its next one is as far as it may be at least."""
    n = len(natural.scales)
    if natural.is_exact_in_doubles:
        further = np.ones(len(point.words) - n)
        words = point.words / np.append(natural.sizes, further)[:, None, None]
        return replace(point, words=words)
    x, back = point.balls(), natural.inverse
    moved = change_units(x[:n], back.scales, back.origin, bits_of(2 * DIGITS))
    there = fine_of_balls([*moved, *x[n:]], 1.0)
    before, after = (1 + float(np.linalg.norm(each.rounded)) for each in (point, there))
    steep = point.curvature * float(natural.sizes.max(initial=1.0)) * after / before
    return replace(there, curvature=max(steep, 1.0))
