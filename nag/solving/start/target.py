"""What a start system is made for: a square system, and what it hands to the tracker."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from nag.algebra.combinations import of_fewest_terms
from nag.algebra.number import Number
from nag.algebra.polynomial import Exponents, Polynomial, find_nonzero_variables
from nag.errors import NagError
from nag.numerics.array_table import map_rows
from nag.numerics.doubles import EPS, UNIT
from nag.numerics.natural_coordinates import NaturalCoordinates, natural_coordinates
from nag.numerics.scaling import independent_rows, scaled_terms, variable_scales
from nag.tracking.compiled import CompiledRows
from nag.tracking.homotopy import Homotopy
from nag.tracking.known import NOTHING, KnownOfPaths
from nag.tracking.starts import StartsByIndex

Terms = Mapping[Exponents, Number | complex]


@dataclass(frozen=True, eq=False)
class Target:
    """``n`` polynomials in ``n`` variables, as maps from exponents to exact or complex numbers.

    Attributes:
        n: number of variables and of polynomials.
        rows: the terms, in variables ``y``.
        scales: ``2^scales[i] y_i`` is the variable i in ``natural`` coordinates, with integers;
            empty where the y are the original variables.
        natural: coordinates that the system was brought to before.
        digits: decimal digits of the coefficients of the polynomials that the rows come from.
        given: these polynomials' terms in the variables ``y``, scaled, before rows of the same
            monomials were combined.
        in_torus: whether no coordinate of a solution vanishes.
    """

    n: int
    rows: tuple[Terms, ...]
    scales: tuple[int, ...] = ()
    natural: NaturalCoordinates | None = None
    digits: int | None = None
    given: tuple[Terms, ...] = ()
    in_torus: bool = False

    def __post_init__(self) -> None:
        if len(self.rows) != self.n:
            raise NagError(f"{len(self.rows)} polynomials in {self.n} variables are not square")

    @classmethod
    def of(
        cls,
        polynomials: Sequence[Polynomial],
        n: int,
        digits: int | None = None,
        natural: NaturalCoordinates | None = None,
    ) -> Target:
        """The polynomials in natural coordinates, variables and rows scaled by powers of two.

        Args:
            digits: of the coefficients that those of the polynomials were worked out from, if they
                are not these.
            natural: the coordinates that the polynomials are in, if they have been brought there.
        """
        digits = most_digits(polynomials) if digits is None else digits
        if natural is None:
            natural = natural_coordinates(polynomials, n)
            polynomials = [natural.polynomial(f) for f in polynomials]
        scales = variable_scales(polynomials, n)
        given = tuple(scaled_terms(f, scales) for f in polynomials)
        rows = independent_rows(given)
        in_torus = len(find_nonzero_variables(rows, n)) == n
        return cls(n, rows, tuple(scales.tolist()), natural, digits, given, in_torus)

    def scaled(self, f: Polynomial) -> Polynomial:
        """``f``, a polynomial in the original variables, in the variables ``y``, scaled."""
        if self.natural is not None:
            f = self.natural.polynomial(f)
        return Polynomial(self.n, scaled_terms(f, np.array(self.scales, dtype=np.int64)))

    def original(self, points: np.ndarray) -> np.ndarray:
        """Values of the original variables, from those of ``y``, shape ``(P, n)``."""
        if not self.scales:
            return points
        return map_rows(lambda some: some * self._units + self._origin, points)

    def scaled_points(self, x: np.ndarray) -> np.ndarray:
        """Values of ``y``, from those of the original variables, shape ``(P, n)``."""
        return (x - self._origin) / self._units if self.scales else x

    @cached_property
    def _units(self) -> np.ndarray:
        units = np.exp2(self.scales)
        return units if self.natural is None else units * np.array(self.natural.scales, dtype=float)

    @cached_property
    def _origin(self) -> np.ndarray:
        return np.zeros(self.n) if self.natural is None else np.array(self.natural.origin, float)

    def rounding(self, points: np.ndarray) -> np.ndarray:
        """Errors that `original` adds, relative to one and the size of the result, shape ``(P,)``.

        A shift may cancel most of a coordinate, of which doubles round all of it.
        """
        if self.natural is None or self.natural.is_exact_in_doubles:
            return np.zeros(len(points))
        shift = float(np.linalg.norm(self._origin))

        def errors(some: np.ndarray) -> np.ndarray:
            before = np.linalg.norm(some * self._units, axis=1)
            after = np.linalg.norm(self.original(some), axis=1)
            return UNIT * (before + shift + after) / (1 + after)

        return map_rows(errors, points)

    def original_radii(self, point: np.ndarray, radii: np.ndarray | None) -> np.ndarray | None:
        """Errors of a point's original coordinates, from those of ``y``, shape ``(n,)``."""
        if radii is None or not self.scales:
            return radii
        exact = self.natural is None or self.natural.is_exact_in_doubles
        rounding = 0.0 if exact else EPS * np.abs(point)
        return radii * self._units + rounding

    @cached_property
    def degrees(self) -> tuple[int, ...]:
        """Total degrees."""
        return tuple(max(map(sum, row), default=0) for row in self.rows)

    @cached_property
    def sparsest(self) -> Target:
        """The same target with equations of fewer terms, as far as combinations have these."""
        # Terms cancel exactly or not at all.
        if any(isinstance(c, complex) for row in self.rows for c in row.values()):
            return self
        rows = [Polynomial(self.n, dict(row)) for row in self.rows]
        found = of_fewest_terms(rows)
        if all(f is g for f, g in zip(rows, found, strict=True)):
            return self
        plain = np.zeros(self.n, dtype=np.int64)
        return replace(self, rows=tuple(scaled_terms(f, plain) for f in found))

    @cached_property
    def stack(self) -> StackedExponents:
        """The exponents of all rows."""
        return StackedExponents.of(self.rows)

    @property
    def has_constants(self) -> bool:
        """Whether each polynomial has a constant term."""
        return all((0,) * self.n in row for row in self.rows)

    @cached_property
    def supports(self) -> tuple[np.ndarray, ...]:
        """Exponents of each row together with the origin, each shape ``(terms, n)``.

        With the origin, coefficients chosen at random have constant terms, and solutions with
        coordinates that vanish are limits of solutions without such (Li & Wang 1996). Where there
        are none, the origin is left out. A row without terms counts as a constant.
        """
        origin = ((0,) * self.n,)
        more = () if self.in_torus else origin
        return tuple(np.array(sorted({*row, *more} or origin), np.int64) for row in self.rows)


class StackedExponents(NamedTuple):
    """The exponents of all rows, one row's after another's.

    ``exponents`` has shape ``(terms, n)``; those of row ``r`` begin at ``first[r]``. A row without
    terms counts as a constant.
    """

    exponents: np.ndarray
    first: np.ndarray

    @classmethod
    def of(cls, rows: Sequence[Terms]) -> StackedExponents:
        """The exponents of ``rows``."""
        n = next((len(e) for row in rows for e in row), 0)
        all_of = [list(row) or [(0,) * n] for row in rows]
        first = np.cumsum([0] + [len(exponents) for exponents in all_of], dtype=np.int64)[:-1]
        stacked = np.array([e for exponents in all_of for e in exponents], dtype=np.int64)
        return cls(stacked.reshape(int(first[-1]) + len(all_of[-1]) if all_of else 0, n), first)


@dataclass(frozen=True, eq=False)
class StartSystem:
    """A homotopy from a solved system to the target, and the solutions at t = 1.

    Attributes:
        name: one of `nag.solving.start.KINDS`.
        homotopy: from the start system (t = 1) to the target (t = 0).
        points: start points, one for each path, shape ``(P, N)``, or such by index.
        groups: the groups of variables that were homogenised together.
        complete: whether each isolated solution of the target is the end of as many paths as its
            multiplicity is.
        detail: how the start system came about, for the reader.
        known: what is known of the paths beforehand.
    """

    name: str
    homotopy: Homotopy
    points: np.ndarray | StartsByIndex
    groups: tuple[tuple[int, ...], ...]
    complete: bool = True
    detail: str = ""
    known: KnownOfPaths = NOTHING

    def affine(self, points: np.ndarray) -> np.ndarray:
        """Values of the variables at projective points, shape ``(P, n)``."""
        shift = len(self.groups)
        n = sum(len(group) for group in self.groups)

        def values(some: np.ndarray) -> np.ndarray:
            result = np.empty((len(some), n), dtype=np.complex128)
            for k, group in enumerate(self.groups):
                places = [shift + i for i in group]
                result[:, list(group)] = some[:, places] / some[:, k : k + 1]
            return result

        return map_rows(values, points)


def most_digits(polynomials: Iterable[Polynomial]) -> int:
    """The most decimal digits that a coefficient has."""
    return max((f.digits for f in polynomials), default=0)


def homogenize_rows(
    rows: Iterable[Terms], n: int, groups: Sequence[Sequence[int]], degrees: np.ndarray
) -> CompiledRows:
    """Rows of the given degrees in the groups; the layout is that of `compile_rows`."""
    shift = len(groups)
    parts = []
    for row, wanted in zip(rows, degrees, strict=True):
        if shift == 1:
            degree = int(wanted[0])
            parts.append(((0, {(degree - sum(e), *e): c for e, c in row.items()}),))
            continue
        terms = {}
        for e, c in row.items():
            missing = tuple(
                int(d) - sum(e[i] for i in g) for g, d in zip(groups, wanted, strict=True)
            )
            terms[missing + tuple(e)] = c
        parts.append(((0, terms),))
    coordinates = tuple((k, *(i + shift for i in g)) for k, g in enumerate(groups))
    return CompiledRows(n + shift, tuple(parts), coordinates, tuple(range(shift)), degrees)


def group_degrees(
    rows: Sequence[Terms] | StackedExponents, groups: Sequence[Sequence[int]]
) -> np.ndarray:
    """Degree of each row in each group, shape ``(rows, groups)``."""
    stack = rows if isinstance(rows, StackedExponents) else StackedExponents.of(rows)
    if not len(stack.first):
        return np.zeros((0, len(groups)), dtype=np.int64)
    member = np.zeros((stack.exponents.shape[1], len(groups)), dtype=np.int64)
    for g, group in enumerate(groups):
        member[list(group), g] = 1
    return np.maximum.reduceat(stack.exponents @ member, stack.first, axis=0)


def unit(rng: np.random.Generator, *shape: int) -> np.ndarray:
    """Random complex numbers of absolute value 1."""
    return np.exp(2j * np.pi * rng.random(shape))
