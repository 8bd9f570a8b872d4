"""The irreducible components through given points, with all their witness points.

Where another model of the same set was decomposed, one point of each of its components is enough:
loops find the other points on the slice, and the trace says when these are all.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem
from nag.decomposition.assembly import assembled
from nag.decomposition.common_slices import CommonSlices, Start
from nag.decomposition.reduction import Reduction
from nag.decomposition.sign_orbits import keeps, sign_orbit
from nag.decomposition.symmetric_images import in_orbits
from nag.numerics.small_values import LEAST
from nag.witness.fibres import Fibre, Tracker
from nag.witness.gauss_newton import polish
from nag.witness.witness import Decomposition, PathCounts, Status, WitnessSet

# Relative error of a point that Newton's method could not sharpen.
ROUGH = 1e-7


def best_lifted(
    component: WitnessSet, lift: Callable[[np.ndarray], Sequence[complex] | np.ndarray]
) -> np.ndarray:
    """Of a component's witness points, the one that is smallest in other coordinates.

    Each of them leads to the whole component, but one that is large there, where a norm nearly
    vanishes or a slide goes far, is known to fewer digits.

    Args:
        component: in its own coordinates.
        lift: from a point to its other coordinates.
    """
    lifted = [np.array(lift(x), dtype=complex) for x in component.points]
    sizes = [float(np.abs(point).max(initial=0.0)) for point in lifted]
    return lifted[int(np.argmin(np.nan_to_num(sizes, nan=np.inf)))]


def components_through_points(
    system: PolynomialSystem,
    starts: Sequence[tuple[int, np.ndarray]],
    *,
    seed: int = 0,
    threads: int = 1,
    settings: str = "default",
    symmetries: Sequence[SignedPermutation] = (),
) -> Decomposition:
    """The components through solutions that are generic on them.

    Args:
        system: the equations.
        starts: for each component at least one point, with the component's dimension there.
        seed: of all random numbers.
        threads: for path tracking.
        settings: ``"fast"``, ``"default"`` or ``"careful"`` tracking.
        symmetries: signed permutations that keep the equations; of each orbit of components one is
            worked out.

    Returns:
        A decomposition that is complete if every point led to a component that was confirmed; it
        says nothing of components through none of the points.
    """
    rng = np.random.default_rng([seed, 11])
    tracker = Tracker(settings, threads)
    reduction = Reduction.of(system)
    slices, counts, notes = _on_common_slices(starts, reduction, rng, tracker)
    found = assembled(slices.points, reduction, rng, tracker)
    counts += found.counts
    components: list[WitnessSet] = []
    for piece in found.pieces:
        component, d = piece.component, piece.component.dimension
        if component.status is Status.IRREDUCIBLE and symmetries:
            whole, spent = _with_orbit(
                component, piece.fibres, slices.flag[:d], reduction, symmetries, rng, tracker
            )
            counts += spent
            if whole is None:
                notes.append(f"the orbit of a component of dimension {d} is not known")
            component = component if whole is None else whole
        components.append(component)
    return Decomposition(
        system=system,
        components=tuple(components),
        paths=counts,
        seed=seed,
        settings=settings,
        order=(),
        complete=found.complete and not notes,
        notes=(*notes, *found.notes),
    )


def _on_common_slices(
    starts: Sequence[tuple[int, np.ndarray]],
    reduction: Reduction,
    rng: np.random.Generator,
    tracker: Tracker,
) -> tuple[CommonSlices, PathCounts, list[str]]:
    """A point of each component on the common slice of its dimension, and what was not found."""
    slices = CommonSlices.random(reduction.equations, rng)
    counts, notes = PathCounts(), []
    for d, start in starts:
        x = np.asarray(start, dtype=complex)[reduction.kept]
        zero = polish(reduction.equations.evaluator, x)
        near, accuracy = (zero.x, LEAST) if zero.converged else (x, ROUGH)
        simple = zero.converged and zero.corank == d
        slices, place, spent = slices.with_start(
            Start(near, accuracy, [d], not simple), rng, tracker
        )
        counts += spent
        if place is None:
            notes.append(f"a point of dimension {d} led to no component")
    return slices, counts, notes


def _with_orbit(
    component: WitnessSet,
    fibres: Sequence[Fibre],
    rows: np.ndarray,
    reduction: Reduction,
    symmetries: Sequence[SignedPermutation],
    rng: np.random.Generator,
    tracker: Tracker,
) -> tuple[WitnessSet | None, PathCounts]:
    """The component with its orbit, or None if that could not be found."""
    n, counts = reduction.system.n, PathCounts()
    plain = all(g.sources == tuple(range(n)) for g in symmetries)
    kept = reduction.kept
    generators = [tuple(g.signs[i] for i in kept) for g in symmetries]
    if plain and len(fibres) == 1 and all(keeps(fibres[0].cut, g) for g in generators):
        carriers, counts = sign_orbit(fibres[0], rows, generators, rng, tracker)
        if carriers is None:
            return None, counts
        images = []
        for carrier in carriers[1:]:
            way = SignedPermutation.identity(n)
            for k in carrier:
                way = symmetries[k].after(way)
            images.append(way)
        return replace(component, orbit=len(carriers), images=tuple(images)), counts
    try:
        (found,) = in_orbits(
            reduction.system,
            [component],
            symmetries,
            threads=tracker.threads,
            settings=tracker.settings,
        )
    except ValueError:
        return None, counts
    return found, counts
