"""Real values of a linear form over which points of a curve come together, by two polynomials.

Over a value at which sheets meet, be it at a branch point, a node, a cusp or an isolated real
point, the product of the squared differences of a second form over all pairs of points vanishes; so
does the product of ``det [J; form]`` over all points, with J of the equations that cut the curve,
which also vanishes where the curve meets other sets. Both are polynomials in the value. Zeros of
the first at which points agree in the second form only, and others that mean nothing, go out when
the fibre is looked at.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import flint
import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.numerics.digits import bits_of, in_bits, middle
from nag.numerics.doubles import SLACK
from nag.real.fibre_table import SPARE, VANISHING, CircleOfFibres, roots_of

# Share of the digits to which leading coefficients of products over fibres do not vanish, as many
# as those on to `VANISHING` leave; between the two more digits are taken.
SOMETHING = 1 - VANISHING
# Imaginary parts, beside one and the zero's size, of zeros that are not real.
ASIDE = 1e-2
# Decides: Size of a cluster of zeros beside the distance of the next.
ALONE = 1e-2
# Decides, measured: Distance of special values, in radii of the values, that are one: what two
# methods find lay within 1e-130; several points of the curve may be critical at one. Others lay
# beyond 1e-6.
ONE_VALUE = 1e-12
# Part of the digits beyond which coefficients are changed.
PARTED = 0.75


class UnclearDigitsError(ArithmeticError):
    """More digits are needed, for the reason given."""


@dataclass(frozen=True)
class RealZero:
    """A real zero of a polynomial, in radii of the circle, with its multiplicity."""

    value: flint.arb
    multiplicity: int


def discriminant_degree(degree: int, real: bool) -> int:
    """Largest degree of the product of differences of ``degree`` sheets."""
    return degree * (degree - 1) if real else degree * degree


def determinant_degree(
    equations: Sequence[Polynomial], groups: Sequence[Sequence[int]], multidegree: Sequence[int]
) -> int:
    """Largest degree of the product of determinants over the points of a curve.

    Args:
        equations: one fewer than variables.
        groups: of the variables; without them the multidegree is the degree.
    """
    degree = sum(multidegree) * sum(max(f.degree - 1, 0) for f in equations)
    if not groups:
        return degree
    tops = [
        sum(max((sum(e[i] for i in group) for e in f.terms), default=0) for f in equations)
        for group in groups
    ]
    return min(degree, sum(m * top for m, top in zip(multidegree, tops, strict=True)))


def discriminant_values(circle: CircleOfFibres, rng: np.random.Generator) -> list[flint.acb]:
    """Products of squared differences of a random form, for each fibre of a circle.

    Of a curve that is not its own conjugate, differences of its points and of the conjugate's.
    """
    n = len(circle.form)
    weights = [flint.acb(int(c)) / 64 for c in rng.integers(32, 96, n) * rng.choice([-1, 1], n)]
    values = []
    with in_bits(bits_of(circle.digits + SPARE)):
        for k in range(circle.count):
            forms = [_form(weights, x) for x in circle.points[k]]
            product = flint.acb(1)
            if circle.real:
                for i, a in enumerate(forms):
                    for b in forms[:i]:
                        product = middle(product * (a - b))
                product = middle(product * product)
            else:
                others = [_form(weights, x) for x in circle.conjugates[k]]
                for a in forms:
                    for b in others:
                        product = middle(product * (a - b))
            values.append(product)
    return values


def _form(weights: Sequence[flint.acb], x: Sequence[flint.acb]) -> flint.acb:
    return middle(sum((a * b for a, b in zip(weights, x, strict=True)), flint.acb(0)))


def real_zeros(circle: CircleOfFibres, values: Sequence[flint.acb], top: int) -> list[RealZero]:
    """The real zeros of the polynomial of degree ``top`` at most with these values on the circle.

    Raises:
        UnclearDigitsError: if they are not certain.
    """
    digits = circle.digits
    with in_bits(bits_of(digits + SPARE)):
        (found,) = circle.coefficients([[v] for v in values], circle.count - 1)
        size = max(abs(c).mid() for c in found)
        if not size > 0:
            raise UnclearDigitsError("a product of differences vanishes")
        largest = max(found, key=lambda c: float((abs(c) / size).mid()))
        # Real but for a constant factor.
        if abs(largest.imag) > abs(largest.real):
            found = [middle(c * flint.acb(0, -1)) for c in found]
        found = [middle(c / size) for c in found]
        nothing, something = (flint.arb(10) ** round(-p * digits) for p in (VANISHING, SOMETHING))
        if any(abs(c) > nothing for c in found[top + 1 :]) or any(
            abs(c.imag) > nothing for c in found
        ):
            raise UnclearDigitsError("products over fibres are no real polynomial of their degree")
        noise = max([abs(c).mid() for c in found[top + 1 :]] + [abs(c.imag).mid() for c in found])
        noise = noise + flint.arb(10) ** (-digits)
        while abs(found[-1]) < nothing:
            found.pop()
        if abs(found[-1]) < something:
            raise UnclearDigitsError("the degree of a product over fibres is not clear")
        if len(found) == 1:
            return []
        # Multiple zeros that are parted a little are found in fewer steps than such as are not.
        shift = flint.arb(10) ** round(-PARTED * digits)
        noise = noise + shift
        parted = [c.real * (1 + shift * (k * k % 7 - 3) / 4) for k, c in enumerate(found)]
        polynomial = flint.acb_poly([middle(flint.acb(c)) for c in parted])
        roots = [middle(z) for z in roots_of(polynomial, digits)]
        return _real_clusters(polynomial, roots, noise)


def _real_clusters(
    polynomial: flint.acb_poly, roots: list[flint.acb], noise: flint.arb
) -> list[RealZero]:
    """Real zeros, each the middle of the smallest cluster that no rounding can have scattered.

    The conjugate of a cluster is one as well: it is real if its conjugate is nearest to itself.
    """
    rough = np.array([complex(z) for z in roots])
    sizes = np.maximum(1.0, np.abs(rough))
    left = set(np.flatnonzero(np.abs(rough.imag) < ASIDE * sizes).tolist())
    result = []
    while left:
        members, centre = _certain_cluster(polynomial, roots, min(left), noise)
        left -= set(members)
        mirrored = centre.conjugate()
        nearest = min(range(len(roots)), key=lambda i: float(abs(roots[i] - mirrored).mid()))
        if nearest in members:
            result.append(RealZero(centre.real.mid(), len(members)))
    return sorted(result, key=lambda z: float(z.value))


def _certain_cluster(
    polynomial: flint.acb_poly, roots: list[flint.acb], first: int, noise: flint.arb
) -> tuple[list[int], flint.acb]:
    """The zeros round one that stay in a disc whatever noise does, and its middle.

    On the circle round them values exceed what noise changes them by (Rouche): in curves measured
    by 1e30 and more, or not at all.
    """
    far = sorted((float(abs(z - roots[first]).mid()), i) for i, z in enumerate(roots))
    count = len(roots)
    for k in range(1, count + 1):
        members = [i for _, i in far[:k]]
        centre = middle(sum((roots[i] for i in members), flint.acb(0)) / k)
        spread = max(float(abs(roots[i] - centre).mid()) for i in members)
        rest = [float(abs(roots[i] - centre).mid()) for _, i in far[k:]]
        gap = min([1.0, *rest])
        if spread > ALONE * gap:
            continue
        radius = (max(spread, ALONE**2 * gap) * gap) ** 0.5
        turns = (flint.acb(0, j).exp() for j in range(7))
        least = min(abs(polynomial(centre + radius * turn)).mid() for turn in turns)
        reach = flint.arb(max(1.0, abs(complex(centre)) + radius)) ** count
        if least > SLACK * noise * reach * (1 + count):
            return members, centre
    raise UnclearDigitsError("critical values are not certain")
