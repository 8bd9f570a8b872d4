"""Configurations: where every body of a mechanism is."""

from __future__ import annotations

import cmath
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import flint
import numpy as np

from nag.algebra.fixed_mapping import FixedMapping, fixed_mapping
from nag.algebra.number import Number, square_root, to_mpf
from nag.mechanism.loops import LoopStructure
from nag.mechanism.quaternion import conjugate, multiply, rotate
from nag.numerics.digits import to_ball
from nag.text.table import one_line


@dataclass(frozen=True)
class Configuration:
    """Orientation and position of every body, the ground included.

    Attributes:
        euler: Euler parameters of each body's local frame, norm 1, as tuples of 4 numbers.
        position: the place of each body's reference point, as tuples of 3 numbers. A body's
            reference point is the one that is at the global origin in the reference configuration.

    Entries are exact where the lifted point was exact, else complex, balls or `mpmath` numbers; of
    many real points that are lifted at once, coordinate by coordinate, arrays or one number for all
    of them.
    """

    euler: Mapping[str, tuple[Any, ...]]
    position: Mapping[str, tuple[Any, ...]]

    def __post_init__(self) -> None:
        object.__setattr__(self, "euler", fixed_mapping(self.euler))
        object.__setattr__(self, "position", fixed_mapping(self.position))

    __repr__ = one_line

    def __str__(self) -> str:
        from nag.mechanism.shown import configuration_text

        return configuration_text(self)

    def _repr_html_(self) -> str:
        from nag.mechanism.shown import configuration_html

        return configuration_html(self)

    def __reduce__(self) -> tuple[Any, ...]:
        return Configuration, (dict(self.euler), dict(self.position))


@dataclass(frozen=True)
class Arithmetic:
    """How exact numbers enter the arithmetic of a point, and how square roots are taken there."""

    convert: Callable[[Number], Any]
    sqrt: Callable[[Any], Any]


def arithmetic_of(point: Sequence[Any]) -> Arithmetic:
    """The arithmetic in which a point is lifted: exact, balls, `mpmath` or complex doubles.

    Coordinates that are arrays, of many real points at once, are real doubles.
    """
    if any(isinstance(x, np.ndarray) for x in point):
        return Arithmetic(float, np.sqrt)
    if any(isinstance(x, flint.acb) for x in point):
        return Arithmetic(to_ball, flint.acb.sqrt)
    if all(isinstance(x, int | Number) for x in point):
        return Arithmetic(lambda c: c, square_root)
    if any(_is_multiprecision(x) for x in point):
        import mpmath

        digits = mpmath.mp.dps
        return Arithmetic(lambda c: to_mpf(c, digits), mpmath.sqrt)
    return Arithmetic(lambda c: complex(float(c)), cmath.sqrt)


def _is_multiprecision(x: Any) -> bool:
    """Whether it is one of `mpmath`'s numbers; there are none before that is loaded."""
    mpmath = sys.modules.get("mpmath")
    return mpmath is not None and isinstance(x, mpmath.mpf | mpmath.mpc)


def as_entries(point: Sequence[Any]) -> tuple[Any, ...]:
    """``point`` with integers as fractions and NumPy's numbers as complex ones."""
    entries = []
    for x in point:
        if isinstance(x, int):
            x = Fraction(x)
        elif not isinstance(x, Number | flint.acb | np.ndarray) and not _is_multiprecision(x):
            x = complex(x)
        entries.append(x)
    return tuple(entries)


def configuration(
    structure: LoopStructure,
    euler: Mapping[str, Sequence[Any]],
    arithmetic: Arithmetic,
    slides: Mapping[str, Sequence[Any]] = FixedMapping({}),
) -> Configuration:
    """Place all bodies, given the orientations of those with loops.

    Positions follow from the joints along a spanning tree (PT13, eq. 4). Bodies of trees that were
    cut off keep their place relative to their neighbours, and so do those that are tied rigidly.

    Args:
        slides: for joints that slide, by name, how far the joint's point on the second body is from
            that on the first: a vector in global coordinates of the reference configuration, which
            the first body carries.
    """
    mechanism, convert = structure.mechanism, arithmetic.convert
    reference = {
        b: tuple(convert(x) for x in mechanism.orientation(b)) for b in mechanism.body_names
    }
    placed = {structure.base: reference[structure.base]}
    zero = convert(Fraction(0))
    position: dict[str, tuple[Any, ...]] = {structure.base: (zero, zero, zero)}

    def carry(body: str, vector: Sequence[Any]) -> Sequence[Any]:
        return rotate(placed[body], rotate(conjugate(reference[body]), vector))

    for parent, child, joint in structure.spanning_tree():
        if child in euler:
            placed[child] = tuple(euler[child])
        else:
            placed[child] = _carry_orientation(placed[parent], reference[parent], reference[child])
        point = tuple(convert(x) for x in joint.point)
        at = [carry(b, point) for b in (parent, child)]
        gap = carry(joint.bodies[0], slides.get(joint.name, (zero, zero, zero)))
        sign = 1 if joint.bodies[0] == parent else -1
        position[child] = tuple(
            r + x - y + sign * g
            for r, x, y, g in zip(position[parent], at[0], at[1], gap, strict=True)
        )
    return _with_tied(structure, placed, position, arithmetic)


def _with_tied(
    structure: LoopStructure,
    placed: Mapping[str, tuple[Any, ...]],
    position: Mapping[str, tuple[Any, ...]],
    arithmetic: Arithmetic,
) -> Configuration:
    original, leader = structure.groups.original, structure.groups.leader
    euler = {}
    for body in original.body_names:
        if leader[body] == body:
            euler[body] = placed[body]
        else:
            frames = [
                tuple(arithmetic.convert(x) for x in original.orientation(b))
                for b in (leader[body], body)
            ]
            euler[body] = _carry_orientation(placed[leader[body]], *frames)
    return Configuration(euler, {b: position[leader[b]] for b in original.body_names})


def _carry_orientation(
    parent: tuple[Any, ...], parent_reference: tuple[Any, ...], reference: tuple[Any, ...]
) -> tuple[Any, ...]:
    return multiply(multiply(parent, conjugate(parent_reference)), reference)
