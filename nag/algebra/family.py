"""Families of square polynomial systems: their coefficients depend on parameters."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from nag.algebra.number import Number
from nag.algebra.polynomial import Exponents, Polynomial
from nag.algebra.system import PolynomialSystem
from nag.errors import NagError

Terms = Mapping[Exponents, Number | complex]


@dataclass(frozen=True)
class Family:
    """Square systems that depend on parameters.

    Attributes:
        variables: names of the ``n`` unknowns.
        parameters: names of the ``k`` parameters.
        polynomials: ``n`` polynomials in the unknowns followed by the parameters.
    """

    variables: tuple[str, ...]
    parameters: tuple[str, ...]
    polynomials: tuple[Polynomial, ...]

    def __post_init__(self) -> None:
        for name in ("variables", "parameters", "polynomials"):
            object.__setattr__(self, name, tuple(getattr(self, name)))
        n, total = self.n, self.n + len(self.parameters)
        if len(self.polynomials) != n:
            raise NagError(f"{len(self.polynomials)} equations for {n} unknowns")
        if any(f.n != total for f in self.polynomials):
            raise NagError(f"the polynomials must be in {n} unknowns and the parameters")

    @property
    def n(self) -> int:
        """Number of unknowns."""
        return len(self.variables)

    def terms(self, values: Sequence[Number | complex]) -> tuple[Terms, ...]:
        """The equations' terms where the parameters have these values."""
        result = []
        for f in self.polynomials:
            terms: dict[tuple[int, ...], Number | complex] = {}
            for e, c in f.terms.items():
                value = c if all(isinstance(v, type(c)) for v in values) else complex(c)
                for v, k in zip(values, e[self.n :], strict=True):
                    value = value * v**k if k else value
                key = e[: self.n]
                terms[key] = terms[key] + value if key in terms else value
            result.append(terms)
        return tuple(result)

    def at(self, values: Sequence[Number]) -> PolynomialSystem:
        """The system where the parameters have these exact values."""
        images = [*Polynomial.variables(self.n)]
        images += [Polynomial.constant(self.n, v) for v in values]
        return PolynomialSystem(self.variables, [f.compose(images) for f in self.polynomials])
