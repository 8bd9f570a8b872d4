"""Exact numbers as FLINT's rationals, and the way back."""

from __future__ import annotations

from fractions import Fraction

import flint


def to_rational(c: Fraction | int) -> flint.fmpq:
    """A fraction as FLINT's."""
    return flint.fmpq(*c.as_integer_ratio())


def to_fraction(q: flint.fmpq) -> Fraction:
    """One of FLINT's as Python's."""
    return Fraction(int(q.p), int(q.q))
