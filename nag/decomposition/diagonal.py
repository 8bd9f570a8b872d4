"""The intersection of two components as that of their product with the diagonal.

The product A x B is cut by random combinations of the equations x = y, one by one (Sommese,
Verschelde & Wampler 2004). Off the diagonal generic combinations cut transversally, however A and
B touch: such points stay regular zeros of the two components' own cuts, deflated ones where a
component is not reduced, and are tracked on. A path that ends on the diagonal ends at a point of
the intersection, often a singular one. It leaves the product for the space that A and B share,
where half as many variables remain to be deflated.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property

import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.decomposition.ends import SingularEnds, find_excluded
from nag.decomposition.factor import NOT_MOVED, Operand, move_to_flag
from nag.decomposition.hypersurface import intersect
from nag.decomposition.reduction import Reduction
from nag.decomposition.superset import Superset
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.coincidence import classify_arrivals, clusters, coincident
from nag.numerics.digits import bits_of
from nag.numerics.doubles import ROUNDED
from nag.numerics.zero_values import possible_zeros, vanishes_at_all
from nag.text.table import count_text
from nag.tracking.run import Run
from nag.witness.close_points import CLOSE, DIGITS, STEEPEST, PointInWords, fine_of_balls
from nag.witness.confirm import find_vanishing, zero_in_digits
from nag.witness.cutting import is_end, regular_on, sharpen
from nag.witness.fibres import STEEPER, Fibre, SliceEnds
from nag.witness.moving import SliceError, orthonormal_rows
from nag.witness.points import with_fine
from nag.witness.product import multiply_fibres
from nag.witness.slices import pad_rows, random_rows, unit_complex
from nag.witness.witness import PathCounts


@dataclass(frozen=True, eq=False)
class _Product:
    """Two factors, their coordinates side by side."""

    first: Operand
    second: Operand

    @property
    def n(self) -> int:
        return self.first.n + self.second.n

    def differences(self, rng: np.random.Generator) -> list[Polynomial]:
        """Random combinations of the equations that say that the factors' points are equal."""
        n, split = self.n, self.first.n
        pairs = zip(self.first.reduction.images, self.second.reduction.images, strict=True)
        plain = [
            f.with_variables(n, range(split)) - g.with_variables(n, range(split, n))
            for f, g in pairs
        ]
        plain = [f for f in dict.fromkeys(plain) if f]
        result = []
        for _ in plain:
            f = Polynomial.constant(n, 0)
            for difference, k in zip(plain, rng.integers(-64, 64, len(plain)), strict=True):
                f = f + difference * Fraction(2 * int(k) + 1, 64)
            result.append(f)
        return result

    def fibres(self, rng: np.random.Generator) -> list[Fibre]:
        """The pairs of witness points."""
        others = self.second.fibres(rng)
        return [multiply_fibres(a, b) for a in self.first.fibres(rng) for b in others]

    def excluded_by(self, common: Reduction) -> tuple[Polynomial, ...]:
        """What must not vanish where both points are equal, by the first one's coordinates."""
        images = [self.first.reduction.images[i] for i in common.kept]
        places = range(self.first.n)
        return tuple(
            f.compose(images).with_variables(self.n, places) for f in common.reduced.nonzero
        )

    def gaps(self, z: np.ndarray) -> np.ndarray:
        """Distances of points from the diagonal, relative to their size."""
        split = self.first.n
        x = self.first.reduction.frame.points(z[:, :split])
        y = self.second.reduction.frame.points(z[:, split : self.n])
        return np.linalg.norm(x - y, axis=1) / (1 + np.linalg.norm(x, axis=1))

    def common_rows(self, rows: np.ndarray, common: Reduction) -> np.ndarray:
        """What a slice of the product is on the diagonal, in the shared coordinates."""
        A = np.zeros((len(rows), len(common.frame.t)), dtype=complex)
        split = self.first.n
        A[:, self.first.reduction.kept] += rows[:, 1 : 1 + split]
        A[:, self.second.reduction.kept] += rows[:, 1 + split :]
        return orthonormal_rows(common.frame.pulled_back(A, -rows[:, 0]))


def meet_on_diagonal(
    first: Operand,
    second: Operand,
    common: Reduction,
    rng: np.random.Generator,
    run: Run,
) -> Superset:
    """The points of the intersection of two components on generic slices of all dimensions.

    Raises:
        nag.decomposition.factor.IntersectionError: if witness points are none.
    """
    product = _Product(first, second)
    flag = random_rows(rng, product.n, product.n)
    equations = product.differences(rng)
    try:
        fibres = product.fibres(rng)
    except SliceError:
        # Drawn in the units of one component, it may hardly depend on some coordinates in others.
        note = "a component's slice is too far from generic beside the other one"
        return Superset({}, PathCounts(), (note,))
    fibres, counts = move_to_flag(fibres, flag, rng, run)
    if fibres is None:
        return Superset({}, counts, (NOT_MOVED,))
    diagonal = _Diagonal(product, common, flag, rng, run, counts=counts)
    d = fibres[0].dimension
    # What vanishes on the diagonal, and nowhere else but by chance.
    probes = [*equations[1:], None][: len(equations)]
    if d == 0:
        diagonal.take_those_on_it(fibres, equations[0] if equations else None)
    for k, (f, probe) in enumerate(zip(equations, probes, strict=True)):
        if not fibres or d == 0:
            break
        run.tell("intersecting", k, len(equations))
        d -= 1
        fibres = diagonal.split_at_diagonal(fibres, f, probe, d)
    return Superset(
        diagonal.fibres, diagonal.counts, tuple(diagonal.notes), bare=tuple(diagonal.bare)
    )


def _regular(
    ends: SliceEnds, away: np.ndarray, gaps: np.ndarray, probe: Polynomial | None
) -> tuple[Fibre, int]:
    """The ends off the diagonal as regular zeros of a cut, and how many of them are none.

    Off the diagonal all are; an end that seems singular is a badly conditioned one. What is still
    to vanish is known beside its size only where its distance from the diagonal is.
    """
    cut, rows, places = ends.cut, ends.rows, np.flatnonzero(away & ends.regular)
    points, lost, fine = [ends.points[places]], 0, {}
    for k, i in enumerate(places.tolist()):
        if i in ends.fine or gaps[i] < CLOSE:
            there = _in_words(ends.fibre([i]), probe)
            if there is None:
                lost += 1
            else:
                fine[k] = there
    for i in np.flatnonzero(away & ~ends.regular):
        z = ends.points[i]
        sharpened = sharpen(cut.evaluator, rows, z)
        near = is_end(z, ends.accuracy[i], sharpened.z)
        alone = not coincident(np.vstack(points), sharpened.z, sharpened.step).any()
        if sharpened.converged and near and alone and regular_on(cut.evaluator, rows, sharpened):
            points.append(sharpened.z[None])
        else:
            lost += 1
    return with_fine([Fibre(cut, rows, np.vstack(points), fine)])[0], lost


def _in_words(fibre: Fibre, probe: Polynomial | None) -> PointInWords | None:
    """A fibre's one point in digits, as close to others as the zeros of a polynomial at least.

    None if it is not found.
    """
    there, known = zero_in_digits(fibre, 0), fibre.fine.get(0)
    if there is None:
        return None
    steep = known.curvature if known else 1.0
    if probe is not None:
        values = BallPolynomials.of((probe,)).values(there.centre[: probe.n], bits_of(2 * DIGITS))
        terms = sum(abs(complex(c)) for c in probe.terms.values())
        apart = (
            float(abs(values[0, 0]).mid()) / terms / (1 + float(np.linalg.norm(fibre.points[0])))
        )
        steep = max(steep, STEEPER / max(apart, 1 / STEEPEST))
    return fine_of_balls(there.centre, steep)


@dataclass(eq=False)
class _Diagonal:
    """The diagonal of a product, the flag of slices about it, and what was found on it so far.

    Attributes:
        fibres, bare, counts, notes: as of the `Superset` that they become.
    """

    product: _Product
    common: Reduction
    flag: np.ndarray
    rng: np.random.Generator
    run: Run
    fibres: dict[int, list[Fibre]] = field(default_factory=dict)
    bare: list[tuple[np.ndarray, float]] = field(default_factory=list)
    counts: PathCounts = field(default=PathCounts())
    notes: list[str] = field(default_factory=list)

    @cached_property
    def nonzero(self) -> tuple[Polynomial, ...]:
        """What must not vanish on it, in the product's coordinates."""
        return self.product.excluded_by(self.common)

    def split_at_diagonal(
        self, fibres: Sequence[Fibre], f: Polynomial, probe: Polynomial | None, d: int
    ) -> list[Fibre]:
        """Points of sets that met ``f``, in dimension ``d``: those off the diagonal.

        Those on it are added to the result.

        Args:
            probe: a polynomial that vanishes on the diagonal alone; None if all points are on it.
        """
        product = self.product
        gamma = complex(unit_complex(self.rng))
        off, on, errors = [], [np.zeros((0, product.n), dtype=complex)], [np.zeros(0)]
        for fibre in fibres:
            ends = intersect(fibre, f, gamma, self.run)
            self.counts += ends.counts
            gaps = np.full(len(ends), np.inf)
            gaps[ends.finite] = product.gaps(ends.points[ends.finite])
            on_it, doubtful = self.classify_ends(gaps, ends, probe, bool(fibre.fine))
            here, away = ends.finite & on_it, ends.finite & ~on_it
            # Decided on the factors' own cuts, on which ends are isolated: by the equations of both
            # they need not be, among what is excluded.
            out, unknown = find_excluded(self.nonzero, replace(ends, finite=here))
            here &= ~out
            if unknown:
                self.notes.append(f"{count_text(unknown, 'point')} may be excluded")
            unclear = int(np.sum(away & doubtful))
            on.append(ends.points[here, : product.n])
            errors.append(ends.accuracy[here])
            if d > 0 and away.any():
                rest, lost = _regular(ends, away, gaps, probe)
                off.append(rest)
                unclear += lost
            if unclear:
                self.notes.append(f"{unclear} paths ended neither on the diagonal nor well off it")
        self.take(np.vstack(on), np.concatenate(errors), d)
        return off

    def classify_ends(
        self, gaps: np.ndarray, ends: SliceEnds, probe: Polynomial | None, close: bool
    ) -> tuple[np.ndarray, np.ndarray]:
        """Which ends of paths are on the diagonal, and of which that is not clear.

        Regular ends that are near it are looked at in digits, and so are singular ones where
        sheets are ``close``: there errors of doubles do not say which one was met.
        """
        on_it, doubtful = classify_arrivals(gaps, ends.accuracy)
        if probe is None:
            return on_it, doubtful
        cut, rows, near = ends.cut, ends.rows, gaps < CLOSE
        regular = np.flatnonzero(near & ends.regular)
        answers = dict(zip(regular, find_vanishing(ends.fibre(regular), probe), strict=True))
        if close:
            for i in np.flatnonzero(near & ~ends.regular):
                rng, error = np.random.default_rng(0), max(float(ends.accuracy[i]), ROUNDED)
                zeros = possible_zeros(
                    cut.polynomials, ends.points[i], error, rng, pad_rows(rows, 1 + cut.n + cut.aux)
                )
                answers[i] = vanishes_at_all(zeros, probe)
        for i, answer in answers.items():
            on_it[i], doubtful[i] = answer is True, answer is None
        return on_it, doubtful

    def take_those_on_it(self, fibres: Sequence[Fibre], probe: Polynomial | None) -> None:
        """Add the pairs of isolated points that are equal."""
        accuracy = max(f.component.accuracy for f in (self.product.first, self.product.second))
        equal = [np.zeros((0, self.product.n), dtype=complex)]
        for fibre in fibres:
            near = self.product.gaps(fibre.x) < CLOSE
            if probe is not None:
                answers = find_vanishing(fibre.only(near), probe)
                if None in answers:
                    self.notes.append(f"{answers.count(None)} points may be equal or not")
                near[near] = [answer is True for answer in answers]
            equal.append(fibre.x[near])
        z = np.vstack(equal)
        self.take(z, np.full(len(z), accuracy), 0)

    def take(self, z: np.ndarray, accuracy: np.ndarray, d: int) -> None:
        """Add ends of dimension ``d`` on the diagonal, unless larger sets hold them."""
        common, first = self.common, self.product.first
        x = first.reduction.frame.points(z[:, : first.n])[:, common.kept]
        if not len(x):
            return
        try:
            rows = self.product.common_rows(self.flag[:d], common)
        except SliceError:
            self.notes.append("the equations of both components are too near to dependent ones")
            return
        self.fibres[d] = []
        place = common.equations, rows, self.rng, self.run
        singular = SingularEnds(*place, whole=True, members=False)
        for cluster in clusters(x, accuracy):
            ends = [(x[i], float(accuracy[i])) for i in cluster]
            settled = singular.add(ends, self.fibres)
            self.counts += settled.counts
            if d == 0 and not settled.regular:
                self.bare.append(ends[0])
            else:
                self.notes += settled.doubts
