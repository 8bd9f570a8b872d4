"""Poses that a leg comes as near to as one likes, and does not reach: its outer axes differ there
by an isotropic vector.

The image of a leg, a set that products fill, is not closed. Let a leg turn about three directions
one after the other, u1, u2 and u3 (parallel axes in a row turn about one), and a pose take u3 to
s u1 + n, where n is not zero, isotropic and normal to u1, and |s| |u1| = |u3|. A turn about u2 has
to take u3 to a vector v with the same component along u1, which a turn about u1 then takes to
s u1 + n. Where u2 makes the same angle with u1 as with u3 (s > 0), or angles that add up to half a
turn (s < 0), only v = s u1 has this component: with the angle t of the turn it is the condition
cos^2 + sin^2 cos t = 1 of t. That vector all turns about u1 leave where it is. So no joint
coordinates, real or complex, give the pose.

Such poses make components of the legs' equations: all orientations that take u3 there, of complex
dimension two, satisfy the equation of a universal, a prismatic and a universal joint if the leg's
ends differ by a vector normal to n, and that is one and the same condition for legs in similar
positions.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from nag.algebra.number import is_zero, sign
from nag.mechanism.axes import Vector, cross, dot, vanishes
from nag.mechanism.loop_product import Element
from nag.mechanism.quaternion import rotate
from nag.numerics.double_ranks import NEARLY_SINGULAR
from nag.numerics.zero_values import NONZERO


def is_isotropic_limit(elements: Sequence[Element], pose: np.ndarray) -> bool:
    """Whether a leg's outer axes keep it from a pose, as above.

    Args:
        elements: the factors of a serial chain.
        pose: Study coordinates of a general pose of a component, shape ``(8,)``.
    """
    axes = turning_directions(elements)
    if axes is None or len(axes) != 3:
        return False
    first, middle, last = axes
    there = np.array([complex(x) for x in rotate(list(pose[:4]), _doubles(last))])
    there = there / np.sum(pose[:4] ** 2)
    u1, size = _doubles(first), float(dot(last, last)) ** 0.5
    along = complex(u1 @ there) / (np.linalg.norm(u1) * size)
    if abs(along**2 - 1) > NONZERO:
        return False
    side = 1 if along.real > 0 else -1
    across = there - side * size * u1 / np.linalg.norm(u1)
    if np.linalg.norm(across) < NEARLY_SINGULAR * np.linalg.norm(there):
        return False
    angles = dot(first, middle), dot(middle, last)
    lengths = dot(first, first), dot(last, last)
    equal = is_zero(angles[0] ** 2 * lengths[1] - angles[1] ** 2 * lengths[0])
    return equal and sign(angles[0]) * side == sign(angles[1])


def turning_directions(elements: Sequence[Element]) -> list[Vector] | None:
    """The directions that a chain turns about, one after the other; None if it has a ball.

    Those in a row that are parallel are one.
    """
    found: list[Vector] = []
    for element in elements:
        turns = [g[0][1:] for g in element.generators if not vanishes(g[0][1:])]
        if element.factor is None and turns:
            return None
        if len(turns) > 1:
            return None
        if turns and not (found and vanishes(cross(found[-1], turns[0]))):
            found.append(turns[0])
    return found


def _doubles(vector: Sequence[Any]) -> np.ndarray:
    return np.array([float(x) for x in vector])
