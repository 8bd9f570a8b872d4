"""The last checks: of a class of points that is to be a component, and of an answer as a whole."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations_with_replacement, permutations

import flint
import numpy as np

from nag.algebra.system import PolynomialSystem
from nag.decomposition.reduction import Reduction
from nag.decomposition.splitting import Class
from nag.numerics.double_ranks import SINGULAR, numerical_corank
from nag.numerics.doubles import beyond_doubles
from nag.numerics.zero_values import ON
from nag.tracking.run import Run
from nag.witness.close_points import CLOSE, CLOSE_AFAR, close_pairs, follow_slice
from nag.witness.confirm import is_confirmed, zero_in_digits
from nag.witness.cutting import Equations
from nag.witness.cutting_in_digits import corank_in_digits
from nag.witness.exact_points import SharpPoints, carry_radii, sharpen_points
from nag.witness.fibres import Fibre, move
from nag.witness.frame import Frame
from nag.witness.multiplicity import multiplicity
from nag.witness.points import Points, with_fine
from nag.witness.slices import complex_normal, unit_complex
from nag.witness.witness import Decomposition, PathCounts, Slice, Status, WitnessSet

# Multidegrees are counted only where so many choices of groups are enough.
MOST_MULTIDEGREES = 100


def judge_components(
    system: PolynomialSystem,
    components: Sequence[WitnessSet],
    paths: PathCounts,
    run: Run,
    notes: Sequence[str] = (),
    order: Sequence[int] = (),
) -> Decomposition:
    """A decomposition: complete exactly where every component is confirmed and nothing is noted.

    Components with points whose coordinates are no doubles are left out, and noted.
    """
    fitting = [c for c in components if np.isfinite(c.points).all()]
    if len(fitting) < len(components):
        notes = [*notes, beyond_doubles("components")]
        components = fitting
    return Decomposition(
        system=system,
        components=tuple(components),
        paths=paths,
        seed=run.seed,
        settings=run.settings,
        order=tuple(order),
        complete=not notes and all(c.status is Status.IRREDUCIBLE for c in components),
        notes=tuple(dict.fromkeys(notes)),
    )


def choose_groups(groups: Sequence[Sequence[int]], d: int) -> list[tuple[int, ...]] | None:
    """From which groups of variables d of them may be fixed; None where that is not asked for."""
    choices = list(combinations_with_replacement(range(len(groups)), d))
    choices = [c for c in choices if all(c.count(g) <= len(groups[g]) for g in c)]
    return choices if groups and len(choices) <= MOST_MULTIDEGREES else None


def multidegree_of(degrees: Mapping[tuple[int, ...], int], groups: int, d: int) -> np.ndarray:
    """The multidegree as a symmetric array, by the degrees for each choice of d groups."""
    whole = np.zeros((groups,) * d, dtype=int)
    for choice, degree in degrees.items():
        for place in set(permutations(choice)):
            whole[place] = degree
    return whole


def _multidegree(
    fibres: Sequence[Fibre],
    groups: Sequence[Sequence[int]],
    frame: Frame,
    rng: np.random.Generator,
    run: Run,
) -> tuple[np.ndarray | None, PathCounts]:
    """Numbers of points with groups fixed at random values, by moving the slice there."""
    d, counts = fibres[0].dimension, PathCounts()
    choices, degrees = choose_groups(groups, d), {}
    if choices is None:
        return None, counts
    for choice in choices:
        A = np.zeros((d, len(frame.t)), dtype=complex)
        for row, g in enumerate(choice):
            A[row, list(groups[g])] = complex_normal(rng, (len(groups[g]),))
        target = frame.pulled_back(A, complex_normal(rng, (d,)))
        finite = 0
        if d == 0 or np.linalg.matrix_rank(target[:, 1:]) == d:
            gamma = complex(unit_complex(rng))
            for ends in move(fibres, target, gamma, run, endgame=True):
                counts += ends.counts
                if ends.failed.any():
                    return None, counts
                finite += int(ends.finite.sum())
        degrees[choice] = finite
    return multidegree_of(degrees, len(groups), d), counts


def _coranks(equations: Equations, fibre: Fibre, rng: np.random.Generator) -> list[int]:
    """Coranks of the Jacobian at the points of a fibre.

    Where the equations cut the component in regular points, and doubles say otherwise, as they do
    where coordinates differ much in size, digits decide; of points that are close to others, they
    decide in any case.
    """
    d, rows, result, regular = fibre.dimension, fibre.rows, [], not fibre.cut.deflated
    matrices = equations.evaluator.balanced_jacobians(fibre.x)
    singular = np.linalg.svd(matrices, compute_uv=False)
    for i, (point, s) in enumerate(zip(fibre.x, singular, strict=True)):
        digits = zero_in_digits(fibre, i) if i in fibre.fine else None
        if digits is not None:
            # A zero that they prove to be simple is on a set that its cut says the dimension of.
            x = digits.first(fibre.cut.n).centre
            result.append(d if regular else corank_in_digits(equations.polynomials, x))
            continue
        corank = numerical_corank(s, len(point), SINGULAR)
        if regular and corank != d and multiplicity(equations.polynomials, rows, point, rng) == 1:
            corank = d
        result.append(corank)
    return result


@dataclass(frozen=True, eq=False)
class Examined:
    """Points on one slice, examined together before they are reported as those of components.

    Attributes:
        rows: the slice, in the coordinates in which equations are solved; cut: in the original.
        numbers: indices of the points among all of their dimension, shape ``(P,)``.
        inner: the points in the coordinates in which equations are solved.
        lifted: in the original ones.
        coranks, residuals: of the points, shape ``(P,)``.
    """

    reduction: Reduction
    rows: np.ndarray
    cut: Slice
    numbers: np.ndarray
    inner: SharpPoints
    lifted: SharpPoints
    coranks: np.ndarray
    residuals: np.ndarray

    def only(self, indices: np.ndarray) -> Examined:
        """Those that have one of these indices, in an order that does not depend on them."""
        asked = np.zeros(1 + max(self.numbers.max(initial=-1), indices.max(initial=-1)), dtype=bool)
        asked[indices] = True
        places = self.inner.order(np.flatnonzero(asked[self.numbers]))
        return replace(
            self,
            numbers=self.numbers[places],
            inner=self.inner.only(places),
            lifted=self.lifted.only(places),
            coranks=self.coranks[places],
            residuals=self.residuals[places],
        )

    @classmethod
    def of(
        cls,
        points: Points,
        classes: Sequence[Class],
        reduction: Reduction,
        rng: np.random.Generator,
    ) -> Examined:
        """The points of some classes.

        A slice of other coordinates is rounded on its way to the original ones, if these have
        another origin, and the points on it are found anew; those that are close to others there
        follow it in their digits.
        """
        frame = reduction.frame
        cut = frame.slice(points.rows)
        close = CLOSE if frame.exact else CLOSE_AFAR
        if not frame.is_plain:
            far = frame.points(points.x)
            near = reduction.natural.without_scales.points(far)
            points = points.with_digits([*close_pairs(near), *close_pairs(far, close)])
        by_cuts = points.fibres(np.concatenate([each.indices for each in classes]))
        own = np.concatenate([indices for _, indices in by_cuts])
        inner = sharpen_points([fibre for fibre, _ in by_cuts], points.exact.only(own))
        there = [_lift_fibre(fibre, cut.rows, reduction) for fibre in inner.fibres]
        if not frame.is_plain:
            there = with_fine(there, close)
        if not frame.exact:
            there = [_on_slice(fibre) for fibre in there]
        if frame.is_plain:
            radii, first = [], 0
            for fibre in inner.fibres:
                own_radii = inner.radii[first : first + len(fibre)]
                radii.append(carry_radii(frame, fibre.x, own_radii))
                first += len(fibre)
            lifted = SharpPoints(tuple(there), np.vstack(radii), inner.digits)
        else:
            lifted = sharpen_points(there)
        coranks = np.array([k for f in inner.fibres for k in _coranks(reduction.equations, f, rng)])
        # Residuals that are rounding errors depend on what is evaluated together.
        at_points = [reduction.original.residuals(fibre.x) for fibre in lifted.fibres]
        residuals = np.vstack(at_points).max(axis=1, initial=0.0)
        return cls(reduction, points.rows, cut, own, inner, lifted, coranks, residuals)


def _on_slice(fibre: Fibre) -> Fibre:
    """A fibre whose close points are beside its slice, these on it."""
    polynomials = fibre.cut.polynomials
    fine = {i: follow_slice(polynomials, fibre.rows, point) for i, point in fibre.fine.items()}
    return replace(fibre, fine=fine)


def _lift_fibre(fibre: Fibre, rows: np.ndarray, reduction: Reduction) -> Fibre:
    """A fibre in the original coordinates, where its slice is ``rows``."""
    points = np.hstack([reduction.frame.points(fibre.x), fibre.points[:, fibre.cut.n :]])
    fine = {i: reduction.lifted_fine(each) for i, each in fibre.fine.items()}
    return Fibre(reduction.lifted(fibre.cut), rows, points, fine)


def _smallest(fibres: Sequence[Fibre]) -> np.ndarray | Sequence[flint.acb]:
    """The smallest point of fibres, in digits where it is close to others."""
    sizes = [np.linalg.norm(fibre.x, axis=1) for fibre in fibres]
    k = int(np.argmin([own.min() for own in sizes]))
    fibre, i = fibres[k], int(sizes[k].argmin())
    digits = zero_in_digits(fibre, i) if i in fibre.fine else None
    return fibre.x[i] if digits is None else digits.first(fibre.cut.n).centre


def check_class(
    found: Class,
    examined: Examined,
    rng: np.random.Generator,
    run: Run,
    scheme: bool = True,
) -> tuple[WitnessSet, PathCounts]:
    """A class of points as a witness set, after the final checks.

    Without ``scheme`` the set need not be a component of the scheme of the equations; then its
    multiplicity is 1 if it is a reduced one, and 0, not known, otherwise.
    """
    reduction, rows, counts = examined.reduction, examined.rows, PathCounts()
    examined = examined.only(found.indices)
    d, reduced, groups = len(rows), reduction.equations, reduction.system.groups
    chosen, lifted, coranks = examined.inner.fibres, examined.lifted, examined.coranks.tolist()
    residual = float(examined.residuals.max(initial=0.0))
    reasons = [found.reason] if found.reason else []
    if residual > ON:
        reasons.append("a point does not satisfy all equations")
    if not is_confirmed(chosen[0], 0, reduced.polynomials):
        reasons.append("a point does not satisfy all equations in 100 digits: zeros too close")
    if len(set(coranks)) > 1:
        reasons.append("the corank of the Jacobian differs between its points")
    multiple = int(coranks[0] == d)
    if scheme and not multiple:
        multiple = multiplicity(reduced.polynomials, rows, _smallest(chosen), rng)
    if scheme and coranks[0] != d and not chosen[0].cut.deflated:
        reasons.append("its points are regular and singular at once: zeros too close")
    if scheme and coranks[0] != d and multiple == 1:
        reasons.append("its points are singular and of multiplicity 1: zeros too close")
    if scheme and multiple == 0:
        reasons.append("its multiplicity was not found")
    multidegree = None
    if groups:
        multidegree, counts = _multidegree(chosen, groups, reduction.frame, rng, run)
    return (
        WitnessSet(
            slice=examined.cut,
            points=lifted.x,
            multiplicity=multiple,
            status=Status.UNDECIDED if reasons else Status.IRREDUCIBLE,
            residual=residual,
            radii=lifted.radii,
            digits=lifted.digits,
            corank=coranks[0],
            multidegree=multidegree,
            orbit=1 + len(found.carriers),
            note="; ".join(reasons),
            images=found.carriers,
            fibres=lifted.fibres,
        ),
        counts,
    )
