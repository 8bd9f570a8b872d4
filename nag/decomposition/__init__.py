"""Irreducible decomposition: supersets of witness points, split into components, then judged.

Read in this order, top-down: `decompose` (the list of methods) on `method` (what one is) and
`reduction` (fewer variables). Methods that take a system apart: `independent_parts` (variables) and
`branch_components` (factors: each branch decomposed, and their components joined without repeats,
by `nag.numerics.branch_union`); without paths: `one_equation` and `rational_curve` on `roots`; with
paths: `several_equations` on `isolated` (finite sets, solved at once), `toric_section` (linkages,
cut by a slice at once) and `superset` (equation by equation) on `hypersurface` (one step) and
`ends` (sorted out). Then `splitting` on `trace` (by `zero_sums`), `power_sums` and `monodromy`,
`orbits` (the same up to symmetry); `final_checks` and `assembly`, which put the answer together.
`discovery`, `given_points`, `growth` (from one regular point) and `intersection` (on `diagonal` and
`factor`) begin elsewhere and end alike. `through` says which components a case's points are on,
`singular_points` (on `rank_drop` and `linear_hull`) where a component is singular,
`singular_members` and `sweep` what parameters change, `curve_genus` by `branch_points` the genus;
`fibre_product` both, exactly, of curves joined in single variables; `shown` is what of singular
points and sweeps is printed.

To add a method of decomposition, write a file that makes a `nag.Decomposition` of a `method.Task`,
or None where it does not apply; in `decompose` a function of the task, and of `method.Others`
(which decompose a part of it by the methods after this one), that makes a `method.Attempt` of that,
with the paths that were tracked in vain; and put this function, with the sentence that `nag.report`
prints of it, in `decompose.METHODS` at the place where it is asked. Its name is what
`Decomposition.method` and exports say. A method that tracks paths is imported in that function.

`nag.thresholds` lists what decides, beside the errors of points; each number is set where it is
used.

What can be done with components, beside what they can do themselves (`nag.WitnessSet`):

>>> import nag
>>> import numpy as np
>>> from nag.decomposition import (
...     discover, components_through, intersect_components, intersect_equations,
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
>>> discover(system, starts=10).complete  # others might be missing
False
"""

from importlib import import_module
from typing import Any

_HOME = {
    "discover": "nag.decomposition.discovery",
    "components_through": "nag.witness.membership",
    "genus": "nag.decomposition.curve_genus",
    "intersect_components": "nag.decomposition.intersection",
    "intersect_equations": "nag.decomposition.intersection",
    "project": "nag.witness.projection",
    "real_points_near": "nag.witness.real_points",
    "sample": "nag.witness.sampling",
    "singular_locus": "nag.decomposition.singular_points",
    "singular_parameters": "nag.decomposition.singular_members",
    "witness_at": "nag.witness.moving",
}

__all__ = sorted(_HOME)


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_HOME[name]), name)
