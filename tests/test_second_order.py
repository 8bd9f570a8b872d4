"""Real motions that terms of second order forbid, and none that there are."""

from __future__ import annotations

import networkx
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from linkages import CASES

import nag
from nag.cli.command_line import main
from nag.decomposition.through import through_points
from nag.mechanism.graph import Joint, Mechanism
from nag.mechanism.mobility_report import MobilityStatus
from nag.numerics.second_order import count_real_directions

Z = (0, 0, 1)


def straight(steps: list[int]) -> Mechanism:
    """A closed chain of bars that all lie in one line."""
    places = np.cumsum([0, *steps[:-1]])
    joints = tuple(
        Joint(f"J{i}", "revolute", (f"L{i}", f"L{(i + 1) % len(steps)}"), (int(x), 0, 0), Z)
        for i, x in enumerate(places)
    )
    return Mechanism("L0", joints)


def signs_of_second_order(steps: list[int]) -> set[float]:
    """Signs of the eigenvalues of sum s t^2 where sum s t = 0, of turns t against the first bar."""
    free = np.array(steps[1:], dtype=float)
    tangents = np.linalg.svd(free[None])[2][1:]
    return set(np.sign(np.linalg.eigvalsh(tangents @ np.diag(free) @ tangents.T)).tolist())


lengths = st.lists(st.integers(-5, 5).filter(bool), min_size=3, max_size=4).filter(
    lambda steps: sum(steps) != 0
)


@settings(max_examples=25, deadline=None)
@given(lengths)
def test_a_straight_chain_stands_still_where_its_second_order_is_definite(steps) -> None:
    steps = [*steps, -sum(steps)]
    report = nag.mobility(straight(steps), detail="local")
    assert (report.tangent_dimension, report.local_dimension) == (len(steps) - 2, len(steps) - 3)
    assert report.is_blocked == (len(signs_of_second_order(steps)) == 1)


@pytest.mark.parametrize("formulation", ["E", "H"])
def test_a_stretched_four_bar_is_said_not_to_move(formulation: str) -> None:
    case = nag.read_case(CASES / "mobility" / "four-bar-stretched.toml")
    report = nag.mobility(case, formulation=formulation)
    assert report.status is MobilityStatus.SHAKY and "it does not move" in report.sentence
    document = report.document()
    assert document["blocked"] and report.local_dimension == 1
    assert document["moving_unknown"] == "no real motion has all of its freedoms"


def test_a_joint_beside_a_blocked_loop_still_moves() -> None:
    loop = nag.read_case(CASES / "mobility" / "four-bar-stretched.toml").mechanism
    handle = Joint("E", "revolute", ("base", "handle"), (0, 1, 0), Z)
    report = nag.mobility(Mechanism("base", (*loop.joints, handle)))
    assert report.status is MobilityStatus.MOBILE
    assert report.sentence.startswith("it moves with 1 freedom")
    assert "and no other" in report.sentence


@pytest.mark.parametrize(
    ("equations", "blocked"),
    [
        (["x^2 + x*y + y^2"], True),
        (["x^2 - 3*x*y + y^2"], False),
        (["x^2 - y^3"], False),
        (["x^2 - y^2", "x*y"], False),
        (["x^2 - y^2 + z", "x^2 + 3*y^2 + x*z", "z"], True),
        (["x^2 + 2*z^2 - y^2 + x*y", "3*y^2 - z^2 + y*z"], True),
        (["x*y", "y*z", "x*z"], False),
        (["x^4 + y^4"], False),
    ],
)
def test_a_definite_combination_blocks_all_of_the_tangent_space(equations, blocked) -> None:
    system = nag.system(equations)
    origin = np.zeros(system.n)
    corank = system.n - np.linalg.matrix_rank(
        [[float(d([0] * system.n)) for d in row] for row in system.jacobian]
    )
    assert (count_real_directions(system, origin, int(corank)) == 0) is blocked


@pytest.mark.parametrize("name", ["planar/four-bar-folding", "planar/four-bar-kite"])
def test_where_real_motions_meet_nothing_is_blocked(name: str) -> None:
    report = nag.mobility(nag.read_case(CASES / f"{name}.toml"), detail="through")
    assert not report.is_blocked


def test_a_blocked_loop_beside_one_that_moves_takes_its_freedoms_away() -> None:
    """On the coupler of a four-bar a loop of bars of lengths 1, 2, 3 and 6, all in one line."""
    corners = {"A": (0, 0), "B": (0, 2), "C": (7, 3), "D": (8, 0)}
    links = ("base", "crank", "coupler", "rocker", "base")
    joints = [
        Joint(name, "revolute", links[i : i + 2], (*place, 0), Z)
        for i, (name, place) in enumerate(corners.items())
    ]
    bars = ("coupler", "one", "two", "three", "coupler")
    joints += [
        Joint(f"L{i}", "revolute", bars[i : i + 2], (x, 2, 0), Z)
        for i, x in enumerate((0, 1, 3, 6))
    ]
    report = nag.mobility(Mechanism("base", tuple(joints)), detail="local")
    assert (report.tangent_dimension, report.local_dimension, report.unreal) == (3, 2, 1)
    assert not report.is_blocked and "it moves with 1 freedom, and with 1 more" in report.sentence


@pytest.mark.parametrize(
    ("equations", "count"),
    [
        (["x^2 + y^2"], 1),
        (["x^2 - y^2"], 3),
        (["x^2 + y^2 + z^3"], 1),
        (["x^2 + y^2", "z^2"], 0),
        (["x^2 - y^2", "x*y"], 3),
        (["(x + y)^2"], 2),
    ],
)
def test_real_curves_leave_in_the_directions_that_no_form_sees(equations, count: int) -> None:
    system = nag.system(equations, variables="x y z")
    assert count_real_directions(system, np.zeros(3), 3) == count


@pytest.mark.parametrize(
    ("equations", "unreal"),
    [("x^2 + y^2 - x^2*z", 1), ("x^2 - y^2 - x^2*z", 0), ("x^2 + y^2 + z^2 - x^3", 2)],
)
def test_a_decomposition_says_at_a_point_what_is_not_real(equations, unreal: int) -> None:
    found = nag.decompose(equations, "x y z")
    (through,) = through_points(found, [("origin", (0, 0, 0))])
    assert (through.components, through.unreal) == ((0,), unreal)


def test_a_decomposition_says_that_no_real_motion_leaves_a_stretched_four_bar(capsys) -> None:
    assert main(["decompose", str(CASES / "mobility" / "four-bar-stretched.toml")]) == 0
    assert "by terms of second order no real motion leaves it" in " ".join(
        capsys.readouterr().out.split()
    )


@pytest.mark.parametrize(
    ("points", "bars", "moves"),
    [
        # Bars in a line that one of them is as long as the others of, in the plane and in space,
        # and bars in a line of which two are as long as the other two.
        ([(0, 0), (1, 0), (3, 0), (6, 0)], "AB BC CD AD", False),
        ([(0, 0, 0), (1, 0, 0), (3, 0, 0), (2, 3, 0)], "AB BC AC AD CD", False),
        ([(0, 0), (3, 0), (1, 0), (4, 0)], "AB BC CD AD", True),
    ],
)
def test_frameworks_in_their_own_places_are_asked_whether_real_motions_leave(
    points, bars: str, moves: bool
) -> None:
    graph = networkx.Graph([tuple(bar) for bar in bars.split()])
    networkx.set_node_attributes(graph, dict(zip("ABCD", points, strict=True)), "pos")
    report = nag.mobility(nag.framework_of_graph(graph, len(points[0])))
    assert (report.is_blocked, report.status is MobilityStatus.SHAKY) == (not moves, not moves)
