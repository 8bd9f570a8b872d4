"""Planar frameworks in isotropic coordinates: places as complex numbers, an equation for each loop.

A bar of squared length s from p to q is z = z_q - z_p, and w = s / z is its conjugate where the
realisation is real. Bars meet exactly if the z and the w of every loop add up to zero. The first
holds as z are differences of places; the sums of s / z over the loops of a basis, cleared of
denominators, are the equations: of degree k - 1 for k bars, and z is zero for none.

With half-angles, which are these coordinates after a Moebius transformation of each, equations have
degree 2 k - 4 or more; with z and w of every point there are twice as many unknowns.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.mechanism.framework import Framework
from nag.mechanism.loops import minimum_cycles

# Equations of longer loops have too many terms.
LONGEST_LOOP = 7


def isotropic_system(framework: Framework) -> PolynomialSystem | None:
    """The realisations of a planar framework, its first bar from 0 to 1.

    The variables are the places of the other points as complex numbers. Realisations and solutions
    correspond to each other one by one, also as schemes. None if a loop is too long.
    """
    loops = bar_loops(framework)
    if max(map(len, loops), default=0) > LONGEST_LOOP:
        return None
    free = framework.points_not_on(framework.bars[0])
    n = len(free)
    places = dict(
        zip(framework.bars[0], (Polynomial.constant(n, i) for i in (0, 1)), strict=True),
    )
    places |= dict(zip(free, Polynomial.variables(n), strict=True))
    unit = framework.squared_lengths[0]
    equations = []
    for loop in loops:
        above, below = Polynomial(n, {}), Polynomial.constant(n, 1)
        for first, second in zip(loop, (*loop[1:], loop[0]), strict=True):
            z = places[second] - places[first]
            squared = framework.squared_length(first, second)
            assert squared is not None
            above, below = above * z + below * (squared / unit), below * z
        equations.append(above)
    nonzero = (places[b] - places[a] for a, b in _bars_to_exclude(framework, loops))
    names = tuple(f"z_{p}" for p in free)
    return PolynomialSystem(names, tuple(equations), tuple(nonzero), isotropic=True)


def _bars_to_exclude(framework: Framework, loops: Sequence[Sequence[str]]) -> list[tuple[str, str]]:
    """Bars enough: where z is not zero for them, it is for none.

    Where one bar of a loop has z = 0 and the equation holds, another one of it has.
    """
    sides = [
        {frozenset(side) for side in zip(loop, (*loop[1:], loop[0]), strict=True)} for loop in loops
    ]
    settled = {frozenset(framework.bars[0])}
    chosen: list[tuple[str, str]] = []
    while True:
        following = {side for bars in sides if len(bars - settled) == 1 for side in bars - settled}
        if following:
            settled |= following
            continue
        left = [bar for bar in framework.bars if frozenset(bar) not in settled]
        if not left:
            return chosen
        # Bars at points that are placed already have the shortest expressions.
        placed = {p for side in settled for p in side}
        chosen.append(max(left, key=lambda bar: len(placed.intersection(bar))))
        settled.add(frozenset(chosen[-1]))


def bar_loops(framework: Framework) -> list[tuple[str, ...]]:
    """A minimum cycle basis of the bars, shorter loops first, each as its points in order."""
    # Numbers, not names, so that their order does not depend on hashes.
    index = {p: i for i, p in enumerate(framework.points)}
    loops = minimum_cycles((index[a], index[b]) for a, b in framework.bars)
    loops.sort(key=lambda ring: (len(ring), ring))
    return [tuple(framework.points[i] for i in ring) for ring in loops]


def conjugates(framework: Framework, point: Sequence[Any]) -> list[Any]:
    """The w of the points that are not pinned: what a reflection makes of their places."""
    first, second = framework.bars[0]
    free = framework.points_not_on(framework.bars[0])
    z = {first: 0, second: 1, **dict(zip(free, point, strict=True))}
    w: dict[str, Any] = {first: 0, second: 1}
    unit = framework.squared_lengths[0]
    scaled = [complex(float(s / unit)) for s in framework.squared_lengths]
    while len(w) < len(z):
        for (a, b), squared in zip(framework.bars, scaled, strict=True):
            if (a in w) != (b in w):
                known, new = (a, b) if a in w else (b, a)
                w[new] = w[known] + squared / (z[new] - z[known])
    return [w[p] for p in free]
