"""Orbits: one component of each is worked out, and the answer is the same as without symmetry."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from solved import components_of
from systems import system

import nag
from nag.algebra.evaluation import Evaluator
from nag.algebra.symmetry import SignedPermutation, SymmetryError
from nag.decomposition.decompose import decompose
from nag.decomposition.monodromy import locate_points
from nag.decomposition.orbits import Action, irreducible_orbits
from nag.decomposition.superset import witness_superset
from nag.files.cases import read_case
from nag.files.export import read_decomposition, write_decomposition
from nag.report.agreement import AgreementKind, compare
from nag.tracking.run import Run
from nag.witness.fibres import whole_space
from nag.witness.frame import Frame, expand_orbits
from nag.witness.points import Points
from nag.witness.shown import kinds
from nag.witness.slices import random_rows

CASES = Path(__file__).parent.parent / "cases"


def symmetry(variables: str, **images: str) -> SignedPermutation:
    return SignedPermutation.of_map(images, tuple(variables.split()))


def orbit_sizes(answer) -> list[tuple[int, int, int]]:
    return sorted((c.dimension, c.degree, c.orbit) for c in answer.components)


@pytest.mark.parametrize(
    ("seed", "name"),
    [
        (0, "rhombus-chain-2"),
        (1, "rhombus-chain-2"),
        (0, "rhombus-chain-3"),
        (0, "literature/adjacent-minors-2x6"),
        (1, "literature/adjacent-minors-2x6"),
    ],
)
def test_cases_with_symmetries_agree_with_what_is_known(seed: int, name: str) -> None:
    case = read_case(CASES / f"{name}.toml")
    answer = components_of(case.system, tuple(case.symmetries), seed=seed)
    assert answer.complete
    assert len(answer.components) < sum(c.orbit for c in answer.components)
    for each in (answer, expand_orbits(answer)):
        agreement = compare(each, case.truth)
        assert agreement is not None and agreement.verdict is AgreementKind.AGREES
        assert not agreement.unlisted
    plain = components_of(case.system, seed=seed)
    assert kinds(answer.components) == kinds(plain.components)
    # Each symmetry costs a path for each component.
    spent = len(plain.components) * len(case.symmetries)
    assert answer.paths.tracked == plain.paths.tracked + spent


def test_orbits_are_those_of_the_group() -> None:
    # Bars 1 and 2 may change places, and -4, 5 and -6: the orbits of 3 pairings are 2 + 1 and 3.
    case = read_case(CASES / "rhombus-chain-2.toml")
    answer = decompose(case.system, seed=4, symmetries=case.symmetries)
    assert orbit_sizes(answer) == [(2, 4, 3), (2, 4, 6)]


def test_expanded_components_are_different_components_of_the_system() -> None:
    case = read_case(CASES / "rhombus-chain-2.toml")
    answer = decompose(case.system, seed=2, symmetries=case.symmetries)
    everything = expand_orbits(answer).components
    assert [c.orbit for c in everything] == [1] * 9
    # The components are the zero sets of different pairs of linear forms: c_i = +-c_j.
    forms = set()
    for component in everything:
        x = component.points
        assert np.abs(x @ component.slice.A.T - component.slice.b).max() < 1e-10
        values = Evaluator.of(case.system.polynomials, case.system.n).residuals(x)
        assert values.max() < 1e-12
        c = x[:, ::2]
        forms.add(
            frozenset(
                (i, j, sign)
                for i in range(7)
                for j in range(i)
                for sign in (1, -1)
                if np.abs(c[:, i] - sign * c[:, j]).max() < 1e-9
            )
        )
    assert len(forms) == 9


def test_points_curves_and_surfaces_in_orbits() -> None:
    sphere = "(x^2 + y^2 + z^2 - 9)"
    equations = [f"{sphere}*(x^2 - 1)", f"{sphere}*(y^2 - 1)*(x^2 - 4)", f"{sphere}*(y^2 - 1)*z"]
    signs = [symmetry("x y z", **{v: f"-{v}"}) for v in "xyz"]
    answer = decompose(system("x y z", *equations), seed=0, symmetries=signs)
    assert answer.complete
    # x = +-1 and y = +-1: four lines in one orbit; and the sphere.
    assert orbit_sizes(answer) == [(1, 1, 4), (2, 2, 1)]
    points = decompose(
        system("x y z", "x^2 - 1", "y^2 - 4", "z^2 - 9"), seed=0, symmetries=[*signs[:2]]
    )
    assert orbit_sizes(points) == [(0, 1, 4), (0, 1, 4)]


def test_multiplicities_hold_for_the_whole_orbit() -> None:
    swap = symmetry("x y z", x="y", y="x")
    answer = decompose(system("x y z", "x^2*y^2*z"), seed=1, symmetries=[swap])
    assert sorted((c.multiplicity, c.orbit) for c in answer.components) == [(1, 1), (2, 2)]
    assert kinds(expand_orbits(answer).components) == kinds(answer.components)


def test_a_symmetry_of_a_single_component_is_no_orbit() -> None:
    turn = symmetry("x y z", x="-y", y="x")
    answer = decompose(system("x y z", "x^2 + y^2 - z"), seed=0, symmetries=[turn])
    assert orbit_sizes(answer) == [(2, 2, 1)]
    identity = symmetry("x y z")
    answer = decompose(system("x y z", "x*y"), seed=0, symmetries=[identity])
    assert orbit_sizes(answer) == [(2, 1, 1), (2, 1, 1)]


def test_linear_equations_are_solved_before_symmetries_act() -> None:
    # z = 1 - x - y is eliminated; the three variables are exchanged by the group all the same.
    cycle = symmetry("x y z", x="y", y="z", z="x")
    answer = decompose(system("x y z", "x + y + z - 1", "x*y*z"), seed=5, symmetries=[cycle])
    assert orbit_sizes(answer) == [(1, 1, 3)]


def test_a_map_that_is_no_symmetry_is_refused() -> None:
    with pytest.raises(SymmetryError, match="equation 2"):
        decompose(system("x y", "x*y", "x - 1"), symmetries=[symmetry("x y", x="y", y="x")])


def test_exports_hold_the_orbits_and_read_back(tmp_path) -> None:
    case = read_case(CASES / "rhombus-chain-2.toml")
    answer = decompose(case.system, seed=0, symmetries=case.symmetries)
    write_decomposition(answer, tmp_path / "export.json")
    again = read_decomposition(tmp_path / "export.json")
    assert again == answer
    assert expand_orbits(again) == expand_orbits(answer)


def test_orbits_are_the_same_for_any_number_of_threads() -> None:
    case = read_case(CASES / "rhombus-chain-2.toml")
    one, two = (
        decompose(case.system, seed=7, threads=n, symmetries=case.symmetries) for n in (1, 2)
    )
    assert one == two


def test_a_missing_point_is_noticed() -> None:
    swap = symmetry("x y", x="y", y="x")
    equations = system("x y", "(x^2 - 2)*(y^2 - 2)").polynomials
    rng, tracker = np.random.default_rng(0), Run()
    flag = random_rows(rng, 2, 2)
    fibres = witness_superset(equations, {2: [whole_space(flag)]}, rng, tracker).fibres[1]
    action = Action.of(swap, Frame(np.eye(2), np.zeros(2), (0, 1), np.ones(2)))
    points = Points.of(fibres)
    found = irreducible_orbits(points, [action], 20, rng, tracker)
    assert [len(o.carriers) for o in found.classes] == [1, 1] and not found.notes
    (fibre,) = fibres
    less = Points.of([fibre.only(np.arange(4) > 0)])
    found = irreducible_orbits(less, [action], 20, rng, tracker)
    assert [len(o.carriers) for o in found.classes] == [0, 0, 0]
    assert found.notes == ("1 images of points under a symmetry are not among the points",)


def test_ends_are_located_only_where_that_is_clear() -> None:
    points = np.array([[0.0], [1.0]])
    assert locate_points(np.array([[1 + 1e-9], [5.0]]), points).tolist() == [1, -1]
    assert locate_points(np.array([[1e-5]]), points) is None
    assert locate_points(np.array([[1e-8]]), np.array([[0.0], [3e-8]])) is None


def test_ends_are_located_among_many_points_as_among_few() -> None:
    rng = np.random.default_rng(4)
    parts = rng.normal(size=(2, 400, 3)) * rng.lognormal(sigma=3, size=(400, 1))
    points, chosen = parts[0] + 1j * parts[1], rng.permutation(400)[:200]
    ends = np.vstack([points[chosen] * (1 + 1e-12), 1.1 * points[:5]])
    assert locate_points(ends, points).tolist() == [*chosen.tolist(), *[-1] * 5]
    size = 1 + np.linalg.norm(points[7])
    for error, apart in ((1e-8, 3e-8), (1e-5, 1.0), (3e-7, 1e-4)):
        beside = np.vstack([points, points[7] + np.array([apart * size, 0, 0])])
        off = points[7] + np.array([0, 1j * error * size, 0])
        assert locate_points(np.vstack([ends, off]), beside) is None
        assert locate_points(off[None], points[:5]).tolist() == [-1]


def test_numbers_of_components_mean_the_same_everywhere() -> None:
    pentagon = {"A": (0, 0), "B": (3, 0), "C": (4, 2), "D": ("3/2", 4), "E": (-1, 2)}
    found = nag.decompose(nag.Framework.of(pentagon, ["AB", "BC", "CD", "DE", "EA", "AC", "AD"]))
    assert len(found.components) == 4 and len(found) == 8 == len(list(found))
    assert found.to_dataframe()["number"].tolist() == list(range(1, 9))
    assert found.to_dataframe()["orbit"].tolist() == [2] * 8
    assert found.rows()[1][0] == "1-8"
    for number, component in enumerate(found, 1):
        own = nag.sample(found, number, count=1).points[0]
        assert np.allclose(own, component.points[0]) and np.allclose(own, found[number - 1].points)
    with pytest.raises(nag.NagError, match="there are components 1 to 8"):
        nag.sample(found, 9)
