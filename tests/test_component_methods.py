"""Components are sampled, tested and projected without their system being named again."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import nag
from nag.witness.frame import expand_orbits
from nag.witness.witness import WitnessSet


@pytest.fixture(scope="module")
def circle() -> WitnessSet:
    return nag.decompose("x^2 + y^2 = 1").components[0]


def test_components_know_the_system_that_they_are_of(tmp_path: Any) -> None:
    answer = nag.decompose(["(x - 1)*(x - 3)*y*(x^2 + y^2 - 1)"], symmetries=[{"y": "-y"}])
    nag.write_decomposition(answer, tmp_path / "answer.json")
    again = nag.read_decomposition(tmp_path / "answer.json")
    assert again == answer
    for known in (answer, again, expand_orbits(answer), replace(answer, notes=("one",))):
        assert all(c.system is known.system for c in known.components)


def test_the_system_takes_no_part_in_comparisons(circle: WitnessSet) -> None:
    assert replace(circle, system=None) == circle


def test_a_set_without_a_system_says_so(circle: WitnessSet) -> None:
    alone = replace(circle, system=None)
    for ask in (
        lambda: alone.sample(0),
        lambda: alone.contains([1, 0]),
        lambda: alone.project([0]),
    ):
        with pytest.raises(ValueError, match="system: the witness set does not know its equations"):
            ask()


def test_samples_are_points_of_the_component_and_repeatable(circle: WitnessSet) -> None:
    points = circle.sample(np.random.default_rng(5), 4)
    assert points.shape == (4, 2)
    assert np.abs((points**2).sum(axis=1) - 1).max() < 1e-9
    assert np.array_equal(points, circle.sample(np.random.default_rng(5), 4))
    assert np.array_equal(circle.sample(5, 2), circle.sample(5, 2))
    rng = np.random.default_rng(5)
    assert not np.array_equal(circle.sample(rng, 4), circle.sample(rng, 4))
    assert circle.sample(0, 0).shape == (0, 2)


@pytest.mark.parametrize(
    ("point", "answer"),
    [
        (["3/5", "4/5"], True),
        ({"y": "4/5", "x": 0.6}, True),
        ([0.6, 0.8], True),
        (np.array([1j, np.sqrt(2)]), True),
        ((1, 0), True),
        (["3/5", "4/5 + 1/10^20"], False),
        (["sqrt(2)/2", "sqrt(1/2)"], True),
        ([0.6, 0.8 + 1e-6], False),
        ([2, 2], False),
    ],
)
def test_exact_points_are_tested_exactly_and_floats_to_rounding(
    circle: WitnessSet, point: Any, answer: bool
) -> None:
    assert circle.contains(point) is answer


def test_a_point_of_another_component_is_not_on_it() -> None:
    line, conic = nag.decompose("(x^2 + y^2 - 1)*(x - 2*y)").components
    assert (line.degree, conic.degree) == (1, 2)
    assert line.contains([2, 1]) and not conic.contains([2, 1])
    assert conic.contains([1, 0]) and not line.contains([1, 0])
    both = [2 / np.sqrt(5), 1 / np.sqrt(5)]
    assert line.contains(both) and conic.contains(both)


def test_projections_go_to_variables_by_index_or_name() -> None:
    curve = nag.decompose(["y - x^2", "z - x^3"]).components[0]
    for coordinates in ([1, 2], ["y", "z"]):
        image = curve.project(coordinates)
        assert (image.dimension, image.degree, image.fibre_degree) == (1, 3, 1)


@pytest.mark.parametrize(
    ("ask", "message"),
    [
        (lambda c: c.contains([1]), "point: 1 coordinate is given; there are 2 variables: x, y"),
        (lambda c: c.contains({"x": 1}), "point: no value for 'y'"),
        (lambda c: c.contains({"x": 1, "z": 1}), "point: 'z' is no variable"),
        (lambda c: c.contains("x"), "point: 'x' is given; give 2 numbers"),
        (lambda c: c.contains([1, "x"]), r"point\[1\]: column 1: unknown name 'x'"),
        (
            lambda c: c.contains([1, float("nan")]),
            r"point\[1\]: nan is no number",
        ),
        (lambda c: c.sample(0, -1), "count: -1 is given; give a whole number from 0 up"),
        (lambda c: c.sample(0, 1.5), "count: 1.5 is given"),
        (lambda c: c.sample(None, 1), "rng: None is given; give numpy.random.default_rng"),
        (lambda c: c.project([2]), "coordinates: 2 is no index; there are 2 variables"),
        (lambda c: c.project(["z"]), "coordinates: 'z' is no variable"),
    ],
)
def test_errors_name_the_argument(circle: WitnessSet, ask: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        ask(circle)
