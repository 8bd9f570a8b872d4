"""Components discovered from random starting points, where a complete decomposition is too large.

Newton's method leads to a generic point of some component. The corank of the Jacobian there is its
dimension if the component is reduced; else it is the largest one for which deflation makes the
point regular on a slice. All points move to one slice for each dimension, where loops complete the
components. Nothing says that all components were found.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from nag.algebra.symmetry import SignedPermutation, check_symmetry
from nag.algebra.system import PolynomialSystem
from nag.decomposition.final_checks import checked_witness_set
from nag.decomposition.reduction import Reduction
from nag.decomposition.splitting import split
from nag.decomposition.superset import Progress, forbidden
from nag.decomposition.symmetric_images import in_orbits
from nag.decomposition.trace import digits_of_evidence
from nag.witness.cutting import NEARLY_SINGULAR, ON, Cut, Equations
from nag.witness.fibres import Fibre, Tracker, admit, carried
from nag.witness.gauss_newton import CLOSE, descend, polish
from nag.witness.membership import Membership, is_member
from nag.witness.points import Points
from nag.witness.slices import complex_normal, random_rows, rows_through, unit_complex
from nag.witness.witness import Decomposition, PathCounts, Status, WitnessSet

STARTS = 100
ATTEMPTS = 3
# Residuals to which points of non-reduced components are brought before they are deflated.
DEEP = 1e-14
# Points that no deflation made regular, after which no more are tried: each costs seconds.
MOST_REFUSALS = 3


def _local(
    x: np.ndarray,
    dimensions: Iterable[int],
    accuracy: float,
    deflate: bool,
    pools: Mapping[int, Points],
    equations: Equations,
    rng: np.random.Generator,
) -> tuple[Fibre, np.ndarray] | None:
    """A slice through a point, and the fibre that has it as a regular point there."""
    for d in dimensions:
        rows = rows_through(rng, d, x)
        cuts = pools[d].cuts if d in pools else ()
        fibres = [Fibre(c, d, np.zeros((0, c.n + c.aux), dtype=complex)) for c in cuts]
        if admit(x, accuracy, fibres, equations, rows, rng, deflate):
            (fibre,) = (f for f in fibres if len(f))
            return fibre, rows
    return None


def _on_rows(
    fibre: Fibre, rows: np.ndarray, target: np.ndarray, rng: np.random.Generator, tracker: Tracker
) -> tuple[np.ndarray | None, PathCounts]:
    """The point of a fibre of one on the common slice of its dimension."""
    counts = PathCounts()
    if fibre.dimension == 0:
        return fibre.points[0], counts
    for _attempt in range(ATTEMPTS):
        there, spent = carried([fibre], rows, target, complex(unit_complex(rng)), tracker)
        counts += spent
        if there is not None:
            return there[0].points[0], counts
    return None, counts


def by_sampling(
    system: PolynomialSystem,
    *,
    seed: int = 0,
    starts: int = STARTS,
    threads: int = 1,
    settings: str = "default",
    progress: Progress | None = None,
    symmetries: Sequence[SignedPermutation] = (),
) -> Decomposition:
    """The irreducible components that Newton's method finds from ``starts`` random points.

    Every component that is reported has passed the same checks as in a complete decomposition, but
    others may be missing: ``complete`` is False, whatever was found.

    Args:
        system: as for `nag.decomposition.decompose`.
        starts: number of starting points.
        progress: called with a stage's name, the step reached and the number of steps.
        symmetries: as for `nag.decomposition.decompose`; what they carry a component to is found
            with it.

    Raises:
        nag.algebra.symmetry.SymmetryError: if one of ``symmetries`` does not keep the equations.
    """
    for symmetry in symmetries:
        check_symmetry(system, symmetry)
    rng = np.random.default_rng([seed, 7])
    tracker = Tracker(settings, threads)
    reduction = Reduction.of(system)
    equations = reduction.equations
    flag = random_rows(rng, reduction.n, reduction.n)
    pools: dict[int, Points] = {}
    hits: dict[int, list[int]] = {}
    counts, arrived, refused = PathCounts(), 0, 0
    for k in range(starts):
        if progress is not None:
            progress("sampling", k, starts)
        start = complex_normal(rng, (reduction.n,)) * 2 ** rng.uniform(-2, 1)
        x = descend(equations.evaluator, start)
        if x is None or forbidden(reduction.nonzero, x[None], np.array([CLOSE]))[0]:
            continue
        found, spent = _simple_point(x, pools, equations, flag, rng, tracker)
        counts += spent
        if found is None and refused < MOST_REFUSALS:
            found, spent = _multiple_point(x, pools, equations, flag, rng, tracker)
            counts += spent
            refused += found is None
        if found is not None:
            d, cut, z = found
            arrived += 1
            known = pools.get(d, Points(flag[:d]))
            place = known.place(z[: cut.n])
            if place is None:
                pools[d] = known.with_point(cut, z)
                hits.setdefault(d, []).append(1)
            else:
                hits[d][place] += 1
    evidence = digits_of_evidence(system.polynomials)
    components: list[WitnessSet] = []
    above: list[Fibre] = []
    once = 0
    for d in sorted(pools, reverse=True):
        found = split(pools[d], (), evidence, rng, tracker, progress=progress)
        counts += found.counts
        sets, here = [], []
        for each in found.classes:
            fibres, _ = found.points.fibres(each.indices)
            embedded, spent = _is_embedded(fibres[0], above, flag, rng, tracker)
            counts += spent
            if embedded:
                continue
            component, spent = checked_witness_set(each, found.points, reduction, rng, tracker)
            counts += spent
            sets.append(component)
            here += fibres
            once += sum(hits[d][i] for i in each.indices if i < len(hits[d])) == 1
        above += here
        components += sorted(sets, key=lambda c: c.degree)
    notes = [
        f"found by sampling: Newton's method arrived at a component from {arrived} of {starts} "
        "random points; components may be missing"
    ]
    if once:
        notes.append(f"{once} of {len(components)} components were met only once")
    if refused:
        notes.append(f"{refused} singular points could not be made regular")
    whole = [c for c in components if c.status is Status.IRREDUCIBLE]
    if symmetries and whole:
        try:
            options = {"seed": seed, "threads": threads, "settings": settings}
            orbits = in_orbits(system, whole, symmetries, **options)
        except ValueError as error:
            notes.append(f"orbits of the symmetries are not known: {error}")
        else:
            unmet = sum(c.orbit for c in orbits) - len(whole)
            if unmet:
                notes.append(f"{unmet} components were found by symmetry only")
            components = [*orbits, *(c for c in components if c.status is not Status.IRREDUCIBLE)]
            components.sort(key=lambda c: (-c.dimension, c.degree))
    return Decomposition(
        system=system,
        components=tuple(components),
        paths=counts,
        seed=seed,
        settings=settings,
        order=(),
        complete=False,
        notes=tuple(notes),
    )


def _simple_point(
    x: np.ndarray,
    pools: Mapping[int, Points],
    equations: Equations,
    flag: np.ndarray,
    rng: np.random.Generator,
    tracker: Tracker,
) -> tuple[tuple[int, Cut, np.ndarray] | None, PathCounts]:
    """Dimension, cut and point on the common slice, from a point near a reduced component."""
    if not equations.polynomials:
        d = equations.n
        cut = pools[d].cuts[0] if d in pools else Cut(d, 0, ())
        return (d, cut, np.linalg.solve(flag[:, 1:], -flag[:, 0])), PathCounts()
    zero = polish(equations.evaluator, x)
    if not zero.converged:
        return None, PathCounts()
    return regular_on_flag(
        zero.x, [zero.corank], 1e-12, False, pools, equations, flag, rng, tracker
    )


def _multiple_point(
    x: np.ndarray,
    pools: Mapping[int, Points],
    equations: Equations,
    flag: np.ndarray,
    rng: np.random.Generator,
    tracker: Tracker,
) -> tuple[tuple[int, Cut, np.ndarray] | None, PathCounts]:
    """The same from a point near a component that is not reduced."""
    near = descend(equations.evaluator, x, close=DEEP)
    if near is None:
        return None, PathCounts()
    s = np.linalg.svd(equations.evaluator.balanced_jacobian(near), compute_uv=False)
    rank = int(np.sum(s > NEARLY_SINGULAR * max(1.0, s.max(initial=0.0))))
    below = range(len(near) - rank - 1, -1, -1)
    return regular_on_flag(near, below, 1e-7, True, pools, equations, flag, rng, tracker)


def regular_on_flag(
    x: np.ndarray,
    dimensions: Iterable[int],
    accuracy: float,
    deflate: bool,
    pools: Mapping[int, Points],
    equations: Equations,
    flag: np.ndarray,
    rng: np.random.Generator,
    tracker: Tracker,
) -> tuple[tuple[int, Cut, np.ndarray] | None, PathCounts]:
    """Dimension, cut and point on the common slice of a component through ``x``.

    Args:
        x: a solution.
        dimensions: those that the component may have; the first fits in which ``x`` is regular.
        accuracy: relative error of ``x``.
        deflate: whether deflation may make it regular.
        pools: points found so far, by dimension.
        flag: the common slices, one row for each dimension.
    """
    local = _local(x, dimensions, accuracy, deflate, pools, equations, rng)
    if local is None:
        return None, PathCounts()
    fibre, rows = local
    d = fibre.dimension
    z, counts = _on_rows(fibre, rows, flag[:d], rng, tracker)
    # A cut that leaves out an equation which only seems to hold gives itself away elsewhere.
    if z is None or equations.evaluator.residuals(z[None, : fibre.cut.n]).max(initial=0.0) > ON:
        return None, counts
    return (d, fibre.cut, z), counts


def _is_embedded(
    fibre: Fibre,
    above: Sequence[Fibre],
    flag: np.ndarray,
    rng: np.random.Generator,
    tracker: Tracker,
) -> tuple[bool, PathCounts]:
    """Whether a set that deflation was needed for lies on one of higher dimension."""
    counts = PathCounts()
    if not fibre.cut.deflated:
        return False, counts
    for d in sorted({f.dimension for f in above}):
        higher = [f for f in above if f.dimension == d]
        answer, spent = is_member(fibre.x[0], 1e-12, higher, flag, rng, tracker)
        counts += spent
        if answer is Membership.MEMBER:
            return True, counts
    return False, counts
