"""Square systems that cut a pure-dimensional set, and how a point of it finds one.

A generic point of a component is a regular point of some square system: a subset of the equations
if the component is reduced, of their isosingular deflation otherwise (Hauenstein & Wampler 2013).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.number import Number
from nag.algebra.polynomial import Polynomial
from nag.tracking.compiled import CompiledRows, compile_rows
from nag.witness.sharpening import Sharpened, sharpen
from nag.witness.slices import padded

# A value relative to the size of its terms: zeros lie below 2.5e-13 at sharpened points, others
# above 2e-6 in all systems measured.
ON = 1e-9
# A deflation of more steps that add unknowns has not been met in the literature's examples.
MOST_DEFLATIONS = 4
# A rank is read where neighbouring singular values differ by this factor, and at a point that is
# known to be singular, though perhaps not well, below this value.
GAP = 1e3
NEARLY_SINGULAR = 1e-5
# Newton's method may correct an end by this much, relative to its size: estimates of the error of
# a singular end are themselves uncertain.
NEAR = 1e-7
# Deflated systems of more unknowns, or of more terms, cost more than they are worth.
MOST_UNKNOWNS = 80
MOST_TERMS = 100_000
# A random choice of null vectors may be an unlucky one.
ATTEMPTS = 3
# Rows of larger matrices are chosen by LAPACK, which takes longer to load than smaller ones take.
MOST_ENTRIES = 2000


@dataclass(frozen=True, eq=False)
class Equations:
    """The equations that hold so far, in ``n`` variables."""

    polynomials: tuple[Polynomial, ...]
    n: int

    @cached_property
    def evaluator(self) -> Evaluator:
        return Evaluator.of(self.polynomials, self.n)


@dataclass(frozen=True, eq=False)
class Level:
    """One deflation step: ``J(z) (Q1 + Q2 L) = 0`` in new unknowns ``L``, column by column."""

    base: Evaluator
    q1: np.ndarray
    q2: np.ndarray

    def unknowns(self, z: np.ndarray) -> np.ndarray:
        """The values of ``L`` at ``z``, by least squares, flattened column by column."""
        jacobian = self.base.jacobian(z)
        solution, *_ = np.linalg.lstsq(jacobian @ self.q2, -jacobian @ self.q1, rcond=None)
        return solution.T.ravel()


@dataclass(frozen=True, eq=False)
class Cut:
    """``n + aux - d`` polynomials that cut d-dimensional sets regularly.

    Attributes:
        n: number of variables of the system.
        aux: number of unknowns that deflation added; they come after the variables.
        polynomials: the rows, in ``n + aux`` variables.
        levels: the deflation steps that define the added unknowns.
    """

    n: int
    aux: int
    polynomials: tuple[Polynomial, ...]
    levels: tuple[Level, ...] = ()

    @cached_property
    def rows(self) -> CompiledRows:
        return compile_rows(self.polynomials, n=self.n + self.aux)

    @cached_property
    def evaluator(self) -> Evaluator:
        return Evaluator.of(self.polynomials, self.n + self.aux)

    def lift(self, x: np.ndarray) -> np.ndarray:
        """An affine point with the values of the added unknowns appended."""
        for level in self.levels:
            x = np.concatenate([x, level.unknowns(x)])
        return x

    def extended(self, f: Polynomial) -> Cut:
        """The cut with one more equation, given in the system's variables."""
        lifted = f.with_variables(self.n + self.aux, range(self.n))
        return Cut(self.n, self.aux, (*self.polynomials, lifted), self.levels)


def numerical_corank(singular: np.ndarray, columns: int, small: float) -> int:
    """Corank of a balanced Jacobian with ``columns`` columns, at the gap of its singular values.

    The widest gap counts whose lower side is below ``small``, and that is at least a factor
    `GAP`. Entries of a balanced matrix are of order one, so a matrix of rank zero shows a gap
    below one.
    """
    s = np.zeros(columns)
    s[: len(singular)] = singular[:columns]
    s = np.maximum(s / max(1.0, s.max(initial=0.0)), 1e-17)
    above, best, corank = 1.0, GAP, 0
    for rank, value in enumerate(s):
        if value < small and above / value > best:
            best, corank = above / value, columns - rank
        above = value
    return corank


def _null_basis(rows: np.ndarray, columns: int) -> np.ndarray:
    """Orthonormal basis of the directions along the slice, shape ``(columns, columns - d)``."""
    a = padded(rows, 1 + columns)[:, 1:]
    if not len(a):
        return np.eye(columns, dtype=complex)
    _, s, adjoint = np.linalg.svd(a)
    rank = int((s > np.finfo(float).eps * max(a.shape) * s[0]).sum())
    return adjoint[rank:].conj().T


def regular_on(evaluator: Evaluator, rows: np.ndarray, sharpened: Sharpened) -> bool:
    """Whether a sharpened zero is regular on the slice: its singular values against its error."""
    basis = _null_basis(rows, len(sharpened.z))
    matrix = evaluator.balanced_jacobian(sharpened.z) @ basis
    s = np.zeros(basis.shape[1])
    values = np.linalg.svd(matrix, compute_uv=False)
    s[: len(values)] = values[: len(s)]
    limit = max(1e3 * sharpened.step, 1e-11) * max(1.0, s.max(initial=0.0))
    return len(s) == 0 or bool(s[-1] > limit)


def _square_rows(evaluator: Evaluator, rows: np.ndarray, z: np.ndarray) -> list[int] | None:
    """Indices of equations that are independent along the slice at ``z``, or None if too few."""
    basis = _null_basis(rows, len(z))
    matrix = evaluator.balanced_jacobian(z) @ basis
    need = basis.shape[1]
    if len(matrix) < need:
        return None
    if need == 0:
        return []
    if len(matrix) == need:
        return list(range(need))
    return _most_independent(matrix, need)


def _most_independent(matrix: np.ndarray, need: int) -> list[int]:
    """Rows chosen one by one, each the longest beside those before (Businger & Golub 1965)."""
    if matrix.size > MOST_ENTRIES:
        from scipy.linalg import qr

        _, _, pivots = qr(matrix.T, mode="economic", pivoting=True)
        return sorted(int(p) for p in pivots[:need])
    rest, chosen = np.array(matrix, dtype=complex), []
    for _ in range(need):
        lengths = np.linalg.norm(rest, axis=1)
        lengths[chosen] = -1.0
        best = int(lengths.argmax())
        chosen.append(best)
        if lengths[best] > 0:
            unit = rest[best] / lengths[best]
            # Once more, as rounding errors of the first time count beside small rows.
            for _ in range(2):
                rest = rest - (rest @ unit.conj())[:, None] * unit
    return sorted(chosen)


def _deflated(
    polynomials: Sequence[Polynomial], n: int, q1: np.ndarray, q2: np.ndarray
) -> list[Polynomial]:
    """The polynomials together with ``J (q1 + q2 L) = 0``, exact, in the variables ``(z, L)``."""
    k, m = q2.shape[1], q1.shape[1]
    total = n + k * m
    first = [[Fraction(q) for q in row] for row in q1]
    second = [[Fraction(q) for q in row] for row in q2]
    zeros = (0,) * (k * m)
    units = [(*zeros[:i], 1, *zeros[i + 1 :]) for i in range(k * m)]
    result = [f.with_variables(total, range(n)) for f in polynomials]
    for f in polynomials:
        gradient = [(i, f.derivative(i)) for i in sorted(f.support)]
        for column in range(m):
            terms: dict[tuple[int, ...], Number] = {}
            for i, derivative in gradient:
                entries = [(zeros, first[i][column])]
                entries += [(units[column * k + j], second[i][j]) for j in range(k)]
                for exponents, coefficient in derivative.terms.items():
                    for unit, q in entries:
                        key = exponents + unit
                        terms[key] = terms.get(key, 0) + coefficient * q
            value = Polynomial(total, terms)
            if value:
                result.append(value)
    return result


def find_cut(
    equations: Equations,
    rows: np.ndarray,
    x: np.ndarray,
    accuracy: float,
    rng: np.random.Generator,
    deflate: bool,
) -> tuple[Cut, np.ndarray] | None:
    """A square system with ``x`` as a regular point on the slice, and the sharpened point.

    Without ``deflate`` only subsets of ``equations`` are tried: success means that the component
    through ``x`` is reduced. Returns None where no cut is found.
    """
    for _ in range(ATTEMPTS if deflate else 1):
        found = _find_cut(equations, rows, x, accuracy, rng, deflate)
        if found is not None:
            return found
    return None


def _find_cut(
    equations: Equations,
    rows: np.ndarray,
    x: np.ndarray,
    accuracy: float,
    rng: np.random.Generator,
    deflate: bool,
) -> tuple[Cut, np.ndarray] | None:
    n, evaluator = equations.n, equations.evaluator
    polynomials, total, z, levels = list(equations.polynomials), n, x, []
    steps = 0
    while True:
        found = _regular_subset(polynomials, evaluator, tuple(levels), rows, x, z, accuracy, rng)
        if found is not None or not deflate:
            return found
        free = total - len(rows)
        q = dyadic(rng, (total, free))
        singular = np.linalg.svd(evaluator.balanced_jacobian(z) @ q, compute_uv=False)
        m = numerical_corank(singular, free, NEARLY_SINGULAR)
        if m == 0:
            return None
        steps += free > m
        if steps > MOST_DEFLATIONS or total + (free - m) * m > MOST_UNKNOWNS:
            return None
        entries = sum(sum(map(bool, e)) for f in polynomials for e in f.terms)
        if entries * m * (1 + free - m) > MOST_TERMS:
            return None
        level = Level(evaluator, q[:, :m], q[:, m:])
        polynomials = _deflated(polynomials, total, level.q1, level.q2)
        z = np.concatenate([z, level.unknowns(z)])
        total = len(z)
        evaluator = Evaluator.of(polynomials, total)
        levels.append(level)


def dyadic(rng: np.random.Generator, shape: tuple[int, ...]) -> np.ndarray:
    """Random numbers of absolute value between 1/2 and 3/2 with eight bits.

    With coefficients that are exact, Newton's method in any precision converges to exact points.
    """
    return rng.choice([-1, 1], shape) * (64 + rng.integers(0, 128, shape)) / 128


def _regular_subset(
    polynomials: Sequence[Polynomial],
    evaluator: Evaluator,
    levels: tuple[Level, ...],
    rows: np.ndarray,
    x: np.ndarray,
    z: np.ndarray,
    accuracy: float,
    rng: np.random.Generator,
) -> tuple[Cut, np.ndarray] | None:
    n, total = len(x), len(z)
    sharpened = sharpen(evaluator, rows, z)
    # A regular zero is where the path ended, not somewhere in its neighbourhood.
    distance = np.linalg.norm(sharpened.z[:n] - x) / (1 + np.linalg.norm(x))
    if not sharpened.converged or distance > max(1e3 * accuracy, NEAR):
        return None
    chosen = _square_rows(evaluator, rows, sharpened.z)
    if chosen is None:
        return None
    subset = tuple(polynomials[i] for i in chosen)
    for combined in (False, True):
        chosen = _combinations(polynomials, len(subset), rng) if combined else subset
        cut = Cut(n, total - n, chosen, levels)
        again = sharpen(cut.evaluator, rows, sharpened.z)
        if again.converged and regular_on(cut.evaluator, rows, again):
            return cut, again.z
        if not regular_on(evaluator, rows, sharpened):
            return None
    return None


def _combinations(
    polynomials: Sequence[Polynomial], count: int, rng: np.random.Generator
) -> tuple[Polynomial, ...]:
    """Random exact combinations of polynomials of comparable size.

    A subset that is independent may still be much worse conditioned than all equations together.
    """
    powers = [leading_power(f) for f in polynomials]
    result = []
    for row in dyadic(rng, (count, len(polynomials))):
        terms: dict[tuple[int, ...], Number] = {}
        for weight, power, f in zip(row, powers, polynomials, strict=True):
            factor = Fraction(weight) / power
            for exponents, coefficient in f.terms.items():
                terms[exponents] = terms.get(exponents, 0) + coefficient * factor
        result.append(Polynomial(polynomials[0].n, terms))
    return tuple(result)


def leading_power(f: Polynomial) -> Fraction:
    """The power of two next to the size of the largest coefficient of ``f``; 1 for zero."""
    size = max((abs(float(c)) for c in f.terms.values()), default=1.0)
    return Fraction(2) ** int(np.floor(np.log2(size)))
