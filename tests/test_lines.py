"""Loops by the lines of their axes, and the lines of a loop."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import nag
from nag.mechanism.axes import cross


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
