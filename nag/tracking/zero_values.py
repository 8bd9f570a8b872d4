"""The exact isolated zero that a point stands for: its multiplicity, and what vanishes there.

Where several zeros are so close that the point may stand for any of them, only what is the same
at all of them is known.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from nag.algebra.high_precision import vanish_at
from nag.algebra.polynomial import Polynomial
from nag.numerics.singular_point import Place, SingularEnd, analyse


def _zeros(
    equations: Sequence[Polynomial], x: np.ndarray, accuracy: float
) -> tuple[SingularEnd, ...]:
    """The isolated zeros that ``x`` may stand for; none if that is left open."""
    end = analyse(equations, x, accuracy, np.random.default_rng(0))
    if end.place is Place.CLUSTER:
        return end.nearby
    return (end,) if end.place is Place.ISOLATED else ()


def vanish_at_zero(
    equations: Sequence[Polynomial],
    x: np.ndarray,
    accuracy: float,
    polynomials: Sequence[Polynomial],
) -> bool | None:
    """Whether ``polynomials`` vanish at the isolated zero of ``equations`` near ``x``.

    It is computed to 100 digits. None if that does not succeed, or they vanish at some of several
    zeros.
    """
    answers = {vanish_at(polynomials, zero.digits) for zero in _zeros(equations, x, accuracy)}
    return answers.pop() if len(answers) == 1 else None


def multiplicity_at_zero(
    equations: Sequence[Polynomial], x: np.ndarray, accuracy: float
) -> int | None:
    """The multiplicity of the isolated zero of ``equations`` near ``x``; None if not found."""
    answers = {zero.multiplicity for zero in _zeros(equations, x, accuracy)}
    return answers.pop() if len(answers) == 1 else None
