"""Where steps lead, and how long they are, by the sources of the kernel in plain Python."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pytest

from nag.machine_code import plain
from nag.machine_code.lanes import LANES, aligned_zeros
from nag.machine_code.records import Reals
from nag.tracking.numbers.doubles import DOUBLES, ComplexDoubles
from nag.tracking.predictor import CORRECT, PREDICT, estimate_radius, next_step, next_t, predict

ORDER = 4
LANE = 3


class Point(NamedTuple):
    """One coordinate, and what the predictor reads and writes."""

    N: int
    base: Reals
    ahead: Reals
    mode: Reals
    slots: Reals

    @property
    def point(self) -> np.ndarray:
        """The coordinate in each lane."""
        return self.slots[:LANES] + 1j * self.slots[LANES:]


def series(radius: complex) -> Point:
    """The path ``1 / (1 - h / radius)``, which Pade's approximant is exact for."""
    base = aligned_zeros(2 * (ORDER + 1))
    for k in range(ORDER + 1):
        coefficient = radius ** -float(k)
        base[LANES * 2 * k : LANES * (2 * k + 1)] = coefficient.real
        base[LANES * (2 * k + 1) : LANES * (2 * k + 2)] = coefficient.imag
    return Point(1, base, aligned_zeros(1), aligned_zeros(1), aligned_zeros(2))


def predicts(z: ComplexDoubles, p: Point) -> None:
    predict(z, p, p, 4)


@pytest.mark.parametrize("radius", [2.0 + 0.0j, -3.0 + 0.0j, 1.0 - 2.0j, 1.5j])
def test_a_path_with_one_pole_is_predicted_exactly_half_way_to_it(radius: complex) -> None:
    point, steps = series(radius), 0.5 * abs(radius) * np.linspace(-1, 1, LANES)
    point.ahead[:] = steps
    plain.run(predicts, point, constants=(DOUBLES,))
    assert np.abs(point.point - 1 / (1 - steps / radius)).max() < 1e-14


def test_close_to_the_pole_the_taylor_polynomial_is_taken() -> None:
    point = series(1.0 + 0.0j)
    point.ahead[:] = 0.9
    plain.run(predicts, point, constants=(DOUBLES,))
    expected = sum(0.9**k for k in range(ORDER + 1))
    assert np.abs(point.point - expected).max() < 1e-14 and not point.point.imag.any()


def test_lanes_that_do_not_predict_stay_where_they_are() -> None:
    point = series(2.0 + 0.0j)
    point.mode[:] = [CORRECT, PREDICT] * 4
    point.slots[:LANES], point.ahead[:] = 7.0, 1.0
    plain.run(predicts, point, constants=(DOUBLES,))
    found = point.point
    assert (found[::2] == 7.0).all() and np.abs(found[1::2] - 2.0).max() < 1e-14


def norms(radius: float, order: int) -> np.ndarray:
    """Squared norms of the corrections, which do not matter, and of a series' coefficients."""
    values = aligned_zeros(order + 2)
    for k in range(1, order + 1):
        values[LANES * (k + 1) : LANES * (k + 2)] = radius ** (-2.0 * k)
    return values


class Steps(NamedTuple):
    """What the kernel keeps of the lanes."""

    norms: Reals
    radius: Reals
    t: Reals
    ahead: Reals
    here: Reals
    goal: Reals
    h: Reals
    taken_h: Reals
    growth: Reals
    seen_t: Reals
    seen_radius: Reals


def steps(radius: float = 1.0, **lane: float) -> Steps:
    made = Steps(norms(radius, ORDER), *(aligned_zeros(1) for _ in Steps._fields[1:]))
    made.radius[:] = radius
    for name, value in lane.items():
        getattr(made, name)[LANE] = value
    return made


def estimates_radius(made: Steps) -> None:
    estimate_radius(made, ORDER)


@pytest.mark.parametrize("radius", [1e-3, 0.5, 40.0])
def test_the_radius_is_that_of_a_geometric_series(radius: float) -> None:
    made = steps(radius)
    made.radius[:] = 0.0
    plain.run(estimates_radius, made)
    assert made.radius == pytest.approx(radius, rel=1e-12)


def test_a_polynomial_converges_everywhere() -> None:
    made = steps()
    made.norms[LANES * (ORDER + 1) :] = 0.0
    plain.run(estimates_radius, made)
    assert (made.radius == 1e6).all()


def test_a_step_is_as_long_as_the_next_term_allows() -> None:
    # The term of order 5 is (h / 2)^5.
    made = steps(radius=2.0)
    next_step(made, ORDER, LANE, 1e-5, 0.9)
    assert made.h[LANE] == pytest.approx(0.2, rel=1e-12)


def test_a_step_stays_inside_the_radius_and_grows_by_what_was_found() -> None:
    made = steps(radius=2.0)
    next_step(made, ORDER, LANE, 1.0, 0.5)
    assert made.h[LANE] == pytest.approx(1.0, rel=1e-12)
    made = steps(radius=2.0, taken_h=0.1, growth=3.0)
    next_step(made, ORDER, LANE, 1e-5, 0.9)
    assert made.h[LANE] == pytest.approx(0.3, rel=1e-12)


def test_branch_points_that_are_seen_from_further_on_bound_a_step_until_they_are_passed() -> None:
    made = steps(radius=2.0, here=0.75, seen_t=0.5, seen_radius=0.05, taken_h=0.1, growth=4.0)
    next_step(made, ORDER, LANE, 1e-5, 0.5)
    assert made.h[LANE] == pytest.approx(0.15, rel=1e-12)
    made = steps(radius=2.0, here=0.5, seen_t=0.5, seen_radius=0.05, taken_h=0.1, growth=4.0)
    next_step(made, ORDER, LANE, 1e-5, 0.5)
    assert made.h[LANE] == pytest.approx(0.4, rel=1e-12)


@pytest.mark.parametrize(
    ("h", "t"),
    [(0.1, 0.9), (0.5, 0.5), (0.55, 0.625), (0.74, 0.625), (0.75, 0.25), (2.0, 0.25)],
)
def test_a_step_ends_at_the_goal_or_well_before_it(h: float, t: float) -> None:
    made = steps(here=1.0, goal=0.25, h=h)
    next_t(made, LANE)
    assert made.t[LANE] == pytest.approx(t, rel=1e-12)
    assert made.ahead[LANE] == pytest.approx(t - 1.0, rel=1e-12)
