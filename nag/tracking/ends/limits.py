"""Limits of branches as t goes to 0: orders, leading coefficients, and whether the equations agree.

A branch is ``x_j = t^v_j (X_j + ..)`` with rational orders v. In the direction (v, 1) the terms of
least order of each equation of the homotopy must cancel at X: its initial forms. That they vanish
to many digits is evidence, no proof: an end so near to it would look the same. It takes more digits
than the coefficients have.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

import flint
import numpy as np

from nag.algebra.number import decimal_digits
from nag.algebra.polynomial import ROUND_NUMBERS
from nag.numerics.digits import in_bits, number_of_words, real_of_words, words_of_number
from nag.tracking.ends.initial_forms import FINE, InitialForms
from nag.tracking.ends.runs import MAX_WINDING
from nag.tracking.ends.terms import BITS, Terms
from nag.tracking.homotopy import Homotopy
from nag.tracking.paths import NEVER, relative

# Decides, measured: Digits to which the exact equations' terms of least order must cancel at a
# limit, so that coefficients that doubles rounded would show. No gap: a limit that does not pass is
# looked for further in.
LEAST_EVIDENCE = 14
# Decides: The most that is asked for: more cannot be asked of 64 digits, and 120 are for paths that
# these lose.
MOST_EVIDENCE = 58
# Decides, measured: How far an order of a coordinate may be from a rational number.
WHOLE = 1e-3
# The largest order.
LARGEST = 100
# Decides: Error of a limit in last terms of its series.
BEYOND = 30.0
# Decides: Last terms of a power series over those that were left further out: branches that are not
# one leave more on the way in.
FALLEN = 0.5


@dataclass(frozen=True, eq=False)
class Limit:
    """Where a branch leads.

    Attributes:
        orders: of the coordinates, in units of ``1 / winding``.
        winding: winding number, or a part of it where all orders have a smaller denominator.
        point: leading coefficients as doubles, 0 for coordinates that vanish beside those of
            least order in their group, shape ``(N,)``; ``centre``: the same in all digits, shape
            ``(N, 2, words)``.
        branch: logarithms of all leading coefficients over the first of least order in their
            group, 0 for coordinates that are not known, shape ``(N,)``.
        bends: derivatives of the coordinates' logarithms with respect to ``t ** (1 / w)`` at t = 0,
            less that of the same one of each group, shape ``(N,)``.
        leading: leading coefficients, in FLINT's ``acb``, 0 for coordinates that are not known.
        tail: size of the last terms of the power series.
        residual: largest value of an initial form over the sum of its terms.
        seen_from: the t of the point that it was found from.
    """

    orders: tuple[int, ...]
    winding: int
    point: np.ndarray
    centre: np.ndarray
    branch: np.ndarray
    bends: np.ndarray
    leading: tuple[Any, ...]
    tail: float
    residual: float
    seen_from: float

    @property
    def direction(self) -> tuple[Fraction, ...]:
        """The orders of the coordinates."""
        return tuple(Fraction(order, self.winding) for order in self.orders)


@dataclass(frozen=True, eq=False)
class Limits:
    """What finds the limits of the branches of one homotopy, in numbers of ``words`` doubles."""

    terms: Terms
    words: int
    order: int

    @cached_property
    def forms(self) -> InitialForms:
        """The initial forms of the homotopy, in the digits that are worked with."""
        return InitialForms(self.terms, BITS[self.words])

    @cached_property
    def _fine(self) -> InitialForms:
        return InitialForms(self.terms, FINE)

    def is_affine(self, limit: Limit) -> bool:
        """Whether a limit counts as one at infinity only as some variable vanishes there."""
        known = limit.point != 0
        homotopy = self.terms.homotopy
        counted, infinite = known[list(homotopy.infinity)], known[list(homotopy.rows.infinity)]
        return bool(infinite.all() and not counted.all())

    def is_believed(self, limit: Limit, before: Limit | None, need: float) -> bool:
        """Whether a branch that seems to lead to infinity does so from nearer as well.

        Forms at a multiple zero are as small as a power of the distance from it, and several
        branches look like one from afar that part further in. What is left of their power series
        then grows on the way in, and of a branch that is one it falls.

        Args:
            before: what was found before, of which only what was found further out counts.
        """
        if (limit.point[list(self.terms.homotopy.infinity)] != 0).all() or limit.tail <= need:
            return True
        if before is None or before.seen_from <= limit.seen_from:
            return False
        return before.direction == limit.direction and limit.tail < FALLEN * before.tail

    def exists(self, limit: Limit, noise: float) -> bool:
        """Whether a limit at infinity is one exactly: what finite ones are is decided elsewhere.

        Args:
            noise: largest relative rounding error of the coordinates that it was found from.
        """
        if (limit.point[list(self.terms.homotopy.infinity)] != 0).all():
            return True
        error = BEYOND * limit.tail + noise
        return self._fine.vanish(limit.orders, limit.winding, limit.leading, error)

    def of(
        self, x: np.ndarray, found: np.ndarray, known: np.ndarray, t: np.ndarray, winding: int
    ) -> Limit | None:
        """The limit of a branch.

        Args:
            x: coordinates at t, shape ``(N, 2, words)``.
            found: what `nag.tracking.ends.branch.extrapolate` gives, shape ``(N, 4, 2, words)``.
            known: which coordinates exceed their rounding errors, shape ``(N,)``.
            t: shape ``(words,)``.
            winding: the w of the power series in ``t^(1/w)``.

        Returns:
            None where the orders are no rational numbers with a common small denominator, or no
            coordinate of a group is known.
        """
        with in_bits(BITS[self.words]):
            return self._of(x, found, known, t, winding)

    def _of(
        self,
        x: np.ndarray,
        found: np.ndarray,
        known: np.ndarray,
        t: np.ndarray,
        winding: int,
    ) -> Limit | None:
        N = self.terms.homotopy.N
        slopes, last = (
            found[:, i, 0].sum(axis=1) + 1j * found[:, i, 1].sum(axis=1) for i in (0, 1)
        )
        tail = float(np.abs(last[known]).max(initial=0.0))
        if not np.abs(slopes[known].imag).max(initial=0.0) <= WHOLE:
            return None
        denominator = _denominator(slopes[known].real, winding)
        groups = self.terms.homotopy.groups
        if not denominator or not all(known[list(indices)].any() for indices in groups):
            return None
        orders = [NEVER] * N
        leading = [flint.acb(0)] * N
        log_t = real_of_words(t).log()
        # `extrapolate` leaves out this part of the change, times w v.
        shift = flint.fmpq(0)
        for m in range(1, self.order + 1):
            shift += flint.fmpq(1, m)
        for j in np.flatnonzero(known).tolist():
            orders[j] = round(denominator * slopes[j].real)
            order = flint.fmpq(orders[j], denominator)
            change = number_of_words(found[j, 2]) + winding * order * shift - log_t * order
            leading[j] = number_of_words(x[j]) * change.exp()
            if not leading[j].is_finite():
                return None
        bends = found[:, 3, 0].sum(axis=1) + 1j * found[:, 3, 1].sum(axis=1)
        rates = np.array([k / denominator if k < NEVER else 0.0 for k in orders])
        bends = np.where(known, bends - winding * self.order * rates, 0.0)
        bends = relative(bends, orders, self.terms.homotopy.groups) / t[0] ** (1.0 / winding)
        winding = denominator
        residual = self.forms.residual(tuple(orders), winding, leading)
        centre = self._centre(orders, leading)
        parts = centre.sum(axis=2)
        point = parts[:, 0] + 1j * parts[:, 1]
        branch = self._branch(orders, leading)
        return Limit(
            *(tuple(orders), winding, point, centre, branch, bends),
            *(tuple(leading), tail, residual, float(t[0])),
        )

    def _centre(self, orders: list[int], leading: list[Any]) -> np.ndarray:
        centre = np.zeros((self.terms.homotopy.N, 2, self.words))
        for indices in self.terms.homotopy.groups:
            least = min(orders[j] for j in indices)
            first = [j for j in indices if orders[j] == least]
            # A power of two, by which nothing is rounded.
            size = 2 ** round(max(float(abs(leading[j]).log().mid()) for j in first) / np.log(2.0))
            for j in first:
                centre[j] = words_of_number(leading[j] / size, self.words)
        return centre

    def _branch(self, orders: list[int], leading: list[Any]) -> np.ndarray:
        logs = np.zeros(self.terms.homotopy.N, dtype=np.complex128)
        for indices in self.terms.homotopy.groups:
            first = min(indices, key=lambda j: (orders[j], j))
            for j in indices:
                if orders[j] < NEVER:
                    logs[j] = complex((leading[j] / leading[first]).log())
        return logs


def _denominator(values: np.ndarray, least: int) -> int:
    """The first denominator from ``least`` on that all rational values share; 0 if none does."""
    for d in range(least, LARGEST + 1):
        if np.all(np.abs(d * values - np.rint(d * values)) <= WHOLE):
            return d
    return 0


def digits_of_evidence(homotopy: Homotopy, beyond: int) -> tuple[int, ...]:
    """To how many digits an end must satisfy the equations: so many more than these have.

    What holds only because coefficients were rounded then does not count. Entry ``k`` is for
    winding numbers that ``2 ** k`` divides: what joins two branches may be a coincidence of
    coefficients, and the zeros that several of these move away are as much farther out.
    """
    most = _rows_digits(homotopy) if homotopy.digits is None else homotopy.digits
    long = max(0, most - ROUND_NUMBERS)
    return tuple(
        min(LEAST_EVIDENCE + beyond + max(1, k) * long, MOST_EVIDENCE)
        for k in range(MAX_WINDING.bit_length())
    )


def _rows_digits(homotopy: Homotopy) -> int:
    """Decimal digits of the coefficients of the rows at t = 0."""
    most = 0
    for row in homotopy.rows.parts:
        for part, terms in row:
            if homotopy.factors[part][0] != 0:
                most = max(most, *map(decimal_digits, terms.values()))
    return most
