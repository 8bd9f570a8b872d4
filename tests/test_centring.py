"""New origins of variables: exact, only where zeros lie close together, and then they are found."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.files.cases import read_case
from nag.mechanism.model import model
from nag.solving.solve import solve
from nag.solving.start.centring import FAR, centres, shifted

BENCHMARKS = Path(__file__).parent.parent / "cases" / "benchmarks"
RADIUS = Fraction(1, 2000)
ORIGINS = (Fraction(2, 3), Fraction(-5, 7), Fraction(9, 11))


def multilinear(seed: int) -> list[Polynomial]:
    """Three equations with all eight multilinear monomials in three variables: six zeros."""
    rng = np.random.default_rng(seed)
    support = [tuple(int(c) for c in np.binary_repr(k, 3)) for k in range(8)]
    return [
        Polynomial(3, {e: Fraction(int(c), 64) for e, c in zip(support, row, strict=True)})
        for row in rng.integers(-64, 65, (3, 8)) | 1
    ]


def clustered(polynomials: list[Polynomial]) -> list[Polynomial]:
    """The polynomials whose zeros are the given ones' times a small radius, about new origins."""
    images = [(x - b) / RADIUS for x, b in zip(Polynomial.variables(3), ORIGINS, strict=True)]
    return [f.compose(images) for f in polynomials]


@pytest.mark.parametrize("seed", range(6))
def test_clustered_zeros_are_the_images_of_those_spread_out(seed: int) -> None:
    spread = multilinear(seed)
    wide = solve(PolynomialSystem(["x", "y", "z"], spread), seed=seed)
    close = solve(PolynomialSystem(["x", "y", "z"], clustered(spread)), seed=seed)
    assert wide.complete
    assert close.complete
    assert len(wide.solutions) == len(close.solutions) == 6
    images = wide.points * float(RADIUS) + np.array([float(b) for b in ORIGINS])
    for point in close.points:
        distances = np.abs(images - point).max(axis=1)
        assert distances.min() < 1e-12


@pytest.mark.parametrize("seed", range(6))
def test_origins_lie_among_the_zeros(seed: int) -> None:
    spread = multilinear(seed)
    zeros = solve(PolynomialSystem(["x", "y", "z"], spread), seed=seed).points
    reach = float(RADIUS) * np.abs(zeros).max(axis=0)
    found = centres(clustered(spread), 3)
    offset = np.array([float(a - b) for a, b in zip(found, ORIGINS, strict=True)])
    assert (np.abs(offset) <= reach).all()


def test_a_shift_is_exact() -> None:
    f = clustered(multilinear(0))[0]
    point = (Fraction(1, 3), Fraction(4, 5), Fraction(-2, 7))
    moved = [x - b for x, b in zip(point, ORIGINS, strict=True)]
    assert shifted(f, ORIGINS)(moved) == f(point)


@pytest.mark.parametrize("name", ["inverse-6r", "katsura-6", "cyclic-5", "chandra-8", "cbms1"])
def test_well_placed_variables_stay(name: str) -> None:
    case = read_case(BENCHMARKS / f"{name}.toml")
    system = case.system if case.mechanism is None else model(case.mechanism).system
    assert centres(system.polynomials, system.n) == (0,) * system.n


def test_squares_and_missing_monomials_are_not_made_denser() -> None:
    x, y = Polynomial.variables(2)
    far = Fraction(1000)
    assert centres([(x - far) ** 2 - 1, x * y - far], 2) == (0, 0)


def test_equations_that_depend_on_each_other_are_left_alone() -> None:
    x, y = Polynomial.variables(2)
    f = (x - 1000) * (y - 1000) - 1
    assert centres([f, f * 3], 2) == (0, 0)
    assert FAR > 1
