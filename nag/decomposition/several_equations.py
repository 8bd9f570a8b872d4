"""The components of several equations by paths: cut or solved at once, or one by one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from nag.decomposition.assembly import assemble_components
from nag.decomposition.final_checks import judge_components
from nag.decomposition.hypersurface import NEARER
from nag.decomposition.isolated import (
    contains_points,
    count_points,
    is_finite,
    solve_at_once,
    solve_for_points,
)
from nag.decomposition.method import Attempt, Task
from nag.decomposition.orbits import Action
from nag.decomposition.superset import Superset, intersection_order, witness_superset
from nag.decomposition.toric_section import section_at_once, turns_to_cut
from nag.tracking.run import Stream
from nag.witness.fibres import whole_space
from nag.witness.slices import random_rows
from nag.witness.witness import Decomposition, PathCounts


def decompose_section(task: Task) -> Attempt:
    """The components of a set of turns by all its points on a slice, see `section_at_once`."""
    turns = turns_to_cut(task.reduction)
    if turns is None:
        return Attempt()
    flag, rng = _random_flag(task)
    own = task.run.random(Stream.ALL_AT_ONCE)
    superset, spent = section_at_once(task.reduction, turns, flag, own, task.run)
    if superset is None:
        return Attempt(None, spent)
    answer = _settle(task, superset, rng)
    # Zeros of a section that is whole are counted already.
    return Attempt(answer if answer.complete else count_points(answer, task), spent)


def decompose_finite(task: Task) -> Attempt:
    """The points of a system of as many equations as variables, if they are seen to be all."""
    finite, spent = is_finite(task.reduction.reduced, task.rng, task.run)
    points = None
    if finite:
        points = solve_at_once(task, finite=True)
    return Attempt(points, spent)


def decompose_several(task: Task) -> Decomposition:
    """The components by witness points of every dimension, one equation after the other."""
    flag, rng = _random_flag(task)
    reduced = task.reduction.reduced
    order = intersection_order(reduced.polynomials)
    equations = [reduced.polynomials[i] for i in order]
    space = {len(flag): [whole_space(flag)]}
    superset = witness_superset(equations, space, rng, task.run, nonzero=reduced.nonzero)
    answer = _settle(task, superset, rng, order)
    return count_points(answer, task)


def _random_flag(task: Task) -> tuple[np.ndarray, np.random.Generator]:
    """Rows of generic slices, and the random numbers of what begins with them."""
    rng, n = task.run.random(), task.reduction.n
    return random_rows(rng, n, n, NEARER), rng


def _settle(
    task: Task, superset: Superset, rng: np.random.Generator, order: Sequence[int] = ()
) -> Decomposition:
    """The components of witness points of all dimensions; points are solved for where in doubt."""
    moving = [g for g in task.symmetries if not g.is_identity]
    actions = [Action.of(g, task.reduction.frame) for g in moving]
    found = assemble_components(
        superset.points,
        task.reduction,
        rng,
        task.run,
        actions=actions,
        scheme=task.scheme,
        found=task.found,
    )
    answer = judge_components(
        task.system,
        found.components,
        superset.counts + found.counts,
        task.run,
        [*superset.doubts, *found.notes],
        order,
    )
    # Whether all doubts are about isolated points.
    only_points = superset.only_points and not found.notes
    if not answer.complete and answer.dimension > 0 and only_points:
        again = solve_for_points(answer, task)
        answer = answer if again is None else again
    if not answer.complete and answer.dimension <= 0:
        isolated = solve_at_once(task)
        if isolated is not None and contains_points(isolated, answer):
            answer = replace(isolated, paths=_add_tracked(isolated.paths, answer.paths))
    return answer


def _add_tracked(paths: PathCounts, earlier: PathCounts) -> PathCounts:
    """The counts of paths with those tracked before, whatever became of these."""
    return replace(paths, tracked=earlier.tracked + paths.tracked)
