"""A component on a slice of one's own: its witness points are moved there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.given import check_type
from nag.algebra.system import PolynomialSystem
from nag.errors import ComponentError
from nag.numerics.double_ranks import DEPENDENT
from nag.numerics.zero_values import ON
from nag.tracking.run import DEFAULT_RUN, Run, takes_run
from nag.witness.change_of_coordinates import carry_component, coordinates_of
from nag.witness.component_equations import component_fibres
from nag.witness.exact_points import SharpFibre, order_points, sharpen_fibre
from nag.witness.fibres import Fibre, move
from nag.witness.given_component import check_component
from nag.witness.slices import to_slice, unit_complex
from nag.witness.witness import Slice, WitnessSet


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


@dataclass(frozen=True, eq=False)
class Arrival:
    """Points on the slice that they were carried to, sharpened there.

    Attributes:
        sharp: the regular ends of the paths, by fibres, with their error radii.
        infinite, irregular: numbers of paths that ended at infinity, and of those that failed or
            ended where the slice cuts no regular point.
    """

    sharp: list[SharpFibre]
    infinite: int
    irregular: int

    @property
    def fibres(self) -> list[Fibre]:
        """The points with the equations that cut them."""
        return [each.fibre for each in self.sharp]

    @property
    def x(self) -> np.ndarray:
        """The points without added unknowns, shape ``(P, n)``."""
        return np.vstack([fibre.x for fibre in self.fibres])

    @property
    def radii(self) -> np.ndarray:
        """Errors of the points' coordinates, shape ``(P, n)``."""
        return np.vstack([each.radii for each in self.sharp])

    @property
    def accuracy(self) -> float:
        """Largest relative error, infinite where Newton's method did not converge."""
        errors = np.concatenate([each.errors for each in self.sharp])
        return float(errors.max(initial=np.finfo(float).eps))


def move_and_sharpen(
    fibres: Sequence[Fibre],
    target: np.ndarray,
    rng: np.random.Generator,
    run: Run,
    endgame: bool = True,
) -> Arrival:
    """What becomes of fibres when their slice moves to ``target``."""
    if not len(target):
        return Arrival([sharpen_fibre(fibre) for fibre in fibres], 0, 0)
    found, infinite, irregular = [], 0, 0
    gamma = complex(unit_complex(rng))
    for ends in move(fibres, target, gamma, run, endgame=endgame):
        infinite += ends.counts.at_infinity
        irregular += int(np.sum(~ends.regular)) - ends.counts.at_infinity
        found.append(sharpen_fibre(ends.fibre(np.flatnonzero(ends.regular))))
    return Arrival(found, infinite, irregular)


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
        run: a `nag.Run`; its seed, threads, settings and progress may be given one by one.

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
    rng = run.random(2)
    goal, natural = orthonormal_rows(target.rows), coordinates_of(system)
    own = natural.system(system)
    here = carry_component(component, natural, own)
    fibres, rows = component_fibres(own, here), natural.rows(goal)
    evaluator = Evaluator.of(own.polynomials, own.n)
    there = move_and_sharpen(fibres, rows, rng, run)
    found = [each.only(order_points(each.fibre.points)) for each in there.sharp]
    points = np.vstack([each.fibre.x for each in found])
    residual = float(evaluator.residuals(points).max(initial=0.0))
    if len(points) < component.degree or not np.isfinite(there.accuracy) or residual >= ON:
        raise SliceError(
            f"of the {component.degree} points of the component, the slice meets {there.infinite} "
            f"at infinity and {there.irregular} where the intersection is not transversal"
        )
    moved = replace(
        here,
        slice=to_slice(rows),
        points=points,
        residual=residual,
        radii=np.vstack([each.radii for each in found]),
        digits=np.concatenate([each.digits for each in found]),
        fibres=tuple(each.fibre for each in found),
    )
    cut = to_slice(goal)
    return carry_component(moved, natural.inverse, component.system, cut, back=True)
