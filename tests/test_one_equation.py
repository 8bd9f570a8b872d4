"""One equation that exact algebra leaves is decomposed without paths, as algebra says."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

import nag
from nag.decomposition.decompose import decompose
from nag.decomposition.through import Through, through_points
from nag.files.cases import read_case
from nag.mechanism.model import model
from nag.mechanism.problem import problem_of

CASES = Path(__file__).parent.parent / "cases"

# Irreducible over the rationals; degrees of the factors over the complex numbers.
CONJUGATES = [
    ("x^2 - 2*y^2", [1, 1]),
    ("(x + y)^2 + 1", [1, 1]),
    ("(x^2 + y)^2 + (x*y - 1)^2", [2, 2]),
    ("x^6 - 2*(y^2 + x + 3)^3", [2, 2, 2]),
    ("(x^3 + y + 1)^4 - 10*(x^3 + y + 1)^2*(x*y + 2)^2 + (x*y + 2)^4", [3, 3, 3, 3]),
    ("(x^2 + y*z + 1)^2 - 2*(x*y + z)^2", [2, 2]),
    ("x^4 + y^4 - 10*x^2*y^2 + 1", [4]),
    ("x*y - 1/10^20", [2]),
    ("x^2 + y^2 - z^2 - 3*w + 1", [2]),
]


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(("text", "degrees"), CONJUGATES)
def test_conjugate_factors_are_told_apart_without_paths(
    text: str, degrees: list[int], seed: int
) -> None:
    answer = nag.decompose([text], seed=seed)
    assert answer.complete and answer.paths.tracked == 0
    assert [c.degree for c in answer.components] == degrees
    assert {c.dimension for c in answer.components} == {answer.system.n - 1}
    assert max(c.residual for c in answer.components) < 1e-14


def test_points_of_a_conjugate_factor_are_points_of_one_line() -> None:
    ratios = [
        complex(c.points[0, 0] / c.points[0, 1]) for c in nag.decompose(["x^2 - 2*y^2"]).components
    ]
    assert np.allclose(sorted(z.real for z in ratios), [-(2**0.5), 2**0.5], rtol=1e-14)
    assert max(abs(z.imag) for z in ratios) < 1e-14


@pytest.mark.parametrize(
    ("name", "multidegree"),
    [
        ("bennett", [1, 1]),
        ("spatial/bennett-isogram-equilateral", [1, 1]),
        ("spatial/planar-four-bar", [2, 2]),
        ("spherical/four-bar", [2, 2]),
    ],
)
def test_loops_whose_equations_collapse_need_no_path(name: str, multidegree: list[int]) -> None:
    case = read_case(CASES / f"{name}.toml")
    answer = decompose(problem_of(case).system)
    assert answer.complete and answer.paths.tracked == 0
    (component,) = answer.components
    assert component.multidegree.tolist() == multidegree
    assert component.degree == sum(multidegree)


def test_what_must_not_vanish_takes_its_factor_away() -> None:
    made = model(read_case(CASES / "bennett.toml").mechanism)
    (f,) = made.system.polynomials
    answer = decompose(replace(made.system, nonzero=(f * 3,)))
    assert answer.complete and answer.components == ()


def test_a_component_without_paths_can_be_moved() -> None:
    curve = nag.decompose(["(x^2 + y)^2 + (x*y - 1)^2"]).components[0]
    points = curve.sample(0, 5)
    x, y = points.T
    either = np.minimum(abs(x**2 + y + 1j * (x * y - 1)), abs(x**2 + y - 1j * (x * y - 1)))
    assert either.max() < 1e-12 * (1 + abs(points).max() ** 2)
    assert all(curve.contains(p) for p in points)


def test_a_zero_is_on_the_only_component_without_a_path(monkeypatch) -> None:
    def moved(*_: object) -> None:
        raise AssertionError("a path was tracked")

    monkeypatch.setattr("nag.witness.membership.is_member", moved)
    answer = nag.decompose("x^2 + y^2 - 1")
    points = [
        ("on it", (Fraction(3, 5), Fraction(4, 5))),
        ("beside it", (Fraction(1), Fraction(1))),
    ]
    assert through_points(answer, points) == [
        Through("on it", True, (0,)),
        Through("beside it", False),
    ]


def test_a_rounded_zero_is_on_the_components_that_the_zero_is_on() -> None:
    answer = nag.decompose(["x^2 + y^2 - 1", "(x - y)*(x + 2*y - 1)"])
    root = Fraction("0.7071067811865476")
    points = [("rounded", (root, root)), ("off", (root, root + Fraction(1, 10**6)))]
    rounded, off = through_points(answer, points)
    assert rounded.solution and not rounded.doubt and not off.solution
    (index,) = rounded.components
    assert np.allclose(answer.components[index].points, float(root))


def test_a_zero_on_what_is_excluded_need_not_be_on_the_only_component() -> None:
    system = nag.system("x*(x^2 + y^2 - 1)")
    answer = decompose(replace(system, nonzero=nag.system("x", "x y").polynomials))
    assert len(answer.components) == 1 and answer.paths.tracked == 0
    places = [(Fraction(0), Fraction(5)), (Fraction(0), Fraction(1)), (Fraction(1), Fraction(0))]
    found = through_points(answer, [(str(at), at) for at in places])
    assert [one.components for one in found] == [(), (0,), (0,)]
