"""What singular points and swept components show in the commands."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from nag.text.table import count_text
from nag.witness.shown import ranges_text

if TYPE_CHECKING:
    from nag.decomposition.singular_members import SingularParameters
    from nag.decomposition.singular_points import SingularLocus, SingularSet
    from nag.numerics.tangent_cone import TangentCone

# What is smaller than this, in a point that is known to rounding, is written as zero.
NOTHING = 1e-13


def coordinate_text(z: complex) -> str:
    """A coordinate to eight digits."""
    real = 0.0 if abs(z.real) < NOTHING else z.real
    imaginary = 0.0 if abs(z.imag) < NOTHING else z.imag
    if not imaginary:
        return f"{real:.8g}"
    return f"{real:.8g}{imaginary:+.8g}i" if real else f"{imaginary:.8g}i"


# What the equations of a set of parameters rest on.
PROOFS = {
    "reduction": "proved by reduction modulo the equations of singular points",
    "points": "recognised in many digits of random points, and holds in twice as many",
    "dimension": "by the rank of tangents",
}


def parameter_rows(found: SingularParameters) -> list[tuple[str, str]]:
    """For which parameters members are singular, what that rests on, and what is open."""
    rows = []
    for each in found.sets:
        size = f"dimension {each.dimension}, degree {each.degree}"
        rows.append(("singular", each.text(found.parameters)))
        rows.append(("", f"{size}; {PROOFS[each.proof]}"))
    if not rows:
        answer = "for no parameters" if found.complete else "it is not known for which parameters"
        rows.append(("singular", answer))
    if found.proved:
        rows.append(("complete", "proved: a Groebner basis has no further singular points"))
    return [*rows, *(("open", note) for note in found.notes)]


def _numbers(indices: Sequence[int]) -> str:
    return ", ".join(str(i + 1) for i in indices)


def locus_rows(locus: SingularLocus, count: int) -> list[tuple[str, str]]:
    """How many singular points and sets there are, and which of the components are smooth."""
    points = [one for one in locus.sets if one.dimension == 0]
    larger = len(locus.sets) - len(points)
    parts = [count_text(len(points), "isolated singular point")] if points else []
    if larger:
        parts.append(count_text(larger, "set") + " of singular points of positive dimension")
    none = "no singular points" if locus.complete else "undecided: no singular point is certain"
    rows = [("answer", ", ".join(parts) or none)]
    essential = sum(bool(one.essential) for one in locus.sets)
    if locus.sets:
        meeting = sum(one.intersection for one in locus.sets)
        kinds = f"{essential} on a component by itself, {meeting} where components meet"
        rows.append(("kinds", kinds))
    smooth = locus.smooth
    if smooth:
        which = "the component"
        if count > 1:
            alone = "by itself" if len(smooth) == 1 else "each by itself"
            noun = "component" if len(smooth) == 1 else "components"
            which = f"{noun} {ranges_text([i + 1 for i in smooth])} of {count}, {alone}"
        proof = "; proved, by a Groebner basis" if set(smooth) <= set(locus.proved) else ""
        rows.append(("smooth", f"{which}{proof}"))
    if not locus.complete:
        rows.append(("", "INCOMPLETE, see below"))
    return rows


def set_rows(one: SingularSet, variables: Sequence[str]) -> list[tuple[str, str]]:
    """One singular point or set, as labelled texts.

    Args:
        variables: names of the coordinates, without that of an imaginary unit, the last one.
    """
    n = one.points.shape[1]
    every = (*variables, *[""] * (n - len(variables)))
    values = zip(variables, one.points[0].tolist(), strict=False)
    at = ", ".join(f"{name} = {coordinate_text(z)}" for name, z in values)
    if one.dimension:
        head = ("set", f"dimension {one.dimension}, degree {one.degree}, through {at}")
    else:
        head = ("point", at)
    rows = [head, ("", _kind_text(one))]
    if one.cone is not None:
        rows.append(("", _cone_text(one, one.cone, every)))
        # That the unit is constant is no equation of the user's.
        linear = [f for f in one.cone.linear if any(any(e[: len(variables)]) for e in f)]
        if linear:
            space = replace(one.cone, linear=tuple(linear)).tangent_text(every)
            rows.append(("", f"tangent space {space}"))
    elif not one.dimension:
        rows.append(("", "tangent cone not found"))
    return rows


def _cone_text(one: SingularSet, cone: TangentCone, variables: Sequence[str]) -> str:
    text = f"tangent cone {cone.text(variables)} to lowest order, in distances from it"
    more = None not in (cone.dimension, one.local.dimension)
    if more and cone.dimension != one.local.dimension:
        text += "; further equations of it are of higher degree"
    return text


def _kind_text(one: SingularSet) -> str:
    parts = []
    if one.intersection:
        parts.append(f"components {_numbers(tuple(one.multiplicities))} meet")
    for i in one.essential:
        parts.append(f"singular on component {i + 1}, multiplicity {one.multiplicities[i]}")
    text = "; ".join(parts)
    if one.local.tangent_dimension is not None:
        text += f"; tangent dimension {one.local.tangent_dimension}"
    if one.local.dimension is not None:
        text += f", local dimension {one.local.dimension}"
    return text
