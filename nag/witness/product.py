"""Products of witness sets, in the variables of one and then of the other.

The product of two sets that are irreducible over the complex numbers is irreducible, of the sum of
their dimensions. On the product of their slices it has the pairs of their witness points, all of
them: at infinity it is the join of both, of which the slices meet no point (Sommese & Wampler 2005,
section 13.2). So its degree is the product of the degrees, and nothing has to be tracked.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise, product

import numpy as np

from nag.algebra.symmetry import SignedPermutation
from nag.witness.close_points import PointInWords
from nag.witness.cutting import Cut
from nag.witness.fibres import Fibre
from nag.witness.witness import Slice, Status, WitnessSet


def multiply_components(first: WitnessSet, second: WitnessSet) -> WitnessSet:
    """The product of two components, each of its own equations.

    Its multiplicity is the product of the multiplicities; its orbit are the products of the orbits.
    The multidegree is left out.
    """
    blocks, others = _point_blocks(first), _point_blocks(second)
    pairs = [(np.repeat(a, len(b)), np.tile(b, len(a))) for a in blocks for b in others]
    i, j = (np.concatenate(each) for each in zip(*pairs, strict=True))
    n, d = (sum(c.slice.A.shape[k] for c in (first, second)) for k in (1, 0))
    A = np.zeros((d, n), dtype=complex)
    A[: first.dimension, : first.points.shape[1]] = first.slice.A
    A[first.dimension :, first.points.shape[1] :] = second.slice.A
    both = (first, second)
    irreducible = all(c.status is Status.IRREDUCIBLE for c in both)
    images = _images(first, second)
    return WitnessSet(
        slice=Slice(A, np.concatenate([c.slice.b for c in both])),
        points=np.hstack([first.points[i], second.points[j]]),
        multiplicity=(first.multiplicity or 0) * (second.multiplicity or 0),
        status=Status.IRREDUCIBLE if irreducible else Status.UNDECIDED,
        residual=max(c.residual for c in both),
        radii=np.hstack([first.radii[i], second.radii[j]]),
        digits=np.minimum(first.digits[i], second.digits[j]),
        corank=first.corank + second.corank,
        orbit=first.orbit * second.orbit,
        note="; ".join(dict.fromkeys(c.note for c in both if c.note)),
        images=images,
        fibres=tuple(multiply_fibres(a, b) for a in first.fibres for b in second.fibres),
    )


def _point_blocks(component: WitnessSet) -> list[np.ndarray]:
    """Places of the points of each of its fibres; of all where these are not kept."""
    sizes = [len(fibre) for fibre in component.fibres] or [component.degree]
    ends = np.cumsum([0, *sizes])
    return [np.arange(a, b) for a, b in pairwise(ends)]


def _images(first: WitnessSet, second: WitnessSet) -> tuple[SignedPermutation, ...]:
    """The symmetries of a product but the identity; none where those of a factor are not known."""
    both = [(SignedPermutation.identity(c.points.shape[1]), *c.images) for c in (first, second)]
    if [len(each) for each in both] != [first.orbit, second.orbit]:
        return ()
    n = first.points.shape[1]
    found = (
        SignedPermutation((*g.sources, *(n + k for k in h.sources)), (*g.signs, *h.signs))
        for g, h in product(*both)
    )
    return tuple(g for g in found if not g.is_identity)


def multiply_fibres(first: Fibre, second: Fibre) -> Fibre:
    """The product of two fibres, the unknowns that deflation added after all coordinates."""
    a, b = first.cut, second.cut
    n, aux = a.n + b.n, a.aux + b.aux
    left = [*range(a.n), *range(n, n + a.aux)]
    right = [*range(a.n, n), *range(n + a.aux, n + aux)]
    polynomials = [f.with_variables(n + aux, left) for f in a.polynomials]
    polynomials += [f.with_variables(n + aux, right) for f in b.polynomials]
    points = np.zeros((len(first) * len(second), n + aux), dtype=complex)
    points[:, left] = np.repeat(first.points, len(second), axis=0)
    points[:, right] = np.tile(second.points, (len(first), 1))
    fine = {
        i * len(second) + j: _pair_in_words(first, i, second, j, (left, right))
        for i in range(len(first))
        for j in range(len(second))
        if i in first.fine or j in second.fine
    }
    d = first.dimension
    rows = np.zeros((d + second.dimension, 1 + n), dtype=complex)
    rows[:d, : 1 + a.n] = first.rows
    rows[d:, 0] = second.rows[:, 0]
    rows[d:, 1 + a.n :] = second.rows[:, 1:]
    return Fibre(Cut(n, aux, tuple(polynomials)), rows, points, fine)


def _pair_in_words(
    first: Fibre, i: int, second: Fibre, j: int, places: tuple[Sequence[int], Sequence[int]]
) -> PointInWords:
    """The pair of two points in the digits that are known of them."""
    both = [
        fibre.fine.get(k) or PointInWords.of_doubles(fibre.points[k])
        for fibre, k in ((first, i), (second, j))
    ]
    words = np.zeros((sum(len(each.words) for each in both), *both[0].words.shape[1:]))
    for each, place in zip(both, places, strict=True):
        words[place] = each.words
    return PointInWords(words, max(each.curvature for each in both))
