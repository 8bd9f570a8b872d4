"""Linkages cut by a slice at once, and rigid ones solved, in isotropic coordinates."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from math import prod
from pathlib import Path

import numpy as np
import pytest
from linkages import kinds
from random_linkages import FLAT, Axes, random_linkage, random_planar_mechanism

from nag.algebra.evaluation import Evaluator
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.algebra.turns import looped_turns
from nag.cli.command_line import main
from nag.decomposition import several_equations
from nag.decomposition.decompose import decompose
from nag.decomposition.reduction import Reduction
from nag.decomposition.superset import Superset
from nag.decomposition.toric_section import paths_at_once, section_at_once, turns_to_cut
from nag.files.cases import read_case
from nag.mechanism.linkage import Link, Linkage, linkage_model
from nag.mechanism.model import model
from nag.solving import solve as solving
from nag.solving.solve import solve
from nag.solving.start.isotropic import IsotropicSection
from nag.solving.start.mixed_cells import mixed_cells
from nag.tracking.run import Run
from nag.witness.slices import random_rows
from nag.witness.witness import PathCounts

PLANAR = Path(__file__).parent.parent / "cases" / "planar"


def planar(name: str) -> PolynomialSystem:
    return read_case(PLANAR / f"{name}.toml").system


def at_once(system: PolynomialSystem, seed: int) -> tuple[Superset | None, PathCounts]:
    reduction, rng = Reduction.of(system, scaled=True), np.random.default_rng(seed)
    turns = turns_to_cut(reduction)
    if turns is None:
        return None, PathCounts()
    flag = random_rows(rng, reduction.n, reduction.n)
    return section_at_once(reduction, turns, flag, rng, Run())


def plate(name: str, pins: str, *places: tuple[int, int]) -> Link:
    shape = tuple((Fraction(x), Fraction(y)) for x, y in places)
    return Link(name, tuple(pins), shape)


# A kite folds so that coupler and rocker coincide; the rod and the arm, of one length and at one
# place of either, turn freely then.
FOLDING = Linkage(
    "base",
    (
        plate("base", "AD", (0, 0), (4, 0)),
        plate("crank", "AB", (0, 0), (4, 0)),
        plate("coupler", "BCH", (0, 0), (3, 0), (1, 1)),
        plate("rocker", "DCE", (0, 0), (3, 0), (1, 1)),
        plate("rod", "EF", (0, 0), (2, 0)),
        plate("arm", "FH", (0, 0), (2, 0)),
    ),
)


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize(("name", "degree"), [("watt-six-bar", 16), ("stephenson-six-bar", 18)])
def test_a_six_bar_takes_as_many_paths_as_its_degree(name: str, degree: int, seed: int) -> None:
    system = planar(name)
    found, counts = at_once(system, seed)
    assert found is not None
    assert counts.tracked == degree == paths_at_once(system)
    ((fibre,),) = found.fibres.values()
    reduced = Reduction.of(system, scaled=True).reduced
    assert fibre.dimension == 1
    assert len(fibre) == degree
    assert Evaluator.of(reduced.polynomials, reduced.n).residuals(fibre.x).max() < 1e-14
    on = fibre.rows[:, 0] + fibre.x @ fibre.rows[0, 1:]
    assert np.abs(on).max() < 1e-13 * np.abs(fibre.x).max()


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("loops", [2, 3])
def test_random_linkages_decompose_as_equation_by_equation(
    loops: int, seed: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    system = linkage_model(random_linkage(loops, seed)).system
    assert at_once(system, 0)[0] is not None
    at_once_answer = decompose(system)
    assert at_once_answer.method == "section_at_once"
    monkeypatch.setattr(several_equations, "section_at_once", lambda *_: (None, PathCounts()))
    other = decompose(system)
    assert other.method == "one_by_one" and kinds(other) == kinds(at_once_answer)


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("loops", [1, 2])
def test_a_rigid_linkage_has_the_assemblies_of_other_start_systems(loops: int, seed: int) -> None:
    system = linkage_model(random_linkage(loops, seed, rigid=True)).system
    found, other = solve(system), solve(system, start="total")
    assert found.complete
    assert other.complete
    assert "isotropic" in found.reason
    assert found.paths.tracked == len(found.solutions) < other.paths.tracked
    gaps = np.abs(found.points[:, None] - other.points[None]).max(axis=2)
    assert len(found.points) == len(other.points)
    assert gaps.min(axis=0).max() < 1e-9
    assert kinds(decompose(system)) == Counter({(0, 1, 1): len(found.solutions)})


def test_a_component_of_larger_dimension_is_not_missed() -> None:
    system = linkage_model(FOLDING).system
    assert looped_turns(system) is not None
    assert at_once(system, 0)[0] is None
    assert max(c.dimension for c in decompose(system).components) == 2


@pytest.mark.parametrize("name", ["roberts-seven-bar", "double-parallelogram"])
def test_a_linkage_that_moves_against_counting_is_not_taken_for_rigid(name: str) -> None:
    found, counts = at_once(planar(name), 0)
    assert found is None
    assert counts.tracked == paths_at_once(planar(name))
    assert solve(planar(name)).positive_dimensional


@pytest.mark.parametrize("name", ["burmester-focal", "four-bar"])
def test_more_equations_than_variables_and_single_loops_are_left_to_others(name: str) -> None:
    assert at_once(planar(name), 0) == (None, PathCounts())
    assert paths_at_once(planar(name)) is None


def test_what_must_not_vanish_is_left_to_others() -> None:
    system = planar("watt-six-bar")
    c = Polynomial.variable(system.n, 0)
    excluding = PolynomialSystem(system.variables, system.polynomials, (c,))
    assert at_once(excluding, 0) == (None, PathCounts())


@pytest.mark.parametrize("own", [{0: 3, 1: 3}, dict.fromkeys(range(1, 10, 2), 2)])
def test_circles_may_have_other_radii_and_equal_ratios_of_axes(own: dict[int, int]) -> None:
    system = planar("watt-six-bar")
    scaled = []
    for f in system.polynomials:
        sizes = [prod(own.get(i, 1) ** k for i, k in enumerate(e)) for e in f.terms]
        terms = {e: v / size for (e, v), size in zip(f.terms.items(), sizes, strict=True)}
        scaled.append(Polynomial(system.n, terms))
    changed = PolynomialSystem(system.variables, tuple(scaled))
    assert at_once(changed, 0)[0] is not None
    assert kinds(decompose(changed)) == Counter({(1, 16, 1): 1})


@pytest.mark.parametrize("size", [Fraction(1, 10**12), Fraction(10**12)])
def test_the_unit_of_length_does_not_matter(size: Fraction) -> None:
    system = linkage_model(random_linkage(4, 1)).system
    other = tuple(f if f.degree > 1 else f * size for f in system.polynomials)
    found, counts = at_once(PolynomialSystem(system.variables, other), 0)
    assert found is not None
    assert counts.tracked == paths_at_once(system)


@pytest.mark.parametrize("name", ["watt-six-bar", "assur-triad"])
def test_cells_of_the_torus_are_those_of_all_isotropic_coordinates(name: str) -> None:
    turns = looped_turns(planar(name))
    assert turns is not None
    rng = np.random.default_rng(0)
    slices = rng.standard_normal((turns.freedoms, 1 + 2 * len(turns.pairs))) + 0j
    section = IsotropicSection(turns, slices)
    cells = section.cells(rng)
    assert cells.mixed_volume == mixed_cells(section.target.supports, rng).mixed_volume
    ends = [s[cells.edges[:, i]] for i, s in enumerate(cells.supports)]
    vectors = np.stack([e[:, 1] - e[:, 0] for e in ends], axis=1)
    assert np.array_equal(np.rint(np.abs(np.linalg.det(vectors))), cells.volumes)


def test_zeros_that_are_not_found_all_leave_the_choice_to_others(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    system = planar("assur-triad")
    monkeypatch.setattr(IsotropicSection, "zeros", lambda *_: (None, 6))
    found = solve(system)
    assert found.complete
    assert "isotropic" not in found.reason
    monkeypatch.setattr(solving, "isotropic", lambda *_: None)
    assert np.array_equal(found.points, solve(system).points)


def test_the_paths_that_a_linkage_takes_at_once_are_printed(
    capsys: pytest.CaptureFixture[str],
) -> None:
    for name, said in (("watt-six-bar", True), ("burmester-focal", False)):
        assert main(["model", str(PLANAR / f"{name}.toml")]) == 0
        printed = capsys.readouterr().out
        assert ("16 paths to a slice at once" in printed) is said
        assert ("equation by equation, at most 62" in printed) is said


# Across (1, 1, 0) lengths along the two axes of the plane count differently, by a root of 2.
TILTED = ((1, -1, 0), (0, 0, 1), (1, 1, 0))


@pytest.mark.parametrize("axes", [FLAT, TILTED])
@pytest.mark.parametrize("seed", range(3))
def test_a_placed_linkage_of_several_loops_is_cut_at_once(seed: int, axes: Axes) -> None:
    mechanism = random_planar_mechanism(2, seed, axes)
    made = model(mechanism)
    assert (made.space, made.formulation) == ("planar", "E")
    assert f"at once {paths_at_once(made.system)}" in made.reason
    assert at_once(made.system, 0)[0] is not None
    assert not any(f(made.reference) for f in made.system.polynomials)
    (component,) = decompose(made.system).components
    other = decompose(model(mechanism, "H").system)
    assert [c.dimension for c in other.components] == [component.dimension] == [1]
    lifted = made.lift(component.points[0])
    unreduced = made.unreduced
    point = np.array(made.unreduced_point(lifted))
    assert Evaluator.of(unreduced.polynomials, unreduced.n).residuals(point[None]).max() < 1e-13


def test_the_paths_that_a_mechanism_takes_at_once_count_in_the_choice() -> None:
    made = model(random_planar_mechanism(3, 0))
    first, second = made.alternatives[:2]
    assert (first.formulation, second.formulation) == ("E", "H")
    assert first.paths == first.at_once == 54 < second.paths
    assert second.at_once is None
