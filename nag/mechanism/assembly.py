"""What the models of unassembled mechanisms have in common: parts are given, not how they meet."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from nag.algebra.number import Number
from nag.algebra.polynomial import Polynomial
from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem
from nag.mechanism.axes import Space
from nag.mechanism.path_estimates import Alternative
from nag.numerics.doubles import ROUGH
from nag.text.table import one_line


@dataclass(frozen=True)
class Side:
    """Two places a known distance apart: the ends of a bar, or two pins of a link."""

    ends: tuple[str, str]
    squared: Number
    name: str


class AssemblyModel:
    """A system whose solutions are all assemblies of given parts, real and complex.

    Attributes:
        system: the equations.
        reference: an assembly that is known, an exact solution; None if none is.
        symmetries: reflections and the like that carry assemblies to assemblies.
        reason: one sentence: what was made of the parts.
        space: in which the parts move.
        gruebler_kutzbach: the mobility that counting predicts.
        formulation_text: what the equations are, as text.
        formulation: its name, where parts have formulations and not only coordinates.
        freedoms_left_out: freedoms that every assembly has besides, and whose they are.
        zero_links: which links have length zero.
        rank: number of closure equations and how many are independent, if that is known.
        solution: what one solution is called.
        counted_up_to: what solutions are the same up to, in words after their number.
        points_of_each: how many solutions each assembly is.
        alternatives: all formulations, or all coordinates, those that components are found in
            first.
        joint_types: the types of the joints, where each is a constraint on two bodies' frames.
        sides: places that the parts keep at a distance, where these are all that they keep.
    """

    system: PolynomialSystem
    reference: tuple[Number, ...] | None = None
    symmetries: tuple[SignedPermutation, ...] = ()
    reason: str
    space: Space
    gruebler_kutzbach: int
    formulation_text: str
    formulation: str | None = None
    freedoms_left_out: tuple[tuple[int, str], ...] = ()
    zero_links: tuple[str, ...] = ()
    rank: tuple[int, int] | None = None
    solution = "assembly"
    counted_up_to = ""
    points_of_each = 1
    alternatives: tuple[Alternative, ...]
    joint_types: tuple[str, ...] = ()
    sides: tuple[Side, ...] = ()

    __repr__ = one_line

    def place_polynomials(self) -> Mapping[str, Sequence[Polynomial]]:
        """Coordinates of the sides' ends in one frame, in the system's variables."""
        return {}

    def __str__(self) -> str:
        from nag.mechanism.shown import parts_text

        return parts_text(self)

    def is_real(self, point: Sequence[complex]) -> bool:
        """Whether a solution is a real assembly, to within rounding.

        So it is here where its coordinates are real.
        """
        bound = ROUGH * (1 + max((abs(x) for x in point), default=0.0))
        return all(abs(complex(x).imag) <= bound for x in point)
