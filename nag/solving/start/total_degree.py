"""Total degree start systems: x_i^d_i = c_i, with as many solutions as Bezout's number.

Linear equations of the target belong to the start system as well, so that they hold all the way.
In a generic start system linear forms stand in place of the variables, and each equation is joined
by multiples of the others. Paths to infinity then end on fewer branches at a time, and no
coefficient is so small, as powers of variables and forms may be there, that it counts only very
near the end. The price is longer polynomials.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations_with_replacement
from math import comb, factorial, frexp, hypot, lcm, prod

import numpy as np

from nag.algebra.polynomial import Exponents
from nag.errors import StartError
from nag.numerics.double_ranks import DEPENDENT
from nag.numerics.doubles import LARGEST_WHOLE
from nag.solving.start.interchange import Interchange, interchange
from nag.solving.start.target import (
    StartSystem,
    Target,
    Terms,
    group_degrees,
    homogenize_rows,
    unit,
)
from nag.tracking.homotopy import straight_line
from nag.tracking.known import KnownOfPaths
from nag.tracking.starts import StartsByIndex

# Longest generic start systems.
MOST_TERMS = 10_000
# Ends are kept in memory.
MOST_PATHS = 4_000_000

Row = dict[Exponents, complex]


def bezout(target: Target) -> int:
    """The product of the degrees."""
    return prod(target.degrees)


def has_bezouts_volume(supports: Sequence[np.ndarray]) -> bool:
    """Whether the mixed volume of the supports is the product of their degrees.

    It is where, of any number of the homogeneous coordinates, but not all, at least as many rows
    have a term in these alone (what Chen, Unmixing the mixed volume computation, 2019, says of
    simplices). All sets of coordinates are looked through, two to the number of them.

    Args:
        supports: the exponents of each row, shape ``(terms, n)``.
    """
    n = len(supports)
    powers = 2 ** np.arange(1 + n)
    touched = np.zeros((n, 2 ** (1 + n)), dtype=bool)
    for row, support in zip(touched, supports, strict=True):
        size = support.sum(axis=1)
        row[(support > 0) @ powers[1:] + (size < size.max(initial=0))] = True
    sizes = np.zeros(2 ** (1 + n), dtype=np.int64)
    for power in powers.tolist():
        # What lies in a set of coordinates lies in each that has one more.
        halves = touched.reshape(n, -1, 2, power)
        halves[:, :, 1] |= halves[:, :, 0]
        sizes.reshape(-1, 2, power)[:, 1] += 1
    return bool((touched.sum(axis=0) >= sizes)[:-1].all())


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


@dataclass(frozen=True, eq=False)
class Shape:
    """What a total degree start system consists of.

    Attributes:
        linear, matrix, solved: see `_linear_rows`.
        rows: the other rows, in the order of ``free``, the variables that are not solved for.
        interchange: which of these may be interchanged.
    """

    linear: list[int]
    matrix: np.ndarray
    solved: list[int]
    rows: list[int]
    free: list[int]
    interchange: Interchange

    @classmethod
    def of(cls, target: Target) -> Shape:
        linear, matrix, solved = _linear_rows(target)
        free = [j for j in range(target.n) if j not in solved]
        rows = [i for i in range(target.n) if i not in linear]
        found = interchange(target, rows, free)
        others = iter([i for i in rows if i not in found.owner.values()])
        rows = [found.owner[j] if j in found.owner else next(others) for j in free]
        return cls(linear, matrix, solved, rows, free, found)


def _powers(
    n: int, free: list[int], forms: np.ndarray, degrees: list[int], constants: np.ndarray
) -> list[Row]:
    """Powers of linear forms in the free variables, less constants."""
    rows: list[Row] = []
    for form, d, c in zip(forms.tolist(), degrees, constants, strict=True):
        line = {_unit_vector(j, n): a for j, a in zip(free, form, strict=True) if a}
        if len(line) == 1:
            ((e, a),) = line.items()
            row: Row = {tuple(d * k for k in e): a**d}
        else:
            row = {(0,) * n: 1.0}
            for _ in range(d):
                row = _product(row, line)
        rows.append({**row, (0,) * n: -complex(c)} if d else row)
    return rows


def _roots(
    n: int, free: list[int], degrees: list[int], constants: np.ndarray, index: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Combinations of roots of the constants, by index, at the free variables' coordinates.

    Points of shape ``(P, 1 + n)``, and the numbers of the roots, shape ``(P, n)``.
    """
    points = np.ones((len(index), 1 + n), dtype=np.complex128)
    roots = np.zeros((len(index), n), dtype=np.int64)
    for j, d, c in zip(free, degrees, constants, strict=True):
        if d:
            roots[:, j] = index % d
            points[:, 1 + j] = complex(c) ** (1 / d) * np.exp(2j * np.pi * roots[:, j] / d)
            index = index // d
    return points, roots


def total_degree(
    target: Target,
    rng: np.random.Generator,
    generic: bool = False,
    shape: Shape | None = None,
) -> StartSystem:
    """The straight-line homotopy from ``x_i^d_i = c_i`` with random ``|c_i| = 1``.

    The constants of variables that may be interchanged are the same.

    Args:
        target: the system to be solved.
        rng: gives the constants.
        generic: whether the start system is to be generic, unless it would be too long.
        shape: what `Shape.of` says of the target, if that is known.

    Raises:
        StartError: if there are more paths than memory is for.
    """
    n, degrees = target.n, target.degrees
    paths = bezout(target)
    if paths > MOST_PATHS:
        raise StartError(f"total degree: {paths} paths; at most {MOST_PATHS} are tracked")
    shape = shape or Shape.of(target)
    free, rows, matrix = shape.free, shape.rows, shape.matrix
    constants = unit(rng, len(rows))
    gamma = complex(unit(rng, 1)[0])
    wanted = [degrees[i] for i in rows]
    generic = generic and sum(comb(len(free) + d, d) for d in wanted) <= MOST_TERMS
    if not generic:
        for block in shape.interchange.blocks:
            places = [free.index(j) for j in block]
            constants[places] = constants[places[0]]
    forms = _unitary(len(free), rng) if generic else np.eye(len(free))
    start_rows = _powers(n, free, forms, wanted, constants)
    if generic:
        start_rows = _generic_rows(start_rows, n, free, wanted, rng)
    groups = (tuple(range(n)),)
    degrees_of_rows = group_degrees([target.rows[i] for i in rows], groups)
    goal = homogenize_rows([target.rows[i] for i in rows], n, groups, degrees_of_rows)
    begin = homogenize_rows(start_rows, n, groups, degrees_of_rows)

    def start_points(index: np.ndarray) -> np.ndarray:
        points, _ = _roots(n, free, wanted, constants, index)
        # These are values of the forms; the adjoint of a unitary matrix is its inverse.
        columns = [1 + j for j in free]
        points[:, columns] = points[:, columns] @ forms.conj()
        if shape.linear:
            columns = [1 + j for j in shape.solved]
            known = [0, *(1 + j for j in free)]
            right = points[:, known] @ matrix[:, known].T
            points[:, columns] = -np.linalg.solve(matrix[:, columns], right.T).T
        return points

    orbits = None
    if shape.interchange.blocks and not generic:
        _, roots = _roots(n, free, wanted, constants, np.arange(paths))
        orbits = shape.interchange.orbits(roots, 1)
    points = StartsByIndex((paths, 1 + n), start_points)
    homotopy = straight_line(begin, goal, gamma, matrix)
    return StartSystem("total", homotopy, points, groups, known=KnownOfPaths(orbits=orbits))
