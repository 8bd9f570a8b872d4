"""Equations that follow from others: Groebner bases, and generators that are enough.

An element of a basis vanishes wherever the equations do, and may have factors where these are
irreducible. Systems of more equations than they need often have shorter generators.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import lcm
from typing import Any

from nag.algebra.groebner import Ideal, UnfinishedBasis, ideal
from nag.algebra.rational_function import FunctionField

# Of more equations no basis is asked for.
MOST_EQUATIONS = 12
# Polynomials of a basis, terms of one of them, bits of a coefficient; beyond, it is given up.
BOUNDS = (60, 200, 1000)


@dataclass(frozen=True, eq=False)
class Consequences:
    """What follows from some equations, FLINT's ``fmpq_mpoly`` of one ring.

    Attributes:
        basis: polynomials of a Groebner basis, lowest degrees first.
        codimension: of the zero set.
    """

    basis: tuple[Any, ...]
    codimension: int


def consequences(equations: Sequence[Any]) -> Consequences | None:
    """What follows from equations; None where that is out of reach."""
    found = _ideal(equations) if 1 < len(equations) <= MOST_EQUATIONS else None
    if found is None:
        return None
    ring = equations[0].context()
    elements = [ring.from_dict(g.to_dict()) for g in sorted(found.basis, key=_size)]
    return Consequences(tuple(elements), ring.nvars() - found.dimension)


def generators(candidates: Sequence[Any]) -> list[Any]:
    """Those of the candidates that the ones before, of lower degrees, do not generate."""
    chosen: list[Any] = []
    known: Ideal | None = None
    for f in sorted(candidates, key=_size):
        if known is None or not known.contains([_clear_denominators(f, known.field)]):
            chosen.append(f)
            known = _ideal(chosen)
    return chosen


def _ideal(equations: Sequence[Any]) -> Ideal | None:
    names = [f"x{i}" for i in range(equations[0].context().nvars())]
    field = FunctionField(names, "degrevlex")
    try:
        return ideal(field, [_clear_denominators(f, field) for f in equations], BOUNDS)
    except UnfinishedBasis:
        return None


def _clear_denominators(f: Any, field: FunctionField) -> Any:
    terms = f.to_dict()
    common = lcm(*(int(c.q) for c in terms.values()))
    return field.context.from_dict({e: int(c.p) * (common // int(c.q)) for e, c in terms.items()})


def _size(f: Any) -> tuple[int, int]:
    return int(f.total_degree()), len(f)
