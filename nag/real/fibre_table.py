"""Fibres of a curve over the values of a linear form, in many digits, from a circle of them.

Symmetric functions of the points over ``t`` are polynomials in ``t``: from the fibres over roots of
unity times a radius they are known for all ``t``, and so is every other fibre, critical ones
included, in all digits, without a path to it. A fibre that misses a point of the curve, or has one
of another, shows: the functions are then no polynomials of their degrees.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import flint
import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.errors import ComponentError
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.digits import EXACT, bits_of, in_bits, middle
from nag.numerics.newton import find_zero
from nag.tracking.run import Run
from nag.witness.fibres import Fibre, move
from nag.witness.slices import unit_complex

# Digits in which fibres are computed beside those that they are known to.
SPARE = 20
# Samples beyond those that the degrees need; they tell whether these are right.
MORE_SAMPLES = 4
# Part of the digits that differences of points of a fibre and its conjugate agree in.
SAME = 0.5
# Decides: Share of the digits to which coefficients beyond the degree vanish, of symmetric
# functions and of products over fibres; else the fibres are not those of a curve.
VANISHING = 0.6
# Bits in which zeros are separated, beside those worked in, tried in turn.
MOST_TIMES = (4, 16, 64)

Point = list[flint.acb]


class FibreError(ComponentError):
    """Fibres that were not found, or are not those of a curve, with the reason."""


@dataclass(frozen=True, eq=False)
class CircleOfFibres:
    """The points of a curve over ``radius exp(2 pi i (k + 1/2) / count)``.

    Attributes:
        form: the linear form, real, shape ``(n,)``.
        radius: of the circle.
        digits: that points are known to.
        real: whether the curve is its own conjugate.
        points: for each value the points, of ``n`` coordinates each.
        conjugates: of another curve the points of its conjugate.
        determinants: for each value the product over the points of ``det [J; form]``, with J of the
            square system; None where there is none.
    """

    form: np.ndarray
    radius: float
    digits: int
    real: bool
    points: list[list[Point]]
    conjugates: list[list[Point]]
    determinants: list[flint.acb] | None

    @property
    def count(self) -> int:
        return len(self.points)

    @property
    def degree(self) -> int:
        """Number of points over a value, without conjugates."""
        return len(self.points[0])

    def all_points(self, k: int) -> list[Point]:
        """The points over a value, those of the conjugate included."""
        return self.points[k] + (self.conjugates[k] if self.conjugates else [])

    def coefficients(self, values: Sequence[Sequence[flint.acb]], top: int) -> list[Point]:
        """Coefficients of functions, one a column of ``values``, in powers of ``t / radius``.

        For each the first ``top + 1``.
        """
        m = self.count
        with in_bits(bits_of(self.digits + SPARE)):
            roots = unit_roots(2 * m)
            # The (2 k + 1)-th of 2 m roots to the power -j.
            matrix = flint.acb_mat(
                [[roots[-j * (2 * k + 1) % (2 * m)] / m for k in range(m)] for j in range(top + 1)]
            )
            found = (matrix * flint.acb_mat([list(v) for v in values])).tolist()
            return [[middle(row[i]) for row in found] for i in range(len(values[0]))]


def unit_roots(count: int) -> list[flint.acb]:
    """The ``count`` roots of unity, at the working precision."""
    return [(flint.acb(0, 2) * flint.acb.pi() * k / count).exp() for k in range(count)]


def sample_circle(
    fibres: Sequence[Fibre],
    form: np.ndarray,
    radius: float,
    count: int,
    digits: int,
    rng: np.random.Generator,
    run: Run,
    square: Sequence[Polynomial] = (),
) -> CircleOfFibres:
    """Fibres over points of a circle.

    Args:
        fibres: the curve's points on one slice.
        square: equations, one fewer than variables, whose determinants are asked for.

    Raises:
        FibreError: if a path fails.
    """
    with in_bits(bits_of(digits + SPARE)):
        turns = unit_roots(2 * count)
        at = [middle(turns[2 * k + 1] * flint.arb(radius)) for k in range(count)]
    slopes = BallPolynomials.of(square, form_row(form)) if square else None
    found: list[tuple[list[Point], flint.acb] | None] = [None] * count

    def fibre(k: int) -> tuple[list[Point], flint.acb]:
        known = found[k]
        if known is None:
            known = found[k] = _fibre_over(fibres, form, at[k], digits, rng, run, slopes)
        return known

    upper, lower = fibre(0), fibre(count - 1)
    real = same_points(upper[0], conjugates_of(lower[0]), digits)
    for k in range(count):
        run.tell("fibres", k, count)
        if real and k >= count - count // 2:
            points, determinant = fibre(count - 1 - k)
            ((conjugate,),) = conjugates_of([[determinant]])
            found[k] = conjugates_of(points), conjugate
        else:
            fibre(k)
    table = [entry for entry in found if entry is not None]
    points = [p for p, _ in table]
    others = [] if real else [conjugates_of(points[count - 1 - k]) for k in range(count)]
    products = [product for _, product in table] if square and real else None
    return CircleOfFibres(form, radius, digits, real, points, others, products)


def form_row(form: np.ndarray) -> np.ndarray:
    """A linear form as a row on ``(1, x)``."""
    return np.concatenate([[0.0], form])[None].astype(complex)


def conjugates_of(points: Sequence[Point]) -> list[Point]:
    """The complex conjugates of points."""
    with in_bits(EXACT):
        return [[middle(z.conjugate()) for z in x] for x in points]


def same_points(some: Sequence[Point], others: Sequence[Point], digits: int) -> bool:
    """Whether two lists of points are the same set."""
    limit = flint.arb(10) ** round(-SAME * digits)
    left = list(range(len(others)))
    for x in some:
        near = [
            j
            for j in left
            if all(abs(a - b) < limit * (1 + abs(a)) for a, b in zip(x, others[j], strict=True))
        ]
        if len(near) != 1:
            return False
        left.remove(near[0])
    return True


def _fibre_over(
    fibres: Sequence[Fibre],
    form: np.ndarray,
    t: flint.acb,
    digits: int,
    rng: np.random.Generator,
    run: Run,
    slopes: BallPolynomials | None,
) -> tuple[list[Point], flint.acb]:
    """The points over a value, and the product of their determinants."""
    rows = np.concatenate([[-complex(t)], form])[None].astype(complex)
    gamma = complex(unit_complex(rng))
    points: list[Point] = []
    product = flint.acb(1)
    bits = bits_of(digits + SPARE)
    with in_bits(bits):
        minus = -t
    for fibre, ends in zip(fibres, move(fibres, rows, gamma, run), strict=True):
        if not ends.regular.all():
            raise FibreError("a path to another fibre failed")
        n, total = fibre.cut.n, fibre.cut.n + fibre.cut.aux
        exact = BallPolynomials.of(fibre.cut.polynomials, np.zeros((0, 1 + total), dtype=complex))
        terms = [(complex(c), ((i, 1),)) for i, c in enumerate(form) if c]
        system = BallPolynomials(total, (((minus, ()), *terms),), exact)
        for i, x in enumerate(ends.points):
            start = ends.fine[i].balls() if i in ends.fine else [flint.acb(complex(c)) for c in x]
            zero = find_zero(system, [middle(z) for z in start], digits + SPARE // 2)
            if zero is None or zero.error > -digits:
                raise FibreError("Newton's method does not converge on a fibre")
            points.append([middle(z) for z in zero.point[:n]])
            if slopes is not None:
                with in_bits(bits):
                    product = middle(product * slopes.jacobian(points[-1], bits).det())
    return points, product


def roots_of(polynomial: flint.acb_poly, digits: int) -> list[flint.acb]:
    """The zeros of a polynomial of exact coefficients, to so many digits.

    They are looked for in a variable that is turned: from symmetric starts, as those of real
    polynomials stay, iterations do not part two zeros that are almost real.

    Raises:
        FibreError: if they are not told from each other.
    """
    coefficients = polynomial.coeffs()
    for turn, times in enumerate(MOST_TIMES, 1):
        unit = middle(flint.acb(0, turn).exp())
        turned = flint.acb_poly([middle(c * unit**i) for i, c in enumerate(coefficients)])
        try:
            roots = turned.roots(tol=flint.arb(10) ** -digits, maxprec=times * flint.ctx.prec)
        except ValueError:
            continue
        return [z * unit for z in roots]
    raise FibreError("zeros of a polynomial are not told from each other")


class FibresOverValues(Protocol):
    """All fibres of a curve over the values of a linear form, however they are found.

    Attributes:
        radius: size of the values.
        digits: that points are known to.
    """

    @property
    def radius(self) -> float: ...

    @property
    def digits(self) -> int: ...

    def at(self, t: flint.arb | flint.acb) -> list[Point]:
        """The points over a value that is not special."""
        ...


@dataclass(frozen=True, eq=False)
class FibreTable:
    """All fibres of a curve over the values of a linear form.

    Attributes:
        radius: of the circle that the values are divided by.
        digits: of the samples.
        characteristic: coefficients of ``prod (z - l(x_i))`` over the points ``x_i`` over ``t``, in
            falling powers of ``z`` but for the first, which is 1; polynomials in ``t / radius``.
        numerators: for each coordinate those of ``sum x_i prod_(j != i) (z - l(x_j))``.
        real: whether the curve is its own conjugate.
        sheets: number of points over a value, those of a conjugate included.
    """

    radius: float
    digits: int
    characteristic: list[flint.acb_poly]
    numerators: list[list[flint.acb_poly]]
    real: bool
    sheets: int

    def at(self, t: flint.arb | flint.acb) -> list[Point]:
        """The points over a value at which no two of them agree in a random form.

        Raises:
            FibreError: if two of them do.
        """
        with in_bits(bits_of(self.digits + SPARE)):
            s = flint.acb(t) / flint.arb(self.radius)
            own = flint.acb_poly([middle(c(s)) for c in reversed(self.characteristic)] + [1])
            slope = own.derivative()
            tops = [flint.acb_poly([middle(c(s)) for c in reversed(g)]) for g in self.numerators]
            roots = roots_of(own, self.digits)
            return [[middle(g(middle(z)) / slope(middle(z))) for g in tops] for z in roots]


def fibre_table(circle: CircleOfFibres, rng: np.random.Generator) -> FibreTable:
    """All fibres from those over a circle.

    Raises:
        FibreError: if the samples are not those of a curve.
    """
    n = len(circle.form)
    weights = [flint.acb(int(c)) / 64 for c in rng.integers(32, 96, n) * rng.choice([-1, 1], n)]
    sheets = len(circle.all_points(0))
    rows: list[Point] = []
    with in_bits(bits_of(circle.digits + SPARE)):
        for k in range(circle.count):
            if circle.real and k >= circle.count - circle.count // 2:
                rows.append([middle(c.conjugate()) for c in rows[circle.count - 1 - k]])
                continue
            points = circle.all_points(k)
            own, numerators = flint.acb_poly([1]), [flint.acb_poly([0])] * n
            for x in points:
                z = middle(sum((a * b for a, b in zip(weights, x, strict=True)), flint.acb(0)))
                factor = flint.acb_poly([-z, 1])
                numerators = [g * factor + own * c for g, c in zip(numerators, x, strict=True)]
                own = own * factor
            row = [own[sheets - k] for k in range(1, sheets + 1)]
            row += [g[sheets - 1 - k] for g in numerators for k in range(sheets)]
            rows.append([middle(c) for c in row])
        table = circle.coefficients(rows, min(sheets + MORE_SAMPLES, circle.count - 1))
        # The k-th coefficient is of degree k, that of a numerator k + 1 at most.
        degrees = [*range(1, sheets + 1), *(list(range(1, sheets + 1)) * n)]
        polynomials = []
        limit = flint.arb(10) ** round(-VANISHING * circle.digits)
        for column, degree in zip(table, degrees, strict=True):
            size = max((abs(c).mid() for c in column), default=flint.arb(0)) + 1
            if any(abs(c) > limit * size for c in column[degree + 1 :]):
                raise FibreError("the fibres do not change as those of a curve")
            if circle.real:
                column = [flint.acb(c.real) for c in column]
            polynomials.append(flint.acb_poly(column[: degree + 1]))
    numerators = [polynomials[sheets * (1 + i) : sheets * (2 + i)] for i in range(n)]
    return FibreTable(
        circle.radius, circle.digits, polynomials[:sheets], numerators, circle.real, sheets
    )
