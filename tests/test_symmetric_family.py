"""Rational symmetries of families: cognates are exact, groups finite, and maps are checked."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nag.algebra.expression import parse_polynomial
from nag.algebra.family import Family
from nag.algebra.polynomial import Polynomial
from nag.algebra.rational_map import MapError, MapGroup, RationalMap
from nag.algebra.symmetric_family import SymmetricFamily
from nag.files.cases import CaseError, read_case
from nag.solving.parameter import solve_generic

NINE_POINTS = read_case(Path(__file__).parent.parent / "cases" / "benchmarks" / "nine-point.toml")
FOUR_BARS = NINE_POINTS.family.symmetric
NAMES = ["x", "y", "a"]


def rational_map(*images: str) -> RationalMap:
    """A map of x and y, which may depend on a; an image is a polynomial or "p : q"."""
    parts = [[parse_polynomial(t, NAMES) for t in (i + " : 1").split(":")[:2]] for i in images]
    return RationalMap(tuple(p for p, _ in parts), tuple(q for _, q in parts))


def exact_images(group: MapGroup, point: tuple, values: tuple) -> list[tuple]:
    images = []
    for word in group.words:
        image = point
        for generator in word:
            image = group.generators[generator].exact(image, values)
        images.append(image)
    return images


rationals = st.fractions(-5, 5, max_denominator=20).filter(lambda v: v not in (0, 1))


def four_bar_at_two_displacements(numbers: list[Fraction]) -> tuple[tuple, tuple]:
    """A four-bar in isotropic coordinates, exactly at its positions 1 and 2; and all parameters.

    Two turns of the coupler and of one crank say where the coupler point goes; the other fixed
    pivot then solves two linear equations.
    """
    x, xh, a, ah, y, yh, t1, t2, f1, f2, *rest = numbers
    turns = [(t1, f1), (t2, f2)]
    d = [a - x * t + (x - a) * f for t, f in turns]
    dh = [ah - xh / t + (xh - ah) / f for t, f in turns]
    g = [t - 1 for t, _ in turns]
    gh = [1 / t - 1 for t, _ in turns]
    rows = [(yh * h + eh, y * k + e) for e, eh, k, h in zip(d, dh, g, gh, strict=True)]
    right = [
        y * k * eh + yh * h * e + e * yh + eh * y + e * eh
        for e, eh, k, h in zip(d, dh, g, gh, strict=True)
    ]
    determinant = rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0]
    b = (right[0] * rows[1][1] - right[1] * rows[0][1]) / determinant
    bh = (right[1] * rows[0][0] - right[0] * rows[1][0]) / determinant
    halves = [(x, a, y, b, *g, *rest[:6]), (xh, ah, yh, bh, *gh, *rest[6:12])]
    return tuple(halves), ((*d, *rest[12:18]), (*dh, *rest[18:24]))


@given(st.lists(rationals, min_size=34, max_size=34))
@settings(max_examples=10)
def test_all_six_of_a_class_satisfy_the_equations_exactly(numbers: list[Fraction]) -> None:
    try:
        halves, values = four_bar_at_two_displacements(numbers)
        images = [exact_images(FOUR_BARS.group, h, v) for h, v in zip(halves, values, strict=True)]
    except ZeroDivisionError:
        return
    # The first six equations are those of positions 1 and 2.
    for first, second in zip(*images, strict=True):
        z = (*first, *second, *values[0], *values[1])
        assert [f(z) for f in FOUR_BARS.family.polynomials[:6]] == [0] * 6


def test_the_symmetries_of_four_bars_are_a_group_of_six() -> None:
    assert len(FOUR_BARS) == 6
    rng = np.random.default_rng(0)
    z = [Fraction(int(v)) for v in rng.integers(1, 10**6, 20)]
    images = exact_images(FOUR_BARS.group, tuple(z[:12]), tuple(z[12:]))
    assert len(set(images)) == 6
    # The pivots a, b and c of a four-bar are those of its cognates.
    pivots = {frozenset((image[1], image[3])) for image in images}
    assert len(pivots) == 3 and len(frozenset().union(*pivots)) == 3


def test_images_in_doubles_are_the_exact_ones() -> None:
    group = MapGroup.generated([rational_map("y : a", "x*a"), rational_map("-x", "-y")])
    assert len(group) == 4
    point, value = (Fraction(3), Fraction(-2)), Fraction(5)
    images = group.images(np.array([[3.0, -2.0]]), np.array([5.0]))
    exact = exact_images(group, point, (value,))
    assert np.abs(images[:, 0] - np.array(exact, dtype=float)).max() < 1e-15


def test_infinite_groups_and_poles_everywhere_are_refused() -> None:
    with pytest.raises(MapError, match="more than 720"):
        MapGroup.generated([rational_map("x + 1", "y")])
    with pytest.raises(MapError, match="vanishes everywhere"):
        MapGroup.generated([rational_map("x : y - y", "y")])


def test_isotropic_coordinates_keep_the_equations() -> None:
    rng = np.random.default_rng(1)
    points = rng.normal(size=(3, 24)) + 1j * rng.normal(size=(3, 24))
    values = rng.normal(size=16)
    inner, inner_values = FOUR_BARS.inner(points), FOUR_BARS.inner_values(values)
    assert np.abs(FOUR_BARS.outer(inner) - points).max() < 1e-14
    assert np.abs(FOUR_BARS.outer_values(inner_values) - values).max() < 1e-14
    for x, y in zip(points, inner, strict=True):
        for f, g in zip(FOUR_BARS.original.polynomials, FOUR_BARS.family.polynomials, strict=True):
            assert abs(f([*x, *values], float) - g([*y, *inner_values], float)) < 1e-12


def family(*equations: str) -> Family:
    names = ["x", "y", "p", "q"]
    polynomials = tuple(parse_polynomial(e, names) for e in equations)
    return Family(("x", "y"), ("p", "q"), polynomials)


def test_equations_without_mirror_images_have_no_isotropic_coordinates() -> None:
    plain = SymmetricFamily(family("x^2 + y^2 - p^2 - q^2", "x + y - q"), plane=((0, 1), (2, 3)))
    with pytest.raises(MapError, match="mirror images"):
        _ = plain.family
    with pytest.raises(MapError, match="every unknown and every parameter"):
        SymmetricFamily(family("x - p", "y - q"), plane=((0, 1),))
    with pytest.raises(MapError, match="one vector"):
        SymmetricFamily(family("x - p", "y - q"), plane=((0, 2), (1, 3)))


def test_maps_that_are_no_symmetries_are_found_out() -> None:
    one = Polynomial.constant(4, 1)
    x, y, *_ = Polynomial.variables(4)
    negation = MapGroup.generated([RationalMap((-x, y), (one, one))])
    wrong = family("x^2 + x - p", "y^2 - q*x - 1")
    with pytest.raises(MapError, match="do not carry solutions to solutions"):
        solve_generic(SymmetricFamily(wrong, negation))


CASE = """
title = "t"
kind = "system"
variables = ["x", "y"]
equations = ["x^2 + y^2 - p", "x*y - q"]
[parameters]
p = 5
q = 2
[family]
parameters = ["p", "q"]
"""


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (('["p", "q"]', '["p", "r"]'), "[family]: parameters: unknown parameter"),
        (('["p", "q"]', '["p", "p"]'), "there twice"),
        (('["x", "y"]', '["x", "y", "z"]'), "2 equations in 3 variables"),
        (("p = 5", 'p = "sqrt(2)"'), "irrational"),
        (("[family]", "[family]\nmaps = 1"), "unknown key"),
        (("[family]", '[family]\nplane = { v = ["x", "z"] }'), "unknown coordinate"),
        (("[family]", '[family]\nplane = { v = ["x", "y"] }'), "every unknown and every"),
        (("[family]", '[family]\nmap = [{ image = { z = "x" } }]'), "unknown name"),
        (("[family]", '[family]\nmap = [{ image = { x = ["y", "x - x"] } }]'), "is zero"),
        (("[family]", "[family]\nmap = [{ image = { x = 3 } }]"), "whole number"),
        (("[family]", '[family]\nmap = [{ image = { x = "2*x" } }]'), "more than 720"),
    ],
)
def test_mistakes_in_families_are_named(
    tmp_path: Path, change: tuple[str, str], message: str
) -> None:
    path = tmp_path / "case.toml"
    path.write_text(CASE.replace(*change, 1))
    with pytest.raises(CaseError) as error:
        read_case(path)
    assert message in str(error.value) and "\n" not in str(error.value)


def test_a_family_has_the_parameters_of_the_case() -> None:
    assert NINE_POINTS.family.solutions == 8652
    system = NINE_POINTS.family.symmetric.original.at(NINE_POINTS.family.values)
    assert system.polynomials == NINE_POINTS.system.polynomials
