"""Counting formulas for the mobility of a mechanism."""

from __future__ import annotations

from nag.mechanism.axes import space_of
from nag.mechanism.graph import JOINT_FREEDOMS, Mechanism


def gruebler_kutzbach(mechanism: Mechanism) -> int:
    """Freedoms of all moving bodies minus the conditions of all joints.

    A body has 6 freedoms in space and 3 in planar and spherical mechanisms. The count is wrong
    for overconstrained mechanisms: it knows nothing of the geometry (T25, section 7).

    >>> import nag
    >>> nag.gruebler_kutzbach(nag.read_case("cases/bennett.toml").mechanism)  # and yet it moves
    -2
    """
    freedoms = 6 if space_of(mechanism.joints) == "spatial" else 3
    moving = len(mechanism.body_names) - 1
    return freedoms * moving - sum(freedoms - JOINT_FREEDOMS[j.type] for j in mechanism.joints)
