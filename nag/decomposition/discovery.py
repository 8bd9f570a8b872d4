"""Components discovered from random starting points, where a complete decomposition is too large.

Newton's method leads to a generic point of some component. The corank of the Jacobian there is its
dimension if the component is reduced; else it is the largest one for which deflation makes the
point regular on a slice. All points move to one slice for each dimension, where those of one
component are recognised: monodromy loops find further points and join them, and the trace test says
when a component's are complete (Sommese, Verschelde & Wampler 2002). Nothing says that all
components were found.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from nag.algebra.elimination import eliminate_linear
from nag.algebra.evaluation import Evaluator
from nag.algebra.symmetry import SignedPermutation, check_symmetry
from nag.algebra.system import PolynomialSystem
from nag.decomposition.cutting import NEARLY_SINGULAR, ON, Cut, Equations
from nag.decomposition.fibres import Fibre, Tracker, admit, move
from nag.decomposition.final_checks import checked_witness_set
from nag.decomposition.frame import Frame
from nag.decomposition.gauss_newton import CLOSE, descend, polish
from nag.decomposition.irreducible import Class
from nag.decomposition.membership import Membership, is_member
from nag.decomposition.monodromy import carried
from nag.decomposition.slices import complex_normal, random_rows, rows_through, unit_complex
from nag.decomposition.superset import Progress, forbidden
from nag.decomposition.symmetric_images import in_orbits
from nag.decomposition.trace import is_linear, second_differences
from nag.decomposition.witness import Decomposition, PathCounts, Status, WitnessSet

STARTS = 100
ATTEMPTS = 3
# Loops after which a fibre that is not full is left undecided: 23 was the worst that was needed.
MOST_LOOPS = 60
# Points of a fibre nearer than this, relative to their size, are one.
SAME = 1e-8
# Residuals to which points of non-reduced components are brought before they are deflated.
DEEP = 1e-14
# Points that no deflation made regular, after which no more are tried: each costs seconds.
MOST_REFUSALS = 3
UNFINISHED = f"its trace is not linear after {MOST_LOOPS} loops: points are missing"


@dataclass(frozen=True, eq=False)
class _Pool:
    """Points of one dimension on a common slice, and which of them are known to belong together.

    Attributes:
        cuts: square systems that cut them.
        which: for each point, the index of its cut.
        points: with the unknowns that deflation added.
        labels: for each point, the smallest index of a point of the same component.
        hits: for each point, the number of starting points that led to it.
    """

    cuts: tuple[Cut, ...] = ()
    which: tuple[int, ...] = ()
    points: tuple[np.ndarray, ...] = ()
    labels: tuple[int, ...] = ()
    hits: tuple[int, ...] = ()

    def place(self, x: np.ndarray) -> int | None:
        """The index of the point at ``x``."""
        if not self.points:
            return None
        known = np.array([z[: len(x)] for z in self.points])
        distances = np.linalg.norm(known - x, axis=1)
        nearest = int(distances.argmin())
        return nearest if distances[nearest] < SAME * (1 + np.linalg.norm(x)) else None

    def arrived(self, cut: Cut, z: np.ndarray) -> _Pool:
        """The pool after a starting point led to ``z``."""
        place = self.place(z[: cut.n])
        if place is not None:
            hits = [h + (i == place) for i, h in enumerate(self.hits)]
            return replace(self, hits=tuple(hits))
        cuts = self.cuts if cut in self.cuts else (*self.cuts, cut)
        return self.extended(cuts, cuts.index(cut), z, len(self.points), 1)

    def extended(
        self, cuts: tuple[Cut, ...], which: int, z: np.ndarray, label: int, hits: int
    ) -> _Pool:
        """The pool with one more point."""
        return _Pool(
            cuts,
            (*self.which, which),
            (*self.points, z),
            (*self.labels, label),
            (*self.hits, hits),
        )

    def joined(self, i: int, j: int) -> _Pool:
        """The pool with the classes of two points made one."""
        low, high = sorted((self.labels[i], self.labels[j]))
        return replace(self, labels=tuple(low if k == high else k for k in self.labels))

    def fibres(self, indices: Sequence[int], d: int) -> tuple[list[Fibre], np.ndarray]:
        """The points of given indices by their cuts, and the indices in that order."""
        found, order = [], []
        for k, cut in enumerate(self.cuts):
            own = [i for i in indices if self.which[i] == k]
            if own:
                found.append(Fibre(cut, d, np.array([self.points[i] for i in own])))
                order += own
        return found, np.array(order, dtype=int)


def _local(
    x: np.ndarray,
    dimensions: Iterable[int],
    accuracy: float,
    deflate: bool,
    pools: Mapping[int, _Pool],
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
    for attempt in range(ATTEMPTS):
        used = Tracker("careful" if attempt else tracker.settings, tracker.threads)
        there, spent = carried([fibre], rows, target, complex(unit_complex(rng)), used)
        counts += spent
        if there is not None:
            return there[0].points[0], counts
    return None, counts


def _looped(
    pool: _Pool,
    active: Sequence[int],
    rows: np.ndarray,
    rng: np.random.Generator,
    tracker: Tracker,
) -> tuple[_Pool, PathCounts]:
    """The pool after a random loop: ends are new points, or join two classes."""
    counts = PathCounts()
    middle = random_rows(rng, len(rows), rows.shape[1] - 1)
    out, back = unit_complex(rng, 2)
    fibres, order = pool.fibres(active, len(rows))
    first = 0
    for fibre in fibres:
        own, first = order[first : first + len(fibre)], first + len(fibre)
        there = move(fibre, rows, middle, complex(out), tracker)
        half = Fibre(fibre.cut, fibre.dimension, there.points[there.regular])
        again = move(half, middle, rows, complex(back), tracker)
        counts += there.counts.repeatable + again.counts.repeatable
        origins = own[there.regular][again.regular]
        for i, z in zip(origins, again.points[again.regular], strict=True):
            place = pool.place(z[: fibre.cut.n])
            if place is None:
                pool = pool.extended(pool.cuts, pool.which[i], z, pool.labels[i], 0)
            else:
                pool = pool.joined(i, place)
    return pool, counts


def _linear_classes(
    pool: _Pool, active: Sequence[int], rows: np.ndarray, rng: np.random.Generator, tracker: Tracker
) -> tuple[set[int], PathCounts]:
    """Labels of the classes among ``active`` whose trace is linear, here and elsewhere."""
    fibres, order = pool.fibres(active, len(rows))
    labels = np.array(pool.labels)[order]
    passed = set(labels.tolist())
    counts = PathCounts()
    for elsewhere in (False, True):
        here, at = fibres, rows
        if elsewhere:
            at = random_rows(rng, len(rows), rows.shape[1] - 1)
            here, spent = carried(fibres, rows, at, complex(unit_complex(rng)), tracker)
            counts += spent
            if here is None:
                return set(), counts
        differences, spent = second_differences(here, at, rng, tracker)
        counts += spent
        if differences is None:
            return set(), counts
        passed = {label for label in passed if is_linear(differences[labels == label])}
        if not passed:
            break
    return passed, counts


def _completed(
    pool: _Pool,
    rows: np.ndarray,
    rng: np.random.Generator,
    tracker: Tracker,
    progress: Progress | None,
) -> tuple[_Pool, set[int], PathCounts]:
    """The pool with all points of its components, and the labels of those that are complete."""
    counts, complete = PathCounts(), set[int]()
    if len(rows) == 0:
        return pool, set(pool.labels), counts
    for k in range(MOST_LOOPS):
        if progress is not None:
            progress("completing", len(complete), len(set(pool.labels)))
        used = Tracker("careful" if k % 4 == 3 else tracker.settings, tracker.threads)
        active = [i for i, label in enumerate(pool.labels) if label not in complete]
        if not active:
            break
        before = pool
        pool, spent = _looped(pool, active, rows, rng, used)
        counts += spent
        changed = set(pool.labels[len(before.labels) :])
        changed |= {new for old, new in zip(before.labels, pool.labels, strict=False) if old != new}
        idle = [i for i in active if pool.labels[i] not in changed]
        if idle:
            passed, spent = _linear_classes(pool, idle, rows, rng, used)
            counts += spent
            complete |= passed
    return pool, complete, counts


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
    elimination = eliminate_linear(system, graphs=False)
    reduced, frame = elimination.system, Frame.of(elimination)
    equations = Equations(reduced.polynomials, reduced.n)
    avoid = Evaluator.of(reduced.nonzero, reduced.n)
    flag = random_rows(rng, reduced.n, reduced.n)
    pools: dict[int, _Pool] = {}
    counts, arrived, refused = PathCounts(), 0, 0
    for k in range(starts):
        if progress is not None:
            progress("sampling", k, starts)
        start = complex_normal(rng, (reduced.n,)) * 2 ** rng.uniform(-2, 1)
        x = descend(equations.evaluator, start)
        if x is None or forbidden(avoid, x[None], np.array([CLOSE]))[0]:
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
            pools[d] = pools.get(d, _Pool()).arrived(cut, z)
    everything = Evaluator.of(system.polynomials, system.n)
    components: list[WitnessSet] = []
    above: list[Fibre] = []
    once = 0
    for d in sorted(pools, reverse=True):
        pool, complete, spent = _completed(pools[d], flag[:d], rng, tracker, progress)
        counts += spent
        sets, here = [], []
        for label in sorted(set(pool.labels)):
            own = [i for i, other in enumerate(pool.labels) if other == label]
            fibres, _ = pool.fibres(own, d)
            embedded, spent = _is_embedded(fibres[0], above, flag, rng, tracker)
            counts += spent
            if embedded:
                continue
            reason = "" if label in complete else UNFINISHED
            component, spent = checked_witness_set(
                Class(np.arange(len(own)), reason),
                fibres,
                flag[:d],
                equations,
                everything,
                frame,
                system.groups,
                rng,
                tracker,
            )
            counts += spent
            sets.append(component)
            here += fibres
            once += sum(pool.hits[i] for i in own) == 1
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
    pools: Mapping[int, _Pool],
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
    return _found(zero.x, [zero.corank], 1e-12, False, pools, equations, flag, rng, tracker)


def _multiple_point(
    x: np.ndarray,
    pools: Mapping[int, _Pool],
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
    return _found(near, below, 1e-7, True, pools, equations, flag, rng, tracker)


def _found(
    x: np.ndarray,
    dimensions: Iterable[int],
    accuracy: float,
    deflate: bool,
    pools: Mapping[int, _Pool],
    equations: Equations,
    flag: np.ndarray,
    rng: np.random.Generator,
    tracker: Tracker,
) -> tuple[tuple[int, Cut, np.ndarray] | None, PathCounts]:
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
    if not fibre.cut.levels:
        return False, counts
    for d in sorted({f.dimension for f in above}):
        higher = [f for f in above if f.dimension == d]
        answer, spent = is_member(fibre.x[0], 1e-12, higher, flag, rng, tracker)
        counts += spent
        if answer is Membership.MEMBER:
            return True, counts
    return False, counts
