"""Initial forms of a homotopy, at whose exact zeros its branches begin.

In the direction (v, 1) they are the terms of least order of each equation, where coordinate j has
order v_j and t has order 1: exact, as the homotopy is. A regular zero of them is where a branch
``x_j = t^v_j (X_j + ..)`` begins, by Hensel's lemma. A zero of size 1/e looks infinite to as many
digits as 1/e has: the forms are as small as e then, but have no zero.
Reference:
    Huber & Verschelde, Polyhedral end games for polynomial continuation, 1998.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import exp, inf, log10, sqrt
from typing import Any

import flint
import numpy as np

from nag.numerics.ball_polynomials import Factors
from nag.numerics.coincidence import BEYOND
from nag.numerics.digits import in_bits, log_size
from nag.numerics.double_ranks import INDEPENDENT
from nag.numerics.sharpening import ZERO
from nag.tracking.ends.terms import Terms
from nag.tracking.paths import NEVER

# Bits of forms that are to tell zeros: 120 digits.
FINE = 400
# Decides: Digits by which others must grow away from it, as about a multiple zero: a constant shows
# that the forms have no zero.
GROWN = 2.0
# Decides: The least distance at which they are compared: `BEYOND` errors of the limit where those
# are more.
CLOSE = 1e-10
# Steps of Newton's method with a fixed inverse, and their least gain, decimal logarithm.
STEPS, GAIN = 40, 1.0

# Exponents as (coordinate, exponent) pairs, and coefficients.
Form = list[tuple[Factors, Any]]


@dataclass(frozen=True, eq=False)
class InitialForms:
    """The initial forms of the homotopy that ``terms`` are of, in so many bits, each made once."""

    terms: Terms
    bits: int
    _known: dict[tuple[int, ...], list[Form]] = field(default_factory=dict)

    def _of(self, orders: tuple[int, ...], winding: int) -> list[Form]:
        """The forms in the direction of ``orders``, in units of ``1 / winding``."""
        key = (winding, *orders)
        if key not in self._known:
            forms = []
            for row in self.terms.rows(self.bits):
                least, form = NEVER, []
                for factors, a, b in row:
                    order = sum(k * orders[j] for j, k in factors)
                    for c, d in ((a, order), (b, order + winding)):
                        if c == 0 or d > least:
                            continue
                        if d < least:
                            least, form = d, []
                        form.append((factors, c))
                if least < NEVER // 2:
                    forms.append(form)
            self._known[key] = forms
        return self._known[key]

    def residual(self, orders: tuple[int, ...], winding: int, point: Sequence[Any]) -> float:
        """The largest value of a form over the sum of its terms, at a point in FLINT's ``acb``."""
        worst = 0.0
        with in_bits(self.bits):
            for terms in _terms(self._of(orders, winding), point):
                size = sum(map(abs, terms), flint.arb(0)).mid()
                total = abs(sum(terms, flint.acb(0))).mid()
                worst = max(worst, float(total / size) if size > 0 else 0.0)
        return worst

    def vanish(
        self, orders: tuple[int, ...], winding: int, point: Sequence[Any], error: float
    ) -> bool:
        """Whether the forms have an exact zero near a point, be it multiple.

        A regular one is seen at once. Near a multiple one, what the forms with
        a regular Jacobian leave of the others is zero, or grows with the distance. A constant that
        is left, however small, says that there is none.

        Args:
            point: in FLINT's ``acb``; coordinates of order `NEVER` are not looked at.
            error: of the coordinates, relative to each.
        """
        there = [j for j, order in enumerate(orders) if order < NEVER]
        with in_bits(self.bits):
            forms = [
                [(tuple((there.index(j), k) for j, k in factors), c) for factors, c in form]
                for form in self._of(orders, winding)
            ]
            if not forms:
                # Coordinates that vanish make all equations vanish.
                return True
            first = [
                next(i for i, j in enumerate(there) if j in group)
                for group in self.terms.homotopy.groups
            ]
            x = [point[j].mid() for j in there]
            sizes = [sum(map(abs, own), flint.arb(0)).mid() for own in _terms(forms, x)]
            forms = [
                [(factors, (c / size).mid()) for factors, c in form]
                for form, size in zip(forms, sizes, strict=True)
            ]
            terms = _terms(forms, x)
            jacobian = _logarithmic_jacobian(forms, first, terms, len(x))
            if _is_near_regular_zero(forms, terms, jacobian):
                return True
            inverse = np.linalg.pinv(jacobian, rcond=INDEPENDENT)[:, : len(forms)]
            here = _sizes_left(forms, inverse, x)
            rest = here > ZERO
            if not rest.any():
                return True
            phases = np.exp(2j * np.pi * np.random.default_rng(0).random(len(there)))
            shift = max(error * BEYOND, CLOSE)
            moved = [z * flint.acb(complex(1 + shift * u)) for z, u in zip(x, phases, strict=True)]
            return bool((_sizes_left(forms, inverse, moved)[rest] > here[rest] + GROWN).all())


def _terms(forms: Sequence[Form], x: Sequence[Any]) -> list[list[Any]]:
    """The terms of the forms at a point."""
    powers: dict[tuple[int, int], Any] = {}
    terms = []
    for form in forms:
        own = []
        for factors, c in form:
            for factor in factors:
                power = powers.get(factor)
                if power is None:
                    power = powers[factor] = x[factor[0]] ** factor[1]
                c = c * power
            own.append(c)
        terms.append(own)
    return terms


def _logarithmic_jacobian(
    forms: Sequence[Form], first: Sequence[int], terms: Sequence[Sequence[Any]], n: int
) -> np.ndarray:
    """The derivatives of the forms by the logarithms of the coordinates; those ``first`` stay.

    Args:
        terms: over the sum of their sizes in each form.
        n: number of coordinates.

    Returns:
        Shape ``(forms + first, n)``.
    """
    jacobian = np.zeros((len(forms) + len(first), n), dtype=complex)
    for row, form, own in zip(jacobian, forms, terms, strict=False):
        for (factors, _), term in zip(form, own, strict=True):
            part = complex(term)
            for j, k in factors:
                row[j] += k * part
    jacobian[range(len(forms), len(jacobian)), first] = 1.0
    return jacobian


def _is_near_regular_zero(
    forms: Sequence[Form], terms: Sequence[Sequence[Any]], jacobian: np.ndarray
) -> bool:
    """Whether Kantorovich's theorem shows a zero at which the forms' Jacobian is surjective.

    In the logarithms of the coordinates the second derivatives of a term are the term times
    products of its exponents k. Within r of the point those of a form are at most
    ``|k|^2 e^(|k| r)`` times the sum of the sizes of its terms, which is one.

    Reference:
        Ortega & Rheinboldt, Iterative Solution of Nonlinear Equations in Several Variables, 1970,
        theorem 12.6.2; of right inverses the same proof.
    """
    if len(jacobian) > jacobian.shape[1]:
        return False
    singular_values = np.linalg.svd(jacobian, compute_uv=False)
    smallest = float(singular_values[-1])
    if not smallest > INDEPENDENT * singular_values[0]:
        return False
    values = [abs(complex(sum(own, flint.acb(0)))) for own in terms]
    largest = sqrt(max(sum(k * k for _, k in factors) for form in forms for factors, _ in form))
    step = float(np.linalg.norm(values)) / smallest
    # A zero is within twice a step; half of the room is for the doubles that the bounds are in.
    bend = sqrt(len(forms)) * largest**2 * exp(1)
    return 2 * step * largest < 1 and step * bend / smallest < 0.25


def _sizes_left(forms: Sequence[Form], inverse: np.ndarray, x: Sequence[Any]) -> np.ndarray:
    """What is left of each form where those that can be solved for vanish; decimal logarithms."""
    last = inf
    for _ in range(STEPS):
        values = [sum(own, flint.acb(0)).mid() for own in _terms(forms, x)]
        logs = np.array([log_size(v) for v in values])
        largest = logs.max()
        if largest < ZERO:
            break
        unit = flint.arb(10) ** flint.arb(largest)
        step = inverse @ np.array([complex(v / unit) for v in values])
        length = largest + log10(max(np.abs(step).max(), 1e-300))
        if length > last - GAIN:
            break
        last = length
        x = [(z * (1 - unit * flint.acb(s))).mid() for z, s in zip(x, step.tolist(), strict=True)]
    return logs
