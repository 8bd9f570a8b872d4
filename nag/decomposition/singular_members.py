"""For which parameters a family of complete intersections has singular members.

The null space system w^T J(x, p) = 0, J the derivatives in the variables alone, is solved together
with the equations in variables, parameters and w; its components are projected to the parameters.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations_with_replacement
from math import gcd, lcm

import numpy as np

from nag.algebra.given import check_running, check_whole
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.decomposition.components import decompose
from nag.decomposition.rank_drop import new_names, product
from nag.numerics.zero_values import NONZERO, ON, SINGULAR
from nag.witness.frame import expanded
from nag.witness.given_component import check_system
from nag.witness.sampling import SamplingError, sample
from nag.witness.witness import PathCounts

# Equations of higher degree are not looked for.
HIGHEST = 3
# Largest numerator and denominator of a coefficient, and how far it may be from its fraction.
LARGEST_COEFFICIENT, ROUNDING = 10**4, 1e-8


@dataclass(frozen=True)
class SingularParameters:
    """Where in the space of parameters there are singular points.

    Attributes:
        parameters: their names.
        conditions: for each irreducible set of parameters its equations of lowest degree, integer
            coefficients; no equation where all parameters have singular points.
        paths: what the tracker did.
        complete: whether nothing was left open.
        notes: what was.
    """

    parameters: tuple[str, ...]
    conditions: tuple[tuple[Polynomial, ...], ...]
    paths: PathCounts
    complete: bool
    notes: tuple[str, ...]

    def texts(self) -> list[str]:
        """Each set of parameters in one line."""
        return [
            " and ".join(f"{f.text(self.parameters)} = 0" for f in equations) or "all values"
            for equations in self.conditions
        ]


def singular_parameters(
    system: PolynomialSystem,
    count: int,
    *,
    seed: int = 0,
    threads: int = 1,
    settings: str = "default",
) -> SingularParameters:
    """For which parameters, the last ``count`` variables, the zero set in the others is singular.

    There the transposed Jacobian has a null vector (the rank-deficiency set: Bates, Hauenstein,
    Peterson & Sommese 2009); components of such points are projected to the parameters.

    Args:
        system: a complete intersection in its variables, for general parameters.
        count: how many of the variables are parameters.
        seed: of the random numbers; the same seed gives the same answer for any ``threads``.
        threads: for path tracking.
        settings: ``"fast"``, ``"default"`` or ``"careful"`` tracking.

    Returns:
        For each irreducible set of parameters its equations of lowest degree.

    Raises:
        ValueError: if there are more equations than variables, no complete intersection, or
            another argument makes no sense.

    >>> import nag
    >>> from nag.decomposition import singular_parameters
    >>> singular_parameters(nag.system("x^2 + a*x + b", "x a b"), 2).texts()
    ['a^2 - 4*b = 0']
    """
    check_running(seed, threads, settings)
    n = _variables(system, count)
    whole = _null_space_system(system, n, np.random.default_rng([seed, 8]))
    found = decompose(whole, seed=seed, threads=threads, settings=settings)
    notes, images, conditions = list(found.notes), [], []
    for component in expanded(found).components:
        try:
            points = sample(
                whole, component, _monomial_count(count) // 2 + 4, seed=seed, threads=threads
            ).points
        except (SamplingError, ValueError) as reason:
            notes.append(f"a component of dimension {component.dimension}: {reason}")
            continue
        equations = _equations(points[:, n : n + count])
        if equations is None:
            notes.append("the equations of a set of parameters are not rational, or of high degree")
        elif equations not in conditions:
            conditions.append(equations)
            images.append(points[:, n : n + count])
    names = system.variables[n:]
    largest = [a for a, x in zip(conditions, images, strict=True) if _largest(a, x, conditions)]
    unique = sorted(largest, key=lambda fs: [f.text(names) for f in fs])
    return SingularParameters(
        names, tuple(unique), found.paths, found.complete and not notes, tuple(notes)
    )


def _variables(system: PolynomialSystem, count: int) -> int:
    """How many of the variables are no parameters.

    Raises:
        ValueError: if these are no whole number of them, or leave no complete intersection.
    """
    check_system(system)
    check_whole(count, "count", 1)
    n, m = system.n - count, len(system.polynomials)
    if n < 1:
        raise ValueError(f"count: {count} is given; give fewer than the {system.n} variables")
    if not 0 < m <= n:
        raise ValueError(f"system: {m} equations in {n} variables are no complete intersection")
    return n


def _null_space_system(
    system: PolynomialSystem, n: int, rng: np.random.Generator
) -> PolynomialSystem:
    """Equations and conditions; w keeps its own coordinates, so that what factors still does."""
    total, m = system.n + len(system.polynomials), len(system.polynomials)
    w = [Polynomial.variable(total, system.n + i) for i in range(m)]
    rows = [f.with_variables(total, range(system.n)) for f in system.polynomials]
    for i in range(n):
        terms = [row[i].with_variables(total, range(system.n)) for row in system.jacobian]
        rows.append(product(w, terms))
    rows.append(product(w, [Polynomial.constant(total, int(c)) for c in rng.integers(1, 1000, m)]))
    rows[-1] = rows[-1] - 1
    names = (*system.variables, *new_names(system.variables, m))
    return PolynomialSystem(names, tuple(f for f in dict.fromkeys(rows) if f))


def _largest(
    equations: Sequence[Polynomial], points: np.ndarray, others: Sequence[Sequence[Polynomial]]
) -> bool:
    """Whether a set of parameters lies in no other one."""
    return not any(
        all(abs(f(list(x))) <= ON * max(_size(f, x), ON) for f in other for x in points)
        for other in others
        if other is not equations
    )


def _size(f: Polynomial, x: np.ndarray) -> float:
    return sum(abs(float(c)) * float(np.prod(np.abs(x) ** np.array(e))) for e, c in f.terms.items())


def _monomial_count(count: int) -> int:
    return len(_monomials(count, HIGHEST))


def _monomials(count: int, degree: int) -> list[tuple[int, ...]]:
    chosen = [
        c for d in range(degree, -1, -1) for c in combinations_with_replacement(range(count), d)
    ]
    return [tuple(c.count(i) for i in range(count)) for c in chosen]


def _equations(points: np.ndarray) -> tuple[Polynomial, ...] | None:
    """Polynomials of lowest degree that vanish at points; none if the points fill the space."""
    count = points.shape[1]
    for degree in range(1, HIGHEST + 1):
        monomials = _monomials(count, degree)
        table = np.array([[np.prod(x ** np.array(e)) for e in monomials] for x in points])
        table = table / np.linalg.norm(table, axis=1, keepdims=True)
        _, s, vh = np.linalg.svd(np.vstack([table.real, table.imag]))
        small = s < SINGULAR * s[0]
        if (~small & (s < NONZERO * s[0])).any():
            return None
        if small.any():
            return _rational(vh[len(s) - int(small.sum()) :], monomials)
    # Nothing of such a degree: all parameters, if there are directions enough.
    spread = np.linalg.matrix_rank(points - points[0], tol=SINGULAR)
    return () if spread == count else None


def _rational(
    basis: np.ndarray, monomials: Sequence[tuple[int, ...]]
) -> tuple[Polynomial, ...] | None:
    """The reduced echelon form of a basis as polynomials with coprime integer coefficients."""
    rows, equations = np.array(basis), []
    pivots: list[int] = []
    for i in range(len(rows)):
        column = int(np.argmax(np.abs(rows[i:]).max(axis=0) > NONZERO))
        best = i + int(np.abs(rows[i:, column]).argmax())
        rows[[i, best]] = rows[[best, i]]
        rows[i] /= rows[i, column]
        pivots.append(column)
        for k in range(len(rows)):
            if k != i:
                rows[k] -= rows[k, column] * rows[i]
    for row in rows:
        numbers = [Fraction(float(c)).limit_denominator(LARGEST_COEFFICIENT) for c in row]
        if np.abs(row - np.array([float(q) for q in numbers])).max() > ROUNDING:
            return None
        scale = lcm(*(q.denominator for q in numbers))
        divisor = gcd(*(int(q * scale) for q in numbers))
        terms = {e: q * scale / divisor for e, q in zip(monomials, numbers, strict=True) if q}
        equations.append(Polynomial(len(monomials[0]), terms))
    return tuple(equations)
