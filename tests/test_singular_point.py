"""What is decided at singular zeros: isolated and of which multiplicity, or on a component."""

from __future__ import annotations

from fractions import Fraction

import flint
import numpy as np
import pytest
from singular_zeros import ISOLATED, ON_COMPONENTS, Zero, polynomials

from nag.numerics.deflation import deflate
from nag.numerics.digits import DIGITS, doubles, working_digits
from nag.numerics.exact_system import ExactSystem
from nag.numerics.far_along import RoundsInDoubles
from nag.numerics.sharpening import sharpen
from nag.numerics.singular_point import Place, SingularEnd, analyse

LARGE = {"DZ1", "two curves of order 40"}


def judged(zero: Zero, error: float, seed: int) -> SingularEnd:
    rng = np.random.default_rng(seed)
    return analyse(zero.polynomials, zero.beside(error, rng), error, rng)


@pytest.mark.parametrize("name", sorted(set(ISOLATED) - LARGE))
@pytest.mark.parametrize("error", [1e-4, 1e-10])
def test_an_isolated_zero_has_the_dimension_of_its_local_ring(name: str, error: float) -> None:
    zero = ISOLATED[name]
    end = judged(zero, error, seed=1)
    assert (end.place, end.multiplicity) == (Place.ISOLATED, zero.multiplicity), end.reason
    assert np.abs(end.point - zero.point).max() < 1e-15 * max(1, np.abs(zero.point).max())


@pytest.mark.slow
def test_a_local_ring_of_large_dimension_is_told_from_a_curve() -> None:
    """The other one of `LARGE` is Dayton and Zeng's point, in tests/test_local_dimension.py."""
    zero = ISOLATED["two curves of order 40"]
    end = judged(zero, 1e-10, seed=0)
    assert (end.place, end.multiplicity) == (Place.ISOLATED, zero.multiplicity)


@pytest.mark.parametrize("power", [100, 200])
def test_a_high_power_has_its_multiplicity(power: int) -> None:
    end = judged(Zero.of("x", f"x^{power}", [0], power), 1e-4, seed=0)
    assert (end.place, end.multiplicity) == (Place.ISOLATED, power)


@pytest.mark.parametrize("name", sorted(set(ISOLATED) - LARGE - {"DZ2"}))
def test_changes_of_coordinates_change_no_multiplicity(name: str) -> None:
    for seed in range(2):
        changed = ISOLATED[name].changed(np.random.default_rng(seed))
        end = judged(changed, 1e-7, seed)
        assert (end.place, end.multiplicity) == (Place.ISOLATED, changed.multiplicity), end.reason


@pytest.mark.parametrize("name", sorted(ON_COMPONENTS))
@pytest.mark.parametrize("error", [1e-4, 1e-10])
def test_a_point_on_a_component_is_not_isolated(name: str, error: float) -> None:
    end = judged(ON_COMPONENTS[name], error, seed=2)
    assert end.place is Place.ON_COMPONENT, end.reason
    assert end.dimension > 0
    assert end.multiplicity == 0


@pytest.mark.parametrize("name", sorted(set(ISOLATED) - LARGE))
def test_no_isolated_zero_has_a_larger_corank_than_its_multiplicity_allows(name: str) -> None:
    zero = ISOLATED[name]
    if len(zero.polynomials) == len(zero.point):
        rng = np.random.default_rng(3)
        given = zero.polynomials, zero.beside(1e-8, rng), 1e-8, rng
        end = analyse(*given, most=zero.multiplicity)
        assert (end.place, end.multiplicity) == (Place.ISOLATED, zero.multiplicity), end.reason


def test_a_point_that_fewer_zeros_lie_at_than_its_corank_allows_is_on_a_component() -> None:
    """Three lines in a plane, of which the origin is an embedded point: corank 2."""
    system = polynomials("x y", "x*y*(x - y)", "x^2*y^2")
    ends = [
        analyse(system, np.zeros(2), 1e-10, np.random.default_rng(0), most=most)
        for most in (3, 4, None)
    ]
    assert [end.place for end in ends] == [Place.ON_COMPONENT] * 3
    assert ["corank 2" in end.reason for end in ends] == [True, False, False]


@pytest.mark.parametrize("name", sorted(ON_COMPONENTS))
def test_changes_of_coordinates_isolate_no_point(name: str) -> None:
    changed = ON_COMPONENTS[name].changed(np.random.default_rng(5))
    assert judged(changed, 1e-7, seed=5).place is Place.ON_COMPONENT


@pytest.mark.parametrize("power", [8, 20, 40])
def test_two_zeros_close_together_are_not_one_double_zero(power: int) -> None:
    system = polynomials("x y", f"(x - 1)^2 - y - 1/10^{2 * power}", "y")
    end = analyse(system, np.array([1, 0]), 1e-6, np.random.default_rng(0))
    assert end.place is Place.CLUSTER
    assert [(z.place, z.multiplicity) for z in end.nearby] == [(Place.ISOLATED, 1)] * 2
    apart = Fraction(1, 10**power)
    assert {z.rational for z in end.nearby} == {(1 + apart, 0), (1 - apart, 0)}


@pytest.mark.parametrize("power", [120, 145])
def test_zeros_nearer_than_all_digits_are_not_called_one_multiple_zero(power: int) -> None:
    texts = (f"(x + 2*y)^2 - 1/10^{2 * power} + y - 3*x", "y - 3*x")
    end = analyse(polynomials("x y", *texts), np.zeros(2), 1e-9, np.random.default_rng(0))
    assert end.place is Place.UNDECIDED
    # A third equation that the double zero of two others only nearly satisfies.
    texts = ("(x - 1)^2", "y - x", f"x + y - 2 - 1/10^{power}")
    end = analyse(polynomials("x y", *texts), np.ones(2), 1e-9, np.random.default_rng(0))
    assert end.place is Place.UNDECIDED


def test_an_isolated_zero_beside_a_line_is_found_with_it() -> None:
    # The line x = z = -y, and a point at a distance of 1e-20 from it.
    line, point = ("(x - z)", "(y + z)"), ("(x - z - 1/10^20)", "(y + z)", "(x + 2*y - 1)")
    texts = [f"{a}*{b}" for a in line for b in point]
    rng = np.random.default_rng(0)
    end = analyse(polynomials("x y z", *texts), np.array([-1, 1, -1]), 1e-15, rng)
    assert (end.place, end.dimension) == (Place.CLUSTER, 1)
    far = 1 - Fraction(1, 10**20)
    assert [(z.multiplicity, z.rational) for z in end.nearby] == [(1, (1 - 2 * far, far, -far))]


def test_a_double_zero_close_to_a_simple_one_is_told_from_a_triple_one() -> None:
    system = polynomials("x y", "(x - 1)^2*(x - 1 - 1/10^20) - y", "y - y^2")
    end = analyse(system, np.array([1, 0]), 1e-6, np.random.default_rng(0))
    assert end.place is Place.CLUSTER
    known = {((Fraction(1), 0), 2), ((1 + Fraction(1, 10**20), 0), 1)}
    assert {(z.rational, z.multiplicity) for z in end.nearby} == known


def test_four_zeros_close_together_in_two_variables_are_all_found() -> None:
    system = polynomials("x y", "x^2 - 2/10^30", "y^2 - x*y - 1/10^30")
    end = analyse(system, np.array([1e-9, 0]), 1e-8, np.random.default_rng(0))
    assert end.place is Place.CLUSTER
    assert [z.multiplicity for z in end.nearby] == [1] * 4
    assert all(abs(abs(z.point[0]) - 2**0.5 * 1e-15) < 1e-30 for z in end.nearby)


def test_a_hyperbola_close_to_two_lines_is_a_curve_through_its_points() -> None:
    system = polynomials("x y z", "x*y - 1/10^20", "z", "z*(x - y)")
    # Nearer to it than the lines are, or not: then an isolated zero might lie as near.
    for error, place in ((1e-14, Place.ON_COMPONENT), (1e-8, Place.UNDECIDED)):
        end = analyse(system, np.array([1e-9, 1e-11, 0]), error, np.random.default_rng(0))
        assert end.place is place


def test_equations_that_nearly_vanish_have_no_zero_there() -> None:
    system = polynomials("x y", "x^2 - 2", "y - x", "x*y - 2 - 1/10^20")
    end = analyse(system, np.array([2**0.5] * 2), 1e-12, np.random.default_rng(0))
    assert end.place is Place.UNDECIDED
    assert "1e-20" in end.reason


def test_a_regular_zero_has_multiplicity_one() -> None:
    system = polynomials("x y", "x^2 - 2", "y - x", "x*y - 2")
    end = analyse(system, np.array([2**0.5] * 2), 1e-12, np.random.default_rng(0))
    assert (end.place, end.multiplicity) == (Place.ISOLATED, 1)


def test_irrational_coefficients_are_taken_to_all_digits() -> None:
    system = polynomials("x y", "(x - sqrt(2))^2", "(y - x)^3")
    end = analyse(system, np.array([2**0.5] * 2), 1e-9, np.random.default_rng(0))
    assert (end.place, end.multiplicity) == (Place.ISOLATED, 6)
    text = end.precise.centre[0].real.str(100, radius=False)
    assert text.startswith("1.41421356237309504880168872420969807856967187537694")


def test_a_point_may_be_given_by_more_digits_than_doubles_have() -> None:
    system = polynomials("x", "x*(x - 1/10^20)")
    with working_digits(DIGITS):
        given = [flint.acb("1e-20")]
    one = analyse(system, given, 1e-30, np.random.default_rng(0))
    assert (one.place, one.multiplicity, one.rational) == (
        Place.ISOLATED,
        1,
        (Fraction(1, 10**20),),
    )
    both = analyse(system, given, 1e-19, np.random.default_rng(0))
    assert both.place is Place.CLUSTER


def test_slices_are_further_equations() -> None:
    system = polynomials("x y", "(y^2 - x^3)^3*y^2")
    rng = np.random.default_rng(0)
    slices = np.array([[-3 - 1j, 1 + 1j, 2]])
    assert analyse(system, np.array([1, 1]), 1e-12, rng).place is Place.ON_COMPONENT
    assert analyse(system, np.array([1, 1]), 1e-12, rng, slices).multiplicity == 3


@pytest.mark.parametrize("size", [1e-8, 1e6])
def test_the_size_of_the_coordinates_does_not_matter(size: float) -> None:
    s = Fraction(size).limit_denominator(10**9)
    system = polynomials("x y", f"(x - {s})^2", f"(y - x)^3/({s}) - (y - x)*(x - {s})")
    end = analyse(system, np.array([size, size]), 1e-12, np.random.default_rng(0))
    assert (end.place, end.multiplicity) == (Place.ISOLATED, 6)


def test_the_same_seed_gives_the_same_answer() -> None:
    first, second = (judged(ON_COMPONENTS["three lines"], 1e-6, seed=3) for _ in range(2))
    assert first.precise.centre == second.precise.centre and first.reason == second.reason


def test_a_line_through_a_rational_point_parallel_to_an_axis_is_seen_exactly() -> None:
    equations = polynomials(
        "x y z",
        "-40*x^5 + 100*x^3*z^2 - 180*x^2*y^2*z + 70*y^2*z^3 + 100/3*x^2",
        "1/5*x^3*y*z - 1/100*y^3*z^2 - 1/50*x^4 + 6*y^2*z^2 + 23/100*x^2",
        "-50*x*z^3 - 200/3*y^4 + 400*x*y*z",
    )
    end = analyse(equations, np.zeros(3), 1e-15, np.random.default_rng(0))
    assert end.place is Place.ON_COMPONENT
    assert end.dimension == 1
    assert "exactly" in end.reason


SINGULAR_CURVES = {
    "a crossing of surfaces": ("x y z w", "w - z - x^2, x*y*(1 + z)", [0, 0, 0, 0], [0, 0, 1, 1]),
    "a triple curve": ("x y", "(x - y^2)^3, (x - y^2)^3*y", [0, 0], [0, 1]),
}


@pytest.mark.parametrize("name", SINGULAR_CURVES)
def test_the_set_that_two_rounds_leave_is_the_same_in_doubles(name: str) -> None:
    variables, equations, zero, direction = SINGULAR_CURVES[name]
    with flint.ctx.workdps(DIGITS):
        system = ExactSystem.of(polynomials(variables, *equations.split(", ")), np.zeros(len(zero)))
        centre = [flint.acb(c) for c in zero]
        found = deflate(system, centre, -140.0, np.random.default_rng(0))
        assert (len(found.rounds), found.free) == (2, 1)
        known = RoundsInDoubles.of(system, found.rounds)
        assert known is not None
        tangent = known.tangent(np.array(zero, dtype=complex), np.ones(1))
        assert np.abs(tangent / np.abs(tangent).max() - direction).max() < 1e-9
        near = np.array(zero) + 0.3 * tangent + 1e-3 * np.arange(1, len(zero) + 1)
        for _ in range(5):
            near = near - known.newton(near)
        exact = sharpen(system, [flint.acb(complex(c)) for c in near], found.rounds)
    assert exact is not None
    assert np.abs(doubles(exact[0]) - near).max() < 1e-10
