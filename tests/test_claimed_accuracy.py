"""No result claims more digits than are right, against zeros proved to 100 digits."""

from __future__ import annotations

from pathlib import Path

import flint
import numpy as np
import pytest

from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.bench.atlas.families import FAMILIES
from nag.bench.reference import Reference
from nag.decomposition import decompose
from nag.files.cases import read_case
from nag.numerics.certified_points import CertifiedPoints
from nag.numerics.singular_point import analyse
from nag.solving.certificate import certify_solutions
from nag.solving.solve import solve
from nag.witness.certificate import certify_decomposition

CASES = Path(__file__).parents[1] / "cases"
FAMILY = {f.name: f for f in FAMILIES}


def errors(reference: Reference, points: np.ndarray) -> np.ndarray:
    """Distances from the proved zeros, relative to one and the zeros' norms."""
    off = np.linalg.norm((points - reference.high) - reference.low, axis=1)
    return off / (1 + np.linalg.norm(reference.high, axis=1))


def within(reference: Reference, proved: CertifiedPoints) -> bool:
    """Whether no point is further from its zero than the certificate says."""
    off = reference.errors(proved.points, np.arange(len(proved.points)))
    return bool((off <= proved.errors() * (1 + 1e-9)).all())


def family_system(name: str, value: int) -> PolynomialSystem:
    return FAMILY[name].make(value, np.random.default_rng(0)).system


SOLVED = [
    *((f"cases/{n}", None) for n in ("benchmarks/cyclic-5", "hard/chemequ")),
    ("cluster-3", 8),
    ("cluster-2", 4),
    ("tangent", 8),
    ("dependent", 8),
    ("far", 30),
    ("far-beside", 12),
    ("sizes", 12),
    ("wilkinson", 20),
    ("unity", 30),
]


@pytest.mark.parametrize(("name", "value"), SOLVED, ids=str)
def test_solutions_are_as_accurate_as_they_say(name: str, value: int | None) -> None:
    if value is None:
        system = read_case(CASES.parent / f"{name}.toml").system
    else:
        system = family_system(name, value)
    result = solve(system)
    assert result.solutions
    none = np.zeros((0, 1 + system.n), dtype=complex)
    reference = Reference.of(system, result.points, none)
    claimed = np.array([s.accuracy for s in result.solutions])
    assert (errors(reference, result.points) <= claimed).all()
    assert within(reference, certify_solutions(result).points)


DECOMPOSED = [
    *((n, None) for n in ("four-bar", "rhombus", "slider-crank", "literature/whitney-umbrella")),
    *(("lengths", k) for k in (1, 2, 4, -4)),
    *(("kite", k) for k in (2, 8)),
    *(("hyperbola", k) for k in (2, 8)),
    ("touching", 4),
]


@pytest.mark.parametrize(("name", "value"), DECOMPOSED, ids=str)
def test_witness_points_are_as_accurate_as_they_say(name: str, value: int | None) -> None:
    if value is None:
        system = read_case(CASES / f"{name}.toml").system
    else:
        system = family_system(name, value)
    answer = decompose(system)
    assert answer.components
    certificate = certify_decomposition(answer)
    for component, proved in zip(answer.components, certificate.components, strict=True):
        reference = Reference.of(system, component.points, component.slice.rows)
        assert (errors(reference, component.points) <= component.accuracy).all()
        assert within(reference, proved.points)


def test_a_singular_zero_has_the_hundred_digits_that_it_shows() -> None:
    x, y = Polynomial.variables(2)
    end = analyse(
        [(x - y) ** 3, x**2 + y**2 - 3], np.array([1.5**0.5] * 2), 1e-9, np.random.default_rng(0)
    )
    with flint.ctx.workdps(130):
        exact = (flint.arb(3) / 2).sqrt()
        for re, im in end.digits:
            assert abs(flint.arb(re) - exact) < flint.arb(10) ** -99
            assert abs(flint.arb(im)) < flint.arb(10) ** -99
        off = np.abs([float(flint.arb(float(z.real)) - exact) for z in end.point]).max()
    assert off <= end.accuracy * 1.5**0.5
