"""Monomials as products of variables and earlier ones, each made once for all that need it."""

from __future__ import annotations

from dataclasses import dataclass, field

Exponents = tuple[int, ...]


@dataclass(frozen=True, eq=False)
class MonomialProducts:
    """A list of one, the variables, and products; a monomial is known by its place there.

    Attributes:
        n: number of variables.
        pairs: places of the factors of each product, both earlier ones.
    """

    n: int
    pairs: list[tuple[int, int]] = field(default_factory=list)
    _places: dict[Exponents, int] = field(default_factory=dict)

    def place(self, e: Exponents) -> int:
        """The place of a monomial, which is appended with all that it needs where it is new."""
        if e not in self._places:
            self._places[e] = self._made(e)
        return self._places[e]

    def _made(self, e: Exponents) -> int:
        last = max((i for i, k in enumerate(e) if k), default=-1)
        if sum(e) <= 1:
            return 1 + last
        first, rest = e[:last], e[last + 1 :]
        half = 0 if any(first) else e[last] // 2
        factors = (*first, half, *rest), (*(0,) * last, e[last] - half, *rest)
        self.pairs.append((self.place(factors[0]), self.place(factors[1])))
        return self.n + len(self.pairs)
