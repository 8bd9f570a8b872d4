"""Witness supersets, equation by equation: u-generation (Duff, Leykin & Rodriguez 2022).

A set of dimension d is kept as its points on the first d rows of a flag of slices. Where an
equation f of degree m vanishes on such a point, the point stays; from the others start the paths
of ``f = u^m`` from the slice ``L_d = 0`` to ``u = 0``, m from each, which end at the points of
dimension d - 1. Nothing is randomised: each point carries the equations that cut it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.polynomial import Polynomial
from nag.decomposition.cutting import ON, Cut, Equations, leading_power
from nag.decomposition.fibres import (
    SAME,
    Fibre,
    Moved,
    Tracker,
    admit,
    homogeneous,
    moved,
)
from nag.decomposition.membership import Membership, is_member
from nag.decomposition.slices import padded, unit_complex
from nag.decomposition.witness import PathCounts
from nag.tracking.compiled import compile_rows
from nag.tracking.homotopy import Homotopy
from nag.tracking.track import track

Progress = Callable[[str, int, int], None]


@dataclass(frozen=True, eq=False)
class Superset:
    """Witness points of every dimension, singular ends that no cut was found for, and counts."""

    fibres: dict[int, list[Fibre]]
    counts: PathCounts
    notes: tuple[str, ...]


def intersection_order(equations: Sequence[Polynomial]) -> list[int]:
    """Order of intersection: lowest degree first, then fewest variables, then as given."""
    keys = [(f.degree, len(f.support), i) for i, f in enumerate(equations)]
    return [i for *_, i in sorted(keys)]


def intersect(
    fibre: Fibre, f: Polynomial, flag: np.ndarray, gamma: complex, tracker: Tracker
) -> Moved:
    """The ends of the paths from a fibre's points, none of them on f, to the hypersurface f = 0."""
    cut, d, degree = fibre.cut, fibre.dimension, f.degree
    n, total = cut.n, cut.n + cut.aux
    f = f * (1 / leading_power(f))
    u = Polynomial.variable(total + 1, total)
    place = range(total)
    rows = [g.with_variables(total + 1, place) for g in cut.polynomials]
    rows.append(f.with_variables(total + 1, range(n)) - u**degree)
    compiled = compile_rows(rows, n=total + 1)
    columns = total + 2
    slices = padded(flag[:d], columns)
    a0, a1 = slices.copy(), np.zeros_like(slices)
    a0[d - 1] = 0
    a0[d - 1, -1] = 1
    a1[d - 1] = gamma * slices[d - 1] - a0[d - 1]
    # An evaluator divides by the largest coefficient.
    values = Evaluator.of([f], n).values(fibre.x)[:, 0] * max(
        map(abs, map(float, f.terms.values()))
    )
    roots = np.exp(2j * np.pi * np.arange(degree) / degree)
    u_start = (values.astype(complex) ** (1 / degree))[:, None] * roots[None, :]
    starts = np.concatenate(
        [np.repeat(fibre.points, degree, axis=0), u_start.reshape(-1, 1)], axis=1
    )
    homotopy, points = Homotopy(compiled, a0, a1), homogeneous(starts)
    for settings in (tracker.settings, "careful"):
        paths = track(
            homotopy, points, settings=settings, threads=tracker.threads, end_exponent=degree
        )
        ends = moved(paths, keep=total)
        twice = _coinciding(ends)
        if not twice.any():
            return ends
    failed = ends.failed | twice
    counts = replace(ends.counts, failed=int(failed.sum()))
    return replace(ends, finite=ends.finite & ~twice, failed=failed, counts=counts)


def _coinciding(ends: Moved) -> np.ndarray:
    """Which regular ends are not alone: distinct paths never end at one regular point."""
    twice = np.zeros(len(ends.points), dtype=bool)
    regular = np.flatnonzero(ends.regular)
    points = ends.points[regular]
    for i, j in enumerate(regular):
        distances = np.linalg.norm(points[:i] - points[i], axis=1)
        same = distances < SAME * (1 + np.linalg.norm(points[i]))
        twice[regular[:i][same]] = True
        twice[j] |= bool(same.any())
    return twice


def clusters(points: np.ndarray, accuracy: np.ndarray) -> list[np.ndarray]:
    """Indices of the points that coincide within their errors, one array for each cluster."""
    groups: list[list[int]] = []
    for i in np.argsort(accuracy, kind="stable"):
        for group in groups:
            j = group[0]
            scale = 1 + np.linalg.norm(points[j])
            tolerance = max(SAME, 1e2 * (accuracy[i] + accuracy[j]))
            if np.linalg.norm(points[i] - points[j]) < tolerance * scale:
                group.append(int(i))
                break
        else:
            groups.append([int(i)])
    return [np.array(g) for g in groups]


def forbidden(nonzero: Evaluator, x: np.ndarray, accuracy: np.ndarray) -> np.ndarray:
    """Which points lie where a polynomial that must not vanish does."""
    residuals = nonzero.residuals(x)
    limit = np.maximum(1e-8, 1e2 * accuracy)
    return (residuals < limit[:, None]).any(axis=1)


@dataclass(frozen=True, eq=False)
class _Candidates:
    """Ends of one dimension: fibres of regular ones, and clusters of singular ones.

    A cluster is its points, the best known one first, with their errors.
    """

    fibres: list[Fibre]
    singular: list[list[tuple[np.ndarray, float]]]


def _collect(
    pieces: Sequence[tuple[Cut, Moved]], n: int, d: int, nonzero: Evaluator
) -> _Candidates:
    fibres: list[Fibre] = []
    seen = np.zeros((0, n), dtype=complex)
    singular, errors = [np.zeros((0, n), dtype=complex)], [np.zeros(0)]
    for cut, ends in pieces:
        x = ends.points[:, :n]
        allowed = ends.finite.copy()
        allowed[allowed] &= ~forbidden(nonzero, x[allowed], ends.accuracy[allowed])
        chosen = []
        for i in np.flatnonzero(allowed & ends.regular):
            scale = 1 + np.linalg.norm(x[i])
            if not (np.linalg.norm(seen - x[i], axis=1) < SAME * scale).any():
                chosen.append(i)
                seen = np.vstack([seen, x[i]])
        if chosen:
            fibres.append(Fibre(cut, d, ends.points[chosen]))
        rest = allowed & ~ends.regular
        singular.append(x[rest])
        errors.append(ends.accuracy[rest])
    points, accuracy = np.vstack(singular), np.concatenate(errors)
    groups = clusters(points, accuracy)
    return _Candidates(fibres, [[(points[i], float(accuracy[i])) for i in g] for g in groups])


def witness_superset(
    equations: Sequence[Polynomial],
    n: int,
    nonzero: Sequence[Polynomial],
    flag: np.ndarray,
    rng: np.random.Generator,
    tracker: Tracker,
    progress: Progress | None = None,
    start: Sequence[Fibre] = (),
    known: Sequence[Polynomial] = (),
) -> Superset:
    """Witness points of all dimensions for ``equations`` in n variables, intersected in order.

    ``flag`` holds n slices; a point of dimension d lies on its first d rows. No point of a
    component is missed unless a path failed, and the points that lie on components of higher
    dimension are taken out again after each equation.

    What is intersected is the whole space, or the pure-dimensional set whose points on ``flag``
    are ``start`` and on which the polynomials ``known`` vanish.
    """
    fibres: dict[int, list[Fibre]] = {}
    for fibre in start:
        fibres.setdefault(fibre.dimension, []).append(fibre)
    if not fibres:
        point = np.linalg.solve(flag[:, 1:], -flag[:, 0])
        fibres[n] = [Fibre(Cut(n, 0, ()), n, point[None])]
    counts, notes = PathCounts(), []
    avoid = Evaluator.of(nonzero, n)
    for k, f in enumerate(equations):
        here = Evaluator.of([f], n)
        gamma = complex(unit_complex(rng))
        kept: dict[int, list[Fibre]] = {}
        pieces: dict[int, list[tuple[Cut, Moved]]] = {}
        for d in sorted(fibres, reverse=True):
            for fibre in fibres[d]:
                on = here.residuals(fibre.x)[:, 0] < ON
                if on.any():
                    kept.setdefault(d, []).append(fibre.only(on))
                if d > 0 and f.degree > 0 and not on.all():
                    if progress is not None:
                        progress("intersecting", k, len(equations))
                    ends = intersect(fibre.only(~on), f, flag, gamma, tracker)
                    counts += ends.counts
                    pieces.setdefault(d - 1, []).append((fibre.cut.extended(f), ends))
        so_far = Equations((*known, *equations[: k + 1]), n)
        for d in sorted(pieces, reverse=True):
            candidates = _collect(pieces[d], n, d, avoid)
            kept.setdefault(d, []).extend(candidates.fibres)
            for cluster in candidates.singular:
                x, accuracy = cluster[0]
                if admit(x, accuracy, kept[d], so_far, flag[:d], rng, deflate=False):
                    # Ends that seemed to be one may be simple zeros close together.
                    for other, error in cluster[1:]:
                        admit(other, error, kept[d], so_far, flag[:d], rng, deflate=False)
                    continue
                answer = Membership.FOREIGN
                for higher in sorted((e for e in kept if e > d), reverse=True):
                    answer, used = is_member(x, accuracy, kept[higher], flag, rng, tracker)
                    counts += used
                    if answer is not Membership.FOREIGN:
                        break
                if answer is Membership.MEMBER:
                    continue
                if answer is Membership.UNDECIDED:
                    notes.append(f"a point of dimension {d} could not be told from a larger set")
                elif not admit(x, accuracy, kept[d], so_far, flag[:d], rng, deflate=True):
                    notes.append(f"a singular point of dimension {d} could not be made regular")
        fibres = {d: [fibre for fibre in kept[d] if len(fibre)] for d in kept}
    return Superset(fibres, counts, tuple(notes))
