"""Points of plane curves: traces, irreducible classes, and the checks before they are reported."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from cuts import curve, fibre, points_on
from systems import system

from nag.algebra.evaluation import Evaluator
from nag.algebra.polynomial import Polynomial
from nag.decomposition import monodromy, splitting
from nag.decomposition.decompose import decompose
from nag.decomposition.final_checks import Examined, check_class
from nag.decomposition.monodromy import LoopEnds, run_loop
from nag.decomposition.reduction import Reduction
from nag.decomposition.splitting import Class, split_points
from nag.decomposition.trace import EVIDENCE, Trace
from nag.files.cases import read_case
from nag.numerics.coincidence import join_labels
from nag.tracking.run import Run
from nag.witness.fibres import Fibre
from nag.witness.points import Points
from nag.witness.slices import random_rows
from nag.witness.witness import Status, WitnessSet

CIRCLE, LINE, CUBIC = "x^2 + y^2 - 1", "x - 2*y - 3", "y^2 - x^3 + x - 2"
UNION = f"({CIRCLE})*({LINE})"
TRACKER = Run()
CASES = Path(__file__).parent.parent / "cases"
ROWS = random_rows(np.random.default_rng(6), 1, 2)


def on(points: np.ndarray, equation: str) -> np.ndarray:
    """Which points lie on a curve."""
    return np.abs(Evaluator.of([curve(equation)], 2).values(points)[:, 0]) < 1e-9


def on_line(equation: str, rng: np.random.Generator) -> Points:
    """All points of a reduced plane curve on a random line."""
    rows = random_rows(rng, 1, 2)
    return Points.of([fibre(equation, rows[0])])


def trace_of(points: Points, rng: np.random.Generator) -> Trace:
    found, counts = Trace.of(points, EVIDENCE, rng).carry(points, range(len(points)), TRACKER)
    assert found is not None and counts.tracked == 2 * len(points) and counts.failed == 0
    return found


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("equation", [CIRCLE, LINE, CUBIC, UNION])
def test_the_trace_of_a_whole_curve_is_linear_and_of_nothing_less(equation: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    points = on_line(equation, rng)
    trace, whole = trace_of(points, rng), len(points)
    on_curves = [on(points.x, e) for e in (CIRCLE, LINE, CUBIC)]
    for size in range(1, whole + 1):
        for chosen in combinations(range(whole), size):
            taken = np.isin(np.arange(whole), chosen)
            expected = all(taken[curve].all() or not taken[curve].any() for curve in on_curves)
            assert trace.linear(points, chosen)[0] is expected


def test_the_smallest_unions_of_classes_with_linear_traces_are_found() -> None:
    rng = np.random.default_rng(3)
    points = on_line(UNION, rng)
    trace = trace_of(points, rng)
    circle, line = np.flatnonzero(on(points.x, CIRCLE)), np.flatnonzero(on(points.x, LINE))
    classes = [circle[:1], line, circle[1:]]
    assert trace.smallest_unions(points, classes)[0] == [[0, 2], [1]]
    assert trace.smallest_unions(points, classes[:2])[0] == [[1]]


@pytest.mark.parametrize("seed", range(3))
def test_points_fall_into_the_irreducible_curves(seed: int) -> None:
    rng = np.random.default_rng(seed)
    points = on_line(f"{UNION}*({CUBIC})", rng)
    found = split_points(points, EVIDENCE, rng, TRACKER)
    assert [c.reason for c in found.classes] == ["", "", ""]
    classes = {frozenset(c.indices.tolist()) for c in found.classes}
    curves = {frozenset(np.flatnonzero(on(points.x, e)).tolist()) for e in (CIRCLE, LINE, CUBIC)}
    assert classes == curves and sorted(map(len, classes)) == [1, 2, 3]
    assert [int(found.labels[c.indices].min()) for c in found.classes] == [
        min(c.indices) for c in found.classes
    ]


def test_few_points_fall_into_components_without_loops(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(splitting, "run_loop", None)
    rng = np.random.default_rng(4)
    points = on_line(f"{UNION}*({CUBIC})*(x + y - 7)*(y^4 - x - 2)", rng)
    found = split_points(points, EVIDENCE, rng, TRACKER)
    assert sorted(len(c.indices) for c in found.classes) == [1, 1, 2, 3, 4]
    assert found.counts.tracked == 2 * len(points)


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(("first", "second"), [(CIRCLE, LINE), (CIRCLE, CUBIC), (LINE, CUBIC)])
def test_what_a_loop_joined_wrongly_is_taken_back(
    monkeypatch: pytest.MonkeyPatch, first: str, second: str, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    points = on_line(f"{UNION}*({CUBIC})", rng)
    swapped = [int(np.flatnonzero(on(points.x, e))[0]) for e in (first, second)]
    tracked = []

    def swaps_first(*arguments):
        found, counts = run_loop(*arguments)
        tracked.append(found)
        if len(tracked) > 1:
            return found, counts
        places = np.arange(len(points))
        places[swapped] = swapped[::-1]
        return LoopEnds(np.arange(len(points)), points, places), counts

    monkeypatch.setattr(splitting, "run_loop", swaps_first)
    for name, most in (("FEW_CLASSES", 2), ("MOST_IN_LATTICE", 2), ("MOST_CLASSES", 3)):
        monkeypatch.setattr(splitting, name, most)
    found = split_points(points, EVIDENCE, rng, TRACKER)
    curves = {frozenset(np.flatnonzero(on(points.x, e)).tolist()) for e in (CIRCLE, LINE, CUBIC)}
    assert {frozenset(c.indices.tolist()) for c in found.classes} == curves
    assert not any(c.reason for c in found.classes)
    assert found.discarded == 1 and len(tracked) > 1


def test_classes_are_what_pairs_join() -> None:
    rng = np.random.default_rng(2)
    assert join_labels(4, []).tolist() == [0, 1, 2, 3]
    for pairs in (rng.integers(0, 60, (2, 20, 2)), [np.column_stack([range(59), range(1, 60)])]):
        labels = join_labels(60, pairs)
        graph = np.eye(60, dtype=bool)
        graph[tuple(np.concatenate(pairs).T)] = True
        reached = np.linalg.matrix_power((graph | graph.T).astype(float), 60) > 0
        assert labels.tolist() == reached.argmax(axis=1).tolist()


def test_a_loop_whose_ends_are_no_permutation_joins_nothing() -> None:
    rng = np.random.default_rng(8)
    points = on_line(CUBIC, rng)
    ends = points.only([0, 1, 1])
    assert monodromy.ends_are_distinct(points, np.array([-1, -1, -1]))
    assert not monodromy.ends_are_distinct(ends, np.array([-1, -1, -1]))
    assert not monodromy.ends_are_distinct(ends, np.array([0, 1, 1]))
    assert monodromy.ends_are_distinct(ends, np.array([2, 1, -1]))


# Far from the origin 50 loops were needed, which took one path for another once in a hundred.
SHIFTS = (-14, 0.25, -187.5, 8.75, 30, -66, 120, 1.5, 93, -150.25, 77, 181, -3.5, 0)


@pytest.mark.parametrize("seed", range(2))
def test_components_far_from_the_origin_are_found_with_as_few_paths(seed: int) -> None:
    case = read_case(CASES / "rhombus-chain-2.toml")
    x = Polynomial.variables(case.system.n)
    forms = [v + Fraction(shift) for v, shift in zip(x, SHIFTS, strict=True)]
    moved = replace(
        case.system, polynomials=tuple(f.compose(forms) for f in case.system.polynomials)
    )
    near, far = decompose(case.system, seed=seed), decompose(moved, seed=seed)
    assert far.complete
    assert [(c.dimension, c.degree) for c in far.components] == [(2, 4)] * 9
    assert far.paths.tracked <= 1.1 * near.paths.tracked


def test_a_point_that_is_missing_is_found_by_loops() -> None:
    rng = np.random.default_rng(5)
    rows = random_rows(rng, 1, 2)
    whole = fibre(CUBIC, rows[0])
    less = Points.of([whole.only(np.arange(3) > 0)])
    found = split_points(less, EVIDENCE, rng, TRACKER)
    assert [(len(c.indices), c.reason) for c in found.classes] == [(3, "")]
    gaps = np.linalg.norm(found.points.x[:, None] - whole.x[None], axis=2)
    assert sorted(gaps.argmin(axis=1)) == [0, 1, 2] and gaps.min(axis=1).max() < 1e-12


def test_isolated_points_are_components_by_themselves() -> None:
    cut = fibre(CIRCLE, ROWS[0]).cut
    points = Points.of([Fibre(cut, np.zeros((0, 3), dtype=complex), np.eye(2))])
    found = split_points(points, EVIDENCE, np.random.default_rng(0), TRACKER)
    assert [c.indices.tolist() for c in found.classes] == [[0], [1]]
    assert found.counts.tracked == 0


def checked(points: np.ndarray, reduction: Reduction, reason: str = "") -> WitnessSet:
    """What the final checks say of points of the cubic as a component."""
    own = Points.of([Fibre(fibre(CUBIC, ROWS[0]).cut, ROWS, points)])
    found = Class(np.arange(len(points)), reason)
    rng = np.random.default_rng(0)
    examined = Examined.of(own, [found], reduction, rng)
    return check_class(found, examined, rng, TRACKER)[0]


POINTS = points_on(curve(CUBIC), ROWS[0])
REDUCTION = Reduction.of(system("x y", CUBIC, groups=((0,), (1,))))


def test_a_curve_passes_the_checks_with_its_multidegree() -> None:
    made = checked(POINTS, REDUCTION)
    assert made.status is Status.IRREDUCIBLE and made.note == ""
    assert (made.degree, made.multiplicity, made.corank) == (3, 1, 1)
    # Two points with x fixed, three with y fixed.
    assert made.multidegree.tolist() == [2, 3]
    assert made.residual < 1e-15 and made.accuracy < 1e-14
    assert np.abs(made.points @ made.slice.A.T - made.slice.b).max() < 1e-14


def test_points_are_sharpened_to_rounding() -> None:
    made = checked(POINTS + 1e-8, REDUCTION)
    gaps = np.linalg.norm(made.points[:, None] - POINTS[None], axis=2).min(axis=1)
    assert made.status is Status.IRREDUCIBLE and gaps.max() < 1e-13


def test_a_reason_for_doubt_is_kept() -> None:
    made = checked(POINTS, REDUCTION, "some reason")
    assert made.status is Status.UNDECIDED and made.note == "some reason"


def test_points_that_do_not_satisfy_all_equations_are_not_reported_as_a_component() -> None:
    made = checked(POINTS, Reduction.of(system("x y", CUBIC, CIRCLE)))
    assert made.status is Status.UNDECIDED and made.residual > 1e-3 and made.degree == 3
    assert "a point does not satisfy all equations" in made.note


@pytest.mark.parametrize("seed", [0, 1])
def test_points_that_bend_by_1e_50_are_no_lines(seed: int) -> None:
    # Two of the twenty points of an irreducible curve move along a line to 50 digits.
    texts = (
        "15619296875*x^3*y*w + 368050176*w^5 - 135837941100900*w^4 - 28308556765671875*w^3"
        " - 2211788000000000000*w^2 - 76799966530078125000*w - 1000000000000000000000",
        "x^4 - 160000*x^2*w^2 - 18000000000",
    )
    answer = decompose(system("x y w", *texts), seed=seed)
    assert answer.complete
    assert [(c.dimension, c.degree) for c in answer.components] == [(1, 20)]


# A ring of five turns and one of four, of lengths below 10; the turn in the first ring alone has a
# length of 1000, which no real assembly fits, and its points have sizes from 1 to 10^5.
FAR = """
3*c1 - 2*s1 + 2*c2 + 1000*c3 + 3*s3 + 3*c4 - 2*s4 + c5
3*s1 + 2*c1 + 2*s2 + 1000*s3 - 3*c3 + 3*s4 + 2*c4 + s5
3*c1 + 2*c2 - s2 + 3*c4 - 2*s4 + 3*c5 + s5 - 2
3*s1 + 2*s2 + c2 + 3*s4 + 2*c4 + 3*s5 - c5 - 1
"""


@pytest.mark.parametrize("seed", range(3))
def test_points_of_very_different_sizes_are_joined(seed: int) -> None:
    equations = [f"c{k}^2 + s{k}^2 - 1" for k in range(1, 6)] + FAR.split("\n")[1:-1]
    far = system(" ".join(f"c{k} s{k}" for k in range(1, 6)), *equations)
    (component,) = decompose(far, seed=seed).components
    assert component.status is Status.IRREDUCIBLE
    assert (component.dimension, component.degree) == (1, 20)
    sizes = np.abs(component.points).max(axis=1)
    assert sizes.max() > 100 * sizes.min()
