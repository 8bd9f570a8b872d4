"""What is known of a system by exact algebra: each fact is worked out when it is asked for, once.

Whoever asks about the same system is handed what others have found out.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property

from nag.algebra.algebraic_zeros import AlgebraicZero, algebraic_zeros
from nag.algebra.branches import Branches, search_branches
from nag.algebra.system import PolynomialSystem
from nag.algebra.zero_count import ZeroCount, most_zeros
from nag.numerics.natural_coordinates import NaturalCoordinates, natural_coordinates


@dataclass(frozen=True, eq=False)
class SystemFacts:
    """What exact algebra says of a system."""

    system: PolynomialSystem
    _counts: dict[tuple[int, bool], ZeroCount | None] = field(default_factory=dict, repr=False)

    @cached_property
    def unconditional(self) -> SystemFacts:
        """Of the equations alone, whatever must not vanish."""
        return SystemFacts(replace(self.system, nonzero=())) if self.system.nonzero else self

    @cached_property
    def branches(self) -> Branches:
        """The branches that the system falls into."""
        return search_branches(self.system)

    @cached_property
    def exact_zeros(self) -> tuple[AlgebraicZero, ...] | None:
        """All zeros, where polynomials in one variable give them, or two equations in two do."""
        return algebraic_zeros(self.system)

    @cached_property
    def natural(self) -> NaturalCoordinates:
        """The coordinates that suit the equations."""
        return natural_coordinates(self.system.polynomials, self.system.n)

    def count_zeros(self, enough: int = -1, patient: bool = True) -> ZeroCount | None:
        """How many zeros there are at most, modulo two primes, as `most_zeros` counts them."""
        asked = enough, patient
        if asked not in self._counts:
            exact = (count for count in self._counts.values() if count and count.exact)
            known = next(exact, None)
            self._counts[asked] = known or most_zeros(self.system.polynomials, *asked)
        return self._counts[asked]
