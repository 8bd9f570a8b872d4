"""Types of joints: each is one record, of which the equations of all formulations are made.

Piipponen & Tuomela 2013 (PT13), table 1: coincidence of two points (C, three conditions),
orthogonality of two vectors (SO, one), orthogonality of a vector and the gap between two points
(O, one). The set that a joint's SO constraints describe in the unit Euler parameters (a, b) of its
bodies falls into prime components, one for each assembly mode; with r = conj(a) b each lies over
an eigenspace of Tuomela 2025 (T25), lemma 2.1.

A new type is a new entry of `JOINT_TYPES`. Formulation E and the unreduced model read its numbers
of constraints, formulations H and S its factors, case files and graphs what must be given of it.
An entry is checked when it is made; what it cannot see by itself: directions of gaps, and of the
first factor, are those of ``axis`` in the first body; planar mechanisms have only joints that are
one turn or one slide; formulation H eliminates from each loop one factor of three freedoms, or two
neighbouring ones of one each.

A factor of a kind that is not there yet is a new entry of `FACTOR_KINDS`, and has its generators in
`joint_factors`. A vector that no type has had is a field of `nag.mechanism.graph.Joint` and one of
`VECTORS`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal

from nag.errors import NagError

# What may be given of a joint.
VECTORS = ("point", "axis", "second_axis")


@dataclass(frozen=True)
class FactorKind:
    """A kind of factor of a displacement (`nag.mechanism.joint_factors`).

    Attributes:
        freedoms: of the displacement.
        turning: number of coordinates that turn, the first ones, each with a chart constant of its
            own; without any the factor has norm 1.
        letters: first letters of its variables' names, in their order; of a kind with one variable,
            those of the first factor of the kind in a joint, of the second one, ...
    """

    freedoms: int
    turning: int
    letters: tuple[str, ...]


FACTOR_KINDS = MappingProxyType(
    {
        "turn": FactorKind(1, 1, ("x", "y")),
        "slide": FactorKind(1, 0, ("d", "e")),
        "ball": FactorKind(3, 3, ("a", "b", "c")),
        "plane": FactorKind(3, 1, ("x", "d", "e")),
    }
)
# Study coordinates of a body in the air, seven on a quadric.
FREE_KIND = FactorKind(6, 3, ("e1", "e2", "e3", "g0", "g1", "g2", "g3"))


@dataclass(frozen=True)
class PrimeComponents:
    """What SO constraints fall into.

    Attributes:
        modes: number of prime components over the rotations: as many ways to assemble two bodies
            whose local frames are given.
        count: number of prime components of the constraints and the norms in (a, b).
        dimension: of each of them, in the eight Euler parameters of both bodies.
        degree: of each of them.
    """

    modes: int
    count: int
    dimension: int
    degree: int


# By the number of SO constraints: none; R(a) u orthogonal to R(b) v; r in an eigenspace; r
# constant. The degrees are those of {(a, a r)}.
PRIME_COMPONENTS = (
    PrimeComponents(1, 1, 6, 4),
    PrimeComponents(1, 1, 5, 16),
    PrimeComponents(2, 2, 4, 8),
    PrimeComponents(4, 8, 3, 2),
)


@dataclass(frozen=True)
class JointType:
    """What a type of joint asks for, and what it leaves free.

    Attributes:
        fields: what must be given of it, of `VECTORS`.
        optional: what may be given and changes nothing (a place where the joint is drawn).
        coincidences: number of C constraints, three conditions each, at its point.
        orthogonalities: number of SO constraints: one between its two axes; two that keep its axis;
            three that keep all directions.
        gaps: number of O constraints: one along its axis, or two across it.
        factors: kinds of the factors whose product is its displacement, in order: keys of
            `FACTOR_KINDS`. The first of a kind is about or along ``axis``, a second one about or
            along ``second_axis``.
        letter: by which chains of joints are abbreviated, as RPS.

    Raises:
        NagError: if these do not fit each other.
    """

    fields: tuple[str, ...]
    optional: tuple[str, ...]
    coincidences: int
    orthogonalities: int
    gaps: int
    factors: tuple[str, ...]
    letter: str = "?"

    def __post_init__(self) -> None:
        fault = self._find_fault()
        if fault is not None:
            raise NagError(f"a joint type of factors {self.factors}: {fault}")

    def _find_fault(self) -> str | None:
        """What of it does not fit the rest."""
        for words, known in (
            ((*self.fields, *self.optional), VECTORS),
            (self.factors, tuple(FACTOR_KINDS)),
        ):
            for word in words:
                if word not in known:
                    return f"{word!r} is unknown; there are {', '.join(known)}"
        for name, most in (("orthogonalities", len(PRIME_COMPONENTS) - 1), ("gaps", 2)):
            if not 0 <= getattr(self, name) <= most:
                return f"{getattr(self, name)} {name}; at most {most}"
        if self.conditions + self.freedoms != 6:
            return f"{self.conditions} conditions and {self.freedoms} freedoms; 6 in all"
        two_axes = self.orthogonalities == 1 or len(set(self.factors)) < len(self.factors)
        if two_axes != ("second_axis" in self.fields):
            return "a second axis has who has one orthogonality, or two factors of a kind"
        return None

    @property
    def conditions(self) -> int:
        """Number of scalar conditions, 6 minus the freedoms."""
        return 3 * self.coincidences + self.orthogonalities + self.gaps

    @property
    def freedoms(self) -> int:
        """Freedoms of one body against the other, in space."""
        return sum(FACTOR_KINDS[kind].freedoms for kind in self.factors)

    @property
    def components(self) -> PrimeComponents:
        """Prime components of its SO constraints."""
        return PRIME_COMPONENTS[self.orthogonalities]

    @property
    def modes(self) -> int:
        """Number of its assembly modes."""
        return self.components.modes

    @property
    def is_rigid(self) -> bool:
        """Whether it leaves nothing free."""
        return not self.factors

    @property
    def turns_only(self) -> bool:
        """Whether it is one turn about its axis."""
        return self.factors == ("turn",)

    @property
    def slides_only(self) -> bool:
        """Whether it is one slide along its axis."""
        return self.factors == ("slide",)

    @property
    def turns_freely(self) -> bool:
        """Whether it is any turn about its point."""
        return self.factors == ("ball",)

    @property
    def turns_about_point(self) -> bool:
        """Whether it moves and its point stays where it is."""
        return self.coincidences > 0 and not self.is_rigid

    @property
    def keeps_axis(self) -> bool:
        """Whether its axis has one and the same direction in both bodies."""
        return self.orthogonalities >= 2

    @property
    def keeps_line(self) -> bool:
        """Whether its axis, as a line, is one and the same of both bodies."""
        return self.orthogonalities == 2 and "point" in self.fields


LINE = ("point", "axis")
JOINT_TYPES = MappingProxyType(
    {
        "revolute": JointType(LINE, (), 1, 2, 0, ("turn",), "R"),
        "prismatic": JointType(("axis",), ("point",), 0, 3, 2, ("slide",), "P"),
        "cylindrical": JointType(LINE, (), 0, 2, 2, ("turn", "slide"), "C"),
        "universal": JointType((*LINE, "second_axis"), (), 1, 1, 0, ("turn", "turn"), "U"),
        "spherical": JointType(("point",), (), 1, 0, 0, ("ball",), "S"),
        "planar": JointType(("axis",), ("point",), 0, 2, 1, ("plane",), "E"),
        "rigid": JointType((), LINE, 1, 3, 0, ()),
    }
)

# Of the joints of such factors the coordinates that have values: their names, and what they are.
COORDINATES: Mapping[tuple[str, ...], tuple[tuple[str, Literal["angle", "slide"]], ...]] = (
    MappingProxyType(
        {
            (): (),
            ("turn",): (("angle", "angle"),),
            ("slide",): (("slide", "slide"),),
            ("turn", "slide"): (("angle", "angle"), ("slide", "slide")),
            ("turn", "turn"): (("first", "angle"), ("second", "angle")),
            ("ball",): (),
            ("plane",): (("angle", "angle"), ("x", "slide"), ("y", "slide")),
        }
    )
)

# Other names in use (PT13 has "translational").
SYNONYMS = MappingProxyType(
    {
        "translational": "prismatic",
        "slider": "prismatic",
        "hinge": "revolute",
        "ball": "spherical",
    }
)

HELICAL = (
    "a helical joint is not algebraic: its turn and its slide are an angle and a multiple of it; "
    "take a cylindrical joint, which has its configurations among others, or a revolute or "
    "prismatic one for the limits of a small and a large pitch"
)
