"""Components that are conjugate over the rational numbers, by their points on a rational slice.

A slice with rational coefficients in some of the variables, as many equations as the dimension of
the images there, meets these in points that the Galois group permutes, and a rational linear form
tells the points apart. What has a set of conjugate components for its zeros is defined over the
rational numbers: the values of the form on all of them are the zeros of a polynomial that is
recognised, and the values on conjugate ones those of one irreducible factor (Hilbert's theorem).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import flint
import numpy as np

from nag.algebra.flint_numbers import to_rational
from nag.interpolation.precise_samples import Sample, Source, SourceError
from nag.interpolation.vanishing import DIGITS, InterpolationError
from nag.numerics.digits import SPARE, bits_of, in_bits
from nag.numerics.doubles import ROUGH
from nag.numerics.rational_relations import TooFewDigitsError, recognise_rational
from nag.tracking.run import Run
from nag.witness.moving import move_and_sharpen
from nag.witness.slices import random_rows

# Random coefficients are whole numbers up to this, over the coordinates' sizes.
LARGEST = 99


@dataclass(frozen=True, eq=False)
class ConjugateClass:
    """Images that are conjugate.

    Attributes:
        members: indices of components with different images.
        polynomial: the values of the linear form on the slice are its zeros; irreducible.
    """

    members: tuple[int, ...]
    polynomial: flint.fmpq_poly

    @property
    def degree(self) -> int:
        """Of the images together."""
        return int(self.polynomial.degree())


@dataclass(frozen=True, eq=False)
class RationalSlice:
    """Rational equations and a rational linear form in some of the variables.

    Attributes:
        coordinates: of these variables, ``k`` of them.
        rows: dyadic fractions in doubles, shape ``(r, 1 + k)``.
        form: likewise, shape ``(k,)``.
    """

    coordinates: tuple[int, ...]
    rows: np.ndarray
    form: np.ndarray

    @classmethod
    def at_random(
        cls, source: Source, coordinates: Sequence[int], dimension: int, rng: np.random.Generator
    ) -> RationalSlice:
        """One that is generic where coordinates have the sizes that they have on a component.

        It is one in the source's coordinates. The form of a single variable is this variable.
        """
        sizes = source.fibres[0].sizes[[0, *(1 + i for i in coordinates)]]
        rows = rng.integers(1, LARGEST + 1, (dimension, len(sizes))) / sizes
        form = rng.integers(1, LARGEST + 1, len(coordinates)) / sizes[1:]
        return cls(tuple(coordinates), rows, np.ones(1) if len(form) == 1 else form)

    def samples(self, source: Source, rng: np.random.Generator, run: Run) -> list[Sample]:
        """The points of a component on this slice and on one through the fibres of the projection.

        Raises:
            SourceError: if a path fails.
        """
        n, r = source.system.n, len(self.rows)
        target = np.zeros((source.dimension, 1 + n), dtype=complex)
        target[:r, [0, *(1 + i for i in self.coordinates)]] = self.rows
        sizes = source.fibres[0].sizes
        target[r:] = random_rows(rng, source.dimension - r, n) / sizes
        there, paths = move_and_sharpen(source.fibres, target, rng, run)
        if paths.failed or not there.accuracy < ROUGH:
            raise SourceError("a path to a rational slice failed")
        found = []
        for fibre in there.fibres:
            found += [Sample(source.natural, fibre.only([k])) for k in range(len(fibre))]
        return found

    def value(self, sample: Sample, digits: int) -> flint.acb:
        """The form at a point."""
        point = sample.balls(digits)
        terms = (point[i] * float(c) for i, c in zip(self.coordinates, self.form, strict=True))
        return sum(terms, flint.acb(0))


def conjugate_classes(
    sources: Sequence[Source],
    coordinates: Sequence[int],
    dimension: int,
    rng: np.random.Generator,
    run: Run,
) -> list[ConjugateClass]:
    """Classes of components whose images in some variables are conjugate.

    Args:
        sources: the components.
        dimension: of their images.

    Raises:
        InterpolationError: if together they are not defined over the rational numbers.
        SourceError: if points on the slice are not found.
    """
    cut = RationalSlice.at_random(sources[0], coordinates, dimension, rng)
    samples = [cut.samples(source, rng, run) for source in sources]
    for digits in DIGITS:
        with in_bits(bits_of(digits + SPARE)):
            values = [_distinct([cut.value(s, digits) for s in each]) for each in samples]
            zeros = _distinct([v for each in values for v in each])
            try:
                whole = _polynomial(zeros, digits)
            except TooFewDigitsError:
                continue
            return _classes(values, [factor for factor, _ in whole.factor()[1]])
    raise InterpolationError(
        f"on a rational slice the components have values that are the zeros of no rational "
        f"polynomial that is recognised in {DIGITS[-1]} digits: conjugate ones are missing"
    )


def _distinct(values: Sequence[flint.acb]) -> list[flint.acb]:
    """One of those that overlap each."""
    kept: list[flint.acb] = []
    for v in values:
        if not any(v.overlaps(u) for u in kept):
            kept.append(v)
    return kept


def _polynomial(zeros: Sequence[flint.acb], digits: int) -> flint.fmpq_poly:
    """The monic polynomial with these zeros.

    Raises:
        TooFewDigitsError: if its coefficients are not recognised.
    """
    product = flint.acb_poly([1])
    for z in zeros:
        product *= flint.acb_poly([-z, 1])
    coefficients = list(product)
    if any(not c.imag.contains(0) for c in coefficients):
        raise TooFewDigitsError("coefficients are not real")
    numbers = [recognise_rational(c.real, digits) for c in coefficients]
    return flint.fmpq_poly(list(map(to_rational, numbers)))


def _classes(
    values: Sequence[Sequence[flint.acb]], factors: Sequence[flint.fmpq_poly]
) -> list[ConjugateClass]:
    """Components by the factors that vanish at their values; equal images count once."""
    parts: list[set[int]] = []
    for own in values:
        hit = {k for k, f in enumerate(factors) if any(_at(f, v).contains(0) for v in own)}
        joined = hit.union(*(part for part in parts if part & hit))
        parts = [part for part in parts if not part & hit] + [joined]
    found = []
    for part in sorted(parts, key=min):
        members: list[int] = []
        for i, own in enumerate(values):
            here = any(_at(factors[k], own[0]).contains(0) for k in part)
            if here and not any(own[0].overlaps(v) for k in members for v in values[k]):
                members.append(i)
        product = flint.fmpq_poly([1])
        for k in sorted(part):
            product *= factors[k]
        found.append(ConjugateClass(tuple(members), product))
    return found


def _at(f: flint.fmpq_poly, z: flint.acb) -> flint.acb:
    total = flint.acb(0)
    for c in reversed(f.coeffs()):
        total = total * z + flint.acb(c)
    return total
