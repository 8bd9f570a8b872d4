"""Krawczyk's test: boxes that are proved to hold exactly one zero, for many points at once.

For a box X of discs about x and any matrix Y near the inverse Jacobian, all zeros in X lie in
``K(X) = x - Y F(x) + (1 - Y F'(X)) (X - x)``; if K(X) lies in the interior of X, there is exactly
one zero in X, and it is simple. In doubles first, with bounds of all rounding errors, for all
points together; in balls of more digits where that does not suffice.

References:
    Krawczyk, Newton-Algorithmen zur Bestimmung von Nullstellen mit Fehlerschranken, 1969;
    Rump, Verification methods: rigorous results using floating-point arithmetic, 2010 (the
    inflation of the box); Burr, Lee & Leykin, Effective certification of approximate solutions,
    2019.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import flint
import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.numerics.array_table import copy_rows, join_columns, map_rows, take_rows
from nag.numerics.ball_boxes import BITS, SMALLER, FineBox, box_about, holds_conjugate, one_zero
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.coincidence import neighbours
from nag.numerics.digits import in_bits, round_up
from nag.numerics.discs import LEAST, UP, DiscPolynomials, Discs, magnitude, matrix_product
from nag.numerics.doubles import UNIT
from nag.numerics.large_arrays import full_array, leave_to_file
from nag.numerics.read_only import equal_values

# A box that is not mapped into itself is enlarged so many times; how much each side exceeds that
# of the image, and the side of a coordinate that is zero, relative to the largest.
INFLATIONS = 4
WIDER, LEAST_SIDE = 2.0, 2.0**-60
# Boxes are made larger afterwards, by this factor at a time, so that they tell zeros apart.
GROWTH, GROWN = 1024.0, 1
# Points of a block at the most, and by entries of their Jacobians.
MOST_POINTS, BLOCK = 1024, 2**19

# Works out the results of a function, arrays by name, for the arguments of several calls, in their
# order, each made when it is needed; how many there are, and what they are called where progress is
# told.
Work = Callable[..., Mapping[str, np.ndarray]]
Share = Callable[
    [Work, Iterable[tuple[Any, ...]], Sequence[int], str], Iterable[Mapping[str, np.ndarray]]
]


def work_here(
    work: Work, calls: Iterable[tuple[Any, ...]], sizes: Sequence[int], stage: str
) -> Iterator[Mapping[str, np.ndarray]]:
    """One after another, here."""
    return (work(*call) for call in calls)


@dataclass(frozen=True, eq=False)
class Boxes:
    """Boxes about points, products of discs, each for one of ``P`` points in ``n`` variables.

    Attributes:
        centres: complex, shape ``(P, n)``.
        outer: radii of boxes that hold exactly one zero, which is simple; shape ``(P, n)``.
        inner: radii of boxes that this zero lies in.
        proved: for which points there is such a box, shape ``(P,)``.
        fine: the boxes of points for which doubles did not suffice; `inner` holds their zeros
            all the same, and `outer` is 0 where doubles about the centre cannot say it.
    """

    centres: np.ndarray
    outer: np.ndarray
    inner: np.ndarray
    proved: np.ndarray
    fine: dict[int, FineBox]

    __eq__ = equal_values


def prove_boxes(
    polynomials: Sequence[Polynomial],
    slices: np.ndarray,
    points: np.ndarray,
    reach: np.ndarray,
    in_balls: Callable[[int], bool] = lambda _: True,
    share: Share = work_here,
) -> Boxes:
    """Prove a simple zero next to each point.

    Args:
        polynomials: exact, in ``n`` variables.
        slices: further linear equations, rows on ``(1, x)``, whose doubles are exact; shape
            ``(n - len(polynomials), 1 + n)``.
        points: complex, shape ``(P, n)``.
        reach: how far from the points zeros may be to count, relative to their size, ``(P,)``.
        in_balls: which points, by their indices, are looked at in more digits than doubles have.
        share: who works out what doubles are to prove.
    """
    found = boxes_in_doubles(polynomials, slices, points, share)
    sizes = map_rows(lambda some: np.maximum(1.0, np.abs(some).max(axis=1, initial=0.0)), points)
    found.proved[~(found.inner.max(axis=1, initial=0.0) < reach * sizes)] = False
    left = [i for i in np.flatnonzero(~found.proved).tolist() if in_balls(i)]
    if not left:
        return found
    system = BallPolynomials.of(polynomials, slices)
    for i in left:
        fine = box_in_balls(system, points[i], float(reach[i]))
        if fine is not None:
            enter_box(found, i, fine)
    return found


def boxes_in_doubles(
    polynomials: Sequence[Polynomial],
    slices: np.ndarray,
    points: np.ndarray,
    share: Share = work_here,
) -> Boxes:
    """The boxes that doubles suffice to prove."""
    P, n = points.shape
    none = np.zeros(P, dtype=bool)
    blank = full_array((P, n), np.inf), full_array((P, n), np.inf)
    boxes = Boxes(copy_rows(points), *blank, none, {})
    blocks = _blocks(len(polynomials) + len(slices), n, P)
    calls = ((tuple(polynomials), slices, points[block]) for block in blocks)
    done = share(prove_block, calls, _sizes(blocks), "proving boxes")
    for block, found in zip(blocks, done, strict=True):
        for name in ("outer", "inner", "proved"):
            getattr(boxes, name)[block] = found[name]
        leave_to_file(boxes.outer, boxes.inner, points)
    return boxes


def prove_block(
    polynomials: Sequence[Polynomial], slices: np.ndarray, points: np.ndarray, threads: int = 1
) -> dict[str, np.ndarray]:
    """A block of `boxes_in_doubles`, by the names of its arrays in `Boxes`."""
    blank = np.full(points.shape, np.inf)
    found = blank, blank, np.zeros(len(points), dtype=bool)
    # A coefficient may be too large for a double.
    with suppress(OverflowError), np.errstate(all="ignore"):
        found = _test_boxes(DiscPolynomials.of(polynomials, slices), points)
    return dict(zip(("outer", "inner", "proved"), found, strict=True))


def _test_boxes(
    system: DiscPolynomials, points: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Outer and inner radii about points, and for which of them they are proved."""
    P, n = points.shape
    exact = Discs(points, np.zeros(points.shape))
    inverse = invert_matrices(system.jacobian(exact).mid)
    step = _step(inverse, system(exact))
    sides = np.abs(points).max(axis=1, initial=0.0)[:, None] * LEAST_SIDE
    outer = WIDER * step + np.maximum(sides, 1e-300)
    inner, proved = np.full((P, n), np.inf), np.zeros(P, dtype=bool)
    left = np.flatnonzero(np.isfinite(outer).all(axis=1))
    for _ in range(INFLATIONS):
        if not len(left):
            break
        image = _image(system, points[left], outer[left], inverse[left], step[left])
        good = (image < outer[left]).all(axis=1)
        done = left[good]
        proved[done], inner[done] = True, image[good]
        left, image = left[~good], image[~good]
        outer[left] = WIDER * image
        left = left[np.isfinite(outer[left]).all(axis=1)]
    _grow(system, points, inverse, step, outer, proved)
    return outer, inner, proved


def sharpen_boxes(
    polynomials: Sequence[Polynomial],
    slices: np.ndarray,
    boxes: Boxes,
    chosen: np.ndarray,
    share: Share = work_here,
) -> np.ndarray:
    """Smaller radii of boxes that zeros lie in, by residuals in more digits.

    The rounding of residuals is nearly all that boxes of doubles hold beside the distance of a
    point from its zero. All zeros in a box lie in its image, and in that of this.

    Args:
        polynomials, slices: as many rows as unknowns, of `prove_boxes`.
        boxes: those it found; chosen: indices of some that were proved in doubles.
        share: who works it out.

    Returns:
        Radii, none larger than ``inner``, shape ``(len(chosen), n)``.
    """
    blocks = _blocks(len(polynomials) + len(slices), boxes.centres.shape[1], len(chosen))
    calls = (
        (tuple(polynomials), slices, boxes.centres[some], boxes.inner[some])
        for some in (chosen[block] for block in blocks)
    )
    found = share(sharpen_radii, calls, _sizes(blocks), "proving errors")
    return join_columns([boxes.inner[:0], *(each["inner"] for each in found)])


def sharpen_radii(
    polynomials: Sequence[Polynomial],
    slices: np.ndarray,
    points: np.ndarray,
    inner: np.ndarray,
    threads: int = 1,
) -> dict[str, np.ndarray]:
    """A block of `sharpen_boxes`, about points."""
    try:
        system = DiscPolynomials.of(polynomials, slices)
    except OverflowError:
        return {"inner": inner}
    values = _values_in_balls(BallPolynomials.of(polynomials, slices), points)
    with np.errstate(all="ignore"):
        inverse = invert_matrices(system.jacobian(Discs(points, np.zeros(points.shape))).mid)
        step = _step(inverse, values)
        inner, left = inner.copy(), np.arange(len(points))
        for _ in range(SMALLER):
            image = _image(system, points[left], inner[left], inverse[left], step[left])
            inner[left] = np.fmin(inner[left], image)
            # Images are never below Newton's step.
            left = left[(image > 2 * step[left]).any(axis=1)]
            if not len(left):
                break
    return {"inner": inner}


def _values_in_balls(system: BallPolynomials, points: np.ndarray) -> Discs:
    """Values at points, shape ``(P, n)``, but for their rounding to doubles exact to many digits.

    Shape ``(P, rows)``.
    """
    mid = np.zeros((len(points), len(system)), dtype=complex)
    rad = np.zeros(mid.shape)
    with in_bits(BITS[0]):
        for i, point in enumerate(points.tolist()):
            found = system.values([flint.acb(z) for z in point], BITS[0]).entries()
            mid[i] = [complex(value) for value in found]
            rad[i] = [round_up(value.rad()) for value in found]
    # Each part of a middle is rounded to the nearest, twice at the most.
    return Discs(mid, (rad + 4 * UNIT * magnitude(mid)) * UP + LEAST)


def _blocks(rows: int, n: int, count: int) -> list[slice]:
    """So many points, as many at once as memory is for."""
    size = min(MOST_POINTS, max(1, BLOCK // max(1, rows * n)))
    return [slice(first, min(first + size, count)) for first in range(0, count, size)]


def _sizes(blocks: Sequence[slice]) -> list[int]:
    return [block.stop - block.start for block in blocks]


def _grow(
    system: DiscPolynomials,
    points: np.ndarray,
    inverse: np.ndarray,
    step: np.ndarray,
    outer: np.ndarray,
    proved: np.ndarray,
) -> None:
    """Larger boxes for the points that are proved, while each still holds one zero."""
    left = np.flatnonzero(proved)
    for _ in range(GROWN):
        wider = GROWTH * outer[left]
        image = _image(system, points[left], wider, inverse[left], step[left])
        good = (image < wider).all(axis=1)
        left = left[good]
        outer[left] = wider[good]


def invert_matrices(matrices: np.ndarray) -> np.ndarray:
    """Inverses, not exact; not finite where there is none."""
    usable = np.isfinite(matrices).all(axis=(1, 2))
    found = np.full(matrices.shape, np.nan, dtype=complex)
    try:
        found[usable] = np.linalg.inv(matrices[usable])
    except np.linalg.LinAlgError:
        for i in np.flatnonzero(usable):
            try:
                found[i] = np.linalg.inv(matrices[i])
            except np.linalg.LinAlgError:
                continue
    return found


def _step(inverse: np.ndarray, values: Discs) -> np.ndarray:
    """Upper bounds of the entries of ``Y F(x)``, shape ``(P, n)``."""
    moved, error = matrix_product(inverse, values.mid[..., None])
    error = error + magnitude(inverse) @ values.rad[..., None] * UP
    return (magnitude(moved) + error)[..., 0] * UP


def _image(
    system: DiscPolynomials,
    points: np.ndarray,
    radii: np.ndarray,
    inverse: np.ndarray,
    step: np.ndarray,
) -> np.ndarray:
    """Upper bounds of the distances of K(X) from the points, shape ``(P, n)``."""
    slopes = system.jacobian(Discs(points, radii))
    rest, error = matrix_product(inverse, slopes.mid)
    rest -= np.eye(points.shape[1])
    size = magnitude(rest) + error + magnitude(inverse) @ slopes.rad * UP
    return (step + (size @ radii[..., None])[..., 0]) * UP


def box_in_balls(system: BallPolynomials, point: np.ndarray, reach: float) -> FineBox | None:
    """The box of a simple zero within ``reach`` of the point, relative to its size, or None."""
    if not np.isfinite(point).all():
        return None
    start = [flint.acb(complex(z)) for z in point]
    box = box_about(system, start)
    bound = reach * max(1.0, float(np.abs(point).max(initial=0.0)))
    if box is None or not all(abs(a - b) < bound for a, b in zip(start, box.centre, strict=True)):
        return None
    return box


def enter_box(boxes: Boxes, i: int, fine: FineBox) -> None:
    """Enter a box of balls for point ``i``."""
    boxes.fine[i] = fine
    boxes.proved[i] = True
    centre = np.array([complex(z) for z in fine.centre])
    boxes.centres[i] = centre
    off = [abs(z - complex(c)) for z, c in zip(fine.centre, centre, strict=True)]
    boxes.inner[i] = [round_up(o + r) for o, r in zip(off, fine.inner, strict=True)]
    room = [r - o for o, r in zip(off, fine.outer, strict=True)]
    boxes.outer[i] = [max(0.0, float(r.lower()) / UP) for r in room]


def find_overlaps(boxes: Boxes) -> tuple[list[tuple[int, int]], list[tuple[int, int]]]:
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
    places, centres, inner = np.flatnonzero(boxes.proved), boxes.centres, boxes.inner
    if len(places) < len(centres):
        centres, inner = take_rows(centres, places), take_rows(inner, places)
    n = centres.shape[1]
    if n == 0:
        return
    # Of size one, so that the sum over a box's radii, twice, bounds what the key may differ by.
    weights = np.exp(1j * np.arange(1, n + 1) ** 2)
    key = map_rows(lambda some: (some @ weights).real, centres)

    def widths(some: np.ndarray, radii: np.ndarray) -> np.ndarray:
        rounding = np.abs(some).sum(axis=1) * (n + 8) * 8 * UNIT
        return (4 * radii.sum(axis=1) + 2 * rounding) * UP

    width = map_rows(widths, centres, inner)
    for first, second in neighbours(key, width):
        distance = np.abs(centres[first] - centres[second]) / UP
        apart = (distance > (inner[first] + inner[second]) * UP).any(axis=1)
        pairs = zip(places[first[~apart]].tolist(), places[second[~apart]].tolist(), strict=True)
        yield from (tuple(sorted(pair)) for pair in pairs)


def fine_box(boxes: Boxes, i: int) -> FineBox:
    """A box as balls."""
    if i in boxes.fine:
        return boxes.fine[i]
    return FineBox(
        tuple(flint.acb(complex(z)) for z in boxes.centres[i]),
        tuple(flint.arb(float(r)) for r in boxes.outer[i]),
        tuple(flint.arb(float(r)) for r in boxes.inner[i]),
    )


def tell_real_zeros(boxes: Boxes, system: PolynomialSystem) -> tuple[np.ndarray, np.ndarray]:
    """Which zeros are proved real, and which not real.

    The conjugate of a zero is one too, so a box with one zero that holds the conjugate has a real
    zero. Where coefficients are not real the conjugate says nothing, so none is proved real; all
    coordinates count but the imaginary unit itself.
    """
    counting = slice(0, system.n - system.imaginary)

    def holds(centres: np.ndarray, inner: np.ndarray, outer: np.ndarray) -> np.ndarray:
        return ((2 * np.abs(centres.imag) + inner) * UP < outer).all(axis=1)

    def is_off(centres: np.ndarray, inner: np.ndarray) -> np.ndarray:
        return (np.abs(centres.imag) > inner * UP)[:, counting].any(axis=1)

    # Points that are not proved may be of any size.
    with np.errstate(over="ignore"):
        real = boxes.proved & map_rows(holds, boxes.centres, boxes.inner, boxes.outer)
    real &= not system.imaginary
    complex_ = boxes.proved & map_rows(is_off, boxes.centres, boxes.inner)
    for i in boxes.fine:
        box = boxes.fine[i]
        real[i] = not system.imaginary and holds_conjugate(box)
        off = [abs(z.imag) for z in box.centre]
        beyond = [d > r for d, r in zip(off, box.inner, strict=True)]
        complex_[i] = any(beyond[counting])
    return real, complex_
