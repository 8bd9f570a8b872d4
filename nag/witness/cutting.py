"""Square systems that cut a pure-dimensional set, and how a point of it finds one.

A generic point of a component is a regular point of some square system: a subset of the equations
if the component is reduced, of their isosingular deflation otherwise (Hauenstein & Wampler 2013).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.number import Number
from nag.algebra.polynomial import Polynomial
from nag.numerics.coincidence import LEAST
from nag.numerics.double_ranks import NEARLY_SINGULAR, matrix_corank, pivot_rows
from nag.numerics.doubles import (
    ARRIVED,
    EPS,
    MULTIPLE,
    NEWTON_STEPS,
    ROUGH,
    ROUNDED,
    SHARP,
    SLACK,
    VANISHING,
)
from nag.numerics.scaling import scaled_terms, variable_scales
from nag.tracking.compiled import CompiledRows, compile_rows
from nag.witness.isosingular import DeflatedEquations, Level
from nag.witness.slices import pad_rows

# A deflation of more steps that add unknowns has not been met in the literature's examples.
MOST_DEFLATIONS = 4
# Gradients below this, relative to what their degree lets them have, are not scaled up further.
FLAT = 1e-4
# Roundings in such a step, times the condition.
LOSS = 1e2
# Part of the smallest singular value by which it may change as far from a zero as rounding errors
# of the values say: more may be a double zero's, which is looked for in more digits.
CHANGED = 0.1
# Sizes are very unequal if they, and 1, differ by more than two to this power.
UNEQUAL = 10


@dataclass(frozen=True, eq=False)
class Equations:
    """The equations that hold so far, in ``n`` variables."""

    polynomials: tuple[Polynomial, ...]
    n: int

    @cached_property
    def evaluator(self) -> Evaluator:
        return Evaluator.of(self.polynomials, self.n)


@dataclass(frozen=True, eq=False)
class Cut:
    """``n + aux - d`` polynomials that cut d-dimensional sets regularly.

    Attributes:
        n: number of variables of the system.
        aux: number of unknowns that deflation added; they come after the variables.
        polynomials: the rows, in ``n + aux`` variables.
        levels: the deflation steps that define the added unknowns.
        plain: what this cut is with a number for the last unknown, if it is such a one.
    """

    n: int
    aux: int
    polynomials: tuple[Polynomial, ...]
    levels: tuple[Level, ...] = ()
    plain: Cut | None = None

    def document(self, variables: Sequence[str]) -> dict[str, Any]:
        """The cut as a JSON object, in the variables and further unknowns."""
        stem = "u"
        while any(name.startswith(stem) for name in variables):
            stem += "u"
        names = [f"{stem}{i + 1}" for i in range(self.aux)]
        texts = [f.text([*variables, *names]) for f in self.polynomials]
        return {"unknowns": names, "polynomials": texts}

    @cached_property
    def rows(self) -> CompiledRows:
        return compile_rows(self.polynomials, n=self.n + self.aux)

    @cached_property
    def evaluator(self) -> Evaluator:
        return Evaluator.of(self.polynomials, self.n + self.aux)

    @cached_property
    def powers(self) -> np.ndarray:
        """Binary logarithms of sizes that make coefficients comparable, shape ``(n + aux,)``.

        Zero where sizes are not very unequal.
        """
        if self.plain is not None:
            return np.append(self.plain.powers, 0)
        powers = variable_scales(self.polynomials, self.n + self.aux)
        return powers if np.ptp([*powers, 0]) > UNEQUAL else np.zeros_like(powers)

    @property
    def sizes(self) -> np.ndarray:
        """Sizes of the homogeneous coordinates ``(1, x)`` of the sets, shape ``(1 + n,)``."""
        return np.ldexp(1.0, np.concatenate([[0], self.powers[: self.n]]))

    @cached_property
    def scaled(self) -> Cut:
        """The cut where coordinates are divided by two to the `powers`."""
        total = self.n + self.aux
        terms = [scaled_terms(f, self.powers) for f in self.polynomials]
        return Cut(self.n, self.aux, tuple(Polynomial(total, own) for own in terms))

    @cached_property
    def numbered(self) -> Cut:
        """The cut with one unknown more, the last, which is 0, 1 or -1."""
        total = self.n + self.aux + 1
        u = Polynomial.variable(total, total - 1)
        rows = [f.with_variables(total, range(total - 1)) for f in self.polynomials]
        return Cut(self.n, self.aux + 1, (*rows, u**3 - u), self.levels, plain=self)

    @property
    def deflated(self) -> bool:
        """Whether its polynomials are those of a deflation, not some of the system's."""
        return bool(self.levels) or self.aux > 0

    def lift(self, x: np.ndarray) -> np.ndarray:
        """An affine point with the values of the added unknowns appended."""
        for level in self.levels:
            x = np.concatenate([x, level.unknowns(x)])
        return x

    def extended(self, f: Polynomial) -> Cut:
        """The cut with one more equation, given in the system's variables."""
        lifted = f.with_variables(self.n + self.aux, range(self.n))
        return Cut(self.n, self.aux, (*self.polynomials, lifted), self.levels)


@dataclass(frozen=True)
class Sharpened:
    """What Newton's method made of a point: ``z`` affine, the size of the last step, success."""

    z: np.ndarray
    step: float
    converged: bool


@np.errstate(over="ignore", invalid="ignore")
def sharpen(evaluator: Evaluator, rows: np.ndarray, z: np.ndarray) -> Sharpened:
    """Gauss-Newton for ``evaluator`` and the slice ``rows`` from the affine point ``z``.

    It succeeds when the steps shrink to rounding at once and the residuals vanish with them, as
    they do near a regular zero and nowhere else. How steps shrink decides here, and how short the
    last must be follows from the singular values on the way, so that it is no use of
    `nag.numerics.double_newton`, to which it does not matter.
    """
    a = pad_rows(rows, 1 + len(z))
    step, slow, floor = np.inf, 0, SHARP
    for _ in range(NEWTON_STEPS):
        values = evaluator.values(z[None])[0]
        jacobian = evaluator.jacobian(z)
        matrix = np.vstack([jacobian, a[:, 1:]])
        right = np.concatenate([values, a[:, 0] + a[:, 1:] @ z])
        if not (np.isfinite(matrix).all() and np.isfinite(right).all()):
            # Powers of the coordinates leave the range of doubles.
            return Sharpened(z, np.inf, False)
        weights = 1 / np.maximum(np.linalg.norm(matrix, axis=1), _floors(evaluator, z, len(a)))
        delta, _, _, s = np.linalg.lstsq(matrix * weights[:, None], right * weights, rcond=ARRIVED)
        z = z - delta
        if len(s) and s[-1] > 0:
            floor = min(max(SHARP, LOSS * EPS * s[0] / s[-1]), ROUGH)
        last, step = step, float(np.linalg.norm(delta) / (1 + np.linalg.norm(z)))
        # Rounding alone keeps the steps at a badly conditioned point from shrinking further.
        if step < ARRIVED or (step < floor and step > 0.25 * last):
            break
        slow += step > 0.25 * last
        if not np.isfinite(step) or slow > 2:
            return Sharpened(z, np.inf, False)
    residual = float(evaluator.residuals(z[None]).max(initial=0.0))
    return Sharpened(z, step, bool(step < floor) and residual < VANISHING)


def _floors(evaluator: Evaluator, z: np.ndarray, slices: int) -> np.ndarray:
    """Least sizes that gradients are scaled by.

    A gradient that vanishes at the solution (that of a square, say) is rounding error near it;
    scaled to length one it would outvote the equations that determine the point.
    """
    size = max(1.0, float(np.abs(z).max(initial=1.0)))
    return np.concatenate([FLAT * size ** (evaluator.degrees - 1.0), np.full(slices, 1e-300)])


def is_end(x: np.ndarray, accuracy: float, zero: np.ndarray) -> bool:
    """Whether a zero is where a path ended, not somewhere in the neighbourhood of its end ``x``."""
    distance = np.linalg.norm(zero - x) / (1 + np.linalg.norm(x))
    return bool(distance <= max(SLACK * accuracy, MULTIPLE))


def _null_basis(rows: np.ndarray, columns: int) -> np.ndarray:
    """Orthonormal basis of the directions along the slice, shape ``(columns, columns - d)``."""
    a = pad_rows(rows, 1 + columns)[:, 1:]
    if not len(a):
        return np.eye(columns, dtype=complex)
    _, s, adjoint = np.linalg.svd(a)
    rank = int((s > EPS * max(a.shape) * s[0]).sum())
    return adjoint[rank:].conj().T


def regular_on(evaluator: Evaluator, rows: np.ndarray, sharpened: Sharpened) -> bool:
    """Whether a sharpened zero is regular on the slice: its singular values against its error.

    The last step says nothing where rounding alone makes the values beside a double zero vanish.
    """
    basis = _null_basis(rows, len(sharpened.z))
    if not basis.shape[1]:
        return True
    matrix = evaluator.balanced_jacobian(sharpened.z) @ basis
    if len(matrix) < basis.shape[1]:
        return False
    left, s, right = np.linalg.svd(matrix, full_matrices=False)
    limit = max(SLACK * sharpened.step, LEAST) * max(1.0, s[0])
    if not s[-1] > limit:
        return False
    return not _perhaps_double(evaluator, sharpened.z, left[:, -1], s[-1], basis @ right[-1].conj())


def _perhaps_double(
    evaluator: Evaluator, z: np.ndarray, left: np.ndarray, smallest: float, direction: np.ndarray
) -> bool:
    """Whether rounding errors of the values move ``z`` so far that it may be a double zero.

    Slopes vanish at a double zero in one direction. In that of the smallest singular value, slopes
    change by about themselves over as far as rounding errors leave the point unknown.

    Args:
        left, direction: singular vectors of the smallest singular value of the balanced Jacobian.
    """
    scales = max(1.0, float(np.abs(z).max(initial=1.0))) ** (1.0 - evaluator.degrees)
    errors = ROUNDED * evaluator.absolute(z[None])[0] * scales
    far = float(np.abs(left) @ errors) / smallest * direction
    if not np.isfinite(far).all():
        return False
    changes = [
        left.conj() @ (evaluator.balanced_jacobian(z + sign * far) @ direction) - smallest
        for sign in (1, -1)
    ]
    return not float(np.abs(changes).max()) <= CHANGED * smallest


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
    return sorted(pivot_rows(matrix, need)[0])


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
    end = _End(rows, x, accuracy)
    if not deflate:
        return end.regular_subset(_not_deflated(equations), x, rng)
    return _deflated_cut(equations, end, rng)


def _not_deflated(equations: Equations) -> DeflatedEquations:
    return DeflatedEquations.none(equations.polynomials, equations.evaluator, equations.n)


def _deflated_cut(
    equations: Equations, end: _End, rng: np.random.Generator
) -> tuple[Cut, np.ndarray] | None:
    """A cut from deflations with random null vectors, as many as are needed."""
    system, z = _not_deflated(equations), end.x
    steps = 0
    while True:
        found = end.regular_subset(system, z, rng)
        if found is not None:
            return found
        free = system.total - len(end.rows)
        q = dyadic(rng, (system.total, free))
        m = matrix_corank(system.evaluator.balanced_jacobian(z) @ q, NEARLY_SINGULAR)
        if m == 0:
            return None
        steps += free > m
        # Without equations nothing that deflation adds would ever end this.
        if not system.polynomials or steps > MOST_DEFLATIONS or system.too_large(free, m):
            return None
        system = system.once_more(q[:, :m], q[:, m:])
        z = np.concatenate([z, system.levels[-1].unknowns(z)])


@dataclass(frozen=True, eq=False)
class _End:
    """The end of a path on the slice ``rows``, for which a square system is looked for."""

    rows: np.ndarray
    x: np.ndarray
    accuracy: float

    def regular_subset(
        self, system: DeflatedEquations, z: np.ndarray, rng: np.random.Generator
    ) -> tuple[Cut, np.ndarray] | None:
        """As many of the equations as are needed, or combinations, and the point sharpened.

        Args:
            z: the point with the unknowns that deflation added.
        """
        rows, n = self.rows, system.n
        sharpened = sharpen(system.evaluator, rows, z)
        if not sharpened.converged or not is_end(self.x, self.accuracy, sharpened.z[:n]):
            return None
        chosen = _square_rows(system.evaluator, rows, sharpened.z)
        if chosen is None:
            return None
        subset = tuple(system.polynomials[i] for i in chosen)
        for combined in (False, True):
            chosen = _combinations(system.polynomials, len(subset), rng) if combined else subset
            cut = Cut(n, system.total - n, chosen, system.levels)
            again = sharpen(cut.evaluator, rows, sharpened.z)
            # Rounding errors in place of a Jacobian lead anywhere, to another zero as well.
            here = again.converged and is_end(self.x, self.accuracy, again.z[:n])
            if here and regular_on(cut.evaluator, rows, again):
                return cut, again.z
            if not regular_on(system.evaluator, rows, sharpened):
                return None
        return None


def dyadic(rng: np.random.Generator, shape: tuple[int, ...]) -> np.ndarray:
    """Random numbers of absolute value between 1/2 and 3/2 with eight bits.

    With coefficients that are exact, Newton's method in any precision converges to exact points.
    """
    return rng.choice([-1, 1], shape) * (64 + rng.integers(0, 128, shape)) / 128


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
