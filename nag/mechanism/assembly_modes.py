"""Assembly modes: the prime components of a joint's orthogonality constraints.

By Tuomela 2025 (T25), lemma 2.1, the relative orientation r = conj(a) b of two bodies lies over an
eigenspace of L. In global coordinates of the reference configuration r is a free turn of the joint
after a constant rotation m: m = 1 in the mode of the reference configuration; a half-turn across
the axis, which reverses the axis of the second body, in the other mode of a revolute, cylindrical
or planar joint; one of the three half-turns about an orthogonal frame in the other modes of a
prismatic joint.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import product
from math import prod

from nag.algebra.number import Number
from nag.mechanism.axes import across, direction
from nag.mechanism.graph import Joint

# Every joint that is not in its reference mode, with the index of its mode.
Modes = tuple[tuple[str, int], ...]
REFERENCE: Modes = ()
UNIT = (Fraction(1), Fraction(0), Fraction(0), Fraction(0))


def mode_rotation(joint: Joint, mode: int) -> tuple[Number, ...]:
    """The constant rotation m of a mode, a quaternion of any length, in global coordinates."""
    if mode == 0:
        return UNIT
    axis = direction(joint.axis)
    e2, e3 = across(axis)
    zero = Fraction(0)
    if joint.of_type.orthogonalities == 3:
        return (zero, *((axis, e2, e3)[mode - 1]))
    return (zero, *e2)


def all_modes(joints: Sequence[Joint]) -> Iterator[Modes]:
    """Every combination of the joints' modes, that of the reference configuration first."""
    for combination in product(*(range(j.of_type.modes) for j in joints)):
        yield tuple((j.name, m) for j, m in zip(joints, combination, strict=True) if m)


def number_of_modes(joints: Sequence[Joint]) -> int:
    """How many combinations there are."""
    return prod(j.of_type.modes for j in joints)
