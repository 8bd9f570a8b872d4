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
from nag.decomposition import discover, intersect_equations, singular_locus
from nag.decomposition.decompose import decompose
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


@pytest.mark.parametrize("power", [-12, -8, -4, 4, 6, 8, 10, 12])
def test_operations_on_components_do_not_depend_on_units(power: int) -> None:
    k = Fraction(10) ** power
    surfaces = nag.system(f"(({k}*x)^2 + y^2 - z)*({k}*x - y*z + 1)", "x y z")
    plane = nag.system(f"{k}*x + 2*y = z", "x y z")
    for seed in range(2):
        both = decompose(surfaces, seed=seed)
        found = {
            "pair": both.components[0].intersect(both.components[1], seed=seed),
            "equations": intersect_equations(surfaces, both.components[0], plane, seed=seed),
            "discovered": discover(surfaces, starts=6, seed=seed),
        }
        kinds = {
            name: [(c.dimension, c.degree, str(c.status)) for c in answer.components]
            for name, answer in found.items()
        }
        assert kinds == {
            "pair": [(1, 4, "irreducible")],
            "equations": [(1, 2, "irreducible")],
            "discovered": [(2, 2, "irreducible")] * 2,
        }
        assert found["pair"].complete and found["equations"].complete
        locus = singular_locus(both, seed=seed)
        assert [(s.dimension, s.degree, dict(s.multiplicities)) for s in locus.sets] == [
            (1, 4, {0: 1, 1: 1})
        ]


def test_intersections_come_back_in_the_units_that_were_given() -> None:
    plain = nag.decompose("(x^2 + y^2 - z)*(x - y*z + 1)")
    large = nag.decompose("(10^16*x^2 + y^2 - z)*(10^8*x - y*z + 1)")
    curves = [
        both.components[0].intersect(both.components[1]).components[0] for both in (plain, large)
    ]
    assert curves[0].contains([0, 1, 1]) and curves[1].contains([0, 1, 1])
    for x in curves[1].sample(0, 3):
        assert curves[1].contains(x) and curves[0].contains(x * [1e8, 1, 1])
    slopes, b = curves[1].slice.A, curves[1].slice.b
    off = np.abs(curves[1].points @ slopes.T - b) / (np.abs(curves[1].points) @ np.abs(slopes.T))
    assert off.max() < 1e-14
    sizes = np.abs(curves[1].points).max(axis=0)
    assert (curves[1].radii < 1e-14 * sizes).all()


def test_components_whose_slices_were_drawn_in_different_units_meet() -> None:
    # The plane says nothing of the units of z and w, the quadric nothing of that of x.
    plain = nag.system("(9*y*z - y^2 - 2*y*w - 9*z^2 + 6*z)*(77*x + 9/8*y - 1)", "x y z w")
    whole = decompose(in_units(plain, (10, -7, -7, 8)))
    found = whole.components[0].intersect(whole.components[1])
    assert found.complete
    assert [(c.dimension, c.degree) for c in found.components] == [(2, 2)]
