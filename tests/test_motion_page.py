"""The page of a motion: one file, no network, and it moves."""

from __future__ import annotations

import base64
import html
import json
import re
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from traced_curves import trace_loop

import nag
from nag.kinematics.driven_motion import DrivenMotion
from nag.kinematics.motion import Motion, motion_of
from nag.kinematics.scene import Scene
from nag.mechanism.linkage import Linkage
from nag.mechanism.problem import in_real_coordinates, problem_of
from nag.mechanism.real_assemblies import real_assemblies
from nag.page.link_shapes import link_shapes, typical_length
from nag.page.motion_page import _encode, driven_page, motion_page

ROOT = Path(__file__).parent.parent
# One of each kind of joint, and of space.
CASES = [
    "bennett",
    "planar/watt-six-bar",
    "planar/elliptic-trammel",
    "planar/slider-crank",
    "planar/four-bar-kite",
    "spherical/four-bar",
    "spatial/rssr",
    "spatial/universal-shaft",
]
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
FLAGS = [
    "--headless=new",
    "--no-sandbox",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--virtual-time-budget=3000",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--window-size=800,600",
    "--dump-dom",
]


@pytest.fixture(scope="module")
def moved():
    """Motions along the loop through a known point, each worked out once."""
    known: dict[str, Motion] = {}

    def move(name: str) -> Motion:
        if name not in known:
            case = nag.read_case(ROOT / "cases" / f"{name}.toml")
            problem = in_real_coordinates(problem_of(case))
            start = problem.reference
            if start is None:
                start = next(real_assemblies(problem.parts)).x
            curve = trace_loop(problem, np.array([float(x) for x in start]))
            known[name] = motion_of(problem, samples=120, curve_of=lambda _: curve)
        return known[name]

    return move


@pytest.mark.parametrize("name", CASES)
def test_a_page_is_one_file_below_a_megabyte_that_asks_for_nothing(moved, name) -> None:
    page = motion_page(moved(name), "title", "case.toml")
    assert len(page.encode()) < 1_000_000
    # Scripts, styles and pictures are in it: nothing has an address, but for the icon that is none.
    body = re.sub(r"<script.*?</script>", "", page, flags=re.DOTALL)
    assert re.findall(r"(?:src|href)=\"(.*?)\"", body) == ["data:,"]
    assert not re.findall(r"<script[^>]*src|@import|url\(", page)
    assert len(re.findall(r"<script", page)) == len(re.findall(r"</script>", page))
    assert "{{" not in body and "MIT License" in page


def test_the_same_motion_gives_the_same_bytes(moved) -> None:
    pages = [motion_page(moved("bennett"), "title", "case.toml") for _ in range(2)]
    assert pages[0] == pages[1]


def test_titles_and_names_cannot_break_out_of_the_page(moved) -> None:
    title = "</script><script>alert(1)</script><!-- \u2028 & {{data}}"
    page = motion_page(moved("bennett"), title, "</script>.toml")
    assert f"<title>{html.escape(title)}</title>" in page
    assert "alert(1)</script>" not in page
    (data,) = re.findall(r'<script type="application/json" id="motion">(.*?)</script>', page)
    assert json.loads(data)["title"] == title


def data_of(page: str) -> dict:
    """What a page's script is given."""
    (text,) = re.findall(r'<script type="application/json" id="motion">(.*?)</script>', page)
    return json.loads(text)


def rows_of(data: dict, circuit: dict) -> np.ndarray:
    """The numbers of a circuit's frames as the page's script reads them, a row each."""
    parts = np.frombuffer(base64.b64decode(circuit["rows"]), np.uint8).reshape(-1, 3)
    moving = iter((parts @ [1, 256, 65536]).reshape(-1, circuit["frames"]))
    still = np.ones(circuit["frames"])
    return np.array([s * (f + next(moving)) if s else f * still for f, s in data["grids"]])


def test_a_page_says_that_its_circuits_are_those_through_the_reference(moved) -> None:
    data = data_of(motion_page(moved("bennett"), "title", "case.toml"))
    (component,) = (text for name, text in data["facts"] if name == "component")
    assert component == "dimension 1, degree 2; 1 circuit through the reference configuration"


def test_frames_are_the_samples(moved) -> None:
    motion = moved("bennett")
    (own,) = motion.circuits
    data = data_of(motion_page(motion, "title", "case.toml"))
    (circuit,) = data["circuits"]
    assert circuit["frames"] == 121 and not [k for k, _ in data["facts"] if k == "frames"]
    rows = rows_of(data, circuit)
    turns, places = rows[:16].reshape(4, 4, -1), rows[16:28].reshape(4, 3, -1)
    assert np.abs(np.moveaxis(turns, 1, 2) - own.poses.turns).max() < 1e-6
    assert np.abs(np.moveaxis(places, 1, 2) - own.poses.places).max() < 1e-6
    assert np.abs(rows[28:].T - np.degrees(own.values.values)).max() < 1e-4
    # The ground does not move, and it costs nothing; what is zero is zero.
    ground = motion.scene.ground
    assert all(not data["grids"][4 * ground + k][1] for k in range(4))
    assert (rows[28:, 0] == 0).all()


def _points(shape) -> list[np.ndarray]:
    places = {"rod": 2, "bar": 2, "rail": 2, "tube": len(shape.at), "ring": 1, "pin": 1}
    return [np.array(p) for p in shape.at[: places.get(shape.kind, 1)]]


@pytest.mark.parametrize("name", CASES)
def test_every_body_is_seen_and_reaches_its_joints(moved, name) -> None:
    motion = moved(name)
    scene: Scene = motion.scene
    shapes = link_shapes(scene, {})
    for i, own in enumerate(shapes.bodies):
        assert own, scene.bodies[i]
        numbers = np.array([x for s in own for p in s.at for x in p])
        assert np.isfinite(numbers).all()
    if scene.planar is None:
        for joint, hub in zip(scene.joints, shapes.hubs, strict=True):
            shown = [p for s in shapes.bodies[joint.bodies[0]] for p in _points(s)]
            nearest = min(np.linalg.norm(np.array(hub) - p) for p in shown)
            assert nearest < 0.2 * shapes.link, joint.name


def test_a_spatial_link_lies_along_the_common_perpendicular_of_its_axes(moved) -> None:
    motion = moved("bennett")
    shapes = link_shapes(motion.scene, {})
    for body, own in enumerate(shapes.bodies):
        (tube,) = (s for s in own if s.kind == "tube")
        ends = np.array([tube.at[0], tube.at[-1]])
        along = ends[1] - ends[0]
        for joint in motion.scene.joints:
            if body in joint.bodies:
                axis = joint.axis_in(joint.bodies.index(body))
                assert abs(along @ axis) < 1e-9


def see(page: str, folder: Path) -> dict:
    """What the page's own test saw in a browser without a network."""
    file = folder / "page.html"
    file.write_text(page, encoding="utf-8")
    command = [
        CHROMIUM,
        *FLAGS,
        "--host-resolver-rules=MAP * ~NOTFOUND",
        f"--user-data-dir={folder / 'profile'}",
        f"file://{file}#test",
    ]
    done = subprocess.run(command, capture_output=True, text=True, timeout=100, check=True)
    (seen,) = re.findall(r'data-seen="(.*?)"', done.stdout)
    return json.loads(html.unescape(seen))


@pytest.mark.slow
@pytest.mark.skipif(CHROMIUM is None, reason="Chromium is not here (apt-get install chromium)")
@pytest.mark.parametrize("name", CASES)
def test_a_page_plays_scrubs_and_drags_in_a_browser_without_a_network(
    moved, name, tmp_path
) -> None:
    motion = moved(name)
    seen = see(motion_page(motion, "title", "case.toml"), tmp_path)
    assert seen.pop("messages") == []
    assert seen.pop("colours") > 20
    assert seen.pop("requests") == 0
    assert seen.pop("circuits") == len(motion.circuits)
    assert seen.pop("rows") == seen.pop("frames") == len(motion.circuits[-1])
    told = ("played", "stopped", "scrubbed", "charted", "dragged", "keys", "chosen")
    assert seen == dict.fromkeys(told, True)


@pytest.mark.slow
@pytest.mark.skipif(CHROMIUM is None, reason="Chromium is not here (apt-get install chromium)")
def test_a_link_that_moves_little_in_the_picture_is_dragged_as_well(tmp_path) -> None:
    links = {
        "base": ("A", "D", 8),
        "crank": ("A", "B", 1),
        "coupler": ("B", "C", 7),
        "rocker": ("C", "D", 5),
    }
    motion = nag.motion(nag.Linkage.of(links, "base"), circuit="all", samples=120)
    assert len(motion.circuits) == 2
    seen = see(motion_page(motion, "title", "case.toml"), tmp_path)
    assert seen["messages"] == [] and seen["dragged"]


def five_bar(second: float, third: float, fourth: float) -> Linkage:
    links = {"base": ("A", "E", 3), "crank": ("A", "B", 2), "left": ("B", "C", second)}
    right = {"right": ("C", "D", third), "rocker": ("D", "E", fourth)}
    return Linkage.of(links | right, "base")


def replace_often(driven: DrivenMotion, times: int) -> DrivenMotion:
    """The same driven through its values again and again."""
    count = len(driven)
    again = [
        replace(c, first=c.first + k * count) for k in range(times) for c in driven.continuations
    ]
    return replace(
        driven,
        values=driven.values * times,
        motions=driven.motions * times,
        continuations=tuple(again),
    )


def test_crossings_of_a_driven_motion_name_the_circuits_at_their_value() -> None:
    # With the crank along the base a parallelogram is left, or four links as long together as one
    # and the other two: its circuits cross each other, or one itself; before, none does.
    values = [-np.pi / 3, 0.0]
    for lengths, words in (((2.5, 1, 2.5), "crosses circuit"), ((4, 2, 3), "crosses itself")):
        driven = nag.driven_motion(five_bar(*lengths), "A", values, samples=24)
        data = data_of(driven_page(driven, "five-bar", "five-bar"))
        texts = [c["text"] for each in data["circuits"] for c in each["crossings"]]
        assert texts and all(
            re.fullmatch(rf"{words}( [12])? at .* % of its length", text) for text in texts
        )


def test_frames_beyond_the_largest_sample_are_the_largest_number_there_is() -> None:
    grids = np.array([[-5.0, 0.5], [3.0, 0.0]])
    rows = np.array([[-2.6, -2.5, 0.0, 0.5 * (2**24 - 5)], [3.0, 3.0, 3.0, 3.0]])
    parts = np.frombuffer(base64.b64decode(_encode(rows, grids)), np.uint8).reshape(-1, 3)
    assert (parts @ [1, 256, 65536]).tolist() == [0, 0, 5, 2**24 - 1]


def test_many_circuits_have_fewer_frames_and_the_page_says_how_far_places_are_off() -> None:
    driven = nag.driven_motion(five_bar(2.5, 2.7, 1.8), "A", [0.0, 0.5, 1.0], samples=360)
    circuits = [(k, c) for k, motion in enumerate(driven) for c in motion.circuits]
    many = replace_often(driven, 25)
    page = driven_page(many, "five-bar", "five-bar")
    data = data_of(page)
    assert len(page.encode()) < 1_000_000 and len(data["circuits"]) == 25 * len(circuits) > 100
    (said,) = (text for name, text in data["facts"] if name == "frames")
    (off,) = (float(x) / 100 for x in re.findall(r"off by (\S+) % of a link at most", said))
    assert 0 < off <= 0.02
    points = [own for j in driven[0].scene.joints for own in zip(j.bodies, j.points, strict=True)]
    largest = 0.0
    for own, (_, circuit) in zip(data["circuits"], circuits, strict=False):
        rows = rows_of(data, own)
        for k, at in enumerate(np.linspace(0, own["frames"] - 1, len(circuit))):
            # The page's cubic through four frames.
            first = int(np.clip(int(at) - 1, 0, own["frames"] - 4))
            t = at - first
            weights = [np.prod([(t - j) / (i - j) for j in range(4) if j != i]) for i in range(4)]
            frame = rows[:, first : first + 4] @ weights
            for body, point in points:
                q = frame[4 * body : 4 * body + 4]
                z = (q[0] + 1j * q[3]) ** 2 * (point[0] + 1j * point[1]) / (q @ q)
                z += frame[20 + 3 * body] + 1j * frame[21 + 3 * body]
                x, y, _ = circuit.poses.move(body, point)[k]
                largest = max(largest, abs(z - x - 1j * y))
    assert largest / typical_length(driven[0].scene) == pytest.approx(off, rel=0.06)


def test_frames_tell_how_bodies_turn_where_all_joints_are_at_one_point(moved) -> None:
    motion = moved("spherical/four-bar")
    centre = motion.scene.joints[0].points[0]
    assert all(np.abs(j.points - centre).max() == 0 for j in motion.scene.joints)
    data = data_of(motion_page(motion, "title", "case.toml"))
    assert [c["frames"] for c in data["circuits"]] == [len(c) for c in motion.circuits]


def test_what_does_not_fit_in_a_page_is_to_be_driven_through_fewer_values() -> None:
    driven = nag.driven_motion(five_bar(2.5, 2.7, 1.8), "A", [0.0, 0.5, 1.0], samples=24)
    with pytest.raises(nag.NagError, match=r"fewer values, about \d+"):
        driven_page(replace_often(driven, 400), "five-bar", "five-bar")
