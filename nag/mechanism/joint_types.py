"""Types of joints: their freedoms, their constraints and the components of these.

Piipponen & Tuomela 2013 (PT13), table 1: coincidence of two points (C, three conditions),
orthogonality of two vectors (SO, one), orthogonality of a vector and the gap between two points
(O, one). The set that a joint's SO constraints describe in the unit Euler parameters (a, b) of its
bodies falls into prime components, one for each assembly mode; with r = conj(a) b each lies over
an eigenspace of Tuomela 2025 (T25), lemma 2.1.
"""

from __future__ import annotations

from dataclasses import dataclass
from types import MappingProxyType


@dataclass(frozen=True)
class JointType:
    """What a type of joint asks for, and what it leaves free.

    Attributes:
        freedoms: of one body against the other, in space.
        fields: what must be given of it: ``point``, ``axis``, ``second_axis``.
        optional: what may be given and changes nothing (a place where the joint is drawn).
        coincidences: number of C constraints, three conditions each.
        orthogonalities: number of SO constraints.
        gaps: number of O constraints.
        modes: number of prime components of the SO constraints over the rotations: as many ways to
            assemble two bodies whose local frames are given.
        components: number of prime components of the SO constraints and the norms in (a, b).
        dimension: of each of them, in the eight Euler parameters of both bodies.
        degree: of each of them.
    """

    freedoms: int
    fields: tuple[str, ...]
    optional: tuple[str, ...]
    coincidences: int
    orthogonalities: int
    gaps: int
    modes: int
    components: int
    dimension: int
    degree: int

    @property
    def conditions(self) -> int:
        """Number of scalar conditions, 6 minus the freedoms."""
        return 3 * self.coincidences + self.orthogonalities + self.gaps


# The degrees are those of {(a, a r)}: r in an eigenspace for a revolute joint, r constant for a
# rigid one, R(a) u orthogonal to R(b) v for a universal one.
JOINT_TYPES = MappingProxyType(
    {
        "revolute": JointType(1, ("point", "axis"), (), 1, 2, 0, 2, 2, 4, 8),
        "prismatic": JointType(1, ("axis",), ("point",), 0, 3, 2, 4, 8, 3, 2),
        "cylindrical": JointType(2, ("point", "axis"), (), 0, 2, 2, 2, 2, 4, 8),
        "universal": JointType(2, ("point", "axis", "second_axis"), (), 1, 1, 0, 1, 1, 5, 16),
        "spherical": JointType(3, ("point",), (), 1, 0, 0, 1, 1, 6, 4),
        "planar": JointType(3, ("axis",), ("point",), 0, 2, 1, 2, 2, 4, 8),
        "rigid": JointType(0, (), ("point", "axis"), 1, 3, 0, 4, 8, 3, 2),
    }
)

# Degrees of freedom that a joint leaves between its two bodies.
JOINT_FREEDOMS = MappingProxyType({name: t.freedoms for name, t in JOINT_TYPES.items()})

# Other names in use (PT13 has "translational").
SYNONYMS = MappingProxyType({"translational": "prismatic"})

HELICAL = (
    "a helical joint is not algebraic: its turn and its slide are an angle and a multiple of it; "
    "take a cylindrical joint, which has its configurations among others, or a revolute or "
    "prismatic one for the limits of a small and a large pitch"
)


def freedoms_in(joint_type: str, space: str) -> int:
    """Freedoms of a joint in a planar, spherical or spatial mechanism."""
    return min(JOINT_FREEDOMS[joint_type], 6 if space == "spatial" else 3)
