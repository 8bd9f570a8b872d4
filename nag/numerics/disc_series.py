"""Discs that move: polynomials in a parameter between -1 and 1, with discs as coefficients.

A series stands for all functions of s whose value at each s in [-1, 1] is the sum of ``c_k s^k``
with a number ``c_k`` of each disc, which may be another one for another s. The last coefficient
takes in what a product has of higher order (a Taylor model).

Reference:
    Makino & Berz, Taylor models and other validated functional inclusion methods, 2003.
"""

from __future__ import annotations

import numpy as np

from nag.numerics.discs import (
    LEAST,
    UP,
    DiscPolynomials,
    Discs,
    Weights,
    magnitude,
    rounding_of_sum,
)


def series_product(a: Discs, b: Discs) -> Discs:
    """Series of the products; coefficients stand along the first axis."""
    length = len(a.mid)
    size_a, size_b = magnitude(a.mid), magnitude(b.mid)
    most_a, most_b = size_a + a.rad, size_b + b.rad
    shape = np.broadcast_shapes(a.mid.shape, b.mid.shape)
    mid = np.zeros(shape, dtype=complex)
    sizes, most = np.zeros(shape), np.zeros(shape)
    for i in range(length):
        mid[i:] += a.mid[i] * b.mid[: length - i]
        sizes[i:] += size_a[i] * size_b[: length - i]
        most[i:] += most_a[i] * most_b[: length - i]
    # What the factors' radii add is the difference, up to rounding.
    rad = most - sizes + 2 * rounding_of_sum(length) * most
    for i in range(1, length):
        rad[-1] += most_a[i] * most_b[length - i :].sum(axis=0)
    return Discs(mid, rad * (UP + rounding_of_sum(length * length)) + LEAST)


def series_sum(a: Discs, b: Discs) -> Discs:
    """Series of the sums."""
    mid = a.mid + b.mid
    return Discs(mid, (a.rad + b.rad + magnitude(mid) * 2.0**-51) * UP + LEAST)


def values_along(system: DiscPolynomials, x: Discs) -> Discs:
    """Values on series of boxes, shape ``(length, P, n)``: shape ``(length, P, rows)``."""
    return _weighted(system.values, _monomials(system, x))


def slopes_along(system: DiscPolynomials, x: Discs) -> Discs:
    """Jacobian matrices on series of boxes: shape ``(length, P, rows, n)``."""
    found = _weighted(system.slopes, _monomials(system, x))
    shape = (*x.mid.shape[:2], system.rows, system.n)
    return Discs(found.mid.reshape(shape), found.rad.reshape(shape))


def _weighted(weights: Weights, monomials: Discs) -> Discs:
    """Sums of monomials, shape ``(length, M, P)``, to shape ``(length, P, rows)``."""
    length, count, P = monomials.mid.shape
    flat = [c.transpose(1, 0, 2).reshape(count, -1) for c in monomials]
    found = weights @ Discs(*flat)
    return Discs(*(c.reshape(-1, length, P).transpose(1, 2, 0) for c in found))


def _monomials(system: DiscPolynomials, x: Discs) -> Discs:
    """All monomials of a system, shape ``(length, M, P)``."""
    base = Discs(*(np.ascontiguousarray(c.transpose(0, 2, 1)) for c in x))
    one = Discs(np.zeros_like(base.mid), np.zeros_like(base.rad))
    one.mid[0] = 1.0
    table = [one, base]
    while len(table) <= system.top:
        table.append(series_product(table[-1], base))
    mid = np.concatenate([t.mid for t in table[: system.top + 1]], axis=1)
    rad = np.concatenate([t.rad for t in table[: system.top + 1]], axis=1)
    first, *others = system.powers
    found = Discs(mid[:, first], rad[:, first])
    for places in others:
        several = np.flatnonzero(places)
        these = Discs(found.mid[:, several], found.rad[:, several])
        more = Discs(mid[:, places[several]], rad[:, places[several]])
        found.mid[:, several], found.rad[:, several] = series_product(these, more)
    return found
