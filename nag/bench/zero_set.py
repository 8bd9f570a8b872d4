"""The zero set of a system, as far as answers are compared with it."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field

# Components by dimension, degree and multiplicity.
Components = Counter[tuple[int, int, int]]


@dataclass(frozen=True)
class ZeroSet:
    """The zero set of a system, as a scheme.

    Attributes:
        points: isolated zeros by multiplicity.
        degrees: by dimension, above 0, and multiplicity, the sum of the components' degrees.
        components: all components, isolated zeros included, or None where only the sums of their
            degrees are known.
        facts: what else is known, in words, each with how often it is so.
        dimension: where it is not None, nothing but the dimension is known; -1 for the empty set.
    """

    points: Counter[int] = field(default_factory=Counter)
    degrees: Counter[tuple[int, int]] = field(default_factory=Counter)
    components: Components | None = None
    dimension: int | None = None
    facts: Counter[str] = field(default_factory=Counter)

    @classmethod
    def of(cls, components: Components, facts: Counter[str] | None = None) -> ZeroSet:
        """The zero set that has these components, and of which these facts are known."""
        points: Counter[int] = Counter()
        degrees: Counter[tuple[int, int]] = Counter()
        for (dimension, degree, multiplicity), count in components.items():
            if dimension:
                degrees[dimension, multiplicity] += count * degree
            else:
                points[multiplicity] += count
        return cls(points, degrees, Counter(components), facts=Counter(facts or {}))

    def agrees(self, components: Components) -> bool:
        """Whether these are the components, as far as is known here."""
        if self.dimension is not None:
            return self.dimension == max((key[0] for key in components), default=-1)
        if self.components is not None:
            return self.components == components
        found = ZeroSet.of(components)
        return (self.points, self.degrees) == (found.points, found.degrees)
