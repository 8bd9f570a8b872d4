"""Alt's problem with its nine points moved, and its family in other unknowns and equations.

What an exact change of all unknowns would hide, that the equations are those of plane vectors, is
what the family is solved by; it is changed within that. The points are turned, scaled, mirrored and
put in another order, so that another one is the first; plane vectors among the unknowns are scaled
and put in another order, the equations mixed. Then the family is solved as a user would: once for
random parameters, and by `solve_targets` for the moved points and for those of the case. The zeros
for the former must be carried to those for the latter, to each of them one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from nag.algebra.family import Family
from nag.algebra.polynomial import Polynomial
from nag.algebra.rational_map import MapGroup, RationalMap
from nag.algebra.symmetric_family import FamilyMember, SymmetricFamily
from nag.bench.atlas.changes import mix_equations, power, small
from nag.numerics.coincidence import overlapping_pairs
from nag.solving.kantorovich import Confirmation
from nag.solving.solutions import SolveResult

# Among the complex numbers of a solution: the moving pivots, the fixed ones, and where the turns
# of the coupler begin, of which each is less by 1.
MOVING, FIXED, TURNS = (0, 2), (1, 3), 4
# Equations to which a multiple of another one is added.
MIXED = 1
# What is counted of the zeros.
CARRIED = "zero of the case to which one for the moved points is carried"
Point = tuple[Fraction, Fraction]


@dataclass(frozen=True)
class Similarity:
    """The plane mirrored, if so, in its first axis, and then multiplied by a complex number.

    Attributes:
        factor: that number; order: which of the points become the first, second and so on.
    """

    factor: Point
    mirrored: bool
    order: tuple[int, ...]

    @classmethod
    def random(cls, count: int, rng: np.random.Generator) -> Similarity:
        """A turn by an angle with rational cosine and sine, and a size between 1/4 and 4."""
        t, size = small(rng), Fraction(2) ** int(rng.integers(-2, 3))
        turn = size * (1 - t * t) / (1 + t * t), size * 2 * t / (1 + t * t)
        order = tuple(rng.permutation(count).tolist())
        return cls(turn, bool(rng.integers(2)), order)

    def displacements(self, given: Sequence[Point]) -> list[Point]:
        """Those of the moved points from the first of them, for those of the points."""
        whole = [(Fraction(0), Fraction(0)), *given]
        placed = [self._move_point(whole[i]) for i in self.order]
        return [(x - placed[0][0], y - placed[0][1]) for x, y in placed[1:]]

    def _move_point(self, point: Point) -> Point:
        (a, b), (x, y) = self.factor, point
        y = -y if self.mirrored else y
        return a * x - b * y, a * y + b * x

    def zeros_before(self, zeros: np.ndarray, given: Sequence[Point]) -> np.ndarray:
        """Zeros for displacements ``given`` from those for the moved points, both isotropic."""
        halves = list(np.split(np.asarray(zeros, dtype=np.complex128), 2, axis=1))
        factor = complex(*map(float, self.factor))
        first = (Fraction(0), Fraction(0)) if not self.order[0] else given[self.order[0] - 1]
        origin = complex(*map(float, first))
        if self.mirrored:
            halves.reverse()
            factor = factor.conjugate()
        by = ((factor, origin), (factor.conjugate(), origin.conjugate()))
        return np.hstack([self._half(h, *each) for h, each in zip(halves, by, strict=True)])

    def _half(self, zeros: np.ndarray, factor: complex, origin: complex) -> np.ndarray:
        """The same for half of the coordinates: complex numbers or what conjugates become."""
        turns = np.hstack([np.ones((len(zeros), 1)), 1 + zeros[:, TURNS:]])
        turns = turns[:, np.argsort(self.order)]
        # Where the coupler was at the first of the points was its position without a turn.
        turns = turns / turns[:, :1]
        before = np.empty_like(zeros)
        for i in MOVING:
            before[:, i] = zeros[:, i] / (factor * turns[:, self.order[0]])
        for i in FIXED:
            before[:, i] = zeros[:, i] / factor + origin
        before[:, TURNS:] = turns[:, 1:] - 1
        return before


@dataclass(frozen=True, eq=False)
class NinePoints:
    """The moved problem.

    Attributes:
        case: the family as it ships, and the case's points.
        motion: of the points.
        family: the family in other unknowns and equations.
        order: which of the complex unknowns become the first, second and so on; factors: of these.
    """

    case: FamilyMember
    motion: Similarity
    family: SymmetricFamily
    order: tuple[int, ...]
    factors: tuple[Fraction, ...]

    @classmethod
    def random(cls, case: FamilyMember, rng: np.random.Generator) -> NinePoints:
        """The family and the points of ``case``, changed at random."""
        symmetric = case.symmetric
        count = symmetric.original.n // 2
        order = tuple(rng.permutation(count).tolist())
        factors = tuple(small(rng) for _ in order)
        motion = Similarity.random(1 + len(symmetric.original.parameters) // 2, rng)
        changed = _changed(symmetric, order, factors, rng)
        return cls(case, motion, changed, order, factors)

    @property
    def displacements(self) -> list[Point]:
        """Those of the case's points from the first."""
        values = [Fraction(v) for v in self.case.values]
        half = len(values) // 2
        return list(zip(values[:half], values[half:], strict=True))

    @property
    def targets(self) -> tuple[list[Fraction], list[Fraction]]:
        """The parameters of the moved points, and those of the case."""
        moved = self.motion.displacements(self.displacements)
        both = ([[p[k] for p in some] for k in (0, 1)] for some in (moved, self.displacements))
        first, second = ([*x, *y] for x, y in both)
        return first, second

    def plain(self, points: np.ndarray) -> np.ndarray:
        """Solutions of the changed family, shape ``(P, n)``, as those of the case's, isotropic."""
        inner = self.family.inner(points)
        plain, count = np.empty_like(inner), len(self.order)
        for k, (i, factor) in enumerate(zip(self.order, self.factors, strict=True)):
            for half in (0, count):
                plain[:, half + i] = inner[:, half + k] * float(factor)
        return plain

    def carried(self, moved: SolveResult, unmoved: SolveResult) -> int:
        """How many solutions for the case's points are the one that a moved one is carried to.

        Both are confirmed by Kantorovich's theorem, in the case's own family.
        """
        values = self.case.symmetric.inner_values([complex(v) for v in self.case.values])
        images = self.motion.zeros_before(self.plain(moved.points), self.displacements)
        confirm = Confirmation(self.case.symmetric.family)
        ours, theirs = confirm(images, values), confirm(self.plain(unmoved.points), values)
        both = [np.flatnonzero(each.regular) for each in (ours, theirs)]
        zeros = np.concatenate([ours.points[both[0]], theirs.points[both[1]]])
        radii = np.concatenate([ours.radii[both[0]], theirs.radii[both[1]]])
        met = overlapping_pairs(zeros, 2 * np.linalg.norm(radii, axis=1))
        pairs = met[(met[:, 0] < len(both[0])) & (met[:, 1] >= len(both[0]))]
        single = len(pairs) == len(met) == len(np.unique(pairs[:, 0]))
        return len(np.unique(pairs[:, 1])) if single else 0


def _changed(
    symmetric: SymmetricFamily,
    order: Sequence[int],
    factors: Sequence[Fraction],
    rng: np.random.Generator,
) -> SymmetricFamily:
    """The family whose vectors are those in this order, divided by factors; equations mixed."""
    family, n = symmetric.original, symmetric.original.n
    unknowns = [pair for pair in symmetric.plane if pair[0] < n]
    given = [pair for pair in symmetric.plane if pair[0] >= n]
    x = Polynomial.variables(n + len(family.parameters))
    forms, names = list(x), [""] * n
    pairs = [(2 * k, 2 * k + 1) for k in range(len(unknowns))]
    for old, new, factor in zip((unknowns[i] for i in order), pairs, factors, strict=True):
        for i, k in zip(old, new, strict=True):
            forms[i], names[k] = factor * x[k], family.variables[i]
    equations = mix_equations([f.compose(forms) for f in family.polynomials], MIXED, rng)
    mixed = [power(rng, 1) * equations[i] for i in rng.permutation(n)]
    maps = [_in_order(g, order, factors) for g in symmetric.group.generators]
    changed = Family(tuple(names), family.parameters, tuple(mixed))
    return SymmetricFamily(changed, MapGroup.generated(maps), (*pairs, *given))


def _in_order(given: RationalMap, order: Sequence[int], factors: Sequence[Fraction]) -> RationalMap:
    """The map of unknowns in this order, divided by factors."""
    z = Polynomial.variables(given.numerators[0].n)
    forms = list(z)
    for k, (i, factor) in enumerate(zip(order, factors, strict=True)):
        forms[i] = factor * z[k]
    tops = [given.numerators[i].compose(forms) / f for i, f in zip(order, factors, strict=True)]
    return RationalMap(tuple(tops), tuple(given.denominators[i].compose(forms) for i in order))
