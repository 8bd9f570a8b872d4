"""Digits of sharpened points and of projections' points, against zeros known to 300 digits."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from decimal import Decimal
from fractions import Fraction
from math import isqrt
from pathlib import Path

import flint
import numpy as np
import pytest

import nag
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.bench.atlas.changes import NAMES, Coordinates, combine_equations
from nag.bench.reference import Reference
from nag.cli import main
from nag.decomposition import project
from nag.decomposition.decompose import decompose
from nag.numerics.local_dimension import LocalDimension, local_dimension

CASES = Path(__file__).parents[1] / "cases"
DIGITS = 300
Exact = Callable[[], list[flint.arb]]


def digits_of(text: str) -> int:
    """How many digits a decimal number shows."""
    return len(Decimal(text).as_tuple().digits)


def right_digits(found: LocalDimension, exact: Sequence[flint.arb]) -> list[int]:
    """How many digits of each coordinate are shown, which must all be right."""
    assert len(found.digits) == len(exact)
    for (re, im), z in zip(found.digits, exact, strict=True):
        last = flint.arb(10) ** Decimal(re).as_tuple().exponent
        if re != "0":
            assert abs(flint.arb(re) - z) <= last
        else:
            assert abs(z) < flint.arb(10) ** -70
        assert im == "0"
    return [digits_of(re) for re, _ in found.digits]


def rounded(exact: Sequence[flint.arb]) -> np.ndarray:
    return np.array([complex(float(z)) for z in exact])


@pytest.mark.parametrize("shift", [0, 9, 30, 55])
@pytest.mark.parametrize("power", [0, 20, 60])
def test_linear_equations_carry_no_more_digits_over_than_they_leave(shift: int, power: int) -> None:
    near, big = Fraction(isqrt(2 * 10 ** (2 * shift)), 10**shift), Fraction(10**power)
    x, y, z = Polynomial.variables(3)
    system = PolynomialSystem(NAMES[:3], (x**2 - 2, y - big * (x - near), (z - x) ** 2))
    with flint.ctx.workdps(DIGITS):
        root = flint.arb(2).sqrt()
        off = 10**power * (root - flint.arb(flint.fmpq(near.numerator, near.denominator)))
        exact = [root, off, root]
        point = rounded(exact)
        found = local_dimension(system, point)
        shown = right_digits(found, exact)
    assert (found.dimension, found.tangent_dimension, found.multiplicity) == (0, 1, 2)
    assert shown[0] == shown[2] == 100
    assert 60 <= shown[1] <= 125 - shift


@pytest.mark.parametrize("power", [3, 10, 20, 40, 50, 60])
def test_equations_that_are_nearly_dependent_leave_fewer_digits(power: int) -> None:
    x, y = Polynomial.variables(2)
    u, v = x**2 - 2, y**2 - 3
    system = PolynomialSystem(NAMES[:2], (u + v, u + v * (1 + Fraction(1, 10**power))))
    with flint.ctx.workdps(DIGITS):
        exact = [flint.arb(2).sqrt(), flint.arb(3).sqrt()]
        found = local_dimension(system, rounded(exact))
        shown = right_digits(found, exact)
    assert (found.tangent_dimension, found.multiplicity) == (0, 1)
    assert all(min(100, 130 - power) <= k <= 145 - power or k == 100 for k in shown)


def _moved(
    equations: Sequence[Polynomial], points: Sequence[flint.arb], rng: np.random.Generator
) -> tuple[PolynomialSystem, list[flint.arb]]:
    """The equations in random exact coordinates, mixed, and a point of them in these."""
    n = equations[0].n
    coordinates = Coordinates.random(n, rng)
    system = PolynomialSystem(
        NAMES[:n], combine_equations([coordinates.of(f) for f in equations], rng)
    )
    constant = (0,) * n
    unit = [tuple(int(i == j) for i in range(n)) for j in range(n)]

    def number(c: Fraction | int) -> flint.arb:
        return flint.arb(flint.fmpq(Fraction(c).numerator, Fraction(c).denominator))

    matrix = flint.arb_mat([[number(f.terms.get(e, 0)) for e in unit] for f in coordinates.forms])
    shifts = [number(f.terms.get(constant, 0)) for f in coordinates.forms]
    right = flint.arb_mat([[p - s] for p, s in zip(points, shifts, strict=True)])
    return system, list(matrix.solve(right).entries())


X, Y, Z = Polynomial.variables(3)
ROOT: Exact = lambda: [flint.arb(2).sqrt(), flint.arb(0), 1 - flint.arb(2).sqrt()]  # noqa: E731
# Equations, a point in closed form, its local dimension, tangent dimension and multiplicity.
KINDS = {
    "node": ((Y**2 - (X**2 - 2) ** 2 * (X + 3), Z + X - 1), 1, 2, None),
    "cusp": ((Y**2 - (X**2 - 2) ** 3, Z + X - 1), 1, 2, None),
    "tacnode": ((Y**2 - (X**2 - 2) ** 4, Z + X - 1), 1, 2, None),
    "lines": ((Y * (X**2 - 2) * (Y - X**2 + 2), Z + X - 1), 1, 2, None),
    "regular": ((X**2 - 2, Y, Z + X - 1), 0, 0, 1),
    "double": ((X**2 - 2, Y**2, Z + X - 1), 0, 1, 2),
    "triple": ((X**2 - 2, Y**3, (Z + X - 1) * (Z + 5)), 0, 1, 3),
    "square": (((X**2 - 2) ** 2, Y**2, Z + X - 1), 0, 2, 4),
    "touching": ((Y - (X**2 - 2) ** 2, Y + (X**2 - 2) ** 2 * X, Z**2 + 2 * X - 3), 0, 1, 2),
    "cone": (((X**2 - 2) ** 2 + Y**2 - (Z + X - 1) ** 2,), 2, 3, None),
    "surfaces": ((Y * (Z + X - 1),), 2, 3, None),
}


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("places", [9, 12, 17])
def test_a_point_in_general_coordinates_is_what_it_is_to_all_digits(kind: str, places: int) -> None:
    equations, dimension, tangent, multiplicity = KINDS[kind]
    for seed in range(3):
        with flint.ctx.workdps(DIGITS):
            system, exact = _moved(equations, ROOT(), np.random.default_rng([seed, places]))
            given = np.array([complex(round(float(z), places)) for z in exact])
            found = local_dimension(system, given, seed=seed)
            assert (found.dimension, found.tangent_dimension) == (dimension, tangent)
            assert found.multiplicity == multiplicity
            if kind != "surfaces":
                assert min(n for n in right_digits(found, exact) if n) >= 90


def test_a_rounded_point_of_a_curve_is_on_it_to_all_digits_that_are_shown() -> None:
    x, y = Polynomial.variables(2)
    system = PolynomialSystem(NAMES[:2], (x**3 + y**3 - 3 * x * y - 1,))
    for start in (1.7, -2.3, 0.4):
        roots = np.roots([1, 0, -3 * start, start**3 - 1])
        with flint.ctx.workdps(DIGITS):
            found = local_dimension(system, np.array([start, roots[0]], dtype=complex))
            (a, _), (b, c) = found.digits
            point = flint.acb(flint.arb(b), flint.arb(c))
            value = flint.arb(a) ** 3 + point**3 - 3 * flint.arb(a) * point - 1
            assert found.dimension == found.tangent_dimension == 1
            assert abs(value) < flint.arb(10) ** -95


# Curves, coordinates, and for each component dimension and degree of the image, and of the fibre.
CURVES = {
    "cubic": (("y - x^2", "z - x*y"), (0, 1), [(1, 2, 1)]),
    "cubic on a line": (("y - x^2", "z - x*y"), (2,), [(1, 1, 3)]),
    "circle in space": (("x^2 + y^2 - 2", "z^2 - x - 3"), (0, 1), [(1, 2, 2)]),
    "two": (("(x^2 + y^2 - 2)*(y^2 - x^3 + 3*x - 2)",), (0,), [(1, 1, 2), (1, 1, 2)]),
    "surface": (("x*y*z - x - y + 2",), (0, 1), [(2, 1, 1)]),
    "sphere": (("x^2 + y^2 + z^2 - 2",), (0, 1), [(2, 1, 2)]),
    "far": (("(x - 10^9)^2 + y^2 - 1", "z - x + 10^9 - 3"), (1, 2), [(1, 2, 1)]),
    "small": (("x*y - 1/10^8", "z - x - y"), (0, 2), [(1, 2, 1)]),
    "thin": (("(x + 2*y - 1)*(x + 2*y - 1 - 1/10^5)", "z - x*y"), (0, 1), [(1, 1, 1)] * 2),
}


@pytest.mark.parametrize("name", CURVES)
def test_points_of_projections_are_as_accurate_as_they_say(name: str) -> None:
    equations, coordinates, known = CURVES[name]
    system = nag.system(list(equations))
    for seed in range(3):
        answer = decompose(system, seed=seed)
        images = [project(system, c, coordinates, seed=seed) for c in answer.components]
        assert sorted((i.dimension, i.degree, i.fibre_degree) for i in images) == sorted(known)
        for image in images:
            assert len(image.points) == image.degree * image.fibre_degree
            # The first equations of the slice are in the image's coordinates.
            others = [j for j in range(system.n) if j not in coordinates]
            assert not image.slice.A[: image.dimension, others].any()
            reference = Reference.of(system, image.points, image.slice.rows)
            off = np.linalg.norm((image.points - reference.high) - reference.low, axis=1)
            assert (off <= image.accuracy * (1 + np.linalg.norm(reference.high, axis=1))).all()
            # Not worse than it is said to be by more than what is never believed in doubles.
            assert image.accuracy < 1e-9


@pytest.mark.parametrize("name", ["spatial/bricard_cube", "bennett", "spatial/universal-shaft"])
def test_a_rounded_configuration_of_a_mechanism_closes_to_all_digits(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case = CASES / f"{name}.toml"
    made = nag.model(nag.read_case(case).mechanism)
    system = made.system
    places = zip(system.variables, made.reference, strict=True)
    at = ", ".join(f"{v} = {float(x):.9f}" for v, x in places)
    target = tmp_path / "local.json"
    command = ["local", str(case), "--quiet", "--at", at, "--json", str(target)]
    assert main(command) == 0
    (found,) = json.loads(target.read_text())["points"]
    assert f"local dimension {found['local_dimension']}" in capsys.readouterr().out
    assert found["local_dimension"] == 1
    with flint.ctx.workdps(DIGITS):
        shown = [flint.acb(*map(flint.arb, pair)) for pair in found["sharpened"]]
        for f in system.polynomials:
            terms = [abs(monomial(shown, e, c)) for e, c in f.terms.items()]
            value = sum((monomial(shown, e, c) for e, c in f.terms.items()), start=flint.acb(0))
            assert abs(value) < sum(terms, start=flint.arb(0)) * flint.arb(10) ** -95


def monomial(x: Sequence[flint.acb], exponents: Sequence[int], c: Fraction) -> flint.acb:
    value = flint.acb(flint.arb(flint.fmpq(c.numerator, c.denominator)))
    for z, k in zip(x, exponents, strict=True):
        value *= z**k
    return value
