"""What ends of paths beside larger sets stand for, and what vanishes there."""

import numpy as np
import pytest

import nag
from nag.numerics.singular_point import Place
from nag.numerics.zero_values import (
    multiplicity_of_all,
    possible_zeros,
    select_isolated,
    vanishes_at,
)
from nag.witness.close_to_sets import find_nearby_zeros
from nag.witness.cutting import Equations

NO_SLICE = np.zeros((0, 4))


def _beside_a_line(distance):
    """A line, ``x = z = 0``, and a regular zero at ``(distance, 1, 0)``."""
    return nag.system(
        [
            f"x*(x - {distance}) + z*(y + 1)",
            "x*(y - 1) + z*(2*x + z - 3)",
            f"x*(y - 1 + 5*(x - {distance})) + z*(y + x + 7)",
        ]
    ).polynomials


@pytest.mark.parametrize("k", [20, 25, 29])
def test_an_end_known_in_each_coordinate_is_told_from_a_line_however_near(k):
    equations = Equations(_beside_a_line(f"10^-{k}"), 3)
    end = np.array([10.0**-k, 1, 0], dtype=complex)
    found = find_nearby_zeros([(end, 1e-15)], equations, NO_SLICE, np.random.default_rng(0))
    assert found.decided
    assert [zero.multiplicity for zero in found.zeros] == [1]
    assert abs(found.zeros[0].point[0]) == pytest.approx(10.0**-k, rel=1e-12)


def test_an_end_on_the_line_stands_for_no_isolated_zero():
    equations = Equations(_beside_a_line("10^-29"), 3)
    end = np.array([0, 2, 0], dtype=complex)
    found = find_nearby_zeros([(end, 1e-15)], equations, NO_SLICE, np.random.default_rng(0))
    assert found.decided
    assert not found.zeros


@pytest.mark.parametrize("k", [60, 95, 110])
def test_what_exceeds_the_error_of_a_zero_does_not_vanish_there(k):
    system = nag.system([f"x - 1/3 + y*x + 10^-{k}*z", f"y - 10^-{k}*(1 + x*z)", "z - 7/5 + x*y"])
    y, zero = _at_a_third(system, 10.0**-k)
    assert not vanishes_at(zero, y)
    assert vanishes_at(zero, system.polynomials[1])


def test_what_is_zero_vanishes():
    y, zero = _at_a_third(nag.system(["x - 1/3 + y*x", "y*(1 + x*z)", "z - 7/5 + x*y"]), 0.0)
    assert vanishes_at(zero, y)


def _at_a_third(system, y):
    x = np.array([1 / 3, y, 7 / 5], dtype=complex)
    (zero,) = possible_zeros(system.polynomials, x, 1e-15, np.random.default_rng(0))
    return nag.system(["y"], "x y z").polynomials[0], zero


@pytest.mark.parametrize(
    ("texts", "isolated", "others"),
    [
        (["(x - 1)^2", "y*(y - 10^-40)"], 2, 0),
        (["x*y - y", "(x - 1)*y"], 0, 1),  # On a line.
        (["(x - 1)*y", "(y - 10^-40)*y"], 1, 1),  # A point that is 10^-40 off a line, or the line.
        (["(x - 1)^2 + 1/100", "y"], None, 0),
    ],
)
def test_what_a_point_may_stand_for_is_known_or_open(texts, isolated, others):
    system = nag.system(texts, "x y")
    x = np.array([1, 0], dtype=complex)
    zeros = possible_zeros(system.polynomials, x, 1e-15, np.random.default_rng(0))
    if isolated is None:
        assert zeros is None and select_isolated(zeros) == ()
        return
    alone = [zero for zero in zeros if zero.place is Place.ISOLATED]
    assert (len(alone), len(zeros) - len(alone)) == (isolated, others)
    assert len(select_isolated(zeros)) == (0 if others else isolated)
    # Of a point that may be one of a larger set no multiplicity is known.
    assert (multiplicity_of_all(zeros) is None) == bool(others)
