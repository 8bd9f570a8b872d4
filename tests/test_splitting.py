"""Points of plane curves: traces, irreducible classes, and the checks before they are reported."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from cuts import curve, fibre, points_on

from nag.algebra.elimination import eliminate_linear
from nag.algebra.evaluation import Evaluator
from nag.algebra.system import PolynomialSystem
from nag.decomposition.final_checks import checked_witness_set
from nag.decomposition.irreducible import Class, irreducible_classes
from nag.decomposition.trace import is_linear, second_differences, smallest_linear_unions
from nag.witness.cutting import Equations
from nag.witness.fibres import Fibre, Tracker
from nag.witness.frame import Frame
from nag.witness.slices import random_rows
from nag.witness.witness import Status, WitnessSet

CIRCLE, LINE, CUBIC = "x^2 + y^2 - 1", "x - 2*y - 3", "y^2 - x^3 + x - 2"
UNION = f"({CIRCLE})*({LINE})"
TRACKER = Tracker()


def on(points: np.ndarray, equation: str) -> np.ndarray:
    """Which points lie on a curve."""
    return np.abs(Evaluator.of([curve(equation)], 2).values(points)[:, 0]) < 1e-9


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("equation", [CIRCLE, LINE, CUBIC, UNION])
def test_the_trace_of_a_whole_curve_is_linear_and_of_nothing_less(equation: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    rows = random_rows(rng, 1, 2)
    points = fibre(equation, rows[0])
    differences, counts = second_differences([points], rows, rng, TRACKER)
    assert differences.shape == (len(points), 2)
    assert counts.tracked == 2 * len(points) and counts.failed == 0
    assert is_linear(differences)
    whole = {len(points)} if equation != UNION else {1, 2, 3}
    for k in range(1, len(points)):
        subset = differences[:k]
        parts = on(points.x[:k], LINE).sum() if equation == UNION else 0
        expected = equation == UNION and k in whole and k - parts in (0, 2)
        assert is_linear(subset) == expected


def test_the_smallest_unions_that_add_up_to_zero_are_found() -> None:
    differences = np.array([[1, 2], [-1, -2], [3, 0], [0, 0], [-2, 1], [-1, -1], [5, 5]], complex)
    classes = [np.array([k]) for k in range(7)]
    # {3}; {0, 1}; {2, 4, 5}; the last one is in none.
    assert smallest_linear_unions(classes, differences) == [[3], [0, 1], [2, 4, 5]]
    pair = [np.array([0, 1]), np.array([2, 3]), np.array([4, 5]), np.array([6])]
    assert smallest_linear_unions(pair, differences) == [[0], [1, 2]]


def test_nothing_is_searched_among_too_many_classes() -> None:
    differences = np.zeros((13, 2))
    assert smallest_linear_unions([np.array([k]) for k in range(13)], differences) == []


@pytest.mark.parametrize("seed", range(3))
def test_points_fall_into_the_irreducible_curves(seed: int) -> None:
    rng = np.random.default_rng(seed)
    rows = random_rows(rng, 1, 2)
    points = fibre(f"{UNION}*({CUBIC})", rows[0])
    classes, _ = irreducible_classes([points], rows, rng, TRACKER)
    assert [c.reason for c in classes] == ["", "", ""]
    found = {frozenset(c.indices.tolist()) for c in classes}
    curves = {frozenset(np.flatnonzero(on(points.x, e)).tolist()) for e in (CIRCLE, LINE, CUBIC)}
    assert found == curves and sorted(map(len, found)) == [1, 2, 3]


def test_points_in_several_fibres_are_numbered_one_after_the_other() -> None:
    rng = np.random.default_rng(4)
    rows = random_rows(rng, 1, 2)
    fibres = [fibre(LINE, rows[0]), fibre(CUBIC, rows[0])]
    classes, _ = irreducible_classes(fibres, rows, rng, TRACKER)
    assert sorted(c.indices.tolist() for c in classes) == [[0], [1, 2, 3]]


def test_a_curve_with_a_point_missing_is_not_confirmed() -> None:
    rng = np.random.default_rng(5)
    rows = random_rows(rng, 1, 2)
    points = fibre(UNION, rows[0])
    circle = np.flatnonzero(on(points.x, CIRCLE))
    classes, _ = irreducible_classes([points.only(np.arange(3) != circle[0])], rows, rng, TRACKER)
    reasons = {tuple(c.indices.tolist()): c.reason for c in classes}
    assert sum(r == "" for r in reasons.values()) == 1
    assert any("points are missing" in r for r in reasons.values()) and len(reasons) == 2


def test_isolated_points_are_components_by_themselves() -> None:
    points = Fibre(fibre(CIRCLE, random_rows(np.random.default_rng(0), 1, 2)[0]).cut, 0, np.eye(2))
    empty = np.zeros((0, 3), dtype=complex)
    classes, counts = irreducible_classes([points], empty, np.random.default_rng(0), TRACKER)
    assert [c.indices.tolist() for c in classes] == [[0], [1]] and counts.tracked == 0


def checked(points: np.ndarray, equation: str, rows: np.ndarray, reason: str = "") -> WitnessSet:
    """What the final checks say of points as a component of a plane curve."""
    of = PolynomialSystem(("x", "y"), (curve(equation),))
    equations = Equations(of.polynomials, 2)
    own = Fibre(fibre(equation, rows[0]).cut, 1, points)
    made, _ = checked_witness_set(
        Class(np.arange(len(points)), reason),
        [own],
        rows,
        equations,
        equations.evaluator,
        Frame.of(eliminate_linear(of, graphs=False)),
        ((0,), (1,)),
        np.random.default_rng(0),
        TRACKER,
    )
    return made


ROWS = random_rows(np.random.default_rng(6), 1, 2)


def test_a_curve_passes_the_checks_with_its_multidegree() -> None:
    made = checked(points_on(curve(CUBIC), ROWS[0]), CUBIC, ROWS)
    assert made.status is Status.IRREDUCIBLE and made.note == ""
    assert (made.degree, made.multiplicity, made.corank) == (3, 1, 1)
    # Three points with y fixed, two with x fixed.
    assert made.multidegree.tolist() == [2, 3]
    assert made.residual < 1e-15 and made.accuracy < 1e-14
    assert np.abs(made.points @ made.slice.A.T - made.slice.b).max() < 1e-14


def test_points_are_sharpened_to_rounding() -> None:
    points = points_on(curve(CUBIC), ROWS[0])
    made = checked(points + 1e-8, CUBIC, ROWS)
    gaps = np.linalg.norm(made.points[:, None] - points[None], axis=2).min(axis=1)
    assert made.status is Status.IRREDUCIBLE and gaps.max() < 1e-13


def test_a_reason_for_doubt_is_kept() -> None:
    made = checked(points_on(curve(CUBIC), ROWS[0]), CUBIC, ROWS, "some reason")
    assert made.status is Status.UNDECIDED and made.note == "some reason"


def test_points_that_do_not_satisfy_all_equations_are_not_reported_as_a_component() -> None:
    of = PolynomialSystem(("x", "y"), (curve(CUBIC),))
    more = PolynomialSystem(("x", "y"), (curve(CUBIC), curve(CIRCLE)))
    rows, frame = ROWS, Frame.of(eliminate_linear(of, graphs=False))
    made, _ = checked_witness_set(
        Class(np.arange(3)),
        [fibre(CUBIC, rows[0])],
        rows,
        Equations(of.polynomials, 2),
        Evaluator.of(more.polynomials, 2),
        frame,
        (),
        np.random.default_rng(0),
        TRACKER,
    )
    assert made.status is Status.UNDECIDED and made.residual > 1e-3
    assert "a point does not satisfy all equations" in made.note
    assert replace(made, note="").degree == 3
