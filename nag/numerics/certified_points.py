"""Points of a zero set on a slice, each proved to be next to exactly one zero as far as can be.

Krawczyk's test needs as many equations as unknowns. Of more equations, as many are proved to have a
simple zero there, and the others, which no numbers can prove to vanish, are evaluated at it to many
digits; where one of them does not vanish, the point is proved to be no zero. Where a point is
singular, the zero of deflated equations is proved in the same way.

Zeros may be so close to each other that doubles about them do not say which is meant. Newton's
method from anywhere near leads to one of them, slowly at first: while the others are as good as at
the same place a step leads part of the way. From random places about the points it leads to each;
those that are found are proved, and proved to be distinct, in balls.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from fractions import Fraction
from functools import cache, partial
from typing import Any

import flint
import numpy as np
from scipy.optimize import linear_sum_assignment

from nag.algebra.evaluation import Evaluator
from nag.algebra.exact_ranks import jacobian_rank
from nag.algebra.number import EQUALITY_DIGITS
from nag.algebra.polynomial import Polynomial
from nag.numerics.array_table import copy_rows, map_rows, take_rows
from nag.numerics.ball_boxes import BITS, FineBox, ball_box, box_about, holds_conjugate, one_zero
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.coincidence import NEAR, clusters
from nag.numerics.deflated_system import deflated_zero, vanishing_digits
from nag.numerics.digits import DIGITS, in_bits, middle, rational_point, to_ball
from nag.numerics.discs import UP
from nag.numerics.double_ranks import pivot_rows
from nag.numerics.doubles import EPS, ROUNDED, SLACK
from nag.numerics.krawczyk import (
    Boxes,
    Share,
    enter_box,
    find_overlaps,
    prove_boxes,
    work_here,
)
from nag.numerics.large_arrays import full_array
from nag.numerics.newton import newton_to_rest
from nag.numerics.read_only import equal_values
from nag.numerics.singular_point import Place, analyse
from nag.text.json_text import pairs, real_or_null
from nag.text.table import magnitude, printable

# Places to begin at, for each zero, and steps from there: each may lead part of the way only.
PLACES, STEPS = 10, 200


def prove_close_zeros(
    system: BallPolynomials, points: np.ndarray, reach: float, rng: np.random.Generator
) -> list[FineBox]:
    """Boxes of as many distinct simple zeros next to points as there are of these, or fewer.

    Args:
        system: as many rows as unknowns.
        points: complex, shape ``(k, n)``, close together.
        reach: how far from the points zeros may be, absolute.
    """
    size = max(float(np.abs(points).max(initial=0.0)), np.finfo(float).tiny)
    spread = float(np.abs(points - points[0]).max(initial=0.0))
    least = 4 * EPS * size
    found: list[FineBox] = []
    for place in range(PLACES * len(points)):
        begin = points[place % len(points)]
        # Distances of all sizes: the points may be zeros of several groups.
        off = least * max(1.0, spread / least) ** rng.random()
        shape = rng.standard_normal(len(begin)) + 1j * rng.standard_normal(len(begin))
        start = [flint.acb(complex(z)) for z in begin + off * shape]
        x = newton_to_rest(system, start, BITS[-1], STEPS)
        box = None if x is None else ball_box(system, x, BITS[-1])
        if box is None or not _near(box, points, reach):
            continue
        if all(one_zero(box, other) is False for other in found):
            found.append(box)
        if len(found) == len(points):
            break
    return found


def _near(box: FineBox, points: np.ndarray, reach: float) -> bool:
    centre = np.array([complex(z) for z in box.centre])
    return bool((np.abs(points - centre).max(axis=1) < reach).any())


def match_boxes(
    boxes: Sequence[FineBox], points: np.ndarray, accuracy: np.ndarray, real: np.ndarray | None
) -> list[FineBox]:
    """One box for each point: the nearest, and of those that are as near one that is as real.

    Args:
        accuracy: estimated relative errors of the points, shape ``(k,)``.
        real: which points are said to be real, shape ``(k,)``, or None.
    """
    size = max(float(np.abs(points).max(initial=0.0)), np.finfo(float).tiny)
    centres = np.array([[complex(z) for z in box.centre] for box in boxes])
    cost = np.abs(points[:, None] - centres).max(axis=2) / size
    if real is not None:
        differs = real[:, None] != np.array([holds_conjugate(box) for box in boxes])
        # What the points' errors leave open decides nothing else.
        unclear = 8 * np.maximum(np.nan_to_num(accuracy, posinf=0.0), EPS)
        cost = cost + differs * unclear[:, None]
    _, chosen = linear_sum_assignment(cost)
    return [boxes[k] for k in chosen.tolist()]


# Gradients below this, relative to their terms, count as what they are.
FLAT = 1e-8
# Most decimal digits of a zero, in a document, for which doubles do not suffice.
MOST_DECIMALS = 60


class Proof(StrEnum):
    """What is proved of a point.

    `SIMPLE`: all equations have exactly one zero in the box, and it is simple. `PART`: so have as
    many of the equations as there are unknowns, and the others vanish there to so many digits.
    `DEFLATED`: so have deflated equations, in more unknowns. `EXACT`: the zero is multiple, and
    rational. `NONE`: nothing.
    """

    SIMPLE = "simple"
    PART = "part"
    DEFLATED = "deflated"
    EXACT = "exact"
    NONE = "none"


# What stands after the number of points that have a proof.
WORDS = {
    Proof.SIMPLE: "simple zeros of all equations, one in each box",
    Proof.PART: "simple zeros of as many equations as unknowns, the others vanishing there to "
    "{digits}",
    Proof.DEFLATED: "singular, as simple zeros of as many deflated equations as unknowns, the "
    "others vanishing there to {digits}",
    Proof.EXACT: "singular, as exact rational zeros",
    Proof.NONE: "not proved",
}


@dataclass(frozen=True, eq=False)
class CertifiedPoints:
    """What is proved of points.

    Attributes:
        points: complex, shape ``(P, n)``.
        proofs: one for each point.
        boxes: of the zeros; proved where the proof is not `NONE`.
        digits: to which equations that were not needed vanish, shape ``(P,)``; infinite where
            there are none.
        real: which zeros are proved to be real though they are singular, shape ``(P,)``.
        refuted: indices of points next to a zero of as many equations as unknowns that is proved
            to be none of all of them.
        multiplicities: how often each zero counts, 0 where that is not known, shape ``(P,)``: one
            where it is simple, else the dimension of its local ring, on evidence.
    """

    points: np.ndarray
    proofs: tuple[Proof, ...]
    boxes: Boxes
    digits: np.ndarray
    real: np.ndarray
    refuted: tuple[int, ...]
    multiplicities: np.ndarray

    __eq__ = equal_values

    def having(self, *proofs: Proof) -> np.ndarray:
        """Indices of the points with one of these proofs."""
        return np.array([i for i, p in enumerate(self.proofs) if p in proofs], dtype=np.int64)

    @property
    def on_evidence(self) -> np.ndarray:
        """Which points rest on evidence, as equations vanish to so many digits, shape ``(P,)``."""
        return np.array([p is not Proof.NONE for p in self.proofs], dtype=bool) & np.isfinite(
            self.digits
        )

    @property
    def all_proved(self) -> bool:
        """Whether each point is proved, and none on evidence."""
        return Proof.NONE not in self.proofs and not self.on_evidence.any()

    def document(self) -> list[dict[str, Any]]:
        """What is proved of each point, as JSON objects."""
        boxes, errors, centres = self.boxes, self.errors(), pairs(self.boxes.centres)
        documents, evidence = [], self.on_evidence
        for i, proof in enumerate(self.proofs):
            document: dict[str, Any] = {"proof": str(proof), "refuted": i in self.refuted}
            if evidence[i]:
                document["evidence"] = True
            if boxes.proved[i]:
                document |= {
                    "centre": centres[i],
                    "inner": boxes.inner[i].tolist(),
                    "outer": boxes.outer[i].tolist(),
                    "error": real_or_null(float(errors[i])),
                    "digits": real_or_null(float(self.digits[i])),
                }
            if i in boxes.fine:
                document["decimals"] = boxes.fine[i].decimals(MOST_DECIMALS)
            documents.append(document)
        return documents

    def errors(self) -> np.ndarray:
        """Proved bounds of the distances of points from their zeros, relative, shape ``(P,)``.

        Distances and sizes are those of the largest coordinates, sizes at least one; infinite
        where nothing is proved.
        """

        def bounds(points: np.ndarray, centres: np.ndarray, inner: np.ndarray) -> np.ndarray:
            off = (np.abs(points - centres) + inner) * UP
            sizes = np.maximum(1.0, np.abs(points).max(axis=1, initial=0.0))
            return off.max(axis=1, initial=0.0) / sizes * UP

        found = map_rows(bounds, self.points, self.boxes.centres, self.boxes.inner)
        return np.where(self.boxes.proved, found, np.inf)


def certify_points(
    polynomials: Sequence[Polynomial],
    slices: np.ndarray,
    points: np.ndarray,
    accuracy: np.ndarray,
    singular: np.ndarray,
    real: np.ndarray | None = None,
    share: Share = work_here,
) -> CertifiedPoints:
    """Prove what can be proved of points of a zero set on a slice.

    Args:
        polynomials: exact, in ``n`` variables.
        slices: linear equations, rows on ``(1, x)``, whose doubles are exact, shape ``(d, 1 + n)``.
        points: complex, shape ``(P, n)``.
        accuracy: estimated relative errors of the points, shape ``(P,)``.
        singular: which of the points are known to be singular, shape ``(P,)``.
        real: which of them are said to be real, shape ``(P,)``: which one of several zeros is meant
            where doubles do not tell them apart.
        share: who works out what doubles are to prove.
    """
    equations = [f for f in polynomials if f]
    found, proofs = _nothing_proved(points), [Proof.NONE] * len(points)
    boxes, n = found.boxes, points.shape[1]
    reach = _reach(accuracy)
    finite = np.isfinite(points).all(axis=1)
    tested = np.flatnonzero(~singular & finite)
    refuted = _regular(equations, slices, found, proofs, tested, reach, share)
    if len(equations) + len(slices) == n:
        _close_together(
            BallPolynomials.of(equations, slices), found, proofs, tested, accuracy, real
        )
    for i in np.flatnonzero(~boxes.proved & finite).tolist():
        if i in refuted:
            continue
        simple = _singular(equations, slices, found, proofs, i, float(accuracy[i]))
        if simple and singular[i]:
            refuted |= _regular(equations, slices, found, proofs, np.array([i]), reach)
    return _with_proofs(found, proofs, refuted)


def certify_regular_points(
    polynomials: Sequence[Polynomial], slices: np.ndarray, points: np.ndarray, accuracy: np.ndarray
) -> CertifiedPoints:
    """The same of points that are simple zeros; nothing is proved of others."""
    equations = [f for f in polynomials if f]
    found, proofs = _nothing_proved(points), [Proof.NONE] * len(points)
    tested = np.flatnonzero(np.isfinite(points).all(axis=1))
    refuted = _regular(equations, slices, found, proofs, tested, _reach(accuracy))
    return _with_proofs(found, proofs, refuted)


def _nothing_proved(points: np.ndarray) -> CertifiedPoints:
    P, n = points.shape
    blank = full_array((P, n), np.inf), full_array((P, n), np.inf)
    boxes = Boxes(copy_rows(points), *blank, np.zeros(P, dtype=bool), {})
    real, counts = np.zeros(P, dtype=bool), np.zeros(P, dtype=np.int64)
    return CertifiedPoints(points, (), boxes, np.full(P, np.inf), real, (), counts)


def _reach(accuracy: np.ndarray) -> np.ndarray:
    return np.maximum(NEAR, SLACK * np.nan_to_num(accuracy, nan=0.0))


def _with_proofs(
    found: CertifiedPoints, proofs: Sequence[Proof], refuted: set[int]
) -> CertifiedPoints:
    found.multiplicities[[p in (Proof.SIMPLE, Proof.PART) for p in proofs]] = 1
    return replace(found, proofs=tuple(proofs), refuted=tuple(sorted(refuted)))


def _regular(
    equations: Sequence[Polynomial],
    slices: np.ndarray,
    found: CertifiedPoints,
    proofs: list[Proof],
    tested: np.ndarray,
    reach: np.ndarray,
    share: Share = work_here,
) -> set[int]:
    """Prove simple zeros next to the points ``tested``; those proved to be next to none."""
    boxes, points = found.boxes, found.points
    count, n = len(equations) + len(slices), points.shape[1]
    if count > n:
        return _prove_overdetermined(equations, slices, found, proofs, tested, reach)
    if count == n:
        near = take_rows(points, tested), reach[tested]
        _enter(boxes, tested, prove_boxes(equations, slices, *near, share=share))
        for i in tested[boxes.proved[tested]].tolist():
            proofs[i] = Proof.SIMPLE
    return set()


def _close_together(
    system: BallPolynomials,
    found: CertifiedPoints,
    proofs: list[Proof],
    tested: np.ndarray,
    accuracy: np.ndarray,
    real: np.ndarray | None,
) -> None:
    """Prove a zero of its own for each point of those close together, where one has none yet."""
    boxes = found.boxes
    twice = {i for pair in find_overlaps(boxes)[0] for i in pair}
    without = twice | set(tested[~boxes.proved[tested]].tolist())
    if not without:
        return
    # Distances of points that are larger leave the range of doubles.
    with np.errstate(over="ignore"):
        tested = tested[np.isfinite(np.linalg.norm(found.points[tested], axis=1))]
    for group in clusters(found.points[tested], accuracy[tested]):
        members = tested[group]
        if len(members) < 2 or without.isdisjoint(members.tolist()):
            continue
        points, errors = found.points[members], accuracy[members]
        near = NEAR * max(1.0, float(np.abs(points).max(initial=0.0)))
        zeros = prove_close_zeros(system, points, near, np.random.default_rng(0))
        if len(zeros) < len(members):
            continue
        claims = None if real is None else real[members]
        for i, box in zip(
            members.tolist(), match_boxes(zeros, points, errors, claims), strict=True
        ):
            enter_box(boxes, i, box)
            proofs[i] = Proof.SIMPLE


def _prove_overdetermined(
    equations: Sequence[Polynomial],
    slices: np.ndarray,
    found: CertifiedPoints,
    proofs: list[Proof],
    tested: np.ndarray,
    reach: np.ndarray,
) -> set[int]:
    """Prove zeros of as many equations as unknowns, and look at the others there.

    Returns:
        Indices of points next to zeros that are proved to be no zeros of all equations.
    """
    boxes, points, refuted, left = found.boxes, found.points, set(), tested
    seen: set[tuple[int, ...]] = set()

    @cache
    def chosen(i: int) -> list[int]:
        return independent_equations(equations, slices, points[i])

    def is_chosen(rows: list[int], places: np.ndarray, i: int) -> bool:
        return chosen(int(places[i])) == rows

    while len(left):
        # Another point may need other equations: in balls, each is tried with its own alone.
        rows = chosen(int(left[0]))
        if tuple(rows) in seen:
            left = left[1:]
            continue
        seen.add(tuple(rows))
        square = [equations[i] for i in rows]
        others = [f for i, f in enumerate(equations) if i not in set(rows)]
        own = partial(is_chosen, rows, left)
        _enter(boxes, left, prove_boxes(square, slices, points[left], reach[left], own))
        for i in left[boxes.proved[left]].tolist():
            vanishing, exact = _vanish_at_others(square, others, slices, points[i])
            found.digits[i] = np.inf if exact else vanishing
            if not vanishing:
                refuted.add(i)
            proofs[i] = Proof.SIMPLE if exact else Proof.PART
            boxes.proved[i] = exact or vanishing >= EQUALITY_DIGITS
            if not boxes.proved[i]:
                proofs[i] = Proof.NONE
        left = np.array([i for i in left[1:] if not boxes.proved[i] and i not in refuted], int)
    return refuted


def distinct_simple(groups: Sequence[CertifiedPoints]) -> int:
    """Number of simple zeros of points of one system that are proved, and proved distinct."""
    boxes = joined_boxes(groups, Proof.SIMPLE)
    same, unknown = find_overlaps(boxes)
    return len(boxes.centres) - len({j for _, j in [*same, *unknown]})


def joined_boxes(groups: Sequence[CertifiedPoints], *proofs: Proof) -> Boxes:
    """The boxes of all points with one of these proofs, group by group."""
    parts = [(g, g.having(*proofs)) for g in groups]
    for g, chosen in parts:
        if len(chosen) == len(g.points) == sum(len(some) for _, some in parts):
            # All boxes are those of one group, and may be many.
            return g.boxes
    fine, start = {}, 0
    for g, chosen in parts:
        fine |= {
            start + k: g.boxes.fine[i] for k, i in enumerate(chosen.tolist()) if i in g.boxes.fine
        }
        start += len(chosen)
    return Boxes(
        np.concatenate([g.boxes.centres[i] for g, i in parts]),
        np.concatenate([g.boxes.outer[i] for g, i in parts]),
        np.concatenate([g.boxes.inner[i] for g, i in parts]),
        np.concatenate([g.boxes.proved[i] for g, i in parts]),
        fine,
    )


def _enter(boxes: Boxes, places: np.ndarray, found: Boxes) -> None:
    boxes.centres[places], boxes.outer[places] = found.centres, found.outer
    boxes.inner[places], boxes.proved[places] = found.inner, found.proved
    boxes.fine.update({int(places[i]): box for i, box in found.fine.items()})


def independent_equations(
    equations: Sequence[Polynomial], slices: np.ndarray, point: np.ndarray
) -> list[int]:
    """Equations that determine the point on the slice, as many as are needed."""
    evaluator = Evaluator.of(equations, len(point))
    jacobian = evaluator.jacobian(point)
    # A gradient that is rounding beside its terms is not scaled up.
    terms = evaluator.sizes(point[None])[0] / max(1.0, float(np.abs(point).max(initial=0.0)))
    jacobian /= np.maximum(np.linalg.norm(jacobian, axis=1), FLAT * terms)[:, None]
    if len(slices):
        q, _ = np.linalg.qr(slices[:, 1:].conj().T)
        jacobian = jacobian - (jacobian @ q) @ q.conj().T
    # A gradient beyond the range of doubles says nothing.
    jacobian[~np.isfinite(jacobian).all(axis=1)] = 0
    return sorted(pivot_rows(jacobian, len(point) - len(slices))[0])


def _vanish_at_others(
    square: Sequence[Polynomial],
    others: Sequence[Polynomial],
    slices: np.ndarray,
    point: np.ndarray,
) -> tuple[float, bool]:
    """Digits to which other equations vanish at a proved zero, and whether that is exact.

    No digits where one of them is proved not to vanish. A rational zero is tested exactly.
    """
    start = [flint.acb(complex(z)) for z in point]
    box = box_about(BallPolynomials.of(square, slices), start, (BITS[-1],))
    if box is None:
        return EQUALITY_DIGITS / 2, False
    rest = BallPolynomials.of(others, slices[:0])
    digits = vanishing_digits(rest, box)
    if len(slices) or not digits:
        return digits, False
    with in_bits(BITS[-1]):
        exact = rational_point(box.centre, DIGITS)
        if exact is None or any(f(exact) for f in [*square, *others]):
            return digits, False
        off = [abs(z - to_ball(q)) for z, q in zip(box.centre, exact, strict=True)]
        return digits, all(d < r for d, r in zip(off, box.outer, strict=True))


def _singular(
    equations: Sequence[Polynomial],
    slices: np.ndarray,
    result: CertifiedPoints,
    proofs: list[Proof],
    i: int,
    accuracy: float,
) -> bool:
    """What is proved of a point that may be singular; enters it at place ``i``.

    Returns:
        Whether it seems to be a simple zero, of which nothing is entered.
    """
    rng = np.random.default_rng(0)
    boxes = result.boxes
    point = boxes.centres[i]
    error = max(accuracy, ROUNDED) if np.isfinite(accuracy) else NEAR
    end = analyse(equations, point, error, rng, slices if len(slices) else None)
    if end.place is not Place.ISOLATED or end.precise is None:
        return False
    if end.rational is not None and not len(slices):
        if any(f(end.rational) for f in equations):
            return False
        exact = all(f.exact for f in equations)
        if exact and jacobian_rank(equations, end.rational) == len(point):
            return True
        enter_box(boxes, i, _rational_box(end.rational))
        proofs[i], result.digits[i], result.real[i] = Proof.EXACT, np.inf, True
        result.multiplicities[i] = end.multiplicity
        return False
    found = deflated_zero(equations, slices, end.precise, rng)
    if found is None or found.vanishing < EQUALITY_DIGITS:
        return False
    if not found.rounds:
        return True
    proofs[i], result.real[i] = Proof.DEFLATED, found.real
    result.multiplicities[i] = end.multiplicity
    result.digits[i] = found.vanishing if found.left else np.inf
    box, n = found.box, len(point)
    # Of the deflated equations the zero is the only one in its box, of the given ones it need not.
    enter_box(boxes, i, FineBox(box.centre[:n], (flint.arb(0),) * n, box.inner[:n]))
    return False


def _rational_box(point: Sequence[Fraction]) -> FineBox:
    with in_bits(BITS[-1]):
        exact = [to_ball(c) for c in point]
        centre = tuple(middle(z) for z in exact)
        off = tuple(flint.acb(abs(z - c)).abs_upper() for z, c in zip(exact, centre, strict=True))
    return FineBox(centre, (flint.arb(0),) * len(point), off)


def points_rows(
    groups: Iterable[CertifiedPoints], what: str, images: Sequence[CertifiedPoints] = ()
) -> list[tuple[str, str]]:
    """How many of the points of several groups are proved, in which way, and how far off they are.

    Args:
        what: what the points are.
        images: those of components that symmetries carry others into.
    """
    groups = list(groups)
    counts = Counter(p for g in groups for p in g.proofs)
    total = sum(counts.values())
    evidence = sum(int(g.on_evidence.sum()) for g in groups)
    proved = total - counts[Proof.NONE]
    more = f"; {evidence} on evidence" if evidence else ""
    rows = [("certified", f"{proved - evidence} of {total} {what}{more}")]
    rows += [
        ("", f"{counts[p]} {WORDS[p].format(digits=_least_digits(groups, p))}")
        for p in Proof
        if counts[p]
    ]
    if images:
        there = sum(int(g.boxes.proved.sum()) for g in images)
        points = sum(len(g.points) for g in images)
        text = f"besides {there} of {points} on {len(images)} more components, by symmetries"
        rows.append(("", text))
    errors = [g.errors()[g.boxes.proved] for g in groups]
    largest = max((float(e.max()) for e in errors if len(e)), default=0.0)
    if proved:
        text = f"no point is further from its zero than {magnitude(largest)}, relative to its size"
        rows.append(("error", text))
    return rows


def _least_digits(groups: Iterable[CertifiedPoints], proof: Proof) -> str:
    """Digits to which equations that a proof of this kind did not need vanish, in words."""
    digits = (float(g.digits[g.having(proof)].min(initial=np.inf)) for g in groups)
    least = min(digits, default=np.inf)
    if np.isinf(least):
        return "all digits"
    return f"{least:.0f} digits, which is evidence and no proof"


def cost_row(groups: Sequence[CertifiedPoints], seconds: float) -> tuple[str, str]:
    """In what arithmetic points were proved, and how long it took."""
    fine = sum(len(g.boxes.fine) for g in groups)
    proved = sum(int(g.boxes.proved.sum()) for g in groups)
    text = f"{proved - fine} boxes in doubles, {fine} in balls of more digits"
    return ("proof", printable(f"{text}, {seconds:.3f} s"))
