"""What is decided at a singular zero: the sharpened point, where it lies, its multiplicity."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from enum import Enum
from fractions import Fraction
from typing import Any

import flint
import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.numerics.precise_point import PrecisePoint


class Place(Enum):
    """How a zero lies in the solution set."""

    ISOLATED = "isolated"
    ON_COMPONENT = "on a component of positive dimension"
    CLUSTER = "one of several zeros close together"
    UNDECIDED = "undecided"


@dataclass(frozen=True, eq=False)
class SingularEnd:
    """A zero that may be singular.

    Attributes:
        point: the sharpened zero, rounded, shape ``(n,)``; where nothing was decided, as given.
        place: where it lies.
        multiplicity: the dimension of its local ring if isolated (1 if it is regular), else 0.
        accuracy: relative error of ``point``.
        condition: of the deflated equations there; ``inf`` where there are none.
        reason: what the judgement rests on, or why there is none.
        dimension: of a set of zeros through the point, or among the zeros of a cluster: a lower
            bound; 0 if there is none.
        precise: the zero to about a hundred digits; None if undecided.
        rational: the exact coordinates, if they are rational.
        nearby: the isolated zeros of a cluster, each judged by itself.
        beside: another point of the set of zeros through this one, where all zeros near the point
            are those of a smooth set; else None.
    """

    point: np.ndarray
    place: Place
    multiplicity: int
    accuracy: float
    condition: float
    reason: str = ""
    dimension: int = 0
    precise: PrecisePoint | None = None
    rational: tuple[Fraction, ...] | None = None
    nearby: tuple[SingularEnd, ...] = ()
    beside: PrecisePoint | None = None

    def parts(self) -> dict[str, Any]:
        """All of it as numbers, texts, lists and maps, exactly."""
        own = {each.name: getattr(self, each.name) for each in fields(self)}
        rational = self.rational and [str(c) for c in self.rational]
        return own | {
            "point": [[z.real, z.imag] for z in self.point.tolist()],
            "place": self.place.name,
            "precise": self.precise and self.precise.parts(),
            "rational": rational,
            "nearby": [end.parts() for end in self.nearby],
            "beside": self.beside and self.beside.parts(),
        }

    @classmethod
    def from_parts(cls, parts: Mapping[str, Any]) -> SingularEnd:
        """What `parts` was made of."""
        precise, beside, rational = (parts[name] for name in ("precise", "beside", "rational"))
        own = {
            "point": np.array([complex(*z) for z in parts["point"]], dtype=np.complex128),
            "place": Place[parts["place"]],
            "precise": precise and PrecisePoint.from_parts(*precise),
            "rational": None if rational is None else tuple(map(Fraction, rational)),
            "nearby": tuple(map(cls.from_parts, parts["nearby"])),
            "beside": beside and PrecisePoint.from_parts(*beside),
        }
        return cls(**{**parts, **own})


def analyse(
    polynomials: Sequence[Polynomial],
    x: np.ndarray | Sequence[complex | flint.acb],
    accuracy: float | np.ndarray,
    rng: np.random.Generator,
    slices: np.ndarray | None = None,
    place_only: bool = False,
    patience: float = 1.0,
    most: int | None = None,
) -> SingularEnd:
    """Sharpen a zero, and decide whether it is isolated, and of which multiplicity.

    That it is multiple is decided at an exact zero of exact deflated equations, known to 125
    digits, where all that should vanish is below 1e-100; that it is isolated by the dual space of
    its local ring (modulo two primes of 62 bits if the point is rational, in 150 digits else); that
    it is not by following a set of zeros from it, exact in the same sense at every point, or as its
    corank asks for a larger multiplicity than it can have.

    Args:
        polynomials: exact, in ``n`` variables.
        x: the point: complex doubles, or balls, of which the middles count.
        accuracy: how far the zero may be, relative to the size of ``x`` or to one; or how far each
            of its coordinates, absolute, shape ``(n,)``.
        rng: chooses directions and hyperplanes.
        slices: further linear equations as rows on ``(1, x)``, complex, taken as exact.
        place_only: whether 150 digits will do for coefficients of any length, as only where the
            zero lies is of interest: not how many zeros it may be, nearer together than that.
        patience: part of the usual work after which a local ring is left undecided.
        most: the largest multiplicity that it may have if it is isolated, where there are as many
            equations as variables and that is known.
    """
    from nag.numerics.local_structure import Effort, judge_zero

    return judge_zero(polynomials, x, accuracy, rng, slices, Effort(not place_only, patience, most))
