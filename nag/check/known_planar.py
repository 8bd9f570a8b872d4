"""Planar linkages of PT13 with all their components."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from nag.check.known import (
    KnownDecomposition,
    PaperComponent,
    Parameters,
    Parametrisation,
    Values,
    circle,
    flat,
    turned,
)
from nag.symbolic import four_bar, slider_crank


def bars(which: str, a: Any, b: Any, t: Any) -> list[tuple[Any, Any]]:
    """Bars 0 to 3 of a four-bar against bar 0, in a component and with one half-angle."""
    one = t - t + 1
    ground, first = (one, 0 * one), circle(t)
    if which == "parallelogram":
        return [ground, first, ground, first]
    if which == "folded_1":
        return [ground, first, (-first[0], -first[1]), (-one, 0 * one)]
    if which == "folded_2":
        return [ground, ground, first, first]
    third = circle(t * Fraction(a + b) / (b - a))
    second = [(a * e - b * p + b * q) / a for e, p, q in zip(ground, first, third, strict=True)]
    return [ground, first, tuple(second), third]


PLACES = {
    "parallelogram": "PT13 5.3, J_0",
    "antiparallelogram": "PT13 5.3, J_1",
    "folded_1": "PT13 5.3, hat J_1",
    "folded_2": "PT13 5.3, hat J_2",
}


def four_bar_generators(which: str, a: Any, b: Any, c: Values, s: Values) -> list[Any]:
    """Generators of one of its components."""
    if which == "antiparallelogram":
        return four_bar.antiparallelogram(a, b, c, s)
    formula = {
        "parallelogram": four_bar.parallelogram,
        "folded_1": four_bar.folded_1,
        "folded_2": four_bar.folded_2,
    }[which]
    return formula(c, s)


def positive(p: Parameters) -> bool:
    """Whether the sides are lengths."""
    return all(x > 0 for x in p.values())


def modes(a: Any, b: Any) -> tuple[str, ...]:
    """Names of a four-bar's components."""
    if a == b:
        return ("parallelogram", "folded_1", "folded_2")
    return ("parallelogram", "antiparallelogram")


def free_four_bar(p: Parameters) -> KnownDecomposition:
    """All four bars may turn."""
    a, b = p["a"], p["b"]

    def component(which: str) -> PaperComponent:
        def point(t: Any, z: Any) -> list[Any]:
            return flat([turned(circle(z), bar) for bar in bars(which, a, b, t)])

        return PaperComponent(
            PLACES[which],
            lambda v: four_bar_generators(which, a, b, v[::2], v[1::2]),
            Parametrisation("t z", point),
        )

    return KnownDecomposition(
        "four-bar",
        four_bar.VARIABLES,
        lambda v: four_bar.four_bar(a, b, v[::2], v[1::2]),
        tuple(map(component, modes(a, b))),
    )


def fixed_four_bar(p: Parameters) -> KnownDecomposition:
    """Bar 0 is fixed."""
    a, b = p["a"], p["b"]

    def all_bars(v: Values) -> tuple[list[Any], list[Any]]:
        one = v[0] - v[0] + 1
        return [one, *v[::2]], [0 * one, *v[1::2]]

    def component(which: str) -> PaperComponent:
        return PaperComponent(
            PLACES[which],
            lambda v: four_bar_generators(which, a, b, *all_bars(v)),
            Parametrisation("t", lambda t: flat(bars(which, a, b, t)[1:])),
        )

    return KnownDecomposition(
        "four-bar, bar 0 fixed",
        four_bar.VARIABLES[2:],
        lambda v: four_bar.four_bar(a, b, *all_bars(v)),
        tuple(map(component, modes(a, b))),
    )


def two_four_bars(p: Parameters) -> KnownDecomposition:
    """PT13 (9)."""
    a, b = p["a"], p["b"]

    def component(first: str, second: str) -> PaperComponent:
        def generators(v: Values) -> list[Any]:
            c, s = v[::2], v[1::2]
            return [
                c[0] - 1,
                s[0],
                *four_bar_generators(first, 1, b, c[:4], s[:4]),
                *four_bar_generators(second, a, b, four_bar.second(c), four_bar.second(s)),
            ]

        def point(t: Any, z: Any) -> list[Any]:
            left = bars(first, 1, b, t)
            # The second four-bar in its own order: bars 4, 3, 5, 6; bar 3 is given.
            right = bars(second, a, b, z)
            back = (right[1][0], -right[1][1])
            new = [turned(turned(left[3], back), bar) for bar in right]
            return flat([*left, new[0], new[2], new[3]])

        place = "PT13 (10)" if (a, b) != (1, 1) else "PT13 5.3, a = b = 1"
        return PaperComponent(
            f"{place}: {first} and {second}", generators, Parametrisation("t z", point)
        )

    return KnownDecomposition(
        "two four-bars",
        four_bar.TWO_VARIABLES,
        lambda v: four_bar.two_four_bars(a, b, v[::2], v[1::2]),
        tuple(component(f, g) for f in modes(1, b) for g in modes(a, b)),
    )


# Directions of bars 1, 2, 3, 5, 6 on the six curves: 1 is along bar 0, t turns.
GONZALEZ_CURVES = {
    "parallelogram and parallelogram": ("t", "1", "t", "1", "t"),
    "parallelogram and folded_1": ("t", "1", "t", "-t", "-1"),
    "folded_2 and parallelogram": ("1", "t", "t", "1", "t"),
    "folded_2 and folded_1": ("1", "t", "t", "-t", "-1"),
    "folded_1 and parallelogram": ("t", "-t", "-1", "1", "-1"),
    "parallelogram and folded_2": ("1", "1", "1", "t", "t"),
}


def gonzalez(p: Parameters) -> KnownDecomposition:
    """PT13 section 7.2: two rhombi between fixed bars."""

    def all_bars(v: Values) -> tuple[list[Any], list[Any]]:
        one = v[0] - v[0] + 1
        c, s = list(v[::2]), list(v[1::2])
        return [one, *c[:3], one, *c[3:]], [0 * one, *s[:3], 0 * one, *s[3:]]

    def component(name: str, directions: tuple[str, ...]) -> PaperComponent:
        first, second = name.split(" and ")

        def generators(v: Values) -> list[Any]:
            c, s = all_bars(v)
            return [
                *four_bar_generators(first, 1, 1, c[:4], s[:4]),
                *four_bar_generators(second, 1, 1, four_bar.second(c), four_bar.second(s)),
            ]

        def point(t: Any) -> list[Any]:
            c, s = circle(t)
            one = t - t + 1
            values = {"1": (one, 0 * one), "-1": (-one, 0 * one), "t": (c, s), "-t": (-c, -s)}
            return flat([values[d] for d in directions])

        return PaperComponent(f"PT13 7.2: {name}", generators, Parametrisation("t", point))

    return KnownDecomposition(
        "two rhombi between fixed bars",
        four_bar.GONZALEZ_VARIABLES,
        lambda v: four_bar.gonzalez(*all_bars(v)),
        tuple(component(*item) for item in GONZALEZ_CURVES.items()),
    )


def slider(p: Parameters) -> KnownDecomposition:
    """PT13 (15)."""
    lengths = slider_crank.LENGTHS

    def split(v: Values) -> tuple[Values, Values]:
        return v[::2], v[1::2]

    def point(s1: Any, s2: Any, c3: Any, c2: Any, c1: Any) -> list[Any]:
        return [c1, s1, c2, s2, c3, -2 * s1 - s2]

    roots = (
        ("c3", lambda s1, s2: 1 - (2 * s1 + s2) ** 2),
        ("c2", lambda s1, s2: 1 - s2**2),
        ("c1", lambda s1, s2: 1 - s1**2),
    )
    component = PaperComponent(
        "PT13 (15)",
        lambda v: slider_crank.equations(lengths, *split(v)),
        Parametrisation("s1 s2", point, roots),
    )
    return KnownDecomposition(
        "slider crank",
        tuple(f"{x}{i}" for i in (1, 2, 3) for x in "cs"),
        lambda v: slider_crank.equations(lengths, *split(v)),
        (component,),
    )
