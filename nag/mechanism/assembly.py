"""What the models of unassembled mechanisms have in common: parts are given, not how they meet."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from nag.algebra.number import Number
from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem

# Imaginary parts of real assemblies, relative to the size of the point.
REAL = 1e-8


class AssemblyModel(Protocol):
    """A system whose solutions are all assemblies of given parts, real and complex."""

    @property
    def system(self) -> PolynomialSystem:
        """The equations."""

    @property
    def reference(self) -> tuple[Number, ...] | None:
        """An assembly that is known, an exact solution."""

    @property
    def symmetries(self) -> tuple[SignedPermutation, ...]:
        """Reflections and the like that carry assemblies to assemblies."""

    @property
    def reason(self) -> str:
        """One sentence: what was made of the parts."""

    def is_real(self, point: Sequence[complex]) -> bool:
        """Whether a solution is a real assembly, to within rounding."""


class RealCoordinates:
    """Models in coordinates that are real exactly where an assembly is."""

    def is_real(self, point: Sequence[complex]) -> bool:
        """Whether a solution is a real assembly, to within rounding."""
        bound = REAL * (1 + max((abs(x) for x in point), default=0.0))
        return all(abs(complex(x).imag) <= bound for x in point)
