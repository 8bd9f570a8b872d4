"""Exact proofs that equations have a Jacobian of full rank at all their zeros."""

import pytest
from singular_zeros import polynomials

from nag.algebra.smoothness import is_regular_everywhere

# Equations, codimension of the zeros, whether the zeros are smooth points of that codimension.
KNOWN = {
    "a circle": (("x y", "x^2 + y^2 - 1"), 1, True),
    "a circle, twice": (("x y", "x^2 + y^2 - 1", "2*x^2 + 2*y^2 - 2"), 1, True),
    "a cusp": (("x y", "y^2 - x^3"), 1, False),
    "a double line": (("x y", "x^2"), 1, False),
    "circles that touch": (("x y", "x^2 + y^2 - 1", "(x - 3)^2 + y^2 - 4"), 2, False),
    "circles that cross": (("x y", "x^2 + y^2 - 1", "(x - 1)^2 + y^2 - 1"), 2, True),
    "a torus": (("a b c d", "a^2 + b^2 - 1", "c^2 + d^2 - 1"), 2, True),
    "a node at a point that is not real": (("x y", "(x - y)*(x*y + 1)"), 1, False),
    "the twisted cubic": (("x y z", "y - x^2", "z - x*y", "x*z - y^2"), 2, True),
}


@pytest.mark.parametrize("name", KNOWN)
def test_smoothness_is_proved_exactly_where_it_holds(name: str) -> None:
    equations, rank, smooth = KNOWN[name]
    assert is_regular_everywhere(polynomials(*equations), rank) is smooth


def test_what_is_too_large_is_not_claimed() -> None:
    names = " ".join(f"x{i}" for i in range(9))
    assert not is_regular_everywhere(polynomials(names, "x0^2 + x8^2 - 1"), 1)


def test_irrational_coefficients_are_not_claimed() -> None:
    assert not is_regular_everywhere(polynomials("x y", "x^2 + sqrt(2)*y^2 - 1"), 1)
