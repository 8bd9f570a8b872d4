"""What equations of a component's image, and the maps to its other variables, show in commands."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from nag.text.table import count_text, join_words, label_lines, named_line

if TYPE_CHECKING:
    from nag.interpolation.essential import VariableMap
    from nag.interpolation.image_ideal import ImageIdeal

PROOFS = {
    "substitution": (
        "proved: with maps to all variables put in, the system's equations lie in the ideal of "
        "equations in essential variables, which are regular at the exact point, and so do these"
    ),
    "reduction": (
        "proved: a power of each, times a polynomial that does not vanish on the component, lies "
        "in the ideal of the system's equations"
    ),
    "points": "not proved; they hold at fresh random points, see below",
}


NO_OTHERS = "the equations have no other zeros but for sets of lower dimension"


def ideal_line(found: ImageIdeal) -> str:
    """What an elimination is at the prompt: one line."""
    onto = ", ".join(found.names)
    count = count_text(len(found.generators), "equation")
    maps = count_text(len(found.maps), "map")
    whose = whose_equations(found) if found.generators or found.maps else ""
    said = f" onto {onto}: dimension {found.dimension}, {count}{whose}, {maps}"
    return named_line(found, said)


def whose_equations(found: ImageIdeal) -> str:
    """Of which images the equations are, if not of the component's alone."""
    if found.together:
        return f" of components {join_words([str(number) for number in found.together])} together"
    if found.self_conjugate is False:
        return " of it and its conjugate together"
    return "" if found.self_conjugate else " of it and perhaps its conjugate together"


def head_rows(found: ImageIdeal) -> list[tuple[str, str]]:
    """What is said above the equations."""
    names = ", ".join(found.names)
    onto = f"{names}, degrees up to {found.degree}" if found.degree else names
    return [("onto", onto), ("image", image_text(found)), ("essential", essential_text(found))]


def checked_row(found: ImageIdeal) -> tuple[str, str]:
    """At how many random points equations and maps hold, and how well."""
    if not (found.generators or found.maps):
        return "checked", "nothing to check"
    points, worst = found.fresh
    text = f"at {points} fresh random points: equations and maps hold to {-worst:.0f} digits"
    return "checked", text


def elimination_lines(found: ImageIdeal) -> list[str]:
    """Equations, what they rest on, the maps and the variables without one."""
    lines = ["equations"]
    texts = [f"{found.text(f)} = 0" for f in found.generators]
    lines += _with_proofs(texts, found.generator_proofs) or ["  none"]
    if found.maps:
        lines += ["", "maps"]
        lines += _with_proofs([map_text(found, m) for m in found.maps], found.map_proofs)
    return lines


def _with_proofs(texts: Sequence[str], proofs: Sequence[str]) -> list[str]:
    lines = []
    for kind, explanation in PROOFS.items():
        chosen = [text for text, proof in zip(texts, proofs, strict=True) if proof == kind]
        if chosen:
            lines += [*(f"  {text}" for text in chosen), *label_lines([("  ", explanation)])]
    return lines


def map_text(found: ImageIdeal, m: VariableMap) -> str:
    """``b2 = a2/(2*a0)``."""
    name = found.variables[m.variable]
    if m.polynomial:
        (below,) = m.denominator.terms.values()
        return f"{name} = {found.text(m.numerator / below)}"
    above, below = m.whole_fraction()
    texts = [found.text(f) for f in (above, below)]
    shown = [
        f"({t})" if len(f.terms) > 1 or "*" in t else t
        for f, t in zip((above, below), texts, strict=True)
    ]
    return f"{name} = {shown[0]}/{shown[1]}"


def essential_text(found: ImageIdeal) -> str:
    """Whether the variables determine all others."""
    names = ", ".join(found.names)
    are, them = ("is", "it") if len(found.names) == 1 else ("are", "them")
    if found.missing:
        missing = ", ".join(found.variables[i] for i in found.missing)
        if found.dimension < found.component_dimension:
            return f"{names} {are} not essential: the image has a smaller dimension"
        return f"{names} {are} not shown to be essential: no map was found to {missing}"
    if not found.maps:
        return f"{names} {are} all the variables"
    if all(m.polynomial for m in found.maps):
        kind = f"polynomials in {them}"
    else:
        kind = f"rational functions of {them}"
    return f"{names} {are} essential: all other variables are {kind}"


def image_text(found: ImageIdeal) -> str:
    """Dimension and degree of the image, and whether its equations are all there."""
    text = f"dimension {found.dimension}"
    if found.dimension == len(found.coordinates):
        return f"{text}: no polynomial vanishes on it"
    if found.defines:
        return f"{text}, degree {found.zeros[1]}: {NO_OTHERS}"
    whole = f", of degree {found.zeros[1]} together: {NO_OTHERS}" if found.defines_union else ""
    if found.together:
        names = join_words([str(number) for number in found.together])
        return (
            f"{text}, without equations of its own over the field of the coefficients: those of "
            f"components {names} hold, among which are its conjugates{whole}"
        )
    if found.self_conjugate is False:
        return f"{text}, not its own conjugate: the equations hold on both{whole}"
    if found.self_conjugate is None and found.defines_union:
        return f"{text}: the equations hold on it and on its conjugate, which may be another{whole}"
    if found.cuts:
        return f"{text}: a component of the equations' common zeros; there may be others"
    return f"{text}: equations of higher degree are missing"
