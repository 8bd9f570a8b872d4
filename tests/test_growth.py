"""The component through a regular point, grown from there."""

from __future__ import annotations

import numpy as np
import pytest

import nag
from nag.algebra.evaluation import Evaluator
from nag.decomposition.growth import grow_component, leave_singular_point
from nag.mechanism.problem import problem_of
from nag.numerics.local_dimension import local_dimension
from nag.tracking.evaluations import PREPARATION, count, count_evaluations
from nag.witness.witness import Status

# Equations, a regular point, the dimension there, and the degree of the component through it.
COMPONENTS = {
    "a line beside a circle": (["(x^2 + y^2 - 1)*(x - 2*y)"], (2, 1), 1, 1),
    "a circle beside a line": (["(x^2 + y^2 - 1)*(x - 2*y)"], (0.6, 0.8), 1, 2),
    "a twisted cubic, overdetermined": (["x*z - y^2", "y - x^2", "z - x*y"], (2, 4, 8), 1, 3),
    "a surface": (["x*y*z - 1", "w - x^2 - y"], (1, 1, 1, 2), 2, 5),
    "a curve beside a plane": (["x*(x^3 + y^3 - 9*z)", "x*(x^2 - z^2)"], (1, 2, 1), 1, 3),
}


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("name", sorted(COMPONENTS))
def test_all_points_are_found_from_one(name: str, seed: int) -> None:
    equations, point, dimension, degree = COMPONENTS[name]
    system = nag.system(equations)
    grown = grow_component(system, np.array(point), dimension, seconds=10.0, seed=seed)
    assert (grown.degree, grown.least, grown.reason) == (degree, degree, "")
    assert (grown.component.dimension, grown.component.degree) == (dimension, degree)


def test_what_is_not_afforded_is_bounded_from_below() -> None:
    system = nag.system(["x^4 + y^4 + z^4 - 18", "x*y + y*z + z*x - 5"])
    at = np.array([1, 1, 2])
    found = [grow_component(system, at, 1, seconds=s) for s in (0.0, 0.001, 10.0)]
    assert [growth.least for growth in found] == sorted(growth.least for growth in found)
    assert found[0].least == 1 and found[-1].degree == 8
    part = found[0]
    assert part.degree is None and part.component is None and part.reason


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize(
    ("name", "degree"), [("spatial/rccc", 14), ("spatial/octahedron-line-symmetric", 12)]
)
def test_points_that_few_loops_move_are_found_as_well(name: str, degree: int, seed: int) -> None:
    """One of the points stays where it is on most loops; a trace says that it is missing."""
    found = nag.mobility(nag.read_case(f"cases/{name}.toml"), seed=seed)
    assert found.components == ((1, degree),)


def sarrus_row(count: int) -> nag.Mechanism:
    """Sarrus linkages on top of each other, the plate of each the base of the next."""
    joints = []
    for k in range(count):
        places = {"a": ((0, 1, 0), (1, 0), (3, 0)), "b": ((1, 0, 0), (0, 1), (0, 3))}
        for leg, (axis, near, far) in places.items():
            links = (f"p{k}", f"low_{leg}{k}", f"high_{leg}{k}", f"p{k + 1}")
            for i, place in enumerate((near, far, near)):
                point = (*place, 2 * k + i)
                name = f"{leg}{i}_{k}"
                joints.append(nag.Joint(name, "revolute", links[i : i + 2], point, axis))
    return nag.Mechanism("p0", tuple(joints))


@pytest.mark.parametrize("seed", [0, 3, 4])
def test_a_product_is_grown_factor_by_factor(seed: int) -> None:
    problem = problem_of(sarrus_row(3))
    point = np.array(problem.reference, dtype=float)
    grown = grow_component(problem.system, point, 3, seconds=10.0, seed=seed)
    assert grown.degree == 125 == grown.component.degree
    assert grown.component.status is Status.IRREDUCIBLE
    evaluator = Evaluator.of(problem.system.polynomials, problem.system.n)
    assert evaluator.residuals(grown.component.points).max() < 1e-12


def test_points_in_a_product_are_not_grown() -> None:
    system = nag.system(["x^2 - 2", "y^2 + z^2 - 1", "w^3 - w"], variables="x y z w")
    grown = grow_component(system, np.array([2**0.5, 0.6, 0.8, 1.0]), 1, seconds=10.0)
    assert (grown.dimension, grown.degree, grown.component) == (1, 2, None)


def tied(system: nag.PolynomialSystem) -> nag.PolynomialSystem:
    """The same equations, with one variable more that holds the sum of all others."""
    n = system.n + 1
    *others, last = nag.Polynomial.variables(n)
    rows = [f.with_variables(n, range(n - 1)) for f in system.polynomials]
    return nag.PolynomialSystem((*system.variables, "s"), (*rows, last - sum(others, last * 0)))


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0, 3, 4])
def test_no_point_of_another_component_is_counted(seed: int) -> None:
    """Each linkage has two curves of degree 5, and with default settings paths jump to the other.

    As one system; seeds are such on which they did, without the variable that ties them.
    """
    problem = problem_of(sarrus_row(3))
    point = np.array([float(x) for x in problem.reference])
    point = np.append(point, point.sum())
    grown = grow_component(tied(problem.system), point, 3, seconds=10.0, seed=seed)
    assert grown.least <= 125 and grown.degree in (None, 125)


def test_what_is_made_ready_counts_once() -> None:
    system = nag.system(["x*y*z - 1", "w - x^2 - y"])
    with count_evaluations() as whole:
        grown = grow_component(system, np.array([1, 1, 1, 2]), 2, seconds=10.0)
    with count_evaluations() as nothing:
        grow_component(system, np.array([1, 1, 1, 2]), 2, seconds=0.0)
    assert grown.degree == 5
    # The cut and that of the trace, in doubles and in twice the digits at most.
    assert nothing.once == 0 < whole.once <= 4 * PREPARATION


def test_work_in_more_digits_counts_for_more_and_inside_counts_outside() -> None:
    with count_evaluations() as outer:
        with count_evaluations() as inner:
            count(2)
            count(3, words=2)
        count(1)
    assert (inner.number, outer.number) == (5, 6)
    assert outer.work - inner.work == 1 and inner.work > 5


# Surfaces singular at the origin, and whether their tangent cone is irreducible.
SINGULAR = {
    "a cone": ("x^2 + 2*y^2 - z^2 + x^3", True),
    "a cubic cone": ("x^3 + y^3 + z^3 + 5*x*y*z + z^4", True),
    "the lines of a cubic's flexes": ("x^3 + y^3 + z^3 - 3*x*y*z + z^4", False),
    "two planes": ("x*y", False),
    "one sheet whose cone is two planes": ("x*y + z^3", False),
    "two complex planes, bent": ("x^2 + y^2 + z^3", False),
    "a double plane": ("x^2 - y^2*z", False),
    "two surfaces": ("(x^2 + y*z)*(x + y - z + z^2)", False),
}


@pytest.mark.parametrize("name", sorted(SINGULAR))
def test_a_singular_point_is_left_where_its_tangent_cone_shows_one_component(name: str) -> None:
    text, irreducible = SINGULAR[name]
    system = nag.system([text, "w^2 + w - 3*x"], "w x y z")
    local = local_dimension(system, (0, 0, 0, 0))
    assert (local.tangent_dimension, local.dimension) == (3, 2)
    for seed in range(3):
        beside = leave_singular_point(system, (0,) * 4, local, np.random.default_rng(seed))
        assert (beside is not None) is irreducible
        if beside is not None:
            evaluator = Evaluator.of(system.polynomials, 4)
            assert evaluator.residuals(beside[None]).max() < 1e-14
            assert np.linalg.matrix_rank(evaluator.jacobian(beside), 1e-9) == 2


def test_an_equation_that_cuts_a_curve_from_a_cone_shows_no_component() -> None:
    # The cone's equation times others: a line and the origin are left.
    system = nag.system(["(x^2 + y^2 - z^2)*x", "(x^2 + y^2 - z^2)*y", "(x^2 + y^2 - z^2)*z"])
    local = local_dimension(system, (0, 0, 0))
    assert leave_singular_point(system, (0, 0, 0), local, np.random.default_rng(0)) is None
