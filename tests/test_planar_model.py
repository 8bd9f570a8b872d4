from fractions import Fraction

import mpmath
import pytest
from linkages import case, exact, four_bar, loop

from nag.decomposition.decompose import decompose
from nag.mechanism.graph import Body, Joint, Mechanism
from nag.mechanism.model import model

FRAMES = [
    ((0, 0, 1), ((1, 0, 0), (0, 1, 0))),
    ((0, 1, 0), ((0, 0, 1), (1, 0, 0))),
    ((2, 4, 4), ((2, 1, -2), (2, -2, 1))),
    ((1, 1, 1), ((1, -1, 0), (1, 1, -2))),
]


def test_four_bar_has_three_norms_and_two_loop_equations():
    m = model(case("planar-four-bar"), "E")
    assert (m.formulation, m.space) == ("E", "planar")
    full = m.form.elimination
    assert len(full.original_variables) == 6
    assert max(image.degree for image in full.images) == 1
    assert (m.system.n, m.system.degrees) == (4, (2, 2, 2))


@pytest.mark.parametrize(("axis", "across"), FRAMES)
def test_parallelogram_moves_in_any_plane(axis, across):
    """Opposite links turn together: an exact motion, through half a turn as well."""
    m = model(four_bar(axis, across), "E")
    squared = sum(x * x for x in m.form.normal)
    for t in (Fraction(1, 3), Fraction(-7, 2), Fraction(1000)):
        n = 1 + squared * t * t
        c, s = (1 - squared * t * t) / n, 2 * t / n
        point = _reduced(m, {"B1": (c, s), "B2": (Fraction(1), Fraction(0)), "B3": (c, s)})
        assert set(m.system(point)) == {0}
        assert set(m.unreduced(m.unreduced_point(m.lift(point)))) == {0}
    half = _reduced(m, {"B1": exact(-1, 0), "B2": exact(1, 0), "B3": exact(-1, 0)})
    assert set(m.system(half)) == {0}
    lifted = m.lift(half)
    assert lifted.euler["B1"][0] == 0
    assert set(m.unreduced(m.unreduced_point(lifted))) == {0}


def _reduced(m, turns):
    full = [x for body in m.structure.moving for x in turns[body]]
    return [full[i] for i in m.form.elimination.kept]


def test_frames_in_the_plane_make_the_turns_those_of_the_frames():
    """Local frames along the links give the (c, s) of PT13 section 5.3."""
    quarter = exact("1/2", "1/2", "1/2", "1/2")
    mechanism = four_bar((1, 1, 1), ((1, -1, 0), (1, 1, -2)))
    turned = Mechanism("B0", mechanism.joints, (Body("B1", quarter),))
    m = model(turned, "E")
    # 1/2 + 1/2 n is a turn by 120 degrees: c = -1/2, s |n| = sqrt(3)/2.
    assert m.form.offsets["B1"] == (Fraction(-1, 2), Fraction(1, 2))
    assert set(m.system(m.reference)) == {0}
    assert m.lift(m.reference).euler["B1"] == quarter


def test_frames_across_the_plane_are_kept_apart():
    across = exact("3/5", "4/5", 0, 0)
    m = model(Mechanism("B0", four_bar().joints, (Body("B2", across),)), "E")
    assert m.form.offsets["B2"] == (1, 0)
    assert m.lift(m.reference).euler["B2"] == across


def test_rational_turns_without_rational_half_angle_lift_exactly():
    m = model(four_bar(), "E")
    c, s = Fraction(3, 5), Fraction(4, 5)
    assert m.lift(_reduced(m, _parallel(c, s))).euler["B1"][0] ** 2 == Fraction(4, 5)


def _parallel(c, s):
    return {"B1": (c, s), "B2": (Fraction(1), Fraction(0)), "B3": (c, s)}


def test_two_loops_in_the_plane():
    joints = [
        ("a", "G", "P", (0, 0, 0)),
        ("b", "P", "Q", (0, 1, 0)),
        ("c", "Q", "R", (2, 1, 0)),
        ("d", "R", "G", (2, 0, 0)),
        ("e", "Q", "S", (4, 1, 0)),
        ("f", "S", "G", (4, 0, 0)),
    ]
    base = loop([(0, 0, 0)] * 3, [(0, 0, 1)] * 3).joints[0]
    mechanism = Mechanism(
        "G", [type(base)(n, "revolute", (a, b), exact(*p), exact(0, 0, 1)) for n, a, b, p in joints]
    )
    m = model(mechanism, "E")
    assert len(m.structure.loops) == 2
    # Parallel cranks of equal length: all turn together.
    c, s = Fraction(5, 13), Fraction(12, 13)
    turns = dict.fromkeys("PRS", (c, s)) | {"Q": (Fraction(1), Fraction(0))}
    point = _reduced(m, turns)
    assert set(m.system(point)) == {0}
    with mpmath.workdps(40):
        lifted = m.unreduced_point(m.lift([mpmath.mpf(x.numerator) / x.denominator for x in point]))
        for f in m.unreduced.polynomials:
            assert abs(f(lifted, lambda c: mpmath.mpf(c.numerator) / c.denominator)) < 1e-35


def test_a_triangle_of_bodies_costs_no_path_and_gives_both_its_assemblies():
    def pin(name, first, second, *place):
        return Joint(name, "revolute", (first, second), exact(*place, 0), exact(0, 0, 1))

    ends = [pin("A", "g", "a", 0, 0), pin("B", "a", "b", 1, 3), pin("D", "c", "g", 6, 0)]
    plate = Mechanism("g", (*ends, pin("C", "b", "c", 5, 4)))
    triangle = [pin("P", "b", "d", 3, 3), pin("Q", "d", "e", 4, 6), pin("S", "e", "b", 2, 7)]
    braced = Mechanism("g", (*ends, *triangle, pin("C", "d", "c", 5, 4)))
    found = [decompose(model(m, "H").system) for m in (plate, braced)]
    assert all(answer.complete for answer in found)
    kinds = [[(c.dimension, c.degree, c.multiplicity) for c in a.components] for a in found]
    assert kinds == [[(1, 4, 1)], [(1, 4, 1)] * 2]
    assert found[1].paths.tracked == 0
