"""Whether a component through a real point has real points of its own dimension there.

Of equations with real coefficients the conjugate of a component is one. One that is another than
its conjugate has no real points but those on both, of a smaller dimension. One that is its own
conjugate has, where its multiplicity at the point is odd: of so many points that a real slice
beside the point cuts it in next to it, those that are not real are pairs, so that one is real. (At
a smooth point the multiplicity is 1.) Where it is even, real slices beside the point are looked at:
real points on some of them, at two distances, are found; that there are none proves nothing.

Reference:
    Bochnak, Coste & Roy, Real Algebraic Geometry, 1998, sections 2.8 and 3.3.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from nag.algebra.system import PolynomialSystem
from nag.numerics.doubles import EPS
from nag.numerics.zero_values import ON
from nag.tracking.run import Run, Stream
from nag.witness.component_equations import component_fibres
from nag.witness.fibres import Fibre, move
from nag.witness.membership import Membership, membership_in
from nag.witness.multiplicity import multiplicity_at
from nag.witness.slices import unit_complex
from nag.witness.witness import WitnessSet

# Distances of real slices from the point, relative to the coordinates' sizes, and how many slices
# at each are looked at.
BESIDE, SLICES = (1e-2, 1e-3), 4
# Decides: How much further than its slice a point may be from the given one that is next to it.
NEXT_TO = 30.0


def is_other_than_its_conjugate(
    system: PolynomialSystem, component: WitnessSet, run: Run
) -> bool | None:
    """Whether a component of equations with real coefficients is not its own conjugate.

    None where a path test does not decide it.
    """
    point = component.points[0].conj()
    error = max(float(component.errors[0]), EPS)
    answer = membership_in(system, component, point, error, run)
    return None if answer is Membership.UNDECIDED else answer is Membership.FOREIGN


def is_real_through(
    system: PolynomialSystem,
    component: WitnessSet,
    point: np.ndarray,
    accuracy: float,
    run: Run,
) -> bool | None:
    """Whether real points of a component's dimension come as near to a real point as one likes.

    Args:
        system: that the component was found from, with real coefficients.
        component: one that passes through the point.
        point: real, shape ``(n,)``.
        accuracy: relative error of the point.

    Returns:
        None where it is not known.

    >>> import nag
    >>> from nag.real.real_through import is_real_through
    >>> lines = nag.decompose("x^2 + y^2", "x y z")
    >>> [is_real_through(lines.system, c, np.zeros(3), 1e-15, nag.Run()) for c in lines.components]
    [False, False]
    """
    if system.imaginary or system.isotropic:
        return None
    if component.dimension == 0:
        return True
    other = is_other_than_its_conjugate(system, component, run)
    if other is None or other:
        return None if other is None else False
    if component.degree == 1:
        return True
    try:
        fibres = component_fibres(system, component)
    except ValueError:
        return None
    rng = run.random(Stream.REAL_PIECE_AT_POINT)
    count = multiplicity_at(point + 0j, accuracy, fibres, rng, run)
    if count is not None and count % 2:
        return True
    beside = all(_has_real_points_beside(fibres, point, off, rng, run) for off in BESIDE)
    return True if beside else None


def _has_real_points_beside(
    fibres: Sequence[Fibre], point: np.ndarray, off: float, rng: np.random.Generator, run: Run
) -> bool:
    """Whether one of some real slices beside a point has a real point of the set next to it."""
    sizes = fibres[0].sizes[1:]
    for _ in range(SLICES):
        q, _ = np.linalg.qr(rng.standard_normal((len(point), len(point))))
        rows = q[: fibres[0].dimension] / sizes
        shift = off * rng.standard_normal(len(rows))
        target = np.hstack([-(rows @ point + shift)[:, None], rows]) + 0j
        for ends in move(fibres, target, complex(unit_complex(rng)), run):
            x = ends.x[ends.regular]
            near = np.linalg.norm((x - point) / sizes, axis=1) < NEXT_TO * off
            real = np.abs(x.imag / sizes).max(axis=1, initial=0.0) < ON
            if (near & real).any():
                return True
    return False
