"""Polynomial systems and families from texts, benchmarks, and what answers consist of."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import Any

from nag.algebra.expression import parse_polynomial
from nag.algebra.family import Family
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.files.cases import read_case
from nag.solving.start.target import Target
from nag.witness.witness import Decomposition

BENCHMARKS = Path(__file__).parents[1] / "cases" / "benchmarks"


def system(
    variables: str, *equations: str, nonzero: tuple[str | Polynomial, ...] = (), **more: Any
) -> PolynomialSystem:
    """The equations in variables whose names are separated by blanks."""
    names = tuple(variables.split())
    return PolynomialSystem(
        names,
        tuple(parse_polynomial(e, names) for e in equations),
        tuple(parse_polynomial(e, names) if isinstance(e, str) else e for e in nonzero),
        **more,
    )


def family(variables: str, parameters: str, *equations: str) -> Family:
    """Likewise a family of systems."""
    names = variables.split() + parameters.split()
    polynomials = [parse_polynomial(e, names) for e in equations]
    return Family(tuple(variables.split()), tuple(parameters.split()), tuple(polynomials))


def benchmark(name: str) -> Target:
    """A benchmark as what start systems are made for."""
    of = read_case(BENCHMARKS / f"{name}.toml").system
    return Target.of(of.polynomials, of.n)


def kinds(answer: Decomposition) -> Counter[tuple[int, int, int]]:
    """Dimension, degree and multiplicity of the components."""
    return Counter((c.dimension, c.degree, c.multiplicity) for c in answer.components)
