"""Irreducibility over the complex numbers of a zero set, proved by one plane section of it."""

from __future__ import annotations

from typing import Any

import numpy as np

from nag.algebra.factoring import is_absolutely_irreducible
from nag.algebra.groebner import Ideal, ideal
from nag.algebra.polynomial import Polynomial
from nag.algebra.rational_function import FunctionField


def certainly_irreducible(whole: Ideal, seed: int = 0) -> bool:
    """Whether the components of highest dimension are one, of multiplicity 1.

    The zero set is cut with random rational hyperplanes to a curve of the same degree, and that is
    projected to a plane, again to the same degree. Were there two components, there would be two
    images, of smaller degree each.

    Args:
        whole: of dimension 1 or more, in an order that compares degrees first.
        seed: of the random hyperplanes; an unlucky one gives False, none gives a wrong True.

    Raises:
        UnfinishedBasis: if a Groebner basis grows too large.
    """
    rng = np.random.default_rng(seed)
    names = whole.field.names
    field = FunctionField((*names, "s'", "t'"), "lex")
    *x, s, t = field.variables
    lifted = [_lift(f, field) for f in whole.basis]
    cuts = [_linear(rng, x) for _ in range(whole.dimension - 1)]
    images = [s - _linear(rng, x), t - _linear(rng, x)]
    curve = whole.enlarged(_restricted(f.numerator, whole.field) for f in cuts)
    if (curve.dimension, curve.degree) != (1, whole.degree):
        return False
    found = ideal(field, [*lifted, *cuts, *images])
    kept = [g for g in found.basis if not any(any(e[: len(names)]) for e in g.to_dict())]
    if len(kept) != 1:
        return False
    factors = kept[0].factor()[1]
    if len(factors) != 1 or int(factors[0][1]) != 1:
        return False
    terms = {tuple(map(int, e[-2:])): int(c) for e, c in factors[0][0].to_dict().items()}
    plane = Polynomial(2, terms)
    return plane.degree == whole.degree and is_absolutely_irreducible(plane, rng)


def _linear(rng: np.random.Generator, x: list[Any]) -> Any:
    constant, *slopes = (int(k) for k in rng.integers(-9, 10, len(x) + 1))
    return sum((k * y for k, y in zip(slopes, x, strict=True)), constant + 0 * x[0])


def _lift(f: Any, field: FunctionField) -> Any:
    return field.context.from_dict({(*map(int, e), 0, 0): c for e, c in f.to_dict().items()})


def _restricted(f: Any, field: FunctionField) -> Any:
    n = len(field.names)
    return field.context.from_dict({tuple(map(int, e))[:n]: c for e, c in f.to_dict().items()})
