"""Numerical irreducible decomposition of the zero set of a polynomial system: the methods, in turn.

Each of `METHODS` is asked in its turn and answers, or leaves the system to the next ones. The first
two take a system apart and ask the next ones for its parts.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from nag.algebra.given import check_listed
from nag.algebra.imaginary_unit import as_real, has_unit
from nag.algebra.symmetry import SignedPermutation, check_symmetry
from nag.algebra.system import PolynomialSystem
from nag.decomposition.branch_components import decompose_apart
from nag.decomposition.final_checks import judge_components
from nag.decomposition.independent_parts import decompose_parts
from nag.decomposition.method import Attempt, Method, Others, Task, decompose_by
from nag.decomposition.one_equation import decompose_one_equation
from nag.decomposition.rational_curve import decompose_rational_curve
from nag.numerics.system_facts import SystemFacts
from nag.tracking.run import DEFAULT_RUN, UNFINISHED, Run, answers_early
from nag.witness.given_component import check_system
from nag.witness.witness import Decomposition, PathCounts, WitnessSet


@answers_early
@np.errstate(over="ignore", invalid="ignore")
def decompose(
    system: PolynomialSystem,
    *,
    run: Run = DEFAULT_RUN,
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
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.
        symmetries: signed permutations of the variables that keep the equations. Of the components
            that they carry into each other one is worked out and reported, with the size of its
            orbit; `nag.witness.frame.expand_orbits` lists the others.

    Raises:
        nag.algebra.symmetry.SymmetryError: if one of ``symmetries`` does not keep the equations.
        ValueError: if another argument makes no sense; the message says which, and what would.

    >>> import nag
    >>> from nag.decomposition.decompose import decompose
    >>> [(c.dimension, c.degree) for c in decompose(nag.system("x*(y - 1)")).components]
    [(1, 1), (1, 1)]
    """
    check_system(system)
    check_listed(symmetries, "symmetries", "a list of nag.SignedPermutation")
    for symmetry in symmetries:
        check_symmetry(system, symmetry)
    task = Task(
        SystemFacts(as_real(system)),
        tuple(symmetries),
        run.without_found,
        found=None if run.found is None else partial(_tell_found, system, run),
        sides=1 + system.imaginary,
    )
    answer = decompose_by(tuple(METHODS), task)
    return leave_out_conjugate(answer, system) if system.imaginary else answer


def _tell_found(system: PolynomialSystem, run: Run, components: Sequence[WitnessSet]) -> None:
    """Tell of components that are known before the others are."""
    answer = judge_components(as_real(system), components, PathCounts(), run, [UNFINISHED])
    assert run.found is not None
    run.found(leave_out_conjugate(answer, system) if system.imaginary else answer)


def leave_out_conjugate(answer: Decomposition, system: PolynomialSystem) -> Decomposition:
    """The components on which the imaginary unit is i; those with -i are the conjugate system's."""
    kept = [c for c in answer.components if has_unit(c.points).any()]
    if len(system.own_groups) < len(system.groups):
        # The unit is a number, and no group of its own.
        kept = [
            c if c.multidegree is None else replace(c, multidegree=_without_last(c.multidegree))
            for c in kept
        ]
    return replace(answer, system=system, components=tuple(kept))


def _without_last(multidegree: np.ndarray) -> np.ndarray:
    """A multidegree without the last group."""
    return multidegree[(slice(None, -1),) * multidegree.ndim]


def by_variables(task: Task, others: Others) -> Attempt:
    """The products of the components of equations that share no variables."""
    return decompose_parts(task, others)


def by_branches(task: Task, others: Others) -> Attempt:
    """The components of the branches that the factors of the equations leave, without repeats."""
    return Attempt(decompose_apart(task, others))


def one_equation(task: Task, _: Others) -> Attempt:
    """The factors over the complex numbers of the one equation that linear algebra leaves."""
    return Attempt(decompose_one_equation(task))


def rational_curve(task: Task, _: Others) -> Attempt:
    """A curve that polynomials in one variable give, exactly."""
    answer = decompose_rational_curve(task.reduction, task.rng, task.run, task.scheme)
    return Attempt(answer)


# Paths take longer to load than most of what needs none takes altogether.
def section_at_once(task: Task, _: Others) -> Attempt:
    """The components of turns in loops, cut by a slice at once, if these are all zeros there."""
    from nag.decomposition.several_equations import decompose_section

    return decompose_section(task)


def all_at_once(task: Task, _: Others) -> Attempt:
    """The points of a set that is seen to be finite."""
    from nag.decomposition.several_equations import decompose_finite

    return decompose_finite(task)


def one_by_one(task: Task, _: Others) -> Attempt:
    """Equations intersected one after the other; all at once where only points are in doubt."""
    from nag.decomposition.several_equations import decompose_several

    return Attempt(decompose_several(task))


ONE_EQUATION = (
    "exact linear algebra leaves one equation: its factors over the complex numbers are the "
    "components"
)
# In the order in which they are asked, and what is printed of each; `Decomposition.method` names
# the one that answered.
METHODS: dict[Method, str] = {
    by_variables: "equations that share no variables are decomposed apart; the components are "
    "products",
    by_branches: "the equations have factors, or few zeros: what they leave is decomposed apart",
    one_equation: ONE_EQUATION,
    rational_curve: "a curve that polynomials in one variable give, exactly",
    section_at_once: "cut by a slice all at once, which has as many points as its mixed volume",
    all_at_once: "a finite set, solved all at once",
    one_by_one: "the equations are intersected one by one",
}
