"""Points of zero sets whose tangent and local dimensions are known."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from fractions import Fraction as F
from typing import Any

import numpy as np
from linkages import CASES, case, four_bar, loop
from singular_zeros import ISOLATED, ON_COMPONENTS, Zero, polynomials

from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.files.cases import read_case
from nag.mechanism.graph import Mechanism
from nag.mechanism.model import model


@dataclass(frozen=True, eq=False)
class Known:
    """A point, exact where its coordinates are, and what is true there.

    `multiplicity` is 0 where the point is not isolated.
    """

    system: PolynomialSystem
    point: tuple[Any, ...]
    tangent: int
    dimension: int
    multiplicity: int = 0

    def changed(self, rng: np.random.Generator) -> Known:
        """The same point in other coordinates, of combined equations; all of it exact."""
        at = np.array([_double(x) for x in self.point])
        zero = Zero(list(self.system.polynomials), at, self.multiplicity).changed(rng)
        system = PolynomialSystem(self.system.variables, tuple(zero.polynomials))
        return Known(system, tuple(zero.point), self.tangent, self.dimension, self.multiplicity)


def _double(x: Any) -> complex:
    return x if isinstance(x, complex) else complex(float(x))


def plain(equations: Sequence[Polynomial]) -> PolynomialSystem:
    return PolynomialSystem(tuple(f"x{i}" for i in range(equations[0].n)), tuple(equations))


def known(
    variables: str, equations: str, point: Sequence[Any], tangent: int, dimension: int, m: int = 0
) -> Known:
    system = plain(polynomials(variables, *equations.split(", ")))
    return Known(system, tuple(map(Fraction, point)), tangent, dimension, m)


def at_reference(mechanism: Mechanism, formulation: str, tangent: int, dimension: int) -> Known:
    made = model(mechanism, formulation)
    return Known(made.system, tuple(made.reference), tangent, dimension)


def framework(
    pins: dict[str, tuple], joints: dict[str, tuple], bars: Sequence[tuple[str, str]]
) -> tuple[PolynomialSystem, tuple[Fraction, ...]]:
    """Bars between pins and points of the plane; a point "A+B" is the middle of A and B."""
    names = [f"{c}{j}" for j in joints for c in "xy"]
    n = len(names)
    unknowns = Polynomial.variables(n)
    place = {p: [Polynomial.constant(n, Fraction(c)) for c in at] for p, at in pins.items()}
    for i, j in enumerate(joints):
        place[j] = [unknowns[2 * i], unknowns[2 * i + 1]]
    at = tuple(Fraction(c) for p in joints.values() for c in p)

    def located(name: str) -> list[Polynomial]:
        ends = [place[p] for p in name.split("+")]
        return [sum(cs[1:], cs[0]) / len(ends) for cs in zip(*ends, strict=True)]

    equations = []
    for a, b in bars:
        (x, y), (u, v) = located(a), located(b)
        square = (x - u) ** 2 + (y - v) ** 2
        equations.append(square - square(at))
    return PolynomialSystem(tuple(names), tuple(equations)), at


def double_watt(mirrored: bool) -> Known:
    """Two Watt linkages whose tracers are joined by a bar along the normal of their paths.

    Each tracer moves along the direction (-3, 4)/5 and leaves it in third order: with the paths
    h = k v^3 and h = -k v^3 (mirrored) the bar of length L asks (v - w)^2 = 2 k L (v^3 + w^3) and
    more, a cusp (Connelly & Servatius 1994); with equal paths the bar moves parallel to itself, or
    v + w is of second order: two curves that touch.
    """
    p, b = np.array([Fraction(-4, 5), Fraction(-1, 10)]), np.array([0, Fraction(1, 2)])
    along, apart = np.array([Fraction(4, 5), Fraction(3, 5)]), np.array([Fraction(4), Fraction(3)])

    def second(x: np.ndarray) -> tuple:
        image = x - 2 * (x @ along) * along if mirrored else x
        return tuple(image + apart)

    pins = {"P": tuple(p), "Q": tuple(-p), "R": second(p), "S": second(-p)}
    joints = {"A": tuple(b), "B": tuple(-b), "C": second(b), "D": second(-b)}
    bars = [("P", "A"), ("A", "B"), ("B", "Q"), ("R", "C"), ("C", "D"), ("D", "S"), ("A+B", "C+D")]
    system, at = framework(pins, joints, bars)
    return Known(system, at, 2, 1)


def prism(parallel: bool) -> Known:
    """Two triangles joined by three bars, one triangle fixed; the bars meet in a point or not."""
    pins = {"A": (0, 0), "B": (6, 0), "C": (3, 3)}
    joints = {"D": (1, -2), "E": (5, -3 if parallel else -2), "F": (3, -1)}
    if parallel:
        joints = {"D": (0, -2), "E": (6, -1), "F": (3, -2)}
    bars = [("A", "D"), ("B", "E"), ("C", "F"), ("D", "E"), ("E", "F"), ("F", "D")]
    system, at = framework(pins, joints, bars)
    return Known(system, at, 1, 0, 2)


def wunderlich(across: tuple[Fraction, Fraction], up: tuple[Fraction, Fraction]) -> Known:
    """Wunderlich's twelve bars as the edges of a cube, all faces parallelograms.

    Two angles are free. With all points on a line, sets of other faces turned over begin there,
    those of mobility 1 among them; with one kind of face flat, two of mobility 2.
    """
    base = (Fraction(3), Fraction(0))
    places = {"A": (0, 0), "B": base, "C": across, "E": up}
    for name, (first, second) in {"D": "BC", "F": "BE", "G": "CE", "H": "DE"}.items():
        a, b = places[first], places[second]
        places[name] = (a[0] + b[0], a[1] + b[1])
    bars = [
        tuple(bar)
        for bar in ["AB", "CD", "EF", "GH", "AC", "BD", "EG", "FH", "AE", "BF", "CG", "DH"]
    ]
    pins = {name: places.pop(name) for name in "AB"}
    system, at = framework(pins, places, bars)
    flat = [across[1] == 0, up[1] == 0]
    return Known(system, at, 6 if all(flat) else 3 if any(flat) else 2, 2)


def sarrus() -> Mechanism:
    points = [(0, 0, 0), (0, 1, 1), (0, 0, 2), (-3, 0, 2), (-4, 0, 1), (-3, 0, 0)]
    return loop(points, [(1, 0, 0)] * 3 + [(0, 1, 0)] * 3)


def _of_case(name: str) -> PolynomialSystem:
    system = read_case(CASES / f"{name}.toml").system
    assert system is not None
    return system


# A kite folded onto its ground bar: with s2 = s1 and c2 = c1 the short sides turn together; the
# other curve is the generic motion.
KITE = "2*c1 + c2 - c3 - 2, 2*s1 + s2 - s3, c1^2 + s1^2 - 1, c2^2 + s2^2 - 1, c3^2 + s3^2 - 1"

MECHANISMS = {
    "slider crank, s1 = -1": Known(_of_case("slider-crank"), (0, -1, 0, 1, 0, 1), 3, 2),
    "slider crank, s1 = 1": Known(_of_case("slider-crank"), (0, 1, 0, -1, 0, -1), 3, 2),
    "slider crank, a regular point": known(
        "c1 s1 c2 s2 c3 s3",
        "2*s1 + s2 + s3, c1^2 + s1^2 - 1, c2^2 + s2^2 - 1, c3^2 + s3^2 - 1",
        [1, 0, "3/5", "4/5", "-3/5", "-4/5"],
        2,
        2,
    ),
    "rhombus, stretched": Known(_of_case("rhombus"), (1, 0, 1, 0, 1, 0), 2, 1),
    "rhombus, folded": Known(_of_case("rhombus"), (-1, 0, 1, 0, -1, 0), 2, 1),
    "kite, folded": known("c1 s1 c2 s2 c3 s3", KITE, [1, 0, 1, 0, 1, 0], 2, 1),
    "parallelogram, stretched": at_reference(
        loop([(0, 0, 0), (1, 0, 0), (3, 0, 0), (2, 0, 0)], [(0, 0, 1)] * 4), "E", 2, 1
    ),
    "parallelogram": at_reference(four_bar(), "E", 1, 1),
    "Bennett, H": at_reference(case("bennett"), "H", 1, 1),
    "Bennett, E": at_reference(case("bennett"), "E", 1, 1),
    "Bricard's cube, H": at_reference(case("bricard-cube"), "H", 1, 1),
    "Bricard's cube, E": at_reference(case("bricard-cube"), "E", 1, 1),
    "Sarrus, H": at_reference(sarrus(), "H", 1, 1),
    "double Watt, cusp": double_watt(mirrored=True),
    "double Watt, two curves that touch": double_watt(mirrored=False),
    "Wunderlich, all on a line": wunderlich((F(2), F(0)), (F(1), F(0))),
    "Wunderlich, one face flat": wunderlich((F(2), F(0)), (F(-5, 13), F(12, 13))),
    "Wunderlich, regular": wunderlich((F(6, 5), F(8, 5)), (F(-5, 13), F(12, 13))),
    "a prism of parallel bars": prism(parallel=True),
    "a bar stretched between its pins": known(
        "x y", "x^2 + y^2 - 1, (x - 2)^2 + y^2 - 1", [1, 0], 1, 0, 2
    ),
}

# Sets that touch and meet; truths by hand.
SETS = {
    "curves that touch to order 12": known("x y", "(y - x^12)*y", [0, 0], 2, 1),
    "a line that touches a surface to order 12": known(
        "x y z", "(z - x^12)*y, (z - x^12)*z", [0, 0, 0], 3, 2
    ),
    "a double line that touches a conic": known(
        "x y z", "z*(y - x^2)^2, z*(z - y)", [0, 0, 0], 3, 2
    ),
    "a plane and a line": known("x y z", "x*z, y*z", [0, 0, 0], 3, 2),
    "a plane and a line, on the line": known("x y z", "x*z, y*z", [0, 0, 1], 1, 1),
    "two planes in a point": known("x y z w", "x*z, x*w, y*z, y*w", [0] * 4, 4, 2),
    "a plane through a double point": known(
        "x y z", "x^2*(x - 1), x*y*(x - 1), x*z*(x - 1)", [0, 0, 0], 3, 2
    ),
    "the handle of Whitney's umbrella": known("x y z", "x^2 - y^2*z", [0, 0, 1], 3, 2),
    "a cuspidal edge": known("x y z", "y^2 - x^3", [0, 0, 5], 3, 2),
    "a cone in four variables": known("x y z w", "x*w - y*z", [0] * 4, 4, 3),
    "the cone over the twisted cubic": known(
        "x y z w", "x*z - y^2, y*w - z^2, x*w - y*z", [0] * 4, 4, 2
    ),
    "four lines in space": known("x y z", "x*y*z, (x - y)*z, (x - y)*x*y", [0] * 3, 3, 1),
    "whole space": known("x y", "0*x", [0, 0], 2, 2),
    "a curve of higher multiplicity": known("x y z", "x^3, y^3, x*y", [0, 0, 2], 3, 1),
}

_SURFACES = ("Whitney's umbrella", "a plane with an embedded point")


def _known_zero(name: str, zero: Zero) -> Known:
    at = list(zero.point)
    jacobian = [[f.derivative(i)(at) for i in range(len(at))] for f in zero.polynomials]
    rank = np.linalg.matrix_rank(np.array(jacobian, dtype=complex), tol=1e-9)
    dimension = 0 if zero.multiplicity else 2 if name in _SURFACES else 1
    tangent = len(at) - int(rank)
    return Known(plain(zero.polynomials), tuple(at), tangent, dimension, zero.multiplicity)


ZEROS = {name: _known_zero(name, zero) for name, zero in (ISOLATED | ON_COMPONENTS).items()}
ALL = MECHANISMS | SETS | ZEROS
