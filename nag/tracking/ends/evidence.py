"""How many digits are evidence that an end is what it seems to be."""

from __future__ import annotations

from nag.algebra.number import decimal_digits
from nag.tracking.ends.runs import MAX_WINDING
from nag.tracking.homotopy import Homotopy

# Digits to which equations with coefficients of so few digits must hold at least, and the most
# that may be asked for.
LEAST_EVIDENCE, ROUND_NUMBERS, MOST_EVIDENCE = 14, 6, 58


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
