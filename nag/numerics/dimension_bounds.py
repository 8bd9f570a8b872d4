"""Bounds of the local dimension at a point, from matrices and from zeros nearby."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from itertools import accumulate
from typing import Any

import flint
import numpy as np

from nag.algebra.elimination import Elimination
from nag.algebra.exact_ranks import PrimeField
from nag.algebra.factoring import common_factor
from nag.algebra.number import is_zero
from nag.algebra.polynomial import Polynomial
from nag.numerics.algebraic_point import prime_images
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.ball_ranks import Field, UnclearRank
from nag.numerics.curves import curve_through
from nag.numerics.deflation import MOST_WORK, DeflatedPoint
from nag.numerics.descent import Round, series_cost
from nag.numerics.digits import (
    BITS,
    DIGITS,
    doubles,
    log_size,
    middle,
    to_ball,
    working_digits,
)
from nag.numerics.dual_space import CurveSearch, DualSpace, dual_space
from nag.numerics.exact_system import ExactSystem
from nag.numerics.implicit_function import eliminate
from nag.numerics.local_dimension import LocalDimension
from nag.numerics.local_structure import FURTHEST, HIGHEST, NUMBERS, REACHES, known_digits
from nag.numerics.located_zero import LocatedZero, is_exact, locate_zero
from nag.numerics.power_series import Series, SeriesRing, Terms
from nag.numerics.sharpening import ZERO, sharpen

# Degrees of the dual space from which on sets of zeros through the point are looked for, if it has
# not become smaller for two degrees.
SEARCHES = (3, 5, 9, 18, 36)
# Images modulo primes that must agree.
IMAGES = 2
# Digits of a point on hyperplanes: zeros beside it are told from it in less.
PASSING = 1200


@dataclass(frozen=True, eq=False)
class _LocalEquations:
    """The equations about the zero in some arithmetic."""

    field: Field
    rows: Sequence[Terms]
    centre: Sequence[Any]


class _SeriesTooLong(Exception):
    """Series would be too long."""


def bounds(
    polynomials: Sequence[Polynomial],
    point: Sequence[Any],
    error: float | None,
    rng: np.random.Generator,
) -> LocalDimension:
    """Bounds of the local dimension of the zeros of ``polynomials`` at a point.

    Args:
        error: decimal logarithm of the point's error in each coordinate; None if it is exact.
    """
    found, zero = _bounds(polynomials, point, error, rng)
    return found if zero is None else _told(found, zero)


def _bounds(
    polynomials: Sequence[Polynomial],
    point: Sequence[Any],
    error: float | None,
    rng: np.random.Generator,
) -> tuple[LocalDimension, list[flint.acb] | None]:
    """Bounds, and the zero in balls; None if there is none."""
    with working_digits(DIGITS):
        zero, factors, reason = locate_zero(polynomials, point, error, rng)
        if zero is None:
            here = np.array([complex(float(c)) if is_exact(c) else complex(c) for c in point])
            return LocalDimension(here, None, 0, len(point), 0, 0, (), "", reason), None
        answer = _at_zero(zero, _on_hypersurface(polynomials, zero, factors), rng)
        return answer, [c * f for c, f in zip(zero.balls, factors, strict=True)]


def _told(found: LocalDimension, zero: Sequence[flint.acb]) -> LocalDimension:
    """What was found, with the digits of the zero that its balls leave."""
    digits = tuple((known_digits(c.real), known_digits(c.imag)) for c in zero)
    return replace(found, point=doubles([middle(c) for c in zero]), digits=digits)


def reduced_bounds(
    elimination: Elimination,
    point: Sequence[Any],
    error: float | None,
    rng: np.random.Generator,
) -> LocalDimension | None:
    """`bounds` where linear equations have been solved: the local ring stays the same.

    None if these equations lead further away from a rounded point than it may be off.
    """
    kept = elimination.project(point)
    if error is not None:
        given = np.array([complex(c) for c in point])
        moved = np.abs(np.array([complex(c) for c in elimination.lift(kept)]) - given)
        reach = 10.0 ** min(error + max(REACHES), max(FURTHEST, error))
        if (moved > reach * np.maximum(1.0, np.abs(given))).any():
            return None
    found, zero = _bounds(elimination.system.polynomials, kept, error, rng)
    if zero is None:
        return replace(found, point=np.array([complex(c) for c in elimination.lift(found.point)]))
    lifted = BallPolynomials.of(elimination.images).values(zero, BITS)
    return _told(found, lifted.entries())


def _on_hypersurface(
    polynomials: Sequence[Polynomial], zero: LocatedZero, units: Sequence[flint.arb]
) -> bool:
    """Whether a common factor of the equations vanishes at a zero of them."""
    common = common_factor(polynomials)
    if common is None:
        return False
    if zero.exact is not None:
        powers = [Fraction(2) ** int(unit.man_exp()[1]) for unit in units]
        return is_zero(common([c * k for c, k in zip(zero.exact, powers, strict=True)]))
    point = [c * unit for c, unit in zip(zero.found.point, units, strict=True)]
    sizes = [flint.acb(max(abs(c).mid(), unit)) for c, unit in zip(point, units, strict=True)]
    system, bits = BallPolynomials.of((common,)), BITS
    (bound,), (value,) = system.sizes(sizes, bits), system.values(point, bits).mid().entries()
    return log_size(value) < ZERO + log_size(flint.acb(bound))


def _at_zero(zero: LocatedZero, hypersurface: bool, rng: np.random.Generator) -> LocalDimension:
    """Bounds at an exact zero, raised from below and lowered from above until they meet."""
    tangent, system = zero.tangent, zero.system
    missing = max(0, system.n - len(system.rows))
    # The deflated set is smooth of this dimension, and was followed.
    free = zero.found.free if zero.found.exact else 0
    lower, why = max(
        (system.n - 1 if hypersurface else 0, "a common factor of the equations vanishes there"),
        (free, "a smooth set was followed"),
        (missing, "fewer equations than variables"),
        key=lambda known: known[0],
    )
    answer = LocalDimension(
        np.zeros(0), tangent, lower, tangent, 0, 0, (), "", f"the tangent dimension; {why}"
    )
    if lower == tangent:
        if tangent == 0:
            return replace(answer, multiplicity=1, reason="the Jacobian is regular")
        return answer
    images = _images(zero)
    arithmetic = f"modulo {len(images)} primes" if images[0].field.modulus else f"{DIGITS} digits"
    while True:
        search = CurveSearch(SEARCHES, partial(_sliced_curve, zero, lower, rng))
        try:
            space = _dual_space(zero, images, lower, search.succeeds, rng)
        except (UnclearRank, _SeriesTooLong) as reason:
            return _bound_undecided(answer, zero, images, lower, rng, str(reason))
        coranks = tuple(accumulate(space.hilbert))
        answer = replace(answer, hyperplanes=lower, coranks=coranks, arithmetic=arithmetic)
        if space.finite:
            reason = f"isolated {_on(lower)}{'; ' + why if lower else ''}"
            multiplicity = space.dimension if lower == 0 else 0
            return replace(
                answer, lower=lower, upper=lower, multiplicity=multiplicity, reason=reason
            )
        if not search.dimension:
            reason = "its dual space grows on, but no set of zeros through it was found"
            return _bound_undecided(answer, zero, images, lower, rng, reason)
        lower += search.dimension
        why = f"a set of dimension {lower} was followed to the point"
        answer = replace(answer, lower=lower, reason=f"the tangent dimension; {why}")
        if lower == tangent:
            return answer


def _on(k: int) -> str:
    if k == 0:
        return "by a finite dual space"
    return f"on {k} random hyperplane{'' if k == 1 else 's'} by a finite dual space"


def _bound_undecided(
    answer: LocalDimension,
    zero: LocatedZero,
    images: list[_LocalEquations],
    lower: int,
    rng: np.random.Generator,
    reason: str,
) -> LocalDimension:
    """The least upper bound that the matrices give above a lower bound."""
    upper = zero.tangent
    for k in range(lower + 1, zero.tangent):
        try:
            if _dual_space(zero, images, k, lambda _: False, rng).finite:
                upper = k
                break
        except (UnclearRank, _SeriesTooLong):
            continue
    return replace(answer, lower=lower, upper=upper, reason=reason)


def _images(zero: LocatedZero) -> list[_LocalEquations]:
    """The equations modulo primes if the zero is algebraic, else in digits."""
    if zero.exact is not None:
        found = [
            _LocalEquations(PrimeField(image.modulus), image.rows, image.centre)
            for image in prime_images(zero.system, zero.exact, IMAGES)
        ]
        if found:
            return found
    return [_LocalEquations(NUMBERS, zero.system.at(DIGITS), zero.found.point)]


def _hyperplanes(zero: LocatedZero, k: int, rng: np.random.Generator) -> np.ndarray:
    """Normals of random hyperplanes in the variables that the regular part leaves, integers."""
    return rng.integers(1, 2**30, size=(k, zero.tangent)) * rng.choice((-1, 1), (k, zero.tangent))


def _through(normals: np.ndarray, free: list[int], image: _LocalEquations, n: int) -> list[Terms]:
    """Equations of the hyperplanes through the image of the point."""
    rows: list[Terms] = []
    p = image.field.modulus
    for normal in normals.tolist():
        weights = [a % p if p else flint.acb(a) / 2**30 for a in normal]
        constant: Any = 0
        for w, i in zip(weights, free, strict=True):
            constant = constant - w * image.centre[i]
        row = [
            (tuple(int(i == j) for j in range(n)), w) for i, w in zip(free, weights, strict=True)
        ]
        rows.append([((0,) * n, constant % p if p else constant), *row])
    return rows


def _dual_space(
    zero: LocatedZero,
    images: list[_LocalEquations],
    k: int,
    stop: Callable[[Sequence[int]], bool],
    rng: np.random.Generator,
) -> DualSpace:
    """The dual space on ``k`` random hyperplanes through the point, the smallest of all images."""
    normals = _hyperplanes(zero, k, rng)
    spaces = []
    for image in images:
        spaces.append(_in_image(zero, image, normals, stop))
        if not spaces[-1].finite:
            return spaces[-1]
    return min(spaces, key=lambda space: space.dimension)


def _in_image(
    zero: LocatedZero,
    image: _LocalEquations,
    normals: np.ndarray,
    stop: Callable[[Sequence[int]], bool],
) -> DualSpace:
    """The dual space on hyperplanes in one arithmetic, where the regular part is solved first."""
    block, n, k, field = zero.block, zero.system.n, len(normals), image.field
    free = [i for i in range(n) if i not in block.columns]
    rows = [*image.rows, *_through(normals, free, image, n)]
    solved = (*block.rows, *range(len(image.rows), len(rows)))
    columns = (*block.columns, *free[:k])
    m, most = zero.tangent - k, MOST_WORK * (5 if field.modulus else 1)

    def series(order: int) -> tuple[SeriesRing, list[Series]]:
        if series_cost(m, order, [Round(solved, columns)]) > most:
            raise _SeriesTooLong(f"its series in {m} variables are too long")
        found = eliminate(rows, image.centre, solved, columns, order, field.modulus)
        if found is None:
            raise _SeriesTooLong("the regular part is singular in this arithmetic")
        rest = [{e: c for e, c in s.items() if not field.is_zero(c)} for s in found.rest]
        return found.ring, rest

    return dual_space(field, m, series, HIGHEST, stop)


def _sliced_curve(
    zero: LocatedZero, hyperplanes: int, rng: np.random.Generator, attempts: int
) -> int:
    sliced = _slice_zero(zero, hyperplanes, rng)
    return 0 if sliced is None else curve_through(*sliced, rng, attempts)


def _slice_zero(
    zero: LocatedZero, k: int, rng: np.random.Generator
) -> tuple[ExactSystem, DeflatedPoint] | None:
    """The zero on ``k`` random hyperplanes through it, as exact as the searches beside it need."""
    system, block = zero.system, zero.block
    order = max(zero.found.rounds[0].order, 2)
    free = [i for i in range(system.n) if i not in block.columns]
    solved = (*block.rows, *range(len(system.rows), len(system.rows) + k))
    here = Round(solved, (*block.columns, *free[:k]), order)
    point = _passing(zero) if k else zero.found.point
    if point is None:
        return None
    units = [tuple(int(i == j) for j in range(system.n)) for i in free]
    with working_digits(PASSING):
        for row in _hyperplanes(zero, k, rng).tolist():
            weights: list[Any] = [Fraction(a, 2**30) for a in row]
            if isinstance(point[0], flint.acb):
                weights = [to_ball(a) for a in weights]
            constant = -sum(a * point[i] for a, i in zip(weights, free, strict=True))
            if isinstance(constant, flint.acb):
                constant = middle(constant)
            terms = [((0,) * system.n, constant), *zip(units, weights, strict=True)]
            system = system.with_row(terms)
    return system, replace(zero.found, rounds=(here,))


def _passing(zero: LocatedZero) -> Sequence[Any] | None:
    """The zero, exact or to so many digits that hyperplanes through it may be told from others."""
    if zero.exact is not None and all(isinstance(c, Fraction) for c in zero.exact):
        return zero.exact
    with working_digits(PASSING):
        if zero.exact is not None:
            return [middle(to_ball(c)) for c in zero.exact]
        found = sharpen(zero.system, zero.found.point, zero.found.rounds, PASSING)
    return None if found is None else found[0]
