"""Newton's method in balls leads to the digits asked for, whatever the precision outside is."""

from __future__ import annotations

import pickle

import flint
import numpy as np
import pytest

import nag
from nag.algebra.polynomial import Polynomial
from nag.numerics.ball_boxes import box_about
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.deflation import deflate
from nag.numerics.exact_system import ExactSystem
from nag.numerics.newton import find_zero, newton_step
from nag.numerics.precise_point import PrecisePoint, precise_zero
from nag.numerics.series_zeros import find_zeros_of_cluster
from nag.numerics.singular_point import analyse
from nag.numerics.zero_values import vanishes_at_point


def equations(*texts: str) -> tuple[Polynomial, ...]:
    return nag.system(texts, "x y").polynomials


def zero_of(first: str, second: str, near: list[complex]) -> PrecisePoint:
    found = precise_zero(BallPolynomials.of(equations(first, second)), np.array(near), within=-1.0)
    assert found is not None
    return found


def exact_root(k: int) -> flint.arb:
    with flint.ctx.workdps(2000):
        return flint.arb(2).sqrt() / flint.arb(10) ** k


@pytest.mark.parametrize("k", [0, 20, 60])
@pytest.mark.parametrize("digits", [30, 150, 900])
def test_zeros_are_as_near_as_is_asked_for_and_said(k: int, digits: int) -> None:
    """The zeros of x^2 = 2 / 10^(2k) are 10^-k apart: so many digits more are lost."""
    system = BallPolynomials.of(equations(f"x^2 - 2/10^{2 * k}", "y - 3*x - 7"))
    start = [exact_root(k) * (1 + flint.arb(10) ** -6), flint.arb(7)]
    found = find_zero(system, list(map(flint.acb, start)), digits)
    assert found is not None and found.error < 1 - digits
    with flint.ctx.workdps(2000):
        off = abs(found.point[0] - exact_root(k))
        assert off < flint.arb(10) ** -digits
        assert off <= flint.arb(10) ** flint.arb(found.error)


@pytest.mark.parametrize("m", [2, 3, 4])
@pytest.mark.parametrize("k", [200, 310, 900])
def test_a_multiple_zero_is_none_that_newtons_method_finds_however_near(m: int, k: int) -> None:
    system = BallPolynomials.of(equations(f"x^{m} + 7*x^{m + 1}", "y^2 - 2 + x"))
    start = [flint.arb(10) ** -k, exact_root(0)]
    assert find_zero(system, list(map(flint.acb, start)), 100) is None


def test_a_simple_zero_is_found_beside_others_that_are_nearer_than_its_digits() -> None:
    system = BallPolynomials.of(equations(f"x^2 - x/10^{200}", "y - x"))
    tiny = flint.arb(10) ** -310
    found = find_zero(system, [flint.acb(tiny), flint.acb(tiny)], 100)
    assert found is not None and found.error < -300


def test_more_equations_or_fewer_than_unknowns_have_steps_as_well() -> None:
    x = [flint.acb(1, 2) / 3, flint.acb(5) / 7]
    more = newton_step(BallPolynomials.of(equations("x - 2", "y + 3", "x + y + 1")), x, 200)
    assert more is not None
    assert all(abs(a - b - c) < 1e-12 for a, b, c in zip(x, more, (2, -3), strict=True))
    fewer = newton_step(BallPolynomials.of(equations("x + y - 2")), x, 200)
    assert fewer is not None and abs(fewer[0] - fewer[1]) < 1e-12


@pytest.mark.parametrize("bits", [10, 53, 3000])
def test_nothing_depends_on_the_precision_outside(bits: int) -> None:
    polynomials = equations("x^2 + y^2 - 2/3", "x*y - sqrt(2)/9")
    system, z = BallPolynomials.of(polynomials), np.array([0.79, 0.2], dtype=complex)
    (zero, box), (other, other_box) = (
        _in_precision(
            b, lambda: (precise_zero(system, z, within=-1.0), box_about(system, start(z)))
        )
        for b in (bits, 53)
    )
    assert zero.centre == other.centre and (zero.radii == other.radii).all()
    assert box.centre == other_box.centre and list(map(str, box.inner)) == list(
        map(str, other_box.inner)
    )
    ends = [
        _in_precision(b, lambda: analyse(polynomials, z, 1e-2, np.random.default_rng(0)))
        for b in (bits, 53)
    ]
    assert ends[0].precise.centre == ends[1].precise.centre


def start(z: np.ndarray) -> list[flint.acb]:
    return [flint.acb(complex(c)) for c in z]


def _in_precision(bits, compute):
    with flint.ctx.workprec(bits):
        return compute()


def test_zeros_of_a_cluster_are_found_one_by_one_and_leave_the_precision_as_it_is() -> None:
    system = ExactSystem.of(equations("x^2 - 1/10^60", "y - x"), np.zeros(2))
    found = deflate(system, [flint.acb(0)] * 2, -25.0, np.random.default_rng(0))
    before = flint.ctx.prec
    for _ in find_zeros_of_cluster(system, found, -25.0, np.random.default_rng(0)):
        assert flint.ctx.prec == before


def test_a_polynomial_vanishes_or_does_not_or_the_digits_leave_it_open() -> None:
    (zero,) = [
        precise_zero(
            BallPolynomials.of(equations("x^2 - 2", "y^2 - 3")), np.array([1.4, 1.7]), within=-1.0
        )
    ]
    same, differs, close = equations("x^2*y^2 - 6", "x - y + 3/10", "x^2 - 2 - 1/10^70")
    assert (
        vanishes_at_point(same, zero),
        vanishes_at_point(differs, zero),
        vanishes_at_point(close, zero),
    ) == (
        True,
        False,
        False,
    )
    rough = PrecisePoint(zero.centre, np.full(2, 1e-30))
    assert vanishes_at_point(close, rough) is None


def test_precise_points_are_pickled_to_the_last_bit() -> None:
    zero = precise_zero(
        BallPolynomials.of(equations("x^2 + 2", "y^3 - 3")), np.array([1.41j, 1.44]), within=-1.0
    )
    again = pickle.loads(pickle.dumps(zero))
    assert again.centre == zero.centre and (again.radii == zero.radii).all()
