"""Irreducible decomposition: supersets of witness points, split into components, then judged.

Read in this order: `components` (the whole); `isolated` (finite sets, solved at once); `superset`
(equation by equation) on `hypersurface` (one step of it); `splitting` on `monodromy` and `trace`,
`orbits` (the same up to symmetry); `final_checks` and `assembly`, which put the answer together.
`discovery` and `given_points` (on `common_slices`) and `intersection` begin elsewhere and end
alike. `branch_components` follows what exact factoring decides.

What decides, beside the errors of points. ``python tests/measure_thresholds.py --decompose``
measures how far what is compared with those that are marked with a star lies from them.

=======================  =====  ====================================================================
name                     value  what it decides, and why there
=======================  =====  ====================================================================
numerics.coincidence     1e-11  Least relative error of a point in doubles; balls of a hundred times
.LEAST *                        the errors that meet are one point. The same ones lay within 1e-15,
                                others beyond 0.05, where systems are not made to have close ones.
.HIT *                   1e-8   Ends of paths that may have led to a known point: such as had lay
.MISS *                  1e-5   within 5e-11, others beyond 7e-4; what falls between is asked again
                                on another slice.
monodromy.ROUGH          1e-8   Errors that ends of loops may have, whatever the tracker thinks: a
                                jump to a close point must not join components.
trace.EVIDENCE           18     Digits to which a trace must be linear beside the points' motion;
.ROUND_NUMBERS           6      one more for each digit of the coefficients beyond so many: what is
                                nearly reducible has long ones. Points get 28 to 240 digits for it.
                                Where the points that are left bend less, more are asked of all.
splitting.MOST_LOOPS *   100    Loops before points are left undecided; 23 were the most needed.
isolated.NONZERO         1e-6   Values beside their terms that are certainly not zero; smaller ones
                                are computed to 100 digits, or leave the answer to another way.
witness.cutting.ON *     1e-9   Values beside their terms at a sharpened point that may be zero:
                                zeros lie below 2.5e-13, others above 2e-6 in all systems measured.
witness.cutting.GAP *    1e3    Quotient of neighbouring singular values at which a rank is read:
                                others lay below 130, ranks above 1e13.
witness.confirm          1e-14  Values that are rounding where coefficients have at most six digits;
.CERTAIN *                      with longer ones, zeros are computed to 100 digits.
=======================  =====  ====================================================================

What can be done with components, beside what they can do themselves (`nag.WitnessSet`):

>>> import nag
>>> import numpy as np
>>> from nag.decomposition import (
...     by_sampling, components_through, intersect_components, intersect_equations,
...     real_points_near, witness_at,
... )
>>> surface = nag.decompose("(x^2 + y^2 - z)*(x - y)")
>>> system, (plane, bowl) = surface.system, surface.components
>>> parabola = intersect_components(system, plane, bowl)
>>> [(c.dimension, c.degree) for c in parabola.components]
[(1, 2)]
>>> circle = intersect_equations(system, bowl, nag.system("z = 1", "x y z"))
>>> [(c.dimension, c.degree) for c in circle.components]
[(1, 2)]
>>> [components_through(surface, np.array(p)) for p in ([1, 1, 2], [1, 0, 1])]
[[0, 1], [1]]
>>> target = nag.Slice(np.array([[1, 0, 0], [0, 0, 1]]), np.array([1, 3]))  # x = 1, z = 3
>>> sorted(round(float(y), 6) for y in witness_at(system, bowl, target).points[:, 1].real)
[-1.414214, 1.414214]
>>> near = real_points_near(system, bowl, np.array([0.0, 0.0, 2.0]))
>>> bool(abs(near.distances[0] - np.sqrt(7) / 2) < 1e-6)
True
>>> by_sampling(system, starts=10).complete  # others might be missing
False
"""

from importlib import import_module
from typing import Any

_HOME = {
    "by_sampling": "nag.decomposition.discovery",
    "components_through": "nag.witness.membership",
    "decompose": "nag.decomposition.components",
    "genus": "nag.decomposition.curve_genus",
    "intersect_components": "nag.decomposition.intersection",
    "intersect_equations": "nag.decomposition.intersection",
    "intersect_pair": "nag.decomposition.intersection",
    "memberships": "nag.witness.membership",
    "project": "nag.witness.projection",
    "real_points_near": "nag.witness.real_points",
    "sample": "nag.witness.sampling",
    "singular_locus": "nag.decomposition.singular_locus",
    "singular_parameters": "nag.decomposition.singular_parameters",
    "witness_at": "nag.witness.moving",
}

__all__ = sorted(_HOME)


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_HOME[name]), name)
