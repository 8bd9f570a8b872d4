"""Relations among numbers of many digits, and that the proofs of what they suggest refuse."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import flint
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nag.algebra.expression import parse_polynomial
from nag.algebra.groebner import ideal_of
from nag.algebra.multipliers import multipliers
from nag.algebra.number import Surd, square_root
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.interpolation.essential import maps
from nag.interpolation.point_cloud import AmbientVariables, Cloud
from nag.interpolation.precise_samples import SourceError, source_at
from nag.interpolation.proof import (
    cleared_map,
    equations_ideal,
    largest_value,
    proved_by_reduction,
    substitution,
)
from nag.interpolation.vanishing import (
    Interpolated,
    monomials_of_degree,
    next_degree,
    primitive,
    start,
)
from nag.numerics.rational_relations import (
    Echelon,
    TooFewDigitsError,
    recognise_rational,
    recognise_sum_of_roots,
)
from nag.tracking.run import Run

laws = settings(max_examples=25)
DIGITS = 60


def ball(x: Fraction, radius: int = DIGITS) -> flint.arb:
    return flint.arb(flint.fmpq(x.numerator, x.denominator)) + flint.arb(0, f"1e-{radius}")


def system(names: str, *equations: str) -> PolynomialSystem:
    variables = tuple(names.split())
    return PolynomialSystem(variables, tuple(parse_polynomial(f, variables) for f in equations))


def cloud(equations: PolynomialSystem, *point: int | str) -> Cloud:
    rng = np.random.default_rng(0)
    source = source_at(equations, tuple(Fraction(x) for x in point), rng)
    return Cloud(source, AmbientVariables.itself(equations), rng, Run())


rationals = st.builds(Fraction, st.integers(-(10**6), 10**6), st.integers(1, 10**6))


@laws
@given(st.integers(0, 2**32), st.lists(rationals, min_size=1, max_size=5))
def test_a_combination_of_independent_columns_is_found_exactly(seed, coefficients) -> None:
    rng = np.random.default_rng(seed)
    k = len(coefficients)
    columns = [[Fraction(int(x), 997) for x in rng.integers(-999, 999, k + 3)] for _ in range(k)]
    exact = flint.fmpz_mat([[int(x * 997) for x in column] for column in columns])
    total = [
        sum(c * v[i] for c, v in zip(coefficients, columns, strict=True)) for i in range(k + 3)
    ]
    with flint.ctx.workdps(DIGITS + 20):
        echelon = Echelon(k + 3, DIGITS)
        found = [echelon.add([ball(x) for x in column]) for column in columns]
        if exact.rank() == k:
            assert found == [None] * k
            assert echelon.relation([ball(x) for x in total]) == coefficients
            assert echelon.copy().add([ball(x) for x in total]) == coefficients
            assert echelon.relation([ball(x + (i == 0)) for i, x in enumerate(total)]) is None
            assert len(echelon) == k


@laws
@given(rationals)
def test_rational_numbers_are_recognised(x) -> None:
    with flint.ctx.workdps(DIGITS + 20):
        assert recognise_rational(ball(x), DIGITS) == x


@laws
@given(rationals, rationals, rationals, rationals)
def test_sums_of_square_roots_are_recognised(a, b, c, d) -> None:
    roots = [square_root(Fraction(n)) for n in (2, 3, 6)]
    x = a + b * roots[0] + c * roots[1] + d * roots[2]
    with flint.ctx.workdps(4 * DIGITS + 20):
        known = x.ball(14 * DIGITS) if isinstance(x, Surd) else ball(x)
        known += flint.arb(0, f"1e-{4 * DIGITS}")
        assert recognise_sum_of_roots(known, (1, 2, 3, 6), 4 * DIGITS) == x


@pytest.mark.parametrize("value", [2, 3, 5])
def test_other_roots_are_no_sums_of_these(value) -> None:
    for digits in (20, 40, 80, 160):
        with flint.ctx.workdps(digits + 20):
            root = flint.arb(value).sqrt().sqrt() + flint.arb(0, f"1e-{digits}")
            with pytest.raises(TooFewDigitsError):
                recognise_sum_of_roots(root, (1, 2, 3, 6), digits)


@pytest.mark.parametrize("value", [2, 3, 5])
def test_irrational_numbers_are_not(value) -> None:
    for digits in (20, 40, 80, 160):
        with flint.ctx.workdps(digits + 20):
            root = flint.arb(value).sqrt() + flint.arb(0, f"1e-{digits}")
            with pytest.raises(TooFewDigitsError):
                recognise_rational(root, digits)


def test_wide_balls_do_not_decide() -> None:
    with flint.ctx.workdps(DIGITS + 20):
        echelon = Echelon(3, DIGITS)
        with pytest.raises(TooFewDigitsError):
            echelon.add([ball(Fraction(0), 10)] * 3)


@pytest.mark.parametrize(("n", "degree", "count"), [(1, 4, 1), (3, 2, 6), (4, 3, 20), (2, 0, 1)])
def test_monomials_ascend(n, degree, count) -> None:
    """As FLINT orders them."""
    found = monomials_of_degree(n, degree)
    assert len(set(found)) == len(found) == count
    ring = flint.fmpz_mpoly_ctx.get([f"x{i}" for i in range(n)], flint.Ordering.degrevlex)
    everything = ring.from_dict(dict.fromkeys(found, 1))
    assert [tuple(map(int, e)) for e in everything.monoms()] == found[::-1]


def all_up_to(points: Cloud, coordinates: list[int], degree: int) -> Interpolated:
    known = start(coordinates)
    while known.degree < degree:
        known = next_degree(points, known)
    return known


CURVES = {
    "twisted cubic": (("x y z", "y - x^2", "z - x^3"), ["x^2 - y", "x*y - z", "y^2 - x*z"]),
    # One quadric and, as the curve is no complete intersection, three cubics.
    "rational quartic": (
        ("x y z t", "x - t", "y - t^3", "z - t^4"),
        ["x*y - z", "x^2*z - y^2", "y^3 - x*z^2", "x^3 - y"],
    ),
}


@pytest.mark.parametrize("name", CURVES)
def test_ideals_of_rational_curves(name) -> None:
    given_system, expected = CURVES[name]
    equations = system(*given_system)
    points = cloud(equations, *[0] * equations.n)
    known = all_up_to(points, [0, 1, 2], 4)
    names = ["x", "y", "z"]
    printed = [parse_polynomial(f, names) for f in expected]
    assert ideal_of(known.generators, names) == ideal_of(printed, names)
    assert len(known.generators) == len(printed)
    d = len(expected)
    assert known.counts == (1, 4, *(d * i + 1 for i in range(2, 5)))


def test_generators_are_primitive() -> None:
    f = parse_polynomial("2/3*x - 4/5*x^2 + 2", ["x"])
    assert primitive(f) == parse_polynomial("6*x^2 - 5*x - 15", ["x"])


CUBIC = ("x y z", "y - x^2", "z - x^3")


def test_substitution_refuses_what_is_wrong() -> None:
    points = cloud(system(*CUBIC), 1, 1, 1)
    found = maps(points, start([0]), [1, 2])
    proved = substitution(points, [0], (), (), found)
    assert proved is not None
    n = 3
    assert all(proved.proves(cleared_map(m, n, [0])) for m in found)
    assert not proved.proves(parse_polynomial("x*y - z + x - 1", ["x", "y", "z"]))
    x = Polynomial.variable(1, 0)
    for wrong in (x**2 + x - 1, x, 2 - x**2):
        # Each has the right value at the point.
        changed = (replace(found[0], numerator=wrong), found[1])
        assert substitution(points, [0], (), (), changed) is None
    assert substitution(points, [0], (), (), found[:1]) is None


def test_substitution_refuses_generators_that_do_not_vanish() -> None:
    points = cloud(system("x y z", "x^2 + y^2 - 1", "z - x*y"), 1, 0, 0)
    known = all_up_to(points, [0, 1], 2)
    found = maps(points, known, [2])
    assert substitution(points, [0, 1], known.generators, known.basis, found) is not None
    wrong = (parse_polynomial("x^2 + 2*y^2 - 1", ["x", "y"]),)
    assert substitution(points, [0, 1], wrong, wrong, found) is None


def test_reduction_proves_what_holds_on_one_component_only() -> None:
    """A line and a conic: what vanishes on the conic alone is proved for it and not the line."""
    names = ["x", "y"]
    equations = system("x y", "(x^2 + y^2 - 1)*(x + y - 3)")
    conic, line = cloud(equations, 1, 0), cloud(equations, 1, 2)
    ideal = equations_ideal(conic)
    assert ideal is not None
    circle, linear = (parse_polynomial(f, names) for f in ("x^2 + y^2 - 1", "x + y - 3"))
    assert proved_by_reduction(conic, ideal, circle)
    assert proved_by_reduction(line, ideal, linear)
    assert proved_by_reduction(line, ideal, circle * linear)
    assert not proved_by_reduction(line, ideal, circle)
    assert not proved_by_reduction(conic, ideal, linear)
    assert not proved_by_reduction(conic, ideal, circle + linear)


def test_multipliers_are_the_quotient_of_the_ideal() -> None:
    names = ["x", "y"]
    ideal = ideal_of([parse_polynomial("x^2*y", names), parse_polynomial("x*y^2", names)], names)
    found = multipliers(ideal, parse_polynomial("x*y", names), 1, 10)
    assert found is not None
    assert {primitive(f).text(names) for f in found} == {"x", "y"}
    assert multipliers(ideal, parse_polynomial("x*y", names), 0, 10) == []
    assert multipliers(ideal, parse_polynomial("x", names), 3, 4) is None


def test_fresh_points_show_what_does_not_vanish() -> None:
    points = cloud(system(*CUBIC), 1, 1, 1)
    names = ["x", "y", "z"]
    assert largest_value(points, [parse_polynomial("x*z - y^2", names)], 100) < -95
    tiny = parse_polynomial("x*z - y^2 + 1/10^40*x", names)
    assert -45 < largest_value(points, [tiny], 100) < -35


def test_a_shaky_point_is_no_source() -> None:
    """The tangent y = 0 of x^2 + y^2 = 1 and the circle itself meet twice: nothing moves."""
    equations = system("x y", "x^2 + y^2 - 1", "y - 1")
    with pytest.raises(SourceError, match="singular; name a component"):
        cloud(equations, 0, 1).samples(1)
