"""Equations of a component in its linear hull, the smallest linear space that it lies in.

Where linear equations hold on one component and not on all, they say more of it than the system
does: fewer variables are left, and in these it is often cut as a smooth complete intersection.

A component that is multiple in a system gets equations that it is simple in as well: those of its
own ideal, up to its degree, which cut it transversally at its smooth points.

Reference:
    Mumford, Varieties defined by quadratic equations, 1970 (theorem 1).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.decomposition.reduction import Reduction
from nag.interpolation.point_cloud import AmbientVariables, Cloud
from nag.interpolation.precise_samples import SourceError, source_of_component
from nag.interpolation.vanishing import InterpolationError, next_degree, start
from nag.tracking.run import Run
from nag.witness.component_equations import find_fibres
from nag.witness.witness import WitnessSet


def add_hull_equations(
    system: PolynomialSystem, component: WitnessSet, rng: np.random.Generator, run: Run
) -> tuple[PolynomialSystem, WitnessSet]:
    """A component with the equations of its linear hull beside those of a system.

    They are interpolated from random points of it, and recognised in 100 digits or more.

    Args:
        system: the equations that ``component`` was found from.

    Returns:
        ``system`` and ``component`` as they are where the hull has no further rational equations;
        with a multiplicity of one, wherever it is simple in the equations that are returned.
    """
    if component.dimension == 0:
        return system, component
    component = mark_simple(system, component)
    try:
        source = source_of_component(system, component)
        cloud = Cloud(source, AmbientVariables.itself(system), rng, run)
        known = next_degree(cloud, start(range(system.n)))
        own = _add_equations(known.basis, system)
        if component.multiplicity == 1 and Reduction.of(own).n == Reduction.of(system).n:
            return system, component
        found = mark_simple(own, component)
        while found.multiplicity != 1 and known.degree < component.degree:
            known = next_degree(cloud, known)
            own = _add_equations(known.generators, system)
            found = mark_simple(own, component)
    except (SourceError, InterpolationError):
        return system, component
    if found.multiplicity != 1:
        return system, component
    return own, replace(found, system=own, fibres=())


def mark_simple(system: PolynomialSystem, component: WitnessSet) -> WitnessSet:
    """The component with a multiplicity of one, if a system is regular at its witness points."""
    if component.multiplicity == 1 or component.dimension == 0:
        return component
    regular = find_fibres(system, component, deflate=False) is not None
    return replace(component, multiplicity=1, fibres=()) if regular else component


def _add_equations(found: Sequence[Polynomial], system: PolynomialSystem) -> PolynomialSystem:
    return replace(system, polynomials=tuple(dict.fromkeys((*found, *system.polynomials))))
