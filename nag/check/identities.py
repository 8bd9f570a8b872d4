"""Identities between formulas, proved at generic parameters, square roots included."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any

from nag.algebra.groebner import divisor, remainder
from nag.algebra.rational_function import FunctionField, RationalFunction
from nag.check.statement import Verdict, VerdictKind, fails, holds

# Label of what must vanish, and its value.
Residuals = Mapping[str, Any]
Formula = Callable[..., Residuals]
# A name for a square root, and what its square is in the parameters.
Root = tuple[str, Callable[..., Any]]


def surviving(names: str, formula: Formula, roots: Sequence[Root] = ()) -> list[str]:
    """Labels of what does not vanish identically.

    Args:
        names: the parameters' names.
        formula: from parameters and roots, as functions, to what must vanish.
        roots: square roots of functions of the parameters. They are taken for independent: neither
            they nor their products are functions of the parameters.
    """
    field = FunctionField(" ".join([*(name for name, _ in roots), names]))
    variables = field.variables
    adjoined, parameters = variables[: len(roots)], variables[len(roots) :]
    relations = [
        (root**2 - square(*parameters)).numerator
        for root, (_, square) in zip(adjoined, roots, strict=True)
    ]
    divisors = [divisor(f, len(roots)) for f in relations]
    kept = []
    for label, value in formula(*parameters, *adjoined).items():
        if not isinstance(value, RationalFunction):
            value = field(value)
        if remainder(value.denominator, divisors, len(roots)) == 0:
            raise ZeroDivisionError(f"{label}: the denominator vanishes identically")
        if remainder(value.numerator, divisors, len(roots)) != 0:
            kept.append(label)
    return kept


def identity(
    names: str, formula: Formula, at: Sequence[Fraction], roots: Sequence[Root] = ()
) -> Verdict:
    """Whether everything vanishes identically; if not, a value at the parameters ``at``.

    Where there are roots, ``at`` has values of them too, after those of the parameters.
    """
    kept = surviving(names, formula, roots)
    given = ", ".join(names.split())
    if not kept:
        with_roots = f" with {', '.join(name for name, _ in roots)} adjoined" if roots else ""
        return holds(f"identity in {given}{with_roots}")
    return fails("it is false", counterexample(names, formula, at, kept, roots))


def misprinted(names: str, printed: Formula, mended: Formula, at: Sequence[Fraction]) -> Verdict:
    """A formula that fails at ``at`` as printed and holds identically when mended."""
    kept = surviving(names, printed)
    if not kept:
        return holds(f"identity in {', '.join(names.split())}")
    if surviving(names, mended):
        return Verdict(
            VerdictKind.OPEN, "neither what is printed nor what was thought to be true holds"
        )
    text = f"mended, it is an identity in {', '.join(names.split())}"
    return fails(text, counterexample(names, printed, at, kept))


def counterexample(
    names: str,
    formula: Formula,
    at: Sequence[Fraction],
    labels: Sequence[str],
    roots: Sequence[Root] = (),
) -> str:
    """The exact value at a point of the first label that does not vanish there."""
    values = formula(*at)
    label = next((x for x in labels if values[x] != 0), labels[0])
    all_names = [*names.split(), *(name for name, _ in roots)]
    point = ", ".join(f"{n} = {x}" for n, x in zip(all_names, at, strict=True))
    return f"at {point}: {label} is {values[label]}, not 0"


def labelled(label: str, values: Sequence[Any]) -> dict[str, Any]:
    """Entries of a vector under one label."""
    return {f"{label}[{i + 1}]": value for i, value in enumerate(values)}


def matrix(label: str, left: Sequence[Sequence[Any]], right: Sequence[Sequence[Any]]) -> Residuals:
    """Differences of the entries of two matrices."""
    return {
        f"{label}[{i + 1}, {j + 1}]": x - y
        for i, (r, s) in enumerate(zip(left, right, strict=True))
        for j, (x, y) in enumerate(zip(r, s, strict=True))
    }
