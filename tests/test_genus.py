"""The genus of curves, by monodromy round the branch points of a projection."""

from __future__ import annotations

import pytest
from linkages import CASES, case, four_bar
from local_points import plain
from singular_zeros import polynomials

import nag
from nag.decomposition import genus

# Plane curves of degree d with n nodes and cusps have genus (d - 1)(d - 2)/2 - n.
CURVES = {
    "a conic": ("x y", "x^2 + y^2 - 1", 0),
    "a cubic": ("x y", "y^2 - x^3 - x - 1", 1),
    "a cubic with a node": ("x y", "y^2 - x^3 - x^2", 0),
    "a cubic with a cusp": ("x y", "y^2 - x^3", 0),
    "a quartic": ("x y", "x^4 + y^4 - x*y^2 - 1", 3),
    "a lemniscate": ("x y", "(x^2 + y^2)^2 - x^2 + y^2", 0),
    "a double cover of the line": ("x y", "y^2 - x^5 - x - 1", 2),
    "a cusp on a parabola": ("x y", "(y - x^2)^2 - x^7", 0),
    "one branch of four sheets": ("x y", "y^4 - x^9", 0),
    "a double cover in unequal units": ("x y", "y^2 - x*(x - 10^6)*(x - 10^12)", 1),
    "two quadrics": ("x y z", "x^2 + y^2 + z^2 - 1, x*y - z", 1),
    "a twisted cubic": ("x y z", "y - x^2, z - x^3", 0),
    # A quadric and a cubic meet in a curve of genus 4, less one for each point where they touch.
    "a quadric and a cubic that touch": ("x y z", "x*y - z^2 - 1, x^3 + y^3 + z^3 - 2", 1),
}


@pytest.mark.parametrize("name", sorted(CURVES))
def test_the_genus_of_a_curve(name: str) -> None:
    variables, equations, expected = CURVES[name]
    system = plain(polynomials(variables, *equations.split(", ")))
    (curve,) = nag.decompose(system).components
    found = genus(system, curve)
    assert (found.genus, found.rational) == (expected, expected == 0)
    assert found.sheets == curve.degree


def test_bricard_s_variety_is_elliptic() -> None:
    # Singular, genus in normal.lib: 1.
    system = nag.read_case(CASES / "bricard-variety.toml").system
    (curve,) = nag.decompose(system).components
    assert genus(system, curve).genus == 1


def test_bennett_and_the_parallelogram_move_rationally() -> None:
    for mechanism in (case("bennett"), four_bar()):
        system = nag.model(mechanism).system
        for curve in nag.decompose(system).components:
            assert genus(system, curve).rational


def test_only_curves_have_a_genus_here() -> None:
    system = plain(polynomials("x y z", "x^2 + y^2 + z^2 - 1"))
    with pytest.raises(ValueError, match="dimension 2"):
        genus(system, nag.decompose(system).components[0])


@pytest.mark.parametrize(
    ("equation", "number"),
    [("x^4 + y^4 + 2*x^3*y + y^2 - x^3", 10), ("y^2 - (x - 1)^3*(x - 2)^3*(x + 5)", 8)],
)
def test_cusps_are_branch_points_wherever_they_lie(equation: str, number: int) -> None:
    system = plain(polynomials("x y", equation))
    (curve,) = nag.decompose(system).components
    for seed in range(2):
        assert genus(system, curve, seed=seed).branch_points == number
