"""Mechanisms that several tests use."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path

import numpy as np

from nag.algebra.system import PolynomialSystem
from nag.files.cases import read_case
from nag.mechanism.graph import Body, Joint, Mechanism
from nag.witness.witness import Decomposition

CASES = Path(__file__).parent.parent / "cases"


def exact(*values: int | str | Fraction) -> tuple[Fraction, ...]:
    return tuple(Fraction(v) for v in values)


def kinds(answer: Decomposition) -> Counter[tuple[int, int, int]]:
    """How many components there are of each dimension, degree and multiplicity."""
    assert answer.complete
    counts: Counter[tuple[int, int, int]] = Counter()
    for c in answer.components:
        counts[c.dimension, c.degree, c.multiplicity] += c.orbit
    return counts


def loop(points: list, axes: list, orientations: dict | None = None) -> Mechanism:
    """A single loop B0, B1, ...: joint J_l joins B_{l-1} and B_l."""
    n = len(points)
    joints = [
        Joint(f"J{i}", "revolute", (f"B{(i - 1) % n}", f"B{i}"), exact(*p), exact(*a))
        for i, (p, a) in enumerate(zip(points, axes, strict=True))
    ]
    frames = orientations or {}
    bodies = [Body(f"B{i}", frames.get(f"B{i}")) for i in range(1, n)]
    return Mechanism("B0", tuple(joints), tuple(bodies))


def case(name: str) -> Mechanism:
    mechanism = read_case(CASES / f"{name}.toml").mechanism
    assert mechanism is not None
    return mechanism


def general_loop(joints: int, seed: int) -> Mechanism:
    """Axes with random small integer directions through random small integer points."""
    rng = np.random.default_rng(seed)
    points = [tuple(int(x) for x in rng.integers(-5, 6, 3)) for _ in range(joints)]
    axes = []
    while len(axes) < joints:
        axis = tuple(int(x) for x in rng.integers(-4, 5, 3))
        if any(axis):
            axes.append(axis)
    return loop(points, axes)


def four_bar(axis: tuple = (0, 0, 1), across: tuple = ((1, 0, 0), (0, 1, 0))) -> Mechanism:
    """Parallelogram with sides 2 and 1 times the vectors ``across``."""
    u, v = across
    corners = [(0, 0), (2, 0), (2, 1), (0, 1)]
    points = [tuple(x * a + y * b for a, b in zip(u, v, strict=True)) for x, y in corners]
    return loop(points, [axis] * 4)


def spherical_four_bar() -> Mechanism:
    axes = [(0, 0, 1), (1, 0, 2), (1, 1, 1), (0, 2, 1)]
    return loop([(1, 2, 3)] * 4, axes)


def newton(system: PolynomialSystem, start: np.ndarray, normals: np.ndarray) -> np.ndarray | None:
    """A solution in the linear space through ``start`` with ``normals`` as rows, or None."""
    point = start.astype(complex)
    for _ in range(60):
        at = list(point)
        matrix = np.array([[g(at) for g in row] for row in system.jacobian], dtype=complex)
        values = np.array(system(at), dtype=complex)
        matrix = np.vstack([matrix, normals])
        values = np.append(values, normals @ (point - start))
        step = np.linalg.lstsq(matrix, -values, rcond=None)[0]
        point = point + step
        if not np.linalg.norm(point) < 1e2:
            return None
        if np.linalg.norm(step) < 1e-13 * np.linalg.norm(point):
            return point if residual(system, point) < 1e-13 else None
    return None


def residual(system: PolynomialSystem, point: Sequence[complex]) -> float:
    """Largest value at a point, relative to the size of its terms where that is over 1."""
    size = [abs(x) for x in point]
    worst = 0.0
    for f in system.polynomials:
        terms = sum(
            abs(float(c)) * np.prod([s**k for s, k in zip(size, e, strict=True)])
            for e, c in f.terms.items()
        )
        worst = max(worst, abs(f(list(point))) / max(terms, 1.0))
    return worst


def closed_chain(*joints: tuple) -> Mechanism:
    """A single loop of joints (type, point) or (type, point, axis, ...), as `loop` names them."""
    n = len(joints)
    return Mechanism(
        "B0",
        tuple(
            Joint(f"J{i}", kind, (f"B{(i - 1) % n}", f"B{i}"), *(exact(*v) for v in vectors))
            for i, (kind, *vectors) in enumerate(joints)
        ),
    )


def loops_of_all_joints() -> dict[str, Mechanism]:
    """Single loops in which every type of joint occurs, in general position."""
    z = (0, 0, 1)
    revolutes = (
        ("revolute", (1, 0, 0), (0, 1, 2)),
        ("revolute", (1, 2, 0), (1, 1, 1)),
        ("revolute", (0, 3, 1), (2, -1, 0)),
    )
    return {
        "slider-crank": closed_chain(
            *(("revolute", p, z) for p in ((0, 0, 0), (1, 1, 0), (3, 0, 0))),
            ("prismatic", (0, 0, 0), (1, 0, 0)),
        ),
        "PPPP": closed_chain(
            *(("prismatic", (0, 0, 0), a) for a in ((1, 0, 0), (0, 1, 0), (1, 1, 0), (1, 2, 0)))
        ),
        "RUR": closed_chain(
            ("revolute", (0, 0, 0), z),
            ("universal", (0, 0, 0), (0, 1, 0), (1, 0, 0)),
            ("revolute", (0, 0, 0), (2, 3, 1)),
        ),
        "RCCC": closed_chain(
            ("revolute", (0, 0, 0), z), *(("cylindrical", *r[1:]) for r in revolutes)
        ),
        "RSSR": closed_chain(
            ("revolute", (0, 0, 0), z),
            ("spherical", (1, 0, 0)),
            ("spherical", (1, 2, 1)),
            revolutes[2],
        ),
        "ECRR": closed_chain(
            ("planar", (0, 0, 0), z), ("cylindrical", *revolutes[0][1:]), *revolutes[1:]
        ),
        "four-bar": closed_chain(
            ("revolute", (0, 0, 0), z),
            ("rigid", (0, 0, 0)),
            *(("revolute", p, z) for p in ((0, 1, 0), (2, 1, 0), (2, 0, 0))),
        ),
    }
