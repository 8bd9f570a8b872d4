"""Bennett's mechanisms B_H: the 14 equations in Euler parameters, T25 section 6."""

from __future__ import annotations

from typing import Any

from nag.symbolic import bennett, bennett_geometry
from nag.symbolic.rotation import inner, rotate, rotate_back

E1 = (1, 0, 0)


def frames(m: Any) -> list[tuple[Any, Any, Any]]:
    """(eta, xi, chi) of joints 0 to 3 in global coordinates, lemmas 5.3 and 5.4."""
    chi = bennett_geometry.axes(m)
    first = tuple(tuple(x + 0 * m[0] for x in e) for e in ((1, 0, 0), (0, 1, 0)))
    return [(*first, chi[0]), *((*bennett_geometry.across(c), c) for c in chi[1:])]


def constraints(m: Any, a: Any, b: Any, c: Any, printed: bool = False) -> list[Any]:
    """f_0 to f_13; ``printed``: f_11 as printed, with eta in place of xi."""
    init = bennett.orientations(m)
    r = bennett_geometry.abbreviations(m)["r"]
    joints = frames(m)
    columns = [E1, *(rotate(q, E1) for q in (a, b, c))]
    loop = [columns[0][i] + r * columns[1][i] + columns[2][i] + r * columns[3][i] for i in range(3)]

    def across(k: int, left: Any, left_init: Any, right: Any, right_init: Any) -> list[Any]:
        eta, xi, chi = joints[k]
        turned = rotate(right, rotate_back(right_init, chi)) if right is not None else chi
        vectors = (eta, eta) if printed and k == 3 else (eta, xi)
        found = []
        for v in vectors:
            here = v if left is None else rotate(left, rotate_back(left_init, v))
            found.append(inner(here, turned))
        return found

    return [
        *(q[0] ** 2 + q[1] ** 2 + q[2] ** 2 + q[3] ** 2 - 1 for q in (a, b, c)),
        *loop,
        *across(1, None, None, a, init[0]),
        *across(2, a, init[0], b, init[1]),
        *across(3, b, init[1], c, init[2]),
        *across(0, c, init[2], None, None),
    ]
