"""How many paths a system may ask for: what the choice among models goes by."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property
from math import prod

from nag.algebra.system import PolynomialSystem
from nag.algebra.turns import looped_turns


class PathNumbers:
    """How many paths a system may ask for, by several counts."""

    system: PolynomialSystem

    @property
    def bezout(self) -> int:
        """Product of the degrees of as many equations as there are variables, the lowest."""
        return prod(sorted(f.degree for f in self.system.polynomials)[: self.system.n])

    @property
    def bound(self) -> int:
        """Bezout's number in the variable groups, cut down to points by linear equations."""
        return path_bound(self.system)

    @cached_property
    def at_once(self) -> int | None:
        """Number of paths to a slice where these may be all it takes: see `paths_at_once`."""
        return paths_at_once(self.system)

    @property
    def most(self) -> int:
        """Estimated number of paths that equation by equation are tracked at most."""
        return estimated_paths(self.system)

    @property
    def paths(self) -> int:
        """Estimated number of paths: those at once where there are such."""
        return self.at_once or self.most


def path_bound(system: PolynomialSystem) -> int:
    """Bezout's number of the system's lowest degrees, cut down to points by linear equations.

    Multihomogeneous where the system has groups; slices are linear in all variables together.
    """
    polynomials = sorted(system.polynomials, key=lambda f: f.degree)[: system.n]
    if not system.groups:
        return prod(f.degree for f in polynomials)
    degrees = [tuple(f.degree_in(g) for g in system.groups) for f in polynomials]
    return intersection_number(degrees, [len(g) for g in system.groups])


def estimated_paths(system: PolynomialSystem) -> int:
    """Paths of an intersection equation by equation, if no witness point is lost on the way.

    The sum of the Bezout numbers of the first, the first two, ... equations, by rising degree, each
    with as many linear equations as leave points.
    """
    polynomials = sorted((f for f in system.polynomials if f.degree > 0), key=lambda f: f.degree)
    total = 0
    for k in range(1, min(system.n, len(polynomials)) + 1):
        first = polynomials[:k]
        if system.groups:
            degrees = [tuple(f.degree_in(g) for g in system.groups) for f in first]
            total += intersection_number(degrees, [len(g) for g in system.groups])
        else:
            total += prod(f.degree for f in first)
    return total


def fewest_estimated_paths(system: PolynomialSystem) -> int:
    """The same with the system's groups of variables or without, whichever are fewer."""
    return min(estimated_paths(s) for s in (system, replace(system, groups=())))


def paths_at_once(system: PolynomialSystem) -> int | None:
    """Paths to a slice that are tracked before any equation by equation; None for most systems.

    They are enough where they all end at zeros; only turns in several loops are asked for them.
    """
    if looped_turns(system) is None:
        return None
    # Path tracking takes longer to load than most models take to be made.
    from nag.decomposition import toric_section

    return toric_section.paths_at_once(system)


def intersection_number(degrees: Sequence[Sequence[int]], dimensions: Sequence[int]) -> int:
    """Solutions of equations of these degrees in a product of projective spaces.

    Missing equations are linear in all spaces together. It is the coefficient of the spaces' point
    class in the product of the classes sum(d_i h_i).
    """
    rows = [tuple(row) for row in degrees]
    rows += [(1,) * len(dimensions)] * (sum(dimensions) - len(rows))
    counts = {tuple(dimensions): 1}
    for row in rows[: sum(dimensions)]:
        following: dict[tuple[int, ...], int] = {}
        for left, ways in counts.items():
            for i, d in enumerate(row):
                if d > 0 and left[i]:
                    key = (*left[:i], left[i] - 1, *left[i + 1 :])
                    following[key] = following.get(key, 0) + ways * d
        counts = following
    return sum(counts.values())
