"""Families of square polynomial systems: their coefficients depend on parameters."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from nag.algebra.imaginary_unit import adjoin_unit, name_unit, values_with_unit
from nag.algebra.number import ComplexNumber, Number
from nag.algebra.polynomial import Exponents, Polynomial
from nag.algebra.system import PolynomialSystem
from nag.algebra.tokens import shorten_names
from nag.errors import NagError
from nag.text.table import count_text

Terms = Mapping[Exponents, Number | complex]


@dataclass(frozen=True)
class Family:
    """Square systems that depend on parameters.

    Attributes:
        variables: names of the ``n`` unknowns.
        parameters: names of the ``k`` parameters.
        polynomials: ``n`` polynomials in the unknowns followed by the parameters.
        imaginary: whether coefficients are complex: the last unknown is the imaginary unit then, as
            in `nag.algebra.imaginary_unit`, and solutions are those in which it is i.
    """

    variables: tuple[str, ...]
    parameters: tuple[str, ...]
    polynomials: tuple[Polynomial, ...]
    imaginary: bool = False

    def __post_init__(self) -> None:
        for name in ("variables", "parameters", "polynomials"):
            object.__setattr__(self, name, tuple(getattr(self, name)))
        n, total = self.n, self.n + len(self.parameters)
        if len(self.polynomials) != n:
            own = len(self.polynomials) - self.imaginary
            unknowns = self.own_variables
            raise NagError(
                f"{count_text(own, 'equation')} for {count_text(len(unknowns), 'unknown')}: "
                f"{shorten_names(unknowns)}; "
                "a family has as many of both, so name parameters among them"
            )
        if any(f.n != total for f in self.polynomials):
            raise NagError(f"the polynomials must be in {n} unknowns and the parameters")

    @property
    def n(self) -> int:
        """Number of unknowns."""
        return len(self.variables)

    @property
    def own_variables(self) -> tuple[str, ...]:
        """Names of the unknowns but the imaginary unit."""
        return self.variables[: self.n - self.imaginary]

    @classmethod
    def of_system(cls, system: PolynomialSystem, count: int) -> Family:
        """The family whose parameters are the last ``count`` variables of a system of its own.

        Raises:
            NagError: if the others are not as many as equations.
        """
        own = system.own_variables
        unknowns, parameters = own[: len(own) - count], own[len(own) - count :]
        if not system.imaginary:
            return cls(unknowns, parameters, system.polynomials)
        n, k = len(unknowns), len(parameters)
        # The unit goes before the parameters.
        places = [*range(n), *range(n + 1, n + 1 + k), n]
        moved = [f.with_variables(system.n, places) for f in system.polynomials]
        return cls((*unknowns, system.variables[-1]), parameters, tuple(moved), imaginary=True)

    def with_unit(self) -> Family:
        """The same family with the imaginary unit as one more unknown, if it has none."""
        if self.imaginary:
            return self
        names = (*self.variables, *self.parameters)
        own = [f.with_variables(len(names) + 1, range(len(names))) for f in self.polynomials]
        system = adjoin_unit((*names, name_unit(names)), own)
        return Family.of_system(system, len(self.parameters))

    def terms(self, values: Sequence[Number | ComplexNumber | complex]) -> tuple[Terms, ...]:
        """The equations' terms where the parameters have these values.

        Exact complex ones are allowed where the unit is an unknown.
        """
        if any(isinstance(v, ComplexNumber) for v in values):
            exact = [v for v in values if not isinstance(v, complex)]
            return tuple(f.terms for f in self.at(exact).polynomials)
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

    def at(self, values: Sequence[Number | ComplexNumber]) -> PolynomialSystem:
        """The system where the parameters have these exact values."""
        images = [*Polynomial.variables(self.n)]
        if self.imaginary:
            given = values_with_unit(
                dict(zip(self.parameters, values, strict=True)), self.variables
            )
            images += [
                v if isinstance(v, Polynomial) else Polynomial.constant(self.n, v)
                for v in given.values()
            ]
            own = [f.compose(images) for f in self.polynomials[:-1]]
            return adjoin_unit(self.variables, own)
        if any(isinstance(v, ComplexNumber) for v in values):
            return self.with_unit().at(values)
        images += [Polynomial.constant(self.n, v) for v in values]
        return PolynomialSystem(self.variables, [f.compose(images) for f in self.polynomials])
