"""Operations on components in coordinates far from those that suit the equations."""

from __future__ import annotations

from fractions import Fraction

import flint
import numpy as np
import pytest

import nag
from nag.algebra.system import PolynomialSystem
from nag.decomposition import genus, project, sample, singular_locus, witness_at
from nag.decomposition.trace import linear_traces
from nag.interpolation.precise_samples import samples, source_of_component
from nag.numerics.digits import to_ball
from nag.numerics.natural_coordinates import NaturalCoordinates
from nag.tracking.run import Run
from nag.witness.change_of_coordinates import carry_component, coordinates_of
from nag.witness.witness import Decomposition

SYSTEMS = {
    "surfaces": nag.system("(x^2 + y^2 - z)*(x - y)", "x y z"),
    "spheres": nag.system("(x^2 + y^2 + z^2 - 1)*((x - 1)^2 + y^2 + z^2 - 1)", "x y z"),
    "cubics": nag.system("(y^2 - x^3 - x - 1)*(x^2 + y^2 - 4)", "x y"),
    "double": nag.system("(x^2 + y^2 + z^2 - 1)^2*(x*y - z)", "x y z"),
}
ORIGIN = (Fraction(-7, 3), Fraction(5), Fraction(-1, 9))


def translated(name: str, power: int) -> PolynomialSystem:
    plain = SYSTEMS[name]
    origin = tuple(-b * 10**power for b in ORIGIN[: plain.n])
    return NaturalCoordinates((Fraction(1),) * plain.n, origin).system(plain)


def decomposed(name: str, power: int) -> Decomposition:
    found = nag.decompose(translated(name, power), seed=1)
    assert found.complete
    return found


@pytest.mark.parametrize("power", [3, 6])
@pytest.mark.parametrize(
    ("name", "right"),
    [
        ("surfaces", [(1, 2)]),
        ("spheres", [(1, 2)]),
        ("cubics", [(0, 1)] * 6),
        ("double", [(1, 4)]),
    ],
)
def test_components_meet_alike_wherever_the_origin_lies(
    name: str, right: list[tuple[int, int]], power: int
) -> None:
    first, second = decomposed(name, power).components[:2]
    found = first.intersect(second, seed=1)
    assert [(c.dimension, c.degree) for c in found.components] == right
    assert found.complete
    assert max(c.residual for c in found.components) < 1e-12


def test_singular_points_are_found_far_from_the_origin() -> None:
    found = singular_locus(decomposed("cubics", 6), seed=1)
    assert found.complete
    assert [one.multiplicities for one in found.sets] == [{0: 1, 1: 1}] * 6
    assert all(one.local.dimension == 1 for one in found.sets)


def test_points_far_from_the_origin_are_sampled_to_rounding() -> None:
    whole = decomposed("cubics", 6)
    for component in whole.components:
        found = sample(whole.system, component, 3, seed=1)
        assert found.residual < 1e-14


def test_traces_and_genera_do_not_depend_on_the_origin() -> None:
    whole = decomposed("cubics", 6)
    assert linear_traces(whole, seed=1) == [True, True]
    assert [genus(whole.system, c, seed=1).genus for c in whole.components] == [0, 1]


def test_a_component_comes_back_as_it_was() -> None:
    whole = decomposed("cubics", 6)
    natural = coordinates_of(whole.system)
    component, system = whole.components[1], natural.system(whole.system)
    there = carry_component(component, natural, system)
    back = carry_component(there, natural.inverse, whole.system, component.slice)
    assert system.polynomials != whole.system.polynomials
    assert np.abs(there.points).max() < 100
    assert there.errors.max() < 1e-15 > back.errors.max()
    assert np.all(np.abs(back.points - component.points) <= back.radii + component.radii)


def test_points_far_from_the_origin_are_told_to_be_on_a_component_or_off_it() -> None:
    whole = decomposed("spheres", 6)
    first, second = whole.components
    centre = [b * 10**6 for b in ORIGIN]
    point = [c + Fraction(k, 9) for c, k in zip(centre, (1, 4, 8), strict=True)]
    answers = [c.contains(point) for c in (first, second)]
    assert sorted(answers) == [False, True]
    rounded = [float(x) for x in point]
    assert [c.contains(rounded, accuracy=1e-15) for c in (first, second)] == answers
    assert not any(c.contains([float(x) + 1e-3 for x in point]) for c in (first, second))


def test_components_are_moved_and_projected_far_from_the_origin() -> None:
    whole = decomposed("spheres", 6)
    for component in whole.components:
        target = nag.Slice(np.eye(3)[:2], [float(b) * 1e6 + 0.25 for b in ORIGIN[:2]])
        there = witness_at(whole.system, component, target, seed=1)
        assert there.degree == 2 and there.errors.max() < 1e-15
        assert np.abs(there.points[:, :2] - target.b).max() < 1e-9
        image = project(whole.system, component, ["x", "y"], seed=1)
        assert (image.dimension, image.degree, image.fibre_degree) == (2, 1, 2)


def test_points_far_from_the_origin_are_sampled_to_many_digits() -> None:
    plain = nag.system(["(x^2 + y^2 + z^2 - 4)*(x - 1)", "x^2 + y^2 - 2*x"], "x y z")
    origin = tuple(-b * 10**6 for b in ORIGIN)
    system = NaturalCoordinates((Fraction(1),) * 3, origin).system(plain)
    whole = nag.decompose(system, seed=1)
    assert [(c.dimension, c.degree) for c in whole.components] == [(1, 1), (1, 1), (1, 4)]
    for component in whole.components:
        source = source_of_component(system, component)
        for found in samples(source, 3, np.random.default_rng(1), Run()):
            with flint.ctx.workdps(150):
                point = found.balls(60)
                values = [f(point, to_ball) for f in system.polynomials]
                sizes = [float(abs(z).upper()) for z in values]
            assert all(z.contains(0) for z in values)
            assert max(sizes) < 1e-40
            assert np.abs(found.x - [complex(z) for z in point]).max() < 1e-9


@pytest.mark.parametrize("exponent", [-20, -8, 8, 20])
def test_slices_move_to_parts_of_a_set_of_any_size(exponent: int) -> None:
    parabola = nag.decompose("y - x^2").components[0]
    size = 10.0**exponent
    small = nag.Slice(np.array([[0.6j, 1.0]]) * [size, 1.0], np.array([(0.8 - 0.3j) * size**2]))
    there = witness_at(parabola.system, parabola, small)
    assert there.degree == 2 and np.abs(there.points[:, 0]).max() < 10 * size
    back = witness_at(parabola.system, there, parabola.slice)
    for x in parabola.points:
        assert np.abs(back.points - x).max(axis=1).min() < 1e-12


@pytest.mark.parametrize("exponent", [5, 7])
def test_cylinders_meet_where_their_free_variables_have_their_common_origin(exponent: int) -> None:
    given = nag.system("(x^2 + y^2 - 1)*(y^2 + z^2 - 2)", "x y z")
    origin = tuple(Fraction(k * 10**exponent) for k in (1, -3, 2))
    there = NaturalCoordinates((Fraction(1),) * 3, origin).inverse.system(given)
    whole = nag.decompose(there)
    assert whole.complete and [c.degree for c in whole.components] == [2, 2]
    singular = singular_locus(whole)
    assert singular.complete and [s.points.shape for s in singular.sets] == [(4, 3)]
    for c in whole.components:
        assert c.sample(0, 2).shape == (2, 3)
