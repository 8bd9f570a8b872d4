"""The local dimension of a solution set at a point: bounds from above and below that meet.

The largest dimension of a component through the point. From above: the point is isolated on so many
random hyperplanes through it, which the finite dual space of the local ring proves (modulo a prime
at rational points and at those in square roots, in 150 digits else). From below: a set of zeros of
that dimension was followed to the point, or there are so few equations. Where both meet, it is
decided.

References:
    Bates, Hauenstein, Peterson & Sommese, A numerical local dimension test for points on the
    solution set of a system of polynomial equations, 2009;
    Wampler, Hauenstein & Sommese, Mechanism mobility and a local dimension test, 2011.
"""

from __future__ import annotations

import contextlib
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from math import log10
from typing import Any

import numpy as np

from nag.algebra.elimination import eliminate_linear
from nag.algebra.evaluation import Evaluator
from nag.algebra.from_python import coordinates
from nag.algebra.given import check_error, check_type, check_whole
from nag.algebra.number import Number, is_zero
from nag.algebra.system import PolynomialSystem
from nag.errors import ComponentError
from nag.numerics.doubles import ROUGH
from nag.numerics.read_only import ComplexArray, equal_values, fixed_array
from nag.text.table import lines_of, one_line, point_text

# Decides: Error of a coordinate that was written down, beside its size or one: half a unit of the
# eighth digit, in its real and in its imaginary part. What that leaves of an equation is rounding.
WRITTEN = 2**0.5 * 0.5e-7
# More coranks of a sequence are left to the export.
MOST_CORANKS = 12


class NoSolution(ComponentError):
    """A point that does not satisfy the equations."""


@dataclass(frozen=True, eq=False)
class LocalDimension:
    """What is known of a solution set at a point.

    Attributes:
        point: the sharpened point, rounded, shape ``(n,)``.
        tangent_dimension: corank of the Jacobian there; None where the point is not decided.
        lower, upper: bounds of the local dimension.
        multiplicity: dimension of the local ring at an isolated point, else None.
        hyperplanes: number of random hyperplanes through the point that the matrices were made on.
        coranks: coranks of the Macaulay matrices of degree 0, 1, .. on them; they end where the
            dual space does, or where it was given up. Empty where none were needed.
        arithmetic: what the matrices were made in.
        reason: what the bounds rest on, or why they do not meet.
        digits: real and imaginary parts of the point as decimals, all digits that are certain, at
            most 100; empty if it is not decided.
        imaginary: whether the last coordinate is the imaginary unit's, as of the system.
        names: what the coordinates are called, that of the unit last; they are not compared.
    """

    point: ComplexArray
    tangent_dimension: int | None
    lower: int
    upper: int
    multiplicity: int | None
    hyperplanes: int
    coranks: tuple[int, ...]
    arithmetic: str
    reason: str
    digits: tuple[tuple[str, str], ...] = ()
    imaginary: bool = False
    names: tuple[str, ...] = field(default=(), compare=False)

    __eq__ = equal_values

    def __post_init__(self) -> None:
        object.__setattr__(self, "point", fixed_array(self.point))
        object.__setattr__(self, "multiplicity", self.multiplicity or None)

    def to_numpy(self) -> ComplexArray:
        """The point, complex, to be written to, without the imaginary unit: shape ``(n,)``."""
        return self.point[: len(self.point) - self.imaginary].copy()

    __repr__ = one_line

    def __str__(self) -> str:
        return lines_of(f"LocalDimension at {point_text(self.to_numpy())}", self.rows())

    def rows(self) -> list[tuple[str, str]]:
        """The answer and what it rests on, as labelled texts."""
        return _local_rows(self)

    def document(self) -> dict[str, Any]:
        """The answer as a JSON object."""
        return {
            "tangent_dimension": self.tangent_dimension,
            "local_dimension": self.dimension,
            "lower": self.lower,
            "upper": self.upper,
            "isolated": self.isolated,
            # In documents 0 stands for none.
            "multiplicity": self.multiplicity or 0,
            "hyperplanes": self.hyperplanes,
            "coranks": list(self.coranks),
            "arithmetic": self.arithmetic,
            "reason": self.reason,
            "sharpened": [list(pair) for pair in self.digits],
        }

    @property
    def decided(self) -> bool:
        """Whether the bounds meet."""
        return self.lower == self.upper

    @property
    def complete(self) -> bool:
        """The same as `decided`."""
        return self.decided

    @property
    def dimension(self) -> int | None:
        """The local dimension; None if it is not decided."""
        return self.lower if self.decided else None

    @property
    def smooth(self) -> bool:
        """Whether one component passes through the point, which is reduced, and smooth there."""
        return self.decided and self.tangent_dimension == self.lower

    @property
    def isolated(self) -> bool | None:
        """Whether the point is isolated; None if that is not decided."""
        return True if self.upper == 0 else False if self.lower > 0 else None


def _dimension_text(found: LocalDimension) -> str:
    """The answer in one sentence."""
    if found.tangent_dimension is None:
        return "undecided: no exact solution was found there"
    tangent = f"tangent dimension {found.tangent_dimension}"
    if not found.decided:
        return f"undecided: local dimension {found.lower} to {found.upper}, {tangent}"
    text = f"local dimension {found.lower}, {tangent}"
    if found.lower == 0:
        return f"{text}: isolated, of multiplicity {found.multiplicity}"
    singular = found.tangent_dimension > found.lower
    return f"{text}: {'a singular point of the equations' if singular else 'a regular point'}"


def _matrices_text(found: LocalDimension) -> str:
    """The corank sequence and what it was computed in; empty if there is none."""
    if not found.coranks:
        return ""
    shown = ", ".join(map(str, found.coranks[:MOST_CORANKS]))
    if len(found.coranks) > MOST_CORANKS:
        shown += f", .. {found.coranks[-1]} in degree {len(found.coranks) - 1}"
    k = found.hyperplanes
    where = f" on {k} random hyperplane{'' if k == 1 else 's'} through the point" if k else ""
    return f"coranks {shown} in degrees 0, 1, ..{where}, {found.arithmetic}"


def _local_rows(found: LocalDimension) -> list[tuple[str, str]]:
    """The answer and what it rests on, as labelled texts."""
    rows = [("answer", _dimension_text(found))]
    if found.tangent_dimension is not None:
        bounds = f"at least {found.lower}, at most {found.upper}: {found.reason}"
        rows.append(("bounds", bounds))
    else:
        rows.append(("open", found.reason))
    matrices = _matrices_text(found)
    return [*rows, ("matrices", matrices)] if matrices else rows


def local_dimension(
    system: PolynomialSystem,
    point: Sequence[Any] | np.ndarray,
    *,
    accuracy: float | None = None,
    seed: int = 0,
) -> LocalDimension:
    """The largest dimension of a component of the zero set through a point.

    A point of doubles is sharpened first, a singular one by deflation: it stands for the most
    singular zero within its error.

    Args:
        system: exact equations; ``system.nonzero`` does not matter.
        point: exact numbers (`int`, `Fraction`, `Irrational`), or complex doubles.
        accuracy: how far the zero may be from the point, relative to each coordinate's size or, if
            that is larger, to the size that the coefficients of the equations suggest for it
            (often one); by default 0 for exact numbers, 1e-8 for doubles.
        seed: of directions and hyperplanes.

    Raises:
        ValueError: if the point has not one coordinate for each variable, or another argument makes
            no sense; the message says which, and what would.
        NoSolution: if an exact point does not satisfy the equations.

    >>> import nag
    >>> cusp = nag.local_dimension(nag.system("x^3 = y^2"), (0, 0))
    >>> cusp.tangent_dimension, cusp.lower, cusp.upper
    (2, 1, 1)
    """
    from nag.numerics.dimension_bounds import bounds, reduced_bounds

    check_type(system, PolynomialSystem, "system", "a nag.PolynomialSystem: nag.system(equations)")
    check_error(accuracy, "accuracy")
    check_whole(seed, "seed")
    point = coordinates(point, system.variables, system.imaginary)
    exact = exact_numbers(point)
    error: float | None = None
    if exact is not None and not accuracy:
        wrong = [i for i, f in enumerate(system.polynomials) if not is_zero(f(exact))]
        if wrong:
            raise NoSolution(f"equation {wrong[0] + 1} does not vanish at the point")
        point = exact
    else:
        error = log10(max(ROUGH if accuracy is None else accuracy, 1e-300))
    rng = np.random.default_rng(seed)
    elimination = eliminate_linear(system, graphs=False)
    if 0 < elimination.system.n < system.n:
        found = reduced_bounds(elimination, list(point), error, rng)
        if found is not None:
            return replace(found, imaginary=system.imaginary, names=system.variables)
    found = bounds(system.polynomials, list(point), error, rng)
    return replace(found, imaginary=system.imaginary, names=system.variables)


def local_dimension_near(
    system: PolynomialSystem, point: Sequence[Any] | np.ndarray, *, seed: int = 0
) -> LocalDimension:
    """The local dimension at the zero that a point stands for, which may be a rounded one.

    Raises:
        ValueError: if an argument makes no sense; the message says which, and what would.
        NoSolution: if the point, real or complex, does not satisfy the equations, not even as well
            as one that is rounded to eight digits.
    """
    check_type(system, PolynomialSystem, "system", "a nag.PolynomialSystem: nag.system(equations)")
    given = coordinates(point, system.variables, system.imaginary)
    if exact_numbers(given) is not None:
        with contextlib.suppress(NoSolution):
            return local_dimension(system, point, seed=seed)
    at = np.array([x if isinstance(x, complex) else complex(float(x)) for x in given])
    evaluator = Evaluator.of(system.polynomials, system.n)
    residuals = evaluator.residuals(at[None])[0]
    allowed = np.maximum(ROUGH, evaluator.rounding_residuals(at, WRITTEN))
    wrong = np.flatnonzero(~(residuals < allowed)).tolist()
    if wrong:
        text = f"equation {wrong[0] + 1} does not vanish at the point"
        raise NoSolution(f"{text}; its relative residual is {residuals[wrong[0]]:.1e}")
    # The error of a double zero is the square root of what is left of the equations.
    accuracy = max(ROUGH, float(residuals.max(initial=0.0)) ** 0.5)
    return local_dimension(system, at, accuracy=accuracy, seed=seed)


def exact_numbers(point: Sequence[Any] | np.ndarray) -> tuple[Number, ...] | None:
    """The coordinates as exact numbers, if all of them are."""
    from fractions import Fraction

    if not all(isinstance(x, int | Number) for x in point):
        return None
    return tuple(Fraction(x) if isinstance(x, int) else x for x in point)
