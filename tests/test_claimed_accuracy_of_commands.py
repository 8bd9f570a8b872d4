"""What `nag intersect`, `singular`, `sample`, `member`, `local`, `eliminate` print, against truth.

The curves are the circle x^2 + y^2 = 2 and a cubic with a node at (1, 0). They meet where
x (x^2 + x - 3) = 0, and all of that is known to as many digits as one likes.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import flint
import numpy as np
import pytest

from nag.algebra.expression import parse_polynomial
from nag.cli import main

CURVES = """
title = "A circle and a nodal cubic"
kind = "system"
variables = ["x", "y"]
equations = ["(x^2 + y^2 - 2)*(y^2 - x^3 + 3*x - 2)"]
"""
TRIPLE = """
title = "Two triple points"
kind = "system"
variables = ["x", "y"]
equations = ["x^2 - 2", "(x - y)^3"]
"""
PARAMETRISED = """
title = "A cubic with a parameter"
kind = "system"
variables = ["s", "x", "y"]
equations = ["x - s^2 + 2*s/3", "y - s^3 - s"]
"""
DIGITS = 130
Run = Callable[..., tuple[str, Any]]


@pytest.fixture
def run(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Run:
    """Runs a command on a case: what it prints, and its JSON."""

    def command(text: str, name: str, *arguments: str) -> tuple[str, Any]:
        case, export = tmp_path / "case.toml", tmp_path / "answer.json"
        case.write_text(text)
        main([name, str(case), *arguments, "--quiet", "--json", str(export)])
        return capsys.readouterr().out, json.loads(export.read_text())

    return command


def meetings() -> list[list[flint.acb]]:
    """The points where the circle and the cubic meet."""
    with flint.ctx.workdps(DIGITS):
        root = flint.arb(13).sqrt()
        xs = [flint.acb(0), flint.acb((root - 1) / 2), flint.acb((-root - 1) / 2)]
        ys = [(2 - x * x).sqrt() for x in xs]
        return [[x, s * y] for x, y in zip(xs, ys, strict=True) for s in (1, -1)]


def distances(point: list[list[float]], exact: list[flint.acb]) -> np.ndarray:
    """How far the coordinates of a point of doubles are from the exact ones."""
    with flint.ctx.workdps(DIGITS):
        given = [flint.acb(flint.arb(re), flint.arb(im)) for re, im in point]
        return np.array([float(abs(a - b).mid()) for a, b in zip(given, exact, strict=True)])


def nearest(point: list[list[float]]) -> list[flint.acb]:
    return min(meetings(), key=lambda exact: distances(point, exact).max())


def last_place(text: str) -> float:
    """One unit of the last digit of a decimal number."""
    digits, _, exponent = text.lower().partition("e")
    return 10.0 ** (int(exponent or 0) - len(digits.partition(".")[2]))


def test_points_where_components_meet_are_as_accurate_as_they_say(run: Run) -> None:
    _, found = run(CURVES, "intersect", "--components", "1", "2")
    assert sum(c["degree"] for c in found["components"]) == 6
    for component in found["components"]:
        for point, radii in zip(component["points"], component["radii"], strict=True):
            off = distances(point, nearest(point))
            assert (off <= radii).all()
            norm = 1 + np.linalg.norm(point)
            assert np.linalg.norm(off) <= component["accuracy"] * norm + 2.0**-53 * norm


def test_singular_points_have_the_digits_that_are_shown_and_written(run: Run) -> None:
    text, found = run(CURVES, "singular")
    node = [flint.acb(1), flint.acb(0)]
    assert len(found["sets"]) == 7
    for item in found["sets"]:
        (point,) = item["points"]
        exact = node if item["essential"] else nearest(point)
        assert (distances(point, exact) <= 2.0**-52 * (1 + np.linalg.norm(point))).all()
        with flint.ctx.workdps(DIGITS):
            for (re_text, im_text), z in zip(item["local"]["sharpened"], exact, strict=True):
                shown = flint.acb(flint.arb(re_text), flint.arb(im_text))
                assert abs(shown - z) < flint.arb(10) ** -98
    shown = re.findall(r"x = (-?[\d.]+), y = (-?[\d.]+)(i?)", text)
    assert len(shown) == 7
    exact_points = [node, *meetings()]
    for x, y, imaginary in shown:
        value = [[float(x), 0.0], [0.0, float(y)] if imaginary else [float(y), 0.0]]
        off = min((distances(value, exact) for exact in exact_points), key=max)
        assert (off <= [0.51 * last_place(x), 0.51 * last_place(y)]).all()


def test_samples_are_as_near_to_their_component_as_they_say(run: Run) -> None:
    _, found = run(CURVES, "sample", "--component", "1", "--count", "5")
    assert len(found["points"]) == 5
    with flint.ctx.workdps(DIGITS):
        for point in found["points"]:
            x, y = (flint.acb(flint.arb(re), flint.arb(im)) for re, im in point)
            slope = 2 * (abs(x) ** 2 + abs(y) ** 2).sqrt()
            off = float((abs(x * x + y * y - 2) / slope).mid())
            assert off <= found["accuracy"] * (1 + np.linalg.norm(point))


@pytest.mark.parametrize("off", ["0", "1/10^30", "1/10^12"])
def test_equations_hold_exactly_only_where_they_do(run: Run, off: str) -> None:
    text, found = run(CURVES, "member", "--at", f"x = 1, y = 1 + {off}")
    y = Fraction(found["point"][1])
    factors = (y**2 - 1) * y**2
    assert found["exact"] is (factors == 0)
    assert ("hold exactly" in text) is (factors == 0)
    # The terms of the product at (1, 1) add up to 40 at most.
    assert found["residual"] >= abs(float(factors)) / 40
    answers = [c["answer"] for c in found["components"]]
    assert answers[1] == "foreign"
    assert answers[0] != "foreign" or factors != 0


def test_a_point_that_is_far_off_for_its_digits_is_on_no_component(run: Run) -> None:
    _, found = run(CURVES, "member", "--at", "x = 1, y = 1 + 1/10^4")
    assert [c["answer"] for c in found["components"]] == ["foreign", "foreign"]


def test_a_sharpened_point_has_the_digits_that_are_written(run: Run) -> None:
    _, found = run(TRIPLE, "local", "--at", "x = 1.41421356, y = 1.41421356")
    (point,) = found["points"]
    assert (point["local_dimension"], point["multiplicity"]) == (0, 3)
    with flint.ctx.workdps(DIGITS):
        for re_text, im_text in point["sharpened"]:
            assert abs(flint.arb(re_text) - flint.arb(2).sqrt()) < flint.arb(10) ** -98
            assert abs(flint.arb(im_text)) < flint.arb(10) ** -98


def test_equations_and_maps_of_an_image_hold_exactly(run: Run) -> None:
    _, found = run(PARAMETRISED, "eliminate", "--onto", "x,y")
    (equation,), (back,) = found["equations"], found["maps"]
    f, above, below = (
        parse_polynomial(text, ("x", "y"))
        for text in (equation["polynomial"], back["numerator"], back["denominator"])
    )
    assert f.degree == 3
    for s in (Fraction(k, 7) for k in range(-9, 30, 4)):
        point = [s**2 - 2 * s / 3, s**3 + s]
        assert f(point) == 0
        assert above(point) == s * below(point)
    # No digits are claimed beyond those in which the points were computed.
    assert found["fresh"]["digits"] <= 2 * found["digits"]
