"""Numerical irreducible decomposition of the zero set of a polynomial system."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations_with_replacement, permutations

import numpy as np

from nag.algebra.elimination import Elimination, eliminate_linear
from nag.algebra.evaluation import Evaluator
from nag.algebra.system import PolynomialSystem
from nag.decomposition.cutting import ON, numerical_corank, sharpen
from nag.decomposition.fibres import Fibre, Tracker, move
from nag.decomposition.irreducible import Class, irreducible_classes
from nag.decomposition.multiplicity import multiplicity
from nag.decomposition.slices import complex_normal, random_rows, unit_complex
from nag.decomposition.superset import Progress, intersection_order, witness_superset
from nag.decomposition.witness import Decomposition, PathCounts, Slice, Status, WitnessSet

# Multidegrees are counted only where so many choices of groups are enough.
MOST_MULTIDEGREES = 100


@dataclass(frozen=True, eq=False)
class _Frame:
    """How reduced coordinates sit in the original ones: ``x = T y + t``, and which y are slices."""

    T: np.ndarray
    t: np.ndarray
    positions: tuple[int, ...]

    @classmethod
    def of(cls, elimination: Elimination) -> _Frame:
        m = elimination.system.n
        T = np.zeros((len(elimination.images), m))
        t = np.zeros(len(elimination.images))
        for i, image in enumerate(elimination.images):
            for exponents, coefficient in image.terms.items():
                if any(exponents):
                    T[i, exponents.index(1)] = float(coefficient)
                else:
                    t[i] = float(coefficient)
        names = elimination.original_variables
        positions = tuple(names.index(v) for v in elimination.system.variables)
        return cls(T, t, positions)

    def points(self, y: np.ndarray) -> np.ndarray:
        return y @ self.T.T + self.t

    def slice(self, rows: np.ndarray) -> Slice:
        """A slice of the reduced space as one of the original space: its coordinates are kept."""
        A = np.zeros((len(rows), len(self.t)), dtype=complex)
        A[:, self.positions] = rows[:, 1:]
        return Slice(A, -rows[:, 0])

    def pulled_back(self, A: np.ndarray, b: np.ndarray) -> np.ndarray:
        """Rows on reduced homogeneous coordinates for ``A x = b``."""
        return np.hstack([(A @ self.t - b)[:, None], A @ self.T])


def _multidegree(
    fibres: Sequence[Fibre],
    rows: np.ndarray,
    groups: Sequence[Sequence[int]],
    frame: _Frame,
    rng: np.random.Generator,
    tracker: Tracker,
) -> tuple[np.ndarray | None, PathCounts]:
    """Numbers of points with groups fixed at random values, by moving the slice there."""
    d, counts = len(rows), PathCounts()
    choices = list(combinations_with_replacement(range(len(groups)), d))
    sizes = [len(g) for g in groups]
    choices = [c for c in choices if all(c.count(g) <= sizes[g] for g in c)]
    if not groups or len(choices) > MOST_MULTIDEGREES:
        return None, counts
    degrees = np.zeros((len(groups),) * d, dtype=int)
    for choice in choices:
        A = np.zeros((d, len(frame.t)), dtype=complex)
        for row, g in enumerate(choice):
            A[row, list(groups[g])] = complex_normal(rng, (sizes[g],))
        target = frame.pulled_back(A, complex_normal(rng, (d,)))
        finite = 0
        if d == 0 or np.linalg.matrix_rank(target[:, 1:]) == d:
            gamma = complex(unit_complex(rng))
            for fibre in fibres:
                ends = move(fibre, rows, target, gamma, tracker, endgame=True)
                counts += ends.counts
                if ends.failed.any():
                    return None, counts
                finite += int(ends.finite.sum())
        for place in set(permutations(choice)):
            degrees[place] = finite
    return degrees, counts


def _coranks(evaluator: Evaluator, x: np.ndarray) -> list[int]:
    result = []
    for point in x:
        s = np.linalg.svd(evaluator.balanced_jacobian(point), compute_uv=False)
        result.append(numerical_corank(s, len(point), 1e-9))
    return result


def _witness_set(
    found: Class,
    fibres: Sequence[Fibre],
    rows: np.ndarray,
    reduced: Evaluator,
    original: Evaluator,
    frame: _Frame,
    groups: Sequence[Sequence[int]],
    rng: np.random.Generator,
    tracker: Tracker,
) -> tuple[WitnessSet, PathCounts]:
    """A class of points as a witness set, after the final checks."""
    d, counts = len(rows), PathCounts()
    chosen, start = [], 0
    for fibre in fibres:
        local = found.indices[(found.indices >= start) & (found.indices < start + len(fibre))]
        mask = np.zeros(len(fibre), dtype=bool)
        mask[local - start] = True
        start += len(fibre)
        if mask.any():
            chosen.append(fibre.only(mask))
    points, steps = [], [0.0]
    for fibre in chosen:
        for z in fibre.points:
            sharpened = sharpen(fibre.cut.evaluator, rows, z)
            points.append(sharpened.z[: fibre.cut.n])
            steps.append(sharpened.step if np.isfinite(sharpened.step) else np.inf)
    y = np.array(points)
    x = frame.points(y)
    order = np.lexsort((x.imag[:, 0], x.real[:, 0])) if x.shape[1] else np.arange(len(x))
    y, x = y[order], x[order]
    residual = float(original.residuals(x).max(initial=0.0))
    coranks = _coranks(reduced, y)
    reasons = [found.reason] if found.reason else []
    if residual > ON:
        reasons.append("a point does not satisfy all equations")
    if len(set(coranks)) > 1:
        reasons.append("the corank of the Jacobian differs between its points")
    multiple = 1 if coranks[0] == d else multiplicity(reduced, rows, y[0])
    if multiple == 0:
        reasons.append("its multiplicity was not found")
    multidegree = None
    if groups:
        multidegree, counts = _multidegree(chosen, rows, groups, frame, rng, tracker)
    return (
        WitnessSet(
            slice=frame.slice(rows),
            points=x,
            multiplicity=multiple,
            status=Status.UNDECIDED if reasons else Status.IRREDUCIBLE,
            residual=residual,
            accuracy=max(*steps, np.finfo(float).eps),
            corank=coranks[0],
            multidegree=multidegree,
            note="; ".join(reasons),
        ),
        counts,
    )


def decompose(
    system: PolynomialSystem,
    *,
    seed: int = 0,
    threads: int = 1,
    settings: str = "default",
    progress: Progress | None = None,
) -> Decomposition:
    """Decompose the zero set of ``system`` into irreducible components over the complex numbers.

    Linear equations are solved exactly first. The same seed gives the same answer, byte for byte,
    whatever the number of threads.

    Args:
        system: the equations; components on which a polynomial of ``system.nonzero`` vanishes
            identically are left out.
        seed: of all random numbers.
        threads: for path tracking.
        settings: ``"fast"``, ``"default"`` or ``"careful"`` tracking.
        progress: called with a stage's name, the step reached and the number of steps.
    """
    rng = np.random.default_rng(seed)
    tracker = Tracker(settings, threads)
    elimination = eliminate_linear(system, graphs=False)
    reduced, frame = elimination.system, _Frame.of(elimination)
    order = intersection_order(reduced.polynomials)
    equations = [reduced.polynomials[i] for i in order]
    flag = random_rows(rng, reduced.n, reduced.n)
    superset = witness_superset(equations, reduced.n, reduced.nonzero, flag, rng, tracker, progress)
    counts, notes = superset.counts, list(superset.notes)
    if superset.counts.failed:
        notes.append(f"{superset.counts.failed} paths failed; points may be missing")
    all_reduced, all_original = (Evaluator.of(s.polynomials, s.n) for s in (reduced, system))
    components: list[WitnessSet] = []
    for d in sorted(superset.fibres, reverse=True):
        fibres, rows = superset.fibres[d], flag[:d]
        if not fibres:
            continue
        if progress is not None:
            progress("splitting", len(components), 0)
        classes, spent = irreducible_classes(fibres, rows, rng, tracker)
        counts += spent
        sets = []
        for found in classes:
            component, spent = _witness_set(
                found, fibres, rows, all_reduced, all_original, frame, system.groups, rng, tracker
            )
            counts += spent
            sets.append(component)
        sets.sort(key=lambda c: c.degree)
        components.extend(sets)
    undecided = any(c.status is Status.UNDECIDED for c in components)
    return Decomposition(
        system=system,
        components=tuple(components),
        paths=counts,
        seed=seed,
        settings=settings,
        order=tuple(order),
        complete=not (undecided or notes),
        notes=tuple(notes),
    )
