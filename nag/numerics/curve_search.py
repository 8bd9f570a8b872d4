"""When to look for a set of zeros through a point whose dual space goes on growing."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass


@dataclass
class CurveSearch:
    """Looks for a set of zeros through a point when its dual space has grown for some degrees.

    Attributes:
        degrees: of the dual space after which to look, each once.
        look: the dimension of the set that so many attempts find, 0 if there is none.
        dimension: what was found.
    """

    degrees: Sequence[int]
    look: Callable[[int], int]
    dimension: int = 0
    times: int = 0

    def succeeds(self, hilbert: Sequence[int]) -> bool:
        """Whether a set is known, when the dual space has these dimensions by degree."""
        growing = list(hilbert[-3:]) == sorted(hilbert[-3:])
        if self.times < len(self.degrees) and growing and len(hilbert) > self.degrees[self.times]:
            self.times += 1
            self.dimension = self.look(4 * self.times)
        return self.dimension > 0

    def last(self) -> bool:
        """The same where the dual space cannot be followed further."""
        if self.times < len(self.degrees):
            self.times += 1
            self.dimension = self.look(4 * self.times)
        return self.dimension > 0
