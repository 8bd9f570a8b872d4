"""Multihomogeneous start systems: products of linear forms in groups of variables.

References:
    Morgan & Sommese, A homotopy for solving general polynomial systems that respects
    m-homogeneous structures, 1987; Wampler, Bezout number calculations for multi-homogeneous
    polynomial systems, 1992.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from math import comb, factorial, prod

import numpy as np

from nag.errors import StartError
from nag.numerics.doubles import LARGEST_WHOLE
from nag.solving.start.target import StartSystem, Target, group_degrees, homogenize_rows, unit
from nag.solving.start.total_degree import MOST_PATHS
from nag.tracking.homotopy import straight_line
from nag.tracking.starts import StartsByIndex

Groups = tuple[tuple[int, ...], ...]
# A start row is written out as a sum of terms; longer ones would slow every step down.
MOST_TERMS = 5000
# States of the count below; the search for groups skips what is dearer.
MOST_STATES = 20_000
# Integers below this fit into 64 bits.
LARGEST = 1 << 62
# A local search from a partition with so many times the paths of the best is not begun.
HOPELESS = 4
# Partitions that the search tries: some always, and one more for so many paths to be saved.
LEAST_TRIED, PATHS_FOR_A_TRY = 20, 20
MOST_TRIED = 2000
# Ways to choose factors, more than there may be paths; products with degrees fit into 64 bits.
MOST_WAYS = 1 << 40


def bezout_number(degrees: np.ndarray, sizes: Sequence[int]) -> int:
    """Coefficient of ``prod(z_g ^ sizes[g])`` in ``prod_i(sum_g degrees[i, g] z_g)``."""
    weighted = (degrees * np.array(sizes, dtype=np.int64)).sum(axis=1).tolist()
    if prod(weighted) << sum(sizes) < LARGEST:
        return _bezout_number_by_exclusion(degrees, sizes)
    rows, most = degrees.tolist(), list(sizes)
    if all(sum(row) > 0 for row in rows) and prod(map(sum, rows)) < LARGEST_WHOLE:
        return _bezout_number_of_floats(rows, most)
    counts = {tuple(most): 1}
    for row in rows:
        following: dict[tuple[int, ...], int] = {}
        for left, ways in counts.items():
            for g, d in enumerate(row):
                if d and left[g]:
                    key = (*left[:g], left[g] - 1, *left[g + 1 :])
                    following[key] = following.get(key, 0) + ways * d
        counts = following
    return sum(counts.values())


def _bezout_number_by_exclusion(degrees: np.ndarray, sizes: Sequence[int]) -> int:
    """The same by inclusion and exclusion, as Ryser's formula for permanents, in 64 bits."""
    weights, chosen = np.ones(1, dtype=np.int64), np.zeros((1, len(degrees)), dtype=np.int64)
    for size, column in zip(sizes, degrees.T, strict=True):
        count = np.arange(size + 1)
        own = np.array([(-1) ** (size - k) * comb(size, k) for k in count.tolist()])
        weights = (weights[:, None] * own).ravel()
        chosen = (chosen[:, None] + count[:, None] * column).reshape(-1, len(degrees))
    return int(weights @ chosen.prod(axis=1)) // prod(map(factorial, sizes))


def _bezout_number_of_floats(rows: list[list[int]], sizes: list[int]) -> int:
    """The same where all numbers on the way are integers that doubles hold exactly."""
    strides = np.cumprod([1, *(size + 1 for size in sizes)])
    exponents = np.arange(strides[-1])[:, None] // strides[:-1] % (np.array(sizes) + 1)
    counts = np.zeros(strides[-1])
    counts[0] = 1.0
    room = [exponents[: -int(s), g] < sizes[g] for g, s in enumerate(strides[:-1])]
    for row in rows:
        following = np.zeros(strides[-1])
        for g, d in enumerate(row):
            if d:
                shift = int(strides[g])
                following[shift:] += d * (counts[:-shift] * room[g])
        counts = following
    return int(counts[-1])


def count(target: Target, groups: Groups) -> int:
    """Bezout's number of ``target`` for a partition of its variables."""
    return bezout_number(group_degrees(target.stack, groups), [len(g) for g in groups])


def _moves(groups: Groups) -> Iterator[Groups]:
    """Partitions that differ in the place of one variable, or by two groups put together."""
    for a, group in enumerate(groups):
        for i in group:
            rest = tuple(j for j in group if j != i)
            others = [g for b, g in enumerate(groups) if b != a]
            if rest:
                yield tuple(sorted([*others, rest, (i,)]))
            for b, g in enumerate(others):
                moved = [*others[:b], tuple(sorted((*g, i))), *others[b + 1 :]]
                yield tuple(sorted([*moved, rest] if rest else moved))
        for b in range(a):
            rest_of = [g for c, g in enumerate(groups) if c not in (a, b)]
            yield tuple(sorted([*rest_of, tuple(sorted((*groups[b], *group)))]))


def _states(groups: Groups) -> int:
    return int(np.prod([len(g) + 1 for g in groups], dtype=float))


def best_groups(target: Target, given: Groups = ()) -> tuple[Groups, int]:
    """A partition of the variables with a small Bezout number, and that number.

    Local search from one group, from groups of one, from the connected parts of the monomials'
    structure, and from the ``given`` ones. The search looks at more partitions where more paths
    could be saved.
    """
    n = target.n
    seen: dict[Groups, int] = {}
    most = min(LEAST_TRIED + prod(target.degrees) // PATHS_FOR_A_TRY, MOST_TRIED)

    def value(groups: Groups) -> int | None:
        if groups not in seen:
            if len(seen) >= most or _states(groups) > MOST_STATES:
                return None
            seen[groups] = count(target, groups)
        return seen[groups]

    first = [(tuple(range(n)),), _never_together(target), tuple((i,) for i in range(n))]
    if given:
        first.insert(0, tuple(sorted(given)))
    best: tuple[int, int, Groups] | None = None
    for groups in dict.fromkeys(first):
        here = value(groups)
        if here is None:
            continue
        if best is not None and here > HOPELESS * best[0]:
            continue
        current = (here, len(groups), groups)
        while len(seen) < most:
            steps = [(value(g), len(g), g) for g in dict.fromkeys(_moves(current[2]))]
            better = min((s for s in steps if s[0] is not None), default=current)
            if better >= current:
                break
            current = better
        best = current if best is None else min(best, current)
    assert best is not None
    return best[2], best[0]


def _never_together(target: Target) -> Groups:
    """Groups of variables whose products, two of the same group, occur in no monomial.

    Found greedily; such groups make bilinear systems bilinear.
    """
    there = (target.stack.exponents > 0).astype(np.int64)
    clash = there.T @ there > 0
    groups: list[list[int]] = []
    for i in range(target.n):
        for g in groups:
            if not clash[i, g].any():
                g.append(i)
                break
        else:
            groups.append([i])
    return tuple(sorted(tuple(g) for g in groups))


def terms_of_start(degrees: np.ndarray, sizes: Sequence[int]) -> int:
    """Terms of the longest row of the start system."""
    counts = [[comb(m + d, d) for m, d in zip(sizes, row, strict=True)] for row in degrees.tolist()]
    return max((int(np.prod(c, dtype=float)) for c in counts), default=1)


def _expand(forms: Sequence[tuple[tuple[int, ...], np.ndarray]], n: int) -> dict:
    """The product of affine-linear forms ``c[0] + sum_k c[1 + k] x[group[k]]``."""
    terms: dict[tuple[int, ...], complex] = {(0,) * n: 1.0 + 0j}
    for group, c in forms:
        following: dict[tuple[int, ...], complex] = {}
        for e, value in terms.items():
            following[e] = following.get(e, 0) + value * c[0]
            for k, i in enumerate(group):
                key = (*e[:i], e[i] + 1, *e[i + 1 :])
                following[key] = following.get(key, 0) + value * c[1 + k]
        terms = following
    return terms


@dataclass(frozen=True, eq=False)
class _Choices:
    """All ways to take one factor of each row, ``sizes[g]`` of group g, by index.

    Attributes:
        degrees: of the rows in the groups, shape ``(rows, groups)``.
        strides: places of the digits, one a group, of the number that says how many factors are
            still to be taken of each.
        ways: how many ways there are from each row on, by that number, ``(rows + 1, states)``.
    """

    degrees: np.ndarray
    strides: np.ndarray
    ways: np.ndarray

    @classmethod
    def of(cls, degrees: np.ndarray, sizes: Sequence[int]) -> _Choices:
        """Those of rows of the given degrees."""
        strides = np.cumprod([1, *(size + 1 for size in sizes)])
        states = int(strides[-1])
        digits = np.arange(states)[:, None] // strides[:-1] % (np.array(sizes) + 1)
        ways = np.zeros((len(degrees) + 1, states), dtype=np.int64)
        ways[-1, 0] = 1
        for i in range(len(degrees) - 1, -1, -1):
            for g, d in enumerate(degrees[i].tolist()):
                has = digits[:, g] > 0
                ways[i, has] += d * ways[i + 1, np.flatnonzero(has) - strides[g]]
            # What no way from all factors leads to may be more than 64 bits hold.
            np.minimum(ways[i], MOST_WAYS, out=ways[i])
        return cls(degrees, strides, ways)

    def __len__(self) -> int:
        return int(self.ways[0, -1])

    def choose(self, indices: np.ndarray) -> np.ndarray:
        """Some of them, in order of the rows' first factors, shape ``(k, rows, 2)``.

        Entry ``(p, i)`` is the group of the factor of row ``i`` and the factor's number in it.
        """
        chosen = np.zeros((len(indices), len(self.degrees), 2), dtype=np.int64)
        rank, left = indices.astype(np.int64), np.full(len(indices), self.strides[-1] - 1)
        for i, row in enumerate(self.degrees.tolist()):
            open_ = np.ones(len(indices), dtype=bool)
            for g, d in enumerate(row):
                stride = int(self.strides[g])
                has = left // stride % (int(self.strides[g + 1]) // stride) > 0
                block = np.where(has, self.ways[i + 1, left - stride * has], 0)
                here = open_ & (rank < d * block)
                chosen[here, i, 0], chosen[here, i, 1] = g, rank[here] // block[here]
                rank[here] %= block[here]
                left[here] -= stride
                open_ &= ~here
                rank[open_] -= d * block[open_]
        return chosen


def multihomogeneous(target: Target, groups: Groups, rng: np.random.Generator) -> StartSystem:
    """The straight-line homotopy from products of random linear forms in the groups.

    Raises:
        StartError: if there are more paths, or longer start rows, than time and memory are for.
    """
    n = target.n
    sizes = [len(g) for g in groups]
    degrees = group_degrees(target.rows, groups)
    paths = bezout_number(degrees, sizes)
    if paths > MOST_PATHS:
        raise StartError(f"multihomogeneous: {paths} paths; at most {MOST_PATHS} are tracked")
    if terms_of_start(degrees, sizes) > MOST_TERMS:
        raise StartError("multihomogeneous: the start system has too many terms")
    forms: dict[tuple[int, int, int], np.ndarray] = {}
    start_rows = []
    for i, row in enumerate(degrees.tolist()):
        factors = []
        for g, k in ((g, k) for g, d in enumerate(row) for k in range(d)):
            forms[i, g, k] = unit(rng, 1 + sizes[g])
            factors.append((groups[g], forms[i, g, k]))
        start_rows.append(_expand(factors, n))
    gamma = complex(unit(rng, 1)[0])
    tables = []
    for g, size in enumerate(sizes):
        table = np.zeros((n, int(degrees[:, g].max(initial=0)), 1 + size), dtype=np.complex128)
        for i, k in product(range(n), range(table.shape[1])):
            if (i, g, k) in forms:
                table[i, k] = forms[i, g, k]
        tables.append(table)
    choices, shift = _Choices.of(degrees, sizes), len(groups)

    def start_points(indices: np.ndarray) -> np.ndarray:
        chosen = choices.choose(indices)
        points = np.ones((len(indices), n + shift), dtype=np.complex128)
        for g, (size, table) in enumerate(zip(sizes, tables, strict=True)):
            rows = np.argsort(chosen[:, :, 0] != g, axis=1, kind="stable")[:, :size]
            matrix = table[rows, np.take_along_axis(chosen[:, :, 1], rows, axis=1)]
            solution = np.linalg.solve(matrix[:, :, 1:], -matrix[:, :, :1])[:, :, 0]
            points[:, [shift + i for i in groups[g]]] = solution
        return points

    begin = homogenize_rows(start_rows, n, groups, degrees)
    goal = homogenize_rows(target.rows, n, groups, degrees)
    points = StartsByIndex((len(choices), n + shift), start_points)
    return StartSystem("multihomogeneous", straight_line(begin, goal, gamma), points, groups)
