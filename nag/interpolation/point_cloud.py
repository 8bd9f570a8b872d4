"""As many random points of a component, in as many digits, as an interpolation asks for."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import flint
import numpy as np

from nag.algebra.exact_ranks import roots_of
from nag.algebra.polynomial import Polynomial
from nag.algebra.root_basis import Root
from nag.algebra.system import PolynomialSystem
from nag.interpolation.precise_samples import Sample, Source, samples
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.digits import SPARE, bits_of, in_bits
from nag.numerics.double_ranks import NEARLY_SINGULAR, matrix_corank
from nag.tracking.run import Run
from nag.witness.slices import pad_rows

# Points beyond those that make the columns as long as they are many.
MORE_POINTS = 6

Exponents = tuple[int, ...]


@dataclass(frozen=True)
class AmbientVariables:
    """The variables that polynomials are looked for in, as polynomials in those of a system.

    Attributes:
        system: the equations in all these variables: those of the system, and what makes the
            others out of its variables.
        kept: place of each variable of the smaller system among them.
        images: each variable as a polynomial in the smaller system's variables.
    """

    system: PolynomialSystem
    kept: tuple[int, ...]
    images: tuple[Polynomial, ...]

    @classmethod
    def of(
        cls,
        system: PolynomialSystem,
        names: Sequence[str],
        kept: Sequence[int],
        images: Sequence[Polynomial],
    ) -> AmbientVariables:
        """The variables ``names``, of which ``system`` keeps those at ``kept``."""
        n = len(names)
        equations = [f.with_variables(n, kept) for f in system.polynomials]
        for i, image in enumerate(images):
            if i not in kept:
                equations.append(Polynomial.variable(n, i) - image.with_variables(n, kept))
        whole = PolynomialSystem(tuple(names), tuple(equations))
        return cls(whole, tuple(kept), tuple(images))

    @classmethod
    def itself(cls, system: PolynomialSystem) -> AmbientVariables:
        """The variables of the system and no others."""
        plain = replace(system, nonzero=(), groups=())
        return cls(plain, tuple(range(system.n)), Polynomial.variables(system.n))


class Cloud:
    """Random points of a component, found when they are asked for and kept.

    Components that are conjugate over the rational numbers make one set that is defined there; the
    points lie on one after the other of them. Of isolated points there are no more than these.

    Attributes:
        source: what they are sampled from.
        sources: this, and further components of the same dimension.
        ambient: the variables in which they are given.
        interpolated: what was found of the component's images, by variables and degree.
    """

    def __init__(
        self,
        source: Source,
        ambient: AmbientVariables,
        rng: np.random.Generator,
        run: Run,
        further: Sequence[Source] = (),
    ) -> None:
        self.source, self.sources, self.ambient = source, (source, *further), ambient
        self.interpolated: dict[tuple[tuple[int, ...], int], Any] = {}
        self._rng, self._tracker = rng, run
        self._samples: list[Sample] = []
        self._balls: dict[int, list[list[flint.acb]]] = {}

    @cached_property
    def roots(self) -> tuple[Root, ...]:
        """Members of the basis of sums of roots, 1 first, that span the coefficients' field."""
        return roots_of(f.terms.values() for f in self.ambient.system.polynomials)

    @property
    def unit(self) -> int | None:
        """The index of the imaginary unit, where coefficients may have it."""
        return self.ambient.system.n - 1 if self.ambient.system.imaginary else None

    def with_further(self, further: Sequence[Source]) -> Cloud:
        """A cloud of the same source and further ones, without points yet."""
        return Cloud(self.source, self.ambient, self._rng, self._tracker, further)

    def of_source(self, source: Source) -> Cloud:
        """A cloud of another source, in the same variables."""
        return Cloud(source, self.ambient, self._rng, self._tracker)

    @property
    def count(self) -> int:
        """How many points are there so far."""
        return len(self._samples)

    def samples(self, count: int) -> list[Sample]:
        """The first ``count`` points."""
        if not self.source.dimension:
            count = min(count, len(self.sources))
        places = range(len(self._samples), count)
        found: dict[int, Sample] = {}
        for k, source in enumerate(self.sources):
            own = [i for i in places if i % len(self.sources) == k]
            drawn = samples(source, len(own), self._rng, self._tracker)
            found |= dict(zip(own, drawn, strict=True))
        self._samples += [found[i] for i in places]
        return self._samples[:count]

    def points_for(self, columns: int) -> int:
        """How many points make so many real columns longer than they are many, on each component.

        Fewer where there are no more.
        """
        if not self.source.dimension:
            return len(self.sources)
        return ((columns + 1) // 2 + MORE_POINTS) * len(self.sources)

    def balls(self, count: int, digits: int) -> list[list[flint.acb]]:
        """The first ``count`` points in all variables, as balls of so many digits."""
        known = self._balls.setdefault(digits, [])
        for sample in self.samples(count)[len(known) :]:
            point = sample.balls(digits)
            images = BallPolynomials.of(self.ambient.images)
            known.append(list(images.values(point, bits_of(digits + SPARE)).entries()))
        return known[:count]

    def doubles(self, count: int, digits: int) -> np.ndarray:
        """The same rounded, shape ``(count, n)``."""
        return np.array([[complex(x) for x in p] for p in self.balls(count, digits)])

    def tangents(self, count: int) -> list[tuple[np.ndarray, np.ndarray]]:
        """The first ``count`` points in the system's variables, and bases of their tangent spaces.

        In doubles, shapes ``(n,)`` and ``(d, n)``.
        """
        found = []
        for sample in self.samples(count):
            n = len(sample.x)
            found.append((sample.x, (_sizes(sample)[:n, None] * _tangent(sample)).T))
        return found

    def image_dimension(self, coordinates: Sequence[int]) -> int:
        """Dimension of the closure of the component's image in some of the variables.

        The rank of its derivative in coordinates of comparable sizes.
        """
        if not self.source.dimension:
            return 0
        sample = self.samples(1)[0]
        tangent = _tangent(sample)
        derivatives = np.zeros((len(coordinates), len(sample.x)), dtype=complex)
        for row, i in enumerate(coordinates):
            image = self.ambient.images[i]
            for j in image.support:
                derivatives[row, j] = image.derivative(j)(list(sample.x), complex)
        derivatives *= _sizes(sample)[: len(sample.x)]
        return tangent.shape[1] - matrix_corank(
            _with_rows_of_norm_one(derivatives) @ tangent, NEARLY_SINGULAR
        )


def _sizes(sample: Sample) -> np.ndarray:
    """Sizes that make the coordinates comparable, shape ``(n + aux,)``."""
    return np.ldexp(1.0, sample.fibre.cut.powers)


def _with_rows_of_norm_one(matrix: np.ndarray) -> np.ndarray:
    norms = np.linalg.norm(matrix, axis=1, keepdims=True)
    return matrix / np.where(norms > 0, norms, 1)


def _tangent(sample: Sample) -> np.ndarray:
    """Orthonormal basis of the tangent space at a point, shape ``(n, d)``, in `_sizes`."""
    (z,), cut = sample.fibre.points, sample.fibre.cut
    jacobian = cut.evaluator.jacobian(z)
    rows = pad_rows(sample.fibre.rows, 1 + len(z))[:, 1:]
    matrix = _with_rows_of_norm_one(np.vstack([jacobian, rows]) * _sizes(sample))
    directions = np.linalg.inv(matrix)[: len(sample.x), len(jacobian) :]
    q, _ = np.linalg.qr(directions)
    return q


def monomial_values(
    points: Sequence[Sequence[flint.acb]], monomials: Sequence[Exponents], digits: int
) -> dict[Exponents, list[flint.acb]]:
    """Values of monomials at points of so many digits, each by one product from one below it."""
    values = {(0,) * len(points[0]): [flint.acb(1)] * len(points)}
    with in_bits(bits_of(digits + SPARE)):
        for e, below, i in _products(monomials, values):
            values[e] = [x * p[i] for x, p in zip(values[below], points, strict=True)]
    return values


def monomials_in_doubles(points: np.ndarray, monomials: Sequence[Exponents]) -> np.ndarray:
    """The same in doubles, from shape ``(points, variables)`` to ``(points, monomials)``."""
    values = {(0,) * points.shape[1]: np.ones(len(points), dtype=complex)}
    for e, below, i in _products(monomials, values):
        values[e] = values[below] * points[:, i]
    return np.array([values[e] for e in monomials]).T


def _products(
    monomials: Sequence[Exponents], known: Mapping[Exponents, Any]
) -> Iterator[tuple[Exponents, Exponents, int]]:
    """What is to be worked out for monomials: each, the one below it, and the variable between."""
    for e in monomials:
        path = []
        while e not in known:
            i = next(i for i, k in enumerate(e) if k)
            below = (*e[:i], e[i] - 1, *e[i + 1 :])
            path.append((e, below, i))
            e = below
        yield from reversed(path)


def real_rows(column: Sequence[flint.acb]) -> list[flint.arb]:
    """Real and imaginary parts: polynomials with real coefficients vanish at both or neither."""
    return [z.real for z in column] + [z.imag for z in column]
