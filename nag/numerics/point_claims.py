"""What is said of points, against what is proved of them: errors, multiplicities, coranks.

Each function says how statements about single points stand, as `nag.numerics.certified_points`
proved zeros next to them. A statement about a point next to which nothing is proved is open.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from nag.algebra.factoring import factor_into_irreducibles
from nag.algebra.number import EQUALITY_DIGITS
from nag.algebra.polynomial import Polynomial
from nag.numerics.array_table import copy_rows, map_rows
from nag.numerics.ball_boxes import BITS, FineBox, box_about, one_zero
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.ball_ranks import regular_block
from nag.numerics.certified_points import CertifiedPoints, Proof, independent_equations
from nag.numerics.claims import Standing
from nag.numerics.deflated_system import vanishing_digits
from nag.numerics.digits import DIGITS, in_bits, written_error
from nag.numerics.discs import UP, DiscPolynomials, Discs, magnitude
from nag.numerics.krawczyk import Share, fine_box, sharpen_boxes, work_here

# Distance from zeros of coordinates that are said to be exact: evidence.
SAME = written_error(DIGITS)


def zero_standings(points: CertifiedPoints) -> list[Standing]:
    """That the points are zeros: proved, on evidence, refuted or open."""
    evidence, refuted = points.on_evidence, set(points.refuted)
    return [
        Standing.REFUTED
        if i in refuted
        else Standing.OPEN
        if proof is Proof.NONE
        else Standing.EVIDENCE
        if evidence[i]
        else Standing.PROVED
        for i, proof in enumerate(points.proofs)
    ]


def multiplicity_standings(points: CertifiedPoints, said: Sequence[int]) -> list[Standing]:
    """That the zeros are of these multiplicities; 0 says nothing.

    That a zero is simple is proved with it, and so is that a rational one is not. How often others
    count is read off the dual space of the local ring, which is evidence.
    """
    found = []
    for proof, known, claimed in zip(points.proofs, points.multiplicities, said, strict=True):
        match proof:
            case _ if claimed == 0:
                found.append(Standing.UNSEEN)
            case Proof.NONE:
                found.append(Standing.OPEN)
            case Proof.SIMPLE:
                found.append(Standing.PROVED if claimed == 1 else Standing.REFUTED)
            case Proof.EXACT if claimed == 1:
                found.append(Standing.REFUTED)
            case _:
                found.append(Standing.EVIDENCE if claimed == known else Standing.DOUBTED)
    return found


def error_standings(
    equations: Sequence[Polynomial],
    slices: np.ndarray,
    points: CertifiedPoints,
    radii: np.ndarray,
    share: Share = work_here,
) -> list[Standing]:
    """That no coordinate of a zero is further from that of its point than ``radii``.

    Args:
        radii: shape ``(P, n)``; infinite where nothing is said.
        share: who works out what doubles are to prove.
    """
    boxes = SharpBoxes(equations, slices, points)
    inner = copy_rows(points.boxes.inner)
    held = _holds_zeros(points, inner, radii)
    # What doubles leave open is mostly said by residuals in more digits; few points need balls.
    simple = np.array([proof is Proof.SIMPLE for proof in points.proofs], dtype=bool)
    simple[list(points.boxes.fine)] = False
    if len(equations) + len(slices) == points.points.shape[1]:
        left = np.flatnonzero(simple & ~held & np.isfinite(radii).all(axis=1))
        inner[left] = sharpen_boxes(equations, slices, points.boxes, left, share)
        held = _holds_zeros(points, inner, radii)
    return [
        Standing.PROVED if within else _error_standing(boxes, i, radii[i].tolist())
        for i, within in enumerate(held.tolist())
    ]


def _holds_zeros(points: CertifiedPoints, inner: np.ndarray, radii: np.ndarray) -> np.ndarray:
    """Whether doubles say of points that their zeros lie within finite radii, shape ``(P,)``.

    Args:
        inner: radii about the boxes' centres that the zeros lie in, as ``radii`` of shape
            ``(P, n)``.
    """

    def within(
        place: np.ndarray, centres: np.ndarray, inner: np.ndarray, radii: np.ndarray
    ) -> np.ndarray:
        near = (magnitude(place - centres) + inner) * UP <= radii
        return (near & np.isfinite(radii)).all(axis=1)

    with np.errstate(all="ignore"):
        found = map_rows(within, points.points, points.boxes.centres, inner, radii)
    return found & points.boxes.proved


def _error_standing(boxes: SharpBoxes, i: int, radii: Sequence[float]) -> Standing:
    points = boxes.points
    if not np.isfinite(radii).all():
        return Standing.UNSEEN
    if not points.boxes.proved[i]:
        return Standing.OPEN
    found = _standing_within(fine_box(points.boxes, i), points.points[i], radii)
    # Where boxes of doubles are too large, few digits may do.
    for bits in BITS:
        if found is None:
            found = _standing_within(boxes.box(i, bits), points.points[i], radii)
    return found or Standing.OPEN


def _standing_within(box: FineBox, point: np.ndarray, radii: Sequence[float]) -> Standing | None:
    """Whether the zero in a box is within radii of a point; None where the box does not say."""
    with in_bits(2 * BITS[-1]):
        off = [abs(z - complex(p)) for z, p in zip(box.centre, point, strict=True)]
        known = list(zip(off, box.inner, radii, strict=True))
        if all(d + r <= said for d, r, said in known):
            return Standing.PROVED
        room = [SAME * (1 + abs(z)) for z in box.centre]
        if all(d + r <= said + more for (d, r, said), more in zip(known, room, strict=True)):
            return Standing.EVIDENCE
        if any(d - r > said for d, r, said in known):
            return Standing.REFUTED
    return None


@dataclass(frozen=True, eq=False)
class SharpBoxes:
    """The boxes of proved points of a system on a slice, in more digits."""

    equations: Sequence[Polynomial]
    slices: np.ndarray
    points: CertifiedPoints

    def box(self, i: int, bits: int = BITS[-1]) -> FineBox:
        """The box of point ``i`` in so many bits, where it is seen to be of the same zero."""
        box = fine_box(self.points.boxes, i)
        if self.points.proofs[i] not in (Proof.SIMPLE, Proof.PART):
            return box
        sharp = box_about(self._square(i), box.centre, (bits,))
        return sharp if sharp is not None and one_zero(sharp, box) else box

    def _square(self, i: int) -> BallPolynomials:
        """As many equations as unknowns, of which the zero is a simple one."""
        if len(self.equations) + len(self.slices) == self.points.points.shape[1]:
            return self._all
        rows = independent_equations(self.equations, self.slices, self.points.points[i])
        return BallPolynomials.of([self.equations[k] for k in rows], self.slices)

    @cached_property
    def _all(self) -> BallPolynomials:
        return BallPolynomials.of(self.equations, self.slices)


def corank_standings(
    equations: Sequence[Polynomial], slices: np.ndarray, points: CertifiedPoints, said: int
) -> list[Standing]:
    """That the Jacobian of the equations has this corank at the zeros.

    A rank is no smaller than in balls that hold the zero, which is a proof; that it is no larger is
    evidence, but for simple zeros on a slice.
    """
    jacobian = BallPolynomials.of(equations, slices[:0]).jacobian
    boxes, found = SharpBoxes(equations, slices, points), []
    for i, proof in enumerate(points.proofs):
        if proof is Proof.NONE:
            found.append(Standing.OPEN)
            continue
        if proof is Proof.SIMPLE:
            found.append(Standing.PROVED if said == len(slices) else Standing.REFUTED)
            continue
        box = boxes.box(i)
        with in_bits(BITS[-1]):
            n, entries = len(box.centre), jacobian(box.balls, BITS[-1]).tolist()
            most = n - regular_block(entries, n).rank
        if said > most:
            found.append(Standing.REFUTED)
        else:
            found.append(Standing.EVIDENCE if said == most else Standing.DOUBTED)
    return found


def find_nonvanishing(
    polynomials: Sequence[Polynomial],
    equations: Sequence[Polynomial],
    slices: np.ndarray,
    points: CertifiedPoints,
) -> np.ndarray:
    """At which proved zeros none of the polynomials vanishes, in doubles or more digits, ``(P,)``.

    Args:
        equations, slices: whose zeros these are.
    """
    boxes = points.boxes
    if not polynomials:
        return boxes.proved.copy()
    none = np.zeros((0, 1 + points.points.shape[1]), dtype=complex)
    away = np.zeros(len(points.points), dtype=bool)
    # Coefficients may leave the range of doubles.
    with suppress(OverflowError), np.errstate(all="ignore"):
        values = DiscPolynomials.of(polynomials, none)(Discs(boxes.centres, boxes.inner))
        away = (magnitude(values.mid) > values.rad * 2).all(axis=1)
    return boxes.proved & (away | (zero_digits(polynomials, equations, points, slices, ~away) == 0))


def zero_digits(
    polynomials: Sequence[Polynomial],
    equations: Sequence[Polynomial],
    points: CertifiedPoints,
    slices: np.ndarray | None = None,
    among: np.ndarray | None = None,
) -> np.ndarray:
    """Digits to which one of the polynomials vanishes at each proved zero, shape ``(P,)``.

    They are 0 where it is proved that none does, and where nothing was looked at.

    Args:
        equations, slices: whose zeros these are; simple ones are sharpened first.
        among: which zeros are looked at, shape ``(P,)``; all by default.
    """
    P, n = points.points.shape
    none = np.zeros((0, 1 + n), dtype=complex)
    rows = [BallPolynomials.of([f]) for f in polynomials]
    digits = np.zeros(P)
    boxes = SharpBoxes(equations, none if slices is None else slices, points)
    chosen = points.boxes.proved if among is None else points.boxes.proved & among
    for i in np.flatnonzero(chosen).tolist():
        box = boxes.box(i)
        digits[i] = max((vanishing_digits(row, box) for row in rows), default=0.0)
    return digits


def nonzero_standings(
    polynomials: Sequence[Polynomial],
    equations: Sequence[Polynomial],
    slices: np.ndarray,
    points: CertifiedPoints,
) -> list[Standing]:
    """That none of the polynomials vanishes at the zeros.

    One that has the only factor of an equation that can vanish there does so.
    """
    away = find_nonvanishing(polynomials, equations, slices, points)
    digits = np.zeros(len(away))
    if not away.all():
        digits = zero_digits(polynomials, equations, points, slices)
    found = []
    for i, proof in enumerate(points.proofs):
        if proof is Proof.NONE:
            found.append(Standing.OPEN)
        elif away[i]:
            found.append(Standing.PROVED)
        elif _has_the_only_factor(polynomials, equations, points, i):
            found.append(Standing.REFUTED)
        else:
            found.append(Standing.DOUBTED if digits[i] >= EQUALITY_DIGITS else Standing.OPEN)
    return found


def _has_the_only_factor(
    polynomials: Sequence[Polynomial],
    equations: Sequence[Polynomial],
    points: CertifiedPoints,
    i: int,
) -> bool:
    """Whether a polynomial has the one factor of an equation that can vanish at a zero of all."""
    if points.proofs[i] is not Proof.SIMPLE:
        return False
    ours = {p for g in polynomials for p, _ in factor_into_irreducibles(g)}
    for f in equations:
        factors = [p for p, _ in factor_into_irreducibles(f)]
        left = [p for p in factors if not is_away(p, points, np.array([i]))]
        if len(left) == 1 and left[0] in ours:
            return True
    return False


def is_away(f: Polynomial, points: CertifiedPoints, chosen: np.ndarray) -> bool:
    """Whether a polynomial is proved to have no zero in the boxes of some points."""
    boxes = Discs(points.boxes.centres[chosen], points.boxes.inner[chosen])
    try:
        system = DiscPolynomials.of([f], np.zeros((0, 1 + f.n), dtype=complex))
    except OverflowError:
        return False
    with np.errstate(all="ignore"):
        values = system(boxes)
        return bool((np.abs(values.mid) > 2 * values.rad).all())
