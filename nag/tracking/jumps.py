"""Paths that jumped, as their ends betray: no two lead to one regular zero.

Branches that begin alike may be one that two paths follow, as well.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np

from nag.numerics.coincidence import neighbours
from nag.tracking.homotopy import Homotopy
from nag.tracking.paths import Paths
from nag.tracking.projective import coinciding_pairs

# Decides: Leading coefficients of branches that are compared once more, with shorter steps: a jump
# does not survive those, two branches do.
ALIKE = 1e-9
# Decides: The same of the coefficients that follow, over their sizes together.
BENT = 1e-4
# Combinations of leading coefficients of branches that are compared at all.
NEIGHBOURS = 1e-6


def collisions(homotopy: Homotopy, paths: Paths) -> np.ndarray:
    """Indices of the paths with regular ends, finite or at infinity, that are another one's too.

    Two ends coincide if they do in all digits that both are known to. A limit that is reached
    without winding is compared with the regular ends as well.
    """
    # Paths that failed have no winding number.
    chosen = np.flatnonzero((paths.simple | (paths.winding == 1)) & np.isfinite(paths.accuracy))
    if len(chosen) < 2 or not paths.simple.any():
        return chosen[:0]
    found: set[int] = set()
    points = paths.points if len(chosen) == len(paths) else paths.points[chosen]
    for a, b in coinciding_pairs(homotopy.groups, points, paths.accuracy[chosen]).tolist():
        i, j = chosen[[a, b]].tolist()
        if (paths.simple[i] or paths.simple[j]) and paths.same(homotopy, i, j):
            found |= {i, j}
    return np.array(sorted(found), dtype=np.int64)


def find_like_branches(paths: Paths) -> np.ndarray:
    """Indices of the paths whose branches begin like another's, with the first two terms alike."""
    kinds: dict[tuple[Fraction, ...], list[int]] = {}
    for path, branch in paths.branches.items():
        ratios = tuple(Fraction(k, branch.winding) for k in branch.orders)
        kinds.setdefault(ratios, []).append(path)
    found: set[int] = set()
    for members in kinds.values():
        if len(members) < 2:
            continue
        indices = np.array(members)
        logs = np.array([paths.branches[path].logs for path in members])
        bends = np.array([paths.branches[path].bends for path in members])
        key = (logs.real + np.cos(logs.imag)) @ np.cos(np.arange(logs.shape[1]) ** 2)
        for i, j in neighbours(key, np.full(len(key), NEIGHBOURS)):
            difference = logs[i] - logs[j]
            turns = np.abs(np.exp(1j * difference.imag) - 1)
            same = np.maximum(np.abs(difference.real), turns).max(axis=1) < ALIKE
            sizes = np.abs(bends[i]).max(axis=1) + np.abs(bends[j]).max(axis=1)
            same &= np.abs(bends[i] - bends[j]).max(axis=1) <= BENT * sizes
            found.update(indices[i[same]].tolist(), indices[j[same]].tolist())
    return np.array(sorted(found), dtype=np.int64)
