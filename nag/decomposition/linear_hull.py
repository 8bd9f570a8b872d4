"""Equations of a component in its linear hull, the smallest linear space that it lies in.

Where linear equations hold on one component and not on all, they say more of it than the system
does: fewer variables are left, and in these it is often cut as a smooth complete intersection.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from nag.algebra.system import PolynomialSystem
from nag.decomposition.reduction import Reduction
from nag.interpolation.point_cloud import Ambient, Cloud
from nag.interpolation.precise_samples import SourceError, source_of_component
from nag.interpolation.vanishing import InterpolationError, next_degree, start
from nag.witness.fibres import Tracker
from nag.witness.witness import WitnessSet


def within_hull(
    system: PolynomialSystem, component: WitnessSet, rng: np.random.Generator, tracker: Tracker
) -> tuple[PolynomialSystem, WitnessSet]:
    """A reduced component with the equations of its linear hull beside those of a system.

    They are interpolated from random points of it, and recognised in 100 digits or more.

    Args:
        system: the equations that ``component`` was found from.

    Returns:
        ``system`` and ``component`` as they are where the hull has no further rational equations.
    """
    if component.dimension == 0 or component.multiplicity != 1:
        return system, component
    try:
        source = source_of_component(system, component)
        cloud = Cloud(source, Ambient.itself(system), rng, tracker)
        linear = next_degree(cloud, start(range(system.n))).basis
    except (SourceError, InterpolationError):
        return system, component
    own = replace(system, polynomials=tuple(dict.fromkeys((*linear, *system.polynomials))))
    if Reduction.of(own).n == Reduction.of(system).n:
        return system, component
    return own, replace(component, system=own, fibres=())
