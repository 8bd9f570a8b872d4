"""Planar four-bars with equal opposite sides, alone and in rows, PT13 sections 5.3 and 7.2."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

Values = Sequence[Any]

VARIABLES = tuple(f"{x}{i}" for i in range(4) for x in "cs")
TWO_VARIABLES = tuple(f"{x}{i}" for i in range(7) for x in "cs")
GONZALEZ_VARIABLES = tuple(f"{x}{i}" for i in (1, 2, 3, 5, 6) for x in "cs")


def circles(c: Values, s: Values, indices: Sequence[int]) -> list[Any]:
    """q_j = c_j^2 + s_j^2 - 1."""
    return [c[j] ** 2 + s[j] ** 2 - 1 for j in indices]


def loop(a: Any, b: Any, c: Values, s: Values) -> list[Any]:
    """p_1 and p_2 for bars in their order round the loop."""
    return [a * x[0] - b * x[1] - a * x[2] + b * x[3] for x in (c, s)]


def four_bar(a: Any, b: Any, c: Values, s: Values) -> list[Any]:
    """The ideal J: the loop equations and the four circles."""
    return [*loop(a, b, c, s), *circles(c, s, range(4))]


def parallelogram(c: Values, s: Values) -> list[Any]:
    """J_0, and hat J_0."""
    return [*circles(c, s, (0, 1)), s[2] - s[0], c[2] - c[0], s[3] - s[1], c[3] - c[1]]


def antiparallelogram(a: Any, b: Any, c: Values, s: Values) -> list[Any]:
    """J_1, for a and b that differ."""
    plus, minus = a**2 + b**2, a**2 - b**2
    return [
        *loop(a, b, c, s),
        *circles(c, s, (0, 1, 2)),
        2 * a * b * s[1] * (s[2] - s[0])
        + 2 * b**2 * s[1] ** 2
        - minus * (c[2] * c[0] - 1)
        - plus * s[2] * s[0],
        2 * a * b * (c[2] * s[1] - c[1] * s[0])
        + 2 * b**2 * c[1] * s[1]
        + minus * s[2] * c[0]
        - plus * c[2] * s[0],
        2 * a * b * (s[2] * c[1] - s[1] * c[0])
        + 2 * b**2 * c[1] * s[1]
        - plus * s[2] * c[0]
        + minus * c[2] * s[0],
        2 * a * b * c[1] * (c[2] - c[0])
        - 2 * b**2 * s[1] ** 2
        - plus * (c[2] * c[0] - 1)
        - minus * s[2] * s[0],
    ]


def folded_1(c: Values, s: Values, printed: bool = False) -> list[Any]:
    """hat J_1 of the rhombus: bars 0 and 3 opposite, and bars 1 and 2.

    ``printed``: with bars 2 and 3 exchanged.
    """
    i, k = (2, 3) if printed else (3, 2)
    return [*circles(c, s, (0, 1)), s[i] + s[0], c[i] + c[0], s[k] + s[1], c[k] + c[1]]


def folded_2(c: Values, s: Values) -> list[Any]:
    """hat J_2 of the rhombus: bars 0 and 1 alike, and bars 2 and 3."""
    return [*circles(c, s, (0, 2)), s[1] - s[0], c[1] - c[0], s[3] - s[2], c[3] - c[2]]


def rhombus(c: Values, s: Values) -> list[list[Any]]:
    """hat J_0, hat J_1 and hat J_2."""
    return [parallelogram(c, s), folded_1(c, s), folded_2(c, s)]


def second(x: Values) -> tuple[Any, ...]:
    """Entries of the bars of the second four-bar of (8), in the order of the first."""
    return (x[4], x[3], x[5], x[6])


def two_four_bars(a: Any, b: Any, c: Values, s: Values) -> list[Any]:
    """Equations (8) and (9): sides 1, b and a, b, bar 3 shared, bar 0 fixed."""
    return [
        c[0] - 1,
        s[0],
        *loop(1, b, c[:4], s[:4]),
        *loop(a, b, second(c), second(s)),
        *circles(c, s, range(7)),
    ]


def two_parallelograms(c: Values, s: Values) -> list[Any]:
    """Equation (11)."""
    return [
        c[0] - 1,
        s[0],
        *circles(c, s, (1,)),
        s[2],
        c[2] - 1,
        s[3] - s[1],
        c[3] - c[1],
        *circles(c, s, (4,)),
        s[5] - s[4],
        c[5] - c[4],
        s[6] - s[3],
        c[6] - c[3],
    ]


def gonzalez(c: Values, s: Values) -> list[Any]:
    """Two rhombi between fixed bars 0 and 4; c and s have entries for bars 0 to 6."""
    return [
        1 - c[1] - c[2] + c[3],
        -s[1] - s[2] + s[3],
        1 - c[3] - c[5] + c[6],
        -s[3] - s[5] + s[6],
        *circles(c, s, (1, 2, 3, 5, 6)),
    ]


def gonzalez_component(c: Values, s: Values) -> list[Any]:
    """The component hat I of section 7.2."""
    return [
        *circles(c, s, (1,)),
        s[2],
        c[2] - 1,
        s[3] - s[1],
        c[3] - c[1],
        s[5],
        c[5] - 1,
        s[6] - s[1],
        c[6] - c[1],
    ]
