"""Discs that move: polynomials in a parameter between -1 and 1, with discs as coefficients.

A series stands for all functions of s whose value at each s in [-1, 1] is the sum of ``c_k s^k``
with a number ``c_k`` of each disc, which may be another one for another s. The last coefficient
takes in what a product has of higher order (a Taylor model).

Reference:
    Makino & Berz, Taylor models and other validated functional inclusion methods, 2003.
"""

from __future__ import annotations

from functools import cache

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


@cache
def _collected(length: int) -> tuple[np.ndarray, np.ndarray]:
    """Which products of coefficients belong to which one, and those of too high an order.

    Matrices of zeros and ones, shape ``(length^2, length)``; the second has entries in the last
    column only.
    """
    inside, beyond = np.zeros((2, length * length, length))
    for i in range(length):
        for j in range(length):
            if i + j < length:
                inside[i * length + j, i + j] = 1.0
            else:
                beyond[i * length + j, -1] = 1.0
    return inside, beyond


def _pairs(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """All products of coefficients of two series."""
    found = a[..., :, None] * b[..., None, :]
    return found.reshape(*found.shape[:-2], -1)


def series_product(a: Discs, b: Discs) -> Discs:
    """Series of the products; coefficients stand along the last axis."""
    length = a.mid.shape[-1]
    inside, beyond = _collected(length)
    sizes = _pairs(magnitude(a.mid), magnitude(b.mid))
    whole = _pairs(magnitude(a.mid) + a.rad, magnitude(b.mid) + b.rad)
    # The products' radii are differences of these up to rounding, which the second term holds.
    less = _pairs(magnitude(a.mid), b.rad) + _pairs(a.rad, magnitude(b.mid) + b.rad)
    rounding = rounding_of_sum(length)
    rad = (less + rounding * sizes) @ inside + whole @ beyond
    return Discs(_pairs(a.mid, b.mid) @ inside, rad * (UP + rounding) + LEAST)


def series_sum(a: Discs, b: Discs) -> Discs:
    """Series of the sums."""
    mid = a.mid + b.mid
    return Discs(mid, (a.rad + b.rad + magnitude(mid) * 2.0**-51) * UP + LEAST)


def values_along(system: DiscPolynomials, x: Discs) -> Discs:
    """Values on series of boxes, shape ``(P, n, length)``: shape ``(P, rows, length)``."""
    return _weighted(system.values, _monomials(system, x))


def slopes_along(system: DiscPolynomials, x: Discs) -> Discs:
    """Jacobian matrices on series of boxes: shape ``(P, rows, n, length)``."""
    found = _weighted(system.slopes, _monomials(system, x))
    shape = len(x.mid), system.rows, system.n, x.mid.shape[-1]
    return Discs(found.mid.reshape(shape), found.rad.reshape(shape))


def _weighted(weights: Weights, monomials: Discs) -> Discs:
    count, P, length = monomials.mid.shape
    flat = Discs(monomials.mid.reshape(count, -1), monomials.rad.reshape(count, -1))
    found = weights @ flat
    shape = (-1, P, length)
    return Discs(
        found.mid.reshape(shape).transpose(1, 0, 2), found.rad.reshape(shape).transpose(1, 0, 2)
    )


def _monomials(system: DiscPolynomials, x: Discs) -> Discs:
    """All monomials of a system, shape ``(M, P, length)``."""
    base = Discs(x.mid.transpose(1, 0, 2), x.rad.transpose(1, 0, 2))
    one = Discs(np.zeros_like(base.mid), np.zeros_like(base.rad))
    one.mid[..., 0] = 1.0
    table = [one, base]
    while len(table) <= system.top:
        table.append(series_product(table[-1], base))
    mid = np.concatenate([t.mid for t in table[: system.top + 1]])
    rad = np.concatenate([t.rad for t in table[: system.top + 1]])
    first, *others = system.powers
    found = Discs(mid[first], rad[first])
    for places in others:
        several = np.flatnonzero(places)
        these = Discs(found.mid[several], found.rad[several])
        found.mid[several], found.rad[several] = series_product(
            these, Discs(mid[places[several]], rad[places[several]])
        )
    return found
