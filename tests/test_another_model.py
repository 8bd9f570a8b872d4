"""Linkages and frameworks in two formulations: what corresponds, and what the check can see."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from linkages import CASES
from solved import components_of

import nag
from nag.cli import main
from nag.mechanism.framework import Framework, placed_framework
from nag.mechanism.framework_model import framework_model
from nag.mechanism.linkage import Link, Linkage, LinkageModel, linkage_model, pin_model
from nag.mechanism.other_equations import other_equations
from nag.mechanism.problem import problem_of
from nag.mechanism.real_assemblies import of_real_assemblies

F = Fraction


def turn(t: Fraction) -> tuple[Fraction, Fraction]:
    """A rational point of the circle."""
    return (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)


def assembled_linkage(
    plates: dict[str, tuple[str, ...]], ground: str, seed: int
) -> tuple[LinkageModel, dict[str, tuple[Fraction, Fraction]], list[Fraction]]:
    """Links through random rational places, each in a frame of its own; places and turns."""
    rng = np.random.default_rng(seed)
    pins = sorted({p for own in plates.values() for p in own})
    places = {p: tuple(F(int(k), 7) for k in rng.integers(-30, 31, 2)) for p in pins}
    turns, links = {}, []
    for name, own in plates.items():
        c, s = (F(1), F(0)) if name == ground else turn(F(int(rng.integers(1, 9)), 5))
        turns[name] = (c, s)
        shape = tuple((c * x + s * y, c * y - s * x) for x, y in (places[p] for p in own))
        links.append(Link(name, own, shape))
    made = linkage_model(Linkage(ground, tuple(links)))
    point = [t for link in made.in_loops[1:] for t in turns[link.name]]
    return made, places, point


STEPHENSON = {
    "ground": ("A", "B"),
    "crank": ("A", "C"),
    "plate": ("C", "D", "E"),
    "rocker": ("D", "B", "G"),
    "upper": ("E", "H"),
    "last": ("H", "G"),
}


@pytest.mark.parametrize("seed", range(5))
def test_turns_and_pins_are_the_same_assembly_exactly(seed: int) -> None:
    made, places, point = assembled_linkage(STEPHENSON, "ground", seed)
    assert not any(made.system(point))
    pins = pin_model(made)
    at = pins.places_at(point)
    assert at == tuple(x for p in pins.pins for x in places[p])
    assert not any(pins.system(at))
    assert pins.pin_places(at) == made.pin_places(point)


def test_the_mirror_image_of_a_plate_is_no_assembly() -> None:
    triangle = (Link("g", ("A", "B"), ((F(0), F(0)), (F(4), F(0)))),)
    plate = Link("p", ("A", "B", "C"), ((F(0), F(0)), (F(4), F(0)), (F(1), F(2))))
    bar = Link("b", ("C", "D"), ((F(0), F(0)), (F(1), F(0))))
    last = Link("l", ("D", "A"), ((F(0), F(0)), (F(2), F(0))))
    system = pin_model(linkage_model(Linkage("g", (*triangle, plate, bar, last)))).system
    names = system.variables
    upper, lower = ({"x_C": F(1), "y_C": y} for y in (F(2), F(-2)))
    shape = [f for f in system.polynomials if f.degree == 1 and f.support]
    assert shape
    for there, fits in ((upper, True), (lower, False)):
        point = [there.get(name, F(0)) for name in names]
        assert (not any(f(point) for f in shape)) is fits


@pytest.mark.parametrize(
    "name", ["double-parallelogram", "watt-six-bar", "stephenson-six-bar", "burmester-focal"]
)
def test_pins_and_turns_have_components_of_the_same_degrees(name: str) -> None:
    parts = nag.read_case(CASES / "planar" / f"{name}.toml").assembly
    other = next(other_equations(problem_of(parts)))
    assert other.alike == "degrees"
    kinds = [
        Counter((c.dimension, c.degree) for c in components_of(p.system).components)
        for p in (parts, other.problem.parts)
    ]
    assert kinds[0] == kinds[1]


def test_a_rigid_linkage_is_looked_at_for_spoiled_motions_in_both() -> None:
    parts = nag.read_case(CASES / "planar" / "assur-triad.toml").assembly
    reports = [nag.mobility(p) for p in (parts, pin_model(parts))]
    assert [(r.local_dimension, r.hint) for r in reports] == [(0, "")] * 2
    assert reports[0].same_motion(reports[1], "degrees")


def test_another_triangle_in_space_has_as_many_components() -> None:
    parts = nag.read_case(CASES / "spatial" / "octahedron-plane-symmetric.toml").assembly
    other = next(other_equations(problem_of(parts)))
    assert set(other.problem.parts.pinned) != set(parts.pinned)
    assert not any(other.problem.system(other.problem.reference))
    reports = [nag.mobility(p) for p in (parts, other.problem.parts)]
    assert reports[0].same_motion(reports[1], "counts")


def test_the_check_sees_other_components() -> None:
    report = nag.mobility(nag.read_case(CASES / "planar" / "henneberg-6.toml").assembly)
    fewer = replace(report, components=report.components[1:])
    assert fewer.same_motion(report) and not fewer.same_motion(report, "counts")
    higher = replace(report, components=((0, 2), *report.components[1:]))
    assert higher.same_motion(report, "counts") and not higher.same_motion(report, "degrees")


def test_links_that_hang_on_one_pin_add_their_turns(tmp_path, capsys) -> None:
    plates = {**STEPHENSON, "tail": ("H", "T")}
    made, _, _ = assembled_linkage(plates, "ground", 3)
    report = nag.mobility(made)
    assert (report.gruebler_kutzbach, report.local_dimension, report.free) == (2, 2, 1)
    assert report.same_motion(nag.mobility(pin_model(made)), "degrees")


def test_bars_that_meet_are_pinned_where_space_has_one_triangle_only(tmp_path, capsys) -> None:
    places = {"A": (0, 0, 0), "B": (1, 0, 0), "C": (0, 1, 0), "D": (1, 1, 1), "E": (2, 0, 2)}
    bars = [("A", "B"), ("A", "C"), ("B", "C"), ("C", "D"), ("D", "E"), ("E", "B")]
    exact = {name: tuple(map(F, place)) for name, place in places.items()}
    parts = framework_model(placed_framework(3, exact, bars))
    other = next(other_equations(problem_of(parts)))
    assert not any(other.problem.system(other.problem.reference))
    assert (parts.points_of_each, other.problem.parts.points_of_each) == (1, 2)
    reports = [nag.mobility(p) for p in (parts, other.problem.parts)]
    assert [r.local_dimension for r in reports] == [3, 3]
    assert reports[0].same_motion(reports[1], other.alike)
    file = tmp_path / "one.toml"
    file.write_text(
        'kind = "framework"\ntitle = "t"\ndimension = 3\n'
        f"bars = {[list(bar) for bar in bars]}\n[points]\n"
        + "\n".join(f"{name} = {list(place)}" for name, place in places.items())
    )
    named = zip(parts.system.variables, parts.reference, strict=True)
    at = ", ".join(f"{name} = {x}" for name, x in named)
    assert main(["mobility", str(file), "--check", "--quiet", "--at", at]) == 2
    assert "other bars to pin, and no --at" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("bars", "lengths", "dimension"),
    [
        (["AB", "BC", "CD", "AD", "AE", "CE"], [1, 2, 3, 6, 2, 4], 2),
        (["AB", "BC", "AC", "BD", "CD"], [1, 2, 3, 4, 3], 2),
        (["AB", "BC", "AC", "AD", "BD", "CD", "DE", "AE"], [1, 2, 3, 4, 4, 5, 2, 3], 3),
    ],
)
def test_a_stretched_framework_is_compared_with_other_equations_than_its_own(
    bars: list[str], lengths: list[int], dimension: int
) -> None:
    points = sorted(set("".join(bars)))
    problem = problem_of(framework_model(Framework.of(points, bars, lengths, dimension=dimension)))
    own = of_real_assemblies(problem).system
    others = list(other_equations(problem))
    assert others and all(of_real_assemblies(o.problem).system != own for o in others)


def test_both_say_the_same_of_a_stretched_framework() -> None:
    bars = ["AB", "BC", "CD", "AD", "AE", "CE"]
    problem = problem_of(framework_model(Framework.of("ABCDE", bars, [1, 2, 3, 6, 2, 4])))
    report, other = nag.mobility(problem), next(other_equations(problem))
    assert nag.mobility(other.problem).same_motion(report, other.alike)
