"""The exact zero sets that scripts compare answers with are right where they are known."""

from __future__ import annotations

import shutil
from collections import Counter

import numpy as np
import pytest
from exact_counts import zero_set
from random_small import DEGENERATIONS, far_coordinates, far_system, small_system
from singular_counts import standard_zero_set
from systems import system

from nag.algebra.expression import parse_polynomial
from nag.bench.atlas.changes import FAR_COORDINATES
from nag.bench.atlas.curves import FAMILIES as CURVES
from nag.bench.atlas.points import FAMILIES as POINTS
from nag.bench.verdicts import ZeroSet

needs_singular = pytest.mark.skipif(
    shutil.which("Singular") is None, reason="Singular is not installed"
)


@pytest.mark.parametrize(
    ("equations", "components"),
    [
        (["x - 1", "x - 2"], {}),
        (["5"], {}),
        (["0"], {(2, 1, 1): 1}),
        (["x^2 + y^2 - 1", "x - y"], {(0, 1, 1): 2}),
        (["y - x^2", "y"], {(0, 1, 2): 1}),
        (["x*y + x^3 + y^3", "x^2 + y^3/10^6"], {(0, 1, 5): 1, (0, 1, 1): 4}),
        (["-2*x*y^3 - 2*x^2 + 3*y - 1/500", "-2*y - 3/100000*y^4"], {(0, 1, 1): 8}),
        (["(x - 1)*(x - 1 - 1/10^25)", "y^2 - x"], {(0, 1, 1): 4}),
        (["x^2 + y^2"], {(1, 1, 1): 2}),
        (["x*y - 1/10^20"], {(1, 2, 1): 1}),
        (["(x^2 + y^2 - 1)^2 - 2/10^20"], {(1, 2, 1): 2}),
        (["x*(x - 1)", "x^2*(y - 3)"], {(1, 1, 1): 1, (0, 1, 1): 1}),
        # The zero of the cofactors at the origin lies on the curve, the other one does not.
        (["x^2*(y - x)", "x*y*(x - 2)"], {(1, 1, 1): 1, (0, 1, 1): 1}),
        (["(x^2 + y^2)^3*(x - 2)^2", "(x^2 + y^2)^2*(y - 3)"], {(1, 1, 2): 2, (0, 1, 2): 1}),
        (["(x - y)*(x - 2)*(y - 3)", "(x - y)*(x - 2)*(x - 1)"], {(1, 1, 1): 2, (0, 1, 1): 1}),
    ],
)  # fmt: skip
def test_zero_sets_in_the_plane(
    equations: list[str], components: dict[tuple[int, int, int], int]
) -> None:
    found = zero_set(system("x y", *equations))
    assert found == ZeroSet.of(Counter(components))


def test_zeros_on_the_line_are_those_of_the_common_divisor() -> None:
    found = zero_set(system("x", "(x - 1)^3*(x^2 + 1)*x", "(x - 1)^2*(x^2 + 1)*(x - 5)"))
    assert found is not None
    assert found.components == Counter({(0, 1, 2): 1, (0, 1, 1): 2})


@pytest.mark.parametrize(
    ("polynomial", "factors"),
    [
        ("x^3 - 5", 3),
        ("y^2 + 1", 2),
        ("x^4 - 2*y^4", 4),
        ("x^4 + y^4 + 1", 1),
        ("(x + y)^2 - 2*(x*y + 1)^2", 2),
        ("x^2*y - y^3 + x + 7", 1),
    ],
)
def test_factors_over_the_complex_numbers_are_counted(polynomial: str, factors: int) -> None:
    f = parse_polynomial(polynomial, ("x", "y"))
    found = zero_set(system("x y", polynomial))
    assert found is not None
    assert found.components == Counter({(1, f.degree // factors, 1): factors})


def test_a_mere_sum_of_degrees_agrees_with_any_components_of_that_sum() -> None:
    known = ZeroSet(Counter({1: 3}), Counter({(1, 1): 4}))
    assert known.agrees(Counter({(0, 1, 1): 3, (1, 1, 1): 2, (1, 2, 1): 1}))
    assert not known.agrees(Counter({(0, 1, 1): 3, (1, 1, 2): 2}))
    assert not known.agrees(Counter({(0, 1, 1): 2, (1, 4, 1): 1}))


@needs_singular
@pytest.mark.parametrize(
    ("equations", "points", "degrees"),
    [
        (["x*(x - 1)", "x*(y - 2)^2", "x*(z^2 - 2)"], {2: 2}, {(2, 1): 1}),
        (["x*z", "x^2*(y - 3)*z", "x*(y - 2)*(z - 1)"], {}, {(2, 1): 1, (1, 1): 1}),
        (["x^2", "x*y", "x*z"], {}, {(2, 1): 1}),
        (["x^2", "x*y", "x*z - 1"], {}, {}),
        (["x^3 + y^2 + z^2 - 1", "x^2 + y^3 + z^2 - 1", "x^2 + y^2 + z^3 - 1"], {1: 15, 4: 3}, {}),
        (["(x^2 + y^2 - 1)^2", "z^2"], {}, {(1, 4): 2}),
    ],
)
def test_zero_sets_in_space(
    equations: list[str], points: dict[int, int], degrees: dict[tuple[int, int], int]
) -> None:
    found = zero_set(system("x y z", *equations))
    assert found is not None
    assert (found.points, found.degrees) == (Counter(points), Counter(degrees))


IN_THE_PLANE = [k for k in range(100) if small_system(3, k).system.n == 2]


@needs_singular
def test_primes_are_of_no_special_form() -> None:
    # Modulo 2^29 - 3 the first polynomial has a double root.
    quartic = system("x y z", "64*x^4 - x^3 + 72", "y^3", "z + x*y")
    assert standard_zero_set(3, quartic.polynomials).components == {(0, 1, 3): 4}


@pytest.mark.parametrize("number", IN_THE_PLANE)
def test_resultants_and_standard_bases_agree(number: int) -> None:
    system = small_system(3, number).system
    by_bases, by_resultants = standard_zero_set(2, system.polynomials), zero_set(system)
    assert by_bases is not None and by_resultants is not None
    assert (by_bases.points, by_bases.degrees) == (by_resultants.points, by_resultants.degrees)


@pytest.mark.parametrize("family", sorted(POINTS | CURVES))
def test_families_have_the_components_that_they_are_said_to_have(family: str) -> None:
    make, values = (POINTS | CURVES)[family]
    for value in values[:2]:
        problem = make(value, np.random.default_rng(1))
        found = zero_set(problem.system)
        assert found is not None and found.agrees(problem.truth)


def test_a_tenth_of_the_random_systems_is_degenerate_and_all_are_what_is_asked_for() -> None:
    kinds: Counter[str] = Counter()
    for number in range(300):
        small = small_system(0, number)
        kinds[small.kind] += 1
        assert small == small_system(0, number)
        assert 2 <= small.system.n == len(small.system.polynomials) <= 4
        assert max(small.system.degrees) <= 5
    assert set(kinds) == {"general", *DEGENERATIONS}
    assert 15 <= 300 - kinds["general"] <= 45


def test_systems_in_far_coordinates_have_the_zeros_of_the_plain_ones() -> None:
    kinds = set()
    for number in IN_THE_PLANE[:20]:
        plain, far = small_system(3, number), far_system(3, number)
        assert far == far_system(3, number)
        assert zero_set(far.system) == zero_set(plain.system)
        kinds.add(far_coordinates(3, number)[0])
    assert kinds == set(FAR_COORDINATES)
