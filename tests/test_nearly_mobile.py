"""Linkages of rounded numbers are rigid, and said to be nearly the mobile ones that were meant."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from linkages import CASES
from overconstrained_linkages import (
    Lines,
    assembled,
    line_symmetric,
    plane_symmetric,
    posed,
    rounded_loop,
    sarrus,
    spherical,
    turned,
)
from rounded_linkages import measure

import nag
from nag.cli import main
from nag.errors import NagError
from nag.files.cases import read_case
from nag.mechanism.graph import Joint, Mechanism
from nag.mechanism.nearly_mobile import ROUNDING, WIDEST_GAP, find_near_motion, find_spoiled_motion
from nag.mechanism.overconstrained import known_linkage

KINDS = {
    "a Bennett linkage": lambda: assembled("bennett"),
    "a Goldberg 5R linkage": lambda: assembled("goldberg-5r"),
    "a Myard 5R linkage": lambda: assembled("myard-5r"),
    "a trihedral Bricard linkage": lambda: assembled("bricard-trihedral"),
    "a line-symmetric Bricard linkage": line_symmetric,
    "a plane-symmetric Bricard linkage": plane_symmetric,
    "a Sarrus linkage": sarrus,
    "a spherical linkage": spherical,
}


def general_lines(n: int, seed: int) -> Lines:
    rng = np.random.default_rng(seed)
    axes = rng.standard_normal((n, 3))
    return axes / np.linalg.norm(axes, axis=1, keepdims=True), rng.standard_normal((n, 3))


@pytest.mark.parametrize("name", KINDS)
def test_exact_lines_have_the_name_of_their_linkage(name: str) -> None:
    found = known_linkage(*turned(KINDS[name]()))
    assert found is not None and name.split()[1] in found


@pytest.mark.parametrize("name", KINDS)
def test_the_name_depends_on_the_lines_alone(name: str) -> None:
    axes, points = KINDS[name]()
    known = known_linkage(axes, points)
    for seed in range(8):
        rng = np.random.default_rng(seed)
        along, first = rng.standard_normal((len(axes), 1)), int(rng.integers(len(axes)))
        order = np.roll(np.arange(len(axes))[:: rng.choice([1, -1])], first)
        moved = posed((axes * rng.choice([-1, 1], (len(axes), 1)), points + along * axes), seed)
        assert known_linkage(moved[0][order], moved[1][order]) == known


@pytest.mark.parametrize("n", [4, 5, 6])
def test_general_lines_have_no_name(n: int) -> None:
    assert all(known_linkage(*general_lines(n, seed)) is None for seed in range(20))


@pytest.mark.parametrize("digits", [3, 9])
def test_a_rounded_bennett_linkage_is_rigid_and_nearly_one(digits: int) -> None:
    loop = rounded_loop(turned(assembled("bennett")), digits)
    tolerance = min(10.0 ** (2 - digits), WIDEST_GAP)
    report = nag.mobility(loop, tolerance=tolerance)
    assert report.status == "rigid" and report.near is not None
    near = report.near
    assert near.nearly_mobile and near.whole
    assert [x.linkage for x in near.linkages] == ["a Bennett linkage"]
    assert near.change is not None and near.left_open is not None
    # Neither is more than some hundred units in the last place, and the linkage does move.
    assert max(*near.change, *near.gap) < 100 * 10.0**-digits
    assert max(near.left_open) < ROUNDING


@pytest.mark.parametrize("digits", [3, 9])
@pytest.mark.parametrize("name", KINDS)
def test_a_rounded_linkage_is_nearly_mobile_and_next_to_what_was_rounded(
    name: str, digits: int
) -> None:
    mechanism = rounded_loop(turned(KINDS[name]()), digits)
    found = find_near_motion(mechanism, 2 * 10.0 ** (1 - digits))
    assert found is not None and found.nearly_mobile and found.change is not None
    (linkage,) = found.linkages
    assert name in (linkage.linkage, linkage.next_to)
    # What was rounded is mobile, and no further away than that: the least change is no larger.
    assert max(found.change) < 30 * 10.0**-digits * (1 + found.size)
    assert not replace(found, tolerance=10.0 ** (-digits - 3)).nearly_mobile


@pytest.mark.parametrize("pose", [1, 2])
@pytest.mark.parametrize("make", [line_symmetric, plane_symmetric])
def test_where_motions_nearly_meet_the_change_is_no_larger_than_the_rounding(make, pose) -> None:
    found = find_near_motion(rounded_loop(posed(make(), pose), 3), WIDEST_GAP)
    assert found is not None and found.nearly_mobile and found.change is not None
    assert max(found.change[0], found.change[1] / found.size) < 1e-3


@pytest.mark.parametrize("length", [1e-3, 1.0, 1e3])
def test_near_motions_of_lines_that_all_but_meet_are_measured_where_they_are_drawn(
    length: float,
) -> None:
    axes, points = turned(spherical())
    found = find_near_motion(rounded_loop((axes, length * points), 9), 1e-3)
    assert found is not None and found.nearly_mobile
    assert length / 2 < found.size < 2 * length


def test_gap_and_change_are_those_of_another_solver() -> None:
    mechanism = rounded_loop(posed(assembled("bennett"), 1), 3)
    found = find_near_motion(mechanism, 0.02)
    assert found is not None and found.change is not None
    theirs = measure(mechanism)
    scale = np.array([1, found.size])
    assert np.allclose(np.array(found.gap) / scale, theirs.gap, rtol=0.1, atol=0)
    assert np.allclose(np.array(found.change) / scale, theirs.change, rtol=0.1, atol=0)
    assert theirs.left_open.max() < 1e-11


def test_conditions_that_all_but_depend_on_each_other_are_met_as_well() -> None:
    """Few steps do not close a trihedral linkage of three digits."""
    mechanism = rounded_loop(posed(assembled("bricard-trihedral"), 0), 3)
    found = find_near_motion(mechanism, WIDEST_GAP)
    assert found is not None and found.nearly_mobile
    assert [x.next_to for x in found.linkages] == ["a trihedral Bricard linkage"]


@pytest.mark.parametrize("offset", [1e-2, 0.3])
@pytest.mark.parametrize("make", [lambda: assembled("bennett"), plane_symmetric])
def test_linkages_with_an_axis_out_of_place_are_not_nearly_mobile(make, offset: float) -> None:
    axes, points = turned(make())
    points[0] += offset * np.cross(axes[0], axes[1]) / np.linalg.norm(axes[0])
    found = find_near_motion(rounded_loop((axes, points), 12), 1e-3)
    assert found is not None and not found.nearly_mobile


def test_of_what_moves_no_near_motion_is_looked_for() -> None:
    report = nag.mobility(read_case(CASES / "bennett.toml").mechanism, tolerance=1e-4)
    assert report.near is None and report.status == "overconstrained"


def test_gaps_within_a_smaller_tolerance_are_not_claimed() -> None:
    made = read_case(CASES / "spatial" / "bennett-rounded.toml").mechanism
    assert made is not None
    wide, narrow = (find_near_motion(made, t) for t in (1e-6, 1e-8))
    assert wide is not None and narrow is not None
    assert wide.nearly_mobile and not narrow.nearly_mobile
    assert not wide.obstacle and narrow.obstacle.startswith("the gap is ")
    assert 1e-8 < max(wide.gap) < 1e-6


@pytest.mark.parametrize("n", [4, 5, 6])
def test_general_loops_are_never_nearly_mobile(n: int) -> None:
    found = find_near_motion(rounded_loop(general_lines(n, 0), 6), 1e-3)
    assert found is not None and not found.nearly_mobile


def test_rigid_is_the_first_word_and_a_hint_follows_where_one_is_due(capsys) -> None:
    rounded = str(CASES / "spatial" / "bennett-rounded.toml")
    assert main(["mobility", rounded, "--quiet"]) == 0
    said = capsys.readouterr().out
    assert "mobility    rigid: it does not move" in said and "\nhint  " in said
    assert main(["mobility", rounded, "--quiet", "--tolerance", "1e-6"]) == 0
    assert "nearly mobile within 1e-06" in capsys.readouterr().out
    general = rounded_loop(general_lines(6, 1), 6)
    assert find_spoiled_motion(general) == ""


ROUNDED_TABLE = [{"a": 120, "alpha": "5*pi/18"}, {"a": 75, "alpha": "28.6056*pi/180"}] * 2


def test_a_table_in_rounded_numbers_gives_a_hint_and_is_nearly_mobile() -> None:
    table = nag.DHLoop.of(ROUNDED_TABLE)
    assert "rounding" in nag.mobility(table).hint
    report = nag.mobility(table, tolerance=1e-3)
    assert report.near is not None and report.near.nearly_mobile
    assert [str(x) for x in report.near.linkages] == ["a Bennett linkage"]
    assert report.sentence.startswith("no configuration moves") and "nearly" in report.sentence
    other = nag.DHLoop.of([ROUNDED_TABLE[0], {"a": 75, "alpha": "pi/6"}] * 2)
    general = nag.mobility(other, tolerance=1e-3)
    assert general.near is not None and not general.near.nearly_mobile
    assert "nor nearly so within 0.001" in general.sentence


GOLDBERG = [
    {"a": "7/5", "alpha": "pi/2"},
    {"a": "0.471", "alpha": "28.07*pi/180"},
    {"a": "3/5", "alpha": "36.87*pi/180"},
    {"a": "4/5", "alpha": "53.13*pi/180"},
    {"a": "0.471", "alpha": "28.07*pi/180"},
]


def test_a_table_that_rounding_leaves_shaky_is_looked_at_with_a_tolerance() -> None:
    report = nag.mobility(nag.DHLoop.of(GOLDBERG), tolerance=1e-2)
    assert report.status == "shaky" and "but nearly does" in report.sentence
    assert report.near is not None and report.near.nearly_mobile
    assert [str(x) for x in report.near.linkages] == ["a Goldberg 5R linkage"]


def test_a_rounded_table_that_cannot_be_assembled_says_what_to_do_in_both_commands() -> None:
    rows = [{"a": a, "alpha": t} for a, t in zip((3, "3/2") * 2, ("pi/2", "pi/6") * 2, strict=True)]
    rows[3]["a"] = "1.501"
    for ask in (lambda t: nag.mobility(t, tolerance=1e-3), nag.motion):
        with pytest.raises(NagError, match=r"cannot be assembled.*rounded.*kind = \"mechanism\""):
            ask(nag.DHLoop.of(rows))


def test_a_drawing_in_four_digits_gives_a_hint() -> None:
    lines = [
        ((0, 0, 0), (0, 0, 1)),
        (("54.4315", "106.9449", 0), ("0.6827", "-0.3475", "0.6428")),
        (("37.4951", "36.6726", "-19.9992"), ("0.2667", "-0.3227", "0.9082")),
        ((-75, 0, 0), (0, "0.4788", "0.8779")),
    ]
    joints = (
        nag.Joint(f"J{i}", "revolute", (f"B{i}", f"B{(i + 1) % 4}"), *line)
        for i, line in enumerate(lines)
    )
    assert "rounding" in find_spoiled_motion(nag.Mechanism("B0", tuple(joints)))


def test_a_tolerance_that_makes_no_sense_is_refused(capsys) -> None:
    made = read_case(CASES / "spatial" / "bennett-rounded.toml").mechanism
    for wrong in (0, -1, 1, float("nan")):
        with pytest.raises(NagError, match=r"tolerance: .* is not positive and at most 0\.03"):
            nag.mobility(made, tolerance=wrong)
    rounded = str(CASES / "spatial" / "bennett-rounded.toml")
    assert main(["mobility", rounded, "--tolerance", "2"]) == 2
    assert "is not positive and at most 0.03" in capsys.readouterr().err


NEARLY_MEETING = (((1, 0, 0), (0, 0, 0)), ((1, 2, 0), (0, 0, 1)), ((1, 2, 3), (1, 0, 0)))
NEARLY_MEETING += (((0, 1, 4), (0, 1, 0)),)


def nearly_meeting(offset: Fraction, *along: int) -> Mechanism:
    """Four turns about axes that pass a point in the distance of an offset, named along them."""
    joints = []
    for i, (axis, away) in enumerate(NEARLY_MEETING):
        point = tuple(
            offset * x + along[i % len(along)] * y for x, y in zip(away, axis, strict=True)
        )
        joints.append(Joint(f"J{i}", "revolute", (f"b{(i - 1) % 4}", f"b{i}"), point, axis))
    return Mechanism("b0", tuple(joints))


@pytest.mark.parametrize("offset", [Fraction(1, 10**6), Fraction(1)])
def test_axes_that_pass_a_point_are_small_beside_links_that_are_told(offset: Fraction) -> None:
    """Where joints are named there as well nothing says that their distances are small."""
    found = find_near_motion(nearly_meeting(offset, 0), 1e-3)
    assert found is not None and not found.nearly_mobile and found.radius is not None
    assert found.size < offset and 2e3 * offset < found.radius < 2e4 * offset
    assert any(label == "lengths" for label, _ in found.rows())
    # The shortest of the axes' vectors is longer than one.
    drawn = find_near_motion(nearly_meeting(offset, int(found.radius) + 1), 1e-3)
    assert drawn is not None and drawn.nearly_mobile and drawn.radius is None


def test_a_ball_where_axes_all_but_meet_says_nothing_of_the_size() -> None:
    """It must be there, while the others are drawn at a distance of one."""
    near = (("J0", "revolute", (0, 0, 1), (0, 0, 1)), ("J1", "revolute", (1, 0, 0), (1, 0, "1e-6")))
    joints = [
        Joint(name, kind, (f"b{i}", f"b{i + 1}"), point, axis)
        for i, (name, kind, point, axis) in enumerate(near)
    ]
    ball = Joint("J2", "spherical", ("b2", "b0"), ("0", "1e-6", "0"))
    found = find_near_motion(Mechanism("b0", (*joints, ball)), 1e-3)
    assert found is not None and found.nearly_mobile and found.size == pytest.approx(1)


@pytest.mark.parametrize("shift", [0, 10**6])
def test_a_planar_joint_is_nowhere(shift: int) -> None:
    """Where the origin lies beside it is nothing that a mechanism has."""
    place = (1 + shift, shift, shift), (2 + shift, 1 + shift, shift)
    joints = (
        Joint("E", "planar", ("b0", "b1"), axis=("0", "1e-5", "1")),
        Joint("A", "revolute", ("b1", "b2"), place[0], (0, 0, 1)),
        Joint("B", "revolute", ("b2", "b0"), place[1], ("1e-5", "0", "1")),
    )
    found = find_near_motion(Mechanism("b0", joints), 1e-3)
    assert found is not None and found.nearly_mobile
    assert found.size == pytest.approx(1 / np.sqrt(2), rel=1e-6)


def test_one_joint_that_is_named_far_along_its_axis_makes_nothing_small() -> None:
    near = find_near_motion(nearly_meeting(Fraction(1), 0), 1e-3)
    far = find_near_motion(nearly_meeting(Fraction(1), 0, 0, 10**9, 0), 1e-3)
    assert near is not None and far is not None
    assert not far.nearly_mobile
    assert far.size == pytest.approx(near.size, rel=1e-12)
    assert far.gap == pytest.approx(near.gap, rel=1e-12)


TRIANGLE = (
    (("0.1269", "-0.9141", "0.3852"), ("0", "0", "0")),
    (("0.1739", "-1.2523", "0.5277"), ("-2.0917", "0.5819", "2.0703")),
    (("0.2209", "-1.5905", "0.6702"), ("-2.8220", "-1.4247", "-2.4508")),
)
FOUR_BAR = (
    (("0.127", "-0.914", "0.385"), ("0.000", "0.000", "0.000")),
    (("0.174", "-1.252", "0.528"), ("-2.814", "-0.875", "-1.148")),
    (("0.221", "-1.590", "0.670"), ("-5.611", "-0.649", "0.310")),
    (("0.268", "-1.929", "0.813"), ("-3.486", "0.970", "3.450")),
)


@pytest.mark.parametrize(("lines", "near"), [(TRIANGLE, False), (FOUR_BAR, True)])
def test_axes_that_all_but_meet_far_away_have_the_size_of_the_links(
    lines: tuple[tuple[tuple[str, ...], tuple[str, ...]], ...], near: bool
) -> None:
    """Planar loops, turned and rounded: parallel axes but for the digits that are written."""
    count = len(lines)
    joints = (
        Joint(f"J{k}", "revolute", (f"b{k}", f"b{(k + 1) % count}"), point, axis)
        for k, (axis, point) in enumerate(lines)
    )
    found = find_near_motion(Mechanism("b0", tuple(joints)), 0.01)
    assert found is not None
    assert 1 < found.size < 5
    assert found.nearly_mobile == near
    if near:
        # By the closure of the plane loop: from -1.95 to 3.80, open by 7.6e-4 rad and 1.6e-3.
        assert found.driven_to == pytest.approx((-1.95, 3.80), abs=0.02)
        assert found.gap[0] < 2e-3 and found.gap[1] < 3e-3


def test_of_several_near_freedoms_all_but_one_are_held() -> None:
    """A planar five-bar, rounded: with one joint held its motion is that of a four-bar."""
    corners = np.array([[0, 0, 0.3], [-1, 2, 0], [2, 3.5, -0.2], [4, 2, 0.4], [3, 0, 0]])
    lengths = np.array([[1.0], [1.3], [0.8], [0.7], [0.9]])
    mechanism = rounded_loop(turned((np.array([[0, 0, 1.0]] * 5) * lengths, corners)), 6)
    found = find_near_motion(mechanism, 1e-3)
    assert found is not None and found.nearly_mobile
    (held,) = found.held
    # The driven joint turns from where the two links across from it are in line to the mirror
    # image, or through a whole turn.
    left = [i for i in range(5) if f"J{i}" != held]
    k = left.index(int(found.driven[1:]))
    before, here, after, across = (corners[left[(k + i) % 4], :2] for i in (-1, 0, 1, 2))
    own, others = (
        [np.linalg.norm(before - middle), np.linalg.norm(after - middle)]
        for middle in (here, across)
    )
    low, high = (
        np.arccos(np.clip((own[0] ** 2 + own[1] ** 2 - d**2) / (2 * own[0] * own[1]), -1, 1))
        for d in (abs(others[0] - others[1]), sum(others))
    )
    least, most = found.driven_to
    assert most - least == pytest.approx(2 * (np.pi - low if low > 0 else high), abs=0.02)
    assert low == 0 or high == np.pi


@pytest.mark.parametrize("first", [0, 3])
def test_of_a_turn_and_a_slide_the_slide_is_held(first: int) -> None:
    """A planar four-bar, rounded, that two of its joints let slide along their axes as well."""
    corners = [[0, 0, 0], [2, 0, 0.3], [2.5, 1.5, -0.4], [0.2, 1, 0]]
    axes = np.array([[0, 0, 1.0]] * 4) * np.array([[1.0], [1.3], [0.8], [0.7]])
    order = np.roll(np.arange(4), first)
    axes, points = posed((axes[order], np.array(corners)[order]), 1)
    joints = rounded_loop((axes, points), 6).joints
    sliding = ("J0", "J1") if not first else ("J1", "J2")
    made = (replace(j, type="cylindrical") if j.name in sliding else j for j in joints)
    found = find_near_motion(Mechanism("B0", tuple(made)), 1e-3)
    assert found is not None and found.nearly_mobile and not found.slides
    assert len(found.held) == 1 and found.held[0] in sliding
    least, most = found.driven_to
    assert most - least > 1


def test_loops_that_nearly_move_by_themselves_are_looked_at_one_by_one() -> None:
    first, second = (rounded_loop(posed(assembled("bennett"), seed), 6).joints for seed in (1, 2))
    other = (
        replace(
            joint,
            name=f"K{i}",
            bodies=tuple(b if b == "B0" else f"C{b}" for b in joint.bodies),
        )
        for i, joint in enumerate(second)
    )
    both = Mechanism("B0", (*first, *other))
    found = find_near_motion(both, 1e-4)
    assert found is not None and found.nearly_mobile and len(found.held) == 1
    assert found.driven[0] != found.held[0][0]
    assert "of the next" in find_spoiled_motion(both)


def parallelogram_with_rod(first: tuple[str, ...], second: tuple[str, ...]) -> Mechanism:
    """A parallelogram whose axes are tilted by thousandths, and a rod from its base to its side."""
    links = ["base", "a", "b", "c"]
    places = [("0", "0", "0"), ("1", "2", "0"), ("4", "2", "0"), ("3", "0", "0")]
    axes = [("0.001", "0", "1"), ("0", "0.001", "1"), ("0", "0", "1"), ("0", "-0.001", "1")]
    turns = [
        Joint("ABCD"[i], "revolute", (links[i], links[(i + 1) % 4]), places[i], axes[i])
        for i in range(4)
    ]
    ends = [
        Joint("S1", "spherical", ("base", "rod"), first),
        Joint("S2", "spherical", ("rod", "b"), second),
    ]
    return Mechanism("base", (*turns, *ends))


@pytest.mark.parametrize(
    ("second", "nearly"), [(("2", "1", "0.001"), True), (("2.1", "1.3", "0.001"), False)]
)
def test_what_is_rigid_apart_from_a_rod_about_itself_is_looked_at(second, nearly):
    # In the rod's plane of motion two axes of a ball fall in line, if they are not chosen.
    found = nag.mobility(parallelogram_with_rod(("1", "-1", "0"), second), tolerance=1e-2)
    assert found.local_dimension == 1
    assert found.near is not None
    assert found.near.nearly_mobile is nearly
    assert found.near.driven in "ABCD"
    assert found.near.held == ()
