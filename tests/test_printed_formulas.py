"""The papers' formulas where the check does not go: random parameters, complex points, lifts."""

import cmath
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from linkages import case, exact, residual

from nag.check.loops import bennett_mechanism
from nag.mechanism.axes import cross, dot
from nag.mechanism.configuration import arithmetic_of, configuration
from nag.mechanism.model import model
from nag.mechanism.quaternion import conjugate, multiply, norm_squared, rotate
from nag.symbolic import bennett, bennett_geometry, bricard, revolute

OWN = exact("7/4", "5/6", "1/3")
laws = settings(max_examples=20)


@st.composite
def admissible(draw):
    """Parameters of the set Omega_0, with q_5 not 0."""
    value = st.builds(Fraction, st.integers(-12, 12), st.integers(1, 9))
    m = (draw(value), draw(value), draw(value))
    assume(all(x != 0 for x in m) and abs(m[2]) != 1)
    assume(bennett_geometry.abbreviations(m)["q5"] != 0)
    return m


@laws
@given(admissible())
def test_axes_are_unit_and_across_both_links_with_orthonormal_frames(m):
    v, chi = bennett_geometry.links(m), bennett_geometry.axes(m)
    for i in range(4):
        assert dot(chi[i], chi[i]) == 1
        assert dot(chi[i], v[i]) == dot(chi[i], v[i - 1]) == 0
    for axis in chi[1:]:
        eta, xi = bennett_geometry.across(axis)
        assert cross(eta, xi) == axis
        assert dot(eta, eta) == dot(xi, xi) == 1


def test_printed_points_and_axes_fail_where_the_errata_say():
    assert bennett_geometry.points_11(OWN, printed=True)[1] == exact("4095/6554", "-1950/3277", 0)
    assert bennett_geometry.points(OWN)[3] == exact("2730/3277", "2600/3277", 0)
    v, chi = bennett_geometry.links(OWN), bennett_geometry.axes(OWN, printed=True)
    assert dot(chi[2], v[2]) == Fraction(145563264, 617674837)
    assert dot(chi[3], v[3]) == Fraction(-12230400, 10738729)
    axis = exact("2/3", "1/3", "2/3")
    assert dot(bennett_geometry.across(axis, printed=True)[0], axis) == Fraction(-4, 15)


@laws
@given(admissible())
def test_the_initial_configuration_is_essential_up_to_the_sign_of_b(m):
    a, b, c = bennett.orientations(m)
    assert bennett.variety(m, a[0], a[2], c[0], c[2]) == [0, 0, 0]
    assert bennett.g_4(m, a[0], c[0]) == (0, 0)
    found = bennett.essential_to_all(m, a[0], a[2], c[0], c[2])
    assert found == [a, tuple(-x for x in b), c]


rationals = st.builds(Fraction, st.integers(-12, 12), st.integers(1, 9))


@laws
@given(st.tuples(*[rationals] * 4))
def test_turns_to_a_frame_are_not_both_zero_and_turn(a):
    n = norm_squared(a)
    assume(n != 0)
    units = [tuple(Fraction(int(i == j)) for j in range(3)) for i in range(3)]
    eta, xi, _ = (tuple(x / n for x in rotate(a, unit)) for unit in units)
    assume(eta[2] != 0)
    turns = revolute.turns_to_frame(eta, xi)
    assert any(any(alpha) for alpha in turns)
    for alpha, length in zip(turns, revolute.squared_lengths(eta, xi), strict=True):
        assert norm_squared(alpha) == length
        assert rotate(alpha, (1, 0, 0)) == tuple(length * x for x in eta)
        assert rotate(alpha, (0, 1, 0)) == tuple(length * x for x in xi)


def test_the_components_of_equation_8_are_the_two_directions_of_the_axis():
    u = exact("1/5", "2/5", "2/5", "4/5")
    same = multiply(u, exact("3/5", 0, 0, "4/5"))
    opposite = multiply(same, exact(0, 1, 0, 0))
    for z, zeros in ((same, 1), (opposite, 2)):
        assert revolute.component(u, z, zeros) == [0] * 5
        assert any(revolute.component(u, z, 3 - zeros)[:2])


UNIT = (
    exact("1/5", "2/5", "2/5", "4/5"),
    exact("3/5", 0, 0, "4/5"),
    exact(0, "2/3", "-1/3", "2/3"),
)
FRAMES = (exact(1, 0, 0, 0), exact(0, 1, 0, 0), exact(0, 0, 1, 0), *UNIT)


@pytest.mark.parametrize("p", FRAMES)
@pytest.mark.parametrize("s", FRAMES)
def test_components_in_arbitrary_frames_are_the_two_directions_of_the_axis(p, s):
    """Frames where lemmas 3.2 and 3.4 have no turn among them."""
    eta, xi, axis = (rotate(p, exact(*e)) for e in np.eye(3, dtype=int).tolist())
    chi = rotate(s, exact(0, 0, 1))
    for a in UNIT:
        back = conjugate(s)
        same = multiply(multiply(a, multiply(p, UNIT[1])), back)
        opposite = multiply(
            multiply(a, multiply(p, exact(0, 1, 0, 0))), (s[0], *(-x for x in s[1:]))
        )
        assert rotate(same, chi) == rotate(a, axis)
        assert rotate(opposite, chi) == tuple(-x for x in rotate(a, axis))
        for b, zeros in ((same, 1), (opposite, 2)):
            assert not any(revolute.component_in_frames(eta, xi, chi, a, b, zeros))
            assert any(revolute.component_in_frames(eta, xi, chi, a, b, 3 - zeros)[:2])


def bennetts_curve(m, t):
    """The parametrisation after (20), at a complex t."""
    root1 = cmath.sqrt(m[1] ** 2 + 1)
    cos, sin = cmath.cos(t), cmath.sin(t)
    root6 = cmath.sqrt(bennett.under_the_root(m, cos, sin))
    return bennett.parametrisation(m, cos, sin, root1, root6)


def placed(m, bodies):
    """All bodies' Euler parameters and positions, from those of B1, B2, .."""
    euler = {f"B{i}": tuple(map(complex, q)) for i, q in enumerate(bodies, 1)}
    arithmetic = arithmetic_of(euler["B1"])
    return m.unreduced_point(configuration(m.structure, euler, arithmetic))


@pytest.mark.parametrize("m", [OWN, exact("-38/11", -2, "-35/13"), exact(-9, "-1/7", "1/10")])
def test_bennetts_variety_satisfies_every_constraint(m):
    """Points of I_benn, with (16), (18) and (19), real and complex."""
    m, numbers = model(bennett_mechanism(m), "E"), tuple(float(x) for x in m)
    for t in (0.7, 0.3 + 0.45j, 1.9 - 0.6j):
        essential = bennetts_curve(numbers, t)
        a, b, c = bennett.essential_to_all(numbers, *essential)
        assert max(abs(g) for g in bennett.variety(numbers, *essential)) < 1e-12
        assert residual(m.unreduced, placed(m, (a, b, c))) < 1e-12


def test_lifted_half_angles_satisfy_bennetts_ideal_in_the_papers_coordinates():
    m = model(case("bennett"), "H")
    numbers = tuple(float(x) for x in OWN)
    (equation,) = m.system.polynomials
    for x in (0.4, -1.7, 0.3 + 0.8j, 2.1 - 0.4j):
        rest = equation([x + 0j, 0j])
        lifted = m.lift([x + 0j, -rest / (equation([x + 0j, 1 + 0j]) - rest)])
        a, b, c = (lifted.euler[body] for body in ("B1", "B2", "B3"))
        essential = a[0], a[2], c[0], c[2]
        assert max(abs(g) for g in bennett.variety(numbers, *essential)) < 1e-12
        expected = bennett.essential_to_all(numbers, *essential)
        assert np.allclose(expected[0], a, rtol=0, atol=1e-12)
        assert np.allclose(expected[2], c, rtol=0, atol=1e-12)
        sign = b[0] / expected[1][0]
        assert abs(abs(sign.real) - 1) < 1e-10
        assert np.allclose(np.array(expected[1]) * sign, b, rtol=0, atol=1e-10)


def test_the_case_q5_equal_to_zero():
    """Witnesses of the mechanism, lifted, satisfy the mended formulas and not the printed ones."""
    m = exact("7/4", "56/33", "1/3")
    assert bennett_geometry.abbreviations(m)["q5"] == 0
    h = model(bennett_mechanism(m), "H")
    (equation,) = h.system.polynomials
    outer = (float(m[0]), float(m[2]))
    for x in (0.3, -0.8, 0.2 + 0.9j):
        rest = equation([x + 0j, 0j])
        lifted = h.lift([x + 0j, -rest / (equation([x + 0j, 1 + 0j]) - rest)])
        a, b, c = (np.array(lifted.euler[body]) for body in ("B1", "B2", "B3"))
        essential = a[0], a[3], c[0], c[2]
        assert max(abs(z) for z in bennett.variety_q5_zero(outer, *essential)) < 1e-12
        assert max(abs(z) for z in bennett.variety_q5_zero(outer, *essential, printed=True)) > 1e-3
        for printed in (False, True):
            image = bennett.essential_to_all_q5_zero(outer, *essential, printed=printed)
            off = [min(abs(np.array(image[1]) - s * b).max() for s in (1, -1))]
            off += [abs(np.array(p) - q).max() for p, q in zip(image[::2], (a, c), strict=True)]
            assert (max(off) < 1e-10) is not printed


def test_bricards_variety_satisfies_every_constraint():
    """Points of I_bric, with (10), real and complex, of both signs of the root."""
    m = model(case("bricard-cube"), "E")
    for t in (0.3, 2.6, 0.7 + 0.9j, -1.8 + 0.2j):
        for sign in (1, -1):
            root = sign * cmath.sqrt(4 * cmath.cos(t) ** 2 - 1)
            essential = bricard.parametrisation(cmath.cos(t), cmath.sin(t), 2**0.5, root)
            assert max(map(abs, bricard.variety(*essential))) < 1e-12
            point = placed(m, bricard.essential_to_all(*essential))
            assert residual(m.unreduced, point) < 1e-13


def test_bricards_initial_values_lie_on_his_variety():
    m = model(case("bricard-cube"), "H")
    lifted = m.lift(m.reference)
    a, _, c, *_ = bodies = [lifted.euler[f"B{i}"] for i in range(1, 6)]
    assert bricard.essential_to_all(a[0], a[2], c[2]) == bodies
