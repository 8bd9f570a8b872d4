"""Krawczyk's test in ball arithmetic: proof of exactly one zero of a homotopy at t = 0 in a box.

It is that of `nag.numerics.krawczyk`, for the rows of the homotopy and a patch through the point
for each group, and a box of the size of the errors that the path's end is known to.
"""

from __future__ import annotations

import flint
import numpy as np

from nag.numerics.ball_boxes import BallOperator
from nag.numerics.digits import number_of_words, round_up
from nag.numerics.newton import newton_step, subtract_step
from nag.tracking.ends.terms import BITS, Terms

# Rounding errors in the radius of the box in which Krawczyk's test proves one zero; it must hold
# the errors of the values there.
WIDER = 64.0
# Newton's steps in that radius, at least: the box need not be larger where these are small.
STEPS = 16.0
# Least part of the first that is taken; of a zero in twice the digits, its square.
TINY = 1e-12
# Decides: Newton's step to a regular zero, in the one before, at most, with one Jacobian; to a
# double one it is a fourth of that.
SHRINKS = 0.01


def prove_end(terms: Terms, centre: np.ndarray, errors: np.ndarray) -> np.ndarray | None:
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
    x = [number_of_words(c) for c in centre]
    about = BallOperator.about(terms.with_patches(x, bits), x, bits)
    if about is None:
        return None
    radii = _radii_of_box(about, most, TINY)
    if radii is not None:
        return radii
    near, bits = _next_if_convergent(about, most), 2 * bits
    step = None if near is None else newton_step(terms.with_patches(near, bits), near, bits)
    if step is None:
        return None
    zero = subtract_step(near, step, bits)
    away = np.array([float((z - c).abs_upper()) for z, c in zip(zero, x, strict=True)])
    if not (away < most).all():
        return None
    about = BallOperator.about(terms.with_patches(zero, bits), zero, bits)
    radii = None if about is None else _radii_of_box(about, most, TINY**2)
    return None if radii is None else away + radii


def _next_if_convergent(about: BallOperator, most: np.ndarray) -> list[flint.acb] | None:
    """The point after Newton's step from the centre; None if the next one is not far smaller.

    Steps to a regular zero shrink with the distance from it; to a multiple one, by a constant.
    """
    first = _largest_part(about.step, most)
    if first >= 1:
        return None
    near = subtract_step(about.x, about.step, about.bits)
    next_step = newton_step(about.system, near, about.bits, about.inverse)
    return near if _largest_part(next_step, most) < SHRINKS * first else None


def _largest_part(step: list[flint.acb], most: np.ndarray) -> float:
    """The largest coordinate of a step beside what it may be."""
    parts = (float(s.abs_upper()) / r for s, r in zip(step, most.tolist(), strict=True))
    return max(parts, default=0.0)


def _radii_of_box(about: BallOperator, most: np.ndarray, least: float) -> np.ndarray | None:
    """Half sides of the smallest box that is seen to hold the one zero of another.

    That other one is such that Krawczyk's operator maps it into itself.

    Args:
        most: the largest that they may be, shape ``(N,)``; least: the least part of these.
    """
    # The box must not be larger than Newton's step asks for.
    part = min(1.0, STEPS * _largest_part(about.step, most) + least)
    radii = about.zero_in([flint.arb(part * r) for r in most.tolist()])
    return None if radii is None else np.array([round_up(r) for r in radii])
