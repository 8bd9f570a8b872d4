"""``nag plot``: what is in its pictures, and what it refuses."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import nag
from nag.cli import main
from nag.kinematics.scene import scene_of
from nag.mechanism.problem import in_real_coordinates, problem_of
from nag.pictures import plane_curves
from nag.pictures.curve_picture import draw_real_curves
from nag.pictures.mechanism_picture import draw_mechanism
from nag.pictures.motion_picture import draw_joint_values, draw_point_paths
from nag.pictures.plane_curves import Axis, CurvesInStyle
from nag.pictures.surface_picture import find_lines

CASES = Path(__file__).parent.parent / "cases"
SYSTEM = "((x^2 + y^2)^2 - 2*(x^2 - y^2))*(y^2 - x^2*(x - 1))*(x + y - 1/2)\n"


def ask(*words: str) -> int:
    return main(["plot", *map(str, words), "--quiet"])


@pytest.fixture
def drawn(monkeypatch):
    """The curves that are drawn, in the place of a picture."""
    kept: list[tuple[list[CurvesInStyle], tuple[Axis, Axis]]] = []

    def keep(curves, axes, title, path) -> None:
        kept.append((curves, axes))

    for module in ("curve_picture", "motion_picture"):
        monkeypatch.setattr(f"nag.pictures.{module}.draw_plane_curves", keep)
    return kept


def test_all_real_points_are_drawn_and_special_ones_marked(drawn) -> None:
    answer = nag.decompose(SYSTEM)
    curves = [(str(c.degree), nag.find_real_curve(c)) for c in answer.components]
    draw_real_curves(curves, (0, 1), "title", "nowhere.svg")
    ((own, axes),) = drawn
    by_degree = {each.label: each for each in own}
    assert [axis.angle for axis in axes] == [False, False]
    line, cubic, quartic = (by_degree[d] for d in "134")
    assert np.abs(line.endless[0].sum(axis=1) - 0.5).max() < 1e-9
    assert (len(line.arcs), len(cubic.arcs), len(cubic.endless)) == (0, 0, 1)
    x, y = quartic.arcs[0].T
    assert np.abs((x**2 + y**2) ** 2 - 2 * (x**2 - y**2)).max() < 1e-9
    marks = {name: points for (name, _), points in quartic.marked}
    assert np.abs(marks["singular point"]).max() < 1e-9
    assert cubic.marked[0][0][0] == "isolated point"
    marks = {name: points for (name, _), points in line.marked}
    x, y = marks["meets another component"].T
    assert (
        np.abs((x**3 - 2 * x**2 + x - 0.25) * ((x**2 + y**2) ** 2 - 2 * (x**2 - y**2))).max() < 1e-9
    )


def test_what_is_shown_is_all_that_is_bounded_and_arcs_to_infinity_nearby() -> None:
    circle = np.stack([np.cos(np.linspace(0, 7, 99)), np.sin(np.linspace(0, 7, 99))], axis=-1)
    x = np.linspace(-1000, 1000, 100_001)
    line, higher = (np.stack([x, np.full_like(x, y)], axis=-1) for y in (0.0, 5.0))
    axes = Axis("x"), Axis("y")
    window = plane_curves.find_window([CurvesInStyle("", [circle], (), [line])], axes)
    assert np.all(window[0] < circle.min(axis=0)) and np.all(window[1] > circle.max(axis=0))
    assert 2.9 < window[1, 0] < 4
    alone = plane_curves.find_window([CurvesInStyle("", [], (), [higher])], axes)
    assert alone[0, 1] < 5 < alone[1, 1] and 5 < alone[1, 0] < 20


def test_angles_are_shown_for_one_turn_wherever_a_curve_comes_into_it() -> None:
    axes = Axis("a", True), Axis("b")
    straight = np.array([[180.0, 0.0], [180.0, 3.0]])
    assert [copy[0, 0] for copy in plane_curves._copies(straight, axes)] == [-180.0, 180.0]
    arc = np.array([[-100.0, 1.0], [400.0, 2.0]])
    shifts = [copy[0, 0] for copy in plane_curves._copies(arc, axes)]
    assert shifts == [-460.0, -100.0]


def test_half_angles_are_drawn_as_angles_through_infinity(drawn) -> None:
    curve = nag.find_real_curve(nag.decompose(nag.read_case(CASES / "bennett.toml")).components[0])
    draw_real_curves([("c", curve)], (0, 1), "title", "nowhere.svg")
    (((own,), axes),) = drawn
    assert [axis.angle for axis in axes] == [True, True]
    assert [axis.label for axis in axes] == ["2 atan x_J1", "2 atan x_J2"]
    (arc,) = own.arcs
    assert np.abs(np.abs(arc[-1] - arc[0]) - 360).max() < 1e-6
    assert np.abs(np.diff(arc, axis=0)).max() < 20


def test_joint_angles_and_paths_of_points_are_those_of_the_motion(drawn) -> None:
    found = nag.motion(nag.read_case(CASES / "planar" / "four-bar.toml"), samples=24)
    draw_joint_values(found, ("B", "C"), "title", "nowhere.svg")
    draw_point_paths(found, "C", (0, 1), "title", "nowhere.svg")
    (angles, _), (paths, _) = drawn
    table = found.table(2)
    assert np.array_equal(angles[1].arcs[0], np.stack([table["B"], table["C"]], axis=-1))
    # C is on a circle about D = (4, 0) of radius 7/2.
    for path in paths:
        assert np.abs(np.linalg.norm(path.arcs[0] - [4, 0], axis=1) - 3.5).max() < 1e-12


@pytest.mark.parametrize("kind", ["png", "svg", "pdf"])
def test_the_same_seed_draws_the_same_picture(kind: str, tmp_path, capsys) -> None:
    system = tmp_path / "system.txt"
    system.write_text(SYSTEM)
    pictures = [tmp_path / f"{name}.{kind}" for name in "ab"]
    for picture in pictures:
        assert ask(system, "--onto", "x,y", "--out", picture) == 0
    assert pictures[0].read_bytes() == pictures[1].read_bytes()
    if kind == "png":
        with Image.open(pictures[0]) as image:
            assert len(np.unique(np.asarray(image.convert("L")))) > 4
    assert "degree 3; 1 open arc and 1 isolated point" in capsys.readouterr().out


def test_the_graph_names_all_bodies_and_joints(tmp_path, capsys) -> None:
    picture = tmp_path / "graph.svg"
    assert ask(CASES / "planar" / "watt-six-bar.toml", "--graph", "--out", picture) == 0
    texts = {element.text for element in ET.parse(picture).iter() if element.tag.endswith("text")}
    assert texts >= {"base", "crank", "coupler", "rocker", "rod", "arm", *"ABCDEFG", "revolute"}


def test_an_export_is_drawn_as_its_case_is(tmp_path, capsys) -> None:
    system, export = tmp_path / "system.txt", tmp_path / "export.json"
    system.write_text("x^2 + y^2 = 1\n")
    assert main(["decompose", str(system), "--json", str(export), "--quiet"]) == 0
    for source, picture in ((system, "a.svg"), (export, "b.svg")):
        assert ask(source, "--onto", "x,y", "--out", tmp_path / picture) == 0
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()
    assert ask(export, "--graph", "--out", tmp_path / "c.svg") == 2


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["bennett.toml"], "say what to draw, one of --onto, --joints, --point, --graph"),
        (["bennett.toml", "--graph", "--joints", "J1,J2"], "give one of --onto, --joints"),
        (["bennett.toml", "--onto", "x"], "'x' is none; write two names, as in x,y"),
        (["bennett.toml", "--onto", "x_J1,x_J3"], "--onto: 'x_J3' is not one of the variables"),
        (["bennett.toml", "--joints", "J1,J9"], "--joints: 'J9' is no joint"),
        (["bennett.toml", "--point", "P"], "--point: 'P' is no point or joint; there are J0"),
        (["bennett.toml", "--onto", "x_J1,x_J2", "--component", "2"], "there is one component"),
        (["bennett.toml", "--graph", "--component", "1"], "--component is for --onto"),
        (["slider-crank.toml", "--graph"], "--graph: is for mechanisms; a polynomial system"),
        (["triangle.toml", "--onto", "x,x"], "write two names"),
    ],
)
def test_bad_input_is_one_line(words: list[str], said: str, tmp_path, capsys) -> None:
    name, *rest = words
    picture = tmp_path / "x.svg"
    assert ask(CASES / name, *rest, "--out", picture) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert said in line
    assert not picture.exists()


def test_a_case_that_cannot_be_read_is_named_once(tmp_path, capsys) -> None:
    broken = tmp_path / "broken.toml"
    broken.write_text('title = "no kind"\n')
    for case in (tmp_path / "none.toml", broken):
        for what in ("--graph", "--tree"):
            assert ask(case, what, "--out", tmp_path / "x.svg") == 2
            (line,) = capsys.readouterr().err.splitlines()
            assert line.count(str(case)) == 1


def test_pictures_of_other_kinds_or_places_are_refused(tmp_path, capsys) -> None:
    case = CASES / "bennett.toml"
    for target, said in (("x.gif", "ends in .svg"), ("/nowhere/x.svg", "--out: /nowhere/x.svg")):
        assert ask(case, "--graph", "--out", target) == 2
        (line,) = capsys.readouterr().err.splitlines()
        assert said in line


def test_curves_without_real_points_leave_nothing_to_draw(tmp_path, capsys) -> None:
    system = tmp_path / "system.txt"
    system.write_text("x^2 + y^2 + 1\n")
    assert ask(system, "--onto", "x,y", "--out", tmp_path / "x.svg") == 2
    assert "no component of dimension 1 has real points" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("case", "onto", "loops"),
    [
        ("graph-curve", "x,y,z", 1),
        ("bricard-variety", "a0,a2,c2", 2),
        ("bennett-variety", "a0,a2,c0", 2),
    ],
)
def test_the_papers_curves_are_drawn_in_space_without_corners(
    case: str, onto: str, loops: int, tmp_path, monkeypatch
) -> None:
    # PT13 figure 1, T25 figures 1 and 2.
    kept = []
    monkeypatch.setattr(
        "nag.pictures.curve_picture.draw_space_curves",
        lambda curves, axes, title, path: kept.append(curves),
    )
    picture = tmp_path / "curve.svg"
    assert ask(CASES / f"{case}.toml", "--onto", onto, "--out", picture) == 0
    ((own,),) = kept
    assert len(own.arcs) == loops
    for arc in own.arcs:
        steps = np.diff(arc / np.ptp(arc, axis=0), axis=0)
        steps /= np.linalg.norm(steps, axis=1)[:, None]
        # Without points put in the last step to a fold it is 0.916.
        assert (steps[1:] * steps[:-1]).sum(axis=1).min() > 0.95


def test_curves_in_space_are_written_as_a_picture_with_three_axes(tmp_path) -> None:
    picture = tmp_path / "curve.svg"
    assert ask(CASES / "bricard-variety.toml", "--onto", "a0,a2,c2", "--out", picture) == 0
    text = picture.read_text()
    assert all(f">{name}<" in text for name in ("a0", "a2", "c2", "component 1"))


@pytest.mark.parametrize("case", ["bennett", "planar/four-bar", "robots/3-rps"])
def test_a_mechanism_is_drawn_with_the_names_of_its_bodies_and_joints(case: str, tmp_path) -> None:
    picture = tmp_path / "x.svg"
    assert ask(CASES / f"{case}.toml", "--mechanism", "--out", picture) == 0
    problem = in_real_coordinates(problem_of(nag.read_case(CASES / f"{case}.toml")))
    text, scene = picture.read_text(), scene_of(problem)
    names = [*scene.bodies, *(joint.name for joint in scene.joints)]
    assert [name for name in names if name not in text] == []


def test_components_are_drawn_by_their_dimensions_alike_ones_together(tmp_path) -> None:
    picture = tmp_path / "x.svg"
    given = CASES / "literature" / "sphere-curve-lines-point.toml"
    assert ask(given, "--tree", "--out", picture) == 0
    text = picture.read_text()
    for words in ("dimension 2", "dimension 1", "dimension 0", "3 of degree 1", "degree 3"):
        assert f">{words}<" in text


def test_each_circuit_has_a_panel_where_links_are_not_in_line(tmp_path) -> None:
    picture = tmp_path / "x.svg"
    case = CASES / "planar" / "four-bars-in-a-row.toml"
    assert ask(case, "--mechanism", "--circuit", "all", "--out", picture) == 0
    text = picture.read_text()
    assert all(f">circuit {k}<" in text for k in range(1, 5)) and ">circuit 5<" not in text
    # A pin of three bodies is two joints in one place.
    assert text.count(">D:left, D:right<") == 4


def test_lines_of_a_surface_are_zeros_of_its_equation_in_planes() -> None:
    sphere = nag.system("x^2 + y^2 + z^2 - 1", "x y z").polynomials[0]
    lines = find_lines(sphere, np.tile(np.linspace(-1.6, 1.6, 121), (3, 1)))
    points = np.vstack(lines)
    assert np.abs((points**2).sum(axis=1) - 1).max() < 1e-3
    # Eleven planes of each direction meet it, each in a circle.
    assert len(lines) == 33 and all(np.ptp(line, axis=0).min() < 1e-12 for line in lines)


def test_a_surface_is_drawn_in_three_variables_by_the_equation_of_its_image(tmp_path) -> None:
    picture = tmp_path / "x.svg"
    given = tmp_path / "curve.txt"
    given.write_text("z - x^2 - y^2\n")
    assert ask(given, "--onto", "x,y,z", "--out", picture) == 0
    assert ">component 1<" in picture.read_text()
    assert ask(given, "--onto", "x,y", "--out", picture) == 2


@pytest.mark.parametrize(("case", "one"), [("mobility/delta", "R1"), ("spatial/rssr", "A")])
def test_names_of_joints_are_beside_each_other(case: str, one: str, monkeypatch) -> None:
    figures = []
    monkeypatch.setattr(
        "nag.pictures.mechanism_picture.save", lambda own, path: figures.append(own)
    )
    problem = in_real_coordinates(problem_of(nag.read_case(CASES / f"{case}.toml")))
    scene = scene_of(problem)
    poses = scene.lift(np.array([[float(x) for x in problem.reference]]))
    draw_mechanism(scene, [("", poses)], "title", "nowhere.svg")
    (axes,) = figures[0].axes
    assert {one} < {text.get_text() for text in axes.texts}
    boxes = [text.get_window_extent() for text in axes.texts]
    assert not any(a.overlaps(b) for i, a in enumerate(boxes) for b in boxes[:i])
