"""Solutions of every model are configurations of the mechanism: they satisfy all constraints."""

from fractions import Fraction
from pathlib import Path

import mpmath
import numpy as np
import pytest
from linkages import case, exact, four_bar, general_loop, newton, residual, spherical_four_bar

import nag
from nag.algebra.number import is_zero
from nag.mechanism.axes import dot
from nag.mechanism.graph import Joint, Mechanism
from nag.mechanism.model import formulations, model
from nag.mechanism.quaternion import conjugate, norm_squared, rotate

CASES = Path(__file__).parent.parent / "cases"


def error(m, lifted) -> float:
    return residual(m.unreduced, [complex(x) for x in m.unreduced_point(lifted)])


# Each with the dimension of its solution curves.
MECHANISMS = {
    "Bennett": (case("bennett"), 1),
    "Bricard": (case("bricard-cube"), 1),
    "6R": (general_loop(6, 4), 0),
    "7R": (general_loop(7, 2), 1),
    "planar": (four_bar((1, 1, 1), ((1, -1, 0), (1, 1, -2))), 1),
    "spherical": (spherical_four_bar(), 1),
}


def solutions(m, dimension, rng, wanted, real=False):
    """Solutions of the model's equations: along the reference's curve, or near random points.

    Newton's method alone would find points of norm zero, which have curves of their own.
    """
    found = []
    point = np.array([complex(x) for x in m.reference])
    for _ in range(200):
        if dimension == 1:
            for _ in range(8):
                point = _along_curve(m.system, point, rng, real)
            found.append(point)
        else:
            start = rng.normal(size=m.system.n) + 1j * rng.normal(size=m.system.n)
            solution = newton(m.system, start, np.empty((0, m.system.n)))
            if solution is not None:
                found.append(solution)
        found = [p for p in found if all(abs(f(list(p))) > 1e-3 for f in m.system.nonzero)]
        if len(found) == wanted:
            return found
    raise AssertionError(f"{len(found)} of {wanted} solutions were found")


def _along_curve(system, point, rng, real):
    """A step along the tangent, in a random complex direction, and back to the curve."""
    at = list(point)
    matrix = np.array([[g(at) for g in row] for row in system.jacobian], dtype=complex)
    tangent = np.linalg.svd(matrix)[2][-1].conj()
    if real:
        tangent = np.real(tangent / tangent[np.argmax(abs(tangent))])
    for size in 0.2 * 0.5 ** np.arange(8):
        angle = 0.0 if real else rng.uniform(-1, 1)
        step = newton(system, point + size * np.exp(1j * angle) * tangent, tangent.conj()[None])
        if step is not None and np.linalg.norm(step - point) < 2 * size:
            return step
    raise AssertionError("the curve is lost")


@pytest.mark.parametrize("formulation", ["H", "E"])
@pytest.mark.parametrize("name", MECHANISMS)
def test_solutions_lift_to_solutions_of_all_constraints(name, formulation):
    mechanism, dimension = MECHANISMS[name]
    m = model(mechanism, formulation)
    for point in solutions(m, dimension, np.random.default_rng(7), 3):
        assert error(m, m.lift(point)) < 1e-10


@pytest.mark.parametrize("name", ["Bennett", "Bricard", "7R", "planar", "spherical"])
def test_real_solutions_lift_to_real_configurations(name):
    mechanism, dimension = MECHANISMS[name]
    m = model(mechanism, "H")
    for point in solutions(m, dimension, np.random.default_rng(8), 3, real=True):
        lifted = m.lift(point)
        assert error(m, lifted) < 1e-10
        assert all(abs(np.imag(x)) < 1e-12 for a in lifted.euler.values() for x in a)


def test_half_turns_of_kept_and_eliminated_joints_lift():
    """Bennett's opposite joints turn alike, so J1 at half a turn takes eliminated J3 with it."""
    m = model(case("bennett"), "H")
    (equation,) = m.system.polynomials
    (k,) = m.form.charts.factors[0].charts
    x = 1 / k
    rest = equation([x, Fraction(0)])
    point = [x, -rest / (equation([x, Fraction(1)]) - rest)]
    assert equation(point) == 0
    angles = m.form.coordinates(point)
    assert [f.joint for f in m.form.closures[0].lost] == ["J3", "J0"]
    assert (angles["J1"][0][0], angles["J3"][0][0]) == (0, 0)
    assert error(m, m.lift(np.array(point, dtype=complex))) < 1e-14
    assert all(is_zero(v) for v in m.unreduced(m.unreduced_point(m.lift(point))))


def test_exact_points_lift_exactly():
    m = model(case("bennett"), "H")
    (equation,) = m.system.polynomials
    for x in (Fraction(2, 3), Fraction(-5, 4)):
        rest = equation([x, Fraction(0)])
        point = [x, -rest / (equation([x, Fraction(1)]) - rest)]
        lifted = m.lift(point)
        values = m.unreduced(m.unreduced_point(lifted))
        assert all(is_zero(v) for v in values)
        # Squares of Euler parameters are rational where norms are.
        for a in lifted.euler.values():
            assert is_zero(norm_squared(a) - 1)


def test_lift_keeps_the_precision_of_mpmath_points():
    m = model(case("bennett"), "H")
    (equation,) = m.system.polynomials
    with mpmath.workdps(50):
        x = mpmath.mpc("0.3", "0.8")

        def convert(c):
            return mpmath.mpf(c.numerator) / c.denominator

        rest = equation([x, mpmath.mpf(0)], convert)
        slope = equation([x, mpmath.mpf(1)], convert) - rest
        lifted = m.lift([x, -rest / slope])
        point = m.unreduced_point(lifted)
        assert all(abs(f(point, convert)) < 1e-45 for f in m.unreduced.polynomials)


@pytest.mark.parametrize("name", ["Bennett", "Bricard", "6R", "planar"])
def test_joints_stay_together(name):
    """The joint's point and axis are at the same place on both of its bodies."""
    mechanism, dimension = MECHANISMS[name]
    m = model(mechanism, "H")
    for point in solutions(m, dimension, np.random.default_rng(11), 2):
        lifted = m.lift(point)
        for joint in m.mechanism.joints:
            places, directions = [], []
            for body in joint.bodies:
                orientation = lifted.euler[body]
                reference = conjugate(m.mechanism.orientation(body))
                place = rotate(orientation, [complex(x) for x in rotate(reference, joint.point)])
                places.append(np.array(place) + np.array(lifted.position[body]))
                axis = rotate(orientation, [complex(x) for x in rotate(reference, joint.axis)])
                directions.append(np.array(axis))
            scale = 1 + max(np.linalg.norm(p) for p in places)
            assert np.linalg.norm(places[0] - places[1]) < 1e-10 * scale
            scale = np.linalg.norm(directions[0])
            assert np.linalg.norm(directions[0] - directions[1]) < 1e-10 * scale


def test_dangling_bodies_are_carried_along():
    base = case("planar-four-bar")
    tail = Joint("T", "revolute", ("B1", "X"), exact(5, 0, 0), exact(1, 0, 0))
    m = model(Mechanism("B0", (*base.joints, tail)), "E")
    assert m.space == "planar"
    assert [j.name for j in m.cut] == ["T"]
    assert "cut off" in m.reason
    lifted = m.lift(m.reference)
    assert lifted.euler["X"] == (1, 0, 0, 0)
    turned = model(base, "E")
    full = {"B1": exact(-1, 0), "B2": exact(1, 0), "B3": exact(-1, 0)}
    point = [x for b in turned.structure.moving for x in full[b]]
    point = [point[i] for i in m.form.elimination.kept]
    lifted = m.lift(point)
    assert lifted.euler["X"] == lifted.euler["B1"]
    assert lifted.position["X"] == lifted.position["B1"] == (4, 0, 0)


def test_positions_follow_from_the_displacement_of_the_reference_point():
    m = model(case("planar-four-bar"), "E")
    c, s = Fraction(3, 5), Fraction(4, 5)
    turns = {"B1": (c, s), "B2": exact(1, 0), "B3": (c, s)}
    full = [x for b in m.structure.moving for x in turns[b]]
    lifted = m.lift([full[i] for i in m.form.elimination.kept])
    # B1 turns about (2, 0): the origin goes to (2, 0) - 2 (c, s).
    assert all(
        is_zero(x - y)
        for x, y in zip(lifted.position["B1"], (2 - 2 * c, -2 * s, Fraction(0)), strict=True)
    )
    assert dot(lifted.position["B3"], lifted.position["B3"]) == 0


def test_a_point_with_the_wrong_number_of_coordinates_is_refused():
    m = model(case("bennett"), "H")
    with pytest.raises(ValueError, match="3 coordinates, the model 2"):
        m.lift([0.0, 1.0, 2.0])


@pytest.mark.parametrize("name", ["spatial/rssr", "bennett", "spatial/rccc", "planar/oldham"])
def test_many_points_are_lifted_as_each_of_them(name) -> None:
    mechanism = nag.read_case(CASES / f"{name}.toml").mechanism
    rng = np.random.default_rng(0)
    for formulation in formulations(mechanism):
        made = model(mechanism, formulation)
        near = np.array([float(x) for x in made.reference])
        points = near + 0.05 * rng.standard_normal((6, len(near)))
        many = made.lift([points[:, i] for i in range(len(near))])
        for k, point in enumerate(points):
            one = made.lift(list(point))
            for body in one.euler:
                for a, b in ((one.euler, many.euler), (one.position, many.position)):
                    each = [np.broadcast_to(x, 6)[k] for x in b[body]]
                    near_by = np.abs(np.array(a[body], dtype=complex) - each).max()
                    # Of turns in the plane the root and the angle differ off the curve.
                    assert near_by < (0.2 if made.space == "planar" else 1e-14)
