"""Fibres: points of a pure-dimensional set on a slice, with the square system that cuts them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Any

import numpy as np

from nag.algebra.fixed_mapping import fixed_mapping
from nag.algebra.number import Number
from nag.numerics.coincidence import coincident
from nag.numerics.digits import WORDS
from nag.numerics.read_only import fixed_array
from nag.numerics.zero_values import ON
from nag.text.json_text import pairs
from nag.tracking.homotopy import Homotopy, norms
from nag.tracking.paths import Ball, Paths, PathStatus
from nag.tracking.run import Run
from nag.tracking.track import track
from nag.witness.close_points import (
    PointInWords,
    affine_fine,
    close_pairs,
    distance,
    select_fine,
    with_newton_constant,
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
from nag.witness.slices import balance_rows, even_rows, pad_rows, rows_through, unit_complex
from nag.witness.witness import PathCounts

# Newton's constant of points that are close, over their inverse distance.
STEEPER = 2.0


@dataclass(frozen=True, eq=False)
class Fibre:
    """Points of pure-dimensional sets on a slice, which ``cut`` cuts regularly there.

    Attributes:
        rows: the slice, as rows on ``(1, x)``, perhaps with unknowns, shape ``(d, 1 + n)``.
        points: complex, shape ``(P, n + aux)``, affine.
        fine: more digits of points that are close to others, by their indices.
    """

    cut: Cut
    rows: np.ndarray
    points: np.ndarray
    fine: Mapping[int, PointInWords] = field(default_factory=dict)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Fibre):
            return NotImplemented
        return (
            self.cut.polynomials == other.cut.polynomials
            and self.cut.n == other.cut.n
            and np.array_equal(self.rows, other.rows)
            and np.array_equal(self.points, other.points)
            and self.fine == other.fine
        )

    def document(self, equations: int) -> dict[str, Any]:
        """How the points are cut, as a JSON object.

        Args:
            equations: the index of the cut among all that a document has.
        """
        found = {
            "equations": equations,
            "points": len(self),
            "unknowns": pairs(self.points[:, self.cut.n :]),
        }
        close = [{"point": i, **self.fine[i].document()} for i in sorted(self.fine)]
        return found | ({"close": close} if close else {})

    @property
    def dimension(self) -> int:
        """Dimension of the sets."""
        return len(self.rows)

    @property
    def x(self) -> np.ndarray:
        """The points without the unknowns that deflation added, shape ``(P, n)``."""
        return self.points[:, : self.cut.n]

    @property
    def sizes(self) -> np.ndarray:
        """Sizes of the homogeneous coordinates ``(1, x)`` of the set, shape ``(1 + n,)``."""
        return self.cut.sizes

    def __len__(self) -> int:
        return len(self.points)

    def fixed_on(self, rows: np.ndarray) -> Fibre:
        """The same, read-only, on a slice as it stands in a result."""
        points, fine = fixed_array(self.points), fixed_mapping(self.fine)
        if points is self.points and fine is self.fine and rows is self.rows:
            return self
        return Fibre(self.cut, rows, points, fine)

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

    def only(self, which: np.ndarray | Sequence[int]) -> Fibre:
        """Some of the points: at places, in this order, or where a mask holds."""
        places = np.arange(len(self))[which]
        fine = select_fine(self.fine, places) if self.fine else self.fine
        return replace(self, points=self.points[places], fine=fine)


def whole_space(flag: np.ndarray) -> Fibre:
    """The whole space, by its point on a flag of as many slices as variables."""
    n = len(flag)
    point = np.linalg.solve(flag[:, 1:], -flag[:, 0])
    return Fibre(Cut(n, 0, ()), flag, point[None])


@dataclass(frozen=True, eq=False)
class SliceEnds:
    """Ends of paths to a slice, which ``cut`` cuts regularly there where they are regular.

    Attributes:
        rows: the slice, as of a fibre.
        points: affine ends, shape ``(P, n + aux)``; not meaningful where ``finite`` is False.
        finite: whether the path ended at a finite point.
        regular: whether it ended at a regular one.
        accuracy: estimated relative errors of the ends.
        fine: more digits of regular ends that are close to others, by their indices.
    """

    cut: Cut
    rows: np.ndarray
    points: np.ndarray
    finite: np.ndarray
    regular: np.ndarray
    failed: np.ndarray
    accuracy: np.ndarray
    counts: PathCounts = field(default=PathCounts())
    fine: Mapping[int, PointInWords] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.points)

    @property
    def x(self) -> np.ndarray:
        """The ends without the unknowns that deflation added, shape ``(P, n)``."""
        return self.points[:, : self.cut.n]

    def without(self, indices: Iterable[int]) -> SliceEnds:
        """The ends but for some."""
        kept = np.setdiff1d(np.arange(len(self)), list(indices))
        names = ("points", "finite", "regular", "failed", "accuracy")
        arrays = {name: getattr(self, name)[kept] for name in names}
        return replace(self, **arrays, fine=select_fine(self.fine, kept))

    def fibre(self, indices: Sequence[int] | None = None) -> Fibre:
        """Some of the ends, or all."""
        if indices is None:
            indices = range(len(self))
        return Fibre(self.cut, self.rows, self.points[indices], select_fine(self.fine, indices))


def homogeneous(points: np.ndarray) -> np.ndarray:
    """Affine points as homogeneous ones of norm one."""
    result = np.ones((len(points), 1 + points.shape[1]), dtype=np.complex128)
    result[:, 1:] = points
    return result / norms(result)[:, None]


def affine(points: np.ndarray) -> np.ndarray:
    """Homogeneous points as affine ones; points at infinity become large."""
    first = points[:, :1]
    return points[:, 1:] / np.where(first == 0, 1e-300, first)


def ends_of_paths(paths: Paths, cut: Cut, rows: np.ndarray) -> SliceEnds:
    """The ends of ``paths`` as affine points, without unknowns that ``cut`` does not know."""
    # NumPy takes long to compare with members of an enumeration.
    regular = paths.status == int(PathStatus.REGULAR)
    finite = regular | (paths.status == int(PathStatus.SINGULAR))
    accuracy = np.asarray(paths.accuracy)
    infinite = paths.status == int(PathStatus.AT_INFINITY)
    failed = ~finite & ~infinite
    points = affine(paths.points)[:, : cut.n + cut.aux]
    counts = PathCounts(len(finite), int(failed.sum()), int(infinite.sum()))
    fine = _fine(paths, points, regular, finite & ~regular) if paths.balls else {}
    return SliceEnds(cut, rows, points, finite, regular, failed, accuracy, counts, fine)


def _fine(
    paths: Paths, points: np.ndarray, regular: np.ndarray, singular: np.ndarray
) -> dict[int, PointInWords]:
    """The digits of regular ends in balls that are close to others, regular or singular ones."""
    own = [i for i in paths.balls if regular[i]]
    known = np.array(sorted({*own, *np.flatnonzero(singular).tolist()}), dtype=int)
    found: dict[int, PointInWords] = {}
    for pair in close_pairs(points[known]):
        ends = [int(known[k]) for k in pair]
        if not regular[ends].any():
            continue
        first, second = (
            found.get(i)
            or (
                affine_fine(_words(paths.balls[i]), 1.0).first(points.shape[1])
                if regular[i]
                else PointInWords.of_doubles(points[i])
            )
            for i in ends
        )
        size = 1 + float(np.linalg.norm(points[ends[0]]))
        apart = max(distance(points[ends[0]], first, points[ends[1]], second), 1e-300)
        for i, each in zip(ends, (first, second), strict=True):
            if regular[i]:
                found[i] = PointInWords(each.words, max(each.curvature, STEEPER * size / apart))
    return found


def _words(ball: Ball) -> np.ndarray:
    leading = ball.centre[..., :WORDS]
    return np.pad(leading, ((0, 0), (0, 0), (0, WORDS - leading.shape[-1])))


def move(
    fibres: Sequence[Fibre],
    target: np.ndarray,
    gamma: complex,
    run: Run,
    *,
    endgame: bool = False,
    through: Sequence[Number] = (),
    sizes: np.ndarray | None = None,
) -> list[SliceEnds]:
    """Move the slice of a set to the rows ``target``: the ends of each fibre.

    All rows turn with the same ``gamma``: only then do all points of a fibre, and all fibres of a
    set, move as one. Paths are tracked in coordinates in which those of the set are comparable: a
    point's largest coordinates hide what Newton's method does to the others, and a generic slice
    cuts by them alone; with lengths of 1e-8 beside angles one path in five failed. Scales are
    powers of two, so that nothing is rounded.

    Args:
        fibres: on one slice.
        through: an exact point that the target passes through. Where sheets cross, a slice that is
            rounded beside the crossing meets them in as many points as near to each other.
        sizes: those of a fibre of the set that rows are to be of comparable norms in, where not all
            of its fibres are moved at once, and nearby; else those of the first.
    """
    if not fibres:
        return []
    alone = sizes is None
    sizes = fibres[0].sizes if sizes is None else sizes
    first, last = even_rows(fibres[0].rows, sizes), even_rows(target, sizes)
    if alone:
        n = first.shape[1] - 1
        last = balance_rows(first, last, np.vstack([fibre.points[:, :n] for fibre in fibres]))
    motion = _Motion(last, gamma, run, endgame, through)
    ends = [motion.carry(replace(fibre, rows=first)) for fibre in fibres]
    return [replace(each, rows=target) for each in ends]


@dataclass(frozen=True, eq=False)
class _Motion:
    """Where a slice moves to, and how, see `move`."""

    target: np.ndarray
    gamma: complex
    run: Run
    endgame: bool
    through: Sequence[Number]

    def carry(self, fibre: Fibre) -> SliceEnds:
        """The ends of a fibre, tracked in coordinates of comparable sizes."""
        powers = fibre.cut.powers
        if not powers.any():
            return self.track(fibre)
        units = np.ldexp(1.0, np.concatenate([[0], powers]))[: self.target.shape[1]]
        cut, rows = fibre.cut.scaled, fibre.rows * units
        fine = _scale_points(fibre.fine, -powers, cut, rows)
        own = Fibre(cut, rows, fibre.points * np.ldexp(1.0, -powers), fine)
        through = [x * Fraction(2) ** -int(k) for x, k in zip(self.through, powers, strict=False)]
        ends = replace(self, target=self.target * units, through=through).track(own)
        finite = np.where(ends.finite[:, None], ends.points, 0.0)
        fine = _scale_points(ends.fine, powers, fibre.cut, self.target)
        return replace(ends, cut=fibre.cut, points=finite * np.ldexp(1.0, powers), fine=fine)

    def track(self, fibre: Fibre) -> SliceEnds:
        """The ends of a fibre, tracked in its own coordinates.

        Paths of points that are close to others are tracked in more digits.
        """
        if not fibre.fine:
            paths = track(
                self._homotopy(fibre),
                homogeneous(fibre.points),
                settings=self.run.settings,
                threads=self.run.threads,
                endgame=self.endgame,
            )
            return ends_of_paths(paths, fibre.cut, self.target)
        indices = np.array(sorted(fibre.fine))
        plain = np.setdiff1d(np.arange(len(fibre)), indices)
        rest = replace(fibre, points=fibre.points[plain], fine={})
        starts = [fibre.fine[i] for i in indices]
        homotopy = self._homotopy(fibre)
        close = track_close_points(homotopy, starts, fibre.cut, self.target, self.run, self.endgame)
        return join_ends({0: plain, 1: indices}, (self.track(rest), close))

    def _homotopy(self, fibre: Fibre) -> Homotopy:
        columns = 1 + fibre.cut.n + fibre.cut.aux
        target = pad_rows(self.target, columns)
        if fibre.fine or len(self.through):
            from nag.tracking.close_paths import moving_rows

            source = pad_rows(fibre.rows, columns)
            return moving_rows(fibre.cut.rows, source, target, self.gamma, self.through)
        step = pad_rows(self.gamma * fibre.rows - self.target, columns)
        return Homotopy(fibre.cut.rows, target, step)


def _scale_points(
    fine: Mapping[int, PointInWords], powers: np.ndarray, cut: Cut, rows: np.ndarray
) -> dict[int, PointInWords]:
    """Points in coordinates that are two to the ``powers`` as large; Newton's constant is others.

    There the points are zeros of ``cut`` on the slice ``rows``.
    """
    words = {i: np.ldexp(each.words, powers[:, None, None]) for i, each in fine.items()}
    return {
        i: with_newton_constant(cut.polynomials, rows, replace(fine[i], words=w))
        for i, w in words.items()
    }


def track_close_points(
    homotopy: Homotopy,
    starts: Sequence[PointInWords],
    cut: Cut,
    rows: np.ndarray,
    run: Run,
    endgame: bool,
) -> SliceEnds:
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
    close, total = ends_of_paths(replace(paths, balls={}), cut, rows), cut.n + cut.aux
    fine = {
        i: with_newton_constant(
            cut.polynomials, rows, affine_fine(_words(paths.balls[i]), 1.0).first(total)
        )
        for i in np.flatnonzero(close.regular).tolist()
    }
    return replace(close, fine=fine)


def join_ends(places: Mapping[int, np.ndarray], parts: Sequence[SliceEnds]) -> SliceEnds:
    """Ends of several parts on one slice in one: those of part ``k`` at ``places[k]``."""
    count = sum(map(len, places.values()))
    arrays = {}
    for name in ("points", "finite", "regular", "failed", "accuracy"):
        pieces = [getattr(part, name) for part in parts]
        whole = np.zeros((count, *pieces[0].shape[1:]), dtype=pieces[0].dtype)
        for k, piece in enumerate(pieces):
            whole[places[k]] = piece
        arrays[name] = whole
    fine = {int(places[k][i]): f for k, part in enumerate(parts) for i, f in part.fine.items()}
    counts = sum((p.counts for p in parts), PathCounts())
    return replace(parts[0], **arrays, counts=counts, fine=fine)


def join_fibres(parts: Sequence[Fibre]) -> Fibre:
    """Points of several fibres of one cut on one slice in one."""
    fine, first = {}, 0
    for part in parts:
        fine |= {first + i: each for i, each in part.fine.items()}
        first += len(part)
    points = np.vstack([part.points for part in parts])
    return replace(parts[0], points=points, fine=fine)


def move_through(
    point: np.ndarray,
    fibres: Sequence[Fibre],
    rng: np.random.Generator,
    run: Run,
    exact: Sequence[Number] = (),
) -> list[SliceEnds]:
    """Where the points of fibres get to when their slice moves to a generic one through a point.

    Args:
        exact: the point's coordinates, where they are known.
    """
    first = fibres[0]
    target, gamma = rows_through(rng, first.dimension, point, first.sizes), unit_complex(rng)
    return move(fibres, target, complex(gamma), run, endgame=True, through=exact)


def move_regular(
    fibres: Sequence[Fibre], target: np.ndarray, gamma: complex, run: Run
) -> tuple[list[Fibre] | None, PathCounts]:
    """The fibres on another generic slice, or None if a path did not arrive regularly."""
    counts, result = PathCounts(), []
    for ends in move(fibres, target, gamma, run):
        counts += ends.counts.judged_elsewhere
        if not ends.regular.all():
            return None, counts
        result.append(ends.fibre())
    return result, counts


def admit_end(
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
    fibres.append(Fibre(cut, rows, z[None]))
    return True
