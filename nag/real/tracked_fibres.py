"""Fibres of a curve over the values of a linear form, by paths in doubles, one by one.

The value is a point of a pencil on the curve's closure: paths pass where a group of variables is
infinite as anywhere else. Over values that are not special all points of a fibre are regular. Next
to a special value, at which the critical points are known, those points of the fibre come together
in one of them whose distances from it shrink with the distance from the value; those of the others
do not. All of them are analytic functions of the value as far as the next special one, complex ones
included, so that distances beside that say how much they may change.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import flint
import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.numerics.coincidence import HIT, MISS, SAFETY
from nag.numerics.double_newton import find_zeros
from nag.numerics.doubles import ROUNDED
from nag.real.closure import ProjectiveClosure
from nag.real.critical_points import CriticalPoints
from nag.real.critical_values import ONE_VALUE, UnclearDigitsError
from nag.real.fibre_table import FibreError, Point
from nag.real.real_fibres import SpecialFibre, find_clusters, join_middles
from nag.tracking.compiled import CompiledRows, compile_rows
from nag.tracking.homotopy import Homotopy
from nag.tracking.paths import Paths, PathStatus
from nag.tracking.run import Run
from nag.tracking.track import track
from nag.witness.fibres import Fibre, move_regular
from nag.witness.slices import unit_complex

# Digits of points, for those who ask how near they may be to each other.
DIGITS = 14
# Distances from a special value, beside that of the next, at which its fibre is looked at.
BESIDE = (1e-3, 1e-5, 1e-7, 1e-9)
# Decides: Part of its distance from a critical point that a point still has a hundred times nearer
# to the value, where it comes there, with up to six others.
COMES = 0.55
# Decides: The same where it does not; what falls between is looked at nearer.
STAYS = 0.9
# Decides: Errors of a special value beside the distance from it.
KNOWN = 1e-3


@dataclass(frozen=True, eq=False)
class TrackedFibres:
    """All fibres of a curve's closure over a pencil, by paths in a product of projective spaces.

    Attributes:
        closure: of the curve, with the pencil.
        rows: equations, one fewer than variables, and those that make up the pencil.
        start: the point of the pencil that paths begin over, complex, shape ``(2,)``.
        points: normalised ones over it, shape ``(d, size)``.
        form: the linear form, real, shape ``(n,)``.
        radius: size of the values.
        gamma: which way the pencil's point moves, of absolute value 1.
        run: how paths are tracked.
    """

    closure: ProjectiveClosure
    rows: CompiledRows
    start: np.ndarray
    points: np.ndarray
    form: np.ndarray
    radius: float
    gamma: complex
    run: Run
    digits: int = DIGITS

    @classmethod
    def of(
        cls,
        fibres: Sequence[Fibre],
        square: Sequence[Polynomial],
        system: PolynomialSystem,
        form: np.ndarray,
        radius: float,
        rng: np.random.Generator,
        run: Run,
    ) -> TrackedFibres:
        """The fibres of a curve.

        Args:
            fibres: its points on one slice.
            square: equations, one fewer than variables, regular at general points of the curve.
            form: of which values are asked for.

        Raises:
            FibreError: if a path fails.
        """
        value = radius * complex(unit_complex(rng))
        row = np.concatenate([[-value], form])[None].astype(complex)
        begun, _ = move_regular(fibres, row, complex(unit_complex(rng)), run)
        if begun is None:
            raise FibreError("a path to another fibre failed")
        closure = ProjectiveClosure.of(square, system, form)
        own = compile_rows(closure.equations, homogenize=False, groups=closure.coordinates)
        *curve, ((_, first),), ((_, second),) = own.parts
        parts = (*curve, ((1, first), (2, second)))
        rows = CompiledRows(own.N, parts, own.groups, (), own.degrees[:-1])
        points = closure.homogeneous(np.vstack([fibre.x for fibre in begun]))
        gamma = complex(unit_complex(rng))
        return cls(closure, rows, np.array([value, 1.0]), points, form, radius, gamma, run)

    def over(self, pencil: np.ndarray, endgame: bool = False) -> Paths:
        """Where the points get to when that of the pencil moves to another one.

        Args:
            pencil: a point ``(p : q)``, shape ``(2,)``.
            endgame: whether points may come together there.
        """
        (p, q), (p0, q0) = pencil, self.start * self.gamma
        factors = (1.0, 0.0), (-p, p - p0), (q, q0 - q)
        homotopy = Homotopy(self.rows, factors=factors)
        settings, threads = self.run.settings, self.run.threads
        return track(homotopy, self.points, settings, threads, endgame=endgame)

    def _regular_over(self, t: complex) -> tuple[np.ndarray, np.ndarray]:
        """Normalised points over a value that is not special, and their relative errors.

        Raises:
            FibreError: if a path fails.
        """
        paths = self.over(np.array([t, 1.0]) / max(1.0, abs(t)))
        if len(paths.where(PathStatus.REGULAR)) < len(paths):
            raise FibreError("a path to another fibre failed")
        return self.closure.normalise(paths.points), np.maximum(paths.accuracy, ROUNDED)

    def points_over(self, t: complex) -> np.ndarray:
        """Normalised points over a value that is not special, shape ``(d, size)``.

        Raises:
            FibreError: if a path fails.
        """
        return self._regular_over(t)[0]

    def at(self, t: flint.arb | flint.acb) -> list[Point]:
        """The points over a value that is not special, to the digits of doubles.

        Raises:
            FibreError: if a path fails.
            UnclearDigitsError: if these do not tell points from each other.
        """
        points, errors = self._regular_over(complex(flint.acb(t)))
        apart = self.closure.distances(points, points) + 2 * np.eye(len(points))
        if (apart.min(axis=1) < SAFETY * errors).any():
            raise UnclearDigitsError("points over a value are too close to each other for doubles")
        return [[flint.acb(complex(c)) for c in x] for x in self.closure.affine(points)]

    def is_real(self, t: float) -> bool:
        """Whether the fibre over a real value is its own conjugate, as that of such a curve is.

        Raises:
            FibreError: if a path fails.
        """
        points, errors = self._regular_over(t)
        nearest = self.closure.distances(points.conj(), points).min(axis=1)
        return bool((nearest < SAFETY * errors.max()).all())

    def over_infinity(self) -> SpecialFibre:
        """The fibre over infinity.

        Raises:
            FibreError: if a path fails.
            UnclearDigitsError: if it is not clear which points come together there.
        """
        paths = self.over(np.array([1.0, 0.0]), endgame=True)
        if len(paths.where(PathStatus.REGULAR, PathStatus.SINGULAR)) < len(paths):
            raise FibreError("a path to the fibre over infinity failed")
        points = self.closure.normalise(paths.points)
        together = find_clusters(self.closure.distances(points, points), HIT, MISS)
        middles = [points[own[0]] for own in together]
        pencil = np.array([1.0, 0.0])
        return join_middles(self.closure, pencil, middles, list(map(len, together)))


def special_fibres_of(
    fibres: TrackedFibres, closure: ProjectiveClosure, critical: CriticalPoints
) -> list[SpecialFibre]:
    """The fibres over all real values at which real points are critical, ascending.

    Raises:
        UnclearDigitsError: if it is not clear which points come together there.
        FibreError: if a path fails.
    """
    values = critical.points @ fibres.form
    order = [int(k) for k in np.argsort(values.real) if critical.real[k]]
    together: list[list[int]] = []
    for k in order:
        near = together and values[k].real - values[together[-1][-1]].real
        if together and near <= ONE_VALUE * fibres.radius:
            together[-1].append(k)
        else:
            together.append([k])
    return [_special_fibre(fibres, closure, critical, own, values) for own in together]


def ordinary_fibre(fibres: TrackedFibres, closure: ProjectiveClosure, t: float) -> SpecialFibre:
    """The fibre over a value that is not special.

    Raises:
        FibreError: if a path fails.
    """
    points = fibres.points_over(t)
    return join_middles(closure, np.array([t, 1.0]), points, [1] * len(points))


def _special_fibre(
    fibres: TrackedFibres,
    closure: ProjectiveClosure,
    critical: CriticalPoints,
    own: Sequence[int],
    values: np.ndarray,
) -> SpecialFibre:
    """The fibre over a value at which these of the critical points lie."""
    t = float(np.mean(values[list(own)].real))
    others = np.delete(np.abs(values - t), list(own))
    next_ = float(others.min(initial=fibres.radius))
    size = max(float(np.linalg.norm(critical.points[k])) for k in own)
    off = max(float(critical.errors[k]) for k in own) * size * float(np.linalg.norm(fibres.form))
    centres = closure.homogeneous(critical.points[list(own)].real)
    seen = None
    for far, near in pairwise(BESIDE):
        if off > KNOWN * near * next_:
            break
        further = seen or _seen_from(fibres, closure, centres, t + far * next_)
        seen = _seen_from(fibres, closure, centres, t + near * next_)
        members = [_members(a, b) for a, b in zip(further[1], seen[1], strict=True)]
        if any(which is None for which in members):
            continue
        taken = [int(i) for which in members if which is not None for i in which]
        sheets = [0 if which is None else len(which) for which in members]
        if len(set(taken)) < len(taken):
            continue
        most = [1 + int(critical.multiplicities[k]) for k in own]
        if any(not 1 <= m <= top for m, top in zip(sheets, most, strict=True)):
            raise UnclearDigitsError("more points come together than a critical point is worth")
        rest = np.delete(seen[0], taken, axis=0)
        points = np.vstack([centres, _bring_to_value(closure, rest, t)])
        return join_middles(closure, np.array([t, 1.0]), points, [*sheets, *([1] * len(rest))])
    raise UnclearDigitsError("it is not clear which points come together")


def _seen_from(
    fibres: TrackedFibres, closure: ProjectiveClosure, centres: np.ndarray, t: float
) -> tuple[np.ndarray, np.ndarray]:
    """The points over a value, and their distances from others, of each a row."""
    points = fibres.points_over(t)
    return points, closure.distances(centres, points)


def _members(further: np.ndarray, nearer: np.ndarray) -> np.ndarray | None:
    """Which points come together at a centre, by their distances from it over two values.

    The nearest of both come there, and the others stay; None if that is not clear.
    """
    order = np.argsort(nearer)
    shrunk = nearer[order] / np.maximum(np.sort(further), 1e-300)
    count = int((shrunk < COMES).sum())
    clear = (shrunk[:count] < COMES).all() and (shrunk[count:] > STAYS).all()
    return order[:count] if clear else None


def _bring_to_value(closure: ProjectiveClosure, points: np.ndarray, t: float) -> np.ndarray:
    """Regular points over a value, from such over one next to it, by Newton's method.

    Raises:
        UnclearDigitsError: if it does not converge.
    """
    if not len(points):
        return points

    def equations(x: np.ndarray, _: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        values, slopes = closure.values(x), closure.jacobians(x)
        patches = np.zeros((len(x), len(closure.groups), closure.size), dtype=complex)
        for g in range(len(closure.groups)):
            patches[:, g] = np.where(closure.group_of == g, x.conj(), 0)
        over = slopes[:, -1:] - t * slopes[:, -2:-1]
        matrix = np.concatenate([slopes[:, :-2], patches, over], axis=1)
        right = np.zeros(matrix.shape[:2], dtype=complex)
        right[:, : values.shape[1] - 2] = values[:, :-2]
        right[:, -1] = values[:, -1] - t * values[:, -2]
        scale = np.linalg.norm(matrix, axis=2)
        return right / scale, matrix / scale[..., None]

    ends = find_zeros(equations, points)
    x = closure.normalise(ends.x)
    moved = np.diag(closure.distances(points, x))
    apart = closure.distances(points, points) + 2 * np.eye(len(x))
    if not ends.converged.all() or (moved > 0.1 * apart.min(axis=1)).any():
        raise UnclearDigitsError("points over a critical value are not found")
    return x
