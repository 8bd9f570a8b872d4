"""Multiplicity of a component in the scheme that equations define, at one of its generic points."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.factoring import Factors
from nag.algebra.local_ideal import local_ideal
from nag.algebra.polynomial import Polynomial

# Generators with more choices of a factor of each are not taken apart.
MOST_INTERSECTIONS = 64
# Least singular value of gradients of length one that are certainly independent.
INDEPENDENT = 1e-6
# Derivatives that are larger than this, beside their terms, certainly do not vanish.
NOT_ZERO = 1e-7


def generic_multiplicity(
    equations: Sequence[Factors],
    codimension: int,
    vanishes: Callable[[Polynomial], bool | None],
    independent: Callable[[Sequence[Polynomial]], bool],
    by_local_ring: Callable[[Sequence[Polynomial]], int],
) -> int:
    """Multiplicity of the component through a generic point of it; 0 if it was not found.

    It is exact where the equations' factors show it, see `LocalIdeal.multiplicity`. Where the
    generators are as many as the codimension, it is the sum of the multiplicities of all choices of
    one factor of each, times their exponents: that many elements whose quotient is of finite length
    are a regular sequence in any order, in a regular local ring, and for such the length is
    additive, ``0 -> R/(f) -> R/(f g) -> R/(g) -> 0`` being exact. Else it is the dimension of the
    local ring of all generators.

    Args:
        equations: those that are not zero, by their factors.
        codimension: of the component.
        vanishes: whether a polynomial vanishes on the component; None if that is not known.
        independent: whether gradients of polynomials certainly are, at a generic point.
        by_local_ring: computes the dimension of the local ring of some generators at a generic
            point, on a slice of complementary dimension; 0 if it was not found.
    """
    unknown = False

    def there(f: Polynomial) -> bool:
        nonlocal unknown
        answer = vanishes(f)
        unknown |= answer is None
        return answer is not False

    ideal = local_ideal(equations, there)
    if unknown:
        return 0
    exact = ideal.multiplicity(codimension, independent)
    if exact is not None:
        return exact
    if ideal.intersections(codimension) > MOST_INTERSECTIONS:
        return by_local_ring(ideal.generators)
    total = 0
    for factors in itertools.product(*ideal.monomials):
        chosen = [*ideal.coordinates, *(p for p, _ in factors)]
        part = local_ideal([((p, 1),) for p in chosen], there)
        single = part.multiplicity(codimension, independent) or by_local_ring(part.generators)
        if not single or unknown:
            return 0
        total += single * math.prod(k for _, k in factors)
    return total


@dataclass(frozen=True, eq=False)
class Gradients:
    """The derivatives of polynomials, to be evaluated at points.

    Attributes:
        rows: number of polynomials.
        derivatives: of each by each variable, one after the other.
        scales: largest coefficient of each derivative.
    """

    rows: int
    derivatives: Evaluator
    scales: np.ndarray

    @classmethod
    def of(cls, polynomials: Sequence[Polynomial], n: int) -> Gradients:
        derivatives = [f.derivative(i) for f in polynomials for i in range(n)]
        scales = [max((abs(float(c)) for c in f.terms.values()), default=1.0) for f in derivatives]
        return cls(len(polynomials), Evaluator.of(derivatives, n), np.array(scales))

    def rank(self, x: np.ndarray, error: float | np.ndarray) -> int:
        """How many gradients are certainly independent at a point.

        A derivative counts where it is no rounding error of its terms, nor one that an error of
        the coordinates explains. Rows and columns are brought to length one.

        Args:
            x: the point, shape ``(n,)``.
            error: how far, at most, coordinates may be from the exact ones; a number or one each.
        """
        point = np.asarray(x, dtype=complex)[None]
        values = self.derivatives.values(point)[0]
        sizes = self.derivatives.absolute(point)[0]
        doubt = self.derivatives.absolute(np.abs(point) + error)[0] - sizes
        gradients = np.where(np.abs(values) > NOT_ZERO * sizes + doubt, values, 0)
        gradients = (gradients * self.scales).reshape(self.rows, len(x))
        for axis in (1, 0, 1):
            # Squares of large derivatives leave the range of doubles.
            largest = np.abs(gradients).max(axis=axis, keepdims=True, initial=0.0)
            gradients = gradients / np.where(largest == 0, 1.0, largest)
            lengths = np.linalg.norm(gradients, axis=axis, keepdims=True)
            gradients = gradients / np.where(lengths == 0, 1.0, lengths)
        return int(np.sum(np.linalg.svd(gradients, compute_uv=False) > INDEPENDENT))


def independent_gradients(
    polynomials: Sequence[Polynomial], x: np.ndarray, error: float | np.ndarray
) -> bool:
    """Whether the gradients of polynomials are certainly independent at a point.

    See `Gradients.rank`.
    """
    return Gradients.of(polynomials, len(x)).rank(x, error) == len(polynomials)
