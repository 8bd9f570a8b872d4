"""The critical points of a linear form on a curve, and those where its equations are singular.

With J of the equations, one fewer than variables, they are the points x over which ``J(x) v = 0``,
``c.v = 0`` for some v, a point of a projective space: the zeros of ``det [J; c]`` on the curve. The
rows of ``J v`` are of known degrees in the groups of x and linear in v: a homotopy deforms products
of as many linear forms into them, while x stays on the curve. At its start one row but one is
solved by v, and that one by x on a slice of the curve: as many paths as the degree of the
determinant on the curve, none of which is lost unseen.

Reference:
    Bates, Hauenstein, Peterson & Sommese, Numerical decomposition of the rank-deficiency set of a
    matrix of multivariate polynomials, 2009 (null vectors in the place of minors); Hauenstein,
    Sommese & Wampler, Regeneration homotopies for solving systems of polynomials, 2011 (from
    slices of a set to its intersection with a hypersurface).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import comb

import numpy as np

from nag.algebra.number import Number
from nag.algebra.polynomial import Exponents, Polynomial
from nag.numerics.coincidence import clusters, conjugates_present, radii_of_balls
from nag.numerics.doubles import ROUNDED
from nag.real.closure import coordinates_of_groups
from nag.real.fibre_table import FibreError
from nag.tracking.compiled import CompiledRows
from nag.tracking.homotopy import Homotopy
from nag.tracking.paths import Paths, PathStatus
from nag.tracking.run import Run
from nag.tracking.track import track
from nag.witness.fibres import Fibre, move
from nag.witness.slices import unit_complex

# Terms of all start rows at most: longer ones would slow every step down.
MOST_TERMS = 20_000

Terms = dict[Exponents, Number | complex]


@dataclass(frozen=True, eq=False)
class CriticalPoints:
    """The finite zeros of ``det [J; form]`` on a curve that is its own conjugate.

    Attributes:
        points: each once, shape ``(K, n)``.
        errors: estimated relative ones, shape ``(K,)``.
        multiplicities: of the zeros on the curve, shape ``(K,)``.
        real: which are real, shape ``(K,)``.
        infinite: what multiplicities at infinity add up to.
    """

    points: np.ndarray
    errors: np.ndarray
    multiplicities: np.ndarray
    real: np.ndarray
    infinite: int


@dataclass(frozen=True, eq=False)
class _Layout:
    """Coordinates of pairs (x, v): one that each group of x divides by, x, and v.

    Attributes:
        groups: a partition of the variables' indices.
        tops: degree of each equation in each group.
        degrees: the same of a row of J.
    """

    n: int
    groups: tuple[tuple[int, ...], ...]
    tops: tuple[tuple[int, ...], ...]
    degrees: tuple[tuple[int, ...], ...]

    @classmethod
    def of(cls, equations: Sequence[Polynomial], groups: Sequence[Sequence[int]]) -> _Layout:
        n = equations[0].n
        own = tuple(map(tuple, groups)) or (tuple(range(n)),)
        tops = tuple(tuple(max(f.degree_in(g), 0) for g in own) for f in equations)
        # A derivative has one degree fewer in one of the groups, which that may be is open.
        degrees = tops if len(own) > 1 else tuple((max(top - 1, 0),) for (top,) in tops)
        return cls(n, own, tops, degrees)

    @property
    def size(self) -> int:
        return len(self.groups) + 2 * self.n

    @property
    def vector(self) -> range:
        """Coordinates of v."""
        return range(len(self.groups) + self.n, self.size)

    @property
    def coordinates(self) -> tuple[tuple[int, ...], ...]:
        """Homogeneous coordinates of each group of x."""
        return coordinates_of_groups(self.groups)

    def homogenize(self, f: Polynomial, degrees: Sequence[int], v: int | None = None) -> Terms:
        """A polynomial in x of these degrees, times a coordinate of v if one is given."""
        last = [0] * self.n
        if v is not None:
            last[v] = 1
        terms: Terms = {}
        for e, c in f.terms.items():
            pairs = zip(degrees, self.groups, strict=True)
            missing = (top - sum(e[i] for i in group) for top, group in pairs)
            terms[(*missing, *e, *last)] = c
        return terms

    def compile(self, rows: Sequence[Sequence[tuple[int, Terms]]]) -> CompiledRows:
        """The curve's equations and rows linear in v, as parts of a homotopy."""
        groups = (*self.coordinates, tuple(self.vector))
        degrees = [(*tops, 0) for tops in self.tops] + [(*own, 1) for own in self.degrees]
        infinity = tuple(range(len(self.groups)))
        parts = tuple(tuple(row) for row in rows)
        return CompiledRows(self.size, parts, groups, infinity, np.array(degrees))

    @property
    def start_terms(self) -> int:
        """Number of terms of all start rows together."""
        total = 0
        for own in self.degrees:
            terms = self.n
            for top, group in zip(own, self.groups, strict=True):
                terms *= comb(top + len(group), top)
            total += terms
        return total


def can_be_tracked(equations: Sequence[Polynomial], groups: Sequence[Sequence[int]]) -> bool:
    """Whether start rows are short enough."""
    return bool(equations) and _Layout.of(equations, groups).start_terms <= MOST_TERMS


def find_critical_points(
    fibres: Sequence[Fibre],
    equations: Sequence[Polynomial],
    groups: Sequence[Sequence[int]],
    form: np.ndarray,
    rng: np.random.Generator,
    run: Run,
) -> CriticalPoints:
    """All finite points of a curve at which a form is critical or its equations are singular.

    Args:
        fibres: the curve's points on one slice.
        equations: one fewer than variables, real, regular at general points of the curve.
        groups: of the variables, or none.
        form: real, shape ``(n,)``.

    Raises:
        FibreError: if a path fails, or zeros are not there with their conjugates.
    """
    layout = _Layout.of(equations, groups)
    sizes = fibres[0].sizes[1:]
    count, n = len(equations), layout.n
    kernels = _random(rng, count, n) / sizes
    factors = {
        (i, g, k): _random(rng, 1, 1 + len(group))[0] / [1.0, *sizes[list(group)]]
        for i, own in enumerate(layout.degrees)
        for g, group in enumerate(layout.groups)
        for k in range(own[g])
    }
    rows: list[list[tuple[int, Terms]]] = [
        [(0, layout.homogenize(f, tops))] for f, tops in zip(equations, layout.tops, strict=True)
    ]
    for i, (f, own) in enumerate(zip(equations, layout.degrees, strict=True)):
        forms = [(layout.coordinates[g], c) for (j, g, _), c in factors.items() if j == i]
        goal: Terms = {}
        for v in range(n):
            goal |= layout.homogenize(f.derivative(v), own, v)
        # Of one size with the goal: else a row is all but the goal's as soon as a path begins.
        size = max(abs(complex(c)) for c in goal.values())
        product = _multiply_forms([*forms, (layout.vector, kernels[i])], layout.size)
        start = {e: size * c for e, c in product.items()}
        rows.append([(1, start), (2, goal)])
    critical = np.zeros((1, layout.size), dtype=complex)
    critical[0, list(layout.vector)] = form
    gamma = complex(unit_complex(rng))
    parts = (1.0, 0.0), (0.0, gamma), (1.0, -1.0)
    homotopy = Homotopy(layout.compile(rows), critical, None, parts)
    starts = _start_pairs(layout, fibres, factors, kernels, form, rng, run)
    paths = track(homotopy, starts, settings=run.settings, threads=run.threads)
    return _critical_points(layout, paths)


def _random(rng: np.random.Generator, rows: int, columns: int) -> np.ndarray:
    return np.exp(2j * np.pi * rng.random((rows, columns)))


def _multiply_forms(forms: Sequence[tuple[Sequence[int], np.ndarray]], size: int) -> Terms:
    """The product of linear forms in some of the coordinates each."""
    terms: dict[Exponents, complex] = {(0,) * size: 1 + 0j}
    for places, coefficients in forms:
        longer: dict[Exponents, complex] = {}
        for e, value in terms.items():
            for i, c in zip(places, coefficients.tolist(), strict=True):
                higher = (*e[:i], e[i] + 1, *e[i + 1 :])
                longer[higher] = longer.get(higher, 0) + value * c
        terms = longer
    return dict(terms)


def _start_pairs(
    layout: _Layout,
    fibres: Sequence[Fibre],
    factors: dict[tuple[int, int, int], np.ndarray],
    kernels: np.ndarray,
    form: np.ndarray,
    rng: np.random.Generator,
    run: Run,
) -> np.ndarray:
    """Where the start rows vanish: a factor in x of one, on the curve, and those in v of others.

    Raises:
        FibreError: if paths to slices in a group fail, or not as many arrive everywhere.
    """
    begun: dict[int, Sequence[Fibre]] = {}
    result = []
    for (i, g, _), factor in factors.items():
        row = np.zeros((1, 1 + layout.n), dtype=complex)
        row[0, [0, *(1 + j for j in layout.groups[g])]] = factor
        gamma = complex(unit_complex(rng))
        found = move(begun.get(g, fibres), row, gamma, run, endgame=g not in begun)
        for ends in found:
            finite = ends.finite if g not in begun else np.ones(len(ends), dtype=bool)
            if ends.failed.any() or not ends.regular[finite].all():
                raise FibreError("a path to a slice in some of the variables failed")
        found = [ends.without(np.flatnonzero(~ends.regular)) for ends in found]
        begun.setdefault(g, [ends.fibre() for ends in found])
        others = np.delete(kernels, i, axis=0)
        v = np.linalg.svd(np.vstack([others, form]))[2][-1].conj()
        x = np.vstack([ends.x for ends in found])
        ones = np.ones((len(x), len(layout.groups)))
        result.append(np.hstack([ones, x, np.tile(v, (len(x), 1))]))
    return np.vstack(result) if result else np.zeros((0, layout.size), dtype=complex)


def _critical_points(layout: _Layout, paths: Paths) -> CriticalPoints:
    """The finite ends, each once.

    Raises:
        FibreError: if a path failed, or ends are not there with their conjugates.
    """
    if len(paths.where(PathStatus.FAILED)):
        raise FibreError("a path to a critical point failed")
    ended = paths.where(PathStatus.REGULAR, PathStatus.SINGULAR)
    x = np.empty((len(ended), layout.n), dtype=complex)
    for group, (dividing, *places) in zip(layout.groups, layout.coordinates, strict=True):
        x[:, list(group)] = paths.points[ended][:, places] / paths.points[ended][:, [dividing]]
    errors = np.maximum(paths.accuracy[ended], ROUNDED)
    if not np.isfinite(x).all() or not np.isfinite(errors).all():
        raise FibreError("a path to a critical point failed")
    together = clusters(x, errors)
    points = np.array([x[own].mean(axis=0) for own in together]).reshape(-1, layout.n)
    radii = np.array([errors[own].max() for own in together])
    multiplicities = np.array([len(own) for own in together], dtype=int)
    real = np.linalg.norm(points.imag, axis=1) <= radii_of_balls(points, radii)
    if not conjugates_present(points, radii, multiplicities, real):
        raise FibreError("critical points are not there with their conjugates: paths were lost")
    return CriticalPoints(points, radii, multiplicities, real, len(paths) - len(ended))
