"""Complex coefficients: the imaginary unit as one more variable, of which one value counts.

A polynomial over Q(i) is one over Q in its variables and ``I``, modulo ``I^2 + 1``. The zeros of a
system with that equation are those with ``I = i`` and those of the conjugate system with
``I = -i``: two disjoint sets, and every irreducible component lies in one of them. So all that is
exact stays rational; whoever hands out zeros leaves the second set out.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from nag.algebra.number import Number
from nag.algebra.polynomial import Exponents, Polynomial
from nag.algebra.system import PolynomialSystem

if TYPE_CHECKING:
    import numpy as np

# The name of the unit, of the first that is no other name.
NAMES = ("I", "imaginary_unit", "imaginary_unit_")


def name_unit(taken: Iterable[str]) -> str:
    """A name for the imaginary unit besides those that are taken."""
    taken = set(taken)
    return next(name for name in NAMES if name not in taken)


def adjoin_unit(
    variables: Sequence[str],
    polynomials: Iterable[Polynomial],
    nonzero: Iterable[Polynomial] = (),
    groups: Iterable[Sequence[int]] = (),
) -> PolynomialSystem:
    """The system of polynomials whose last variable is the imaginary unit.

    Args:
        variables: names, that of the unit last.
        groups: of the other variables, or of all.
    """
    n = len(variables)
    groups = [tuple(group) for group in groups]
    if groups and not any(n - 1 in group for group in groups):
        groups.append((n - 1,))
    unit = Polynomial.variable(n, n - 1)
    return PolynomialSystem(
        tuple(variables),
        (*(reduce_unit(f) for f in polynomials), unit**2 + 1),
        tuple(reduce_unit(f) for f in nonzero),
        tuple(groups),
        imaginary=True,
    )


def reduce_unit(f: Polynomial) -> Polynomial:
    """The remainder modulo ``I^2 + 1``, the unit being the last variable."""
    terms: dict[Exponents, Number] = {}
    for e, c in f.terms.items():
        key = (*e[:-1], e[-1] % 2)
        c = -c if e[-1] % 4 > 1 else c
        terms[key] = terms[key] + c if key in terms else c
    return Polynomial(f.n, terms)


def as_real(system: PolynomialSystem) -> PolynomialSystem:
    """The same equations, both values of the unit among their zeros."""
    return replace(system, imaginary=False) if system.imaginary else system


def has_unit(points: np.ndarray) -> np.ndarray:
    """Of points, shape ``(k, n)``, whether the last coordinate is i and not -i, shape ``(k,)``."""
    return points[:, -1].imag > 0
