"""End points on solution sets of positive dimension, by what must not vanish on these.

A set counts unless one of the polynomials that must not vanish does so on all of it. Where one does
at a point of a smooth set, it is evaluated at another point of the set.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields

import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.numerics.read_only import fixed_array
from nag.numerics.singular_point import SingularEnd
from nag.numerics.zero_values import vanishes, vanishes_at
from nag.text.table import counted


@dataclass(frozen=True, eq=False)
class LargerSets:
    """End points on solution sets of positive dimension, each shape ``(k, n)``.

    Attributes:
        counting: no polynomial that must not vanish does so on all of the set.
        excluded: one does.
        doubtful: that is not known.
    """

    counting: np.ndarray
    excluded: np.ndarray
    doubtful: np.ndarray

    def __post_init__(self) -> None:
        for field in fields(self):
            object.__setattr__(self, field.name, fixed_array(getattr(self, field.name)))

    @classmethod
    def of(cls, n: int, points: Sequence[tuple[np.ndarray, bool | None]] = ()) -> LargerSets:
        """Points, each with whether its set is excluded; None where that is not known."""
        parts = [[x for x, answer in points if answer is which] for which in (False, True, None)]
        return cls(*(np.array(part, dtype=complex).reshape(len(part), n) for part in parts))

    @classmethod
    def together(cls, n: int, parts: Sequence[LargerSets]) -> LargerSets:
        """The points of several branches of a system."""
        every = [cls.of(n), *parts]
        return cls(*(np.vstack([getattr(p, f.name) for p in every]) for f in fields(cls)))

    def map_points(self, image: Callable[[np.ndarray], np.ndarray]) -> LargerSets:
        """The points in other coordinates."""
        return LargerSets(image(self.counting), image(self.excluded), image(self.doubtful))

    @property
    def points(self) -> np.ndarray:
        """All of them."""
        return np.vstack([self.counting, self.excluded, self.doubtful])

    @property
    def notes(self) -> list[str]:
        """What a reader must know of them."""
        notes = []
        if count := len(self.counting):
            lie = "lies on it and is no isolated solution"
            if count > 1:
                lie = "lie on it and are no isolated solutions"
            ends = counted(count, "end point")
            notes.append(f"the solution set has positive dimension; {ends} {lie}")
        if count := len(self.doubtful):
            lie = "lies on a solution set" if count == 1 else "lie on solution sets"
            notes.append(
                f"{counted(count, 'end point')} {lie} of positive dimension; whether something "
                "that must not vanish does so on all of it was not decided"
            )
        return notes


def is_set_excluded(nonzero: Sequence[Polynomial], end: SingularEnd) -> bool | None:
    """Whether one of some polynomials vanishes on all of the set through a zero that lies on one.

    None where that is not known.
    """
    near = [g for g in nonzero if vanishes_at(end, g) is not False]
    if not near:
        return False
    if end.beside is None:
        return None
    answers = [vanishes(g, end.beside) for g in near]
    return True if True in answers else None if None in answers else False
