"""Total degree start systems: x_i^d_i = c_i, with as many solutions as Bezout's number.

Linear equations of the target belong to the start system as well, so that they hold all the way.
In a generic start system linear forms stand in place of the variables, and each equation is joined
by multiples of the others. Paths to infinity then end on fewer branches at a time, and no
coefficient is so small, as powers of variables and forms may be there, that it counts only very
near the end. The price is longer polynomials.
"""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from itertools import combinations_with_replacement
from math import comb, factorial, frexp, hypot, lcm, prod

import numpy as np

from nag.algebra.polynomial import Exponents
from nag.solving.start.target import (
    Start,
    StartError,
    Target,
    Terms,
    group_degrees,
    homogenized,
    unit,
)
from nag.tracking.homotopy import straight_line

# Longest generic start systems.
MOST_TERMS = 10_000
# Largest integer such that doubles hold all up to it.
LARGEST_WHOLE = 2**53
# Pivots below this belong to linear equations that depend on others.
DEPENDENT = 1e-10
# Start points are kept in memory.
MOST_PATHS = 4_000_000

Row = dict[Exponents, complex]


def bezout(target: Target) -> int:
    """The product of the degrees."""
    return prod(target.degrees)


def _linear_rows(target: Target) -> tuple[list[int], np.ndarray, list[int]]:
    """Indices of linear rows, their coefficients ``(k, 1 + n)``, and the variables they solve for.

    No rows if they do not determine as many variables as they are, or if doubles do not hold a
    multiple of each: rounded equations may have finite zeros near those at infinity.
    """
    indices = [i for i, d in enumerate(target.degrees) if d == 1]
    matrix = np.zeros((len(indices), 1 + target.n), dtype=np.complex128)
    for k, i in enumerate(indices):
        row = _exact_row(target.rows[i])
        if row is None:
            return [], matrix[:0], []
        for e, c in row.items():
            matrix[k, 1 + e.index(1) if any(e) else 0] = c
    rest, solved = matrix[:, 1:].copy(), []
    for k in range(len(indices)):
        row = rest[k]
        pivot = int(np.abs(row).argmax())
        if abs(row[pivot]) < DEPENDENT:
            return [], matrix[:0], []
        solved.append(pivot)
        rest[k + 1 :] -= np.outer(rest[k + 1 :, pivot] / row[pivot], row)
    return indices, matrix, solved


def _exact_row(row: Terms) -> dict[Exponents, complex] | None:
    """A multiple of a row whose coefficients are doubles, of norm between 1/2 and 1."""
    exact = {e: c for e, c in row.items() if isinstance(c, (int, Fraction))}
    if len(exact) == len(row):
        common = lcm(*(c.denominator for c in exact.values()))
        whole = {e: int(c * common) for e, c in exact.items()}
        if any(abs(c) > LARGEST_WHOLE for c in whole.values()):
            return None
        values = {e: complex(c) for e, c in whole.items()}
    elif all(isinstance(c, (float, complex)) for c in row.values()):
        values = {e: complex(c) for e, c in row.items()}
    else:
        return None
    size = 2.0 ** -frexp(hypot(*(abs(c) for c in values.values())))[1]
    return {e: c * size for e, c in values.items()}


def _unit_vector(j: int, n: int) -> Exponents:
    return tuple(int(k == j) for k in range(n))


def _unitary(size: int, rng: np.random.Generator) -> np.ndarray:
    return np.linalg.qr(rng.normal(size=(size, size)) + 1j * rng.normal(size=(size, size)))[0]


def _random_polynomial(n: int, places: list[int], degree: int, rng: np.random.Generator) -> Row:
    """A polynomial in the variables at ``places`` that is alike in all directions."""
    terms: Row = {}
    for chosen in combinations_with_replacement([-1, *places], degree):
        exponents = [0] * n
        count = factorial(degree)
        for j, k in Counter(chosen).items():
            count //= factorial(k)
            if j >= 0:
                exponents[j] = k
        terms[tuple(exponents)] = complex(rng.normal(), rng.normal()) * count**0.5
    return terms


def _product(first: Row, second: Row) -> Row:
    terms: Row = {}
    for e, c in first.items():
        for f, d in second.items():
            key = tuple(map(int.__add__, e, f))
            terms[key] = terms.get(key, 0.0) + c * d
    return terms


def _generic_rows(
    rows: list[Row], n: int, places: list[int], degrees: list[int], rng: np.random.Generator
) -> list[Row]:
    """Rows with multiples of those of lower degree added; they vanish where all given ones do."""
    result = []
    for degree in degrees:
        total: Row = {}
        for row, lower in zip(rows, degrees, strict=True):
            if lower > degree:
                continue
            part = _product(_random_polynomial(n, places, degree - lower, rng), row)
            size = sum(abs(c) ** 2 for c in part.values()) ** 0.5
            for e, c in part.items():
                total[e] = total.get(e, 0.0) + c / size
        result.append(total)
    return result


def total_degree(target: Target, rng: np.random.Generator, generic: bool = False) -> Start:
    """The straight-line homotopy from ``x_i^d_i = c_i`` with random ``|c_i| = 1``.

    Args:
        target: the system to be solved.
        rng: gives the constants.
        generic: whether the start system is to be generic, unless it would be too long.

    Raises:
        StartError: if there are more paths than memory is for.
    """
    n, degrees = target.n, target.degrees
    paths = bezout(target)
    if paths > MOST_PATHS:
        raise StartError(f"total degree: {paths} paths; at most {MOST_PATHS} are tracked")
    linear, matrix, solved = _linear_rows(target)
    free = [j for j in range(n) if j not in solved]
    rows = [i for i in range(n) if i not in linear]
    constants = unit(rng, len(rows))
    gamma = complex(unit(rng, 1)[0])
    wanted = [degrees[i] for i in rows]
    generic = generic and sum(comb(len(free) + d, d) for d in wanted) <= MOST_TERMS
    forms = _unitary(len(free), rng) if generic else np.eye(len(free))
    start_rows: list[Row] = []
    for form, d, c in zip(forms.tolist(), wanted, constants, strict=True):
        line = {_unit_vector(j, n): a for j, a in zip(free, form, strict=True) if a}
        row: Row = {(0,) * n: 1.0}
        for _ in range(d):
            row = _product(row, line)
        start_rows.append({**row, (0,) * n: -complex(c)} if d else row)
    if generic:
        start_rows = _generic_rows(start_rows, n, free, wanted, rng)
    groups = (tuple(range(n)),)
    shape = group_degrees([target.rows[i] for i in rows], groups)
    goal = homogenized([target.rows[i] for i in rows], n, groups, shape)
    begin = homogenized(start_rows, n, groups, shape)
    points = np.ones((paths, 1 + n), dtype=np.complex128)
    index = np.arange(paths)
    for j, i, c in zip(free, rows, constants, strict=True):
        d = degrees[i]
        if d:
            points[:, 1 + j] = complex(c) ** (1 / d) * np.exp(2j * np.pi * (index % d) / d)
            index = index // d
    # What stands there are values of the forms; the adjoint of a unitary matrix is its inverse.
    columns = [1 + j for j in free]
    points[:, columns] = points[:, columns] @ forms.conj()
    if linear:
        columns = [1 + j for j in solved]
        known = [0] + [1 + j for j in free]
        right = points[:, known] @ matrix[:, known].T
        points[:, columns] = -np.linalg.solve(matrix[:, columns], right.T).T
    return Start("total", straight_line(begin, goal, gamma, matrix), points, groups)
