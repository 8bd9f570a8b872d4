"""Start systems that the symmetries of a target keep, and the orbits of their solutions.

Where signed permutations of the variables carry the rows of the target to rows, up to signs, the
coefficients of a start system of the same supports can be chosen so that they do the same with its
rows. Then they keep the whole homotopy, and one path of each orbit leads to the ends of all. Such
coefficients form a linear space, which holds the target: where one of its systems has as many
simple solutions as the mixed volume, nearly all have, and no more can be asked of a start system.

Reference: Verschelde & Cools, Symmetric homotopy construction, 1994.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.algebra.symmetry import SignedPermutation, find_symmetries
from nag.algebra.system import PolynomialSystem
from nag.numerics.coincidence import join_labels
from nag.solving.start.coefficient_monodromy import GenericSystem, distinct_points, equal_pairs
from nag.solving.start.target import Target
from nag.tracking.known import PathOrbits

# Elements of groups that are tried, one after the other.
MOST_ELEMENTS = 24


@dataclass(frozen=True, eq=False)
class RowSymmetry:
    """A signed permutation g of the variables: row ``r`` at ``g y`` is ``signs[r]`` times a row.

    ``rows[r]`` is that row.
    """

    map: SignedPermutation
    rows: tuple[int, ...]
    signs: tuple[int, ...]

    def after(self, first: RowSymmetry) -> RowSymmetry:
        """This symmetry after ``first``."""
        signs = tuple(s * first.signs[r] for s, r in zip(self.signs, self.rows, strict=True))
        rows = tuple(first.rows[r] for r in self.rows)
        return RowSymmetry(self.map.after(first.map), rows, signs)


def find_row_symmetries(target: Target) -> tuple[RowSymmetry, ...]:
    """Generators of the signed permutations that carry rows of a target to rows, up to signs.

    None where coefficients are no exact numbers.
    """
    if any(isinstance(c, complex | float) for row in target.rows for c in row.values()):
        return ()
    rows = tuple(Polynomial(target.n, dict(row)) for row in target.rows)
    system = PolynomialSystem(tuple(f"y{i}" for i in range(target.n)), rows)
    places = {frozenset(f.terms.items()): r for r, f in enumerate(rows)}
    found = []
    for g in find_symmetries(system):
        images = [g.of_polynomial(f) for f in rows]
        pairs = [
            next(
                (places[key], sign)
                for sign in (1, -1)
                if (key := frozenset((f * sign).terms.items())) in places
            )
            for f in images
        ]
        moved, signs = zip(*pairs, strict=True)
        found.append(RowSymmetry(g, moved, signs))
    return tuple(found)


def list_elements(generators: Sequence[RowSymmetry]) -> dict[SignedPermutation, RowSymmetry]:
    """Elements of the group that symmetries generate, short products first; not the identity.

    Not all of a large group.
    """
    found = new = {g.map: g for g in generators}
    while new and len(found) < MOST_ELEMENTS:
        products = [g.after(first) for first in new.values() for g in generators]
        new = {g.map: g for g in products if g.map not in found and not g.map.is_identity}
        found = found | new
    return found


def find_invariant(
    supports: Sequence[np.ndarray],
    values: Sequence[np.ndarray],
    generators: Sequence[RowSymmetry],
    is_generic: Callable[[tuple[np.ndarray, ...]], bool],
) -> tuple[tuple[np.ndarray, ...], list[RowSymmetry]]:
    """Coefficients that as many symmetries keep as leave them generic, and these symmetries.

    Args:
        values: generic coefficients of all terms.
        generators: of the symmetries.
        is_generic: whether coefficients seem to be.
    """
    coefficients, kept = tuple(values), list[RowSymmetry]()
    known: dict[SignedPermutation, RowSymmetry] = {}
    judged = {_as_key(coefficients): True}
    for g, symmetry in list_elements(generators).items():
        if g in known:
            continue
        trial, used = choose_invariant(supports, values, [*kept, symmetry])
        if len(used) == len(kept):
            continue
        key = _as_key(trial)
        if key not in judged:
            judged[key] = is_generic(trial)
        if judged[key]:
            coefficients, kept = trial, [*kept, symmetry]
            known = list_elements(kept)
    return coefficients, kept


def _as_key(coefficients: Sequence[np.ndarray]) -> bytes:
    return np.concatenate(coefficients).tobytes()


def choose_invariant(
    supports: Sequence[np.ndarray],
    values: Sequence[np.ndarray],
    symmetries: Sequence[RowSymmetry],
) -> tuple[tuple[np.ndarray, ...], tuple[RowSymmetry, ...]]:
    """Coefficients that symmetries keep, and those of the symmetries that leave none of them zero.

    Args:
        supports: exponents of the rows, each shape ``(terms, n)``.
        values: a coefficient for each; one of each orbit is taken for all, but for signs.
    """
    first = np.cumsum([0, *map(len, supports)])
    places = [
        {tuple(e): int(first[r]) + k for k, e in enumerate(support.tolist())}
        for r, support in enumerate(supports)
    ]
    orbits, kept = _SignedOrbits(list(range(int(first[-1]))), [1] * int(first[-1])), []
    for symmetry in symmetries:
        more = orbits.copy()
        if all(more.join(*pair) for pair in _pairs_of_terms(symmetry, supports, places)):
            orbits = more
            kept.append(symmetry)
    flat = np.concatenate(values)
    roots = [orbits.find(k) for k in range(len(flat))]
    flat = np.array([flat[root] * sign for root, sign in roots], dtype=np.complex128)
    return tuple(np.split(flat, first[1:-1])), tuple(kept)


def _pairs_of_terms(
    symmetry: RowSymmetry,
    supports: Sequence[np.ndarray],
    places: Sequence[dict[tuple[int, ...], int]],
) -> list[tuple[int, int, int]]:
    """Pairs of terms that a symmetry carries into each other, and the sign between them."""
    g = symmetry.map
    negative = np.array(g.signs) < 0
    pairs = []
    for r, support in enumerate(supports):
        moved = np.zeros_like(support)
        moved[:, list(g.sources)] = support
        odd = support[:, negative].sum(axis=1) % 2
        own, other = places[r], places[symmetry.rows[r]]
        for e, image, minus in zip(support.tolist(), moved.tolist(), odd.tolist(), strict=True):
            sign = -symmetry.signs[r] if minus else symmetry.signs[r]
            pairs.append((own[tuple(e)], other[tuple(image)], sign))
    return pairs


@dataclass(eq=False)
class _SignedOrbits:
    """Terms of equal coefficients up to signs: each one's parent, and its sign beside that."""

    parents: list[int]
    signs: list[int]

    def copy(self) -> _SignedOrbits:
        return _SignedOrbits(self.parents.copy(), self.signs.copy())

    def find(self, k: int) -> tuple[int, int]:
        """The term that stands for a term's orbit, and the sign between them."""
        sign = 1
        while self.parents[k] != k:
            sign *= self.signs[k]
            k = self.parents[k]
        return k, sign

    def join(self, j: int, k: int, sign: int) -> bool:
        """Make two terms one but for a sign; False if they would have to vanish."""
        (one, first), (other, second) = self.find(j), self.find(k)
        between = first * second * sign
        if one == other:
            return between == 1
        low, high = min(one, other), max(one, other)
        self.parents[high], self.signs[high] = low, between
        return True


def close_under(
    system: GenericSystem, symmetries: Sequence[RowSymmetry], most: int
) -> GenericSystem:
    """The system with all images of its solutions, at most so many."""
    here = distinct_points(system.points, system.errors, most)
    while len(here.points) < most:
        images = np.concatenate([_image(s.map, here.points) for s in symmetries])
        if not here.add(images, np.tile(here.radii, len(symmetries))):
            break
    return system.holding(here.points, here.radii)


def _image(g: SignedPermutation, points: np.ndarray) -> np.ndarray:
    """Images of points in projective coordinates."""
    return np.concatenate([points[:, :1], g.of_point(points[:, 1:])], axis=1)


def find_orbits(system: GenericSystem, symmetries: Sequence[RowSymmetry]) -> PathOrbits | None:
    """The orbits of the solutions; None if an image of one is none, as far as doubles can tell."""
    P, N = system.points.shape
    images = []
    for symmetry in symmetries:
        both = np.concatenate([system.points, _image(symmetry.map, system.points)])
        pairs = equal_pairs(both, np.tile(system.errors, 2))
        pairs = pairs[(pairs[:, 0] < P) & (pairs[:, 1] >= P)]
        image = np.full(P, -1)
        image[pairs[:, 1] - P] = pairs[:, 0]
        if len(pairs) != P or len(np.unique(image)) != P or (image < 0).any():
            return None
        images.append(image)
    joined = [np.stack([np.arange(P), image], axis=1) for image in images]
    chosen, orbit = np.unique(join_labels(P, joined), return_inverse=True)
    sources, signs = np.tile(np.arange(N), (P, 1)), np.ones((P, N), dtype=np.int8)
    level, seen = chosen, np.isin(np.arange(P), chosen)
    # All orbits are carried on from their first points, until no image is new.
    while len(level):
        found = []
        for symmetry, image in zip(symmetries, images, strict=True):
            there, first = np.unique(image[level], return_index=True)
            new = ~seen[there]
            there, here = there[new], level[first[new]]
            seen[there] = True
            places = np.append(0, 1 + np.array(symmetry.map.sources))
            sources[there] = sources[here][:, places]
            signs[there] = signs[here][:, places] * np.append(1, symmetry.map.signs)
            found.append(there)
        level = np.concatenate(found)
    return PathOrbits(chosen, orbit, sources, signs)
