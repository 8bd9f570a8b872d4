"""Irreducibility over the complex numbers is decided exactly, however near a curve is to others."""

from __future__ import annotations

import numpy as np
import pytest

import nag
from nag.algebra.exact_ranks import LARGE
from nag.algebra.expression import parse_polynomial
from nag.algebra.factoring import is_absolutely_irreducible
from nag.algebra.system import PolynomialSystem


@pytest.mark.parametrize(
    ("text", "names", "expected"),
    [
        ("x^2 + y^2", "x y", False),
        ("x^2 + y^2", "x y z", False),
        ("x^2 + y^2 + z^2", "x y z", True),
        ("x^4 - 2*y^4", "x y", False),
        ("x^2 - 2", "x y", False),
        ("y - x^3", "x y", True),
        ("x*y - 1/10^20", "x y", True),
        (f"x*y - 1/{LARGE.modulus}", "x y", True),
        # It is irreducible, which is not seen modulo a prime that divides a denominator.
        (f"x^3 + y^3 - 1/{LARGE.modulus}", "x y", False),
        (f"x^3 + y^3 - 1/{LARGE.modulus + 1}", "x y", True),
        ("(x^2 + y^2 - 1)*(x^2 - 2*y^2 + 3*x - 5) + (x - 2*y + 1)/10^16", "x y", True),
    ],
)
def test_factors_over_the_complex_numbers(text: str, names: str, expected: bool) -> None:
    f = parse_polynomial(text, names.split())
    assert is_absolutely_irreducible(f, np.random.default_rng(1)) is expected


@pytest.mark.parametrize("seed", [0, 1])
@pytest.mark.parametrize("text", ["(x - 10^9)^2 + y^2 - 1", "x*y - 1/10^20"])
def test_curves_that_look_like_lines_are_one_component(text: str, seed: int) -> None:
    system = PolynomialSystem(("x", "y"), [parse_polynomial(text, ["x", "y"])])
    answer = nag.decompose(system, seed=seed)
    assert [(c.dimension, c.degree) for c in answer.components] == [(1, 2)]
