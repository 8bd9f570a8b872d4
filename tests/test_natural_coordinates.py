"""Natural coordinates: exact there and back, found after any translation and scaling."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from random_small import small_system
from systems import kinds

import nag
from nag.algebra.evaluation import Evaluator
from nag.algebra.expression import parse_polynomial
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.bench.atlas.changes import in_far_coordinates
from nag.decomposition.decompose import decompose
from nag.files.cases import read_case
from nag.mechanism.model import model
from nag.numerics.natural_coordinates import (
    FAR,
    NaturalCoordinates,
    natural_coordinates,
    shift_polynomial,
)
from nag.solving.solve import solve

CASES = Path(__file__).parent.parent / "cases"
BENCHMARKS = CASES / "benchmarks"
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
def test_origins_lie_near_the_zeros(seed: int) -> None:
    spread = multilinear(seed)
    zeros = solve(PolynomialSystem(["x", "y", "z"], spread), seed=seed).points
    reach = float(RADIUS) * np.abs(zeros).max(axis=0)
    found = natural_coordinates(clustered(spread), 3).origin
    offset = np.array([float(a - b) for a, b in zip(found, ORIGINS, strict=True)])
    assert (np.abs(offset) <= FAR * reach).all()


def test_polynomials_go_there_and_back_exactly() -> None:
    f = clustered(multilinear(0))[0]
    point = (Fraction(1, 3), Fraction(4, 5), Fraction(-2, 7))
    units = (Fraction(3), Fraction(1, 8), Fraction(10, 7))
    natural = NaturalCoordinates(units, ORIGINS)
    there = [(x - b) / s for x, b, s in zip(point, ORIGINS, units, strict=True)]
    image, back = natural.polynomial(f), natural.inverse.polynomial(natural.polynomial(f))
    ratio = image(there) / f(point)
    assert ratio.numerator & (ratio.numerator - 1) == 0
    assert ratio.denominator & (ratio.denominator - 1) == 0
    assert {e: c * f.terms[0, 0, 0] for e, c in back.terms.items()} == {
        e: c * back.terms[0, 0, 0] for e, c in f.terms.items()
    }


@pytest.mark.parametrize("name", ["inverse-6r", "katsura-6", "cyclic-5", "chandra-8", "cbms1"])
def test_well_placed_variables_stay(name: str) -> None:
    case = read_case(BENCHMARKS / f"{name}.toml")
    system = case.system if case.mechanism is None else model(case.mechanism).system
    assert natural_coordinates(system.polynomials, system.n).origin == (0,) * system.n


def test_systems_in_natural_coordinates_are_told_without_linear_algebra(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    system = read_case(CASES / "rhombus-chain-3.toml").system

    def refuse(*args: object) -> None:
        raise AssertionError

    monkeypatch.setattr(np.linalg, "solve", refuse)
    monkeypatch.setattr("nag.numerics.natural_coordinates._solve_rows", refuse)
    assert natural_coordinates(system.polynomials, system.n).is_identity


def test_sparse_equations_are_not_made_denser() -> None:
    x, y = Polynomial.variables(2)
    far = Fraction(1000)
    assert natural_coordinates([(x - far) ** 2 - 1, x * y - far], 2).origin == (0, 0)


def test_scales_that_equations_leave_free_make_no_origin_far() -> None:
    texts = (
        "-7/10^16*x^2*w + 4/10^15*y^3 + 2*10^7*y*z^2 - 4/10^6*x^2 - 8/10^10*y^2 - 4",
        "y^5 + 3*x^2*w",
    )
    equations = [parse_polynomial(text, ["x", "y", "z", "w"]) for text in texts]
    # Alone, the first one is a translated one with a term fewer.
    assert natural_coordinates(equations[:1], 4).origin == (0, 0, 0, Fraction(-4 * 10**10, 7))
    # Of x and w only x^2 w has a size about the new origin: w may be as large as it was.
    assert natural_coordinates(equations, 4).origin == (0, 0, 0, 0)


def test_the_vertex_of_a_cone_is_its_origin() -> None:
    x, y, z, w = (v - b for v, b in zip(Polynomial.variables(4), (700, -3000, 22, 0), strict=True))
    assert natural_coordinates([x * w - y * z, x**2 - y * w], 4).origin == (700, -3000, 22, 0)


def test_equations_without_a_common_centre_are_outvoted() -> None:
    x, y = (v - b for v, b in zip(Polynomial.variables(2), (1000, -3000), strict=True))
    apart = x * y + x * Fraction(1, 1000) - 2
    assert natural_coordinates([apart, x**2 + y**2 - 1, x**3 - y * 5], 2).origin == (1000, -3000)


def test_translated_random_systems_are_as_sparse_as_the_plain_ones_about_their_origin() -> None:
    denser = []
    for number in range(40):
        plain, rng = small_system(7, number).system, np.random.default_rng(number)
        far = in_far_coordinates(plain, ("translated", "third", "one")[number % 3], 4, rng)
        origin = natural_coordinates(far.polynomials, far.n).origin
        found = [shift_polynomial(f, origin) for f in far.polynomials]
        terms = [sum(len(f.terms) for f in fs) for fs in (plain.polynomials, found)]
        if terms[1] > terms[0] + 1:
            denser.append(number)
    assert len(denser) <= 1


def test_little_translations_are_far_for_zeros_of_several_sizes() -> None:
    x, y = Polynomial.variables(2)
    even = [x**3 + y**2 - x * 3, x**2 * y - y * 2 + 1]
    several = [x**3 + y**2 - x * Fraction(3, 10**9), x**2 * y - y * 2 + 1]
    little = (Fraction(1, 3), Fraction(0))
    for plain, origin in ((even, (0, 0)), (several, little)):
        moved = [shift_polynomial(f, [-b for b in little]) for f in plain]
        assert natural_coordinates(moved, 2).origin == origin


@pytest.mark.parametrize("number", range(8))
def test_translations_of_equations_translate_their_origin(number: int) -> None:
    plain, rng = small_system(7, number).system, np.random.default_rng(number)
    found = []
    for decades in (4, 6):
        shift = [Fraction(int(b), 997) * 10**decades for b in rng.integers(100, 1000, plain.n)]
        moved = [shift_polynomial(f, [-b for b in shift]) for f in plain.polynomials]
        origin = natural_coordinates(moved, plain.n).origin
        found.append([shift_polynomial(f, origin) for f in moved])
    assert found[0] == found[1]


def test_equations_that_depend_on_each_other_have_one_origin() -> None:
    x, y = Polynomial.variables(2)
    f = (x - 1000) * (y - 1000) - 1
    assert natural_coordinates([f, f * 3], 2).origin == (1000, 1000)


@pytest.mark.parametrize("seed", range(8))
def test_translated_and_scaled_circles_are_found_exactly(seed: int) -> None:
    rng = np.random.default_rng(seed)
    plain = read_case(CASES / "rhombus-chain-2.toml").system
    origin = [Fraction(int(b), 997) for b in rng.integers(-(10**7), 10**7, plain.n)]
    units = [Fraction(10) ** int(k) for k in rng.integers(-4, 5, plain.n)]
    # The pairs of a circle, and the ends of rods, hang together by its equation alone.
    moved = NaturalCoordinates(tuple(1 / s for s in units), (Fraction(0),) * plain.n)
    moved = moved.system(plain)
    forms = [v - b for v, b in zip(Polynomial.variables(plain.n), origin, strict=True)]
    moved = [f.compose(forms) for f in moved.polynomials]
    found = natural_coordinates(moved, plain.n)
    assert found.origin == tuple(origin)
    circles = [f for f in plain.polynomials if f.degree == 2]
    for f in circles:
        i, j = sorted(f.support)
        assert found.scales[i] / units[i] == found.scales[j] / units[j]


@pytest.mark.parametrize("decades", [1, 3, 6])
@pytest.mark.parametrize("name", ["rhombus-chain-2", "slider-crank", "double-rhombus"])
def test_a_translated_system_is_decomposed_by_the_paths_of_the_plain_one(
    name: str, decades: int
) -> None:
    rng = np.random.default_rng(decades)
    plain = read_case(CASES / f"{name}.toml").system
    origin = [Fraction(int(b), 997) for b in rng.integers(-997, 997, plain.n) * 10**decades]
    forms = [v - b for v, b in zip(Polynomial.variables(plain.n), origin, strict=True)]
    moved = replace(plain, polynomials=tuple(f.compose(forms) for f in plain.polynomials))
    here, there = decompose(plain), decompose(moved)
    assert there.complete
    assert kinds(there) == kinds(here)
    assert there.paths.tracked <= 2 * here.paths.tracked
    shift = np.array([float(b) for b in origin])
    evaluator = Evaluator.of(plain.polynomials, plain.n)
    for component in there.components:
        assert component.accuracy < 1e-14
        residuals = evaluator.residuals(component.points - shift)
        assert residuals.max() < 1e-14 * 10.0**decades


def test_translated_sheets_are_told_apart() -> None:
    x, y, z = (v - b for v, b in zip(Polynomial.variables(3), (701, -3000, 22), strict=True))
    close = (x + y * 2 - 1) ** 2 - Fraction(2, 10**50)
    answer = decompose(PolynomialSystem(["x", "y", "z"], [x**2 + y**2 + z**2 - 1, close]))
    assert answer.complete
    assert kinds(answer) == {(1, 2, 1): 2}
    assert all(c.accuracy < 1e-15 for c in answer.components)


def test_solutions_of_branches_are_joined_about_the_origin_that_suits_them() -> None:
    given = nag.system(
        [
            "-8*x*w + 200*y*z - 40000*z*w",
            "-3/100*y*w + 70000*z*w - 3500000*y - 980000",
            "-5*x^2*z - 530000*x*w^2 + 11000*w^3",
            "700*x^3*z - 1/10*x*y^2*z",
        ],
        "x y z w",
    )
    origin = Fraction(-121744, 5), Fraction(123013, 2), Fraction(-60415), Fraction(838829, 10)
    translation = NaturalCoordinates((Fraction(1),) * 4, origin)
    there = nag.solve(translation.inverse.system(given))
    assert there.complete and len(there.solutions) == len(nag.solve(given).solutions) == 12


def test_equations_are_combined_about_the_origin_that_suits_them() -> None:
    # A combination of the last two is of degree one.
    given = nag.system(
        [
            "1/50000*y^2*z^3 - 100000*x^2",
            "-900000*x^2 - 140000*x*z + 500*z^2",
            "-2700*x^2 - 420*x*z + 3/2*z^2 + 57/100*x + 1/300000*y - 63/10000*z + 9498350",
        ],
        "x y z",
    )
    origin = Fraction(0), Fraction(0), Fraction(-97991, 500000)
    there = NaturalCoordinates((Fraction(1),) * 3, origin).inverse.system(given)
    assert all(
        answer.complete and len(answer.solutions) == 7 for answer in map(solve, (given, there))
    )


def test_terms_that_vanish_far_from_all_zeros_are_no_origin() -> None:
    # At x = -10000 the linear form is zero on the axis of x, and with it the terms in y and z.
    equations = "(x/10000 + y/3 + z/5 + 1)^2/4 + x^2 - 1", "y^2 + z^2 - 1"
    made = nag.system(list(equations), "x y z")
    assert not any(natural_coordinates(made.polynomials, 3).origin)
    # Where the same system was translated, so are the unknowns whose own origin is known.
    away = [f.compose([x - 700 for x in Polynomial.variables(3)]) for f in made.polynomials]
    x, y, z = natural_coordinates(away, 3).origin
    assert y == z == 700 != x
