"""A component on a slice of one's own: its witness points are moved there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.given import check_type
from nag.algebra.system import PolynomialSystem
from nag.errors import ComponentError
from nag.numerics.double_ranks import DEPENDENT
from nag.numerics.zero_values import ON
from nag.tracking.run import DEFAULT_RUN, Run, Stream, takes_run
from nag.witness.change_of_coordinates import carry_component, coordinates_of
from nag.witness.component_equations import component_fibres
from nag.witness.exact_points import SharpPoints, sharpen_points
from nag.witness.fibres import Fibre, move
from nag.witness.given_component import check_component
from nag.witness.slices import to_slice, unit_complex
from nag.witness.witness import PathCounts, Slice, WitnessSet


class SliceError(ComponentError):
    """A slice that does not cut the component in as many regular points as its degree."""


def orthonormal_rows(rows: np.ndarray) -> np.ndarray:
    """The same slice by rows ``(-b, A)`` with orthonormal ``A``.

    Raises:
        SliceError: if the rows of ``A`` are linearly dependent, or not finite.
    """
    if not np.isfinite(rows).all():
        raise SliceError("the slice has entries that are not finite")
    if len(rows) == 0:
        return rows
    u, s, vh = np.linalg.svd(rows[:, 1:], full_matrices=False)
    if len(rows) > rows.shape[1] - 1 or s[-1] <= DEPENDENT * s[0]:
        raise SliceError("the equations of the slice are linearly dependent")
    return np.hstack([(u.conj().T @ rows[:, :1]) / s[:, None], vh])


def move_and_sharpen(
    fibres: Sequence[Fibre],
    target: np.ndarray,
    rng: np.random.Generator,
    run: Run,
    endgame: bool = True,
) -> tuple[SharpPoints, PathCounts]:
    """What becomes of the points of fibres when their slice moves to ``target``.

    Returns:
        The regular ends of the paths, sharpened. Paths count as failed also where the slice cuts no
        regular point.
    """
    if not len(target):
        return sharpen_points(fibres), PathCounts()
    found, counts, gamma = [], PathCounts(), complex(unit_complex(rng))
    for ends in move(fibres, target, gamma, run, endgame=endgame):
        regular, infinite = np.flatnonzero(ends.regular), ends.counts.at_infinity
        counts += PathCounts(len(ends), len(ends) - len(regular) - infinite, infinite)
        found.append(ends.fibre(regular))
    return sharpen_points(found), counts


def _check_slice(target: Slice, component: WitnessSet) -> None:
    check_type(target, Slice, "target", "a nag.Slice")
    if target.A.shape != component.slice.A.shape:
        raise SliceError(
            f"target: the slice has {len(target.b)} equations in {target.A.shape[1]} variables; "
            f"the component needs {component.dimension} in {component.slice.A.shape[1]}"
        )


@takes_run
def witness_at(
    system: PolynomialSystem,
    component: WitnessSet,
    target: Slice,
    *,
    run: Run = DEFAULT_RUN,
) -> WitnessSet:
    """The witness set of ``component`` at a given slice.

    Its points follow the slice there (Sommese & Verschelde 2000). The slice is kept as a set; its
    equations are made orthonormal.

    Args:
        system: the equations that ``component`` was found from.
        component: one of the components of a `nag.Decomposition`.
        target: as many equations as the component has dimensions, in the system's variables.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Returns:
        The component with other points, shape ``(degree, n)``.

    Raises:
        SliceError: if the slice has a wrong number of equations, or meets the component at
            infinity or where the intersection is not transversal.
        ValueError: if an argument makes no sense; the message says which, and what would.

    >>> import nag
    >>> from nag.decomposition import witness_at
    >>> circle = nag.decompose("x^2 + y^2 = 1")
    >>> moved = witness_at(circle.system, circle.components[0], nag.Slice([[1, 0]], [0]))  # x = 0
    >>> sorted(round(float(y), 6) for y in moved.points[:, 1].real)
    [-1.0, 1.0]
    """
    check_component(system, component)
    _check_slice(target, component)
    rng = run.random(Stream.MOVING_SLICE)
    goal, natural = orthonormal_rows(target.rows), coordinates_of(system)
    own = natural.system(system)
    here = carry_component(component, natural, own)
    fibres, rows = component_fibres(own, here), natural.rows(goal)
    evaluator = Evaluator.of(own.polynomials, own.n)
    there, paths = move_and_sharpen(fibres, rows, rng, run)
    residual = float(evaluator.residuals(there.x).max(initial=0.0))
    if len(there) < component.degree or not np.isfinite(there.accuracy) or residual >= ON:
        raise SliceError(
            f"of the {component.degree} points of the component, the slice meets "
            f"{paths.at_infinity} at infinity and {paths.failed} where the intersection is not "
            "transversal"
        )
    there = there.only(there.order(np.arange(len(there))))
    moved = replace(
        here,
        slice=to_slice(rows),
        points=there.x,
        residual=residual,
        radii=there.radii,
        digits=there.digits,
        fibres=there.fibres,
    )
    cut = to_slice(goal)
    return carry_component(moved, natural.inverse, component.system, cut, back=True)
