"""Constraints for equations of motion are independent along the chosen component."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

import nag
from nag.algebra.evaluation import Evaluator

CASES = Path(__file__).parent.parent / "cases"
# Of half-angles: beyond this a joint is next to half a turn.
FAR = 100
CIRCLE = nag.decompose(["x^2 + y^2 = 1", "x*(x^2 + y^2 - 1)"]).components[0].constraints()


def along(name: str) -> tuple[nag.WitnessSet, object, np.ndarray, np.ndarray]:
    """The component, its model, and points of its motion in its own and in all coordinates."""
    model = nag.model(nag.read_case(CASES / f"{name}.toml").mechanism)
    (component,) = nag.decompose(model).components
    curve = nag.find_real_curve(component)
    assert curve.complete
    own = np.vstack([edge.points[::9] for edge in curve.edges])
    own = own[np.abs(own).max(axis=1) < FAR]
    whole = [np.array(model.unreduced_point(model.lift(x)), dtype=complex) for x in own]
    assert np.abs(np.imag(whole)).max() < 1e-12
    return component, model, own, np.real(whole)


@pytest.mark.parametrize(
    ("name", "equations", "unknowns", "rank", "least"),
    [("bennett", 23, 21, 20, 0.05), ("bricard-cube", 35, 35, 34, 0.02)],
)
def test_constraints_are_independent_where_those_of_the_joints_are_not(
    name: str, equations: int, unknowns: int, rank: int, least: float
) -> None:
    component, model, own, whole = along(name)
    assert len(own) > 10
    given = Evaluator.of(model.unreduced.polynomials, unknowns)
    chosen = component.constraints(model.unreduced)
    assert (chosen.count, len(model.unreduced.polynomials)) == (rank, equations)
    for x in whole:
        sizes = np.linalg.svd(given.jacobian(x).real, compute_uv=False)
        assert sizes[rank:].max() < 1e-11
        slopes = chosen.jacobian(x)
        assert slopes.shape == (rank, unknowns)
        assert np.linalg.svd(slopes, compute_uv=False).min() > least
        assert np.abs(chosen.values(x)).max() < 1e-11
    plain = component.constraints()
    for x in own:
        assert np.linalg.matrix_rank(plain.jacobian(x)) == plain.count == len(x) - 1


@given(st.floats(-3, 3), st.floats(-10, 10))
def test_accelerations_do_not_depend_on_how_equations_are_combined(
    turn: float, speed: float
) -> None:
    x = np.array([np.cos(turn), np.sin(turn)])
    v = speed * np.array([-x[1], x[0]])
    slopes = CIRCLE.jacobian(x)
    # The shortest one is towards the centre.
    acceleration = -np.linalg.pinv(slopes) @ CIRCLE.curvature(x, v)
    assert np.abs(acceleration + speed**2 * x).max() <= 1e-13 * (1 + speed**2)


def test_bennett_moves_freely_with_its_energy() -> None:
    model = nag.model(nag.read_case(CASES / "bennett.toml").mechanism)
    (component,) = nag.decompose(model).components
    constraints = component.constraints(model.unreduced)
    start = np.array(model.unreduced_point(model.lift(model.reference)), dtype=float)
    masses = np.tile([4.0, 4, 4, 4, 1, 1, 1], 3)
    tangent = np.linalg.svd(constraints.jacobian(start))[2][-1]

    def motion(t: float, state: np.ndarray) -> np.ndarray:
        x, v = np.split(state, 2)
        slopes = constraints.jacobian(x)
        reactions = np.linalg.solve(slopes / masses @ slopes.T, constraints.curvature(x, v))
        return np.concatenate([v, -(slopes.T @ reactions) / masses])

    state = np.concatenate([start, tangent])
    path = solve_ivp(motion, (0, 3), state, method="DOP853", rtol=1e-10, atol=1e-12)
    places, velocities = np.split(path.y, 2)
    energy = (masses[:, None] * velocities**2).sum(axis=0) / 2
    assert path.success
    assert np.linalg.norm(places[:, -1] - start) > 1
    assert np.ptp(energy) < 1e-9 * energy[0]
    assert np.abs(constraints.values(places[:, -1])).max() < 1e-9


def test_where_the_rank_drops_constraints_are_refused() -> None:
    curve = nag.decompose("(x^2 + y^2)^2 = 2*(x^2 - y^2)").components[0]
    constraints = curve.constraints()
    assert constraints.jacobian([np.sqrt(2), 0]).shape == (1, 2)
    with pytest.raises(nag.ComponentError, match="rank 1 of the equations is not certain"):
        constraints.jacobian([0, 0])


def test_a_component_of_another_dimension_than_the_equations_have_there_is_refused() -> None:
    circle, system = (
        nag.decompose("x^2 + y^2 = 1").components[0],
        nag.system(["x^2 + y^2 - 1", "x"]),
    )
    with pytest.raises(nag.ComponentError, match="singular, not on the component"):
        circle.constraints(system).values([0, 1])


@pytest.mark.parametrize("point", [[1.0], [[1.0, 0.0]], [1j, 0.0], ["1", "0"]])
def test_what_is_no_point_is_refused(point: object) -> None:
    with pytest.raises(nag.NagError, match="point: give 2 real numbers"):
        CIRCLE.values(point)


def test_a_component_that_is_not_reduced_is_refused_or_its_simple_equations_are_taken() -> None:
    double = nag.decompose("(x^2 + y^2 - 1)^2").components[0]
    assert double.constraints().jacobian([0.6, 0.8]).shape == (1, 2)
    (line,) = nag.decompose(["x^2 + y^2 - z", "x^2 + y^2 + z^3 - z"]).components[:1]
    with pytest.raises(nag.ComponentError, match="is not reduced"):
        line.constraints()


@pytest.mark.parametrize("away", [0, 100, 7000])
def test_constraints_do_not_depend_on_where_a_mechanism_is(away: int) -> None:
    bodies = ["ground", "crank", "coupler", "rocker"]
    pins = [(0, 0), (1, 0), (3, 2), (4, 0)]
    joints = [
        nag.Joint(name, "revolute", (bodies[k - 1], bodies[k]), (x + away, y - away, 0), (0, 0, 1))
        for k, (name, (x, y)) in enumerate(zip("ABCD", pins, strict=True))
    ]
    model = nag.model(nag.Mechanism("ground", tuple(joints)), formulation="E")
    (component,) = nag.decompose(model).components
    chosen = component.constraints(model.unreduced)
    x = np.array(model.unreduced_point(model.lift(model.reference)), dtype=float)
    slopes = chosen.jacobian(x)
    assert slopes.shape == (chosen.count, len(x))
    tangent = np.linalg.svd(slopes)[2][-1]
    for step in (1e-5, -1e-5):
        assert np.linalg.norm(chosen.values(x + step * tangent)) < 1e-8
