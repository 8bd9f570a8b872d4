"""Products of joints along loops and paths of a mechanism, and displacements from them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from nag.algebra.number import Number
from nag.mechanism.graph import Joint
from nag.mechanism.joint_factors import (
    Factor,
    factors_of,
    mode_constant,
    reversed_generators,
)
from nag.mechanism.loop_product import Element, combination
from nag.mechanism.quaternion import DualQuaternion, dual_multiply, translation


def joint_elements(joint: Joint, mode: int, forward: bool) -> tuple[Element, ...]:
    """The elements of a joint in the direction from its first body to its second.

    ``forward`` is whether its coordinates count in that direction.
    """
    return tuple(_joint_elements(joint, mode, forward))


def _joint_elements(joint: Joint, mode: int, forward: bool) -> Iterator[Element]:
    for factor in factors_of(joint):
        generators = factor.generators
        yield Element(factor, generators if forward else reversed_generators(generators))
    if mode:
        yield Element(None, (mode_constant(joint, mode),))


def opposite(elements: Sequence[Element]) -> list[Element]:
    """The elements of the opposite displacement."""
    return [Element(e.factor, reversed_generators(e.generators)) for e in reversed(elements)]


def displacement(
    elements: Sequence[Element],
    values: Mapping[Factor, Sequence[Any]],
    convert: Callable[[Number], Any],
) -> DualQuaternion:
    """The product of the elements, of any length."""
    result: DualQuaternion | None = None
    for element in elements:
        value = combination(element, values.__getitem__, convert)
        result = value if result is None else dual_multiply(result, value)
    if result is None:
        raise ValueError("a product of nothing")
    return result


def moved(motion: DualQuaternion, place: Sequence[Any]) -> tuple[Any, ...]:
    """Where a displacement takes a point."""
    zero = 0 * place[0]
    one = zero + 1
    # A translation by the place, then the displacement: the origin goes where the place goes.
    at = ((one, zero, zero, zero), (zero, *(x / 2 for x in place)))
    numerators, squared = translation(dual_multiply(motion, at))
    return tuple(x / squared for x in numerators)
