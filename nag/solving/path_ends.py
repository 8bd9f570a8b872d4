"""The ends of all paths, sorted: isolated solutions, points on components, open questions.

The zeros of equations with real coefficients come in conjugate pairs, which paths of complex
homotopies reach apart from each other. A regular end whose conjugate no path has reached therefore
says where a lost path must have led: of a simple zero, exactly one path ends there.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.polynomial import Polynomial
from nag.numerics.array_table import map_rows, take_rows
from nag.numerics.coincidence import (
    PointMap,
    SortedPoints,
    clusters,
    conjugates_present,
    point_orbit,
    radius_about,
)
from nag.numerics.doubles import MULTIPLE
from nag.numerics.singular_point import Place, SingularEnd
from nag.numerics.zero_values import ON, vanishes_at, vanishes_at_point
from nag.solving.end_judgements import EndJudgements
from nag.solving.isolated_zero import (
    IsolatedZero,
    IsolatedZeros,
    affine_point,
    which_are_real,
)
from nag.solving.solutions import LargerSets, Solutions
from nag.solving.square_problem import SquareProblem
from nag.solving.start.target import StartSystem
from nag.text.table import count_text
from nag.tracking import blocks
from nag.tracking.ends.inclusion import prove_end
from nag.tracking.ends.terms import Terms
from nag.tracking.paths import Ball, Paths, PathStatus
from nag.tracking.projective import coinciding_pairs

# Decides: Values, beside their terms, of ends that are no zeros, however badly they are known.
NEARLY = 1e-5
# Decides: Homogenising coordinates of ends at infinity, beside what is proved of them.
INFINITE = 2e-12
# Singular ends from which on it pays to look for symmetries.
FEW_SINGULAR = 8


@dataclass(frozen=True, eq=False)
class SortedEnds:
    """The end points of all paths, sorted; coordinates are those of the original variables.

    ``close``: the paths to ends that may be several zeros close together. ``isolated``: the
    isolated zeros of all equations in the scaled variables, those included that ``nonzero`` leaves
    out. ``larger``: ends on sets of positive dimension. ``unclear``: what notes say of ends that
    are no such zeros, or may not be; ``notes``: all else.
    """

    solutions: Solutions
    excluded: Solutions
    notes: tuple[str, ...]
    larger: LargerSets
    undecided: np.ndarray
    unclear: tuple[str, ...]
    close: np.ndarray
    isolated: IsolatedZeros

    @cached_property
    def zeros(self) -> int:
        """The number of isolated zeros, by multiplicity."""
        return int(self.isolated.multiplicity.sum())


@dataclass(frozen=True, eq=False)
class _Zeros:
    """End points that are zeros, in the scaled variables, with the indices of their paths.

    ``find_maps``: finds symmetries of the equations, which carry zeros to zeros as conjugation
    does; it is called where there is something to be spared.
    """

    path: np.ndarray
    points: np.ndarray
    accuracy: np.ndarray
    residual: np.ndarray
    regular: np.ndarray
    find_maps: Callable[[], tuple[PointMap, ...]] = tuple

    def regular_indices(self) -> np.ndarray:
        """Indices of the regular ends, which are distinct, as the tracker has seen."""
        return np.flatnonzero(self.regular)

    def groups(self) -> list[np.ndarray]:
        """The other ends, those at one point each."""
        several = np.flatnonzero(~self.regular)
        if not len(several):
            return []
        found = clusters(self.points[several], self.accuracy[several])
        return [several[group] for group in found]

    @cached_property
    def sorted_points(self) -> SortedPoints:
        """The points, to be asked for by where they are."""
        return SortedPoints.of(self.points)

    def count_near(self, groups: Sequence[np.ndarray]) -> np.ndarray:
        """How many ends are anywhere near those of each group, with them, shape ``(P,)``; else 0.

        No isolated zero there is of larger multiplicity, if each is the end of as many paths.
        """
        counts = np.zeros(len(self.path), dtype=np.int64)
        for group in groups:
            x, error = self.points[group[0]], float(self.accuracy[group].max())
            radius = radius_about(x, error)
            near = self.sorted_points.near(x, radius)
            counts[group] = np.sum(np.linalg.norm(self.points[near] - x, axis=1) <= radius)
        return counts

    def find_image(self, i: int, among: Collection[int]) -> int | None:
        """The first of some ends, by their indices, that symmetries carry a singular one to."""
        if self.regular[i] or not among:
            return None
        for image in point_orbit(self.points[i], self.find_maps())[1:]:
            same = self.sorted_points.coincident(image, float(self.accuracy[i]))
            known = next((k for k in same.tolist() if k in among), None)
            if known is not None:
                return known
        return None


@dataclass(frozen=True, eq=False)
class _EndPlace:
    """Where an end lies; None where it is no solution at all.

    ``isolated``: the isolated zeros that it stands for; ``close``: whether it may be several
    solutions close together; ``excluded``: of a set of positive dimension, whether something that
    must not vanish does so on all of it.
    """

    place: Place | None
    isolated: tuple[IsolatedZero, ...] = ()
    close: bool = False
    excluded: bool | None = False


def sort_ends(
    problem: SquareProblem,
    begin: StartSystem,
    paths: Paths,
    rng: np.random.Generator,
    finite: bool = False,
) -> SortedEnds:
    """What the ends of all paths are.

    Args:
        finite: whether only finite sets are of interest: nothing is judged after the first end
            on a set of positive dimension that is not excluded, and a note says so.
    """
    n = problem.system.n
    evaluator = Evaluator.of(problem.equations, n)
    zeros, lost = _select_zeros(problem, begin, paths, evaluator)
    if np.count_nonzero(~zeros.regular) > FEW_SINGULAR:
        zeros = replace(zeros, find_maps=lambda: problem.symmetry_maps)
    rough = problem.on_one_side(lost)
    roughly = "is a zero" if rough == 1 else "are zeros"
    ends = f"{count_text(rough, 'end point')} {roughly} of the equations only roughly"
    unclear = [ends] if lost else []
    undecided: list[np.ndarray] = []
    sets: dict[int, bool | None] = {}
    close: list[int] = []
    each = problem.added or problem.squared
    regular = zeros.regular_indices()
    known = _list_regular(begin, zeros, regular[:0] if each else regular, paths)
    isolated: list[IsolatedZero] = []
    groups = [*zeros.regular_indices()[:, None], *zeros.groups()] if each else zeros.groups()
    limits = np.array([path in paths.branches for path in zeros.path.tolist()], dtype=bool)
    whole = begin.complete and not problem.squared
    most = np.zeros_like(zeros.path)
    if whole and not problem.added:
        # A path that was lost may lead anywhere.
        most = zeros.count_near(groups) + lost + len(paths.where(PathStatus.FAILED))
        # Whether something vanishes on all of a set takes more than that an end lies on one.
        doubtful = np.flatnonzero(~zeros.regular)
        most[[i for i in doubtful if problem.may_be_excluded(zeros.points[i])]] = 0
    singular = EndJudgements(
        problem.equations,
        *(zeros.points, zeros.accuracy, limits, zeros.path, most),
        int(rng.integers(2**62)),
    )
    if blocks.in_blocks() and not finite:
        _judge_in_blocks(problem, zeros, singular, groups)
    judge = partial(_judge_end, problem, begin, zeros, paths, evaluator, singular)
    for group in groups:
        best, found = _judge_group(judge, zeros, group, whole, sets)
        multiplicity = sum(zero.multiplicity for zero in found.isolated)
        # Of a cluster with as many zeros as paths, each is the end of its own.
        met = found.place is Place.CLUSTER and whole and multiplicity == len(group)
        several = found.close or (bool(multiplicity) and whole and multiplicity != len(group))
        if met or found.place is Place.ISOLATED:
            isolated.extend(found.isolated)
            if whole and multiplicity != len(group):
                unclear.append(f"{len(group)} paths end at a zero of multiplicity {multiplicity}")
        elif found.place is Place.ON_COMPONENT:
            # Where equations were added, an end stands for one point of a component.
            sets |= dict.fromkeys([best] if problem.added else group.tolist(), found.excluded)
        elif found.place is not None:
            # That one of several zeros was met leaves open which the other paths met.
            undecided.extend(zeros.points[group])
        if several:
            close.extend(zeros.path[group].tolist())
        if finite and found.place is Place.ON_COMPONENT and not found.excluded:
            unclear.append("the solution set is not seen to be finite; other ends were left out")
            break
    if undecided:
        open_ = problem.on_one_side(len(undecided))
        may_be = "may or may not be isolated solutions, or several that are close together"
        if open_ == 1:
            may_be = "may or may not be an isolated solution, or several that are close together"
        unclear.append(f"{count_text(open_, 'end point')} {may_be}")
    original = problem.target.original
    every = known.join(isolated)
    return SortedEnds(
        *_solutions(problem, every),
        LargerSets.of(n, [(zeros.points[i], answer) for i, answer in sets.items()]).map_points(
            original
        ),
        original(np.array(undecided).reshape(-1, n)),
        tuple(unclear),
        np.array(sorted(close), dtype=np.int64),
        every,
    )


def add_zeros(
    problem: SquareProblem,
    ends: SortedEnds,
    zeros: Sequence[IsolatedZero],
    instead_of: Collection[int] = (),
) -> SortedEnds:
    """The same, with more zeros in the scaled variables, some of which replace known ones."""
    kept = np.ones(len(ends.isolated), dtype=bool)
    kept[list(instead_of)] = False
    isolated = ends.isolated.select_rows(kept).join(zeros)
    solutions, excluded, notes = _solutions(problem, isolated)
    return replace(ends, solutions=solutions, excluded=excluded, notes=notes, isolated=isolated)


def _select_zeros(
    problem: SquareProblem, begin: StartSystem, paths: Paths, evaluator: Evaluator
) -> tuple[_Zeros, int]:
    """The finite ends that are zeros, and the number of those that are only roughly."""
    finite = paths.where(PathStatus.REGULAR, PathStatus.SINGULAR)
    points = begin.affine(_rows(paths.points, finite))
    accuracy = paths.accuracy[finite]
    residual = _residuals(evaluator, points)
    regular = paths.status[finite] == PathStatus.REGULAR
    on = residual < np.maximum(ON, accuracy)
    lost = ~on
    if problem.squared:
        # Whether a regular zero is one of all equations is decided exactly, below.
        on |= regular & (residual < NEARLY)
        lost = ~on & (residual < NEARLY)
    rows = _rows(points, np.flatnonzero(on))
    kept = _Zeros(finite[on], rows, accuracy[on], residual[on], regular[on])
    return kept, int(lost.sum())


def _rows(points: np.ndarray, chosen: np.ndarray) -> np.ndarray:
    """Some rows by indices that increase; the array itself, which may be large, if all."""
    return points if len(chosen) == len(points) else take_rows(points, chosen)


def _list_regular(
    begin: StartSystem, zeros: _Zeros, chosen: np.ndarray, paths: Paths
) -> IsolatedZeros:
    """Regular ends as zeros of the equations; ``chosen``: indices that increase."""
    path = zeros.path[chosen]
    balls = [(k, paths.balls[i]) for k, i in enumerate(path.tolist()) if i in paths.balls]
    return IsolatedZeros(
        _rows(zeros.points, chosen),
        np.ones(len(chosen), dtype=np.int64),
        zeros.residual[chosen],
        zeros.accuracy[chosen],
        paths.condition[path],
        paths.precision[path].astype(np.int64),
        {k: affine_point(begin, ball) for k, ball in balls},
    )


def _judge_in_blocks(
    problem: SquareProblem,
    zeros: _Zeros,
    singular: EndJudgements,
    groups: Sequence[np.ndarray],
) -> None:
    """Judge the best ends of groups, but those that symmetries carry to ends on components."""
    best = [_best_of(zeros, group) for group in groups]
    if problem.added:
        best = [i for i in best if problem.may_be_excluded(zeros.points[i])]
    else:
        best = [i for i in best if not zeros.regular[i]]
    # A map, as it keeps their order and is asked in no time.
    first: dict[int, None] = {}
    later: list[tuple[int, int]] = []
    for i in best:
        known = zeros.find_image(i, first)
        if known is None:
            first[i] = None
        else:
            later.append((i, known))
    singular.judge_in_blocks(list(first))
    singular.judge_in_blocks(
        [i for i, k in later if singular.judge(k).place is not Place.ON_COMPONENT]
    )


def _judge_end(
    problem: SquareProblem,
    begin: StartSystem,
    zeros: _Zeros,
    paths: Paths,
    evaluator: Evaluator,
    singular: EndJudgements,
    i: int,
) -> _EndPlace:
    """Where the zero ``i`` lies."""
    point, accuracy, path = zeros.points[i], float(zeros.accuracy[i]), zeros.path[i]
    precision = int(paths.precision[path])
    if problem.added:
        if not problem.may_be_excluded(point):
            return _EndPlace(Place.ON_COMPONENT)
        end = singular.judge(i)
        return _EndPlace(Place.ON_COMPONENT, excluded=_is_excluded(problem, end))
    if zeros.regular[i]:
        solves = problem.solves(point) if problem.squared else True
        if solves is None:
            return _EndPlace(Place.UNDECIDED)
        if not solves:
            return _EndPlace(None)
        return _EndPlace(Place.ISOLATED, tuple(_list_regular(begin, zeros, np.array([i]), paths)))
    end = singular.judge(i)
    members = [end]
    if end.place is Place.CLUSTER:
        near = zeros.sorted_points.coincident(end.point, max(accuracy, end.accuracy))
        met = zeros.regular[near]
        if end.dimension and met.sum() == sum(z.multiplicity for z in end.nearby):
            # All that is isolated there are ends of other paths.
            return _EndPlace(Place.ON_COMPONENT, excluded=_is_excluded(problem, end))
        members = [] if met.any() else list(end.nearby)
    isolated = tuple(
        IsolatedZero.of_end(z, residual, precision)
        for z, residual in zip(
            members, _residuals(evaluator, _points(members, len(point))), strict=True
        )
        if z.place is Place.ISOLATED
    )
    excluded = _is_excluded(problem, end) if end.place is Place.ON_COMPONENT else False
    return _EndPlace(end.place, isolated, end.place is Place.UNDECIDED, excluded)


def _is_excluded(problem: SquareProblem, end: SingularEnd) -> bool | None:
    """Whether something that must not vanish does so on all of the set that an end lies on.

    None where that is not known.
    """
    if not problem.may_be_excluded(end.point):
        return False
    if end.place is Place.ISOLATED:
        # On random equations that cut the set it is a generic point of it.
        answers = [vanishes_at(end, g) for g in problem.nonzero]
        return True if True in answers else None if None in answers else False
    return _is_set_excluded(problem.nonzero, end) if end.place is Place.ON_COMPONENT else None


def _is_set_excluded(nonzero: Sequence[Polynomial], end: SingularEnd) -> bool | None:
    """Whether one of some polynomials vanishes on all of the set through a zero that lies on one.

    None where that is not known.
    """
    near = [g for g in nonzero if vanishes_at(end, g) is not False]
    if not near:
        return False
    if end.beside is None:
        return None
    answers = [vanishes_at_point(g, end.beside) for g in near]
    return True if True in answers else None if None in answers else False


def _judge_group(
    judge: Callable[[int], _EndPlace],
    zeros: _Zeros,
    group: np.ndarray,
    whole: bool,
    sets: Mapping[int, bool | None],
) -> tuple[int, _EndPlace]:
    """The best known one of ends at one place, and where it lies.

    Ends count as at one place within many times their errors. Where more lead to an isolated zero
    than its multiplicity explains, others beside it are looked for, which digits tell from it.

    Args:
        judge: where an end lies.
        whole: whether as many paths lead to a zero as its multiplicity is.
        sets: ends that lie on components, and whether these are excluded. So do those that
            symmetries carry them to.
    """
    best = _best_of(zeros, group)
    known = zeros.find_image(best, sets)
    if known is not None:
        return best, _EndPlace(Place.ON_COMPONENT, excluded=sets[known])
    found = judge(best)
    if not whole or found.place is not Place.ISOLATED:
        return best, found
    isolated = list(found.isolated)
    for i in group[group != best].tolist():
        if sum(zero.multiplicity for zero in isolated) >= len(group):
            break
        other = judge(i)
        if other.place is Place.ISOLATED:
            isolated += [z for z in other.isolated if all(map(z.is_apart_from, isolated))]
    return best, replace(found, isolated=tuple(isolated))


def _best_of(zeros: _Zeros, group: np.ndarray) -> int:
    """The best known one of ends at one place."""
    return int(group[np.argmin(zeros.accuracy[group])])


def _points(ends: Sequence[SingularEnd], n: int) -> np.ndarray:
    """The points of ends, shape ``(k, n)``."""
    return np.array([end.point for end in ends]).reshape(len(ends), n)


def _solutions(
    problem: SquareProblem, isolated: IsolatedZeros
) -> tuple[Solutions, Solutions, tuple[str, ...]]:
    """The solutions where nothing vanishes that must not, and those that were left out; notes."""
    points, accuracy = isolated.points, isolated.accuracy.copy()
    real = which_are_real(points, accuracy, isolated.fine)
    # Where the unit is known for i, conjugates solve another system.
    paired = problem.system.imaginary or bool(
        conjugates_present(points, accuracy, isolated.multiplicity, real)
    )
    answers: list[bool | None] = []
    if problem.nonzero:
        answers = [problem.is_excluded(s) for s in isolated]
    original, radii = problem.target.original(points), {}
    for i, fine in isolated.fine.items():
        # Coordinates that are small where errors were estimated may be the largest of these.
        x = original[i]
        own = np.linalg.norm(problem.target.original_radii(x, fine.radii))
        accuracy[i] = max(accuracy[i], own / (1 + np.linalg.norm(x)))
        radii[i] = problem.target.original_radii(x, isolated[i].radii)
    solutions = Solutions(
        original,
        isolated.multiplicity,
        real,
        isolated.residual,
        accuracy + problem.target.rounding(points),
        isolated.condition,
        isolated.precision,
        radii,
    )
    kept, left_out = solutions, solutions.select_rows(slice(0))
    if True in answers or None in answers:
        kept, left_out = (
            solutions.select_rows(np.array([answer is wanted for answer in answers]))
            for wanted in (False, True)
        )
    notes = []
    if None in answers:
        open_ = problem.on_one_side(answers.count(None))
        notes.append(f"{count_text(open_, 'solution')} may be excluded")
    if not paired:
        notes.append("the conjugate of a solution is missing")
    return kept, left_out, tuple(notes)


def _residuals(evaluator: Evaluator, points: np.ndarray) -> np.ndarray:
    """The largest residual at each point."""
    return map_rows(lambda some: evaluator.residuals(some).max(axis=1, initial=0.0), points)


def list_doubts(begin: StartSystem, paths: Paths) -> list[str]:
    """What is left open of the paths that failed, and of those to infinity."""
    notes = []
    failed = len(paths.where(PathStatus.FAILED))
    if failed:
        causes = ", ".join(f"{k} because {why}" for why, k in paths.failures.items())
        notes.append(f"{failed} of {len(paths)} paths failed: {causes}")
    infinite = paths.where(PathStatus.AT_INFINITY)
    far = np.abs(paths.points[infinite][:, list(begin.homotopy.infinity)])
    error = np.minimum(paths.accuracy[infinite], MULTIPLE)
    unsure = int((far.min(axis=1, initial=np.inf) > np.maximum(INFINITE, error)).sum())
    if unsure:
        notes.append(f"{unsure} paths to infinity may end at solutions far out")
    return notes


def restore_conjugate_ends(begin: StartSystem, paths: Paths) -> Paths:
    """The paths, those that were lost with the missing conjugates of regular ends as theirs.

    They are left as they are unless as many conjugates are missing as paths were lost, each is
    apart from all known regular ends, and Krawczyk's test proves each a regular zero of the exact
    equations. Which lost path leads to which of them is not known, and does not matter.
    """
    lost = paths.where(PathStatus.FAILED)
    if not begin.complete or not len(lost):
        return paths
    missing = paths.select_rows(_find_unpaired(begin, paths)).conjugate()
    if len(missing) != len(lost) or not _prove_all(begin, missing):
        return paths
    return paths.track_again(lost, missing)


def _find_unpaired(begin: StartSystem, paths: Paths) -> np.ndarray:
    """Indices of the finite regular ends whose conjugates are no such ends."""
    regular = paths.where(PathStatus.REGULAR)
    count = len(regular)
    ends = paths.select_rows(regular)
    twice = Paths.concatenate([ends, ends.conjugate()])
    paired = np.zeros(count, dtype=bool)
    groups = begin.homotopy.groups
    for i, j in coinciding_pairs(groups, twice.points, twice.accuracy).tolist():
        if i < count <= j and twice.same(begin.homotopy, i, j):
            paired[j - count] = True
    return regular[~paired]


def _prove_all(begin: StartSystem, ends: Paths) -> bool:
    terms = Terms(begin.homotopy)
    for i, (x, accuracy) in enumerate(zip(ends.points, ends.accuracy.tolist(), strict=True)):
        ball = ends.balls.get(i)
        if ball is None:
            parts = np.stack([np.stack([x.real, x.imag], axis=1), np.zeros((len(x), 2))], axis=2)
            ball = Ball(parts, np.full(len(x), accuracy))
        if prove_end(terms, ball.centre, ball.radii) is None:
            return False
    return True
