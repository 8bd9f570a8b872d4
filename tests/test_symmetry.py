"""Signed permutations of variables: a group, its action, and which of them keep a system."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nag.algebra.expression import parse_polynomial
from nag.algebra.polynomial import Polynomial
from nag.algebra.symmetry import (
    SignedPermutation,
    SymmetryError,
    check_symmetry,
    find_symmetries,
    first_outside_span,
)
from nag.algebra.system import PolynomialSystem
from nag.files.cases import CaseError, read_case

NAMES = ("x", "y", "z", "w")


def system(*equations: str, **more) -> PolynomialSystem:
    return PolynomialSystem(NAMES, [parse_polynomial(e, NAMES) for e in equations], **more)


@st.composite
def symmetries(draw: st.DrawFn) -> SignedPermutation:
    sources = draw(st.permutations(range(4)))
    return SignedPermutation(tuple(sources), tuple(draw(st.sampled_from([1, -1])) for _ in NAMES))


points = st.lists(st.fractions(-5, 5, max_denominator=7), min_size=4, max_size=4)


@given(symmetries(), symmetries(), points)
def test_products_and_inverses_act_as_maps_do(g, h, point) -> None:
    assert g.after(h).of_point(point) == g.of_point(h.of_point(point))
    assert g.inverse.of_point(g.of_point(point)) == point
    assert g.after(g.inverse).is_identity


@given(symmetries(), points)
def test_a_polynomial_is_composed_with_the_map(g, point) -> None:
    f = parse_polynomial("x^3*y - 2*y^2*z + w - 5*x*z*w + 1/3", NAMES)
    assert g.of_polynomial(f)(point) == f(g.of_point(point))


@given(symmetries(), points)
def test_arrays_and_exact_points_are_carried_alike(g, point) -> None:
    array = np.array([float(x) for x in point])
    assert g.of_point(array).tolist() == [float(x) for x in g.of_point(point)]


@given(symmetries())
def test_text_reads_back(g) -> None:
    assert SignedPermutation.of_map(g.text(NAMES), NAMES) == g


SWAP = {"x": "y", "y": "x"}


@pytest.mark.parametrize(
    ("equations", "images"),
    [
        (["x^2 + y^2 - 1"], SWAP),
        (["x^2 - y^2"], SWAP),
        (["x^2 - y^2 + z", "z"], {"x": "-y", "y": "x"}),
        (["x + z", "y + z"], SWAP),
        (["2*x + 3*y - z", "3*x + 2*y - z"], SWAP),
        (["x - 1", "x*y^2 - z", "y^2 - w"], {"z": "w", "w": "z"}),
        (["x*y - z*w", "x^2 + z^2"], {"x": "z", "z": "x", "y": "w", "w": "y"}),
        (["x^2 - sqrt(2)", "y^2 - sqrt(2)"], SWAP),
        (["0", "x*y"], SWAP),
        ([], SWAP),
    ],
)
def test_symmetries_of_the_ideal_are_recognised(equations, images) -> None:
    check_symmetry(system(*equations), SignedPermutation.of_map(images, NAMES))


@pytest.mark.parametrize(
    ("equations", "images"),
    [
        (["x^2 + 2*y^2 - 1"], SWAP),
        (["x"], SWAP),
        (["x + 1"], {"x": "-x"}),
        (["x^2 + y", "z"], {"y": "-y"}),
        (["x^2 - sqrt(2)", "y^2 - sqrt(3)"], SWAP),
        (["1 + x*y", "x^3"], {"z": "w", "w": "-x", "x": "z"}),
    ],
)
def test_other_maps_are_refused(equations, images) -> None:
    with pytest.raises(SymmetryError, match="does not become a combination"):
        check_symmetry(system(*equations), SignedPermutation.of_map(images, NAMES))


@pytest.mark.parametrize(
    ("polynomials", "place"),
    [
        (["x*z", "x + y", "z"], 2),
        (["sqrt(2)*x + y", "x", "sqrt(2)"], 2),
        (["z", "cos(1)"], 0),
        (["x", "cos(1)"], 1),
        (["y - x", "w"], 1),
        (["x", "y"], None),
    ],
)
def test_the_first_polynomial_outside_is_named(polynomials, place) -> None:
    equations = system("x", "y", "z*w").polynomials
    assert first_outside_span(system(*polynomials).polynomials, equations) == place


def test_conditions_and_groups_must_be_kept() -> None:
    swap = SignedPermutation.of_map(SWAP, NAMES)
    keeps = parse_polynomial("x - y", NAMES)
    check_symmetry(system("x*y", nonzero=(keeps,)), swap)
    with pytest.raises(SymmetryError, match="must not vanish"):
        check_symmetry(system("x*y", nonzero=(parse_polynomial("x - 1", NAMES),)), swap)
    check_symmetry(system("x*y", groups=((0, 1), (2, 3))), swap)
    with pytest.raises(SymmetryError, match="group of x"):
        check_symmetry(system("x*y", groups=((0, 2), (1, 3))), swap)


def generated(maps: Sequence[SignedPermutation], n: int) -> set[SignedPermutation]:
    """The group that some maps generate."""
    group = new = {SignedPermutation.identity(n)}
    while new:
        new = {g.after(h) for g in maps for h in new} - group
        group = group | new
    return group


@given(
    symmetries(),
    st.lists(
        st.tuples(st.tuples(*[st.integers(0, 3)] * 4), st.integers(-3, 3)), min_size=1, max_size=4
    ),
)
def test_the_symmetries_of_what_one_carries_a_polynomial_to_are_found(g, terms) -> None:
    f, images = Polynomial(4, dict(terms)), []
    for h in generated([g], 4):
        image = h.of_polynomial(f)
        # Which sign a polynomial has says nothing.
        images += [image] if image not in images and -image not in images else []
    own = PolynomialSystem(NAMES, images)
    found = find_symmetries(own)
    assert g in generated(found, 4)
    for h in found:
        check_symmetry(own, h)


@pytest.mark.parametrize(
    ("equations", "order"),
    [
        # Those that carry single equations to themselves, up to signs.
        (["x + 2*y + 3*z + 5*w - 1"], 1),
        (["x + 2*y + 3*z + 5*w"], 2),
        (["x^2 + 2*y^2 + 3*z^2 + 5*w^2 - 1"], 16),
        (["x + y + z + w - 1"], 24),
        (["x*y*z*w - 1"], 24 * 8),
        (["x*y + z*w - 1"], 8 * 4),
        (["x^3 + y^3 - 3*x*y", "z - x", "w - y"], 2),
        # Turning and reading backwards; their products with the change of all signs.
        (["x + y + z + w", "x*y + y*z + z*w + w*x", "x*y*z + y*z*w + z*w*x + w*x*y"], 16),
    ],
)
def test_groups_of_symmetries_are_found_whole(equations, order) -> None:
    assert len(generated(find_symmetries(system(*equations)), 4)) == order


def test_found_symmetries_keep_conditions_groups_and_the_unit() -> None:
    all_of, swap = ("x + y + z + w - 1",), SignedPermutation.of_map(SWAP, NAMES)
    keeps, not_so = (parse_polynomial(text, NAMES) for text in ("x - y", "x - 2*y"))
    for more, order in (
        ({"nonzero": (keeps,)}, 4),
        ({"nonzero": (not_so,)}, 2),
        ({"groups": ((0, 1), (2, 3))}, 4),
        ({"groups": ((0, 1, 2), (3,))}, 6),
    ):
        group = generated(find_symmetries(system(*all_of, **more)), 4)
        assert len(group) == order
        assert (swap in group) == (order != 2)
    unit = PolynomialSystem(
        ("x", "y", "I"),
        [parse_polynomial(e, ("x", "y", "I")) for e in ("x^2 + y^2 - 1", "x + y - I", "I^2 + 1")],
        imaginary=True,
    )
    assert generated(find_symmetries(unit), 3) == {
        SignedPermutation.identity(3),
        SignedPermutation((1, 0, 2), (1, 1, 1)),
        SignedPermutation((0, 1, 2), (-1, -1, -1)),
        SignedPermutation((1, 0, 2), (-1, -1, -1)),
    }


def test_declared_symmetries_are_among_those_that_are_found() -> None:
    folder = Path(__file__).parent.parent / "cases" / "benchmarks"
    for name in ("rhombus-chain-4.toml", "cyclic-8.toml"):
        case = read_case(folder / name)
        found = generated(find_symmetries(case.system), case.system.n)
        assert case.symmetries and set(case.symmetries) <= found


CASE = """
title = "Two circles"
kind = "system"
variables = ["x", "y"]
equations = ["(x - 2)^2 + y^2 - 1", "x*y - {a}"]
[[symmetry]]
map = {map}
"""


@pytest.mark.parametrize(
    ("images", "message"),
    [
        ('{ x = "-x" }', "[[symmetry]] 1: map: is no symmetry: equation 1 does not become"),
        ('{ x = "y" }', "[[symmetry]] 1: map: x is no image; each variable must be the image"),
        ('{ x = "u" }', "[[symmetry]] 1: map: unknown variable 'u'"),
        ('{ u = "x" }', "[[symmetry]] 1: map: unknown variable 'u'"),
        ('{ x = "x*y" }', "[[symmetry]] 1: map: 'x*y' is no variable; write a name"),
        ('{ x = "" }', "[[symmetry]] 1: map: '' is no variable; write a name"),
        ("{ x = 1 }", "[[symmetry]] 1: map: 'x' is a whole number; write { variable"),
        ('"x"', "[[symmetry]] 1: map: is a text; write { variable"),
    ],
)
def test_a_wrong_symmetry_in_a_case_is_refused_in_one_line(images, message, tmp_path) -> None:
    path = tmp_path / "case.toml"
    path.write_text(CASE.replace("{map}", images).replace("{a}", "1"))
    with pytest.raises(CaseError) as raised:
        read_case(path)
    assert message in str(raised.value)
    assert "\n" not in str(raised.value)


def test_a_right_symmetry_in_a_case_is_read(tmp_path) -> None:
    path = tmp_path / "case.toml"
    path.write_text(CASE.replace("{map}", '{ y = "-y" }').replace("{a}", "0"))
    assert read_case(path).symmetries == (SignedPermutation((0, 1), (1, -1)),)


def test_declared_symmetries_of_all_cases_hold() -> None:
    folder = Path(__file__).parent.parent / "cases"
    declared = list(map(read_case, sorted(folder.rglob("rhombus-chain-*.toml"))))
    assert declared and all(c.symmetries for c in declared)
    point = [Fraction(i, 7) for i in range(declared[0].system.n)]
    for g in declared[0].symmetries:
        values = [f(g.of_point(point)) for f in declared[0].system.polynomials]
        assert sorted(map(abs, values)) == sorted(map(abs, declared[0].system(point)))
