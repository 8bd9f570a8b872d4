"""Points and components nearer to each other than paths tell: which is which."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

import nag
from nag.decomposition import witness_at
from nag.numerics.precise_point import PrecisePoint
from nag.numerics.singular_point import Place, SingularEnd
from nag.numerics.zero_values import choose_alike
from nag.witness.membership import Membership, memberships

PAIRS = {
    "parabolas": ("y - x^2", "y - x^2 - {0}", (2, 4)),
    "a circle and a line": ("x^2 + y^2 - 1", "x + y - 7/5 - {0}", (Fraction(3, 5), Fraction(4, 5))),
    "lines": ("x - y", "x - y - {0}", (Fraction(1, 3), Fraction(1, 3))),
    "a cusp and a cubic": ("y^2 - x^3", "(y - {0})^2 - x^3", (0, 0)),
}


def decomposed(name: str, digits: int) -> tuple[nag.Decomposition, nag.WitnessSet, nag.WitnessSet]:
    """Two sets together, and the component of each of the two equations."""
    first, second, _ = PAIRS[name]
    texts = first, second.format(f"1/10^{digits}")
    answer = nag.decompose(f"({texts[0]})*({texts[1]})")
    assert answer.complete and len(answer.components) == 2
    own, other = ([c for c in answer.components if _is_cut_by(c, text)] for text in texts)
    assert len(own) == len(other) == 1
    return answer, own[0], other[0]


def _is_cut_by(component: nag.WitnessSet, text: str) -> bool:
    (f,) = nag.system([text], "x y").polynomials
    ((g,),) = (fibre.cut.polynomials for fibre in component.fibres)
    return f.terms.keys() == g.terms.keys() and len({g.terms[e] / f.terms[e] for e in f.terms}) == 1


@pytest.mark.parametrize("digits", [9, 12, 20, 30])
@pytest.mark.parametrize("name", PAIRS)
def test_exact_points_are_on_the_component_whose_equations_hold(name: str, digits: int) -> None:
    _, own, other = decomposed(name, digits)
    point = PAIRS[name][2]
    assert own.contains(point)
    assert not other.contains(point)


@pytest.mark.parametrize("name", PAIRS)
def test_points_in_doubles_are_told_apart_as_far_as_their_errors_go(name: str) -> None:
    answer, own, other = decomposed(name, 9)
    point = np.array(PAIRS[name][2], dtype=complex)
    found = dict(zip(map(id, answer.components), memberships(answer, point), strict=True))
    assert found[id(own)] is Membership.MEMBER
    assert found[id(other)] is not Membership.MEMBER


@pytest.mark.parametrize("digits", [9, 20])
def test_lines_are_sampled_and_cut_each_by_its_own_equation(digits: int) -> None:
    answer, *lines = decomposed("lines", digits)
    target = nag.Slice(np.array([[1.0, 1.0]]), np.array([0.0]))
    for line, apart in zip(lines, (0, 10.0**-digits), strict=True):
        for points in (line.sample(0, 4), witness_at(answer.system, line, target).points):
            assert points[:, 0] - points[:, 1] == pytest.approx(apart, rel=1e-6, abs=1e-40)


def test_a_linear_component_holds_its_equations() -> None:
    answer = nag.decompose(
        ["(x - y)*(x + z - 1)", "x + y + z + w - 2", "2*x + 2*y + 2*z + 2*w - 4"]
    )
    for plane in answer.components:
        (fibre,) = plane.fibres
        assert len(fibre.cut.polynomials) == 2 and fibre.dimension == plane.dimension == 2


def test_a_component_without_its_equations_is_that_of_the_nearest_branch() -> None:
    _, *lines = decomposed("lines", 9)
    for line, apart in zip(lines, (0, 1e-9), strict=True):
        points = replace(line, fibres=()).sample(0, 4)
        assert points[:, 0] - points[:, 1] == pytest.approx(apart, rel=1e-5, abs=1e-15)


def test_isolated_points_near_to_each_other_are_not_one() -> None:
    answer = nag.decompose(["x*(x - 1/10^9)*(x - 1)", "y - 1/3*x"])
    for x in (0, Fraction(1, 10**9), 1):
        assert sum(c.contains((x, Fraction(x) / 3)) for c in answer.components) == 1


@pytest.mark.parametrize(
    "text", ["(x + y - 1/3)^2 - (x - 1/3)^3", "(x + y - 1/3)^2 - (x - 1/3)^3 - (x - 1/3)^2"]
)
def test_a_singular_point_that_doubles_round_is_on_its_curve(text: str) -> None:
    (curve,) = nag.decompose(text).components
    assert curve.contains((Fraction(1, 3), 0))
    assert curve.contains(np.array([1 / 3 + 0j, 0j]))


def test_a_point_is_on_a_line_in_coordinates_of_very_unequal_sizes() -> None:
    # Slices through the point are rounded: they fix x to a part of 1e11 only.
    slant = "3*x/400000000000 + y + 799999999997/600000000000"
    answer = nag.decompose(f"(y + 4/3)*({slant})*(-x^2 + y - 1/2)")
    point = (Fraction(1, 4), Fraction(-1279999999997, 960000000000))
    assert [c.contains(point) for c in answer.components] == [
        _is_cut_by(c, slant) for c in answer.components
    ]
    assert sum(c.contains(point) for c in answer.components) == 1


def test_a_rounded_point_is_not_on_a_sheet_further_off_than_its_error() -> None:
    # The slice meets the sheets at a small angle: ends are further off than the sheets.
    sheet = "2*x*y^2/3 - y^2/2 + z"
    answer = nag.decompose(f"({sheet})*(-y^2 + y/4 + z - 1/2)*({sheet} - 1/10^7)")
    point = np.array([-1, -3, 10.5], dtype=complex)
    assert [c.contains(point) for c in answer.components] == [
        c.contains((-1, -3, "21/2")) for c in answer.components
    ]
    assert sum(c.contains(point) for c in answer.components) == 1


@pytest.mark.parametrize("digits", [9, 16, 40])
def test_an_exact_point_is_the_isolated_zero_whose_equations_it_satisfies(digits: int) -> None:
    answer = nag.decompose([f"(x^2 + y^2 - 5)*(x - 2 - y/10^{digits})", "(y - 1)*(x + y - 3)"])
    assert answer.complete and len(answer.components) == 5
    assert sum(c.contains((2, 1)) for c in answer.components) == 1


@pytest.mark.parametrize("digits", [16, 40])
def test_which_zero_of_the_same_equations_a_point_is_takes_exact_coordinates(digits: int) -> None:
    answer = nag.decompose([f"x*(x - 1/10^{digits})*(x - 1)", "y - x/3"])
    origin = np.zeros(2, complex)
    found = memberships(answer, origin, accuracy=1e-15)
    assert sorted(m.value for m in found) == ["foreign", "undecided", "undecided"]
    found = memberships(answer, origin, accuracy=1e-15, exact=(Fraction(0),) * 2)
    assert [m is Membership.MEMBER for m in found] == [
        not c.points.any() for c in answer.components
    ]
    assert sum(m is Membership.FOREIGN for m in found) == 2


@pytest.mark.parametrize("off", [0.0, 1e-300, 1e-250, 1e-130])
def test_the_origin_is_the_zero_whose_error_holds_it(off: float) -> None:
    # What Newton's method leaves of the origin depends on its last step.
    zeros = [
        SingularEnd(x, Place.ISOLATED, 1, 2e-16, 1.0, precise=PrecisePoint.of_doubles(x, error))
        for x, error in [
            (np.array([0, -off], complex), np.full(2, 1e-120)),
            (np.array([3e-16, 1e-16], complex), np.full(2, 1e-115)),
        ]
    ]
    assert choose_alike(zeros, np.zeros(2, complex)) == (zeros[0],)
    assert choose_alike(zeros, np.array([3e-16, 1e-16], complex)) == (zeros[1],)
    assert choose_alike(zeros, np.array([0, 1e-100], complex)) == tuple(zeros)


@pytest.mark.parametrize("digits", [16, 25])
def test_the_origin_is_told_from_two_zeros_beside_it(digits: int) -> None:
    answer = nag.decompose([f"x*(x - 1/10^{digits})*(x - 2/10^{digits})*(x - 3)", "y - x/3"])
    for k in range(3):
        exact = (Fraction(k, 10**digits), Fraction(k, 3 * 10**digits))
        point = np.array([complex(v) for v in exact])
        found = memberships(answer, point, accuracy=1e-15, exact=exact)
        assert sorted(m.value for m in found) == ["foreign", "foreign", "foreign", "member"]
        own = answer.components[found.index(Membership.MEMBER)]
        assert np.allclose(own.points[0], point, rtol=1e-12, atol=0)


@pytest.mark.parametrize("digits", [6, 8, 10])
@pytest.mark.parametrize("off", [0.0, 1e-13])
def test_rounded_points_beside_conjugate_sheets_are_told_apart(digits: int, off: float) -> None:
    # The same equations cut both sheets, y = x^2 + a and y = x^2 - a with a = sqrt(2)/10^digits.
    a = 2**0.5 * 10.0**-digits
    whole = nag.decompose([f"(y - x^2)^2 = 2*(1/10^{digits})^2", "z = x*y"])
    assert whole.complete and len(whole.components) == 2
    (upper,) = [i for i, c in enumerate(whole.components) if _is_above(c, a)]
    for x in (0.7, -0.3, 3.1):
        y = x * x + a
        point = np.array([x, y, x * y + off], dtype=complex)
        answers = memberships(whole, point)
        assert answers[1 - upper] is not Membership.MEMBER
        assert answers[upper] is not Membership.FOREIGN
        if digits < 10:
            assert answers[upper] is Membership.MEMBER


def _is_above(sheet: nag.WitnessSet, a: float) -> bool:
    (x, y, _), *_ = sheet.points
    return abs(y - x * x - a) < a


@pytest.mark.parametrize("exponent", [10, 13, 16, 20])
def test_a_rounded_point_is_not_on_two_components_that_do_not_meet_there(exponent: int) -> None:
    circles = nag.decompose(f"(x^2 + y^2 - 4)*(x^2 + y^2 - 4 - 1/10^{exponent})")
    assert set(memberships(circles, [2**0.5, 2**0.5])) == {Membership.UNDECIDED}
    crossing = nag.decompose(f"(x^2 + y^2 - 4)*(x - y - 1/10^{exponent})")
    both = memberships(crossing, [2**0.5 + 10.0**-exponent / 2, 2**0.5 - 10.0**-exponent / 2])
    assert set(both) == {Membership.MEMBER}


def test_a_rounded_point_is_not_on_a_set_whose_equations_hold_nowhere_near_it() -> None:
    circles = "(x^2 + y^2 - 1)*((x - 10^6)^2 + y^2 - 10^4)*(y - 1 - 1/10^9)"
    answer = nag.decompose(circles)
    for seed in range(2):
        found = memberships(answer, np.array([1e6 + 1e-7, 100.0]), seed=seed)
        assert found == (Membership.FOREIGN, Membership.FOREIGN, Membership.MEMBER)
