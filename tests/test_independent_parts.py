"""Systems that fall apart by their variables: components are products."""

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
from linkages import case
from systems import system

import nag
from nag.algebra.evaluation import Evaluator
from nag.algebra.symmetry import SignedPermutation
from nag.decomposition.decompose import decompose
from nag.decomposition.independent_parts import independent_variables
from nag.mechanism.graph import Mechanism
from nag.mechanism.model import model
from nag.questions import check_traces
from nag.witness.frame import expand_orbits


def kinds(answer) -> Counter:
    counts: Counter = Counter()
    for c in answer.components:
        counts[c.dimension, c.degree, c.multiplicity] += c.orbit
    return counts


def test_variables_that_occur_together_stay_together():
    f = system("a b c d e", "a*b - 1", "c^2 + d^2 - 1")
    assert independent_variables(f) == [(0, 1), (2, 3), (4,)]


@pytest.mark.parametrize(
    ("equations", "expected"),
    [
        # A circle and a parabola; each pair of lines and a circle; a cone and two points.
        (("a^2 + b^2 - 1", "c - d^2"), {(2, 4, 1): 1}),
        (("(a - b)*(a + 2*b - 1)", "c^2 + d^2 - 1"), {(2, 2, 1): 2}),
        (("a^2 + b*c", "d^2 - 2"), {(2, 2, 1): 2}),
        (("a^2 - 2", "b^2 - a - b", "c*d - 1"), {(1, 2, 1): 4}),
        (("(a^2 - b)^2", "c^2 + d^2 - 1"), {(2, 4, 2): 1}),
        (("a^2 + 1", "b^2 + 1", "c^2 + 1", "d^2 + 1"), {(0, 1, 1): 16}),
    ],
)
def test_components_are_the_products_of_the_parts_components(equations, expected):
    answer = decompose(system("a b c d", *equations))
    assert answer.complete
    assert kinds(answer) == expected


def test_symmetries_of_the_parts_make_orbits_of_the_products():
    f = system("a b c d", "(a^2 - 2)*(b - 3)", "c^2 - b*0 - 5", "d^2 - c")
    signs = [SignedPermutation.of_signs((-1, 1, 1, 1))]
    assert kinds(decompose(f, symmetries=signs)) == kinds(decompose(f))


@pytest.mark.parametrize(
    ("formulation", "expected"),
    [("H", {(2, 4, 1): 4}), ("E", {(2, 4, 1): 1, (2, 8, 1): 2, (2, 16, 1): 1})],
)
def test_loops_that_hang_together_in_the_ground_move_independently(formulation, expected):
    """Two parallelograms, each with the components of degrees 2 and 4 (in half-angles 2 and 2)."""
    one = case("planar-four-bar")
    joints = [
        replace(
            j, name=j.name + tag, bodies=tuple(b if b == one.ground else b + tag for b in j.bodies)
        )
        for tag in ("", "_too")
        for j in one.joints
    ]
    m = model(Mechanism(one.ground, tuple(joints)), formulation)
    answer = decompose(m.system, symmetries=m.symmetries)
    assert answer.complete
    assert kinds(answer) == expected


@pytest.mark.parametrize(
    ("equations", "method"),
    [
        (("x^2 + y^2 - 1", "z^2 - x^2 - 2", "u^2 + v^2 - 3"), "by_variables"),
        (("(x - y)*(x^2 + y^2 - z)",), "by_branches"),
        (("x^2 + y^2 - z^2 - 1", "u - x - y"), "one_equation"),
        (("y - x^2", "z - x^3"), "rational_curve"),
        (("x^2 + y*z - 1", "y^2 + x*z - 2", "z^2 + x*y - x - 3"), "all_at_once"),
        (("x^2 + y^2 + z^2 - 1", "x*y + z - u^2"), "one_by_one"),
    ],
)
def test_answers_name_the_method_that_made_them(equations, method):
    names = "xyzuv" if "v" in "".join(equations) else "xyzu" if "u" in "".join(equations) else "xyz"
    answer = decompose(system(" ".join(names), *equations))
    assert answer.complete and answer.method == method


def test_products_carry_all_that_other_components_do():
    """A circle and a twisted cubic whose variables are mixed."""
    mixed = system("a u b v w", "a^2 + b^2 - 1", "v - u^2", "w - u^3")
    (whole,) = decompose(mixed).components
    assert (whole.dimension, whole.degree, whole.multiplicity, whole.corank) == (2, 6, 1, 2)
    assert whole.errors.max() < 1e-15
    points = nag.sample(decompose(mixed), count=5).points
    assert np.abs(points[:, 3] - points[:, 1] ** 2).max() < 1e-8
    assert whole.contains(["3/5", 2, "4/5", 4, 8]) and not whole.contains(["3/5", 2, "4/5", 4, 9])
    assert nag.certify(decompose(mixed))
    assert check_traces(decompose(mixed)).complete
    met = nag.intersect("(a^2 + b^2 - 1)*(a - b)", 1, 2)
    assert met.components[0].dimension == 0


@pytest.mark.parametrize(
    ("groups", "expected"),
    [
        # A conic has 2 points over a line; the cubic has 3 with c fixed, and one with d fixed.
        ([["a", "b"], ["c"], ["d"]], {(0, 1): 6, (0, 2): 2}),
        ([["a", "b"], ["c", "d"]], {(0, 1): 6}),
        ([["a"], ["b"], ["c", "d"]], {(0, 2): 6, (1, 2): 6}),
    ],
)
def test_so_many_groups_are_fixed_of_each_factor_as_its_dimension(groups, expected):
    equations = ["a^2 + b^2 - a*b - 1", "c - d^3 - 2*d"]
    (whole,) = decompose(nag.system(equations, variables="a b c d", groups=groups)).components
    wanted = np.zeros((len(groups), len(groups)), dtype=int)
    for (i, j), degree in expected.items():
        wanted[i, j] = wanted[j, i] = degree
    assert np.array_equal(whole.multidegree, wanted)


def test_images_of_products_are_components():
    equations = ("a^2 - 2*b^2", "c^4 - 4*d^2", "b - e^2")
    signs = [
        SignedPermutation.of_signs((-1, 1, 1, 1, 1)),
        SignedPermutation.of_signs((1, 1, 1, -1, 1)),
    ]
    f = system("a b c d e", *equations)
    answer = decompose(f, symmetries=signs)
    everything = expand_orbits(answer).components
    assert (
        len(everything) == sum(c.orbit for c in answer.components) == len(decompose(f).components)
    )
    evaluator = Evaluator.of(f.polynomials, f.n)
    for component in everything:
        assert evaluator.residuals(component.points).max() < 1e-14
        assert (
            np.abs(component.slice.A @ component.points.T - component.slice.b[:, None]).max()
            < 1e-12
        )
        assert sum(len(fibre) for fibre in component.fibres) == component.degree


@pytest.mark.parametrize("equations", [["y", "1"], ["x^2 - 1", "y^2 - 2", "1 - 2"], ["3", "0"]])
def test_an_equation_that_is_a_number_has_no_solutions(equations):
    answer = decompose(nag.system(equations, variables="x y"))
    assert answer.complete and not answer.components
    assert not nag.solve(nag.system(equations, variables="x y")).solutions


def test_an_equation_that_is_zero_says_nothing():
    answer = decompose(nag.system(["x^2 - 1", "0"], variables="x y"))
    assert kinds(answer) == Counter({(1, 1, 1): 2})
