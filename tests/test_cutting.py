"""Square systems that cut a set regularly, at points known in doubles."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

import nag
from nag.algebra.evaluation import Evaluator
from nag.algebra.polynomial import Polynomial
from nag.witness import cutting_in_digits
from nag.witness.cutting import Cut, Equations, Sharpened, regular_on, sharpen
from nag.witness.fibres import Fibre

NO_SLICE = np.zeros((0, 3), dtype=complex)


@pytest.mark.parametrize("k", range(24, 30))
def test_a_double_zero_that_rounding_hides_is_not_regular(k: int) -> None:
    # A line that touches a circle: at 2^-27 beside the point, values in doubles may vanish.
    x, y = Polynomial.variables(2)
    evaluator = Evaluator.of([x**2 + y**2 - 1, y - 1], 2)
    arrived = Sharpened(np.array([2.0**-k, 1.0], dtype=complex), 1e-16, True)
    assert not regular_on(evaluator, NO_SLICE, arrived)


@pytest.mark.parametrize("k", range(1, 6))
def test_simple_zeros_side_by_side_are_regular(k: int) -> None:
    x, y = Polynomial.variables(2)
    evaluator = Evaluator.of([x**2 - Fraction(1, 10 ** (2 * k)), y - 1], 2)
    sharpened = sharpen(evaluator, NO_SLICE, np.array([10.0**-k, 1.0], dtype=complex))
    assert sharpened.converged
    assert regular_on(evaluator, NO_SLICE, sharpened)


def is_alone(distance: Fraction) -> bool:
    """Whether the zero of ``x^2 = distance^2`` is seen to be alone."""
    x, y = Polynomial.variables(2)
    equations = Equations((x**2 - distance**2, y - 1), 2)
    zero = np.array([[float(distance), 1.0]], dtype=complex)
    fibre = Fibre(Cut(2, 0, equations.polynomials), NO_SLICE, zero)
    return cutting_in_digits.is_alone(fibre, 0, equations)


def test_doubles_are_enough_to_see_that_no_other_zero_is_near(monkeypatch) -> None:
    monkeypatch.setattr(
        cutting_in_digits, "with_newton_constant", lambda *_: pytest.fail("digits were asked")
    )
    assert is_alone(Fraction(1))
    assert is_alone(Fraction(1, 100))


@pytest.mark.parametrize("k", range(5, 15))
def test_zeros_that_are_close_to_others_are_not_alone(k: int) -> None:
    assert not is_alone(Fraction(1, 10**k))


def test_a_number_for_an_unknown_does_not_change_the_sizes_of_the_others(monkeypatch) -> None:
    x, y = Polynomial.variables(2)
    cut = Cut(2, 0, (2**80 * x**2 + y**2 - 1, x * 2**40 - y))
    with_number = cut.numbered
    alone = Cut(2, 1, with_number.polynomials)
    assert cut.powers.tolist() == [-40, 0]
    monkeypatch.setattr("nag.witness.cutting.variable_scales", None)
    assert with_number.powers.tolist() == [-40, 0, 0]
    monkeypatch.undo()
    assert alone.powers.tolist() == [-40, 0, 0]


# Curves and 15 points; mixed and moved, so that at many points of the curves all derivatives are
# rounding errors.
CURVES_AND_POINTS = (
    "-2*a^2*b^2 + 4*a^2*b*c - 5*a^2*c^2 - 12*a^2*c*d + a^2*c - 11*a^2*d^2 + a^2*d + 4*a^2 "
    "- 8*a*b^3 + 16*a*b^2*c + 2*a*b^2 - 20*a*b*c^2 - 48*a*b*c*d - 44*a*b*d^2 + 4*a*b*d + "
    "16*a*b + 4*a*c^2 + 8*a*c*d + 8*a*d^2 - 4*a - 8*b^4 + 16*b^3*c + 4*b^3 - 20*b^2*c^2 - "
    "48*b^2*c*d - 4*b^2*c - 43*b^2*d^2 + 3*b^2*d + 16*b^2 + 8*b*c^2 - 2*b*c*d^2 + "
    "18*b*c*d + 16*b*d^2 - 8*b - c^2*d + 2*c^2 - 4*c*d^3 + c*d^2 + 8*c*d - 2*c - 4*d^4 + "
    "2*d^3 + 6*d^2 - 2*d",
    "2*a^2*b^2 - 4*a^2*b*c + 2*a^2*c^2 + 2*a^2*c + 4*a^2*d - 4*a^2 + 8*a*b^3 - 16*a*b^2*c "
    "- 2*a*b^2 + 8*a*b*c^2 + 12*a*b*c + 16*a*b*d - 16*a*b - 4*a*c^2 - 8*a*c*d - 8*a*d^2 + "
    "4*a + 8*b^4 - 16*b^3*c - 4*b^3 + 7*b^2*c^2 - 4*b^2*c*d + 16*b^2*c - 5*b^2*d^2 + "
    "16*b^2*d - 14*b^2 + 2*b*c^3 + 8*b*c^2*d - 7*b*c^2 + 10*b*c*d^2 - 12*b*c*d - 4*b*c - "
    "11*b*d^2 + 6*b - c^4 - 4*c^3*d - c^3 - 7*c^2*d^2 - 4*c^2*d + 6*c^2 - 8*c*d^3 - "
    "3*c*d^2 + 16*c*d - 2*c - 8*d^4 + 4*d^3 + 16*d^2 - 8*d",
    "a^2*b^2 - 2*a^2*b*c + 4*a^2*c^2 + 12*a^2*c*d - 2*a^2*c + 13*a^2*d^2 - 5*a^2*d - "
    "2*a^2 + 4*a*b^3 - 8*a*b^2*c - a*b^2 + 16*a*b*c^2 + 48*a*b*c*d - 6*a*b*c + 52*a*b*d^2 "
    "- 20*a*b*d - 8*a*b - 2*a*c^2 - 4*a*c*d - 4*a*d^2 + 2*a + 4*b^4 - 8*b^3*c - 2*b^3 + "
    "15*b^2*c^2 + 44*b^2*c*d - 4*b^2*c + 48*b^2*d^2 - 21*b^2*d - 6*b^2 + 2*b*c^3 + "
    "8*b*c^2*d - 3*b*c^2 + 8*b*c*d^2 - 2*b*c*d - 4*b*c - 3*b*d^2 + 2*b - c^4 - 4*c^3*d - "
    "c^3 - 2*c^2*d^2 - 5*c^2*d - 2*c^2 + 8*c*d^3 - 7*c*d^2 - 16*c*d + 6*c + 8*d^4 - 4*d^3 "
    "- 18*d^2 + 10*d",
    "a^2*b^2 - 2*a^2*b*c + 2*a^2*c^2 + 4*a^2*c*d + 4*a^2*d^2 - 2*a^2 + 4*a*b^3 - "
    "8*a*b^2*c - a*b^2 + 8*a*b*c^2 + 16*a*b*c*d + 2*a*b*c + 16*a*b*d^2 - 8*a*b - 2*a*c^2 "
    "- 4*a*c*d - 4*a*d^2 + 2*a + 4*b^4 - 8*b^3*c - 2*b^3 + 7*b^2*c^2 + 12*b^2*c*d + "
    "4*b^2*c + 11*b^2*d^2 - 6*b^2 + 2*b*c^3 + 8*b*c^2*d - 3*b*c^2 + 10*b*c*d^2 - 4*b*c*d "
    "- 4*b*c - 3*b*d^2 + 2*b - c^4 - 4*c^3*d - c^3 - 5*c^2*d^2 - 4*c^2*d + 2*c^2 - "
    "5*c*d^2 + 2*c",
)


@pytest.mark.parametrize("seed", range(3))
def test_no_end_on_a_curve_becomes_a_zero_elsewhere(seed: int) -> None:
    """Rounding errors in place of a Jacobian led Newton's method to an isolated zero once more."""
    found = nag.decompose(CURVES_AND_POINTS, variables="a b c d", seed=seed)
    assert found.complete
    own = [(c.dimension, c.degree) for c in found]
    assert {kind: own.count(kind) for kind in own} == {(1, 1): 12, (1, 2): 4, (0, 1): 15}
    points = np.array([c.points[0] for c in found if not c.dimension])
    apart = np.linalg.norm(points[:, None] - points, axis=2)
    assert apart[~np.eye(15, dtype=bool)].min() > 0.1
