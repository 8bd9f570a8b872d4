"""Decompositions of the founding papers' mechanisms satisfy the papers' own equations."""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from itertools import product

import numpy as np
import pytest
from solved import components_of

from nag.mechanism.model import Model, model
from nag.symbolic import bennett, bricard
from nag.witness.membership import components_through
from nag.witness.witness import Decomposition
from tests.linkages import case

M = (Fraction(7, 4), Fraction(5, 6), Fraction(1, 3))


@cache
def decomposed(name: str, formulation: str) -> tuple[Model, Decomposition]:
    chosen = model(case(name), formulation)
    return chosen, components_of(chosen.system)


def moving_bodies(chosen: Model, point: np.ndarray) -> list[np.ndarray]:
    """Euler parameters of the bodies B1, B2, .. at a solution, each up to its sign."""
    euler = chosen.lift(list(point)).euler
    return [np.array(euler[name], dtype=complex) for name in sorted(euler) if name != "B0"]


def signs(count: int) -> list[tuple[int, ...]]:
    return list(product((1, -1), repeat=count))


def bennett_residual(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> float:
    """How far the Euler parameters are from I_benn with (16), (18) and (19)."""
    m = tuple(float(x) for x in M)
    ideal = [*bennett.variety(m, a[0], a[2], c[0], c[2]), *bennett.g_4(m, a[0], c[0])]
    image = bennett.essential_to_all(m, a[0], a[2], c[0], c[2])
    return max(
        max(abs(complex(g)) for g in ideal),
        *(
            np.abs(np.array(w, dtype=complex) - v).max()
            for w, v in zip(image, (a, b, c), strict=True)
        ),
    )


def bricard_residual(bodies: list[np.ndarray]) -> float:
    """How far the Euler parameters are from I_bric with (10)."""
    a, _, c, *_ = bodies
    h = bricard.variety(a[0], a[2], c[2])
    image = bricard.essential_to_all(a[0], a[2], c[2])
    distances = [
        np.abs(np.array(w, dtype=complex) - v).max() for w, v in zip(image, bodies, strict=True)
    ]
    return max(*map(abs, h), *distances)


@pytest.mark.parametrize("formulation", ["H", "E"])
def test_witness_points_of_bennett_satisfy_the_papers_equations(formulation: str) -> None:
    chosen, answer = decomposed("bennett", formulation)
    assert answer.complete and answer.dimension == 1
    for component in answer.components:
        for point in component.points:
            bodies = moving_bodies(chosen, point)
            best = min(
                bennett_residual(*(s * v for s, v in zip(sign, bodies, strict=True)))
                for sign in signs(3)
            )
            assert best < 1e-10 * max(1, *(np.abs(v).max() ** 2 for v in bodies))


def test_witness_points_of_bricards_cube_satisfy_the_papers_equations() -> None:
    chosen, answer = decomposed("bricard-cube", "H")
    assert answer.complete and [c.dimension for c in answer.components] == [1]
    for point in answer.components[0].points:
        bodies = moving_bodies(chosen, point)
        best = min(
            bricard_residual([s * v for s, v in zip(sign, bodies, strict=True)])
            for sign in signs(5)
        )
        assert best < 1e-10 * max(1, *(np.abs(v).max() ** 2 for v in bodies))


def test_half_angles_and_euler_parameters_of_bennett_agree_signs_counted() -> None:
    """Each configuration has 2^3 sign choices in E, which its components share evenly."""
    half, half_answer = decomposed("bennett", "H")
    euler, euler_answer = decomposed("bennett", "E")
    assert len(half_answer.components) == 1
    hits = np.zeros(len(euler_answer.components), dtype=int)
    configuration = half.lift(list(half_answer.components[0].points[0]))
    point = np.array(euler.project(configuration), dtype=complex)
    for chosen in product((False, True), repeat=3):
        flips = [s.signs for s, used in zip(euler.symmetries, chosen, strict=True) if used]
        turned = point * np.prod([np.ones(len(point)), *flips], axis=0)
        for k in components_through(euler_answer, turned):
            hits[k] += 1
    assert hits.sum() == euler.sign_group == 8
    assert len(set(hits)) == 1
