"""Variables that may be interchanged, with the equations that belong to them.

A start system ``x_i^d_i = c_i`` can be kept by the same interchanges as the target; then so is the
homotopy, and one path of each orbit leads to the ends of all.

Reference: Verschelde & Cools, Symmetric homotopy construction, 1994.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import comb, prod

import numpy as np

from nag.algebra.polynomial import Exponents
from nag.solving.start.target import Target, Terms
from nag.tracking.known import PathOrbits


@dataclass(frozen=True)
class Interchange:
    """Blocks of variables all permutations of which keep a system.

    Attributes:
        blocks: sets of two and more variables each.
        owner: the row of each variable in a block: an interchange of two variables is one of their
            rows, and keeps all others.
    """

    blocks: tuple[tuple[int, ...], ...]
    owner: dict[int, int]

    def paths(self, degrees: Sequence[int]) -> int:
        """The number of orbits of the solutions of ``x_i^d_i = c_i``, rows of these degrees."""
        free = [d for row, d in enumerate(degrees) if row not in self.owner.values()]
        orbits = [comb(len(b) + degrees[self.owner[b[0]]] - 1, len(b)) for b in self.blocks]
        return prod(free) * prod(orbits)

    def orbits(self, roots: np.ndarray, shift: int) -> PathOrbits:
        """The orbits of start points.

        Args:
            roots: the number of the root that each variable takes, in all combinations, shape
                ``(P, n)``.
            shift: coordinates of a point before the variables.
        """
        P, n = roots.shape
        sources = np.tile(np.arange(shift + n), (P, 1))
        first = roots.copy()
        for block in self.blocks:
            columns = np.array(block)
            order = np.argsort(roots[:, columns], axis=1, kind="stable")
            first[:, columns] = np.take_along_axis(roots[:, columns], order, axis=1)
            place = np.argsort(order, axis=1)
            sources[:, shift + columns] = shift + columns[place]
        # One whose roots are in order stands for its orbit, as it is.
        key = first @ np.cumprod([1, *(roots.max(axis=0)[:-1] + 1)])
        chosen = np.flatnonzero((first == roots).all(axis=1))
        order = np.argsort(key[chosen], kind="stable")
        orbit = order[np.searchsorted(key[chosen][order], key)]
        return PathOrbits(chosen, orbit, sources, np.ones((P, 1), dtype=np.int8))


def interchange(target: Target, rows: Sequence[int], free: Sequence[int]) -> Interchange:
    """The variables among ``free`` that may be interchanged, each with one of ``rows``.

    All other rows of the target stay as they are, or change places among themselves.
    """
    blocks: list[list[int]] = []
    owner: dict[int, int] = {}
    classes = _find_alike(target, free)
    plain = replace(target, rows=_number_coefficients(target.rows)) if classes else target
    for alike in classes:
        owners = _owners(target, rows, alike)
        found: list[list[int]] = []
        for j, row in owners.items():
            for block in found:
                if _exchanges(plain, rows, (block[-1], j), (owners[block[-1]], row)):
                    block.append(j)
                    break
            else:
                found.append([j])
        for block in found:
            if len(block) > 1:
                blocks.append(block)
                owner.update({j: owners[j] for j in block})
    return Interchange(tuple(map(tuple, blocks)), owner)


def _find_alike(target: Target, free: Sequence[int]) -> list[list[int]]:
    """Variables whose exponents, beside the degrees of their terms, are the same."""
    marked = _mark_exponents(target)
    marked.sort(axis=0)
    classes: dict[bytes, list[int]] = {}
    for j in free:
        classes.setdefault(marked[:, j].tobytes(), []).append(j)
    return [alike for alike in classes.values() if len(alike) > 1]


def _mark_exponents(target: Target) -> np.ndarray:
    """Each variable's exponent and degree of each term, as one number; shape ``(terms, n)``."""
    exponents = target.stack.exponents
    total = exponents.sum(axis=1, keepdims=True)
    return exponents * (int(total.max(initial=0)) + 1) + total


def _owners(target: Target, rows: Sequence[int], alike: Sequence[int]) -> dict[int, int]:
    """A row for each variable in which it occurs as in no other; none if they are not distinct."""
    marked = _mark_exponents(target)
    ends = np.append(target.stack.first[1:], len(marked))
    owners: dict[int, int] = {}
    for j in alike:
        seen: dict[bytes, list[int]] = {}
        for row in rows:
            column = np.sort(marked[target.stack.first[row] : ends[row], j])
            seen.setdefault(column.tobytes(), []).append(row)
        single = [key for key, where in seen.items() if len(where) == 1]
        if not single:
            return {}
        owners[j] = seen[min(single)][0]
    return owners if len(set(owners.values())) == len(owners) else {}


def _number_coefficients(rows: Sequence[Terms]) -> tuple[Terms, ...]:
    """Rows of fractions with a whole number for each, as these are compared in less time."""
    if not all(isinstance(c, Fraction) for row in rows for c in row.values()):
        return tuple(rows)
    numbers: dict[tuple[int, int], int] = {}
    return tuple(
        {e: numbers.setdefault(c.as_integer_ratio(), len(numbers)) for e, c in row.items()}
        for row in rows
    )


def _exchanges(
    target: Target, rows: Sequence[int], pair: tuple[int, int], owners: tuple[int, int]
) -> bool:
    """Whether an interchange of two variables is one of their rows and keeps all others."""
    place = {owners[0]: owners[1], owners[1]: owners[0]}
    if not all(_is_image(target.rows[r], target.rows[place.get(r, r)], pair) for r in rows):
        return False
    linear = [row for r, row in enumerate(target.rows) if r not in rows]
    return all(any(_is_image(row, other, pair) for other in linear) for row in linear)


def _is_image(row: Terms, other: Terms, pair: tuple[int, int]) -> bool:
    return len(row) == len(other) and all(
        other.get(_swap_exponents(e, *pair)) == c for e, c in row.items()
    )


def _swap_exponents(e: Exponents, j: int, k: int) -> Exponents:
    if e[j] == e[k]:
        return e
    moved = list(e)
    moved[j], moved[k] = e[k], e[j]
    return tuple(moved)
