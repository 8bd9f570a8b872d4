"""Numerical irreducible decomposition of the zero set of a polynomial system."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from nag.algebra.symmetry import SignedPermutation, check_symmetry
from nag.algebra.system import PolynomialSystem
from nag.decomposition.branch_components import decompose_apart
from nag.decomposition.independent_parts import decompose_parts
from nag.decomposition.one_equation import decompose_one_equation
from nag.decomposition.rational_curve import decompose_rational_curve
from nag.decomposition.reduction import Reduction
from nag.witness.fibres import Progress, Tracker
from nag.witness.witness import Decomposition


@np.errstate(over="ignore", invalid="ignore")
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

    Equations that share no variables are decomposed apart, and their components multiplied. Where
    equations factor over the rationals, the parts that the system falls into are decomposed
    apart; zeros of polynomials in one variable, and of two equations in two, are isolated exactly
    where they are few. Otherwise linear equations are solved exactly first. One equation that is
    left is factored over the complex numbers, and a curve that polynomials in one variable give is
    taken as it is, exactly and without paths. Equations of turns in loops are cut by a slice at
    once, if all zeros there may be are found; other equations are intersected one by one. Where
    doubts are left and only points were found, the equations are solved all at once. Nothing is
    tried again: what is left open is said to be. The same seed gives the same answer, byte for
    byte, whatever the number of threads.

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
    tracker = Tracker(settings, threads, progress)

    def whole(part: PolynomialSystem, kept: Sequence[SignedPermutation]) -> Decomposition:
        # A branch is not the scheme that was given; its multiplicities are of no interest.
        return _decompose_whole(part, seed, tracker, kept, part is system)

    def undivided(part: PolynomialSystem, kept: Sequence[SignedPermutation]) -> Decomposition:
        apart = decompose_apart(part, whole, kept, seed, threads, settings)
        return whole(part, kept) if apart is None else apart

    parts = decompose_parts(system, undivided, symmetries, seed, threads, settings)
    return undivided(system, symmetries) if parts is None else parts


def _decompose_whole(
    system: PolynomialSystem,
    seed: int,
    tracker: Tracker,
    symmetries: Sequence[SignedPermutation],
    scheme: bool,
) -> Decomposition:
    """The components of a system as it is."""
    reduction = Reduction.of(system, scaled=True)
    rng = np.random.default_rng([seed, 3])
    moving = any(not g.is_identity for g in symmetries)
    exact = decompose_one_equation(reduction, rng, tracker, scheme, one=moving)
    exact = exact or decompose_rational_curve(reduction, rng, tracker, scheme)
    if exact is not None:
        return replace(exact, seed=seed)
    # Paths take longer to load than most of what needs none takes altogether.
    from nag.decomposition.several_equations import decompose_several

    return decompose_several(reduction, seed, rng, tracker, symmetries, scheme)
