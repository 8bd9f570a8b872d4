"""Whether polynomials vanish on a component, as far as exact algebra shows it."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

from nag.algebra.elimination import Elimination
from nag.algebra.factoring import factored
from nag.algebra.polynomial import Polynomial


@dataclass(frozen=True, eq=False)
class Vanishing:
    """Whether polynomials vanish on a component; each is decided once.

    Attributes:
        decide: decides it; None where that is not known.
    """

    decide: Callable[[Polynomial], bool | None]
    _known: dict[Polynomial, bool | None] = field(default_factory=dict)

    def __call__(self, f: Polynomial) -> bool | None:
        if f not in self._known:
            self._known[f] = self.decide(f)
        return self._known[f]

    def exclude(self, polynomials: Iterable[Polynomial]) -> None:
        """Take note of polynomials that certainly do not vanish."""
        self._known.update(dict.fromkeys(polynomials, False))


def follows(image: Polynomial, elimination: Elimination) -> bool:
    """Whether a polynomial, in the variables that are left, vanishes where a system does.

    That is seen where it is zero, or has a factor that is one of the irreducible equations.
    """
    return not image or any(p in elimination.irreducible for p, _ in factored(image))
