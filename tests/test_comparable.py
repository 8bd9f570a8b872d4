"""Components in coordinates of very unequal sizes are moved, sampled and projected all the same."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

import nag
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.decomposition import decompose
from nag.witness.component_equations import component_fibres

CASES = Path(__file__).parent.parent / "cases"
# Names, decimal logarithms of the coordinates' sizes, and dimensions and degrees.
SCALED = [
    ("four-bar-free", (7, -8, -8, 3, 6, 3, 8, -7), [(2, 4), (2, 8)]),
    ("rhombus", (-5, 1, -4, 1, -8, 4), [(1, 2), (1, 2), (1, 2)]),
    ("rhombus", (8, 0, 0, 8, 8, 0), [(1, 2), (1, 2), (1, 2)]),
]


def in_units(system: PolynomialSystem, powers: tuple[int, ...]) -> PolynomialSystem:
    """The system whose zeros are 10^powers as large."""
    polynomials = []
    for f in system.polynomials:
        terms = {
            e: Fraction(c) / Fraction(10) ** sum(a * p for a, p in zip(e, powers, strict=True))
            for e, c in f.terms.items()
        }
        polynomials.append(Polynomial(f.n, terms))
    return replace(system, polynomials=tuple(polynomials))


@pytest.mark.parametrize(("name", "powers", "expected"), SCALED)
def test_sizes_of_coordinates_do_not_matter(name, powers, expected) -> None:
    plain = nag.read_case(CASES / f"{name}.toml").system
    system = in_units(plain, powers)
    answer, reference = decompose(system), decompose(plain)
    kinds = sorted((c.dimension, c.degree) for c in answer.components)
    assert answer.complete and kinds == expected
    images = []
    for part in (answer, reference):
        own = [c.project([i]) for c in part.components for i in range(2)]
        images.append(sorted((p.dimension, p.degree, p.fibre_degree) for p in own))
    assert images[0] == images[1]
    for component in answer.components:
        for seed in range(4):
            samples = component.sample(seed, 3)
            assert all(component.contains(x) for x in samples)
            others = [c for c in answer.components if c is not component]
            assert not any(c.contains(x) for c in others for x in samples)


def test_sizes_of_a_set_follow_its_equations() -> None:
    plain = nag.read_case(CASES / "rhombus.toml").system
    powers = (6, -6, 0, 3, 5, -2)
    component = decompose(in_units(plain, powers)).components[0]
    (fibre,) = component_fibres(component.system, component)
    found = fibre.cut.powers[:6] * np.log10(2)
    assert np.abs(found - powers).max() < 1
    assert not decompose(plain).components[0].fibres[0].cut.powers.any()
