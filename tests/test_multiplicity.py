"""Multiplicity of a zero on a slice."""

from __future__ import annotations

import numpy as np
import pytest

from nag.algebra.expression import parse_polynomial
from nag.witness.multiplicity import multiplicity
from nag.witness.slices import rows_through


@pytest.mark.parametrize("size", [1, 8, 64])
@pytest.mark.parametrize(
    ("names", "equation", "point", "d", "expected"),
    [
        ("x y", "(y^2 - x^3)^3*y^2", lambda t: (t**2, t**3), 1, 3),
        ("x y", "(y^2 - x^3)^3*y^2", lambda t: (t, 0), 1, 2),
        ("x y z", "(x^2 - y^2*z)^2*x^2", lambda t: (t * (1 + t), t, (1 + t) ** 2), 2, 2),
        ("x y z", "x^2*(y - z^3)", lambda t: (1, t**3, t), 2, 1),
    ],
)
def test_it_does_not_depend_on_how_far_out_the_point_lies(
    names: str, equation: str, point, d: int, expected: int, size: int
) -> None:
    variables = tuple(names.split())
    polynomials = [parse_polynomial(equation, variables)]
    for seed in range(4):
        rng = np.random.default_rng(seed)
        t = size * np.exp(2j * np.pi * rng.random())
        x = np.array(point(t), dtype=complex)
        assert multiplicity(polynomials, rows_through(rng, d, x), x, rng) == expected
