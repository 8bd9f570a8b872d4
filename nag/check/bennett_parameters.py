"""T25's parameters of a Bennett mechanism, from its points and axes: lemmas 5.1 and 5.3 solved."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

from nag.algebra.number import square_root
from nag.mechanism.axes import difference, dot
from nag.mechanism.graph import Mechanism

Parameters = tuple[Fraction, Fraction, Fraction]


def bennett_parameters(mechanism: Mechanism) -> Iterator[Parameters]:
    """Rational m_0, m_1, m_2 that a loop placed as in lemma 5.1 can only have, for r and for -r.

    Whether it is the mechanism of these is left to be seen: not all it holds is looked at.
    """
    if len(mechanism.joints) != 4 or {joint.type for joint in mechanism.joints} != {"revolute"}:
        return
    first, second, third, fourth = (joint.point for joint in mechanism.joints)
    axis = mechanism.joints[1].axis
    if not _rational(*first, *second, *third, *fourth, *axis) or any(axis[:1]):
        return
    length = square_root(dot(axis, axis))
    x, _, z = difference(third, second)
    r = square_root(dot(difference(third, second), difference(third, second)))
    if not _rational(length, r) or not (r and z and axis[1]):
        return
    # (m_0^2 - 1)/(m_0^2 + 1) and -2 m_0/(m_0^2 + 1) are the axis, and likewise for the others.
    m0 = -axis[1] / (length - axis[2])
    for radius in (r, -r):
        if x == radius or radius + fourth[0] == 0:
            continue
        m1 = z * (m0**2 + 1) / (2 * m0 * (radius - x))
        m2 = m1 * fourth[1] / (radius + fourth[0])
        yield m0, m1, m2


def _rational(*numbers: Any) -> bool:
    return all(isinstance(x, Fraction) for x in numbers)
