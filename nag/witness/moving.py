"""A component on a slice of one's own: its witness points are moved there."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.system import PolynomialSystem
from nag.witness.cutting import ON
from nag.witness.error_radii import in_order, sharpened
from nag.witness.fibres import Tracker, move
from nag.witness.membership import component_fibres
from nag.witness.slices import to_slice, unit_complex
from nag.witness.witness import Slice, WitnessSet

ATTEMPTS = 3
# Rows whose singular values differ by more than this count as dependent.
DEPENDENT = 1e-10


class SliceError(ValueError):
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


def witness_at(
    system: PolynomialSystem,
    component: WitnessSet,
    target: Slice,
    *,
    seed: int = 0,
    threads: int = 1,
    settings: str = "default",
) -> WitnessSet:
    """The witness set of ``component`` at a given slice.

    The slice is kept as a set; its equations are made orthonormal.

    Args:
        system: the equations that the component was found from.
        target: as many equations as the component has dimensions.

    Raises:
        SliceError: if the slice has a wrong number of equations, or meets the component at
            infinity or where the intersection is not transversal.
    """
    if target.A.shape != component.slice.A.shape:
        raise SliceError(
            f"the slice has {len(target.b)} equations in {target.A.shape[1]} variables; the "
            f"component needs {component.dimension} in {system.n}"
        )
    rng = np.random.default_rng([seed, 2])
    rows, goal = component.slice.rows, orthonormal_rows(target.rows)
    fibres = component_fibres(system, component)
    lost = ""
    for attempt in range(ATTEMPTS):
        tracker = Tracker("careful" if attempt else settings, threads)
        gamma = complex(unit_complex(rng))
        found, infinite, irregular = [], 0, 0
        for fibre in fibres:
            ends = move(fibre, rows, goal, gamma, tracker, endgame=True)
            infinite += ends.counts.at_infinity
            irregular += int(np.sum(~ends.regular)) - ends.counts.at_infinity
            there = ends.fibre(fibre.cut, component.dimension, np.flatnonzero(ends.regular))
            found.append(in_order(sharpened(there, goal)))
        points = np.vstack([sharp.fibre.x for sharp in found])
        radii = np.vstack([sharp.radii for sharp in found])
        residual = float(
            Evaluator.of(system.polynomials, system.n).residuals(points).max(initial=0.0)
        )
        if len(points) == component.degree and np.isfinite(radii).all() and residual < ON:
            return replace(
                component,
                slice=to_slice(goal),
                points=points,
                residual=residual,
                radii=radii,
                digits=np.concatenate([sharp.digits for sharp in found]),
                fibres=tuple(sharp.fibre for sharp in found),
            )
        lost = (
            f"of the {component.degree} points of the component, the slice meets {infinite} at "
            f"infinity and {irregular} where the intersection is not transversal"
        )
    raise SliceError(lost)
