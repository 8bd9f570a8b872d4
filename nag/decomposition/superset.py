"""Witness supersets, equation by equation: u-generation (Duff, Leykin & Rodriguez 2022).

A set of dimension d is kept as its points on the first d rows of a flag of slices; each point
carries the equations that cut it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property

import numpy as np

from nag.algebra.polynomial import Polynomial, find_nonzero_variables
from nag.decomposition.ends import EveryEnd, SingularEnds, collect
from nag.decomposition.hypersurface import HypersurfaceSection, hypersurface_section
from nag.numerics.singular_point import Place, analyse
from nag.text.table import count_text
from nag.tracking.run import Run
from nag.witness.close_to_sets import find_nearby_zeros, is_point_of_others
from nag.witness.cutting import Equations, dyadic, leading_power
from nag.witness.fibres import Fibre, SliceEnds
from nag.witness.membership import Membership, is_on_larger_set
from nag.witness.points import Points
from nag.witness.slices import pad_rows
from nag.witness.witness import PathCounts

# Relative error of regular ends of paths.
REGULAR = 1e-13
# Points of sets that are multiple, whose multiplicity is found out one by one.
MOST_JUDGED = 8


@dataclass(frozen=True, eq=False)
class Superset:
    """Witness points of every dimension, on the leading rows of one flag of slices.

    Attributes:
        fibres: the points with what cuts them, by dimension.
        counts: of the paths that led to them.
        notes: tell of singular ends that no cut was found for.
        about_points: how many of these, and of the failed paths, are about points of dimension 0.
        recovered: how many failed paths led to zeros that were found where these seemed to lead,
            by dimension.
        bare: isolated points that no deflation made regular, with their errors.
    """

    fibres: Mapping[int, list[Fibre]]
    counts: PathCounts
    notes: tuple[str, ...]
    about_points: int = 0
    recovered: Mapping[int, int] = field(default_factory=dict)
    bare: Sequence[tuple[np.ndarray, float]] = ()

    @property
    def points(self) -> dict[int, Points]:
        """The points by dimension, under indices."""
        return {d: Points.of(fibres) for d, fibres in self.fibres.items() if fibres}

    @property
    def doubts(self) -> list[str]:
        """The notes, and what failed paths mean."""
        failed = self.counts.failed
        lost = [f"{count_text(failed, 'path')} failed; points may be missing"] if failed else []
        return [*self.notes, *lost]

    @property
    def only_points(self) -> bool:
        """Whether nothing but isolated points may be missing."""
        return self.counts.failed + len(self.notes) == self.about_points


def intersection_order(equations: Sequence[Polynomial]) -> list[int]:
    """Order of intersection: lowest degree first, then fewest new variables, fewest, as given.

    Equations of one degree that share variables with those before lead to sets of lower degree than
    products, as of the norms of all turns in a linkage.
    """
    left, known, order = list(range(len(equations))), frozenset(), []
    supports = [frozenset(f.support) for f in equations]
    while left:
        keys = [(equations[i].degree, len(supports[i] - known), len(supports[i]), i) for i in left]
        *_, best = min(keys)
        left.remove(best)
        order.append(best)
        known |= supports[best]
    return order


def _mixed(f: Polynomial, others: Sequence[Polynomial], rng: np.random.Generator) -> Polynomial:
    """``f`` and random multiples of others, all of comparable size."""
    size = leading_power(f)
    for g, weight in zip(others, dyadic(rng, (len(others),)), strict=True):
        f = f + g * (Fraction(weight) * size / leading_power(g))
    return f


@dataclass(frozen=True, eq=False)
class _Outcome:
    """Sets that met a polynomial, and what they are then; None if that was left open."""

    polynomial: Polynomial
    crossed: HypersurfaceSection
    superset: Superset | None


@dataclass(frozen=True, eq=False)
class _Stage:
    """How sets are to meet a polynomial, where ``before`` vanish on them and ``avoid`` must not.

    ``after`` are the equations that they will meet later. ``whole``: whether the sets are all zeros
    of those before, but for what lies where one of ``avoid`` vanishes.
    """

    before: tuple[Polynomial, ...]
    after: tuple[Polynomial, ...]
    found: Superset
    avoid: tuple[Polynomial, ...]
    rng: np.random.Generator
    run: Run
    whole: bool

    @property
    def units(self) -> tuple[int, ...]:
        """The variables of the monomials in ``avoid``, ascending."""
        monomials = [g for g in self.avoid if len(g.terms) == 1]
        return tuple(sorted({i for g in monomials for i in g.support}))

    def best(self, f: Polynomial, mixing: bool) -> tuple[_Outcome, bool, PathCounts]:
        """What becomes of the sets with ``f``, or with a combination of it with later ones.

        The first equations alone may define components that are not reduced where all together do
        not. A general combination of an equation with later ones of its degree meets a reduced set
        in a reduced one, but for what lies on all of them (Bertini): it takes the equation's place
        then, and from then on, as ``mixing`` says.
        """
        later = [g for g in self.after if g.degree == f.degree]
        first = _mixed(f, later, self.rng) if mixing else f
        best, counts = self.outcome(first, deflate=mixing or not later)
        if best.superset is None:
            mixed, spent = self.outcome(_mixed(f, later, self.rng), deflate=False)
            counts += spent
            if mixed.superset is None and mixed.crossed.singular >= best.crossed.singular:
                mixed = best
            mixing = mixed is not best
            best = mixed
            if best.superset is None:
                found, spent = self.superset(best.polynomial, best.crossed, deflate=True)
                counts += spent
                best = replace(best, superset=found)
        return best, mixing, counts

    def outcome(self, f: Polynomial, deflate: bool) -> tuple[_Outcome, PathCounts]:
        crossed = hypersurface_section(self.found.fibres, f, self.rng, self.run, self.units)
        found, spent = self.superset(f, crossed, deflate)
        return _Outcome(f, crossed, found), PathCounts(crossed.counts.tracked) + spent

    def keep_on_no_other(
        self, fibre: Fibre, kept: Mapping[int, Sequence[Fibre]], equations: Equations
    ) -> tuple[Fibre, list[str], PathCounts]:
        """The points of a deflated fibre that lie on no other set of zeros of ``equations``.

        Deflation of one component takes others out of the zeros of its equations, so that a point
        may be a regular one where it lies on another component of all equations. Where paths of the
        larger sets do not tell, digits do.
        """
        counts, notes, d = PathCounts(), [], fibre.dimension
        mask = np.ones(len(fibre), dtype=bool)
        for i, x in enumerate(fibre.x):
            known = is_point_of_others(fibre, i, REGULAR, kept.get(d, ()))
            if known is not False:
                mask[i] = False
                notes += [] if known else [_untold(1, d)]
                continue
            answer, used = is_on_larger_set(x, REGULAR, kept, d, self.rng, self.run)
            counts += used
            mask[i] = answer is Membership.FOREIGN
            if answer is Membership.UNDECIDED:
                near = find_nearby_zeros([(x, REGULAR)], equations, fibre.rows, self.rng)
                mask[i] = near.decided and len(near.zeros) > 0
                if not near.decided:
                    notes.append(f"a point of dimension {d} could not be told from a larger set")
        return fibre.only(mask), notes, counts

    def superset(
        self, f: Polynomial, crossed: HypersurfaceSection, deflate: bool
    ) -> tuple[Superset | None, PathCounts]:
        """The points of all dimensions after an intersection, without those of larger sets.

        None if ``deflate`` is False and a singular end may belong to a component that is not
        reduced.
        """
        so_far = Equations((*self.before, f), f.n)
        kept = {d: list(fibres) for d, fibres in crossed.kept.items()}
        counts, notes, higher, recovered = PathCounts(), [], 0, {}
        for d in sorted(crossed.ends, reverse=True):
            higher = len(notes)
            candidates = collect(crossed.ends[d], self.avoid, self.units)
            rows = crossed.ends[d][0].rows
            every = self._count_ends(so_far, crossed.ends[d]) if candidates.singular else None
            place = so_far, rows, self.rng, self.run, self.after, self.avoid
            singular = SingularEnds(*place, every=every)
            if candidates.unclear:
                notes.append(f"{count_text(candidates.unclear, 'point')} may be excluded")
            if candidates.untold:
                notes.append(_untold(candidates.untold, d))
            for fibre in candidates.fibres:
                if fibre.cut.deflated:
                    fibre, doubts, used = self.keep_on_no_other(fibre, kept, so_far)
                    counts += used
                    notes += doubts
                kept.setdefault(d, []).append(fibre)
            kept.setdefault(d, [])
            for cluster in candidates.singular:
                settled = singular.add(cluster, kept, deflate)
                counts += settled.counts
                if not (settled.regular or deflate):
                    return None, counts
                notes += settled.doubts
            found = singular.recover(candidates.lost, kept[d])
            recovered |= {d: found} if found else {}
        kept = {d: [fibre for fibre in fibres if len(fibre)] for d, fibres in kept.items()}
        points = len(notes) - higher if 0 in crossed.ends else 0
        return Superset(kept, PathCounts(), tuple(notes), points, recovered), counts

    def _count_ends(self, so_far: Equations, pieces: Sequence[SliceEnds]) -> EveryEnd | None:
        """Where all paths to a slice end; None where they do not say how multiple zeros are.

        The zeros of as many equations as they have codimensions are a complete intersection, whose
        local rings are Cohen-Macaulay: the last equation leaves of them as much as its order on the
        branches, each by the multiplicity of its component, adds up to (Fulton, Intersection
        Theory, 1998, lemma A.2.7). Its order is the number of paths.
        """
        n, d = so_far.n, len(pieces[0].rows)
        if not self.whole or len(self.before) != n - d - 1:
            return None
        places, weights = [], []
        for ends in pieces:
            cut = ends.cut.polynomials[:-1]
            fibres = self.found.fibres[d + 1]
            own = next((fibre for fibre in fibres if fibre.cut.polynomials == cut), None)
            multiplicity = None if own is None else self._multiplicities[id(own)]
            if multiplicity is None:
                return None
            there = ends.finite | ends.failed
            places.append(np.where(ends.failed[:, None], np.nan, ends.x)[there])
            weights.append(np.full(int(there.sum()), multiplicity))
        return EveryEnd(np.vstack(places), np.concatenate(weights))

    @cached_property
    def _multiplicities(self) -> dict[int, int | None]:
        """The largest multiplicity of a component that points of a fibre lie on, where known."""
        every = [fibre for fibres in self.found.fibres.values() for fibre in fibres]
        return {id(fibre): self._largest_multiplicity(fibre) for fibre in every}

    def _largest_multiplicity(self, fibre: Fibre) -> int | None:
        if not fibre.cut.deflated and set(self.before).issuperset(fibre.cut.polynomials):
            return 1
        if len(fibre) > MOST_JUDGED or len(self.before) != fibre.cut.n - fibre.dimension:
            return None
        rng, slices = np.random.default_rng(0), pad_rows(fibre.rows, 1 + fibre.cut.n)
        ends = [analyse(self.before, x, REGULAR, rng, slices, True) for x in fibre.x]
        known = all(end.place is Place.ISOLATED for end in ends)
        return max(end.multiplicity for end in ends) if known else None


def _untold(count: int, d: int) -> str:
    """A note of points that may be those of another set."""
    points = count_text(count, "point")
    return f"{points} of dimension {d} could not be told from others close by"


def witness_superset(
    equations: Sequence[Polynomial],
    sets: Mapping[int, list[Fibre]],
    rng: np.random.Generator,
    run: Run,
    known: Sequence[Polynomial] = (),
    nonzero: Sequence[Polynomial] = (),
) -> Superset:
    """Witness points of all dimensions where sets meet ``equations``, intersected in order.

    A point of dimension d lies on the first d rows of the flag of the sets. No point of a component
    is missed unless a path failed, and the points that lie on components of higher dimension are
    taken out again after each equation.

    Args:
        sets: by their points, by dimension; `nag.witness.fibres.whole_space` is one.
        known: polynomials that vanish on them; nonzero: those that must not vanish.
    """
    equations = list(equations)
    counts, notes, points = PathCounts(), [], 0
    found = Superset(sets, counts, ())
    mixing = False
    variables = Polynomial.variables(equations[0].n) if equations else ()
    rows = [f.terms for f in (*known, *equations)]
    never_zero = [variables[i] for i in find_nonzero_variables(rows, len(variables))]
    avoid = tuple(dict.fromkeys((*nonzero, *never_zero)))
    whole = not known
    for k, f in enumerate(equations):
        run.tell("intersecting", k, len(equations))
        before, after = (*known, *equations[:k]), tuple(equations[k + 1 :])
        stage = _Stage(before, after, found, avoid, rng, run, whole)
        best, mixing, spent = stage.best(f, mixing)
        found = best.superset
        equations[k] = best.polynomial
        notes += found.notes
        points += found.about_points + best.crossed.failed_to(0) - found.recovered.get(0, 0)
        failed = best.crossed.counts.failed - sum(found.recovered.values())
        infinite = best.crossed.counts.at_infinity
        counts += PathCounts(spent.tracked, failed, infinite)
        whole = whole and not failed and not found.notes
    return Superset(found.fibres, counts, tuple(notes), points)
