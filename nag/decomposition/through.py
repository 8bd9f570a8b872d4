"""The components through the points that a case names, and what that says of the decomposition."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from nag.algebra.exact_ranks import jacobian_rank
from nag.algebra.number import Number, is_zero
from nag.algebra.system import PolynomialSystem
from nag.numerics.local_dimension import LocalDimension, exact_numbers
from nag.numerics.second_order import count_unreal_directions
from nag.witness.frame import expand_orbits
from nag.witness.given_component import round_point
from nag.witness.witness import Decomposition


@dataclass(frozen=True)
class Through:
    """The components through a named point.

    Attributes:
        name: name of the point.
        solution: whether the point satisfies the equations, at least to rounding.
        components: indices of the components through it, among all that the orbits stand for.
        doubt: why the components are not known; empty if they are.
        unreal: how much less than the largest of their dimensions real sets through the point have
            at least, by terms of second order; 0 where these prove nothing.
    """

    name: str
    solution: bool
    components: tuple[int, ...] = ()
    doubt: str = ""
    unreal: int = 0


def through_points(
    decomposition: Decomposition,
    points: Sequence[tuple[str, tuple[Number | complex, ...]]],
    threads: int = 1,
) -> list[Through]:
    """Which components pass through named points of the system."""
    found, everything = [], expand_orbits(decomposition)
    for name, point in points:
        at, exact = round_point(point), exact_numbers(point)
        known: dict[str, Any] = {"exact": exact}
        if exact is None or not all(is_zero(value) for value in decomposition.system(exact)):
            from nag.witness.membership import rounded_error

            known = {"accuracy": rounded_error(decomposition.system, at)}
            if known["accuracy"] is None:
                found.append(Through(name, solution=False))
                continue
        if "exact" in known and exact and _is_on_the_only_one(everything, exact):
            found.append(_with_unreal(Through(name, True, (0,)), everything, exact))
            continue
        from nag.witness.membership import components_through

        try:
            indices = components_through(
                everything,
                at,
                **known,
                seed=decomposition.seed,
                threads=threads,
                settings=decomposition.settings,
            )
            doubt = "" if indices else "no component that was found passes through it"
            through = Through(name, True, tuple(indices), doubt)
            found.append(_with_unreal(through, everything, known.get("exact")))
        except ValueError as error:
            found.append(Through(name, True, doubt=str(error)))
    return found


def _with_unreal(
    through: Through, everything: Decomposition, exact: Sequence[Number] | None
) -> Through:
    """The same, with what terms of second order say at an exact zero."""
    equations = everything.system.polynomials
    if exact is None or not through.components:
        return through
    dimension = max(everything.components[i].dimension for i in through.components)
    corank = len(exact) - jacobian_rank(equations, exact)
    if not dimension or corank <= dimension:
        return through
    at = round_point(exact)
    unreal = count_unreal_directions(everything.system, at, corank, dimension)
    return replace(through, unreal=unreal)


def zero_at(
    system: PolynomialSystem, point: Sequence[Any], known: LocalDimension
) -> tuple[Number | complex, ...]:
    """A point, or the zero next to it if it is a rounded one, which a local dimension is that of.

    In doubles, as they are; where the zero is not known, the point itself.
    """
    numbers = exact_numbers(point)
    if numbers is not None and all(is_zero(value) for value in system(numbers)):
        return numbers
    at = known.point
    if not known.digits or (numbers is not None and at.imag.any()):
        at = round_point(point)
    if at.imag.any():
        return tuple(complex(x) for x in at)
    return tuple(Fraction(x) for x in at.real.tolist())


def _is_on_the_only_one(decomposition: Decomposition, point: Sequence[Number]) -> bool:
    """Whether a zero is on the only component, as there are no others by algebra alone."""
    return (
        decomposition.complete
        and decomposition.algebraic
        and len(decomposition.components) == 1
        and not any(is_zero(f(point)) for f in decomposition.system.nonzero)
    )


def note_doubts(decomposition: Decomposition, points: Sequence[Through]) -> Decomposition:
    """The decomposition, incomplete if it leaves doubt about one of ``points``."""
    doubts = tuple(f"{point.name}: {point.doubt}" for point in points if point.doubt)
    if not doubts:
        return decomposition
    return replace(decomposition, complete=False, notes=(*decomposition.notes, *doubts))
