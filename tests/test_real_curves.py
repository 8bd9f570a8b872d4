"""Complete real curves: their pieces, vertices and arcs, against what is known of each."""

from __future__ import annotations

import json
from collections import Counter
from dataclasses import replace
from functools import cache
from math import inf
from pathlib import Path

import flint
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import nag
from nag.algebra.evaluation import Evaluator
from nag.numerics.digits import bits_of, in_bits
from nag.real.arcs import _begun_afar
from nag.real.closure import ProjectiveClosure
from nag.real.critical_points import find_critical_points
from nag.real.critical_values import UnclearDigitsError
from nag.real.curve import PieceKind, VertexKind
from nag.real.real_fibres import distances_of_conjugates, find_own_conjugates
from nag.tracking.run import DEFAULT_RUN

CASES = Path(__file__).parents[1] / "cases"
LOOP, NETWORK, OPEN, POINT = PieceKind
SINGULAR, ISOLATED, INFINITE = VertexKind

# Equations with the pieces and vertices of all their components together.
CURVES: dict[str, tuple[list[str], dict[PieceKind, int], dict[VertexKind, int], int]] = {
    "lemniscate": (["(x^2 + y^2)^2 - 2*(x^2 - y^2)"], {NETWORK: 1}, {SINGULAR: 1}, 2),
    "quadrifolium": (["(x^2 + y^2)^3 - 4*x^2*y^2"], {NETWORK: 1}, {SINGULAR: 1}, 4),
    "cubic with a point": (
        ["y^2 - x^2*(x - 1)"],
        {OPEN: 1, POINT: 1},
        {ISOLATED: 1, INFINITE: 1},
        1,
    ),
    "circle and points": (
        ["(x^2 + y^2 - 1)*((x^2 - 1)^2 + (y^2 - 1)^2)"],
        {LOOP: 1, POINT: 8},
        {ISOLATED: 8},
        1,
    ),
    "four ovals": (["(x^2 + 4*y^2 - 4)*(4*x^2 + y^2 - 4) + 1/10"], {LOOP: 4}, {}, 4),
    "Viviani": (
        ["x^2 + y^2 + z^2 - 4", "(x - 1)^2 + y^2 - 1"],
        {NETWORK: 1},
        {SINGULAR: 1},
        2,
    ),
    "cusp": (["y^2 - x^3"], {NETWORK: 1}, {SINGULAR: 1, INFINITE: 1}, 2),
    "twisted cubic": (["y - x^2", "z - x^3"], {OPEN: 1}, {INFINITE: 1}, 1),
    "hyperbola": (["x*y - 1"], {OPEN: 2}, {INFINITE: 2}, 2),
    "line": (["2*x + 3*y - 1"], {OPEN: 1}, {INFINITE: 1}, 1),
    "ellipse twice": (["(x^2 + 3*y^2 - 1)^2"], {LOOP: 1}, {}, 1),
    "tacnode": (["y^2 - x^4*(1 - x^2)"], {NETWORK: 1}, {SINGULAR: 1}, 2),
    "trifolium": (["(x^2 + y^2)^2 - x*(x^2 - 3*y^2)"], {NETWORK: 1}, {SINGULAR: 1}, 3),
    "deltoid": (
        ["(x^2 + y^2)^2 + 18*(x^2 + y^2) - 27 - 8*(x^3 - 3*x*y^2)"],
        {NETWORK: 1},
        {SINGULAR: 3},
        3,
    ),
    "ramphoid cusp": (["(y - x^2)^2 - x^5"], {NETWORK: 1}, {SINGULAR: 1, INFINITE: 1}, 2),
    "conchoid": (
        ["(x - 1)^2*(x^2 + y^2) - x^2/4"],
        {OPEN: 2, POINT: 1},
        {ISOLATED: 1, INFINITE: 1},
        2,
    ),
    # Robinson 1973: an irreducible sextic, nowhere negative, with ten zeros, two of them infinite.
    "Robinson": (
        ["x^6 + y^6 + 1 - x^4*y^2 - x^4 - y^4*x^2 - y^4 - x^2 - y^2 + 3*x^2*y^2"],
        {POINT: 8},
        {ISOLATED: 8},
        0,
    ),
    "no real points": (["x^2 + y^2 + 1"], {}, {}, 0),
    "cubic with an oval": (["y^2 - x^3 + x"], {LOOP: 1, OPEN: 1}, {INFINITE: 1}, 2),
}
# The same of mechanisms.
MECHANISMS = {
    "bennett": ({LOOP: 1}, {}, 1),
    "planar/four-bar-folding": ({NETWORK: 1}, {SINGULAR: 1}, 2),
    "planar/four-bar-rhombus": ({LOOP: 3}, {}, 3),
    "planar/slider-crank": ({LOOP: 2}, {}, 2),
}


def real_curves(answer: nag.Decomposition, seed: int = 0) -> list[nag.RealCurve]:
    return [nag.find_real_curve(c, seed=seed) for c in answer.components]


@cache
def of_equations(name: str) -> tuple[nag.Decomposition, list[nag.RealCurve]]:
    answer = nag.decompose(CURVES[name][0])
    return answer, real_curves(answer)


@cache
def of_case(name: str) -> tuple[nag.Decomposition, list[nag.RealCurve]]:
    answer = nag.decompose(nag.read_case(CASES / f"{name}.toml"))
    return answer, real_curves(answer)


def counted(curves: list[nag.RealCurve]) -> tuple[dict, dict, int]:
    pieces = Counter(piece.kind for curve in curves for piece in curve.pieces)
    kinds = Counter(vertex.kind for curve in curves for vertex in curve.vertices)
    return dict(pieces), dict(kinds), sum(len(curve.edges) for curve in curves)


@pytest.mark.parametrize("name", CURVES)
def test_curves_have_the_pieces_that_are_known(name: str) -> None:
    _, curves = of_equations(name)
    assert all(curve.complete for curve in curves)
    assert counted(curves) == CURVES[name][1:]


@pytest.mark.parametrize("name", MECHANISMS)
def test_mechanisms_have_the_circuits_that_are_known(name: str) -> None:
    _, curves = of_case(name)
    assert all(curve.complete for curve in curves)
    # Where components of a mechanism meet, the equations are singular on each.
    pieces, _, _ = counted(curves)
    assert sum(pieces.values()) == sum(MECHANISMS[name][0].values())


@pytest.mark.parametrize("name", CURVES)
def test_arcs_are_dense_ordered_and_on_the_curve(name: str) -> None:
    answer, curves = of_equations(name)
    evaluator = Evaluator.of(answer.system.polynomials, answer.system.n)
    for curve in curves:
        for edge in curve.edges:
            assert evaluator.residuals(edge.points + 0j).max() < 1e-13
            # On the sphere on which infinity is a point like others.
            lifted = np.hstack([np.ones((len(edge), 1)), edge.points])
            lifted /= np.linalg.norm(lifted, axis=1)[:, None]
            chords = np.diff(lifted, axis=0)
            lengths = np.linalg.norm(chords, axis=1)
            assert lengths.max() < 0.1
            assert lengths.min() > 1e-6
            cosines = (chords[1:] * chords[:-1]).sum(axis=1) / lengths[1:] / lengths[:-1]
            assert cosines.min() > 0.95


@pytest.mark.parametrize("name", CURVES)
def test_arcs_begin_and_end_at_their_vertices(name: str) -> None:
    for curve in of_equations(name)[1]:
        for edge in curve.edges:
            if edge.closed:
                assert edge.end is None
                assert np.array_equal(edge.points[0], edge.points[-1])
            for v, at in ((edge.start, edge.points[0]), (edge.end, edge.points[-1])):
                if v is not None and curve.vertices[v].kind is not INFINITE:
                    assert np.array_equal(curve.vertices[v].point, at)


@pytest.mark.parametrize("name", CURVES)
def test_every_vertex_has_even_degree(name: str) -> None:
    for curve in of_equations(name)[1]:
        assert all(degree % 2 == 0 for _, degree in curve.graph.degree())
        assert curve.graph.number_of_edges() == len(curve.edges)


def test_vertices_are_where_they_are_known_to_be() -> None:
    (cubic,) = of_equations("cubic with a point")[1]
    (isolated,) = (v for v in cubic.vertices if v.kind is ISOLATED)
    assert np.abs(isolated.point).max() < 1e-15
    (viviani,) = of_equations("Viviani")[1]
    assert np.abs(viviani.vertices[0].point - [2, 0, 0]).max() < 1e-15
    points = [v.point for c in of_equations("circle and points")[1] for v in c.vertices]
    corners = sorted(tuple(np.round(p, 12)) for p in points)
    assert corners == sorted(2 * [(a, b) for a in (-1.0, 1.0) for b in (-1.0, 1.0)])
    (parabola,) = real_curves(nag.decompose("y - x^2"))
    assert np.abs(np.abs(parabola.vertices[0].point) - [0, 1]).max() < 1e-12


@pytest.mark.parametrize("seed", range(1, 4))
@pytest.mark.parametrize("name", ["lemniscate", "four ovals", "cusp", "cubic with an oval"])
def test_the_projection_does_not_matter(name: str, seed: int) -> None:
    answer, curves = of_equations(name)
    others = real_curves(answer, seed)
    assert counted(others) == counted(curves)
    lengths = [
        sorted(
            np.linalg.norm(np.diff(e.points, axis=0), axis=1).sum() for c in some for e in c.edges
        )
        for some in (curves, others)
    ]
    if not any(v.kind is INFINITE for c in curves for v in c.vertices):
        # Polygons with corners on the curve are shorter by the square of their turns.
        assert np.allclose(*lengths, rtol=1e-2)


def test_points_where_other_components_are_met_are_known() -> None:
    for curve in real_curves(nag.decompose("(x^2 + y^2 - 1)*(x - y)")):
        assert np.allclose(np.sort(curve.meetings[:, 0]), [-np.sqrt(0.5), np.sqrt(0.5)], atol=1e-14)
    (lemniscate,) = of_equations("lemniscate")[1]
    assert lemniscate.meetings.shape == (0, 2)
    # The flat positions of a rhombus: each of the three motions meets both others.
    _, curves = of_case("planar/four-bar-rhombus")
    assert [len(curve.meetings) for curve in curves] == [2, 2, 2]


def test_infinity_is_no_place_of_a_curve_in_an_affine_space() -> None:
    # What must not vanish says of a turn only that its infinity is a value like others.
    system = nag.system("x*y - 1")
    excluding = replace(system, nonzero=nag.system("x^2 + y^2 + 1").polynomials)
    (curve,) = real_curves(nag.decompose(excluding))
    assert counted([curve]) == ({OPEN: 2}, {INFINITE: 2}, 2)


def test_half_angles_pass_through_infinity() -> None:
    _, (curve,) = of_case("bennett")
    (edge,) = curve.edges
    assert len(curve.turns) == 2
    # Both joints turn fully: half-angles by half a turn.
    assert np.allclose(np.abs(edge.chart[-1] - edge.chart[0]), np.pi, atol=1e-12)
    assert np.abs(np.diff(edge.chart, axis=0)).max() < 0.5
    for turn in curve.turns:
        y = edge.points[:, turn.variable]
        tangents = np.tan(edge.chart[:, turn.variable])
        near = np.abs(y) < 10
        assert np.allclose(turn.centre + turn.radius * tangents[near], y[near])


def grashof(lengths: list[int]) -> int | None:
    """Circuits of a four-bar that closes; None where it folds, or does not close."""
    ordered = sorted(lengths)
    if ordered[3] >= sum(ordered[:3]) or ordered[0] + ordered[3] == ordered[1] + ordered[2]:
        return None
    return 2 if ordered[0] + ordered[3] < ordered[1] + ordered[2] else 1


def four_bar(lengths: list[int]) -> nag.Decomposition:
    """Crank, coupler, rocker and ground, in points of the pins."""
    a, b, c, g = lengths
    return nag.decompose(
        [f"x^2 + y^2 - {a}^2", f"(x - u)^2 + (y - v)^2 - {b}^2", f"(u - {g})^2 + v^2 - {c}^2"]
    )


@settings(max_examples=5, deadline=None, derandomize=True)
@given(st.lists(st.integers(2, 12), min_size=4, max_size=4).filter(lambda ls: grashof(ls)))
def test_four_bars_have_the_circuits_of_grashofs_rule(lengths: list[int]) -> None:
    curves = real_curves(four_bar(lengths))
    assert all(curve.complete for curve in curves)
    assert counted(curves) == ({LOOP: grashof(lengths)}, {}, grashof(lengths))


def test_a_linkage_that_cannot_be_assembled_has_no_real_points() -> None:
    (curve,) = real_curves(four_bar([2, 2, 3, 9]))
    assert curve.complete and not curve.pieces
    assert "no real points" in str(curve)


def test_a_surface_is_refused_in_one_line() -> None:
    plane = nag.decompose("x + y + z").components[0]
    with pytest.raises(nag.NagError, match="dimension 2; a curve has 1"):
        nag.find_real_curve(plane)


def test_curves_of_multiplicity_are_right_or_refused() -> None:
    (line,) = real_curves(nag.decompose(["x^2 - 2*x*y + y^2"]))
    assert counted([line]) == ({OPEN: 1}, {INFINITE: 1}, 1)
    double = nag.decompose(["x^2 + y^2 + z^2 - 1", "x^2 + y^2 - 1"]).components[0]
    with pytest.raises(nag.ComponentError, match="not reduced"):
        nag.find_real_curve(double)


def test_rounding_does_not_choose_where_a_loop_begins() -> None:
    # All points of the unit circle are as far from infinity.
    circle = nag.system("x^2 + y^2 - 1")
    closure = ProjectiveClosure.of(circle.polynomials, circle, np.array([1.0, 0.5]))
    angles = np.linspace(0, 2 * np.pi, 50)
    exact = closure.homogeneous(np.stack([np.cos(angles), np.sin(angles)], axis=1))
    for seed in range(3):
        off = 1e-15 * np.random.default_rng(seed).normal(size=exact.shape)
        assert np.abs(_begun_afar(closure, exact + off) - exact).max() < 1e-13


def test_documents_are_json_and_runs_repeat() -> None:
    answer, (curve,) = of_equations("lemniscate")
    again = nag.find_real_curve(answer.components[0])
    assert again == curve
    assert json.loads(json.dumps(curve.document())) == again.document()
    assert [len(row) for row in curve.rows()] == [5, 5]


@given(st.integers(10, 80), st.booleans())
@settings(max_examples=20, deadline=None)
def test_two_points_of_a_fibre_however_close_are_real_or_conjugate(order: int, real: bool) -> None:
    """As far apart as 1e-80, which doubles do not show."""
    small, other = flint.arb(10) ** -order, [flint.acb(3), flint.acb(-1)]
    near = flint.acb(small) if real else flint.acb(0, small)
    fibre = [[1 + sign * near, flint.acb(2)] for sign in (1, -1)]
    with in_bits(bits_of(200)):
        found = find_own_conjugates(distances_of_conjugates([*fibre, other]))
    assert found.tolist() == [real, real, True]


def test_points_that_are_not_conjugate_in_pairs_are_not_judged() -> None:
    with pytest.raises(UnclearDigitsError):
        find_own_conjugates(np.array([[1.0, 0.1, 2.0], [1.0, 1.0, 0.1], [0.1, 2.0, 1.0]]))


@pytest.mark.parametrize(
    "equations",
    ["(x^2 + 2*y^2 - 1)^2 + 1/10^12", ["x^2 + y^2 - z", "(z - 1)^2 + 1/10^12"]],
)
def test_curves_that_are_nearly_real_have_no_real_points(equations) -> None:
    """Where points only seem to come together more digits are taken."""
    for curve in real_curves(nag.decompose(equations)):
        assert curve.complete and not curve.vertices and not curve.edges


BY_PATHS_TOO = [*CURVES, "planar/four-bar", "bricard-cube", "planar/watt-six-bar"]


@pytest.mark.parametrize("name", BY_PATHS_TOO)
def test_paths_find_the_critical_values_that_fibres_in_many_digits_have(name: str) -> None:
    problem = CURVES[name][0] if name in CURVES else nag.read_case(CASES / f"{name}.toml")
    for component in nag.decompose(problem).components:
        curves = []
        for most in (inf, -1):
            with pytest.MonkeyPatch.context() as patch:
                patch.setattr("nag.real.find_curve.MOST_SAMPLED", most)
                curves.append(nag.find_real_curve(component))
        assert all(curve.complete for curve in curves)
        assert counted(curves[:1]) == counted(curves[1:])
        values = [np.array(curve.critical_values) for curve in curves]
        # Of a curve without any some other value stands there.
        if counted(curves[:1]) != ({}, {}, 0) and len(values[0]) > 1:
            assert len(values[0]) == len(values[1]) and np.allclose(*values, rtol=1e-9, atol=1e-9)


def test_critical_points_are_as_many_as_the_determinant_has_zeros() -> None:
    """A lemniscate: its determinant is a cubic, its node worth two, its ends of high order."""
    (component,) = nag.decompose(CURVES["lemniscate"][0]).components
    form, rng = np.array([0.75, -0.625]), np.random.default_rng(0)
    equations = component._known_system().polynomials
    found = find_critical_points(component.fibres, equations, (), form, rng, DEFAULT_RUN)
    assert int(found.multiplicities.sum()) + found.infinite == 4 * 3
    (node,) = np.flatnonzero(np.linalg.norm(found.points, axis=1) < 1e-12)
    assert found.multiplicities[node] == 2 and found.real[node]
    assert Evaluator.of(equations, 2).residuals(found.points).max() < 1e-13


def test_critical_points_are_found_whatever_the_equations_are_multiplied_by() -> None:
    plain = ["x^4 + y^4 + z^2*x - 2*y - 1", "x*y*z^2 + z - 3*x + y^3 + 1/2"]
    answer = nag.decompose(plain)
    (component,) = answer.components
    form, found = np.array([0.7, -0.6, 0.9]), []
    for size in (1, 10**14):
        equations = [f * size for f in answer.system.polynomials]
        rng = np.random.default_rng(0)
        own = find_critical_points(component.fibres, equations, (), form, rng, DEFAULT_RUN)
        found.append(sorted(own.points[own.real].real.round(6).tolist()))
    assert found[0] and found[0] == found[1]


def test_a_shaft_between_universal_joints_has_all_of_its_circuits() -> None:
    answer = nag.decompose(nag.read_case(CASES / "spatial/universal-shaft.toml"))
    (curve,) = real_curves(answer)
    assert curve.complete and counted([curve]) == ({LOOP: 6}, {}, 6)
    assert curve.residual < 1e-14


@pytest.mark.parametrize("gap", ["1/10^4", "1/10^6", "1/10^8", "1/10^10"])
def test_loops_that_nearly_meet_are_not_joined(gap: str) -> None:
    # Viviani's window, moved off the node by so little: the loops are twice its root apart.
    (window,) = nag.decompose(["x^2 + y^2 + z^2 = 4", f"(x - 1 + {gap})^2 + y^2 = 1"])
    for seed in range(4):
        curve = nag.find_real_curve(window, seed=seed)
        assert str(curve.verdict) == "complete"
        assert [piece.kind for piece in curve.pieces] == [PieceKind.CLOSED_LOOP] * 2
        heights = [np.sign(edge.points[:, 2]) for edge in curve.edges]
        assert sorted(h[0] for h in heights) == [-1, 1] and all((h == h[0]).all() for h in heights)
