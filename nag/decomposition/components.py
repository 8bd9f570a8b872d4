"""Numerical irreducible decomposition of the zero set of a polynomial system."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from nag.algebra.absolute_factors import is_absolutely_irreducible
from nag.algebra.elimination import eliminate_linear
from nag.algebra.evaluation import Evaluator
from nag.algebra.polynomial import Polynomial
from nag.algebra.symmetry import SignedPermutation, check_symmetry
from nag.algebra.system import PolynomialSystem
from nag.decomposition.branch_components import decompose_apart
from nag.decomposition.final_checks import checked_witness_set
from nag.decomposition.hypersurface import NEARER
from nag.decomposition.irreducible import Class
from nag.decomposition.isolated import contains, isolated_superset
from nag.decomposition.orbits import Action, Orbit, irreducible_orbits
from nag.decomposition.superset import Progress, intersection_order, witness_superset
from nag.numerics.scaling import scaled_terms, variable_scales
from nag.witness.cutting import Equations
from nag.witness.fibres import Tracker
from nag.witness.frame import Frame
from nag.witness.slices import random_rows
from nag.witness.witness import Decomposition, PathCounts, Status, WitnessSet

# An answer that is left open is tried again with other random numbers, if that is not too long.
ATTEMPTS = 3
MOST_PATHS = 20_000
# Coefficients of comparable size are left as they are: scales below this factor bring nothing.
LEAST_SCALE = 8


def scaled_system(system: PolynomialSystem) -> tuple[PolynomialSystem, np.ndarray]:
    """The system in coordinates that make its coefficients comparable, and their scales.

    Scales are powers of two, so that nothing is rounded; they are one where little is gained.
    """
    powers = variable_scales(system.polynomials, system.n)
    if 2 ** np.abs(powers).max(initial=0) < LEAST_SCALE:
        return system, np.ones(system.n)
    nonzero = [scaled_terms(f, powers) for f in system.nonzero]
    polynomials = [scaled_terms(f, powers) for f in system.polynomials]
    scaled = replace(
        system,
        polynomials=tuple(Polynomial(system.n, terms) for terms in polynomials),
        nonzero=tuple(Polynomial(system.n, terms) for terms in nonzero),
    )
    return scaled, 2.0**powers


def decompose(
    system: PolynomialSystem,
    *,
    seed: int = 0,
    threads: int = 1,
    settings: str = "default",
    progress: Progress | None = None,
    symmetries: Sequence[SignedPermutation] = (),
) -> Decomposition:
    """Decompose the zero set of ``system`` into irreducible components over the complex numbers.

    Where equations factor over the rationals, the parts that the system falls into are decomposed
    apart; zeros of polynomials in one variable, and of two equations in two, are isolated exactly
    where they are few. Otherwise linear equations are solved exactly first, and then equations are
    intersected one by one. Where doubts are left, slices and constants are drawn anew, and the
    least doubtful answer is given; a finite set of simple points may be found by solving the
    equations all at once. The same seed gives the same answer, byte for byte, whatever the number
    of threads.

    Args:
        system: the equations; components on which a polynomial of ``system.nonzero`` vanishes
            identically are left out.
        seed: of all random numbers.
        threads: for path tracking.
        settings: ``"fast"``, ``"default"`` or ``"careful"`` tracking.
        progress: called with a stage's name, the step reached and the number of steps.
        symmetries: signed permutations of the variables that keep the equations. Of the components
            that they carry into each other one is worked out and reported, with the size of its
            orbit; `nag.witness.expansion.expanded` lists the others.

    Raises:
        nag.algebra.symmetry.SymmetryError: if one of ``symmetries`` does not keep the equations.
    """
    for symmetry in symmetries:
        check_symmetry(system, symmetry)

    def whole(part: PolynomialSystem, kept: Sequence[SignedPermutation]) -> Decomposition:
        # A branch is not the scheme that was given; its multiplicities are of no interest.
        return _decompose_whole(part, seed, threads, settings, progress, kept, part is system)

    apart = decompose_apart(system, whole, symmetries, seed, threads, settings)
    return whole(system, symmetries) if apart is None else apart


def _decompose_whole(
    system: PolynomialSystem,
    seed: int,
    threads: int,
    settings: str,
    progress: Progress | None,
    symmetries: Sequence[SignedPermutation],
    scheme: bool,
) -> Decomposition:
    """The components of a system as it is, by attempts with different random numbers."""
    tracker = Tracker(settings, threads)
    answers: list[Decomposition] = []
    tracked = 0
    for attempt in range(ATTEMPTS):
        rng = np.random.default_rng([seed, attempt] if attempt else seed)
        answer = _decompose_once(system, rng, tracker, progress, symmetries, scheme)
        tracked += answer.paths.tracked
        answers.append(answer)
        if answer.complete or tracked > MOST_PATHS:
            break
    if not any(a.complete or a.dimension > 0 for a in answers) and tracked <= MOST_PATHS:
        rng = np.random.default_rng([seed, ATTEMPTS])
        answer = _decompose_once(system, rng, tracker, progress, symmetries, scheme, isolated=True)
        tracked += answer.paths.tracked
        if answer.complete and all(contains(answer, other) for other in answers):
            answers.append(answer)
    best = min(answers, key=lambda a: (not a.complete, _undecided(a), len(a.notes)))
    paths = replace(best.paths, tracked=tracked)
    return replace(best, paths=paths, seed=seed, settings=settings)


def _undecided(answer: Decomposition) -> int:
    return sum(c.status is Status.UNDECIDED for c in answer.components)


def _decompose_once(
    system: PolynomialSystem,
    rng: np.random.Generator,
    tracker: Tracker,
    progress: Progress | None,
    symmetries: Sequence[SignedPermutation],
    scheme: bool,
    isolated: bool = False,
) -> Decomposition:
    """One attempt; ``isolated``: at a finite set of simple points, all found at once."""
    elimination = eliminate_linear(system, graphs=False)
    reduced, frame = elimination.system, Frame.of(elimination)
    if not symmetries:
        reduced, scales = scaled_system(reduced)
        frame = frame.scaled(scales)
    actions = [
        Action.of(g, frame.T, frame.t, frame.positions) for g in symmetries if not g.is_identity
    ]
    order = intersection_order(reduced.polynomials)
    equations = [reduced.polynomials[i] for i in order]
    flag = random_rows(rng, reduced.n, reduced.n, NEARER)
    if isolated:
        superset = isolated_superset(reduced, rng, tracker)
    else:
        superset = witness_superset(
            equations, reduced.n, reduced.nonzero, flag, rng, tracker, progress
        )
    counts, notes = superset.counts, list(superset.notes)
    if superset.counts.failed:
        notes.append(f"{superset.counts.failed} paths failed; points may be missing")
    all_reduced = Equations(reduced.polynomials, reduced.n)
    all_original = Evaluator.of(system.polynomials, system.n)
    irreducible = len(equations) == 1 and is_absolutely_irreducible(equations[0], rng)
    components: list[WitnessSet] = []
    for d in sorted(superset.fibres, reverse=True):
        fibres, rows = superset.fibres[d], superset.flag[:d]
        if not fibres:
            continue
        if progress is not None:
            progress("splitting", len(components), 0)
        if irreducible:
            # What is proved exactly needs no loops and no trace.
            orbits = [Orbit(Class(np.arange(sum(map(len, fibres)))))]
            spent, doubts = PathCounts(), ()
        else:
            orbits, spent, doubts = irreducible_orbits(fibres, rows, actions, rng, tracker)
        counts += spent
        notes += [f"dimension {d}: {doubt}" for doubt in doubts]
        sets = []
        for orbit in orbits:
            component, spent = checked_witness_set(
                orbit.representative,
                fibres,
                rows,
                all_reduced,
                all_original,
                frame,
                system.groups,
                rng,
                tracker,
                scheme,
            )
            counts += spent
            size = 1 + len(orbit.carriers)
            sets.append(replace(component, orbit=size, images=orbit.carriers))
        sets.sort(key=lambda c: c.degree)
        components.extend(sets)
    undecided = any(c.status is Status.UNDECIDED for c in components)
    return Decomposition(
        system=system,
        components=tuple(components),
        paths=counts,
        seed=0,
        settings=tracker.settings,
        order=tuple(order),
        complete=not (undecided or notes),
        notes=tuple(notes),
    )
