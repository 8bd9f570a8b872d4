"""Ends of paths sorted out: regular ones, what singular ones stand for, where lost paths lead.

Those that lie where a polynomial does that must not vanish are left out, as digits decide.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.polynomial import Polynomial
from nag.numerics.coincidence import NEAR, SAFETY, clusters, coincident, radius_about
from nag.numerics.doubles import ROUNDED
from nag.numerics.singular_point import SingularEnd
from nag.numerics.zero_values import NONZERO, ON, possible_zeros, vanishes_at
from nag.tracking.run import Run
from nag.witness.close_to_sets import (
    NearbyZeros,
    find_nearby_zeros,
    is_among_points,
    is_point_of_others,
)
from nag.witness.confirm import find_vanishing
from nag.witness.cutting import Cut, Equations
from nag.witness.cutting_in_digits import admit_zero, is_alone
from nag.witness.fibres import Fibre, SliceEnds, admit_end
from nag.witness.membership import Membership, is_on_larger_set
from nag.witness.slices import pad_rows
from nag.witness.witness import PathCounts

Cluster = list[tuple[np.ndarray, float]]

# Decides: Part of the usual work after which a multiple zero that lies on a larger set as far as
# doubles can tell passes for a point of it; simple ones are told in any case.
IN_PASSING = 0.02


@dataclass(frozen=True, eq=False)
class Candidates:
    """Ends of one dimension: fibres of regular ones, and clusters of singular ones.

    A cluster is its points, the best known one first, with their errors. ``unclear``: ends of which
    it is not known whether they are excluded. ``untold``: regular ones that digits do not tell from
    those of another set. ``lost``: where failed paths seem to lead, as clusters, and how many ends
    of paths there are in all next to each of them.
    """

    fibres: list[Fibre]
    singular: list[Cluster]
    unclear: int
    untold: int
    lost: list[tuple[Cluster, int]]


def collect(
    pieces: Sequence[SliceEnds], nonzero: Sequence[Polynomial], units: Sequence[int] = ()
) -> Candidates:
    """The ends of paths to points on a slice, with the systems that cut them.

    Args:
        nonzero: polynomials that must not vanish; ends where one does are left out.
        units: variables that vanish at no regular end, as
            `nag.decomposition.hypersurface.intersect` was told that they must not.
    """
    n = pieces[0].cut.n
    fibres: list[Fibre] = []
    unclear = untold = 0
    singular, errors = [np.zeros((0, n), dtype=complex)], [np.zeros(0)]
    failed, every = [np.zeros((0, n), dtype=complex)], []
    for ends in pieces:
        x = ends.x
        left_out, doubtful = find_excluded(nonzero, ends, units)
        allowed, unclear = ends.finite & ~left_out, unclear + doubtful
        # The tracker has seen that ends of one piece are distinct.
        places = np.flatnonzero(allowed & ends.regular)
        regular = ends.fibre(places)
        known = [
            is_point_of_others(regular, k, float(ends.accuracy[i]), fibres)
            for k, i in enumerate(places)
        ]
        untold += known.count(None)
        if False in known:
            fibres.append(regular.only(np.array([each is False for each in known])))
        rest = allowed & ~ends.regular
        singular.append(x[rest])
        errors.append(ends.accuracy[rest])
        lost = ends.failed & (ends.accuracy < NEAR)
        failed.append(x[lost])
        every.append(x[ends.finite | lost])
    points, accuracy = np.vstack(singular), np.concatenate(errors)
    groups = clusters(points, accuracy)
    several = [[(points[i], float(accuracy[i])) for i in g] for g in groups]
    return Candidates(fibres, several, unclear, untold, _crowds(np.vstack(failed), every))


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


def find_excluded(
    nonzero: Sequence[Polynomial], ends: SliceEnds, units: Sequence[int] = ()
) -> tuple[np.ndarray, int]:
    """Which ends lie where a polynomial that must not vanish does, decided in digits.

    Also of how many of these that is not known; they are left out. Of regular ends it is not asked
    of monomials in ``units``, see `collect`: paths know each coordinate relative to its own size,
    digits of a point relative to the largest.
    """
    cut, rows, result, unclear = ends.cut, ends.rows, ends.finite.copy(), 0
    if not nonzero or not result.any():
        return np.zeros(len(result), dtype=bool), unclear
    evaluator = Evaluator.of(nonzero, cut.n)
    result[result] = seem_excluded(evaluator, ends.x[result], ends.accuracy[result])
    regular = np.flatnonzero(result & ends.regular)
    small = (evaluator.residuals(ends.x[regular]) < ON).any(axis=0)
    at_regular = ends.fibre(regular)
    asked = [
        g
        for g, may in zip(nonzero, small, strict=True)
        if may and not (len(g.terms) == 1 and g.support.issubset(units))
    ]
    each = [find_vanishing(at_regular, g) for g in asked]
    for k, i in enumerate(regular):
        answers = [own[k] for own in each]
        result[i] = True in answers or None in answers
        unclear += True not in answers and None in answers
    singular = np.flatnonzero(result & ~ends.regular)
    # The least accurate first: what it may stand for, others of its place may as well.
    known: dict[int, bool | None] = {}
    for i in singular[np.argsort(-ends.accuracy[singular], kind="stable")].tolist():
        twin = _twin(ends, i, known, real=not len(rows))
        if twin is None:
            known[i] = _is_excluded(nonzero, cut, rows, ends.points[i], ends.accuracy[i])
        else:
            known[i] = known[twin]
        result[i] = known[i] is not False
    return result, unclear + sum(answer is None for answer in known.values())


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


def _is_excluded(
    nonzero: Sequence[Polynomial], cut: Cut, rows: np.ndarray, z: np.ndarray, accuracy: float
) -> bool | None:
    """Whether the zero that a singular end is lies on what is excluded; None where that is open.

    Ill-conditioned zeros pass for singular ones, and may be so close to it that doubles cannot tell
    them from it: the digits of the zero do. Of several zeros that the end may be it is known where
    it is the same of all.
    """
    slices, rng = pad_rows(rows, 1 + len(z)), np.random.default_rng(0)
    zeros = possible_zeros(cut.polynomials, z, max(accuracy, ROUNDED), rng, slices, True)
    if zeros is None:
        return None
    answers = {_one_vanishes(nonzero, zero) for zero in zeros}
    return answers.pop() if len(answers) == 1 else None


def _one_vanishes(polynomials: Sequence[Polynomial], zero: SingularEnd) -> bool | None:
    """Whether one of some polynomials vanishes at a zero; None where that is not known."""
    answers = {vanishes_at(zero, g) for g in polynomials}
    return True if True in answers else None if None in answers else False


@dataclass(frozen=True, eq=False)
class EveryEnd:
    """Where all paths to a slice end, counted so that they add up to a zero's multiplicity.

    Attributes:
        x: shape ``(P, n)``, nan where that is not known.
        weights: for how many each path counts, shape ``(P,)``.
    """

    x: np.ndarray
    weights: np.ndarray

    def count_near(self, cluster: Cluster) -> int:
        """The largest multiplicity of an isolated zero near some ends."""
        radius = radius_about(cluster[0][0], max(error for _, error in cluster))
        far = np.linalg.norm(self.x - cluster[0][0], axis=1) > radius
        return int(self.weights[~far].sum())


@dataclass(frozen=True, eq=False)
class Settled:
    """What came of singular ends.

    Attributes:
        doubts: what is not known of them.
        counts: of the paths that were tracked to larger sets.
        regular: False where a point is on no larger set, and no cut makes it a regular one.
    """

    doubts: Sequence[str] = ()
    counts: PathCounts = field(default=PathCounts())
    regular: bool = True


@dataclass(frozen=True, eq=False)
class SingularEnds:
    """How it is told what singular ends of paths to a slice stand for.

    Attributes:
        equations: they hold on the sets that the paths lead to.
        rows: the slice.
        later: further equations, which may hold on some of the sets.
        avoid: polynomials that must not vanish.
        whole: whether errors are relative to the point, not to each of its coordinates.
        members: whether those that lie on larger sets as far as doubles can tell are looked at in
            digits. Where sets meet, most ends do, and are multiple.
        every: where all paths end, if what is known of them says how multiple a zero can be.
    """

    equations: Equations
    rows: np.ndarray
    rng: np.random.Generator
    run: Run
    later: Sequence[Polynomial] = ()
    avoid: Sequence[Polynomial] = ()
    whole: bool = False
    members: bool = True
    every: EveryEnd | None = None

    def add(self, cluster: Cluster, kept: dict[int, list[Fibre]], deflate: bool = True) -> Settled:
        """Add the points that a cluster of ends stands for to those known, by dimension.

        Those of larger sets are none. Doubles propose: a point is added where they find a cut that
        makes it regular, and digits see no other zero beside it; else the zeros there are looked
        for in digits.

        Args:
            cluster: the best known end first.
            deflate: whether equations may be deflated to make a point regular.
        """
        (x, accuracy), d = cluster[0], len(self.rows)
        own, so_far = kept[d], self.equations
        simple = list(own)
        if admit_end(x, accuracy, simple, so_far, self.rows, self.rng, deflate=False):
            # Ends that seemed to be one may be simple zeros close together.
            for other, error in cluster[1:]:
                admit_end(other, error, simple, so_far, self.rows, self.rng, deflate=False)
            if not self._are_new_alone(own, simple):
                doubts = self._add_all_nearby(cluster, own)
                if doubts is not None:
                    return Settled(doubts)
            own[:] = simple
            return Settled()
        answer, counts = is_on_larger_set(x, accuracy, kept, d, self.rng, self.run)
        untold = f"a point of dimension {d} could not be told from a larger set"
        if answer is Membership.MEMBER and not self.members:
            return Settled(counts=counts)
        if answer is not Membership.FOREIGN:
            # Singular ends mostly lie on the set that they seem to lie on, however hard to judge.
            patience = IN_PASSING if answer is Membership.MEMBER else 1.0
            doubts, found = self.add_nearby_zeros(cluster, own, patience)
            if found.decided:
                return Settled(doubts, counts)
            if answer is Membership.MEMBER:
                # A multiple zero is where paths of the set end, if its local ring is too long.
                return Settled(doubts if found.located else [*doubts, untold], counts)
        holding = self._add_vanishing_equations(x, accuracy)
        if answer is Membership.FOREIGN and admit_end(
            x, accuracy, own, holding, self.rows, self.rng, deflate=False
        ):
            return Settled(counts=counts)
        if not deflate:
            return Settled(counts=counts, regular=False)
        if answer is Membership.UNDECIDED:
            return Settled([untold], counts)
        deflated = list(own)
        admitted = any(
            admit_end(x, accuracy, deflated, each, self.rows, self.rng, deflate=True)
            for each in dict.fromkeys((holding, so_far))
        )
        if admitted and self._are_new_alone(own, deflated):
            own[:] = deflated
            return Settled(counts=counts)
        # Zeros so close together that doubles can neither tell nor cut them.
        doubts = self._add_all_nearby(cluster, own)
        if doubts is not None:
            return Settled(doubts, counts)
        doubts = [f"a singular point of dimension {d} could not be made regular"]
        return Settled(doubts, counts, regular=False)

    def _add_vanishing_equations(self, x: np.ndarray, accuracy: float) -> Equations:
        """The equations, and the later ones that seem to vanish at a point as well.

        A component that is multiple for the first equations may be a simple one for all.
        """
        limit = max(ON, SAFETY * accuracy)
        known = self.equations
        later = Equations(tuple(self.later), known.n).evaluator.residuals(x[None])[0] < limit
        more = [g for g, vanishes in zip(self.later, later, strict=True) if vanishes]
        return Equations((*known.polynomials, *more), known.n) if more else known

    def _are_new_alone(self, before: Sequence[Fibre], after: Sequence[Fibre]) -> bool:
        """Whether points that were put last into fibres are zeros of all equations, and alone."""
        known = [len(fibre) for fibre in before]
        known += [0] * (len(after) - len(before))
        return all(
            is_alone(fibre, i, self.equations)
            for fibre, first in zip(after, known, strict=True)
            for i in range(first, len(fibre))
        )

    def _add_all_nearby(self, cluster: Cluster, own: list[Fibre]) -> list[str] | None:
        """Add all isolated zeros that ends may stand for; doubts, or None if some are not known.

        One is left where fewer zeros were found, with multiplicities, than paths ended there.
        Further equations than cut a set may make it less multiple than the paths show.
        """
        doubts, found = self.add_nearby_zeros(cluster, own)
        if not found.decided or not found.zeros or doubts:
            return None
        d, total = len(self.rows), sum(zero.multiplicity for zero in found.zeros)
        square = len(self.equations.polynomials) == self.equations.n - d
        lost = square and total < len(cluster)
        return [f"zeros of dimension {d} close to each other were not all found"] if lost else []

    def add_nearby_zeros(
        self, cluster: Cluster, own: list[Fibre], patience: float = 1.0
    ) -> tuple[list[str], NearbyZeros]:
        """Add the isolated zeros that ends in doubles may stand for; doubts, and what was found."""
        doubts, (equations, rows, rng) = [], (self.equations, self.rows, self.rng)
        most = None if self.every is None else self.every.count_near(cluster)
        found = find_nearby_zeros(cluster, equations, rows, rng, patience, self.whole, most)
        for zero in found.zeros:
            known = is_among_points(zero, own)
            if known or any(vanishes_at(zero, g) for g in self.avoid):
                continue
            if known is None or not admit_zero(zero, own, equations, rows, rng):
                doubts.append("a point close to a larger set could not be made regular")
        return doubts, found

    def recover(self, lost: Sequence[tuple[Cluster, int]], own: list[Fibre]) -> int:
        """Add the zeros where failed paths seem to lead; of how many paths they are the ends.

        Zeros close to each other are where a path is the last to be told from others: in the end
        it needs as many digits as they have distances multiplied, and there are as many zeros,
        with multiplicities, as paths.
        """
        recovered, of_points = 0, replace(self, whole=True)
        for cluster, near in lost:
            doubts, found = of_points.add_nearby_zeros(cluster, own)
            if found.decided and found.zeros and not doubts:
                total = sum(zero.multiplicity for zero in found.zeros)
                recovered += len(cluster) if total >= near else 0
        return recovered
