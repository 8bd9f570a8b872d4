"""Numerical irreducible decomposition of the zero set of a polynomial system."""

from __future__ import annotations

import numpy as np

from nag.algebra.elimination import eliminate_linear
from nag.algebra.evaluation import Evaluator
from nag.algebra.system import PolynomialSystem
from nag.decomposition.fibres import Tracker
from nag.decomposition.final_checks import checked_witness_set
from nag.decomposition.frame import Frame
from nag.decomposition.irreducible import irreducible_classes
from nag.decomposition.slices import random_rows
from nag.decomposition.superset import Progress, intersection_order, witness_superset
from nag.decomposition.witness import Decomposition, Status, WitnessSet


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
    reduced, frame = elimination.system, Frame.of(elimination)
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
            component, spent = checked_witness_set(
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
