"""Error-free transformations in lanes (Dekker 1971; Knuth; Ogita, Rump & Oishi 2005)."""

from __future__ import annotations

import math

import numpy as np

from nag.machine_code.lanes import fused


def two_sum(a, b):
    """``(s, e)`` with ``s = fl(a + b)`` and ``s + e = a + b`` exactly."""
    s = a + b
    t = s - a
    return s, (a - (s - t)) + (b - t)


def quick_two_sum(a, b):
    """The same where ``|a| >= |b|`` or ``a`` is zero."""
    s = a + b
    return s, b - (s - a)


def two_product(a, b):
    """``(p, e)`` with ``p = fl(a b)`` and ``p + e = a b`` exactly."""
    p = a * b
    return p, fused(a, b, -p)


def power_near_inverse_root(square):
    """The power of two nearest to the inverse square root of a positive double."""
    return 2.0 ** np.rint(-0.5 * math.log2(square))


def power_near_inverse(size):
    """The power of two nearest to the inverse of a positive double."""
    return 2.0 ** np.rint(-math.log2(size))
