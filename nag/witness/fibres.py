"""Fibres: points of a pure-dimensional set on a slice, with the square system that cuts them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction

import numpy as np

from nag.algebra.number import Number
from nag.numerics.coincidence import coincident
from nag.numerics.read_only import fixed_array, fixed_mapping
from nag.numerics.zero_values import ON
from nag.tracking.homotopy import Homotopy, norms
from nag.tracking.paths import Ball, Paths, PathStatus
from nag.tracking.run import Run
from nag.tracking.track import track
from nag.witness.close_points import (
    WORDS,
    Fine,
    affine_fine,
    chosen,
    close_pairs,
    distance,
    rated,
)
from nag.witness.cutting import (
    MOST_DEFLATIONS,
    Cut,
    Equations,
    find_cut,
    is_end,
    regular_on,
    sharpen,
)
from nag.witness.slices import balance_rows, even_rows, padded
from nag.witness.witness import PathCounts

# Newton's constant of points that are close, over their inverse distance.
STEEPER = 2.0


@dataclass(frozen=True, eq=False)
class Fibre:
    """Points of dimension ``dimension`` sets that ``cut`` cuts regularly on a common slice.

    Attributes:
        points: complex, shape ``(P, n + aux)``, affine.
        fine: more digits of points that are close to others, by their indices.
    """

    cut: Cut
    dimension: int
    points: np.ndarray
    fine: Mapping[int, Fine] = field(default_factory=dict)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Fibre):
            return NotImplemented
        return (
            self.cut.polynomials == other.cut.polynomials
            and self.cut.n == other.cut.n
            and self.dimension == other.dimension
            and np.array_equal(self.points, other.points)
            and self.fine == other.fine
        )

    @property
    def x(self) -> np.ndarray:
        """The points without the unknowns that deflation added, shape ``(P, n)``."""
        return self.points[:, : self.cut.n]

    @property
    def sizes(self) -> np.ndarray:
        """Sizes of the homogeneous coordinates ``(1, x)`` of the set, shape ``(1 + n,)``."""
        return np.ldexp(1.0, np.concatenate([[0], self.cut.powers[: self.cut.n]]))

    def __len__(self) -> int:
        return len(self.points)

    @property
    def fixed(self) -> Fibre:
        """The same, read-only, as it stands in a result."""
        points, fine = fixed_array(self.points), fixed_mapping(self.fine)
        if points is self.points and fine is self.fine:
            return self
        return Fibre(self.cut, self.dimension, points, fine)

    def lifted(self, x: np.ndarray) -> np.ndarray:
        """A point with values of the added unknowns, to start Newton's method from.

        Where the cut does not keep how it was found, the unknowns are solved for, those that each
        step of deflation added being linear in its equations.
        """
        n = self.cut.n
        if self.cut.levels or not self.cut.aux:
            return self.cut.lift(x)
        z = np.concatenate([x, self.points[np.linalg.norm(self.x - x, axis=1).argmin(), n:]])
        for _ in range(MOST_DEFLATIONS):
            slopes, values = (
                self.cut.evaluator.jacobian(z)[:, n:],
                self.cut.evaluator.values(z[None]),
            )
            z[n:] -= np.linalg.lstsq(slopes, values[0], rcond=None)[0]
        return z

    def only(self, mask: np.ndarray) -> Fibre:
        """The fibre's points where ``mask`` holds."""
        fine = chosen(self.fine, np.flatnonzero(mask)) if self.fine else self.fine
        return Fibre(self.cut, self.dimension, self.points[mask], fine)


@dataclass(frozen=True, eq=False)
class Moved:
    """The ends of a fibre's points after its slice moved.

    Attributes:
        points: affine ends, shape ``(P, n + aux)``; not meaningful where ``finite`` is False.
        finite: whether the path ended at a finite point.
        regular: whether it ended at a regular one.
        accuracy: estimated relative errors of the ends.
        fine: more digits of regular ends that are close to others, by their indices.
    """

    points: np.ndarray
    finite: np.ndarray
    regular: np.ndarray
    failed: np.ndarray
    accuracy: np.ndarray
    counts: PathCounts = field(default=PathCounts())
    fine: Mapping[int, Fine] = field(default_factory=dict)

    def without(self, indices: Iterable[int]) -> Moved:
        """The ends but for some."""
        kept = np.setdiff1d(np.arange(len(self.points)), list(indices))
        names = ("points", "finite", "regular", "failed", "accuracy")
        arrays = {name: getattr(self, name)[kept] for name in names}
        return replace(self, **arrays, fine=chosen(self.fine, kept))

    def fibre(self, cut: Cut, dimension: int, indices: Sequence[int]) -> Fibre:
        """Some of the ends."""
        return Fibre(cut, dimension, self.points[indices], chosen(self.fine, indices))


def homogeneous(points: np.ndarray) -> np.ndarray:
    """Affine points as homogeneous ones of norm one."""
    result = np.ones((len(points), 1 + points.shape[1]), dtype=np.complex128)
    result[:, 1:] = points
    return result / norms(result)[:, None]


def affine(points: np.ndarray) -> np.ndarray:
    """Homogeneous points as affine ones; points at infinity become large."""
    first = points[:, :1]
    return points[:, 1:] / np.where(first == 0, 1e-300, first)


def ends_of_paths(paths: Paths, keep: int | None = None) -> Moved:
    """The ends of ``paths`` as affine points, the first ``keep`` coordinates of them."""
    # NumPy takes long to compare with members of an enumeration.
    regular = paths.status == int(PathStatus.REGULAR)
    finite = regular | (paths.status == int(PathStatus.SINGULAR))
    accuracy = np.asarray(paths.accuracy)
    infinite = paths.status == int(PathStatus.AT_INFINITY)
    failed = ~finite & ~infinite
    points = affine(paths.points)
    points = points if keep is None else points[:, :keep]
    counts = PathCounts(len(finite), int(failed.sum()), int(infinite.sum()))
    fine = _fine(paths, points, regular, finite & ~regular) if paths.balls else {}
    return Moved(points, finite, regular, failed, accuracy, counts, fine)


def _fine(
    paths: Paths, points: np.ndarray, regular: np.ndarray, singular: np.ndarray
) -> dict[int, Fine]:
    """The digits of regular ends in balls that are close to others, regular or singular ones."""
    own = [i for i in paths.balls if regular[i]]
    known = np.array(sorted({*own, *np.flatnonzero(singular).tolist()}), dtype=int)
    found: dict[int, Fine] = {}
    for pair in close_pairs(points[known]):
        ends = [int(known[k]) for k in pair]
        if not regular[ends].any():
            continue
        first, second = (
            found.get(i)
            or (
                affine_fine(_words(paths.balls[i]), 1.0).first(points.shape[1])
                if regular[i]
                else Fine.of_doubles(points[i])
            )
            for i in ends
        )
        size = 1 + float(np.linalg.norm(points[ends[0]]))
        apart = max(distance(points[ends[0]], first, points[ends[1]], second), 1e-300)
        for i, each in zip(ends, (first, second), strict=True):
            if regular[i]:
                found[i] = Fine(each.words, max(each.curvature, STEEPER * size / apart))
    return found


def _words(ball: Ball) -> np.ndarray:
    leading = ball.centre[..., :WORDS]
    return np.pad(leading, ((0, 0), (0, 0), (0, WORDS - leading.shape[-1])))


def move(
    fibres: Sequence[Fibre],
    source: np.ndarray,
    target: np.ndarray,
    gamma: complex,
    run: Run,
    *,
    endgame: bool = False,
    through: Sequence[Number] = (),
    sizes: np.ndarray | None = None,
) -> list[Moved]:
    """Move the slice of a set from the rows ``source`` to ``target``: the ends of each fibre.

    All rows turn with the same ``gamma``: only then do all points of a fibre, and all fibres of a
    set, move as one. Paths are tracked in coordinates in which those of the set are comparable: a
    point's largest coordinates hide what Newton's method does to the others, and a generic slice
    cuts by them alone; with lengths of 1e-8 beside angles one path in five failed. Scales are
    powers of two, so that nothing is rounded.

    Args:
        through: an exact point that the target passes through. Where sheets cross, a slice that is
            rounded beside the crossing meets them in as many points as near to each other.
        sizes: those of a fibre of the set that rows are to be of comparable norms in, where not all
            of its fibres are moved at once, and nearby; else those of the first.
    """
    if not fibres:
        return []
    alone = sizes is None
    sizes = fibres[0].sizes if sizes is None else sizes
    first, last = even_rows(source, sizes), even_rows(target, sizes)
    if alone:
        n = first.shape[1] - 1
        last = balance_rows(first, last, np.vstack([fibre.points[:, :n] for fibre in fibres]))
    return [_move_scaled(fibre, first, last, gamma, run, endgame, through) for fibre in fibres]


def _move_scaled(
    fibre: Fibre,
    source: np.ndarray,
    target: np.ndarray,
    gamma: complex,
    run: Run,
    endgame: bool,
    through: Sequence[Number],
) -> Moved:
    """The ends of a fibre, tracked in coordinates of comparable sizes."""
    powers = fibre.cut.powers
    if not powers.any():
        return _track(fibre, source, target, gamma, run, endgame, through)
    units = np.ldexp(1.0, np.concatenate([[0], powers]))[: target.shape[1]]
    scaled = source * units, target * units
    own = Fibre(fibre.cut.scaled, fibre.dimension, fibre.points * np.ldexp(1.0, -powers))
    own = replace(own, fine=_scale_points(fibre.fine, -powers, own.cut, scaled[0]))
    there = [x * Fraction(2) ** -int(k) for x, k in zip(through, powers, strict=False)]
    ends = _track(own, *scaled, gamma, run, endgame, there)
    finite = np.where(ends.finite[:, None], ends.points, 0.0)
    fine = _scale_points(ends.fine, powers, fibre.cut, target)
    return replace(ends, points=finite * np.ldexp(1.0, powers), fine=fine)


def _scale_points(
    fine: Mapping[int, Fine], powers: np.ndarray, cut: Cut, rows: np.ndarray
) -> dict[int, Fine]:
    """Points in coordinates that are two to the ``powers`` as large; Newton's constant is others.

    There the points are zeros of ``cut`` on the slice ``rows``.
    """
    words = {i: np.ldexp(each.words, powers[:, None, None]) for i, each in fine.items()}
    return {i: rated(cut.polynomials, rows, replace(fine[i], words=w)) for i, w in words.items()}


def _track(
    fibre: Fibre,
    source: np.ndarray,
    target: np.ndarray,
    gamma: complex,
    run: Run,
    endgame: bool,
    through: Sequence[Number],
) -> Moved:
    """The ends of a fibre, tracked in its own coordinates."""
    if fibre.fine:
        return _track_apart(fibre, source, target, gamma, run, endgame, through)
    columns = 1 + fibre.cut.n + fibre.cut.aux
    if len(through):
        from nag.tracking.close_paths import moving_rows

        ends = padded(source, columns), padded(target, columns)
        homotopy = moving_rows(fibre.cut.rows, *ends, gamma, through)
    else:
        a0, a1 = padded(target, columns), padded(gamma * source - target, columns)
        homotopy = Homotopy(fibre.cut.rows, a0, a1)
    paths = track(
        homotopy,
        homogeneous(fibre.points),
        settings=run.settings,
        threads=run.threads,
        endgame=endgame,
    )
    return ends_of_paths(paths)


def _track_apart(
    fibre: Fibre,
    source: np.ndarray,
    target: np.ndarray,
    gamma: complex,
    run: Run,
    endgame: bool,
    through: Sequence[Number],
) -> Moved:
    """`_track` where some points are close to others: their paths are tracked in more digits."""
    from nag.tracking.close_paths import moving_rows

    indices = np.array(sorted(fibre.fine))
    plain = np.setdiff1d(np.arange(len(fibre)), indices)
    rest = replace(fibre, points=fibre.points[plain], fine={})
    columns = 1 + fibre.cut.n + fibre.cut.aux
    rows = padded(source, columns), padded(target, columns)
    starts = [fibre.fine[i] for i in indices]
    homotopy = moving_rows(fibre.cut.rows, *rows, gamma, through)
    close = track_close_points(homotopy, starts, fibre.cut, target, run, endgame)
    others = _track(rest, source, target, gamma, run, endgame, through)
    return joined({0: plain, 1: indices}, (others, close))


def track_close_points(
    homotopy: Homotopy,
    starts: Sequence[Fine],
    cut: Cut,
    rows: np.ndarray,
    run: Run,
    endgame: bool,
) -> Moved:
    """Where paths end that start at points that are close to others.

    Their ends are zeros of ``cut`` on the slice ``rows``; further coordinates are left out.
    """
    from nag.tracking.close_paths import track_close

    paths = track_close(
        homotopy,
        np.array([start.homogeneous for start in starts]),
        np.array([start.curvature for start in starts]),
        run.settings,
        run.threads,
        endgame=endgame,
    )
    close, total = ends_of_paths(replace(paths, balls={}), keep=cut.n + cut.aux), cut.n + cut.aux
    fine = {
        i: rated(cut.polynomials, rows, affine_fine(_words(paths.balls[i]), 1.0).first(total))
        for i in np.flatnonzero(close.regular).tolist()
    }
    return replace(close, fine=fine)


def joined(places: Mapping[int, np.ndarray], parts: Sequence[Moved]) -> Moved:
    """Ends of several parts in one: those of part ``k`` at ``places[k]``."""
    count = sum(map(len, places.values()))
    arrays = {}
    for name in ("points", "finite", "regular", "failed", "accuracy"):
        pieces = [getattr(part, name) for part in parts]
        whole = np.zeros((count, *pieces[0].shape[1:]), dtype=pieces[0].dtype)
        for k, piece in enumerate(pieces):
            whole[places[k]] = piece
        arrays[name] = whole
    fine = {int(places[k][i]): f for k, part in enumerate(parts) for i, f in part.fine.items()}
    return Moved(**arrays, counts=sum((p.counts for p in parts), PathCounts()), fine=fine)


def join_fibres(parts: Sequence[Fibre]) -> Fibre:
    """Points of several fibres of one cut in one."""
    fine, first = {}, 0
    for part in parts:
        fine |= {first + i: each for i, each in part.fine.items()}
        first += len(part)
    points = np.vstack([part.points for part in parts])
    return Fibre(parts[0].cut, parts[0].dimension, points, fine)


def move_regular(
    fibres: Sequence[Fibre],
    source: np.ndarray,
    target: np.ndarray,
    gamma: complex,
    run: Run,
) -> tuple[list[Fibre] | None, PathCounts]:
    """The fibres on another generic slice, or None if a path did not arrive regularly."""
    counts, result = PathCounts(), []
    moves = move(fibres, source, target, gamma, run)
    for fibre, ends in zip(fibres, moves, strict=True):
        counts += ends.counts.judged_elsewhere
        if not ends.regular.all():
            return None, counts
        result.append(ends.fibre(fibre.cut, fibre.dimension, range(len(fibre))))
    return result, counts


def admit(
    x: np.ndarray,
    accuracy: float,
    fibres: list[Fibre],
    equations: Equations,
    rows: np.ndarray,
    rng: np.random.Generator,
    deflate: bool,
) -> bool:
    """Put a singular end into the fibre whose cut makes it regular; find a cut if there is none."""
    n = len(x)
    for i, fibre in enumerate(fibres):
        if fibre.cut.deflated != deflate:
            continue
        sharpened = sharpen(fibre.cut.evaluator, rows, fibre.lifted(x))
        end = sharpened.z[:n]
        if (
            sharpened.converged
            and is_end(x, accuracy, end)
            and regular_on(fibre.cut.evaluator, rows, sharpened)
            and equations.evaluator.residuals(end[None]).max(initial=0.0) < ON
        ):
            known = np.vstack([other.x for other in fibres])
            if not coincident(known, end, sharpened.step).any():
                points = np.vstack([fibre.points, sharpened.z])
                fibres[i] = replace(fibre, points=points)
            return True
    found = find_cut(equations, rows, x, accuracy, rng, deflate)
    if found is None:
        return False
    cut, z = found
    fibres.append(Fibre(cut, len(rows), z[None]))
    return True
