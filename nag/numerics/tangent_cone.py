"""The terms of lowest order of equations at a singular point: its tangent cone.

In the coordinates of the tangent space the equations have no linear part; their parts of lowest
order are the equations of lowest degree of the tangent cone, and all of them if there is one. They
hold on the tangent space, which linear equations cut out.

A power series whose part of lowest order has no factors over the complex numbers has none itself.
So where the local dimension is one less than the tangent dimension and there is such a form, the
zeros near the point are those of that series: one component passes through it, and is reduced.

Reference:
    Cox, Little & O'Shea, Ideals, Varieties, and Algorithms, chapter 9, section 7.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import chain
from math import gcd, lcm
from typing import Any

import flint
import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.factoring import factor_into_irreducibles, is_absolutely_irreducible
from nag.algebra.fixed_mapping import fixed_mapping
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.numerics.ball_ranks import row_echelon
from nag.numerics.digits import DIGITS, log_size, rational, working_digits
from nag.numerics.implicit_function import eliminate
from nag.numerics.local_dimension import local_dimension
from nag.numerics.located_zero import exact_zero
from nag.numerics.power_series import Series, SeriesRing
from nag.numerics.read_only import equal_values
from nag.numerics.sharpening import ZERO

# Orders beyond this are not looked at.
HIGHEST = 8
# Digits of coefficients that are not rational, as they are printed.
SHOWN = 8

# Coefficients by exponents in all variables; complex if they are not all rational.
Form = Mapping[tuple[int, ...], Fraction | complex]


@dataclass(frozen=True, eq=False)
class TangentCone:
    """The lowest-order part of a zero set at a point, in the coordinates ``u = x - p``.

    Attributes:
        coordinates: indices of the variables that are coordinates of the tangent space; the others
            depend on them in first order.
        degree: of the forms.
        forms: a basis of the equations of that degree, in all variables: with coprime integers as
            coefficients, or with complex numbers, the first of them one.
        linear: equations of the tangent space, one for each of the other variables.
        dimension: of the zero set of the forms in the tangent space, not less than that of the
            tangent cone; None if it is not decided.
    """

    coordinates: tuple[int, ...]
    degree: int
    forms: tuple[Form, ...]
    linear: tuple[Form, ...]
    dimension: int | None

    __eq__ = equal_values

    def __post_init__(self) -> None:
        for name in ("forms", "linear"):
            object.__setattr__(self, name, tuple(map(fixed_mapping, getattr(self, name))))

    def text(self, variables: Sequence[str]) -> str:
        """The forms, with the variables' names for their distances from the point."""
        return _equations(self.forms, variables)

    def document(self, variables: Sequence[str]) -> dict[str, Any]:
        """The forms as texts, and as what they consist of, as a JSON object.

        Args:
            variables: names of all coordinates.
        """
        return {
            "degree": self.degree,
            "forms": [form_text(f, variables) for f in self.forms],
            "linear": [form_text(f, variables) for f in self.linear],
            "coordinates": [variables[i] for i in self.coordinates],
            "dimension": self.dimension,
            "form_terms": [_terms(f) for f in self.forms],
            "linear_terms": [_terms(f) for f in self.linear],
        }

    def is_irreducible(self, rng: np.random.Generator) -> bool:
        """Whether there is one form, and it certainly has no factors over the complex numbers.

        Args:
            rng: chooses a plane on which it is looked at.
        """
        if len(self.forms) != 1:
            return False
        (form,) = self.forms
        if not all(isinstance(c, Fraction) for c in form.values()):
            return False
        f = Polynomial(len(next(iter(form))), form)
        factors = factor_into_irreducibles(f)
        return [k for _, k in factors] == [1] and is_absolutely_irreducible(f, rng)

    def tangent_vector(self, rng: np.random.Generator) -> np.ndarray:
        """A random vector on the cone of one form, complex, its largest entry of size one."""
        (form,) = self.forms
        n, free = len(next(iter(form))), list(self.coordinates)
        others = [i for i in range(n) if i not in free]
        ends = rng.normal(size=(2, 2, len(free)))
        start, along = ends[0] + 1j * ends[1]
        # The form on a line, by its values at as many roots of unity as it has coefficients.
        turns = np.exp(2j * np.pi * np.arange(self.degree + 1) / (self.degree + 1))
        points = np.zeros((len(turns), n), dtype=complex)
        points[:, free] = start + turns[:, None] * along
        values = Evaluator.of([Polynomial(n, form)], n).values(points)[:, 0]
        on_cone = np.roots((np.fft.fft(values) / len(turns))[::-1])[0]
        vector = np.zeros(n, dtype=complex)
        vector[free] = start + on_cone * along
        if others:
            rows = np.zeros((len(self.linear), n), dtype=complex)
            for row, line in zip(rows, self.linear, strict=True):
                for e, c in line.items():
                    row[e.index(1)] = complex(c)
            vector[others] = -np.linalg.solve(rows[:, others], rows[:, free] @ vector[free])
        return vector / np.abs(vector).max()

    def tangent_text(self, variables: Sequence[str]) -> str:
        """The equations of the tangent space, empty if it is the whole space."""
        return _equations(self.linear, variables)


def _terms(form: Form) -> list[dict[str, Any]]:
    """What a form consists of: coefficients as texts, or if not rational as two numbers."""

    def number(c: Fraction | complex) -> str | list[float]:
        return str(c) if isinstance(c, Fraction) else [complex(c).real, complex(c).imag]

    return [{"exponents": list(e), "coefficient": number(c)} for e, c in form.items()]


def _equations(forms: Sequence[Form], variables: Sequence[str]) -> str:
    return ", ".join(f"{form_text(f, variables)} = 0" for f in forms)


def form_text(form: Form, variables: Sequence[str]) -> str:
    """A form; coefficients that are not rational with some digits."""
    n = len(variables)
    if all(isinstance(c, Fraction) for c in form.values()):
        return Polynomial(n, form).text(variables)
    text = ""
    for e, c in form.items():
        z = complex(c)
        one = Polynomial(n, {e: Fraction(1)}).text(variables)
        sign = "-" if not z.imag and z.real < 0 else "+"
        size = -z if sign == "-" else z
        number = f"{size.real:.{SHOWN}g}" if not z.imag else f"({size:.{SHOWN}g})".replace("j", "i")
        part = one if size == 1 else f"{number}*{one}"
        text += f" {sign} {part}" if text else part if sign == "+" else f"-{part}"
    return text


def tangent_cone(
    system: PolynomialSystem,
    point: Sequence[Any] | np.ndarray,
    *,
    accuracy: float = 1e-8,
    seed: int = 0,
) -> TangentCone | None:
    """The tangent cone at a singular point; None where its equations are not found.

    Args:
        point: exact numbers, or doubles, which are sharpened first.
        accuracy: of a point of doubles, as for `nag.local_dimension`.
    """
    n = system.n
    with working_digits(DIGITS):
        zero, factors = exact_zero(system.polynomials, point, accuracy, np.random.default_rng(seed))
        if zero is None or not zero.tangent:
            return None
        rows, block = zero.system.at(DIGITS), zero.block
        for order in range(2, HIGHEST + 1):
            found = eliminate(rows, zero.found.point, block.rows, block.columns, order)
            if found is None:
                return None
            parts = [_part(found.ring, s, order) for s in found.rest]
            parts = [part for part in parts if part]
            if parts:
                break
        else:
            return None
        free = tuple(i for i in range(n) if i not in block.columns)
        # The units of the scaled variables are put back.
        forms = _independent([_scale_part(part, [factors[i] for i in free]) for part in parts])
        linear = []
        for i in sorted(block.columns):
            slopes = _part(found.ring, found.images[i], 1)
            slopes = {free[e.index(1)]: factors[i] * c for e, c in slopes.items()}
            line = {_unit(n, j): -c / factors[j] for j, c in slopes.items()}
            linear.append({_unit(n, i): flint.acb(1), **line})
        inner = _recognise_forms(forms)
    dimension = None
    if all(isinstance(c, Fraction) for form in inner for c in form.values()):
        forms_of_tangent_space = tuple(Polynomial(len(free), form) for form in inner)
        names = tuple(f"u{i}" for i in range(len(free)))
        cone = PolynomialSystem(names, forms_of_tangent_space)
        dimension = local_dimension(cone, [0] * len(free), seed=seed).dimension
    outer = tuple({_place_exponents(n, free, e): c for e, c in form.items()} for form in inner)
    return TangentCone(free, order, outer, tuple(_recognise_forms(linear)), dimension)


def _unit(n: int, i: int) -> tuple[int, ...]:
    return tuple(int(j == i) for j in range(n))


def _place_exponents(n: int, free: Sequence[int], exponents: Sequence[int]) -> tuple[int, ...]:
    placed = dict(zip(free, exponents, strict=True))
    return tuple(placed.get(i, 0) for i in range(n))


def _part(ring: SeriesRing, series: Series, order: int) -> dict[tuple[int, ...], flint.acb]:
    return {
        ring.exponents(key): flint.acb(c)
        for key, c in series.items()
        if ring.degree(key) == order and log_size(c) > ZERO
    }


def _scale_part(
    part: dict[tuple[int, ...], flint.acb], factors: Sequence[Any]
) -> dict[tuple[int, ...], flint.acb]:
    found = {}
    for e, c in part.items():
        for k, factor in zip(e, factors, strict=True):
            c = c / factor**k
        found[e] = c
    return found


def _independent(
    parts: Sequence[dict[tuple[int, ...], flint.acb]],
) -> list[dict[tuple[int, ...], flint.acb]]:
    """A basis of the span of forms, their leading coefficients one."""
    monomials = sorted({e for part in parts for e in part}, reverse=True)
    rows = row_echelon([[part.get(e, 0) for e in monomials] for part in parts], ZERO)
    nonzero = [[(e, c) for e, c in zip(monomials, row, strict=True)] for row in rows]
    return [{e: c for e, c in row if log_size(c) > ZERO} for row in nonzero]


def _recognise_forms(forms: Sequence[dict[tuple[int, ...], flint.acb]]) -> list[Form]:
    """The forms with coprime integers, or all of them with complex doubles."""
    numbers = [{e: rational(c, DIGITS - 30) for e, c in form.items()} for form in forms]
    if any(q is None for q in chain.from_iterable(form.values() for form in numbers)):
        return [{e: _round_number(complex(c)) for e, c in form.items()} for form in forms]
    return [_primitive({e: q for e, q in form.items() if q}) for form in numbers]


def _round_number(z: complex) -> complex:
    real, imag = (x if abs(x) > 10.0**ZERO else 0.0 for x in (z.real, z.imag))
    return complex(real, imag)


def _primitive(terms: dict[tuple[int, ...], Fraction]) -> Form:
    denominator = lcm(*(q.denominator for q in terms.values()))
    divisor = gcd(*(int(q * denominator) for q in terms.values()))
    scale = Fraction(denominator, divisor)
    return {e: q * scale for e, q in terms.items()}
