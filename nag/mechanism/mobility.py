"""Counting formulas for the mobility of a mechanism."""

from __future__ import annotations

from nag.mechanism.axes import space_of
from nag.mechanism.graph import Mechanism
from nag.mechanism.joint_types import freedoms_in


def gruebler_kutzbach(mechanism: Mechanism) -> int:
    """Freedoms of all moving bodies minus the conditions of all joints.

    A body has 6 freedoms in space and 3 in planar and spherical mechanisms. The count is wrong
    for overconstrained mechanisms: it knows nothing of the geometry (T25, section 7).

    >>> import nag
    >>> nag.gruebler_kutzbach(nag.read_case("cases/bennett.toml").mechanism)  # and yet it moves
    -2
    """
    space = space_of(mechanism.joints)
    freedoms = 6 if space == "spatial" else 3
    moving = len(mechanism.body_names) - 1
    lost = sum(freedoms - freedoms_in(j.type, space) for j in mechanism.joints)
    return freedoms * moving - lost
