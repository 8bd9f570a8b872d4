"""No result claims more digits than are right, against zeros proved to 100 digits."""

from __future__ import annotations

import re
from fractions import Fraction
from pathlib import Path

import flint
import numpy as np
import pytest

import nag
from nag.algebra.evaluation import Evaluator
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.bench.atlas.families import FAMILIES
from nag.bench.reference import Reference
from nag.decomposition.decompose import decompose
from nag.files.cases import read_case
from nag.numerics.certified_points import CertifiedPoints
from nag.numerics.natural_coordinates import NaturalCoordinates
from nag.numerics.singular_point import analyse
from nag.solving.certificate import certify_solutions
from nag.solving.shown import coordinate_text
from nag.solving.solve import solve
from nag.solving.start.target import Target
from nag.witness.certificate import certify_decomposition
from nag.witness.sampling import sample

CASES = Path(__file__).parents[1] / "cases"
FAMILY = {f.name: f for f in FAMILIES}


def errors(reference: Reference, points: np.ndarray) -> np.ndarray:
    """Distances from the proved zeros, relative to one and the zeros' norms."""
    off = np.linalg.norm((points - reference.high) - reference.low, axis=1)
    return off / (1 + np.linalg.norm(reference.high, axis=1))


def within(reference: Reference, proved: CertifiedPoints) -> bool:
    """Whether no point is further from its zero than the certificate says."""
    off = reference.errors(proved.points, np.arange(len(proved.points)))
    return bool((off <= proved.errors() * (1 + 1e-9)).all())


def family_system(name: str, value: int) -> PolynomialSystem:
    return FAMILY[name].make(value, np.random.default_rng(0)).system


SOLVED = [
    *((f"cases/{n}", None) for n in ("benchmarks/cyclic-5", "hard/chemequ")),
    ("cluster-3", 8),
    ("cluster-2", 4),
    ("tangent", 8),
    ("dependent", 8),
    ("far", 30),
    ("far-beside", 12),
    ("sizes", 12),
    ("wilkinson", 20),
    ("unity", 30),
]


@pytest.mark.parametrize(("name", "value"), SOLVED, ids=str)
def test_solutions_are_as_accurate_as_they_say(name: str, value: int | None) -> None:
    if value is None:
        system = read_case(CASES.parent / f"{name}.toml").system
    else:
        system = family_system(name, value)
    result = solve(system)
    assert result.solutions
    none = np.zeros((0, 1 + system.n), dtype=complex)
    reference = Reference.of(system, result.points, none)
    claimed = np.array([s.accuracy for s in result.solutions])
    assert (errors(reference, result.points) <= claimed).all()
    assert within(reference, certify_solutions(result).points)


def test_zeros_far_out_are_as_accurate_as_they_say_and_conjugates_are_seen() -> None:
    # Homogenising coordinates of 1e-25, whose phase doubles hardly know.
    equations = (
        "x^2 - 12000*z^2 - 90*z + 1/100000",
        "3/50*y^2*z^2 - 10000*x + 43000",
        "-34000/9*x*y - 1/500*y^2 - 2/25*y - 7/1500*z - 50000",
    )
    result = solve(nag.system(equations, "x y z"))
    assert result.complete
    assert len(result.solutions) == 12
    reference = Reference.of(result.system, result.points, np.zeros((0, 4), dtype=complex))
    claimed = np.array([s.accuracy for s in result.solutions])
    assert np.abs(result.points).max() > 1e25
    assert (errors(reference, result.points) <= claimed).all()


def test_what_a_shift_of_variables_cancels_counts_as_an_error() -> None:
    rng = np.random.default_rng(0)
    n = 3
    rows = tuple({(0,) * n: Fraction(1)} for _ in range(n))
    largest = 0.0
    for _ in range(200):
        centres = tuple(Fraction(int(k), 7) for k in rng.integers(-40, 40, n))
        natural = NaturalCoordinates((Fraction(1),) * n, centres)
        target = Target(n, rows, (2, 0, -3), natural)
        # Zeros that are small beside the centres, or not.
        x = [Fraction(int(k), 10 ** int(rng.integers(1, 4))) for k in rng.integers(-999, 999, n)]
        y = [(c - b) / Fraction(2) ** k for c, b, k in zip(x, centres, (2, 0, -3), strict=True)]
        points = np.array([[float(c) for c in y]], dtype=complex)
        found = target.original(points)[0].real.tolist()
        off = [float(Fraction(z) - c) for z, c in zip(found, x, strict=True)]
        error = np.linalg.norm(off) / (1 + np.linalg.norm([float(c) for c in x]))
        largest = max(largest, error / target.rounding(points)[0])
    assert 0.1 < largest <= 1


def last_place(text: str) -> float:
    """One unit of the last digit of a decimal number."""
    digits, _, exponent = text.lower().partition("e")
    return 10.0 ** (int(exponent or 0) - len(digits.partition(".")[2]))


SHOWN = [("sizes", 12), ("sizes", 4), ("far", 8), ("far-beside", 12), ("cluster-3", 8)]


@pytest.mark.parametrize(("name", "value"), SHOWN, ids=str)
def test_each_digit_of_a_coordinate_that_is_printed_is_right(name: str, value: int) -> None:
    system = family_system(name, value)
    result = solve(system)
    reference = Reference.of(system, result.points, np.zeros((0, 1 + system.n), dtype=complex))
    for solution, exact in zip(result.solutions, reference.high, strict=True):
        error = solution.accuracy * (1 + np.linalg.norm(exact))
        for z, known in zip(solution.point, exact, strict=True):
            text = coordinate_text(z, solution)
            parts = re.findall(r"[+-]?[0-9.]+(?:e[+-]?[0-9]+)?(?=i?)", text)
            for part, right in zip(parts, (known.real, known.imag), strict=False):
                room = error if part == "0" else 1.0001 * last_place(part)
                assert abs(float(part) - right) <= room


def test_small_coordinates_beside_large_ones_are_printed() -> None:
    x, y = Polynomial.variables(2)
    big = 10**12
    equations = ((x - big) * (x - 2 * big), 10**6 * y**2 - 1 + (x - big) * (y - 1))
    result = solve(PolynomialSystem(("x", "y"), equations))
    shown = {coordinate_text(s.point[1], s) for s in result.solutions}
    assert shown == {"0.001", "-0.001", "-1e+06", "1"}


def test_sampled_points_are_as_near_to_the_curve_as_they_say() -> None:
    system = read_case(CASES / "rhombus.toml").system
    evaluator = Evaluator.of(system.polynomials, system.n)
    for component in decompose(system).components:
        found = sample(system, component, 6, seed=1)
        for point in found.points:
            # Across the curve: what lies beside the point is the nearest of its points, or near it.
            tangent = np.linalg.svd(evaluator.jacobian(point))[2][-component.dimension :]
            rows = np.hstack([-tangent @ point[:, None], tangent])
            reference = Reference.of(system, point[None], rows)
            assert errors(reference, point[None])[0] <= found.accuracy


@pytest.mark.parametrize("gap", [Fraction(1, 10**7), Fraction(1, 10**9)])
def test_zeros_beyond_doubles_are_written_to_digits_that_are_right(gap: Fraction) -> None:
    x, y = Polynomial.variables(2)
    system = PolynomialSystem(("x", "y"), (x**2 - 2 * x + 1 - 2 * gap**2, y**2 - x - 2))
    document = certify_solutions(solve(system)).document()
    points = [p["decimals"] for p in document["points"] if "decimals" in p]
    assert points
    with flint.ctx.workdps(120):
        off = flint.arb(2).sqrt() * flint.arb(flint.fmpq(gap.numerator, gap.denominator))
        for (x_text, _), (y_text, _) in points:
            first = min((1 + off, 1 - off), key=lambda z, t=x_text: abs(flint.arb(t) - z))
            for text, exact in ((x_text, first), (y_text.lstrip("-"), (first + 2).sqrt())):
                assert len(text) > 20
                places = len(text.partition(".")[2])
                assert abs(flint.arb(text) - exact) <= flint.arb(10) ** -places


DECOMPOSED = [
    *((n, None) for n in ("four-bar", "rhombus", "slider-crank", "literature/whitney-umbrella")),
    *(("lengths", k) for k in (1, 2, 4, -4)),
    *(("kite", k) for k in (2, 8)),
    *(("hyperbola", k) for k in (2, 8)),
    ("touching", 4),
]


@pytest.mark.parametrize(("name", "value"), DECOMPOSED, ids=str)
def test_witness_points_are_as_accurate_as_they_say(name: str, value: int | None) -> None:
    if value is None:
        system = read_case(CASES / f"{name}.toml").system
    else:
        system = family_system(name, value)
    answer = decompose(system)
    assert answer.components
    certificate = certify_decomposition(answer)
    for component, proved in zip(answer.components, certificate.components, strict=True):
        reference = Reference.of(system, component.points, component.slice.rows)
        assert (errors(reference, component.points) <= component.accuracy).all()
        assert within(reference, proved.points)


def test_a_singular_zero_has_the_hundred_digits_that_it_shows() -> None:
    x, y = Polynomial.variables(2)
    end = analyse(
        [(x - y) ** 3, x**2 + y**2 - 3], np.array([1.5**0.5] * 2), 1e-9, np.random.default_rng(0)
    )
    with flint.ctx.workdps(130):
        exact = (flint.arb(3) / 2).sqrt()
        for z, ball in zip(end.precise.centre, end.precise.balls, strict=True):
            assert abs(z - exact) < flint.arb(10) ** -99
            assert ball.real.contains(exact)
        off = np.abs([float(flint.arb(float(z.real)) - exact) for z in end.point]).max()
    assert off <= end.accuracy * 1.5**0.5
