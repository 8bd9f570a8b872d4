"""Ends of paths sorted out: regular ones, clusters of singular ones, and where lost paths lead.

Those that lie where a polynomial does that must not vanish are left out, as digits decide.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.polynomial import Polynomial
from nag.numerics.coincidence import NEAR, SAFETY, clusters, coincident
from nag.numerics.doubles import ROUNDED
from nag.numerics.zero_values import NONZERO, ON, possible_zeros, vanishes_at
from nag.witness.confirm import find_vanishing
from nag.witness.cutting import Cut
from nag.witness.fibres import Fibre, SliceEnds
from nag.witness.slices import pad_rows

Cluster = list[tuple[np.ndarray, float]]


@dataclass(frozen=True, eq=False)
class Candidates:
    """Ends of one dimension: fibres of regular ones, and clusters of singular ones.

    A cluster is its points, the best known one first, with their errors. ``unclear``: ends of which
    it is not known whether they are excluded. ``lost``: where failed paths seem to lead, as
    clusters, and how many ends of paths there are in all next to each of them.
    """

    fibres: list[Fibre]
    singular: list[Cluster]
    unclear: int
    lost: list[tuple[Cluster, int]]


def collect(pieces: Sequence[SliceEnds], nonzero: Sequence[Polynomial]) -> Candidates:
    """The ends of paths to points on a slice, with the systems that cut them.

    Args:
        nonzero: polynomials that must not vanish; ends where one does are left out.
    """
    n = pieces[0].cut.n
    fibres: list[Fibre] = []
    unclear = 0
    seen = np.zeros((0, n), dtype=complex)
    singular, errors = [np.zeros((0, n), dtype=complex)], [np.zeros(0)]
    failed, every = [np.zeros((0, n), dtype=complex)], []
    for ends in pieces:
        x = ends.x
        left_out, doubtful = find_excluded(nonzero, ends)
        allowed, unclear = ends.finite & ~left_out, unclear + doubtful
        # The tracker has seen that ends of one piece are distinct.
        chosen = [
            i
            for i in np.flatnonzero(allowed & ends.regular)
            if not (len(seen) and coincident(seen, x[i], ends.accuracy[i]).any())
        ]
        if chosen:
            seen = np.vstack([seen, x[chosen]])
            fibres.append(ends.fibre(chosen))
        rest = allowed & ~ends.regular
        singular.append(x[rest])
        errors.append(ends.accuracy[rest])
        lost = ends.failed & (ends.accuracy < NEAR)
        failed.append(x[lost])
        every.append(x[ends.finite | lost])
    points, accuracy = np.vstack(singular), np.concatenate(errors)
    groups = clusters(points, accuracy)
    several = [[(points[i], float(accuracy[i])) for i in g] for g in groups]
    return Candidates(fibres, several, unclear, _crowds(np.vstack(failed), every))


def _crowds(lost: np.ndarray, every: Sequence[np.ndarray]) -> list[tuple[Cluster, int]]:
    """Clusters of failed ends, and how many of all ends are next to each."""
    if not len(lost):
        return []
    found, ends = [], np.vstack(every)
    for own in clusters(lost, np.full(len(lost), NEAR)):
        near = np.any([coincident(ends, lost[i], NEAR) for i in own], axis=0)
        found.append(([(lost[i], NEAR) for i in own], int(near.sum())))
    return found


def seem_excluded(nonzero: Evaluator, x: np.ndarray, accuracy: np.ndarray) -> np.ndarray:
    """Which points seem to lie where a polynomial that must not vanish does."""
    residuals = nonzero.residuals(x)
    limit = np.maximum(NONZERO, SAFETY * accuracy)
    return (residuals < limit[:, None]).any(axis=1)


def find_excluded(nonzero: Sequence[Polynomial], ends: SliceEnds) -> tuple[np.ndarray, int]:
    """Which ends lie where a polynomial that must not vanish does, decided in digits.

    Also of how many of these that is not known; they are left out.
    """
    cut, rows, result, unclear = ends.cut, ends.rows, ends.finite.copy(), 0
    if not nonzero or not result.any():
        return np.zeros(len(result), dtype=bool), unclear
    evaluator = Evaluator.of(nonzero, cut.n)
    result[result] = seem_excluded(evaluator, ends.x[result], ends.accuracy[result])
    regular = np.flatnonzero(result & ends.regular)
    small = (evaluator.residuals(ends.x[regular]) < ON).any(axis=0)
    at_regular = ends.fibre(regular)
    each = [find_vanishing(at_regular, g) for g, may in zip(nonzero, small, strict=True) if may]
    for k, i in enumerate(regular):
        answers = [own[k] for own in each]
        result[i] = True in answers or None in answers
        unclear += True not in answers and None in answers
    singular = np.flatnonzero(result & ~ends.regular)
    # The least accurate first: what it may stand for, others of its place may as well.
    doubtful: dict[int, bool] = {}
    for i in singular[np.argsort(-ends.accuracy[singular], kind="stable")].tolist():
        twin = _twin(ends, i, doubtful, real=not len(rows))
        known = doubtful.get(twin) if twin is not None else None
        if known is None:
            known = _lies_beside_excluded(nonzero, cut, rows, ends.points[i], ends.accuracy[i])
        doubtful[i] = known
    return result, unclear + sum(doubtful.values())


def _twin(ends: SliceEnds, i: int, others: Iterable[int], real: bool) -> int | None:
    """The end among ``others`` that an end is as well, or whose conjugate, as far as is known.

    Several paths end at a singular zero. Equations are real, and what is true of a zero of theirs
    alone is of its conjugate as well: so with ``real``, where no slice passes through it.
    """
    z = ends.points[i]
    for j in others:
        error = max(ends.accuracy[j], ROUNDED) * (1 + np.linalg.norm(z))
        for same in (z, z.conj()) if real else (z,):
            if np.linalg.norm(ends.points[j] - same) <= error:
                return j
    return None


def _lies_beside_excluded(
    nonzero: Sequence[Polynomial], cut: Cut, rows: np.ndarray, z: np.ndarray, accuracy: float
) -> bool:
    """Whether an isolated zero that ``z`` may be lies beside what is excluded, and not on it.

    Ill-conditioned zeros pass for singular ones, and may be so close to it that doubles can neither
    tell them from it nor hold a cut that makes them regular.
    """
    slices, rng = pad_rows(rows, 1 + len(z)), np.random.default_rng(0)
    zeros = possible_zeros(cut.polynomials, z, max(accuracy, ROUNDED), rng, slices, True)
    return not all(any(vanishes_at(zero, g) for g in nonzero) for zero in zeros)
