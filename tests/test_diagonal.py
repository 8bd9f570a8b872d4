"""Two components meet on the diagonal of their product in the points that algebra says."""

from __future__ import annotations

import numpy as np
import pytest
from systems import system

from nag.decomposition.decompose import decompose
from nag.decomposition.diagonal import meet_on_diagonal
from nag.decomposition.factor import Operand
from nag.decomposition.intersection import intersect_components
from nag.decomposition.reduction import Reduction
from nag.decomposition.superset import Superset
from nag.tracking.run import Run

SPHERE = "x^2 + y^2 + z^2 - 1"


def met(
    first: str | tuple[str, ...],
    second: str | tuple[str, ...],
    seed: int = 0,
    *,
    names: str = "x y z",
    nonzero: tuple[str, ...] = (),
) -> tuple[Superset, Reduction]:
    """The meeting of two surfaces, and the coordinates that its points have."""
    factors, every = [], []
    for equations in (first, second):
        own = (equations,) if isinstance(equations, str) else equations
        of = system(names, *own)
        (component,) = decompose(of).components
        factors.append(Operand.of(of, component))
        every += own
    common = Reduction.of(system(names, *every, nonzero=nonzero))
    return meet_on_diagonal(*factors, common, np.random.default_rng(seed), Run()), common


def points(found: Superset, common: Reduction) -> np.ndarray:
    """The points of a curve, in space."""
    return common.frame.points(np.vstack([fibre.x for fibre in found.fibres[1]]))


def sizes(found: Superset) -> dict[int, int]:
    return {d: sum(map(len, fibres)) for d, fibres in found.fibres.items() if fibres}


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(
    ("second", "degree"), [("x^2 - y*z + 3", 4), ("3*x - 4*y + z", 2), ("x^2 + 3*y^2 + z", 4)]
)
def test_surfaces_meet_in_curves_of_the_product_of_their_degrees(
    second: str, degree: int, seed: int
) -> None:
    found, common = met(SPHERE, second, seed)
    assert found.notes == () and found.bare == ()
    assert sizes(found) == {1: degree}
    assert common.original.residuals(points(found, common)).max() < 1e-12
    (row,) = found.fibres[1][0].rows
    own = np.vstack([fibre.x for fibre in found.fibres[1]])
    assert np.abs(row[0] + own @ row[1:]).max() < 1e-12


def test_surfaces_that_touch_along_a_curve_meet_in_it_once() -> None:
    # A cylinder about the sphere: z^2 = 0 on both.
    found, common = met(SPHERE, "x^2 + y^2 - 1")
    assert found.notes == () and sizes(found) == {1: 2}
    assert np.abs(points(found, common)[:, 2]).max() < 1e-10


def test_a_component_meets_itself_in_itself() -> None:
    found, _ = met(SPHERE, SPHERE)
    assert found.notes == () and sizes(found) == {2: 2}


def test_what_must_not_vanish_is_left_out() -> None:
    # The sphere meets two planes in circles, one of which is forbidden.
    second = "x^2 + y^2 + z^2 - 1 - (x - y)*(x + y - 3)"
    found, common = met(SPHERE, second, nonzero=("x - y",))
    assert found.notes == () and sizes(found) == {1: 2}
    x = points(found, common)
    assert np.abs(x[:, 0] + x[:, 1] - 3).max() < 1e-12


def test_what_lies_beside_the_excluded_is_kept() -> None:
    # On the plane x = y what must not vanish has the value 10^-10.
    second = "x^2 + y^2 + z^2 - 1 - (x - y)*(x + y - 3)"
    found, _ = met(SPHERE, second, nonzero=("x - y + 1/10^10",))
    assert found.notes == () and sizes(found) == {1: 4}


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("exponent", [16, 20, 40])
@pytest.mark.parametrize(
    ("text", "which", "place"),
    [
        ("(x^2 + y^2 - 1)*(x - 1 - 1/10^{})", 1, 2**0.5),
        ("(y - x^2)*(y + x^2 - 1/10^{})", 0, 0.5**0.5),
    ],
)
def test_two_points_where_curves_nearly_touch_are_told_apart(
    text: str, which: int, place: float, exponent: int, seed: int
) -> None:
    curves = decompose(system("x y", text.format(exponent)), seed=seed)
    found = intersect_components(curves.system, *curves.components, seed=seed)
    assert found.complete and [(c.dimension, c.degree) for c in found.components] == [(0, 1)] * 2
    both = np.array([c.points[0, which] for c in found.components]) * 10 ** (exponent / 2)
    assert np.allclose(np.sort(both.real + both.imag), [-place, place], rtol=1e-6)


def test_components_that_meet_in_a_small_place_have_slices_in_its_units() -> None:
    lines = decompose(system("x y", "x*y*(x + y - 1/10^20)"))
    for c in lines.components:
        assert np.abs(c.points).max() < 1e-17


def test_a_point_among_larger_sets_that_are_excluded_is_left_out() -> None:
    lines = (system("x y z w", "y", "z", "w - x"), system("x y z w", "y - x", "z", "w - x"))
    factors = [Operand.of(line, decompose(line).components[0]) for line in lines]
    # Both lines, and the plane x = w = 0 through the point in which they meet.
    union = ("x*z", "w*z", "x*(w - x)", "w*(w - x)", "x*y*(y - x)", "w*y*(y - x)")
    common = Reduction.of(system("x y z w", *union, nonzero=("x",)))
    found = meet_on_diagonal(*factors, common, np.random.default_rng(0), Run())
    assert (sizes(found), found.bare, found.notes) == ({}, (), ())


def test_a_double_point_beside_a_curve_is_told_from_it_in_digits() -> None:
    # Graphs over x and y that meet where x (10^5 x - 1)^2 and x (y - 1) vanish: in a conic, and
    # in a double point at a distance of 10^-5.
    graph = ("z - x*y", "w - y^2")
    other = ("10^10*(z - x*y) - x*(10^5*x - 1)^2", "w - y^2 - x*(y - 1)")
    found, _ = met(graph, other, names="x y z w")
    assert found.notes == () and sizes(found) == {1: 2, 0: 1}
