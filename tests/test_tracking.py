"""Paths end where they should, and every end is called what it is."""

from fractions import Fraction
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from evaluated import jacobian, patch, values
from oracle import track_one

from nag.algebra.polynomial import Polynomial
from nag.files.cases import read_case
from nag.solving.square_problem import SquareProblem
from nag.solving.start.choice import choose
from nag.tracking.compiled import compile_rows
from nag.tracking.homotopy import Homotopy, straight_line
from nag.tracking.jumps import collisions
from nag.tracking.known import KnownOfPaths
from nag.tracking.newton import refine
from nag.tracking.paths import PathStatus, Reason
from nag.tracking.projective import aligned_difference
from nag.tracking.settings import Settings, find_settings
from nag.tracking.starts import StartsByIndex
from nag.tracking.track import run_in_doubles, track

CASES = Path(__file__).parent.parent / "cases"


def total_degree(polynomials, seed):
    """Straight line from the roots of unity, and its start points."""
    x = Polynomial.variables(polynomials[0].n)
    degrees = [f.degree for f in polynomials]
    start = compile_rows([v**d - 1 for v, d in zip(x, degrees, strict=True)])
    gamma = np.exp(2j * np.pi * np.random.default_rng(seed).random())
    roots = [[np.exp(2j * np.pi * k / d) for k in range(d)] for d in degrees]
    starts = np.array([(1, *point) for point in product(*roots)])
    return straight_line(start, compile_rows(polynomials), gamma), starts


def katsura(n):
    x = Polynomial.variables(n + 1)
    zero = Polynomial.constant(n + 1, 0)
    u = {k: x[abs(k)] if abs(k) <= n else zero for k in range(-2 * n, 2 * n + 1)}
    window = range(-n, n + 1)
    rows = [sum((u[k] * u[m - k] for k in window), -u[m]) for m in range(n)]
    return [*rows, sum((u[k] for k in window), zero - 1)]


def cyclic(n):
    x = Polynomial.variables(n)
    one = Polynomial.constant(n, 1)
    rows = []
    for k in range(1, n + 1):
        total = Polynomial(n, {})
        for i in range(n if k < n else 1):
            term = one
            for j in range(k):
                term = term * x[(i + j) % n]
            total = total + term
        rows.append(total if k < n else total - 1)
    return rows


def distances(homotopy, first, second):
    return np.linalg.norm(aligned_difference(homotopy.groups, first, second), axis=1)


def test_ends_agree_with_a_tracker_in_plain_python():
    homotopy, starts = total_degree(katsura(3), 5)
    paths = track(homotopy, starts)
    ends = [track_one(homotopy, start) for start in starts]
    expected = np.array([end.point for end in ends])
    assert (paths.status == PathStatus.REGULAR).all()
    assert distances(homotopy, paths.points, expected).max() < 1e-12
    assert {end.winding for end in ends} == {1}


@pytest.mark.parametrize("seed", range(6))
def test_katsura_8_has_256_distinct_solutions(seed):
    homotopy, starts = total_degree(katsura(8), seed)
    paths = track(homotopy, starts)
    assert (paths.status == PathStatus.REGULAR).all()
    assert len(collisions(homotopy, paths)) == 0
    assert paths.accuracy.max() < 1e-15


@pytest.mark.parametrize("seed", range(6))
def test_cyclic_5_has_70_solutions_and_50_paths_to_infinity(seed):
    homotopy, starts = total_degree(cyclic(5), seed)
    paths = track(homotopy, starts)
    assert len(paths.where(PathStatus.REGULAR)) == 70
    assert len(paths.where(PathStatus.AT_INFINITY)) == 50
    assert len(collisions(homotopy, paths)) == 0


@pytest.mark.parametrize("m", [2, 3, 7, 16])
def test_a_root_of_multiplicity_m_has_winding_number_m(m):
    (x,) = Polynomial.variables(1)
    roots = np.exp(2j * np.pi * np.arange(m) / m)
    starts = np.stack([np.ones(m), roots], axis=1)
    target = compile_rows([(x - Fraction(1, 2)) ** m])
    paths = track(straight_line(compile_rows([x**m - 1]), target, np.exp(2j)), starts)
    assert (paths.status == PathStatus.SINGULAR).all()
    assert (paths.winding == m).all()
    error = np.abs(paths.points[:, 1] / paths.points[:, 0] - 0.5)
    assert error.max() < 1e-10
    assert (error <= 3 * paths.accuracy).all()


@pytest.mark.parametrize("seed", range(40))
def test_infinite_singular_and_regular_ends_are_told_apart(seed):
    x, y = Polynomial.variables(2)
    # (y = 0, x = 1) simple, one solution at infinity; two paths stay at points of the line y = -1.
    homotopy, starts = total_degree([(x - 1) * (y + 1), y * (y + 1)], seed)
    paths = track(homotopy, starts)
    regular = paths.where(PathStatus.REGULAR)
    affine = paths.points[regular, 1:] / paths.points[regular, :1]
    assert np.allclose(affine, [[1, 0]], atol=1e-14)
    others = np.setdiff1d(np.arange(4), regular)
    # The line y = -1 solves both equations: ends on it have a singular Jacobian.
    assert len(others) == 3
    assert np.abs(paths.points[others, 2] + paths.points[others, 0]).max() < 1e-10
    assert not (paths.status == PathStatus.FAILED).any()


def test_paths_beside_all_zeros_that_there_can_be_lead_to_infinity():
    x, y = Polynomial.variables(2)
    # Two zeros, which is the mixed volume.
    homotopy, starts = total_degree([x * y + x + 2, x * y - 3 * y + 5], 2)
    followed, counted = track(homotopy, starts), track(homotopy, starts, known=KnownOfPaths(most=2))
    assert (counted.status == followed.status).all()
    assert len(counted.where(PathStatus.REGULAR)) == 2
    infinite = counted.where(PathStatus.AT_INFINITY)
    assert (counted.points[infinite, 0] == 0).all()
    assert not np.isfinite(counted.accuracy[infinite]).any()
    # Where zeros seem to be missing, or there are too many, each path is followed.
    for most in (1, 3):
        other = track(homotopy, starts, known=KnownOfPaths(most=most))
        assert np.array_equal(other.points, followed.points)


def test_zeros_on_coordinate_hyperplanes_do_not_count_as_all():
    x, y = Polynomial.variables(2)
    homotopy, starts = total_degree([x * y, x * y + x + y - 1], 2)
    followed, counted = track(homotopy, starts), track(homotopy, starts, known=KnownOfPaths(most=2))
    assert len(followed.where(PathStatus.REGULAR)) == 2
    assert np.array_equal(counted.points, followed.points)


def test_distant_solutions_are_not_taken_for_points_at_infinity():
    x, y = Polynomial.variables(2)
    far = 10**6
    homotopy, starts = total_degree([(x - far) * (x - 1), (y - 3) * (y + far)], 1)
    paths = track(homotopy, starts)
    assert (paths.status == PathStatus.REGULAR).all()
    affine = paths.points[:, 1:] / paths.points[:, :1]
    expected = [[1, -far], [1, 3], [far, -far], [far, 3]]
    assert np.allclose(sorted(affine.real.round(6).tolist()), expected, rtol=1e-8)


def hypersurface_section(f, seed):
    """From a line's points to those on f = 0: f = u^d, with u growing out of zero."""
    n, d = f.n, f.degree
    generator = np.random.default_rng(seed)
    parts = generator.normal(size=(2, n, n + 1))
    slices = parts[0] + 1j * parts[1]
    u = Polynomial.variable(n + 1, n)
    rows = compile_rows([f.with_variables(n + 1, range(n)) - u**d])
    A0, A1 = np.zeros((2, n, n + 2), dtype=complex)
    A0[:-1, :-1] = slices[:-1]
    A0[-1, -1] = 1
    A1[-1] = [*(slices[-1] * np.exp(2j * np.pi * generator.random())), -1]
    point = np.linalg.svd(slices)[2][-1].conj()
    homogeneous = compile_rows([f])
    section = Homotopy(homogeneous, np.zeros((n - 1, n + 1)))
    value = values(section, point[None], 0)[0, 0] * homogeneous.scales[0]
    root = value ** (1 / d)
    starts = [[*point, root * np.exp(2j * np.pi * k / d)] for k in range(d)]
    return Homotopy(rows, A0, A1), np.array(starts)


@pytest.mark.parametrize("seed", range(4))
def test_paths_of_a_hypersurface_section_end_on_all_its_points(seed):
    x, y, z = Polynomial.variables(3)
    f = (x * x + y * y + z * z - 1) * (x - y) ** 2
    homotopy, starts = hypersurface_section(f, seed)
    paths = track(homotopy, starts)
    assert len(paths.where(PathStatus.REGULAR)) == 2
    singular = paths.where(PathStatus.SINGULAR)
    assert len(singular) == 2
    assert np.abs(paths.points[singular, 1] - paths.points[singular, 2]).max() < 1e-10
    assert np.abs(paths.points[:, -1]).max() < 1e-12
    assert distances(homotopy, paths.points[singular[:1]], paths.points[singular[1:]]) < 1e-10


def test_a_step_between_two_close_branch_points_does_not_lead_to_the_other_path():
    # The paths are x = +-sqrt((t - m)^2 + gap^2): a prediction from far away sees them cross at m.
    x, y = Polynomial.variables(2)
    gap = Fraction(1, 500)
    for m in (Fraction(k, 100) for k in range(5, 95, 3)):
        rows = compile_rows([x**2 - (y - m) ** 2 - gap**2])
        homotopy = Homotopy(rows, np.array([[0, 0, 1]]), np.array([[-1, 0, 0]]))
        far, near = (float((t - m) ** 2 + gap**2) ** 0.5 for t in (1, 0))
        paths = track(homotopy, np.array([[1, far, 1], [1, -far, 1]]))
        assert (paths.status == PathStatus.REGULAR).all()
        ends = paths.points[:, 1] / paths.points[:, 0]
        assert np.abs(ends - [near, -near]).max() < 1e-12


def test_a_correction_is_no_rounding_error_because_it_is_small():
    # The paths are x = c t^5 +- distance: corrections towards the middle do not contract.
    x, y = Polynomial.variables(2)
    distance = Fraction(1, 100_000)
    for c in (Fraction(k, 5) for k in range(1, 20)):
        rows = compile_rows([(x - c * y**5) ** 2 - distance**2])
        homotopy = Homotopy(rows, np.array([[0, 0, 1]]), np.array([[-1, 0, 0]]))
        starts = np.array([[1, c + distance, 1], [1, c - distance, 1]], float)
        # Ends that coincide would betray the jump.
        paths = track(homotopy, starts, distinct=False)
        assert (paths.status == PathStatus.REGULAR).all()
        ends = paths.points[:, 1] / paths.points[:, 0]
        assert np.abs(ends - [float(distance), -float(distance)]).max() < 1e-9


def test_results_do_not_depend_on_the_other_paths_nor_on_threads():
    homotopy, starts = total_degree(katsura(7), 2)
    settings = Settings(retries=0)
    whole = track(homotopy, starts, settings)
    threaded = track(homotopy, starts, settings, threads=2)
    some = np.array([100, 3, 77, 9, 50])
    part = track(homotopy, starts[some], settings)
    assert whole.balls.keys() == threaded.balls.keys()
    for name in set(whole.__dataclass_fields__) - {"balls", "branches"}:
        assert np.array_equal(getattr(whole, name), getattr(threaded, name)), name
        assert np.array_equal(getattr(whole, name)[some], getattr(part, name)), name


def test_a_step_that_was_rejected_is_not_tried_again():
    # A line that touches a circle at a zero of both: rounding errors let no path get closer.
    x, y = Polynomial.variables(2)
    for seed in (17, 47, 48):
        homotopy, starts = total_degree([x**2 + y**2 - 1, (y - 1) * (x + y - 3)], seed)
        raw = run_in_doubles(homotopy, homotopy.normalized(starts), find_settings("fast"), 1, False)
        assert raw.steps.max() < 200


def test_paths_with_many_branch_points_before_their_ends_reach_them_in_doubles():
    system = read_case(CASES / "hard" / "chemequ.toml").system
    rng = np.random.default_rng(0)
    problem = SquareProblem.of(system, system.polynomials, rng)
    begin, _ = choose(problem.target, "auto", system.groups, rng, 1)
    starts = begin.homotopy.normalized(begin.points)
    raw = run_in_doubles(begin.homotopy, starts, Settings(), 1, True)
    # There are 16 finite zeros; ends of the other paths are not regular.
    assert (raw.reason == Reason.NONE).sum() >= 15


def test_starts_by_index_are_the_same_whoever_asks():
    def make(index: np.ndarray) -> np.ndarray:
        return np.stack([index + 0.5j, index**2 + index.size], axis=1)

    starts = StartsByIndex((2500, 2), make)
    whole = np.asarray(starts)
    assert whole[:, 1].real.tolist() == [k**2 + (1024 if k < 2048 else 452) for k in range(2500)]
    rng = np.random.default_rng(3)
    for rows in (slice(1000, 1100), slice(-3, None), rng.permutation(2500)[:40], whole[:, 0] == 0):
        assert np.array_equal(starts[rows], whole[rows])
    assert starts[:0].shape == (0, 2)


def test_paths_do_not_depend_on_how_many_are_in_memory(monkeypatch):
    homotopy, starts = total_degree(katsura(6), 1)
    monkeypatch.setattr("nag.tracking.track.BLOCK", 5)
    parts = track(homotopy, starts)
    monkeypatch.setattr("nag.tracking.track.BLOCK", 1024)
    whole = track(homotopy, starts)
    for name, column in whole.arrays().items():
        assert np.array_equal(column, parts.arrays()[name]), name


def test_a_start_point_off_the_path_is_refused():
    homotopy, starts = total_degree(katsura(3), 0)
    starts = starts.copy()
    starts[2, 1:] = [9.0, -7.0, 3.0, 40.0]
    settings = Settings(retries=0)
    paths = track(homotopy, starts, settings)
    assert paths.status[2] == PathStatus.FAILED
    assert paths.reason[2] == Reason.START
    assert paths.failures == {Reason.START.text: 1}


def test_what_fails_in_doubles_is_followed_in_more_digits():
    (x,) = Polynomial.variables(1)
    homotopy, starts = total_degree([x**3 - 2], 0)
    paths = track(homotopy, starts, Settings(retries=0, max_steps=3))
    expected = track(homotopy, starts)
    assert (paths.status == PathStatus.REGULAR).all()
    assert (paths.precision == 32).all()
    assert sorted(paths.balls) == [0, 1, 2]
    assert distances(homotopy, paths.points, expected.points).max() < 1e-15


@pytest.mark.parametrize("power", [8, 20])
def test_simple_zeros_closer_than_doubles_can_tell_are_told_apart(power):
    (x,) = Polynomial.variables(1)
    gap = Fraction(1, 10**power)
    homotopy, starts = total_degree([(x - 1) * (x - 1 - gap) * (x + 2)], 1)
    paths = track(homotopy, starts, Settings(evidence=60))
    assert (paths.status == PathStatus.REGULAR).all()
    assert len(collisions(homotopy, paths)) == 0
    roots = []
    for ball in paths.balls.values():
        (zero, zero_im), (one, one_im) = ball.fractions()
        roots.append((one * zero + one_im * zero_im) / (zero**2 + zero_im**2))
    close = sorted(r for r in roots if r > 0)
    assert len(close) == 2
    assert abs(close[1] - close[0] - gap) < gap * Fraction(1, 10**6)


def test_ends_do_not_depend_on_the_paths_followed_beside_them():
    homotopy, starts = total_degree(cyclic(5), 4)
    settings = Settings(retries=0)
    whole = track(homotopy, starts, settings)
    some = np.array([100, 3, 77, 9, 50, 51, 14, 0, 5])
    part = track(homotopy, starts[some], settings)
    assert (whole.precision > 16).all()
    assert np.array_equal(whole.points[some], part.points)
    assert np.array_equal(whole.status[some], part.status)


def test_refined_points_are_right_to_the_last_digit():
    # Two roots 1e-5 apart: residuals in double would leave 1e-11.
    (x,) = Polynomial.variables(1)
    roots = [Fraction(1, 3), Fraction(1, 3) + Fraction(1, 10**5)]
    rows = compile_rows([(x - roots[0]) * (x - roots[1])])
    found = refine(rows, None, np.array([[1, 1 / 3 + 1e-9]]))
    assert abs(found.points[0, 1] / found.points[0, 0] - 1 / 3) < 3e-16
    assert found.error[0] < 1e-15
    assert found.moved[0] > 1e-10


def test_singular_values_are_those_of_the_jacobian():
    homotopy, starts = total_degree(katsura(4), 0)
    points = homotopy.normalized(starts)
    found = refine(homotopy, None, points, t=1.0, iterations=0)
    rows = np.concatenate([jacobian(homotopy, points, 1.0), patch(homotopy, points)], axis=1)
    exact = np.linalg.svd(rows, compute_uv=False)
    assert np.allclose(found.before, exact[:, -1], rtol=0.2)
    assert np.allclose(found.size, np.linalg.norm(exact, axis=1), rtol=1e-12)


def test_wrong_shapes_and_names_are_refused():
    homotopy, starts = total_degree(katsura(2), 0)
    with pytest.raises(ValueError, match="not \\(paths, 4\\)"):
        track(homotopy, starts[:, 1:])
    with pytest.raises(ValueError, match="no settings 'brave'"):
        track(homotopy, starts, "brave")
    with pytest.raises(ValueError, match="do not make 4 rows"):
        Homotopy(homotopy.rows, np.ones((1, 4)))
    assert len(track(homotopy, starts[:0])) == 0
