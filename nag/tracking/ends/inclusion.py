"""Krawczyk's test in ball arithmetic: proof of exactly one zero of a homotopy at t = 0 in a box.

For a box X with midpoint x and any matrix Y near the inverse Jacobian, all zeros in X lie in
``K(X) = x - Y F(x) + (1 - Y F'(X)) (X - x)``; if K(X) lies in the interior of X, there is exactly
one, and it is regular. F are the rows of the homotopy and a patch through x for each group.
Reference:
    Krawczyk, Newton-Algorithmen zur Bestimmung von Nullstellen mit Fehlerschranken, 1969;
    Burr, Lee & Leykin, Effective certification of approximate solutions, 2019.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import flint
import numpy as np

from nag.tracking.ends.terms import BITS, Factors, Terms, number

# Most that the radii of the box are, in rounding errors of the coordinates, and in Newton's steps.
WIDER, STEPS = 64.0, 16.0
# Least part of the first that is taken; of a zero in twice the digits, its square.
TINY = 1e-12
# Newton's steps to a regular zero, in the one before, at most.
SHRINKS = 0.01


def proved(terms: Terms, centre: np.ndarray, errors: np.ndarray) -> np.ndarray | None:
    """Radii of a box about a point that holds one zero only, a regular one; None if none is proved.

    Slopes over a box do not see that errors in the coordinates of a badly conditioned zero go
    together: where they are too wide over a box of the size of these, the box is laid about the
    zero that they lead to in twice as many digits.

    Args:
        terms: the homotopy's.
        centre: coordinates, shape ``(N, 2, words)``.
        errors: of the coordinates, shape ``(N,)``.

    Returns:
        Half sides, some rounding errors of the coordinates or less, shape ``(N,)``.
    """
    bits = BITS[centre.shape[-1]]
    if not np.isfinite(centre).all() or not np.isfinite(errors).all():
        return None
    sizes = np.hypot(*centre[:, :, 0].T)
    # A coordinate that vanishes has no size of its own; of one that does not, the box must not be
    # larger than it.
    sizes = np.where(sizes > 0, sizes, sizes.max(initial=0.0))
    most = WIDER * errors + sizes * 2.0 ** -(bits // 2 + 40)
    if not most.all():
        # Boxes as small leave the range of doubles.
        return None
    with flint.ctx.workprec(bits):
        x = [number(c) for c in centre]
        linear = _linearize(terms, x)
        if linear is None:
            return None
        radii = _radii_of_box(terms, x, linear, most, TINY)
        if radii is not None:
            return radii
        near = _next_if_convergent(terms, x, linear, most)
    if near is None:
        return None
    with flint.ctx.workprec(2 * bits):
        linear = _linearize(terms.finer, near)
        if linear is None:
            return None
        zero = _after_step(near, linear.step)
        away = np.array([float((z - c).abs_upper()) for z, c in zip(zero, x, strict=True)])
        linear = _linearize(terms.finer, zero) if (away < most).all() else None
        if linear is None:
            return None
        radii = _radii_of_box(terms.finer, zero, linear, most, TINY**2)
    return None if radii is None else away + radii


class _Linear(NamedTuple):
    """A matrix near the inverse Jacobian at a point, Newton's step there, and the patches."""

    inverse: flint.acb_mat
    step: flint.acb_mat
    patches: list[list[Any]]


def _linearize(terms: Terms, x: list[Any]) -> _Linear | None:
    """What there is at a point; None if the Jacobian has no inverse."""
    patches = patches_through(flint, terms, x)
    values, jacobian = system_at(flint, terms, patches, x)
    try:
        inverse = jacobian.mid().inv().mid()
    except ZeroDivisionError:
        return None
    return _Linear(inverse, inverse * values, patches)


def _after_step(x: list[Any], step: flint.acb_mat) -> list[Any]:
    return [(z - s).mid() for z, s in zip(x, step.entries(), strict=True)]


def _next_if_convergent(
    terms: Terms, x: list[Any], linear: _Linear, most: np.ndarray
) -> list[Any] | None:
    """The point after Newton's step from ``x``; None if the next one is not far smaller.

    Steps to a regular zero shrink with the distance from it; to a multiple one, by a constant.
    """
    near = _after_step(x, linear.step)
    values, _ = system_at(flint, terms, linear.patches, near)
    first, second = (
        max(float(s.abs_upper()) / r for s, r in zip(step.entries(), most.tolist(), strict=True))
        for step in (linear.step, linear.inverse * values)
    )
    return near if second < SHRINKS * first < SHRINKS else None


def _radii_of_box(
    terms: Terms, x: list[Any], linear: _Linear, most: np.ndarray, least: float
) -> np.ndarray | None:
    """Half sides of a box about ``x`` that Krawczyk's operator maps into itself.

    Args:
        most: the largest that they may be, shape ``(N,)``; least: the least part of these.
    """
    N = terms.homotopy.N
    inverse, newton, patches = linear
    # The box must not be larger than Newton's step asks for.
    steps = [float(newton[j, 0].abs_upper()) / r for j, r in enumerate(most.tolist())]
    part = min(1.0, STEPS * max(steps, default=0.0) + least)
    radii = [part * r for r in most.tolist()]
    box = [z + flint.acb(flint.arb(0, r), flint.arb(0, r)) for z, r in zip(x, radii, strict=True)]
    _, slopes = system_at(flint, terms, patches, box)
    rest = flint.acb_mat(N, N, [int(i == j) for i in range(N) for j in range(N)]) - inverse * slopes
    moved = flint.acb_mat(N, 1, [b - z for b, z in zip(box, x, strict=True)])
    image = rest * moved - newton
    inside = all(bool(image[j, 0].abs_upper() < flint.arb(r)) for j, r in enumerate(radii))
    return np.array(radii) if inside else None


def patches_through(flint: Any, terms: Terms, x: list[Any]) -> list[list[Any]]:
    """One row for each group, whose product with the point is 1."""
    rows = []
    for group in terms.homotopy.groups:
        conjugates = [z.mid().conjugate() if j in group else flint.acb(0) for j, z in enumerate(x)]
        size = sum((c * z for c, z in zip(conjugates, x, strict=True)), flint.acb(0)).mid()
        rows.append([(c / size).mid() for c in conjugates])
    return rows


def system_at(flint: Any, terms: Terms, patches: list[list[Any]], x: list[Any]) -> tuple[Any, Any]:
    """Values and Jacobian of the rows at t = 0 and of the patches.

    The rows are homogeneous: what their derivatives make of the point is their degree times their
    value (Euler).
    """
    N = terms.homotopy.N
    degrees = [sum(k for _, k in row[0][0]) if row else 1 for row in terms.at_end]
    rows = [_slopes(row, x, [flint.acb(0)] * N) for row in terms.at_end]
    rows += terms.lines
    first = len(rows)
    rows += patches
    jacobian = flint.acb_mat(rows)
    values = (jacobian * flint.acb_mat([[z] for z in x])).entries()
    for i, degree in enumerate(degrees):
        if degree > 1:
            values[i] = values[i] / degree
    values[first:] = [value - 1 for value in values[first:]]
    return flint.acb_mat(N, 1, values), jacobian


def _slopes(row: list[tuple[Factors, Any]], x: list[Any], slopes: list[Any]) -> list[Any]:
    """The derivatives of a row, added to ``slopes``."""
    for factors, c in row:
        if len(factors) == 2 and factors[0][1] == factors[1][1] == 1:
            (i, _), (j, _) = factors
            slopes[i] += c * x[j]
            slopes[j] += c * x[i]
            continue
        after = [c]
        for j, k in reversed(factors[1:]):
            after.append(after[-1] * x[j] ** k)
        before = None
        for j, k in factors:
            rest = after.pop() if before is None else after.pop() * before
            slopes[j] += rest * k * x[j] ** (k - 1) if k > 1 else rest
            power = x[j] ** k
            before = power if before is None else before * power
    return slopes
