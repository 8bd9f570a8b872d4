"""What T25 prints, tested on what it must satisfy; `cases/ERRATA.md` lists what fails."""

import cmath
from fractions import Fraction

import numpy as np
import pytest
import tuomela as t25
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from linkages import case, exact, loop, residual

from nag.mechanism.axes import cross, dot
from nag.mechanism.model import model
from nag.mechanism.quaternion import multiply, norm_squared, rotate

OWN = exact("7/4", "5/6", "1/3")
laws = settings(max_examples=25)


@st.composite
def admissible(draw):
    """Parameters of the set Omega_0, with q_5 not 0."""
    value = st.builds(Fraction, st.integers(-12, 12), st.integers(1, 9))
    m = (draw(value), draw(value), draw(value))
    assume(all(x != 0 for x in m) and abs(m[2]) != 1)
    assume(t25.short(m)["q5"] != 0)
    return m


def bennett(m):
    frames = dict(zip(("B1", "B2", "B3"), t25.orientations(m), strict=True))
    return loop(t25.points(m), t25.axes(m), frames)


@laws
@given(admissible())
def test_lemma_5_1_opposite_links_are_equal(m):
    v, r = t25.links(m), t25.short(m)["r"]
    assert [dot(x, x) for x in v] == [1, r * r, 1, r * r]


@laws
@given(admissible())
def test_equation_11_and_lemma_5_2(m):
    m0, m1, m2 = m
    p2, _ = t25.points_11(m)
    p = t25.points(m)
    assert p2 == p[2]
    mended = (m0**2 + 1) * (m2**2 - 1) / (t25.short(m)["q"] * (m1**2 + m2**2))
    assert p[3] == (mended * (m2**2 - m1**2), mended * -2 * m1 * m2, 0)
    assert p == t25.points((m0, -1 / m1, 1 / m2)) == t25.points((-1 / m0, -m1, -m2))


def test_equation_11_as_printed_fails():
    assert t25.points_11(OWN)[1] == exact("4095/6554", "-1950/3277", 0)
    assert t25.points(OWN)[3] == exact("2730/3277", "2600/3277", 0)


@laws
@given(admissible())
def test_lemma_5_3_mended_gives_unit_axes_across_both_links(m):
    v, chi = t25.links(m), t25.axes(m)
    for i in range(4):
        assert dot(chi[i], chi[i]) == 1
        assert dot(chi[i], v[i]) == dot(chi[i], v[i - 1]) == 0


@laws
@given(admissible())
def test_theorem_5_1_holds_with_the_mended_axes(m):
    m0, _, m2 = m
    chi, q, r = t25.axes(m), t25.short(m)["q"], t25.short(m)["r"]
    cosines = [dot(chi[i], chi[(i + 1) % 4]) for i in range(4)]
    assert cosines[0] == cosines[2] == (m0**2 - 1) / (m0**2 + 1)
    printed = (m0 * m2 - m0 + m2 + 1) * (m0 * m2 - m0 - m2 - 1) / q
    assert cosines[1] == cosines[3] == printed
    assert 1 - cosines[1] ** 2 == r * r * (1 - cosines[0] ** 2)


def test_lemma_5_3_as_printed_fails():
    v, chi = t25.links(OWN), t25.axes(OWN, mended=False)
    assert dot(chi[2], v[2]) == Fraction(145563264, 617674837)
    assert dot(chi[3], v[3]) == Fraction(-12230400, 10738729)


@laws
@given(admissible())
def test_lemma_5_4_mended_gives_an_orthonormal_frame(m):
    for chi in t25.axes(m)[1:]:
        # The lemma needs chi and e^3 to be independent.
        if abs(chi[2]) == 1:
            continue
        eta, xi = t25.across(chi)
        assert dot(eta, eta) == dot(xi, xi) == 1
        assert dot(eta, xi) == dot(eta, chi) == dot(xi, chi) == 0
        assert dot(cross(eta, xi), chi) == 1


def test_lemma_5_4_as_printed_fails():
    chi = exact("2/3", "1/3", "2/3")
    assert dot(t25.across(chi, mended=False)[0], chi) == Fraction(-4, 15)
    assert dot(t25.across(chi)[0], chi) == 0


@laws
@given(admissible())
def test_lemma_6_1_frames_lie_along_the_links(m):
    v, r = t25.links(m), t25.short(m)["r"]
    for i, length, a in zip((1, 2, 3), (r, 1, r), t25.orientations(m), strict=True):
        assert norm_squared(a) == 1
        assert rotate(a, (length, 0, 0)) == v[i]


@laws
@given(admissible())
def test_16_to_19_at_the_initial_configuration_up_to_the_sign_of_b(m):
    a, b, c = t25.orientations(m)
    assert t25.bennetts_ideal(m, a, c) == [0, 0, 0, 0]
    found = t25.essential_to_all(m, a[0], a[2], c[0], c[2])
    assert found == [a, tuple(-x for x in b), c]


rationals = st.builds(Fraction, st.integers(-12, 12), st.integers(1, 9))


@st.composite
def frames(draw):
    """Orthonormal frames eta, xi, chi with rational entries."""
    a = draw(st.tuples(*[rationals] * 4))
    n = norm_squared(a)
    assume(n != 0)
    units = [tuple(Fraction(int(i == j)) for j in range(3)) for i in range(3)]
    return [tuple(x / n for x in rotate(a, unit)) for unit in units]


@laws
@given(frames())
def test_lemma_3_2_turns_e3_to_the_axis(frame):
    chi = frame[2]
    assume(abs(chi[2]) != 1)
    beta = (1 + chi[2], -chi[1], chi[0], Fraction(0))
    n = norm_squared(beta)
    assert n == 2 * (1 + chi[2])
    assert rotate(beta, (0, 0, 1)) == tuple(n * x for x in chi)


@laws
@given(frames())
def test_lemma_3_4_turns_e1_and_e2_to_the_frame(frame):
    eta, xi, _ = frame
    assume(eta[2] != 0)
    e1, e2, e3 = eta
    x1, x2, x3 = xi
    first = (
        e2 - x1,
        e2 * x3 - x2 * e3 + e3,
        x1 * e3 - x3 * e1 + x3,
        1 - e2 * x1 + x2 * e1 - x2 - e1,
    )
    second = (
        e2 * x3 - x2 * e3 - e3,
        e2 + x1,
        1 + e2 * x1 - x2 * e1 + x2 - e1,
        x1 * e3 - x3 * e1 + x3,
    )
    assert norm_squared(first) == 4 * (1 - e1 - x2 + e1 * x2 - e2 * x1)
    assert norm_squared(second) == 4 * (1 - e1 + x2 - e1 * x2 + e2 * x1)
    assert any(first) or any(second)
    for alpha in (first, second):
        n = norm_squared(alpha)
        assert rotate(alpha, (1, 0, 0)) == tuple(n * x for x in eta)
        assert rotate(alpha, (0, 1, 0)) == tuple(n * x for x in xi)


def test_the_components_of_equation_8_are_the_two_directions_of_the_axis():
    u = exact("1/5", "2/5", "2/5", "4/5")
    turn = exact("3/5", 0, 0, "4/5")
    same = multiply(u, turn)
    opposite = multiply(same, exact(0, 1, 0, 0))
    for z, zeros in ((same, 1), (opposite, 2)):
        values = {
            1: [
                z[1] * u[3] + z[0] * u[2] - z[3] * u[1] - z[2] * u[0],
                z[2] * u[3] - z[3] * u[2] - z[0] * u[1] + z[1] * u[0],
                z[3] * z[1] + z[2] * z[0] - u[3] * u[1] - u[2] * u[0],
                z[3] * z[2] - z[1] * z[0] - u[3] * u[2] + u[1] * u[0],
                z[2] ** 2 + z[1] ** 2 - u[2] ** 2 - u[1] ** 2,
            ],
            2: [
                z[0] * u[3] - z[1] * u[2] + z[2] * u[1] - z[3] * u[0],
                z[3] * u[3] + z[2] * u[2] + z[1] * u[1] + z[0] * u[0],
                z[3] * z[1] + z[2] * z[0] + u[3] * u[1] + u[2] * u[0],
                z[3] * z[2] - z[1] * z[0] + u[3] * u[2] - u[1] * u[0],
                z[3] ** 2 + z[0] ** 2 - u[2] ** 2 - u[1] ** 2,
            ],
        }
        assert values[zeros] == [0] * 5
        assert any(values[3 - zeros][:2])


def bennetts_curve(m, t):
    """The parametrisation after (20), at a complex t."""
    m0, m1, m2 = m
    q5 = t25.short(m)["q5"]
    cos, sin = cmath.cos(t), cmath.sin(t)
    q6 = (m1**2 + m2**2) * (m2**2 * sin**2 + cos**2)
    n1 = cmath.sqrt(m1**2 + 1)
    return (
        cos / n1,
        -q5 * sin / ((m0**2 + 1) * n1),
        m1 * m2 * sin / cmath.sqrt(q6),
        m2 * cos / cmath.sqrt(q6),
    )


@pytest.mark.parametrize("m", [OWN, exact("-38/11", -2, "-35/13"), exact(-9, "-1/7", "1/10")])
def test_bennetts_variety_satisfies_every_constraint(m):
    """Points of I_benn, with (16), (18) and (19), real and complex."""
    constraints = model(bennett(m), "E").unreduced
    numbers = tuple(float(x) for x in m)
    for t in (0.7, 0.3 + 0.45j, 1.9 - 0.6j):
        a0, a2, c0, c2 = bennetts_curve(numbers, t)
        a, b, c = t25.essential_to_all(numbers, a0, a2, c0, c2)
        assert max(abs(g) for g in t25.bennetts_ideal(numbers, a, c)) < 1e-12
        assert residual(constraints, [*a, *b, *c]) < 1e-12


def test_lifted_half_angles_satisfy_bennetts_ideal_in_the_papers_coordinates():
    m = model(case("bennett"), "H")
    numbers = tuple(float(x) for x in OWN)
    (equation,) = m.system.polynomials
    for x in (0.4, -1.7, 0.3 + 0.8j, 2.1 - 0.4j):
        rest = equation([x + 0j, 0j])
        lifted = m.lift([x + 0j, -rest / (equation([x + 0j, 1 + 0j]) - rest)])
        a, b, c = (lifted.euler[body] for body in ("B1", "B2", "B3"))
        assert max(abs(g) for g in t25.bennetts_ideal(numbers, a, c)) < 1e-12
        expected = t25.essential_to_all(numbers, a[0], a[2], c[0], c[2])
        assert np.allclose(expected[0], a, rtol=0, atol=1e-12)
        assert np.allclose(expected[2], c, rtol=0, atol=1e-12)
        sign = b[0] / expected[1][0]
        assert abs(abs(sign.real) - 1) < 1e-10
        assert np.allclose(np.array(expected[1]) * sign, b, rtol=0, atol=1e-10)


def test_the_case_q5_equal_to_zero():
    """Mended: the second denominator, and the coefficients of a_3 c_0 in b_2 and b_3."""
    m0, m2 = 7 / 4, 1 / 3
    m = (Fraction(7, 4), Fraction(56, 33), Fraction(1, 3))
    assert t25.short(m)["q5"] == 0
    h = model(bennett(m), "H")
    (equation,) = h.system.polynomials
    for x in (0.3, -0.8, 0.2 + 0.9j):
        rest = equation([x + 0j, 0j])
        lifted = h.lift([x + 0j, -rest / (equation([x + 0j, 1 + 0j]) - rest)])
        a, b, c = (lifted.euler[body] for body in ("B1", "B2", "B3"))
        zeros = [
            (m0**2 + 1) ** 2 / (m0**2 - 1) ** 2 * a[0] ** 2 + a[3] ** 2 - 1,
            m2**2 * c[0] ** 2
            + 4 * m0**2 / (m0**2 - 1) ** 2 * c[2] ** 2
            - 4 * m0**2 * m2**2 / ((m0**2 - 1) ** 2 * m2**2 + 4 * m0**2),
            2 * m0 * c[2] * a[3] + (m0**2 + 1) * c[0] * a[0],
            a[1] - 2 * m0 / (m0**2 - 1) * a[0],
            a[2],
        ]
        assert max(abs(z) for z in zeros) < 1e-12
        s = t25.short(tuple(float(y) for y in m))
        q, q4, m1 = s["q"], s["q4"], 56 / 33
        t0 = (m2**2 - 1) * s["q0"] / (m1 * m2 * q)
        t2 = m1 * (m2 - 1) * (q4**2 - 4 * m0**2) + 4 * m0 * q4 * (m1**2 + m2)
        t4 = (m1**2 + m2) * (q4**2 - 4 * m0**2) - 4 * m0 * m1 * (m2 - 1) * q4
        t2, t4 = (t / (m2 * (m0**2 + 1) * q) for t in (t2, t4))
        sign = b[0] / (t0 * a[0] * c[0])
        assert abs(abs(sign.real) - 1) < 1e-10
        assert abs(sign * b[2] - t2 * a[0] * c[2] + a[3] * c[0]) < 1e-10
        assert abs(sign * b[3] - t4 * a[0] * c[2] - 11 / 56 * a[3] * c[0]) < 1e-10


def test_bricards_variety_satisfies_every_constraint():
    """Points of I_bric, with (10), real and complex, of both signs of the root."""
    constraints = model(case("bricard-cube"), "E").unreduced
    for t in (0.3, 2.6, 0.7 + 0.9j, -1.8 + 0.2j):
        for sign in (1, -1):
            a0, a2 = cmath.cos(t) / 2**0.5, cmath.sin(t) / 2**0.5
            root = cmath.sqrt(4 * cmath.cos(t) ** 2 - 1) / (2 * 2**0.5 * cmath.cos(t))
            c2 = a2 + sign * root
            assert abs(2 * a2**2 + 2 * a0**2 - 1) < 1e-13
            assert abs(16 * a0**2 * (c2**2 - 2 * c2 * a2 - a0**2) + 1) < 1e-12
            point = [x for body in t25.bricard_10(a0, a2, c2) for x in body]
            assert residual(constraints, point) < 1e-13


def test_bricards_initial_values_lie_on_his_variety():
    m = model(case("bricard-cube"), "H")
    lifted = m.lift(m.reference)
    a, _, c, *_ = bodies = [lifted.euler[f"B{i}"] for i in range(1, 6)]
    assert t25.bricard_10(a[0], a[2], c[2]) == bodies
