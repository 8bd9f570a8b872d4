"""Deflation from points that are known roughly, and the zeros that are regular all the same."""

from __future__ import annotations

import flint
import numpy as np
import pytest
from singular_zeros import polynomials

from nag.algebra.system import PolynomialSystem
from nag.decomposition.given_points import components_through_points
from nag.numerics import deflation
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.deflation import NotDeflated, deflate
from nag.numerics.descent import Round, descend
from nag.numerics.digits import BITS, DIGITS, log_norm, working_digits
from nag.numerics.exact_system import ExactSystem
from nag.numerics.newton import find_zero, move_point
from nag.numerics.sharpening import ARRIVED

QUARTICS = "x^4 - 2*y^2*z^2 + x^5, y^4 + 3*x*z^3 - z^5, z^4 - x^2*y*z + y^6"


def test_the_order_at_a_rough_point_needs_no_longer_series(monkeypatch: pytest.MonkeyPatch) -> None:
    made = []

    def recorded(system, digits, centre, rounds, order, along=None):
        made.append((system.n - len(rounds[0].columns), order))
        return descend(system, digits, centre, rounds, order, along)

    descend = deflation.descend
    monkeypatch.setattr(deflation, "descend", recorded)
    given = polynomials("x y z w", *QUARTICS.split(", "), "w + w^2 - x*y*z")
    system = ExactSystem.of(given, np.zeros(4))
    with working_digits(DIGITS):
        rough = [flint.acb(c) for c in (1e-3, -2e-3, 1.5e-3, 1e-4)]
        found = deflate(system, rough, -2.5, np.random.default_rng(0))
    assert (found.rounds[0].order, found.free, found.exact) == (4, 0, True)
    assert log_norm(found.point) < ARRIVED
    assert max(order for m, order in made if m == 3) == 5


def test_newton_s_method_that_leads_away_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    """Their double zero is 40 times as far as it may be, which only both together tell."""
    pair = [f"(x + y)^2 {sign} (x - y - 8/100)^2/100" for sign in "+-"]
    system = ExactSystem.of(polynomials("x y", *pair), np.zeros(2))
    sharpened = []

    def recorded(system, x, rounds, digits=DIGITS):
        sharpened.append(len(rounds))
        return sharpen(system, x, rounds, digits)

    sharpen = deflation.sharpen
    monkeypatch.setattr(deflation, "sharpen", recorded)
    with working_digits(DIGITS):
        with pytest.raises(NotDeflated, match="away"):
            deflate(system, [flint.acb(0)] * 2, -3.0, np.random.default_rng(0))
        assert sharpened == [1]
        assert deflate(system, [flint.acb(0)] * 2, -2.0, np.random.default_rng(0)).exact


def test_all_equations_together_lead_to_their_common_zero() -> None:
    """From there, Newton's method for the first one alone leads to another zero of it."""
    with working_digits(DIGITS):
        two = polynomials("x", "x*(x - 1/10^6)", "x*(x - 2/10^6)")
        start = [flint.acb("6e-7")]
        found = find_zero(BallPolynomials.of(two), start, DIGITS, -6.0)
        assert found is not None and log_norm(found.point) < ARRIVED
        assert find_zero(BallPolynomials.of(two), start, DIGITS, -6.5) is None
        alone = find_zero(BallPolynomials.of(two[:1]), start, DIGITS, -5.0)
        assert alone is not None and log_norm(alone.point) > -6.1


def test_a_multiple_zero_is_none_that_all_equations_make_regular() -> None:
    with working_digits(DIGITS):
        double = BallPolynomials.of(polynomials("x y", "x^2", "x*y", "y - x^2"))
        assert find_zero(double, [flint.acb("1e-3"), flint.acb("1e-4")], DIGITS, -1.0) is None


def test_deflation_of_no_equations_comes_to_an_end() -> None:
    plane = PolynomialSystem(("x", "y"), ())
    found = components_through_points(plane, [(1, np.array([0.25, 0.5]))])
    assert not found.complete
    assert found.notes == ("a point of dimension 1 led to no component",)


@pytest.mark.parametrize("order", [1, 2])
def test_a_step_by_series_raises_the_error_to_a_power_one_above_their_order(order: int) -> None:
    given = ("w + x^2 - y*z + w^3", "x^2 - 2*y^2 + 3*z*w", "x*y + w^2 + z*x - z^2")
    system = ExactSystem.of(polynomials("x y z w", *given), np.zeros(4))
    rounds = [Round((0,), (3,), 2), Round((2, 1, 3), (0, 1, 2))]
    point = [flint.acb(c) * flint.arb(10) ** -40 for c in (1, -2, 3, 1)]
    found = descend(system, DIGITS, point, rounds, order)
    assert found is not None
    left = move_point(point, found.displacement, BITS)
    assert -2 < log_norm(left) + 40 * (order + 1) < 2


def test_rows_added_to_equations_have_their_values_and_slopes_after_theirs() -> None:
    third = polynomials("x y", "x^2 - y/3", "x*y - 1", "2*x - y/7 + 5")
    whole = ExactSystem.of(third, np.zeros(2))
    built = ExactSystem.of(third[:2], np.zeros(2)).with_row(whole.rows[2])
    for digits in (50, 150):
        with working_digits(digits):
            point = [flint.acb("0.3", "1.7"), flint.acb("-2.1", "0.4")]
            one, other = whole.values_at(digits), built.values_at(digits)
            assert (
                log_norm(a - b for a, b in zip(one.values(point), other.values(point), strict=True))
                < 5 - digits
            )
            for first, second in zip(one.jacobian(point), other.jacobian(point), strict=True):
                assert log_norm(a - b for a, b in zip(first, second, strict=True)) < 5 - digits
