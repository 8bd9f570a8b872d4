"""The linear trace test: the points of a union of components, and of nothing less, have a trace
that is linear in a parallel motion of the slice (Sommese, Verschelde & Wampler 2002)."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np

from nag.decomposition.monodromy import carried
from nag.witness.fibres import Fibre, Tracker
from nag.witness.slices import complex_normal, unit_complex
from nag.witness.witness import PathCounts

# True traces lay below 2e-14 and false ones above 6e-5 in all shipped cases; near-degenerate
# components come closer, and are then undecided rather than split.
LINEAR = 2e-13
# Subsets of more classes than this are not searched.
MOST_CLASSES = 12


def second_differences(
    fibres: Sequence[Fibre], rows: np.ndarray, rng: np.random.Generator, tracker: Tracker
) -> tuple[np.ndarray | None, PathCounts]:
    """Second differences of two random linear functions at each point along a parallel motion.

    Shape ``(P, 2)``, in units of the points' motion; None if a path failed. The sum over a set of
    points vanishes exactly when they are all points of some components.
    """
    counts = PathCounts()
    functional = complex_normal(rng, (rows.shape[1] - 1, 2)) / np.sqrt(rows.shape[1] - 1)
    shift = complex(unit_complex(rng))
    middle = np.vstack([fibre.x for fibre in fibres])
    centre = middle @ functional
    total, moved = -2 * centre, np.zeros(centre.shape)
    for sign in (1, -1):
        target = rows.copy()
        target[-1, 0] += sign * shift
        ends, spent = carried(fibres, rows, target, complex(unit_complex(rng)), tracker)
        counts += spent
        if ends is None:
            return None, counts
        x = np.vstack([fibre.x for fibre in ends]) @ functional
        total = total + x
        moved = np.maximum(moved, np.abs(x - centre))
    # A motion that rounding hides shows nothing: its differences stay as large as they look.
    return total / max(float(moved.max()), 1e-6 * float(np.abs(centre).max())), counts


def is_linear(differences: np.ndarray) -> bool:
    """Whether the trace of a set of points is linear, from their second differences."""
    return bool(np.abs(differences.sum(axis=0)).max(initial=0.0) < LINEAR)


def smallest_linear_unions(
    classes: Sequence[np.ndarray], differences: np.ndarray
) -> list[list[int]]:
    """Unions of classes whose trace is linear and that contain no smaller such union.

    ``classes`` are arrays of point indices. Returns lists of positions in ``classes``, disjoint,
    smallest first; classes in none of them are left out. Nothing is searched among more than
    `MOST_CLASSES` classes.
    """
    left = list(range(len(classes)))
    found: list[list[int]] = []
    if len(left) > MOST_CLASSES:
        return found
    size = 1
    while size <= len(left):
        for chosen in combinations(left, size):
            if is_linear(np.vstack([differences[classes[c]] for c in chosen])):
                found.append(list(chosen))
                left = [c for c in left if c not in chosen]
                break
        else:
            size += 1
    return found
