from fractions import Fraction

import numpy as np
import pytest
from linkages import case, exact, four_bar, general_loop, loop, residual, spherical_four_bar

from nag import decompose
from nag.bench.chains import BENNETT, CHAINS, attach_cell, ring
from nag.mechanism.axes import skew
from nag.mechanism.graph import Mechanism
from nag.mechanism.model import ModelError, model


def test_bennett_is_one_bilinear_equation():
    system = model(case("bennett"), "H").system
    (equation,) = system.polynomials
    assert system.n == 2
    assert equation.degree_in([0]) == equation.degree_in([1]) == 1
    assert (1, 1) in equation.terms


def test_bricards_cube_is_four_multilinear_equations_in_four_unknowns():
    system = model(case("bricard-cube"), "H").system
    assert (system.n, len(system.polynomials)) == (4, 4)
    assert all(f.degree_in([i]) <= 1 for f in system.polynomials for i in range(4))


@pytest.mark.parametrize("joints", [5, 6, 7])
def test_a_general_loop_is_four_multilinear_equations(joints):
    m = model(general_loop(joints, 3), "H")
    assert m.system.n == joints - 2
    assert len(m.system.polynomials) == 4
    for f in m.system.polynomials:
        assert f.degree == joints - 2
        assert all(f.degree_in([i]) == 1 for i in range(joints - 2))
    assert m.system.groups == tuple((i,) for i in range(joints - 2))


def test_path_bound_of_a_general_6r_is_24():
    assert model(general_loop(6, 3), "H").path_bound == 24


def test_the_eliminated_axes_are_skew_where_there_are_skew_neighbours():
    for mechanism in (case("bennett"), case("bricard-cube"), general_loop(6, 5)):
        (closure,) = model(mechanism, "H").form.closures
        joints = {j.name: j for j in mechanism.joints}
        assert skew(*(joints[f.joint] for f in closure.lost))
        assert not closure.quadric


def test_points_of_norm_zero_are_plus_and_minus_i_for_unit_axes():
    for f in model(case("bennett"), "H").system.nonzero:
        assert sorted(f.terms.values()) == [1, 1]
        assert f([1j, 1j]) == 0 == f([-1j, -1j])


def test_points_of_norm_zero_for_axes_without_rational_unit_vector():
    m = model(general_loop(6, 3), "H")
    for i, f in enumerate(m.system.nonzero):
        assert f.support == {i}
        assert f.degree == 2
        # The root, put into the joint's norm c^2 + N s^2.
        coefficients = [complex(f.terms.get(e, 0)) for e in _powers(m.system.n, i)]
        root = np.roots(coefficients[::-1])[0]
        factor = m.form.charts.factors[i]
        k = complex(factor.charts[0])
        (joint,) = (j for j in m.mechanism.joints if j.name == factor.joint)
        axis = np.array([float(x) for x in joint.axis])
        axis /= np.gcd.reduce([int(x) for x in axis])
        if round(np.linalg.norm(axis)) ** 2 == axis @ axis:
            axis = axis / np.linalg.norm(axis)
        c, s = 1 - k * root, k + root
        assert abs(c * c + (axis @ axis) * s * s) < 1e-12


def _powers(n, i):
    return [tuple(p if j == i else 0 for j in range(n)) for p in range(3)]


def test_charts_leave_out_different_points_and_none_of_a_special_angle():
    factors = model(general_loop(7, 2), "H").form.charts.factors
    charts = [k for factor in factors for k in factor.charts]
    assert len({abs(k) for k in charts}) == len(charts)
    assert not {abs(k) for k in charts} & {Fraction(0), Fraction(1)}


def test_axes_that_meet_or_are_parallel_need_a_quadric():
    for mechanism in (four_bar(), spherical_four_bar()):
        (equation,) = model(mechanism, "H").system.polynomials
        assert [equation.degree_in([i]) for i in range(2)] == [2, 2]


def test_planar_four_bar_splits_into_two_curves_of_bidegree_1_1():
    m = model(four_bar(), "H")
    (equation,) = m.system.polynomials
    # For generic x the other coordinate has two rational values: no square root is needed.
    for x in (Fraction(2, 7), Fraction(-9, 5), Fraction(31, 3)):
        a, b, c = (
            sum(
                (value * x ** e[0] for e, value in equation.terms.items() if e[1] == power),
                Fraction(0),
            )
            for power in (2, 1, 0)
        )
        discriminant = b * b - 4 * a * c
        root = Fraction(
            round(float(discriminant.numerator) ** 0.5),
            round(float(discriminant.denominator) ** 0.5),
        )
        assert root * root == discriminant


def test_half_angles_refuse_what_they_do_not_cover():
    hinges = loop([(0, 0, 0), (0, 0, 1)], [(0, 0, 1), (0, 1, 1)])
    with pytest.raises(ModelError, match="at least 3 joints"):
        model(hinges, "H")
    door = loop([(0, 0, 0), (0, 0, 1), (0, 0, 2)], [(0, 0, 1)] * 3)
    with pytest.raises(ModelError, match="coincide"):
        model(door, "H")


def test_reading_the_loop_from_another_body_changes_nothing_of_the_lift():
    """The cube with each body as ground in turn: the same relative turns solve every model."""
    first = case("bricard-cube")
    for ground in ("B1", "B4"):
        m = model(Mechanism(ground, first.joints, first.bodies), "H")
        assert set(m.system(m.reference)) == {0}
        lifted = m.lift(m.reference)
        assert lifted.euler[ground] == first.orientation(ground)
        assert lifted.euler["B3"] == exact(0, 0, 0, 1)


def bennett_star() -> Mechanism:
    """A Bennett linkage, at each of whose joints another one is."""
    joints = list(ring(0, BENNETT, ("b0", "b1", "b2", "b3"), 0))
    for k in range(4):
        others = (f"b{k}", f"x{k}", f"y{k}", f"b{(k - 1) % 4}")
        joints += ring(k + 1, attach_cell(BENNETT, BENNETT[k]), others, 1)
    return Mechanism("b0", tuple(joints))


@pytest.mark.parametrize("n", [2, 3, 4])
def test_a_row_of_bennett_linkages_is_a_curve_linear_in_each_half_angle(n):
    m = model(CHAINS["bennett-loops"].make(n))
    assert (m.formulation, m.system.n) == ("H", 2 * n - 1)
    (curve,) = decompose(m).components
    assert (curve.dimension, curve.degree, curve.multiplicity) == (1, 2 * n - 1, 1)
    assert list(curve.multidegree) == [1] * (2 * n - 1)


def test_a_loop_whose_joints_are_all_those_of_others_eliminates_nothing():
    m = model(bennett_star())
    assert sorted(len(c.lost) for c in m.form.closures) == [0, 2, 2, 2, 2]
    answer = decompose(m)
    assert answer.complete
    assert [(c.dimension, c.degree) for c in answer.components] == [(1, 8)]


@pytest.mark.parametrize("mechanism", [CHAINS["bennett-loops"].make(3), bennett_star()])
def test_loops_with_few_joints_of_their_own_lift_to_all_constraints(mechanism):
    m = model(mechanism, "H")
    (curve,) = decompose(m).components
    for point in curve.points:
        full = m.unreduced_point(m.lift(list(point)))
        assert residual(m.unreduced, full) < 1e-12
