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
from math import exp, inf, sqrt
from typing import Any

import flint
import numpy as np

from nag.numerics.ball_polynomials import Factors, MonomialProducts
from nag.numerics.coincidence import BEYOND
from nag.numerics.digits import in_bits, log_size
from nag.numerics.double_ranks import INDEPENDENT
from nag.numerics.newton import step_by_doubles
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


@dataclass(frozen=True, eq=False)
class Face:
    """The initial forms in one direction, in the coordinates that do not vanish.

    Attributes:
        there: these coordinates.
        monomials: what the forms are evaluated by.
        forms: for each its terms: a monomial, its place among the products, its coefficient.
        matrix: the coefficients, forms by products.
    """

    there: tuple[int, ...]
    monomials: MonomialProducts
    forms: tuple[tuple[tuple[Factors, int, Any], ...], ...]
    matrix: flint.acb_mat

    @classmethod
    def of(cls, forms: Sequence[Sequence[tuple[Factors, Any]]], there: Sequence[int]) -> Face:
        """Forms as exponents and coefficients of their terms, in all coordinates."""
        places = {j: k for k, j in enumerate(there)}
        made = MonomialProducts(len(there))
        placed = []
        for form in forms:
            own = (((tuple((places[j], k) for j, k in factors)), c) for factors, c in form)
            placed.append(tuple((factors, made.place(factors), c) for factors, c in own))
        rows: list[list[Any]] = [[0] * (1 + len(there) + len(made.pairs)) for _ in placed]
        for row, form in zip(rows, placed, strict=True):
            for _, place, c in form:
                row[place] = row[place] + c
        matrix = flint.acb_mat(rows) if rows else flint.acb_mat(0, 0)
        return cls(tuple(there), made, tuple(placed), matrix)

    def values(self, x: Sequence[Any]) -> list[Any]:
        """The values of the forms."""
        at = self.monomials.values(x)
        return (self.matrix * flint.acb_mat(len(at), 1, at)).mid().entries()

    def terms(self, x: Sequence[Any]) -> list[list[Any]]:
        """The terms of the forms."""
        at = self.monomials.values(x)
        return [[c * at[place] for _, place, c in form] for form in self.forms]


@dataclass(frozen=True, eq=False)
class InitialForms:
    """The initial forms of the homotopy that ``terms`` are of, in so many bits, each made once."""

    terms: Terms
    bits: int
    _known: dict[tuple[int, ...], Face] = field(default_factory=dict)

    def _of(self, orders: tuple[int, ...], winding: int) -> Face:
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
            there = [j for j, order in enumerate(orders) if order < NEVER]
            self._known[key] = Face.of(forms, there)
        return self._known[key]

    def residual(self, orders: tuple[int, ...], winding: int, point: Sequence[Any]) -> float:
        """The largest value of a form over the sum of its terms, at a point in FLINT's ``acb``."""
        worst = 0.0
        with in_bits(self.bits):
            face = self._of(orders, winding)
            for terms in face.terms([point[j] for j in face.there]):
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
        with in_bits(self.bits):
            face = self._of(orders, winding)
            if not face.forms:
                # Coordinates that vanish make all equations vanish.
                return True
            first = [
                next(i for i, j in enumerate(face.there) if j in group)
                for group in self.terms.homotopy.groups
            ]
            x = [point[j].mid() for j in face.there]
            terms = face.terms(x)
            inverse_sizes = [(1 / sum(map(abs, own), flint.arb(0))).mid() for own in terms]
            pairs = zip(terms, inverse_sizes, strict=True)
            terms = [[term * inverse for term in own] for own, inverse in pairs]
            jacobian = _logarithmic_jacobian(face, first, terms)
            if _is_near_regular_zero(face, terms, jacobian):
                return True
            inverse = np.linalg.pinv(jacobian, rcond=INDEPENDENT)[:, : len(face.forms)]
            here = _sizes_left(face, inverse_sizes, inverse, x)
            rest = here > ZERO
            if not rest.any():
                return True
            phases = np.exp(2j * np.pi * np.random.default_rng(0).random(len(x)))
            shift = max(error * BEYOND, CLOSE)
            moved = [z * flint.acb(complex(1 + shift * u)) for z, u in zip(x, phases, strict=True)]
            there = _sizes_left(face, inverse_sizes, inverse, moved)
            return bool((there[rest] > here[rest] + GROWN).all())


def _logarithmic_jacobian(
    face: Face, first: Sequence[int], terms: Sequence[Sequence[Any]]
) -> np.ndarray:
    """The derivatives of the forms by the logarithms of the coordinates; those ``first`` stay.

    Args:
        terms: over the sum of their sizes in each form.

    Returns:
        Shape ``(forms + first, n)``.
    """
    forms = face.forms
    jacobian = np.zeros((len(forms) + len(first), len(face.there)), dtype=complex)
    for row, form, own in zip(jacobian, forms, terms, strict=False):
        for (factors, _, _), term in zip(form, own, strict=True):
            part = complex(term)
            for j, k in factors:
                row[j] += k * part
    jacobian[range(len(forms), len(jacobian)), first] = 1.0
    return jacobian


def _is_near_regular_zero(face: Face, terms: Sequence[Sequence[Any]], jacobian: np.ndarray) -> bool:
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
    largest = sqrt(
        max(sum(k * k for _, k in factors) for form in face.forms for factors, _, _ in form)
    )
    step = float(np.linalg.norm(values)) / smallest
    # A zero is within twice a step; half of the room is for the doubles that the bounds are in.
    bend = sqrt(len(face.forms)) * largest**2 * exp(1)
    return 2 * step * largest < 1 and step * bend / smallest < 0.25


def _sizes_left(
    face: Face, inverse_sizes: Sequence[Any], inverse: np.ndarray, x: Sequence[Any]
) -> np.ndarray:
    """What is left of each form where those that can be solved for vanish; decimal logarithms.

    Newton's method with one pseudo-inverse, in doubles, for values that are far below these.
    """
    last = inf
    for _ in range(STEPS):
        values = [v * size for v, size in zip(face.values(x), inverse_sizes, strict=True)]
        logs = np.array([log_size(v) for v in values])
        if logs.max() < ZERO:
            break
        _, length, step = step_by_doubles(inverse, values)
        if length > last - GAIN:
            break
        last = length
        x = [(z * (1 - s)).mid() for z, s in zip(x, step, strict=True)]
    return logs
