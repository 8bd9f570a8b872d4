"""What boxes with one zero each prove of their zeros: which are distinct, and which are real."""

from __future__ import annotations

from collections.abc import Iterator

import flint
import numpy as np

from nag.numerics.ball_boxes import FineBox
from nag.numerics.coincidence import neighbours
from nag.numerics.discs import UNIT, UP
from nag.numerics.krawczyk import Boxes


def overlaps(boxes: Boxes) -> tuple[list[tuple[int, int]], list[tuple[int, int]]]:
    """Pairs of proved boxes with the same zero, and pairs of which that is not known.

    All other pairs of proved boxes are proved to have distinct zeros.
    """
    same, unknown = [], []
    for i, j in _candidates(boxes):
        verdict = one_zero(fine_box(boxes, i), fine_box(boxes, j))
        if verdict is None:
            unknown.append((i, j))
        elif verdict:
            same.append((i, j))
    return same, unknown


def _candidates(boxes: Boxes) -> Iterator[tuple[int, int]]:
    """Pairs of proved boxes whose doubles do not tell the zeros apart, smaller index first."""
    places = np.flatnonzero(boxes.proved)
    centres, inner = boxes.centres[places], boxes.inner[places]
    n = centres.shape[1]
    if n == 0:
        return
    # Of size one, so that the sum over a box's radii, twice, bounds what the key may differ by.
    weights = np.exp(1j * np.arange(1, n + 1) ** 2)
    key = (centres @ weights).real
    rounding = np.abs(centres).sum(axis=1) * (n + 8) * 8 * UNIT
    width = (4 * inner.sum(axis=1) + 2 * rounding) * UP
    for first, second in neighbours(key, width):
        distance = np.abs(centres[first] - centres[second]) / UP
        apart = (distance > (inner[first] + inner[second]) * UP).any(axis=1)
        pairs = zip(places[first[~apart]].tolist(), places[second[~apart]].tolist(), strict=True)
        yield from (tuple(sorted(pair)) for pair in pairs)


def one_zero(a: FineBox, b: FineBox) -> bool | None:
    """Whether two boxes have the same zero: the zero of one lies where the other has but one.

    The centres are exact, so that distances are right to all but rounding in any precision.
    None where it is not known.
    """
    distance = [abs(x - y) for x, y in zip(a.centre, b.centre, strict=True)]
    sums = zip(distance, a.inner, b.inner, strict=True)
    if any(d > r + s for d, r, s in sums):
        return False
    if all(d + r < s for d, r, s in zip(distance, a.inner, b.outer, strict=True)):
        return True
    if all(d + s < r for d, r, s in zip(distance, a.outer, b.inner, strict=True)):
        return True
    return None


def fine_box(boxes: Boxes, i: int) -> FineBox:
    """A box as balls."""
    if i in boxes.fine:
        return boxes.fine[i]
    return FineBox(
        tuple(flint.acb(complex(z)) for z in boxes.centres[i]),
        tuple(flint.arb(float(r)) for r in boxes.outer[i]),
        tuple(flint.arb(float(r)) for r in boxes.inner[i]),
    )


def real_zeros(boxes: Boxes) -> tuple[np.ndarray, np.ndarray]:
    """Which zeros are proved real, and which not real; of equations with real coefficients.

    The conjugate of a zero is one too, so a box with one zero that holds the conjugate has a real
    zero.
    """
    imaginary = np.abs(boxes.centres.imag)
    # Points that are not proved may be of any size.
    with np.errstate(over="ignore"):
        real = boxes.proved & ((2 * imaginary + boxes.inner) * UP < boxes.outer).all(axis=1)
    complex_ = boxes.proved & (imaginary > boxes.inner * UP).any(axis=1)
    for i in boxes.fine:
        box = boxes.fine[i]
        real[i] = holds_conjugate(box)
        off = [abs(z.imag) for z in box.centre]
        complex_[i] = any(d > r for d, r in zip(off, box.inner, strict=True))
    return real, complex_


def holds_conjugate(box: FineBox) -> bool:
    """Whether a box holds the conjugate of its zero as well."""
    triples = zip(box.centre, box.inner, box.outer, strict=True)
    return all(2 * abs(z.imag) + r < s for z, r, s in triples)
