"""Lost paths of real equations: the conjugates of other ends are theirs, if that is proved."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from systems import system

import nag
from nag.algebra.system import PolynomialSystem
from nag.files.cases import read_case
from nag.numerics.singular_point import Place
from nag.solving import path_ends
from nag.solving import solve as solving
from nag.solving.path_ends import restore_conjugate_ends
from nag.solving.square_problem import SquareProblem
from nag.solving.start.choice import choose
from nag.solving.start.target import StartSystem
from nag.tracking.paths import Paths, PathStatus, Reason
from nag.tracking.track import track

CUBICS = ("x^3 + 2*x*y - 3*y + 1", "y^3 - x^2 + 5*x + 2")


def tracked(given: PolynomialSystem, start: str = "total") -> tuple[StartSystem, Paths]:
    rng = np.random.default_rng(4)
    problem = SquareProblem.of(given, list(given.polynomials), rng)
    begin, _ = choose(problem.target, start, given.groups, rng, 1)
    return begin, track(begin.homotopy, begin.points, known=begin.known)


def lost(paths: Paths, *which: int) -> Paths:
    chosen = list(which)
    status, reason = paths.status.copy(), paths.reason.copy()
    points, accuracy = paths.points.copy(), paths.accuracy.copy()
    status[chosen], reason[chosen] = PathStatus.FAILED, Reason.ENDGAME
    points[chosen], accuracy[chosen] = points[0], np.inf
    balls = {i: ball for i, ball in paths.balls.items() if i not in which}
    return replace(
        paths, status=status, reason=reason, points=points, accuracy=accuracy, balls=balls
    )


def pairs(begin: StartSystem, paths: Paths) -> tuple[list[tuple[int, int]], list[int]]:
    """Conjugate pairs of ends, and the real ends."""
    regular = paths.where(PathStatus.REGULAR)
    x = begin.affine(paths.points[regular])
    near = regular[[int(np.abs(x - z.conj()).max(axis=1).argmin()) for z in x]].tolist()
    both = list(zip(regular.tolist(), near, strict=True))
    return [(i, j) for i, j in both if i < j], [i for i, j in both if i == j]


@pytest.mark.parametrize("start", ["total", "polyhedral", "monodromy", "multihomogeneous"])
def test_a_lost_path_leads_to_the_conjugate_that_is_missing(start: str) -> None:
    begin, paths = tracked(system("x y", *CUBICS), start)
    two, _ = pairs(begin, paths)
    for i, j in two:
        for gone in ((i,), (j,)):
            mended = restore_conjugate_ends(begin, lost(paths, *gone))
            assert np.array_equal(mended.status, paths.status)
            ends, wanted = (begin.affine(p.points[[i, j]]) for p in (mended, paths))
            assert ends == pytest.approx(wanted)
    # Which of several lost paths led to which end does not matter.
    several = [j for _, j in two]
    assert len(several) > 1
    mended = restore_conjugate_ends(begin, lost(paths, *several))
    regular = paths.where(PathStatus.REGULAR)
    found, wanted = (begin.affine(p.points[regular])[:, 0] for p in (mended, paths))
    assert np.poly(found) == pytest.approx(np.poly(wanted))


def test_what_no_conjugate_explains_stays_lost() -> None:
    begin, paths = tracked(system("x y", *CUBICS))
    two, real = pairs(begin, paths)
    (i, j), *_ = two
    # Both of a pair, a real one, and a real one beside one of a pair.
    for gone in ((i, j), (real[0],), (real[0], i)):
        missing = lost(paths, *gone)
        assert restore_conjugate_ends(begin, missing) is missing


def test_a_conjugate_that_is_no_zero_is_not_taken() -> None:
    begin, paths = tracked(system("x y", *CUBICS))
    (i, j), *_ = pairs(begin, paths)[0]
    moved = lost(paths, j)
    moved.points[i] = begin.homotopy.normalized(moved.points[[i]] * (1 + 1e-6j * np.arange(3)))
    assert restore_conjugate_ends(begin, moved) is moved


def test_conjugates_of_ends_in_more_digits_are_kept_in_these() -> None:
    # Two zeros at a distance of 1e-8, and their conjugates.
    given = system("x y", "((x^2 + 1)^2 - 10^-16)*(x - 3)", "y^2 - y - x")
    begin, paths = tracked(given)
    fine = [(i, j) for i, j in pairs(begin, paths)[0] if i in paths.balls]
    assert fine
    for i, j in fine:
        mended = restore_conjugate_ends(begin, lost(paths, j))
        assert np.array_equal(mended.balls[j].radii, mended.balls[i].radii)


def test_a_system_whose_paths_were_lost_is_solved(monkeypatch: pytest.MonkeyPatch) -> None:
    given = read_case("cases/benchmarks/cyclic-5.toml").system

    def losing(*args: object, **options: object) -> Paths:
        paths = track(*args, **options)
        regular = paths.where(PathStatus.REGULAR)
        x = paths.points[regular]
        away = [i for i, z in zip(regular, x, strict=True) if abs((z[1] / z[0]).imag) > 1e-6]
        return lost(paths, away[0])

    monkeypatch.setattr(solving, "track", losing)
    found = solving.solve(given, start="total")
    assert found.complete
    assert len(found.solutions) == 70


def test_zeros_are_counted_where_paths_were_lost_to_conjugates(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    given = system("x y", *CUBICS)

    def losing(*arguments: object, **options: object) -> Paths:
        paths = track(*arguments, **options)
        x = paths.points[:, 1] / paths.points[:, 0]
        return lost(paths, int(np.abs(x.imag).argmax()))

    monkeypatch.setattr(solving, "track", losing)
    found = solving.solve(given, start="total")
    assert found.complete and len(found.solutions) == 9
    assert found.reason.endswith("so many paths leave no more than 9")


def test_the_conjugate_of_a_singular_end_on_a_component_is_not_judged_again() -> None:
    on, other = np.array([1 + 2j, 3 - 1j]), np.array([1 + 2j, 3 - 1j + 1e-6])
    points = np.array([on.conj(), other.conj(), on.conj(), on])
    errors = np.full(4, 1e-15)
    zeros = path_ends._Zeros(
        np.arange(4), points, errors, errors, regular=np.array([False, False, True, False])
    )
    asked = []

    def judge(i: int) -> path_ends._EndPlace:
        asked.append(i)
        return path_ends._EndPlace(Place.UNDECIDED)

    places = [
        path_ends._judge_group(judge, zeros, np.array([i]), True, {3: None})[1].place
        for i in range(3)
    ]
    assert places == [Place.ON_COMPONENT, Place.UNDECIDED, Place.UNDECIDED]
    assert asked == [1, 2]


def test_bounds_for_one_value_of_the_unit_and_paths_for_both_are_told_apart() -> None:
    equations = ["x^2*y - 2*x*z*I + 3/2*x*z - 3", "5/2*x*I + y^2 + y*z - I - 1"]
    equations.append("x*y + z^2 - 1/4*z + 1/3*I")
    reason = nag.solve(equations, start="total", imaginary="I").reason
    assert "24 paths, for both values of I; " in reason
    assert reason.endswith("no more than 10 for each value of I")
