"""Loops by the lines of their axes, and the lines of a loop."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import cycle
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import nag
from nag.mechanism.axes import cross, dot
from nag.mechanism.lines import given_links, short_links, turns_about_line
from nag.mechanism.loops import loop_structure


class Line:
    """A line as other programs have it: six numbers by their indices."""

    def __init__(self, numbers: Any) -> None:
        self.numbers = np.array(numbers)

    def __getitem__(self, index: int) -> float:
        return self.numbers[index]


def test_lines_are_those_of_the_mechanism_that_they_make() -> None:
    case = nag.read_case("cases/bennett.toml")
    lines = case.mechanism.lines()
    assert lines.shape == (4, 6)
    assert np.allclose((lines[:, :3] * lines[:, 3:]).sum(axis=1), 0)
    again = nag.Mechanism.from_lines(map(Line, lines))
    assert np.abs(again.lines() - lines).max() < 1e-15
    assert [j.bodies for j in again.joints][-1] == ("link3", "link0")


def test_exact_lines_are_kept_and_rounded_ones_nearly_move() -> None:
    mechanism = nag.read_case("cases/bennett.toml").mechanism
    exact = [[*j.axis, *cross(j.point, j.axis)] for j in mechanism.joints]
    assert nag.mobility(nag.Mechanism.from_lines(exact)).local_dimension == 1
    rounded = nag.mobility(nag.Mechanism.from_lines(mechanism.lines()), tolerance=1e-3)
    assert rounded.local_dimension == 0
    assert "Bennett" in str(rounded)


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ((0, 0, 1, 0, 0), "give six numbers"),
        (3, "give six numbers"),
        ((0, 0, 0, 1, 0, 0), "length zero"),
        ((0, 0, 1, 0, 0, 1), "not orthogonal"),
        ((0, 0, "a", 0, 0, 1), r"lines\[1\]\[2\]: column 1"),
    ],
)
def test_what_is_no_line_is_refused_by_its_number(line: Any, said: str) -> None:
    with pytest.raises(nag.NagError, match=said):
        nag.Mechanism.from_lines([(0, 0, 1, 0, 0, 0), line])


def moved_along(mechanism: nag.Mechanism, steps: Sequence[Fraction]) -> nag.Mechanism:
    """The same axes by other points of them; slides at any other place."""
    joints = []
    for joint, step in zip(mechanism.joints, cycle(steps), strict=False):
        if turns_about_line(joint):
            point = tuple(x + step * y for x, y in zip(joint.point, joint.axis, strict=True))
            joint = replace(joint, point=point)
        elif joint.of_type.slides_only:
            joint = replace(joint, point=tuple(x + step for x in joint.point))
        joints.append(joint)
    return replace(mechanism, joints=tuple(joints))


STEPS = st.builds(
    lambda digits, size: Fraction(digits * 10**size),
    st.integers(-9, 9),
    st.integers(0, 30),
)


@settings(max_examples=4, deadline=None)
@given(steps=st.lists(STEPS, min_size=1, max_size=5))
@pytest.mark.parametrize(
    "name",
    ["bennett", "planar-four-bar", "spatial/rssr", "spatial/rccc", "spatial/delassus-rprp"],
)
def test_mobility_does_not_depend_on_which_points_of_axes_are_named(
    name: str, steps: list[Fraction]
) -> None:
    made = nag.read_case(f"cases/{name}.toml").mechanism
    body = made.body_names[-1]
    assert nag.mobility(moved_along(made, steps), of=body) == nag.mobility(made, of=body)


@settings(max_examples=5, deadline=None)
@given(steps=st.lists(STEPS, min_size=1, max_size=5))
@pytest.mark.parametrize("name", ["robots/3-rps", "spatial/rccc", "planar/five-bar"])
def test_links_are_short_whichever_points_of_axes_are_named(
    name: str, steps: list[Fraction]
) -> None:
    made = nag.read_case(f"cases/{name}.toml").mechanism
    for loop in loop_structure(made).loops:
        assert short_links(loop.joints) == given_links(loop.joints)
        before = max(dot(link, link) for link in given_links(loop.joints))
        moved = moved_along(replace(made, joints=tuple(loop.joints)), steps)
        links = short_links(moved.joints)
        # Each end of a link is moved to within four of the longest of the shortest ones.
        assert max(dot(link, link) for link in links) <= 81 * before
        assert max(x.denominator for link in links for x in link) < 10**4
        # They close, as the points that are named do.
        assert all(sum(along, Fraction(0)) == 0 for along in zip(*links, strict=True))


def test_a_telescope_stays_idle_however_far_its_axes_are_named() -> None:
    """Lengths are those of the mechanism, whichever points of the axes are given."""
    x, z, far = (1, 0, 0), (0, 0, 1), (1 + 2 * 10**9, 2 * 10**9, 10**9)
    joints = (
        nag.Joint("A", "revolute", ("base", "crank"), (0, 0, 10**12), z),
        nag.Joint("B", "spherical", ("crank", "tube"), (1, 0, 0)),
        nag.Joint("C", "cylindrical", ("tube", "rod"), far, (2, 2, 1)),
        nag.Joint("D", "spherical", ("rod", "rocker"), (3, 2, 1)),
        nag.Joint("E", "revolute", ("rocker", "base"), (-(10**20), 0, 1), x),
    )
    moving = nag.mobility(nag.Mechanism("base", joints), detail="local").moving
    assert {e.bodies for e in moving.idle} == {("tube",), ("rod",)}
