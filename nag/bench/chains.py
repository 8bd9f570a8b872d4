"""Mechanisms and systems of n cells, and what is known of them: for how cost grows with n.

Mechanisms are at an exact reference configuration.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import comb
from types import MappingProxyType

from nag.algebra.expression import parse_polynomial
from nag.algebra.system import PolynomialSystem
from nag.files.cases import Truth
from nag.mechanism.axes import difference
from nag.mechanism.graph import Joint, Mechanism
from nag.mechanism.model import model
from nag.mechanism.quaternion import Quaternion, multiply, norm_squared, rotate

Vector = tuple[Fraction, Fraction, Fraction]
Line = tuple[Vector, Vector]

Z: Vector = (Fraction(0), Fraction(0), Fraction(1))
# A Bennett linkage: lines of its joints, axes of unit length.
BENNETT: tuple[Line, ...] = tuple(
    (tuple(map(Fraction, point)), tuple(map(Fraction, axis)))  # type: ignore[misc]
    for point, axis in (
        (("0", "0", "0"), ("0", "0", "1")),
        (("1", "0", "0"), ("0", "-56/65", "33/65")),
        (
            ("5463/6893", "3960/6893", "6720/6893"),
            ("6720/6893", "91896/448045", "38797/448045"),
        ),
        (("2730/3277", "2600/3277", "0"), ("2240/3277", "-2352/3277", "-15/113")),
    )
)
# Two Bennett linkages with a link in common, which is left out with one of its joints: Goldberg's.
GOLDBERG: tuple[Line, ...] = tuple(
    (tuple(map(Fraction, point)), tuple(map(Fraction, axis)))  # type: ignore[misc]
    for point, axis in (
        (("0", "0", "0"), ("0", "0", "1")),
        (("84/145", "16/29", "0"), ("16/29", "-84/145", "3/5")),
        (("597/3145", "64/629", "-48/629"), ("80/629", "-171/629", "600/629")),
        (
            ("97041/267325", "-16704/53465", "-58128/267325"),
            ("-85872/267325", "-22617/53465", "226496/267325"),
        ),
        (
            ("-204743/908905", "206976/908905", "-155232/908905"),
            ("51744/181781", "41741/181781", "169188/181781"),
        ),
    )
)
# The cosine and the sine of half a turn of no special angle, up to scale.
ASIDE = Fraction(5), Fraction(2)


def four_bars(n: int) -> Mechanism:
    """n four-bars in a row in the plane, the output of each the input of the next.

    All cranks turn about the ground; the couplers' lengths are no two alike.
    """
    bars = [(Fraction(3 * i), Fraction(0), Fraction(0)) for i in range(n + 1)]
    # Tangents of half the cranks' angles, rational points of circles of radii near 1.
    tips = []
    for i, (x, _, _) in enumerate(bars):
        t, radius = Fraction(i + 2, i + 3), 1 + Fraction(i % 5, 7)
        c, s = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
        tips.append((x + radius * c, radius * s, Fraction(0)))
    return _cranks(bars, tips)


def parallelograms(n: int) -> Mechanism:
    """The same with cranks of one length and direction, all of which turn alike or fold."""
    bars = [(Fraction(3 * i), Fraction(0), Fraction(0)) for i in range(n + 1)]
    tips = [(x + Fraction(3, 5), Fraction(4, 5), Fraction(0)) for x, _, _ in bars]
    return _cranks(bars, tips)


def _cranks(bars: Sequence[Vector], tips: Sequence[Vector]) -> Mechanism:
    joints = []
    for i, (foot, tip) in enumerate(zip(bars, tips, strict=True)):
        joints.append(Joint(f"A{i}", "revolute", ("ground", f"crank{i}"), foot, Z))
        if i:
            before = f"crank{i - 1}"
            joints.append(Joint(f"B{i}", "revolute", (before, f"coupler{i}"), tips[i - 1], Z))
            joints.append(Joint(f"C{i}", "revolute", (f"coupler{i}", f"crank{i}"), tip, Z))
    return Mechanism("ground", tuple(joints))


def bennett_loops(n: int) -> Mechanism:
    """n Bennett linkages in a row; a cell has two links and the joint between them of the next.

    Every cell is the same linkage, so placed that its first axis is the third of the cell before.
    """
    cell = BENNETT
    bodies = ("base", "x0", "y0", "z0")
    joints = ring(0, cell, bodies, 0)
    for i in range(1, n):
        cell = attach_cell(BENNETT, cell[2])
        bodies = (bodies[2], f"x{i}", f"y{i}", bodies[1])
        joints += ring(i, cell, bodies, 1)
    return Mechanism("base", tuple(joints))


def goldberg_loops(n: int) -> Mechanism:
    """n Goldberg 5R linkages in a row, the first joint of each the fourth of the one before."""
    cell = GOLDBERG
    bodies = ("base", "w0", "x0", "y0", "z0")
    joints = ring(0, cell, bodies, 0)
    for i in range(1, n):
        cell = attach_cell(GOLDBERG, cell[3])
        bodies = (bodies[3], f"w{i}", f"x{i}", f"y{i}", bodies[2])
        joints += ring(i, cell, bodies, 1)
    return Mechanism("base", tuple(joints))


def scissors(n: int) -> Mechanism:
    """A lattice that unfolds: n + 1 pairs of crossed bars, n parallelograms between them.

    Bars of two lengths cross in their middles, and neighbouring pairs are joined at their ends.
    """
    first = Fraction(4, 5), Fraction(3, 5), Fraction(0)
    second = Fraction(18, 13), Fraction(-15, 26), Fraction(0)

    def point(i: int, j: int) -> Vector:
        x, y, z = (i * a + j * b for a, b in zip(first, second, strict=True))
        return x, y, z

    joints = []
    for i in range(n + 1):
        joints.append(Joint(f"M{i}", "revolute", (f"U{i}", f"V{i}"), point(i, i), Z))
        if i:
            top, bottom = (f"U{i - 1}", f"V{i}"), (f"V{i - 1}", f"U{i}")
            joints.append(Joint(f"T{i}", "revolute", top, point(i, i - 1), Z))
            joints.append(Joint(f"B{i}", "revolute", bottom, point(i - 1, i), Z))
    return Mechanism("U0", tuple(joints))


def ring(number: int, cell: Sequence[Line], bodies: Sequence[str], first: int) -> tuple[Joint, ...]:
    """The joints of a closed chain from the ``first`` on; ``cell[i]`` leads to ``bodies[i]``."""
    return tuple(
        Joint(f"J{number}_{i}", "revolute", (bodies[i - 1], bodies[i]), *cell[i])
        for i in range(first, len(cell))
    )


def attach_cell(cell: Sequence[Line], onto: Line) -> tuple[Line, ...]:
    """The cell moved so that its first line is ``onto``, both of unit direction."""
    (start, along), (end, other) = cell[0], onto
    half_turn = (Fraction(0), *(x + y for x, y in zip(along, other, strict=True)))
    aside = (ASIDE[0], *(ASIDE[1] * x for x in other))
    turn = multiply(aside, half_turn)
    return tuple(
        (
            tuple(x + y for x, y in zip(_turn(turn, difference(p, start)), end, strict=True)),
            _turn(turn, axis),
        )
        for p, axis in cell
    )  # type: ignore[return-value]


def _turn(turn: Quaternion, vector: Sequence[Fraction]) -> Vector:
    squared = norm_squared(turn)
    return tuple(x / squared for x in rotate(turn, vector))  # type: ignore[return-value]


def polygons(n: int) -> Mechanism:
    """A closed chain of n + 3 bars in the plane, which has n freedoms."""
    corners: list[Vector] = []
    for i in range(n + 3):
        t = Fraction(2 * i + 1 - n - 2, 3)
        radius = 1 + Fraction(i % 3, 5)
        corners.append(
            (radius * (1 - t * t) / (1 + t * t), radius * 2 * t / (1 + t * t), Fraction(0))
        )
    bodies = ["ground", *(f"bar{i}" for i in range(1, n + 3))]
    return Mechanism("ground", ring(0, [(c, Z) for c in corners], bodies, 0))


def rhombus_chain(k: int) -> PolynomialSystem:
    """A chain of k rhombi, each sharing a bar with the next (PT13 eq. 8 and 9 continued)."""
    names = tuple(f"{x}{i}" for i in range(3 * k + 1) for x in "cs")
    equations = ["c0 - 1", "s0"]
    for r in range(k):
        bars = (0, 1, 2, 3) if r == 0 else (3 * r + 1, 3 * r, 3 * r + 2, 3 * r + 3)
        equations += ["{0}{1} - {0}{2} - {0}{3} + {0}{4}".format(x, *bars) for x in "cs"]
    equations += [f"c{i}^2 + s{i}^2 - 1" for i in range(3 * k + 1)]
    return PolynomialSystem(names, tuple(parse_polynomial(e, names) for e in equations))


@dataclass(frozen=True)
class Chain:
    """What has n cells, for any n from 1.

    Attributes:
        make: the mechanism, or the system, of n cells.
        truth: what is known of its components.
        longest: the number of cells to which it is decomposed unless more are asked for.
        most: and at most.
    """

    make: Callable[[int], Mechanism | PolynomialSystem]
    truth: Callable[[int], tuple[Truth, ...]]
    longest: int
    most: int


def _of_rhombi(k: int) -> tuple[Truth, ...]:
    # Each rhombus pairs its bars off in 3 ways with one bar free to turn: products of k circles.
    return (Truth(dimension=k, degree=2**k, count=3**k),)


def _of_four_bars(n: int) -> tuple[Truth, ...]:
    # Of each crank c + is has 2^n poles, as each cell is of bidegree (2, 2), half of them in common
    # with the next crank's: (n + 1) 2^n - n 2^(n-1) in all. As many has c - is.
    return (Truth(dimension=1, degree=(n + 2) * 2**n, formulation="E"),)


def _of_parallelograms(n: int) -> tuple[Truth, ...]:
    # Each cell is a parallelogram or folds.
    return tuple(
        Truth(dimension=1, degree=2 + 2 * k, count=comb(n, k), formulation="E")
        for k in range(n + 1)
    )


def _of_bennett_loops(n: int) -> tuple[Truth, ...]:
    # Each half-angle is a linear fraction of each other one.
    return (Truth(dimension=1, degree=max(2 * n - 1, 2), formulation="H"),)


def _of_goldberg_loops(n: int) -> tuple[Truth, ...]:
    # Half-angles are linear fractions of one of them, also from cell to cell; those of the third
    # joint of each cell, where two Bennett linkages turn together, are of degree 2.
    kept = model(goldberg_loops(n), formulation="H").system.variables
    degree = sum(2 if name.endswith("_2") else 1 for name in kept)
    return (Truth(dimension=1, degree=degree, formulation="H"),)


def _of_scissors(n: int) -> tuple[Truth, ...]:
    # Each parallelogram may fold. With c + is = v for the bar that crosses the first one, all bars
    # stay parallel to these, or some go with D = v (a - b v) / (a v - b), others with D / v, as a
    # second fold undoes the first: zeros and poles of v, and of D at two more places.
    unfolded = Truth(dimension=1, degree=2, formulation="E")
    return (unfolded, Truth(dimension=1, degree=4, count=2**n - 1, formulation="E"))


def _of_polygons(n: int) -> tuple[Truth, ...]:
    # n + 2 circles and two linear equations, which meet twice at infinity.
    return (Truth(dimension=n, degree=2 ** (n + 2) - 2, formulation="E"),)


CHAINS: Mapping[str, Chain] = MappingProxyType(
    {
        "rhombi": Chain(rhombus_chain, _of_rhombi, 4, 6),
        "four-bars": Chain(four_bars, _of_four_bars, 6, 12),
        "parallelograms": Chain(parallelograms, _of_parallelograms, 5, 12),
        "bennett-loops": Chain(bennett_loops, _of_bennett_loops, 6, 12),
        "goldberg-loops": Chain(goldberg_loops, _of_goldberg_loops, 3, 6),
        "scissors": Chain(scissors, _of_scissors, 5, 8),
        "polygons": Chain(polygons, _of_polygons, 5, 12),
    }
)
