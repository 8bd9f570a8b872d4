"""The judgement of a zero: deflation, the dual space of its local ring, zeros beside it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import log10
from typing import Any

import flint
import numpy as np

from nag.algebra.exact_ranks import FIELDS, PrimeField
from nag.algebra.polynomial import Polynomial
from nag.numerics.ball_ranks import Digits, Field, UnclearRank, regular_block
from nag.numerics.corank import may_hide_others
from nag.numerics.curves import curve_through, is_exact_zero, point_beside
from nag.numerics.deflation import (
    MOST_WORK,
    DeflatedPoint,
    NotDeflated,
    asks_for_more,
    deflate,
)
from nag.numerics.descent import Round, series_cost
from nag.numerics.digits import (
    DIGITS,
    LOG10_2,
    ROUNDING,
    SPARE,
    doubles,
    rational_point,
    times_power_of_two,
    to_point,
    working_digits,
)
from nag.numerics.doubles import EPS
from nag.numerics.dual_space import CurveSearch, DualSpace, dual_space
from nag.numerics.exact_system import ExactSystem
from nag.numerics.implicit_function import eliminate
from nag.numerics.power_series import Series, SeriesRing
from nag.numerics.precise_point import POINT_DIGITS, PrecisePoint
from nag.numerics.series_zeros import find_zeros_of_cluster
from nag.numerics.sharpening import ARRIVED, ZERO, sharpen
from nag.numerics.singular_point import Place, SingularEnd

# Decimal logarithms of the factors by which the error may exceed what is claimed, in this order.
REACHES = (1.0, 0.0, 2.0, 3.5)
# Decides: Decimal logarithm of the largest distance in which a zero is looked for.
FURTHEST = -1.3
# Decides, measured: Decimal logarithm of such entries that are not zero: above -1. What falls
# between is undecided.
SOMETHING = -45.0
NUMBERS = Digits(DIGITS, ZERO, SOMETHING)
# Degrees of the dual space from which on curves through the point are looked for, if it has not
# become smaller for two degrees, and the highest degree.
SEARCHES = (6, 14, 30)
HIGHEST = 400
# How often curves are looked for before that, and Newton's steps for a first zero.
FIRST_ATTEMPTS, FIRST_STEPS = 3, 15
# The most digits, beside those, in which a zero is looked at once more.
MOST_DIGITS = 2000
# Errors of such a point in units of its coordinates: at least this, and as much as rounding makes
# of it by the inverse Jacobian.
ERROR, ROUNDED = 1e-120, 1e-135
# Clusters of clusters are not resolved further than this.
DEEPEST = 3
OTHERS = "a zero on a larger set was found, and others may lie as near"


@dataclass(frozen=True)
class Effort:
    """How much a zero is judged by.

    Attributes:
        hold: whether what vanishes must do so to as many digits as the coefficients ask for.
        patience: part of the usual work after which its local ring is left undecided.
        most: the largest multiplicity that it may have if it is isolated, where that is known.
    """

    hold: bool = True
    patience: float = 1.0
    most: int | None = None


def judge_zero(
    polynomials: Sequence[Polynomial],
    x: Sequence[Any] | np.ndarray,
    accuracy: float | np.ndarray,
    rng: np.random.Generator,
    slices: np.ndarray | None,
    effort: Effort,
) -> SingularEnd:
    """See `nag.numerics.singular_point.analyse`."""
    units, spread = None, None
    with working_digits(DIGITS):
        precise = to_point(x)
        rounded = doubles(precise)
        if not np.isfinite(rounded).all():
            return _leave_undecided(rounded, np.inf, "the point is not finite")
        if isinstance(accuracy, np.ndarray):
            accuracy, units = _units(rounded, accuracy)
        system = ExactSystem.of(polynomials, rounded, slices, units)
        if units is None:
            # Errors count relative to the whole point, the scales to each of its coordinates.
            spread = LOG10_2 * (max(system.scales, default=0) - min(system.scales, default=0))
        y = [times_power_of_two(c, -k) for c, k in zip(precise, system.scales, strict=True)]
        reach = log10(max(accuracy, 1e-300))
        return _judge_point(system, y, max(reach, ROUNDING - DIGITS), rng, effort, spread or 0.0)


def _units(x: np.ndarray, radii: np.ndarray) -> tuple[float, np.ndarray]:
    """An error, and the units in which no coordinate has a larger one.

    Coordinates are at most one in them, and those that are known best are of size one. Those that
    may be zero are so beside the others, however well that is known.
    """
    sizes, least = np.abs(x), 10 ** (ROUNDING - DIGITS)
    there = radii < sizes
    if not there.any():
        return max(float(radii.max(initial=0.0)), least), np.ones(len(x))
    error = max(float((radii[there] / sizes[there]).min()), least)
    units = np.maximum(sizes, radii / error)
    units[~there] = np.maximum(units[~there], sizes.max())
    return error, units


def _judge_point(
    system: ExactSystem,
    y: Sequence[flint.acb],
    claimed: float,
    rng: np.random.Generator,
    effort: Effort,
    spread: float,
    depth: int = 0,
) -> SingularEnd:
    """The judgement of a point that is known to ``10^claimed``, or to ``10^spread`` times that."""
    reasons: list[str] = []
    tried: set[float] = set()
    for more in (*REACHES[:2], REACHES[0] + spread, *REACHES[2:]):
        reach = min(claimed + more, max(FURTHEST, claimed))
        if reach in tried:
            continue
        tried.add(reach)
        try:
            found = deflate(system, y, reach, rng, most=effort.most)
        except NotDeflated as reason:
            reasons.append(str(reason))
            continue
        if found.exact:
            end = _at_zero(system, found, rng, effort)
            # Of a cluster all zeros are looked for, each known far better than they lie apart.
            sure = depth or end.place is not Place.ON_COMPONENT
            if sure or not _may_be_another(system, found.point, reach):
                return end
            reasons.append(OTHERS)
            continue
        reasons.append(f"what should vanish there is of size 1e{found.defect:.0f}")
        if found.free or depth == DEEPEST:
            continue
        nearby = _resolve_cluster(system, found, reach, rng, effort, spread, depth)
        if len(nearby) == 1 and nearby[0].place is Place.ON_COMPONENT and nearby[0].precise:
            centre = nearby[0].precise.centre
            point = [times_power_of_two(c, -k) for c, k in zip(centre, system.scales, strict=True)]
            if depth or not _may_be_another(system, point, reach):
                return nearby[0]
            reasons.append(OTHERS)
            continue
        if len(nearby) == 1 and (found.corank > 1 or nearby[0].place is Place.ON_COMPONENT):
            return nearby[0]
        if nearby:
            return _cluster(system, found, nearby)
    here = doubles(_undo_scales(system, y))
    return _leave_undecided(here, 10**claimed, reasons[0] if reasons else "")


def _may_be_another(system: ExactSystem, zero: Sequence[flint.acb], reach: float) -> bool:
    """Whether what is known to ``10^reach`` may be an isolated zero beside one on a set."""
    if not system.most_zeros:
        return False
    found = regular_block(system.values_at(DIGITS).jacobian(zero), system.n, ZERO)
    block = Round(tuple(found.rows), tuple(found.columns))
    return may_hide_others(system, zero, block, max(reach + 1, ARRIVED))


def _at_zero(
    system: ExactSystem, found: DeflatedPoint, rng: np.random.Generator, effort: Effort
) -> SingularEnd:
    """The judgement of an exact zero."""
    if found.free:
        reason = "the equations vanish along a smooth set that was followed"
        end = _end(system, found, Place.ON_COMPONENT, 0, reason, found.free)
        other = point_beside(system, found) if found.corank == found.free else None
        return end if other is None else replace(end, beside=_precise(system, found, other))
    if not system.most_zeros:
        reason = "there are fewer equations than variables"
        missing = system.n - len(system.rows)
        return _end(system, found, Place.ON_COMPONENT, 0, reason, missing)
    if asks_for_more(found.corank, effort.most):
        reason = f"isolated zeros of corank {found.corank} are of multiplicity {2**found.corank}"
        return _end(system, found, Place.ON_COMPONENT, 0, f"{reason} and more", 1)
    if found.corank > 1 and is_exact_zero(system, found):
        reason, dimension = _on_a_curve(system, found, rng)
        if dimension:
            return _end(system, found, Place.ON_COMPONENT, 0, reason, dimension)
    doubtful = effort.hold and (found.corank > 0 or len(system.rows) > system.n)
    if doubtful and not _held(system, found):
        reason = "more digits show several zeros there, or none, nearer than 150 digits tell"
        return _end(system, found, Place.UNDECIDED, 0, reason)
    if found.corank == 0:
        return _end(system, found, Place.ISOLATED, 1, "the Jacobian is regular")
    if found.corank == 1:
        order = found.rounds[0].order
        return _end(system, found, Place.ISOLATED, order, "the order of a power series")
    try:
        return _by_dual_space(system, found, rng, effort.patience)
    except (UnclearRank, _TooLarge) as reason:
        return _end(system, found, Place.UNDECIDED, 0, str(reason))


def _on_a_curve(
    system: ExactSystem, found: DeflatedPoint, rng: np.random.Generator
) -> tuple[str, int]:
    """Why a zero lies on a set of positive dimension, and of which; 0 where that is not seen soon.

    Where it succeeds this is the cheapest proof: no dual space, and no more digits than long
    coefficients ask for.
    """
    exact = rational_point(found.point, DIGITS) if system.rational else None
    if exact is not None and system.vanishes_exactly(exact) and system.vanishes_on_an_axis(exact):
        return "the equations vanish exactly on a line through it", 1
    dimension = curve_through(system, found, rng, FIRST_ATTEMPTS, FIRST_STEPS)
    return "a curve of zeros was followed to the point", dimension


def _held(system: ExactSystem, found: DeflatedPoint) -> bool:
    """Whether what vanishes at a zero does so to as many digits as long coefficients ask for.

    Zeros may be as near to each other as the coefficients are long, times the number of zeros.
    """
    more = min(2 * system.height * int(min(system.most_zeros, MOST_DIGITS)), MOST_DIGITS)
    digits = DIGITS + more
    exact = sharpen(system, found.point, found.rounds, digits)
    return exact is not None and exact[1].defect < ZERO / DIGITS * digits


def _by_dual_space(
    system: ExactSystem, found: DeflatedPoint, rng: np.random.Generator, patience: float
) -> SingularEnd:
    exact = rational_point(found.point, DIGITS) if system.rational else None
    if exact is not None and not system.vanishes_exactly(exact):
        raise UnclearRank("the equations vanish to all digits, but not at the rational point there")
    search = CurveSearch(SEARCHES, lambda attempts: curve_through(system, found, rng, attempts))
    spaces: list[DualSpace] = []
    for field in FIELDS if exact is not None else (NUMBERS,):
        known = exact is not None and isinstance(field, PrimeField)
        centre = list(map(field.of, exact)) if known else found.point
        try:
            spaces.append(_dual_space(system, field, centre, found, search.succeeds, patience))
        except _TooLarge:
            if not search.last():
                raise
        if search.dimension:
            reason = "a curve of zeros was followed to the point"
            return _end(system, found, Place.ON_COMPONENT, 0, reason, search.dimension)
        if not spaces[-1].finite:
            grown = ", ".join(map(str, spaces[-1].hilbert[:12]))
            reason = f"its dual space grows on ({grown}, ...), but no curve through it was found"
            return _end(system, found, Place.UNDECIDED, 0, reason)
    # Modulo a prime a local ring may be larger than it is, but not smaller.
    multiplicity = min(space.dimension for space in spaces)
    reason = f"the dual space, of degree {len(spaces[0].hilbert) - 1}"
    return _end(system, found, Place.ISOLATED, multiplicity, reason)


class _TooLarge(Exception):
    """Series would be too long."""


def _dual_space(
    system: ExactSystem,
    field: Field,
    centre: Sequence[Any],
    found: DeflatedPoint,
    stop: Callable[[Sequence[int]], bool],
    patience: float,
) -> DualSpace:
    rows = system.modulo(field) if isinstance(field, PrimeField) else system.at(DIGITS)
    first = found.rounds[0]

    def series(order: int) -> tuple[SeriesRing, list[Series]]:
        most = MOST_WORK * patience * (5 if field.modulus else 1)
        if series_cost(found.corank, order, [first]) > most:
            raise _TooLarge(f"its series in {found.corank} variables are too long")
        reduction = eliminate(rows, centre, first.rows, first.columns, order, field.modulus)
        if reduction is None:
            raise _TooLarge("the regular part is singular modulo a prime")
        rest = [{k: c for k, c in s.items() if not field.is_zero(c)} for s in reduction.rest]
        return reduction.ring, rest

    return dual_space(field, found.corank, series, HIGHEST, stop)


def _resolve_cluster(
    system: ExactSystem,
    found: DeflatedPoint,
    reach: float,
    rng: np.random.Generator,
    effort: Effort,
    spread: float,
    depth: int,
) -> list[SingularEnd]:
    """The zeros of a cluster about a point, each judged by itself.

    Of those on a component of positive dimension there is one, the last.
    """
    result: list[SingularEnd] = []
    known: list[PrecisePoint] = []
    component: SingularEnd | None = None
    for start, size, regular in find_zeros_of_cluster(system, found, reach, rng):
        if component is not None and not regular:
            break
        end = _judge_point(system, start, size - 4.0, rng, effort, spread, depth + 1)
        if end.dimension:
            component = end
        for one in end.nearby or (end,):
            if one.place is not Place.ISOLATED or one.precise is None:
                continue
            apart = (one.precise.log_distance(other) for other in known)
            if all(distance > SPARE - POINT_DIGITS for distance in apart):
                known.append(one.precise)
                result.append(one)
    return result if component is None else [*result, component]


def _cluster(
    system: ExactSystem, found: DeflatedPoint, nearby: Sequence[SingularEnd]
) -> SingularEnd:
    isolated = tuple(one for one in nearby if one.place is Place.ISOLATED)
    total = sum(one.multiplicity for one in isolated)
    reason = f"{len(isolated)} zeros close together, of multiplicities that add up to {total}"
    dimension = max(one.dimension for one in nearby)
    if dimension:
        reason += ", beside a component of positive dimension"
    end = _end(system, found, Place.CLUSTER, 0, reason)
    spread = max(float(np.abs(one.point - end.point).max()) for one in nearby)
    return SingularEnd(
        end.point,
        end.place,
        0,
        spread,
        np.inf,
        reason,
        dimension,
        precise=end.precise,
        nearby=isolated,
    )


def _precise(system: ExactSystem, found: DeflatedPoint, y: Sequence[flint.acb]) -> PrecisePoint:
    """A zero as well as the conditions of one beside it let it be known."""
    x = _undo_scales(system, y)
    error = max(ERROR, 10.0 ** max(found.inverse, 0.0) * ROUNDED)
    radii = error * np.exp2(system.scales) + 10.0 ** (1 - POINT_DIGITS) * np.abs(doubles(x))
    return PrecisePoint(tuple(x), np.maximum(radii, 1e-300))


def _undo_scales(system: ExactSystem, y: Sequence[flint.acb]) -> list[flint.acb]:
    return [times_power_of_two(c, k) for c, k in zip(y, system.scales, strict=True)]


def _end(
    system: ExactSystem,
    found: DeflatedPoint,
    place: Place,
    multiplicity: int,
    reason: str,
    dimension: int = 0,
) -> SingularEnd:
    precise = _precise(system, found, found.point)
    x = precise.centre
    exact = rational_point(x, DIGITS) if system.rational and not found.free else None
    return SingularEnd(
        precise.doubles,
        place,
        multiplicity,
        EPS,
        10.0 ** max(found.inverse, 0.0),
        reason,
        dimension,
        precise,
        tuple(exact) if exact is not None else None,
    )


def known_digits(a: flint.arb) -> str:
    """The digits of a ball that are certain to one unit of the last, at most `POINT_DIGITS`."""
    return "0" if a.contains(0) else a.str(POINT_DIGITS, radius=False)


def _leave_undecided(x: np.ndarray, accuracy: float, reason: str) -> SingularEnd:
    return SingularEnd(x, Place.UNDECIDED, 0, accuracy, np.inf, reason)
