"""The equations that cut a component: those that it holds, or such as are found anew."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from nag.algebra.branches import Branch, branches
from nag.algebra.evaluation import Evaluator
from nag.algebra.imaginary_unit import as_real
from nag.algebra.system import PolynomialSystem
from nag.errors import ComponentError
from nag.numerics.natural_coordinates import scale_coordinates
from nag.numerics.precise_point import PrecisePoint
from nag.numerics.zero_values import ON, all_vanish
from nag.witness.change_of_coordinates import carry_component, carry_fibres, coordinates_of
from nag.witness.confirm import zero_in_digits
from nag.witness.cutting import Equations
from nag.witness.cutting_in_digits import cut_fibres
from nag.witness.fibres import Fibre
from nag.witness.points import with_fine
from nag.witness.witness import WitnessSet


def component_fibres(system: PolynomialSystem, component: WitnessSet) -> list[Fibre]:
    """The points of a component with square systems that cut them.

    They are found anew from the system where the component does not hold them.

    Raises:
        ComponentError: if the points are not regular zeros of the system or of a deflation of it.
    """
    if component.fibres:
        return with_fine(component.fibres)
    _, fibres = _cut(system, component, branches(system) or ())
    if fibres is None:
        raise ComponentError("the witness points are no regular zeros of the system")
    return fibres


def component_system(system: PolynomialSystem, component: WitnessSet) -> PolynomialSystem:
    """The branch of the system that a component is one of; the system itself if it has no branches.

    A component may be multiple in the system and simple in its branch.
    """
    apart = branches(system)
    if apart is None:
        return system
    found, _ = _cut(system, component, apart)
    return system if found is None else found


def _cut(
    system: PolynomialSystem, component: WitnessSet, apart: Sequence[Branch]
) -> tuple[PolynomialSystem | None, list[Fibre] | None]:
    """A branch of a system, or the system, with square systems that cut a component's points.

    A set that lies in several branches may be one in which these meet.
    """
    near = []
    for branch in apart:
        scales = scale_coordinates(branch.polynomials, system.n)
        own = Evaluator.of(scales.system(branch.system(system)).polynomials, system.n)
        residuals = own.residuals(scales.points(component.points))
        if residuals.max(initial=0.0) < ON:
            near.append((residuals.max(initial=0.0), branch.system(system)))
    # Of branches that come near to each other the nearest one is meant, if digits do not say more.
    parts = [part for _, part in sorted(near, key=lambda pair: pair[0])]
    if len(parts) > 1:
        point = precise_point(component)
        parts = [part for part in parts if all_vanish(part.polynomials, point) is not False]
    if len(parts) > 1:
        together = dict.fromkeys(f for part in parts for f in part.polynomials)
        parts.append(replace(as_real(system), polynomials=tuple(together)))
    for part in (*parts, system):
        for deflate in dict.fromkeys((False, component.multiplicity != 1)):
            if part is system and deflate != (component.multiplicity != 1):
                continue
            fibres = find_fibres(part, component, deflate)
            if fibres is not None:
                return part, fibres
    return None, None


def precise_point(component: WitnessSet) -> PrecisePoint:
    """A witness point in balls, from the equations that cut it where the component holds them."""
    if component.fibres:
        fibre, n = component.fibres[0], component.points.shape[1]
        zero = zero_in_digits(fibre, 0)
        if zero is not None:
            return zero.first(n)
    return PrecisePoint.of_doubles(component.points[0], component.radii[0])


def find_fibres(
    system: PolynomialSystem, component: WitnessSet, deflate: bool
) -> list[Fibre] | None:
    """The points of a component with square systems, from the equations or deflations of them.

    They are looked for in natural coordinates. None if a point is a regular zero of none.
    """
    natural = coordinates_of(system)
    equations, here = natural.system(system), carry_component(component, natural, None)
    fibres = cut_fibres(
        here.points,
        here.accuracy,
        Equations(equations.polynomials, equations.n),
        here.slice.rows,
        np.random.default_rng(0),
        deflate,
    )
    if fibres is None:
        return None
    return carry_fibres(fibres, natural.inverse, component.slice.rows, back=True)
