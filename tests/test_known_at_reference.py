"""What is too large to decompose does at its reference configuration what is known of it."""

from __future__ import annotations

import json
from fractions import Fraction
from itertools import combinations, product

import numpy as np
import pytest
from linkages import CASES
from solved import shipped

import nag
from nag.algebra.exact_ranks import null_space, rank
from nag.cli import main
from nag.mechanism.axes import cross, difference, dot
from nag.mechanism.framework import Framework, placed_framework
from nag.mechanism.mobility_report import MobilityStatus
from nag.report.agreement import AgreementKind, compare_at_reference

KNOWN = sorted(f"mobility/{path.stem}" for path in (CASES / "mobility").glob("*.toml"))
STEFFEN = ["ABF", "AEF", "ABP", "BCP", "CDP", "ADP", "ADE", "CDE"]
STEFFEN += ["EFQ", "CEQ", "CQR", "FQR", "BFR", "BCR"]
CONNELLY = ["ABC", "BCD", "ACE", "AEF", "CDP", "CPQ", "CEQ", "DFP", "FPQ"]
CONNELLY += ["EFQ", "BRT", "RST", "FST", "BDR", "DRS", "DFS", "AFT", "ABT"]
FACES = {"steffen": STEFFEN, "connelly": CONNELLY}
Point = tuple[Fraction, ...]


def framework(name: str) -> Framework:
    return shipped(name).assembly.framework


def places(name: str) -> dict[str, Point]:
    made = framework(name)
    return dict(zip(made.points, made.placement, strict=True))


@pytest.mark.parametrize("seed", [0, 1])
@pytest.mark.parametrize("name", KNOWN)
def test_dimensions_at_the_reference_are_those_that_are_known(name: str, seed: int) -> None:
    case = shipped(name)
    report = nag.mobility(case, detail="local", seed=seed)
    assert compare_at_reference(report, case.truth_at_reference) is AgreementKind.AGREES


@pytest.mark.parametrize(
    ("name", "body", "freedoms", "motion"),
    [
        ("delta", "platform", 3, "translation"),
        ("h4", "middle", 4, "translation and rotation (Schoenflies)"),
    ],
)
def test_a_robot_moves_its_platform_as_is_known(
    name: str, body: str, freedoms: int, motion: str
) -> None:
    report = nag.mobility(shipped(f"mobility/{name}"), detail="local", of=body)
    found = report.moving.body
    assert (found.motion.rank, found.motion.group) == (freedoms, motion)


@pytest.mark.parametrize("graph", ["k46", "k55"])
@pytest.mark.parametrize("on_quadric", [True, False])
def test_bipartite_frameworks_are_shaky_where_their_points_lie_on_a_quadric(
    graph: str, on_quadric: bool
) -> None:
    name = f"mobility/{graph}{'-on-quadric' if on_quadric else ''}"
    monomials = [
        [1, *p, *(p[i] * p[j] for i in range(3) for j in range(i, 3))]
        for p in places(name).values()
    ]
    assert rank(monomials) == (9 if on_quadric else 10)
    assert shipped(name).truth_at_reference.tangent_dimension == on_quadric


@pytest.mark.parametrize("name", [name for name in KNOWN if name.endswith("-on-quadric")])
def test_a_stress_forbids_shaky_frameworks_to_move(name: str) -> None:
    # Connelly & Whiteley, Second-order rigidity and prestress stability, 1996.
    made, at = framework(name), places(name)
    index = {point: 3 * i for i, point in enumerate(made.points)}
    rows = []
    for a, b in made.bars:
        row = [Fraction(0)] * (3 * len(index))
        for k, x in enumerate(difference(at[a], at[b])):
            row[index[a] + k], row[index[b] + k] = x, -x
        rows.append(row)
    # Nothing turns or is shifted where three points are held so.
    (a, b, c), held = made.points[:3], []
    for place, axes in ((a, (0, 1, 2)), (b, (1, 2)), (c, (2,))):
        for k in axes:
            held.append([Fraction(i == index[place] + k) for i in range(3 * len(index))])
    (velocity,) = null_space(rows + held, 3 * len(index))
    stresses = null_space([list(column) for column in zip(*rows, strict=True)], len(rows))

    def square(bar: tuple[str, str]) -> Fraction:
        first, second = (velocity[index[p] : index[p] + 3] for p in bar)
        gap = difference(first, second)
        return dot(gap, gap)

    assert any(sum(w * square(bar) for w, bar in zip(s, made.bars, strict=True)) for s in stresses)
    report = nag.mobility(shipped(name), budget=0)
    assert (report.status, report.components) == (MobilityStatus.SHAKY, ((0, 1),))


def volume(a: Point, b: Point, c: Point, d: Point) -> Fraction:
    return dot(difference(b, a), cross(difference(c, a), difference(d, a)))


def sign(x: Fraction) -> int:
    return (x > 0) - (x < 0)


def may_meet(ends: list[Point], triangle: list[Point]) -> bool:
    """Whether a segment meets a triangle; also where it lies in its plane."""
    p, q = ends
    a, b, c = triangle
    sides = [sign(volume(a, b, c, end)) for end in ends]
    if sides[0] * sides[1] > 0:
        return False
    turns = {sign(volume(p, q, *edge)) for edge in ((a, b), (b, c), (c, a))}
    return (not sides[0] and not sides[1]) or not {1, -1} <= turns


def cross_each_other(at: dict[str, Point], faces: list[str]) -> bool:
    """Whether two triangles have more in common than their corners and edges; also in a plane."""
    for one, other in combinations(faces, 2):
        common = set(one) & set(other)
        if len(common) == 2:
            if volume(*(at[p] for p in {*one, *other})) == 0:
                return True
            continue
        for face, cut in ((one, other), (other, one)):
            for edge in combinations(face, 2):
                if common.isdisjoint(edge) and may_meet(
                    [at[p] for p in edge], [at[p] for p in cut]
                ):
                    return True
    return False


@pytest.mark.parametrize("name", FACES)
def test_a_flexible_polyhedron_is_a_sphere_whose_faces_do_not_cross(name: str) -> None:
    at, made, faces = places(f"mobility/{name}"), framework(f"mobility/{name}"), FACES[name]
    edges = [frozenset(pair) for face in faces for pair in combinations(face, 2)]
    assert {frozenset(bar) for bar in made.bars} == set(edges)
    assert all(edges.count(edge) == 2 for edge in edges)
    assert len(at) - len(made.bars) + len(faces) == 2
    assert not cross_each_other(at, faces)


@pytest.mark.parametrize(
    ("name", "first", "second"),
    [
        ("steffen", "ABP", "CDE"),
        ("steffen", "FEQ", "CRB"),
        ("connelly", "ABC", "DEF"),
        # Two points in the mirror plane, two pairs of others.
        ("connelly", "CDE", "CQP"),
        ("connelly", "FDE", "FQP"),
        ("connelly", "DBF", "DSR"),
        ("connelly", "TBF", "TSR"),
    ],
)
def test_octahedra_of_flexible_polyhedra_are_symmetric(name: str, first: str, second: str) -> None:
    # A half turn or a mirror exchanges points: distances between all of them are so.
    at = places(f"mobility/{name}")
    image = dict(zip(first + second, second + first, strict=True))
    for p, q in combinations(image, 2):
        gap, turned = difference(at[p], at[q]), difference(at[image[p]], at[image[q]])
        assert dot(gap, gap) == dot(turned, turned)


@pytest.mark.parametrize("name", FACES)
def test_a_flexible_polyhedron_moves_without_crossing(name: str) -> None:
    """By Newton's method in doubles, from the reference to where a pair of points is elsewhere."""
    made, at = framework(f"mobility/{name}"), places(f"mobility/{name}")
    index = {point: k for k, point in enumerate(made.points)}
    i, j = np.array([(index[a], index[b]) for a, b in made.bars]).T
    start = np.array([[float(c) for c in at[p]] for p in made.points])
    squares = np.sum((start[i] - start[j]) ** 2, axis=1)

    def stretch(x: np.ndarray) -> np.ndarray:
        return np.sum((x[i] - x[j]) ** 2, axis=1) - squares

    def rigidity(x: np.ndarray) -> np.ndarray:
        rows, bars = np.zeros((len(i), len(x), 3)), np.arange(len(i))
        rows[bars, i], rows[bars, j] = 2 * (x[i] - x[j]), 2 * (x[j] - x[i])
        return rows.reshape(len(i), -1)

    def rank_of(x: np.ndarray) -> int:
        sizes = np.linalg.svd(rigidity(x), compute_uv=False)
        assert not ((sizes > 1e-12 * sizes[0]) & (sizes < 1e-5 * sizes[0])).any()
        return int((sizes > 1e-8 * sizes[0]).sum())

    assert rank_of(start) == 3 * len(start) - 7
    # The one freedom besides those of a body.
    center = start - start.mean(axis=0)
    whole = [np.cross(e, center) for e in np.eye(3)]
    whole += [np.tile(e, (len(start), 1)) for e in np.eye(3)]
    _, _, directions = np.linalg.svd(np.vstack([rigidity(start), np.reshape(whole, (6, -1))]))
    velocity = directions[-1].reshape(start.shape)
    x = start + velocity / np.abs(velocity).max()
    for _ in range(8):
        step, *_ = np.linalg.lstsq(rigidity(x), stretch(x), rcond=1e-8)
        x = x - step.reshape(x.shape)
    assert np.abs(stretch(x)).max() < 1e-12 * squares.max()
    assert rank_of(x) == 3 * len(start) - 7
    gaps = [np.linalg.norm(y[:, None] - y[None], axis=2) for y in (start, x)]
    assert np.abs(gaps[1] - gaps[0]).max() > 0.1
    assert not cross_each_other(dict(zip(made.points, x.tolist(), strict=True)), FACES[name])


@pytest.mark.parametrize("seed", [*range(10), 17])
def test_no_seed_finds_another_degree_of_the_motion_of_steffens_polyhedron(seed: int) -> None:
    report = nag.mobility(shipped("mobility/steffen"), seed=seed)
    ((dimension, degree),) = report.components
    assert (dimension, degree) == (1, 40) or (degree is None and report.least_degree <= 40)


def affine_cube() -> Framework:
    """Twelve edges and four diagonals of a parallelepiped: K(4, 4), its points on many quadrics."""
    corners = list(product((0, 1), repeat=3))
    edges = ((4, 1, 3), (-3, 5, 2), (1, -2, 6))
    sums = [
        [sum(c * e[i] for c, e in zip(v, edges, strict=True)) for i in range(3)] for v in corners
    ]
    points = {
        "".join(map(str, v)): tuple(map(Fraction, p)) for v, p in zip(corners, sums, strict=True)
    }
    apart = {
        (a, b): sum(x != y for x, y in zip(a, b, strict=True)) for a, b in combinations(points, 2)
    }
    bars = [pair for pair, k in apart.items() if k % 2]
    return placed_framework(3, points, bars)


def test_one_component_passes_through_a_singular_configuration_with_an_irreducible_cone() -> None:
    report = nag.mobility(affine_cube(), budget=0)
    assert (report.tangent_dimension, report.local_dimension) == (3, 2)
    assert (report.components, report.multiplicities, report.open) == (((2, None),), (1,), "")
    # Its one stress is definite on the tangents beside rigid motions: real ones end here.
    assert report.status is MobilityStatus.SHAKY and report.is_blocked and report.unreal == 2
    assert "tangent cone is irreducible" in report.rests_on


@pytest.mark.parametrize("name", ["mobility/3-rrr-stretched"])
def test_what_a_cone_shows_is_what_a_decomposition_finds(name: str) -> None:
    case = shipped(name)
    through, everything = nag.mobility(case), nag.mobility(case, detail="components")
    assert "cone" in through.rests_on and "decomposition" in everything.rests_on
    assert through.components == everything.components


def test_what_a_case_knows_of_its_reference_is_compared(capsys, tmp_path) -> None:
    case, file = CASES / "mobility" / "k46.toml", tmp_path / "k46.json"
    assert main(["mobility", str(case), "--local", "--quiet", "--json", str(file)]) == 0
    assert "agrees with what is known" in capsys.readouterr().out
    assert json.loads(file.read_text("utf-8"))["known"]["verdict"] == "agrees"
    wrong = tmp_path / "wrong.toml"
    text = case.read_text("utf-8").replace("tangent_dimension = 0", "tangent_dimension = 1")
    wrong.write_text(text, "utf-8")
    assert main(["mobility", str(wrong), "--local", "--quiet"]) == 1
    assert "differs from what is known" in capsys.readouterr().out
