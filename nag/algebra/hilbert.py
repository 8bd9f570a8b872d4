"""Dimension and degree of an ideal from the leading monomials of a Groebner basis."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from nag.algebra.polynomial import Exponents, divides


def dimension_and_degree(monomials: Iterable[Exponents], n: int) -> tuple[int, int]:
    """Dimension and degree of the zero set of an ideal, its components counted by multiplicity.

    The numerator of the Hilbert series of the leading monomials, divided by 1 - t as often as it
    can be (Cox, Little & O'Shea, Ideals, Varieties, and Algorithms, section 9.3). For an order
    that compares degrees first these are those of the affine variety; the dimension is right for
    every order.

    Args:
        monomials: exponents of the leading monomials, in ``n`` variables.

    Returns:
        (-1, 0) for the whole ring.
    """
    series = _numerator(_minimal(monomials))
    if not any(series):
        return -1, 0
    dimension = n
    while sum(series) == 0:
        # Division by 1 - t: partial sums.
        quotient, total = [], 0
        for c in series[:-1]:
            total += c
            quotient.append(total)
        series, dimension = quotient, dimension - 1
    return dimension, sum(series)


def _minimal(monomials: Iterable[Exponents]) -> list[Exponents]:
    kept: list[Exponents] = []
    for e in sorted(set(monomials), key=sum):
        if not any(divides(f, e) for f in kept):
            kept.append(e)
    return kept


def _numerator(monomials: Sequence[Exponents]) -> list[int]:
    """Coefficients of the numerator over (1 - t)^n, by the exact sequence of a pivot."""
    counts = [
        sum(1 for e in monomials if e[i]) for i in range(len(monomials[0]) if monomials else 0)
    ]
    if any(sum(e) == 0 for e in monomials):
        return [0]
    if all(c <= 1 for c in counts):
        # Coprime monomials: a product of 1 - t^d.
        series = [1]
        for e in monomials:
            d = sum(e)
            longer = [*series, *[0] * d]
            for i, c in enumerate(series):
                longer[i + d] -= c
            series = longer
        return series
    pivot = counts.index(max(counts))
    power = min(e[pivot] for e in monomials if e[pivot])
    x = tuple(power if i == pivot else 0 for i in range(len(counts)))
    with_x = _numerator(_minimal([*monomials, x]))
    quotients = [tuple(max(a - b, 0) for a, b in zip(e, x, strict=True)) for e in monomials]
    by_x = _numerator(_minimal(quotients))
    series = [0] * max(len(with_x), len(by_x) + power)
    for i, c in enumerate(with_x):
        series[i] += c
    for i, c in enumerate(by_x):
        series[i + power] += c
    return series
