"""Square systems that cut a set regularly, at points known in doubles."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

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
