"""Mechanisms that are given by their parts: tables, frameworks, links by length."""

from __future__ import annotations

import json
import random
from fractions import Fraction
from itertools import combinations
from pathlib import Path

import jsonschema
import networkx
import numpy as np
import pytest
from linkages import CASES

import nag
from nag.algebra.expression import parse_number
from nag.cli import main
from nag.decomposition.decompose import decompose
from nag.files.cases import Case, read_case
from nag.files.json_schema import schema
from nag.mechanism.dh import DHLoop, Row, assemble_table, dh_model
from nag.mechanism.framework import (
    Framework,
    FrameworkError,
    framework_of_graph,
    placed_framework,
)
from nag.mechanism.framework_model import framework_model, space_models
from nag.mechanism.mobility_at import NoAssembly, mobility
from nag.mechanism.model import model
from nag.mechanism.quaternion import dual_multiply
from nag.mechanism.real_assemblies import obstacle
from nag.numerics.local_dimension import local_dimension

PRISM = ["AB", "BC", "CA", "DE", "EF", "FD", "AD", "BE", "CF"]

TABLE = """\
title = "Bennett"
kind = "dh"
[[joint]]
a = "4/5"
alpha_half_tangent = "1/2"
{0}
[[joint]]
a = "3/5"
alpha_half_tangent = "1/3"
{1}
[[joint]]
a = "4/5"
alpha_half_tangent = "1/2"
{2}
[[joint]]
a = "3/5"
alpha_half_tangent = "1/3"
{3}
"""


def henneberg_order(framework: Framework) -> list[str] | None:
    """The points in an order in which each has just two bars to earlier ones, or None.

    The first two are joined by a bar. Such a graph of n points has 2^(n - 2) realisations in the
    plane for general lengths (Henneberg's first construction).
    """
    neighbours = {
        p: {q for bar in framework.bars if p in bar for q in bar} - {p} for p in framework.points
    }
    removed: list[str] = []
    left = set(framework.points)
    while len(left) > 2:
        last = next(
            (p for p in framework.points if p in left and len(neighbours[p] & left) == 2), None
        )
        if last is None:
            return None
        removed.append(last)
        left.discard(last)
    first = [p for p in framework.points if p in left]
    return [*first, *reversed(removed)] if first[1] in neighbours[first[0]] else None


def read(tmp_path: Path, text: str) -> Case:
    path = tmp_path / "case.toml"
    path.write_text(text, encoding="utf-8")
    return read_case(path)


def bennett_angles(tangent: Fraction) -> list[Fraction]:
    """Half-tangents that close the table: neighbours have a constant product, opposite a sign."""
    half = Fraction(1, 2), Fraction(1, 3)
    # sin((beta + alpha) / 2) / sin((beta - alpha) / 2), as a quotient of half-tangents.
    product = (half[1] + half[0]) / (half[1] - half[0])
    other = product / tangent
    return [tangent, other, -tangent, -other]


# Tables


def test_a_table_whose_angles_close_is_the_assembled_mechanism(tmp_path):
    angles = [f'theta_half_tangent = "{x}"' for x in bennett_angles(Fraction(2, 3))]
    case = read(tmp_path, TABLE.format(*angles))
    assert case.system is None
    made = model(case.mechanism)
    assert made.system.exact
    assert all(value == 0 for value in made.system(made.reference))
    (component,) = decompose(made.system).components
    assert (component.dimension, component.degree) == (1, 2)


def test_a_table_that_does_not_close_is_told_its_gap(tmp_path, capsys):
    path = tmp_path / "case.toml"
    angles = bennett_angles(Fraction(2, 3))
    angles[3] *= 2
    path.write_text(TABLE.format(*(f'theta_half_tangent = "{x}"' for x in angles)))
    assert main(["decompose", str(path)]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert "the loop does not close: after the last row a gap of " in error


def test_all_closings_of_an_open_table_close_it():
    loop = read_case(CASES / "spatial" / "general-6r.toml").assembly.loop
    made = dh_model(loop)
    answer = decompose(made.system)
    assert sum(c.degree for c in answer.components) == 16
    for component in answer.components:
        angles = made.half_angles(component.points[0])
        product = ((1, 0, 0, 0), (0, 0, 0, 0))
        for row in loop.rows:
            c, s = angles[row.name]
            product = dual_multiply(product, ((c, 0, 0, s), (0, 0, 0, 0)))
            link = [[complex(x) for x in part] for part in row.link]
            product = dual_multiply(product, (tuple(link[0]), tuple(link[1])))
        entries = np.array([x for part in product for x in part])
        assert np.abs(entries[1:]).max() < 1e-9 * abs(entries[0])


def test_a_held_angle_selects_the_points_of_the_open_table(tmp_path):
    held = [f'theta_half_tangent = "{bennett_angles(Fraction(2, 3))[0]}"', "", "", ""]
    case = read(tmp_path, TABLE.format(*held))
    (component,) = decompose(case.system).components
    assert component.dimension == 0
    angles = case.assembly.half_angles(component.points[0])
    tangents = [angles[name][1] / angles[name][0] for name in ("J2", "J3", "J4")]
    assert np.allclose(tangents, [float(x) for x in bennett_angles(Fraction(2, 3))[1:]])


def test_right_angles_and_straight_ones_are_exact(tmp_path):
    text = TABLE.format(*[""] * 4).replace('alpha_half_tangent = "1/2"', 'alpha = "pi/2"')
    right = read(tmp_path, text)
    assert right.system.exact
    straight = read(tmp_path, text.replace("pi/2", "-pi"))
    assert straight.system.exact


def test_the_same_loop_has_the_same_components_as_table_and_as_mechanism():
    alpha = (Fraction(1), Fraction(1, 2))
    rows = [Row(f"J{i}", Fraction(a), Fraction(0), alpha) for i, a in enumerate((1, 2, 1, 2))]
    flat = [
        Row(r.name, r.a, r.d, (Fraction(1), Fraction(0)), (Fraction(t), Fraction(1)))
        for r, t in zip(rows, (1, 1, 1, 1), strict=True)
    ]
    rectangle = model(assemble_table(DHLoop(tuple(flat))), "H")
    table = dh_model(DHLoop(tuple(Row(r.name, r.a, r.d, r.alpha) for r in flat)))
    degrees = [
        sorted((c.dimension, c.degree) for c in decompose(m.system).components)
        for m in (rectangle, table)
    ]
    assert degrees[0] == degrees[1] == [(1, 2), (1, 2)]


# Frameworks


def random_henneberg(points: int, seed: int) -> Framework:
    """Each point hangs on two earlier ones that are joined to something, at a general place."""
    draw = random.Random(seed)
    places = {
        f"p{i}": (Fraction(draw.randint(-99, 99), 10), Fraction(draw.randint(-99, 99), 10))
        for i in range(points)
    }
    bars = [("p0", "p1")]
    for i in range(2, points):
        bars += [(f"p{j}", f"p{i}") for j in draw.sample(range(i), 2)]
    given = placed_framework(2, places, bars)
    return Framework(2, given.points, given.bars, given.squared_lengths)


@pytest.mark.parametrize(("points", "seed"), [(3, 0), (4, 1), (5, 2), (6, 3)])
def test_henneberg_graphs_have_two_realisations_for_each_further_point(points, seed):
    framework = random_henneberg(points, seed)
    assert henneberg_order(framework) is not None
    assert framework.generic_motions() == framework.freedoms == 0
    answer = decompose(framework_model(framework).system)
    assert {c.dimension for c in answer.components} == {0}
    assert len(answer.components) == 2 ** (points - 2)


def test_ranks_tell_shaky_from_rigid_and_from_mobile():
    conic = read_case(CASES / "shaky" / "k33-on-conic.toml").assembly.framework
    assert (conic.freedoms, conic.generic_motions(), conic.infinitesimal_motions()) == (0, 0, 1)
    braced = read_case(CASES / "planar" / "braced-square.toml").assembly.framework
    assert (braced.freedoms, braced.generic_motions()) == (-1, 0)
    assert braced.infinitesimal_motions() == 0
    dixon = read_case(CASES / "planar" / "dixon-2-k44.toml").assembly.framework
    assert (dixon.freedoms, dixon.generic_motions(), dixon.infinitesimal_motions()) == (-3, 0, 1)
    octahedron = read_case(CASES / "spatial" / "octahedron-line-symmetric.toml").assembly.framework
    assert (octahedron.freedoms, octahedron.infinitesimal_motions()) == (0, 1)


def test_realisations_in_space_are_as_many_whatever_points_are_pinned():
    places = {"A": (0, 0, 0), "B": (4, 1, 0), "C": (1, 3, -1), "N": (1, 1, 5), "S": (2, 1, -3)}
    bars = ["AB", "BC", "CA", *(base + apex for base in "ABC" for apex in "NS")]
    exact = {name: tuple(map(Fraction, place)) for name, place in places.items()}
    bipyramid = placed_framework(3, exact, [(a, b) for a, b in bars])
    counts = {}
    for pinned in space_models(bipyramid):
        answer = decompose(pinned.system, symmetries=pinned.symmetries)
        points = sum(c.orbit * c.degree for c in answer.components)
        counts["".join(pinned.pinned)] = (points // pinned.points_of_each, pinned.points_of_each)
    # Each apex above or below the triangle.
    assert set(counts.values()) == {(4, 1), (4, 2)}
    assert [p for p in counts if counts[p][1] == 2] == ["ANS", "BNS", "CNS"]


@pytest.mark.parametrize(("first", "second"), [(4, 6), (5, 5)])
def test_complete_bipartite_frameworks_in_space_are_shaky_on_a_quadric_and_rigid_beside_it(
    first, second
):
    # Bolker & Roth, When is a bipartite graph a rigid framework?, 1980.
    draw = random.Random(1)
    places = [[Fraction(draw.randint(-9, 9), draw.randint(1, 4)) for _ in "xy"] for _ in range(10)]
    for bend, tangent in ((0, 1), (1, 0)):
        placement = {f"P{i}": (x, y, x * y + bend * x**3) for i, (x, y) in enumerate(places)}
        bars = [(f"P{i}", f"P{j}") for i in range(first) for j in range(first, first + second)]
        made = framework_model(placed_framework(3, placement, bars))
        assert all(value == 0 for value in made.system(made.reference))
        local = local_dimension(made.system, made.reference)
        assert (local.dimension, local.tangent_dimension) == (0, tangent)


def test_no_realisation_is_real_where_a_triangle_has_a_side_that_is_too_long():
    # In the frame of A, B and C, whose vectors across A-B have negative squares, the apices are
    # at rational places: e1 = AB of square 16, e2 and e3 of square v.
    u = Fraction(36 + 16 - 256, 32)
    v = 36 - 16 * u * u
    assert v < 0
    base = ((0, 0, 0), (1, 0, 0), (u, 1, 0))
    bars, squared = [("A", "B"), ("B", "C"), ("C", "A")], [Fraction(n) for n in (16, 256, 36)]
    for apex, place in (
        ("N", (3, Fraction(1, 10), Fraction(1, 10))),
        ("S", (4, 0, Fraction(1, 5))),
    ):
        for corner, at in zip("ABC", base, strict=True):
            x, y, z = (p - q for p, q in zip(place, at, strict=True))
            bars.append((corner, apex))
            squared.append(16 * x * x + v * (y * y + z * z))
    assert min(squared) > 0
    model = framework_model(Framework(3, tuple("ABCNS"), tuple(bars), tuple(squared)))
    found = nag.solve(model.system)
    points = [s.point for s in found.solutions]
    assert len(points) == 4
    assert all(abs(point.imag).max() < 1e-12 for point in points)
    assert not any(model.is_real(point) for point in points)


def test_real_realisations_are_counted_where_coordinates_are_isotropic(capsys):
    # The coordinates of real ones are conjugate pairs, not real numbers.
    prism = str(CASES / "planar" / "three-prism.toml")
    assert main(["solve", prism, "--quiet"]) == 0
    assert "realisations  24, 8 of them real" in capsys.readouterr().out


def test_the_placement_of_a_framework_solves_its_equations_exactly():
    for name in ("shaky/prism-concurrent", "spatial/octahedron-plane-symmetric"):
        made = read_case(CASES / f"{name}.toml").assembly
        assert all(value == 0 for value in made.system(made.reference))


@pytest.mark.parametrize(
    ("dimension", "power", "motions", "stresses"),
    # On a line in space, on one in the plane; on a curve in a plane, and in space.
    [(3, (1, 0, 0), 4, 3), (2, (1, 0), 2, 3), (3, (1, 2, 0), 1, 1), (3, (1, 2, 3), 0, 0)],
)
def test_motions_of_points_in_line_are_fewer_than_those_of_space(
    dimension: int, power: tuple[int, ...], motions: int, stresses: int
) -> None:
    places = {
        c: tuple(Fraction(k * x**k) for k in power)
        for c, x in zip("ABCD", (0, 1, 3, 4), strict=True)
    }
    framework = placed_framework(dimension, places, list(combinations("ABCD", 2)))
    assert framework.infinitesimal_motions() == motions
    assert framework.self_stresses() == stresses


def test_a_networkx_graph_is_a_framework_by_lengths_or_by_positions():
    graph = networkx.Graph(tuple(bar) for bar in PRISM)
    networkx.set_node_attributes(
        graph,
        dict(zip("ABCDEF", [(0, 0), (3, 0), (1, 2), (1, 4), (4, 4), (2, 6)], strict=True)),
        "pos",
    )
    placed = framework_of_graph(graph)
    assert placed.infinitesimal_motions() == 1
    assert placed.squared_length("C", "A") == 5
    for a, b, data in graph.edges(data=True):
        data["length"] = 1 if a + b in PRISM[:3] else 1.5
    assert framework_of_graph(graph).squared_length("F", "C") == Fraction(9, 4)
    with pytest.raises(FrameworkError, match="give every edge a 'length'"):
        framework_of_graph(networkx.path_graph(3))


# Links by length


def test_a_four_bar_by_its_lengths_has_the_components_of_the_assembled_one():
    by_length = read_case(CASES / "planar" / "four-bar-parallelogram.toml")
    placed = model(read_case(CASES / "planar-four-bar.toml").mechanism, "E")
    kinds = [
        sorted((c.dimension, c.degree) for c in decompose(system).components)
        for system in (by_length.system, placed.system)
    ]
    assert kinds[0] == kinds[1] == [(1, 2), (1, 4)]
    assert by_length.assembly.linkage.gruebler_kutzbach == 1


def test_links_that_cannot_meet_are_told_from_those_that_can(tmp_path, capsys):
    # Longer than the others together: complex assemblies only, but assemblies all the same.
    path = tmp_path / "case.toml"
    text = (CASES / "planar" / "triangle-framework.toml").read_text(encoding="utf-8")
    path.write_text(text.replace('[3, 4, "11/2"]', "[1, 2, 4]"))
    assert main(["decompose", str(path), "--quiet"]) == 0
    assert "2 realisations up to motions, 0 of them real" in capsys.readouterr().out


def test_a_stretched_linkage_is_not_said_to_have_no_real_assembly(capsys):
    assert main(["solve", str(CASES / "shaky" / "four-bar-flat.toml"), "--quiet"]) == 0
    found = " ".join(capsys.readouterr().out.split())
    assert "answer no isolated solution, but a solution set of positive dimension" in found
    assert "0 of them real" not in found and "`nag mobility` says whether real ones" in found


@pytest.mark.parametrize(
    ("lengths", "said"),
    [
        (
            (7, 1, 2, 3),
            "there is no real one, which is proved: link base is longer than link crank, ",
        ),
        ((6, 1, 2, "3001/1000"), "a real assembly was found"),
        # Stretched between the ends of the base: the only real assembly is a node.
        ((6, 1, 2, 3), "it does not move there: 1 real assembly in all"),
    ],
)
def test_a_mobile_linkage_says_whether_it_has_real_assemblies(tmp_path, capsys, lengths, said):
    path = tmp_path / "case.toml"
    names, pins = ("base", "crank", "coupler", "rocker"), ("AD", "AB", "BC", "CD")
    links = [
        f'[[link]]\nname = "{name}"\npins = ["{p[0]}", "{p[1]}"]\nlength = "{length}"\n'
        for name, p, length in zip(names, pins, lengths, strict=True)
    ]
    path.write_text('title = "Four-bar"\nkind = "linkage"\nground = "base"\n' + "".join(links))
    assert main(["decompose", str(path), "--quiet"]) == 0
    found = " ".join(capsys.readouterr().out.split())
    start = "it moves" if said == "a real assembly was found" else "in complex coordinates it moves"
    assert f"mobility {start} with 1 freedom, on " in found
    assert said in found
    status = main(["mobility", str(path), "--quiet"])
    captured = capsys.readouterr()
    moves = " ".join(captured.out.split())
    if "proved" in said:
        assert (status, moves) == (2, "")
        assert said.removeprefix("there is no real one, which is proved: ") in captured.err
    elif "not move" in said:
        assert "A, B, C and D are in line" in moves
        assert "it does not move, but infinitesimally it does, with 2 freedoms" in moves
    else:
        assert "it moves with 1 freedom" in moves


STRETCHED = {
    # Each: dimension, points, bars with lengths, local and tangent dimension of the real ones.
    "pentagon": (2, "ABCDE", "AB 1, BC 1, CD 2, DE 2, EA 6", 0, 3),
    "quadrilateral in space": (3, "ABCD", "AB 1, BC 2, CD 3, DA 6", 0, 4),
    "hexagon with a stretched diagonal": (
        2,
        "ABCDEF",
        "AB 1, BC 1, CD 1, AD 3, DE 2, EF 1, FA 1",
        1,
        3,
    ),
    "with square roots": (
        2,
        "ABCD",
        "AB sqrt(2), BC sqrt(3), AC sqrt(2)+sqrt(3), CD 1, DA 4",
        0,
        1,
    ),
    # The pinned points' coordinates along the frame's vectors are larger than one.
    "line beside a triangle in space": (3, "ABCD", "CA 1, CD 2, AD 3, AB 2, DB 2", 0, 2),
    # No frame rests on the pinned bars, which are a triangle in line.
    "triangles in line in space": (3, "ABCD", "AB 1, BC 2, AC 3, CD 1, BD 3", 0, 4),
    # A bar from each stretched pair's end to the other's: the second line follows from the first.
    "lines that share two points": (2, "ABCD", "AB 1, BC 1, AC 2, CD 1, BD 2", 0, 2),
}


@pytest.mark.parametrize("name", STRETCHED)
def test_points_that_lengths_put_in_line_move_as_real_ones_do(name):
    dimension, points, texts, local, tangent = STRETCHED[name]
    bars = [text.split(" ") for text in texts.split(", ")]
    made = Framework.of(points, [b for b, _ in bars], [x for _, x in bars], dimension=dimension)
    found = mobility(made)
    assert (found.local_dimension, found.tangent_dimension) == (local, tangent)
    assert "are in line" in found.sentence
    assert found.doubt == ""


STRETCHED_LINKS = {
    # Links beside A-B 1, C-D 3 and a base and coupler; local and tangent dimension.
    "alone": ({"base": "AD6", "coupler": "BC2"}, 0, 2),
    "a link hangs on it": ({"base": "AD6", "coupler": "BC2", "x": "BE2"}, 1, 3),
    "a plate in line hangs on it": (
        {"base": "AD6", "coupler": "BC2", "x": {"B": (0, 0), "E": (1, 0), "F": (2, 0)}},
        1,
        3,
    ),
    "the ground hangs on it": ({"ground": "XA6", "base": "AD6", "coupler": "BC2"}, 1, 3),
    # A plate turns as one, so that a pin in line with two others does not move across by itself.
    "pins in line with others": (
        {"base": {"A": (0, 0), "D": (6, 0), "E": (8, 0)}, "coupler": "BC2"},
        0,
        2,
    ),
    "a coupler of pins in line": (
        {
            "base": {"A": (0, 0), "E": (2, 1), "D": (6, 0)},
            "coupler": {"B": (0, 0), "F": (1, 0), "C": (2, 0)},
            "x": "EF1",
        },
        0,
        1,
    ),
}


@pytest.mark.parametrize("name", STRETCHED_LINKS)
def test_a_stretched_linkage_moves_as_its_real_assemblies_do(name):
    links, local, tangent = STRETCHED_LINKS[name]
    ground = "ground" if "ground" in links else "base"
    found = nag.mobility(nag.Linkage.of({**links, "left": "AB1", "right": "CD3"}, ground))
    assert (found.local_dimension, found.tangent_dimension) == (local, tangent)
    assert "are in line" in found.sentence


def test_links_that_lengths_forbid_are_no_rigid_ones():
    # Stretched, its pin F is at E, and no link of length 1 is between them.
    base = {"A": (0, 0), "E": (2, 0), "D": (6, 0)}
    coupler = {"B": (0, 0), "F": (1, 0), "C": (2, 0)}
    links = {"base": base, "left": "AB1", "coupler": coupler, "right": "CD3", "x": "EF1"}
    said = "link base, link left, link coupler, link right and link x are stretched along one line"
    with pytest.raises(NoAssembly, match=f"{said} and put F at two places of it"):
        nag.mobility(nag.Linkage.of(links, "base"))


def test_coincident_points_follow_from_lengths():
    # E is where A is, so that the bars from F to both are one.
    bars = ["AB", "BC", "AC", "CE", "EB", "AF", "EF"]
    lengths = [1, 1, 2, 2, 1, 3, 3]
    assert mobility(Framework.of("ABCEF", bars, lengths)).local_dimension == 1
    lengths[-1] = 4
    made = framework_model(Framework.of("ABCEF", bars, lengths))
    assert "longer" in obstacle(made)


def test_a_tetrahedron_without_real_place_is_no_rigid_one():
    bars = ["AB", "BC", "CA", "AD", "BD", "CD"]
    with pytest.raises(NoAssembly, match="none of 2 complex ones is real"):
        mobility(Framework.of("ABCD", bars, [4, 4, 4, "11/5", "11/5", "11/5"], dimension=3))
    assert mobility(Framework.of("ABCD", bars, [4, 4, 4, 3, 3, 3], dimension=3)).status == "rigid"


def test_sides_are_compared_exactly():
    # At equality the linkage is flat, and real; a hair more is too long.
    for excess, said in (
        ("0", ""),
        ("1/10^40", "bar A-C is longer than bar A-B and bar B-C together"),
    ):
        lengths = [parse_number("sqrt(2)"), parse_number("sqrt(3)")]
        lengths.append(lengths[0] + lengths[1] + parse_number(excess))
        squares = tuple(x * x for x in lengths)
        bars = (("A", "B"), ("B", "C"), ("A", "C"))
        assert obstacle(framework_model(Framework(2, tuple("ABC"), bars, squares))) == said


# Lines


FOUR_BAR = (CASES / "planar-four-bar.toml").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    "line",
    [
        'through = [["a", 0, 5], ["a", 0, 7]]',
        'line = { direction = [0, 0, 2], moment = [0, "-2*a", 0] }',
    ],
)
def test_an_axis_may_be_a_line_of_two_points_or_of_pluecker_coordinates(tmp_path, line):
    changed = FOUR_BAR.replace('point = ["a", 0, 0]\naxis = [0, 0, 1]', line)
    assert changed != FOUR_BAR
    first, second = (model(read(tmp_path, text).mechanism) for text in (FOUR_BAR, changed))
    assert first.system == second.system


def test_a_link_of_length_zero_is_named(tmp_path):
    changed = FOUR_BAR.replace('point = ["a", 0, 0]', "point = [0, 0, 7]")
    assert changed != FOUR_BAR
    said = "B0 has length zero: J1 and J0 turn about one line"
    made = read(tmp_path, changed).mechanism
    assert model(made).zero_links == (said,)
    assert said in str(mobility(made))
    assert model(read(tmp_path, FOUR_BAR).mechanism).zero_links == ()


@pytest.mark.parametrize(("a", "twist", "count"), [(0, 0, 1), (0, 1, 0), (1, 0, 0)])
def test_a_row_without_length_and_twist_is_named(a, twist, count):
    def row(name: str, length: int, half_tangent: int) -> Row:
        return Row(name, Fraction(length), Fraction(2), (Fraction(1), Fraction(half_tangent)))

    made = dh_model(DHLoop((*(row(name, 1, 2) for name in "ABCDE"), row("F", a, twist))))
    assert made.zero_links == ("link after F has length zero: F and A turn about one line",) * count


SHAFT = (CASES / "spatial/universal-shaft.toml").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("point = [1, 1, 0]\naxis = [0, 0, 1]", "second_through = [[1, -5, 0], [1, -4, 0]]"),
        ("through = [[1, 1, 2], [1, 1, 3]]", "second_through = [[1, 7, 0], [1, 8, 0]]"),
        (
            "through = [[1, 1, 2], [1, 1, 3]]",
            "second_line = { direction = [0, 1, 0], moment = [0, 0, 1] }",
        ),
    ],
)
def test_the_axes_of_a_universal_joint_may_be_lines_that_meet(tmp_path, first, second):
    both = "point = [1, 1, 0]\naxis = [0, 0, 1]\nsecond_axis = [0, 1, 0]"
    changed = SHAFT.replace(both, f"{first}\n{second}")
    assert changed != SHAFT
    one, other = (model(read(tmp_path, text).mechanism) for text in (SHAFT, changed))
    assert one.system == other.system


# Parameters


def test_set_changes_a_parameter_and_what_is_known_no_longer_holds(capsys):
    command = ["decompose", str(CASES / "planar-four-bar.toml"), "--quiet", "--formulation", "E"]
    assert main([*command, "--set", "b=a/2", "--set", "a=1+1"]) == 0
    assert "known     agrees" in capsys.readouterr().out
    assert main([*command, "--set", "b=a"]) == 0
    output = capsys.readouterr().out
    assert "3 components of dimension 1, degree 2" in output
    assert "known" not in output


def test_a_sweep_follows_general_values_and_decomposes_special_ones(tmp_path, capsys):
    path = tmp_path / "case.toml"
    text = TABLE.format(*[""] * 4).replace('a = "3/5"', 'a = "b"')
    path.write_text(text + '[parameters]\nb = "3/5"\n')
    assert main(["decompose", str(path), "--quiet", "--sweep", "b=0.3:0.9:3"]) == 0
    lines = capsys.readouterr().out.splitlines()
    rows = {line.split()[0]: line for line in lines if line.strip()[:1].isdigit()}
    folded = "2 components of dimension 0, degree 1"
    assert folded in rows["3/10"]
    assert "followed" in rows["3/10"]
    assert folded in rows["9/10"]
    assert "1 component of dimension 1, degree 2" in rows["3/5"]
    assert "by itself" in rows["3/5"]


def test_a_table_whose_closure_equations_collapse_says_so(capsys):
    assert main(["decompose", str(CASES / "spatial" / "bennett.toml"), "--quiet"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "the 4 closure equations have rank 1 in 2 unknowns, by exact linear algebra" in said
    assert main(["model", str(CASES / "spatial" / "general-6r.toml")]) == 0
    assert "rank " not in capsys.readouterr().out


def test_a_sweep_through_a_value_with_other_joints_eliminated_decomposes_it_by_itself(capsys):
    # At m2 = 1 two pairs of Bennett's axes coincide, and each pair turns freely.
    path = CASES / "bennett.toml"
    assert main(["decompose", str(path), "--quiet", "--sweep", "m2=1/2:3/2:3"]) == 0
    lines = [line.split() for line in capsys.readouterr().out.splitlines()]
    found = {line[0]: " ".join(line[1:]) for line in lines if line and line[0] in ("1/2", "1")}
    assert "followed" in found["1/2"] and "dimension 1, degree 2" in found["1/2"]
    assert "by itself" in found["1"] and "dimension 2, degree 1" in found["1"]


def test_a_component_that_falls_apart_at_one_value_is_split_there(tmp_path):
    from nag.decomposition.sweep import sweep

    text = (CASES / "planar" / "four-bar.toml").read_text(encoding="utf-8")
    file = tmp_path / "case.toml"
    head = text.replace('"7/2"', "1").replace("length = 3", "length = 2").replace("= 4", '= "d"')
    file.write_text(head.split("[[truth")[0] + "[parameters]\nd = 2\n")
    values = [Fraction(3, 2), Fraction(2), Fraction(5, 2)]
    swept = sweep(lambda d: read_case(file, {"d": d}).system, values)
    degrees = [sorted(c.degree for c in each.decomposition.components) for each in swept]
    assert degrees == [[6], [2, 4], [6]]
    assert all(each.followed for each in swept)


def test_real_realisations_of_a_solved_framework_have_its_lengths(tmp_path, capsys) -> None:
    file, given = tmp_path / "prism.json", CASES / "planar" / "three-prism.toml"
    main(["solve", str(given), "--quiet", "--json", str(file)])
    printed = capsys.readouterr().out
    document = json.loads(file.read_text())
    jsonschema.validate(document, schema("nag-solutions"))
    framework = read_case(given).described
    assert len(document["realisations"]) == 8
    for each in document["realisations"]:
        at = {name: np.array(place) for name, place in each["places"].items()}
        for (a, b), squared in zip(framework.bars, framework.squared_lengths, strict=True):
            assert ((at[a] - at[b]) ** 2).sum() == pytest.approx(float(squared), rel=1e-12)
    assert "24 isolated solutions, 8 real" in printed and "realisation  solution" in printed
