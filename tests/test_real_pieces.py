"""Whether components have real points: at least one on each piece, none found, or none at all."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from fractions import Fraction

import jsonschema
import numpy as np
import pytest
from linkages import CASES

import nag
from nag.cli import main
from nag.files.json_schema import schema
from nag.mechanism.framework_model import cartesian_model
from nag.real.real_pieces import Reality
from nag.real.real_samples import NoRealPointsError, sample_real

FOUND, NONE_FOUND, NONE = Reality.FOUND, Reality.NONE_FOUND, Reality.NONE


def pieces(*equations: str, seed: int = 0) -> list[nag.RealPieces]:
    return [nag.find_real_points(c, seed=seed) for c in nag.decompose(list(equations)).components]


# Components in the order of answers: whether they have real points.
KNOWN = {
    "sphere": (["x^2 + y^2 + z^2 = 1"], [FOUND]),
    "imaginary sphere": (["x^2 + y^2 + z^2 = -1"], [NONE]),
    "Fermat quartic": (["x^4 + y^4 + z^4 + 1"], [NONE]),
    "two points and none": (["(x^2 - 2)*(x^2 + 2)", "y = x"], [FOUND, FOUND, NONE, NONE]),
    "circles": (["(x^2 + y^2 - 1)*(x^2 + y^2 + 1)"], [FOUND, NONE]),
    "conjugate lines": (["x^2 + y^2"], [FOUND, FOUND]),
    "quadrics in space": (["x^2 + y^2 + z^2 + w^2 = 1", "x*y = z*w"], [FOUND]),
}


@pytest.mark.parametrize("name", KNOWN)
def test_components_have_real_points_where_they_are_known_to(name: str) -> None:
    equations, known = KNOWN[name]
    assert sorted(each.reality for each in pieces(*equations)) == sorted(known)


@pytest.mark.parametrize("seed", range(3))
def test_every_sheet_of_a_surface_has_a_point(seed: int) -> None:
    (found,) = pieces("x*y*z = 1", seed=seed)
    assert found.each_piece and set(found.dimensions) == {2}
    assert np.abs(found.points.prod(axis=1) - 1).max() < 1e-12
    signs = {tuple(s) for s in np.sign(found.points).astype(int).tolist()}
    assert signs == {(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)}


def test_a_point_that_is_nearest_because_it_is_singular_is_not_left_out_silently() -> None:
    # A double cone, and a real point on a surface that is otherwise complex.
    (cone,) = pieces("x^2 + y^2 = z^2")
    assert cone.reality is FOUND and not cone.each_piece
    (point,) = pieces("x^2 + y^2 + z^2*(1 + z^2) = 0")
    assert point.reality is not NONE


def test_several_points_of_a_piece_are_not_told_as_one_on_each() -> None:
    (sphere,) = pieces("x^2 + y^2 + z^2 = 1")
    assert len(sphere) == 2
    assert "2 real points, at least one on each connected piece" in str(sphere)
    (cone,) = pieces("x^2 + y^2 = z^2")
    assert "perhaps not on each connected piece" in str(cone)


def test_the_finite_and_the_one_dimensional_are_complete() -> None:
    (oval,) = pieces("y^2 = x^3 - x")
    assert oval.each_piece and oval.dimensions == (1, 1)
    (cubic,) = pieces("y^2 = x^2*(x - 1)")
    assert sorted(cubic.dimensions) == [0, 1]


def test_peaucelliers_inversor_is_real_where_its_rhombus_folds() -> None:
    case = nag.read_case("cases/planar/peaucellier.toml")
    answer = nag.decompose(cartesian_model(case.assembly.framework))
    curves = [c for c in answer.components if c.dimension == 1]
    assert len(curves) == 2
    ends = []
    for curve in curves:
        found = nag.find_real_points(curve)
        assert found.reality is FOUND and found.dimensions == (0,)
        # OB - BC = 3 = 2 OA: the ends of the rhombus fall together, at distances in units of OA.
        x = dict(zip(answer.system.variables, found.points[0].tolist(), strict=True))
        assert np.hypot(x["x_C"], x["y_C"]) == pytest.approx(2, abs=1e-12)
        ends.append(np.hypot(x["x_P"], x["y_P"]))
    # The inverse of C, and C itself.
    assert sorted(ends) == pytest.approx([2, 14 / 3], abs=1e-12)


@pytest.mark.parametrize(
    "equations",
    [
        ["(x^2 - 2)^2 + 1/10^240", "y^2 - x"],
        ["(x - 1)^2 + 1/10^120", "y^2 - x"],
        ["(x - 1)^2 + 1/10^180", "y^2 - x"],
        ["(x - 1)^2 + 1/10^240", "y^2 - x"],
    ],
)
def test_points_that_are_not_known_to_be_real_are_not_among_the_real_ones(
    equations: list[str],
) -> None:
    for component in nag.decompose(equations).components:
        found = nag.find_real_points(component)
        assert len(found) == 0 and found.each_piece == (found.reality is NONE)
        with pytest.raises(nag.NagError, match="real points: none"):
            sample_real(component, 2)


def test_samples_say_that_points_they_are_drawn_from_may_be_missing() -> None:
    """Two real points, and two of which that is not known, as one finite set."""
    components = nag.decompose(["((x - 1)^2 + 1/10^120)*(x^2 - 2)", "y"]).components
    together = replace(
        components[0],
        points=np.vstack([c.points for c in components]),
        digits=np.concatenate([c.digits for c in components]),
        radii=np.vstack([c.radii for c in components]),
        fibres=(),
    )
    found = nag.find_real_points(together)
    assert (len(found), found.reality, found.each_piece) == (2, FOUND, False)
    samples = sample_real(together, 5)
    assert np.abs(samples.points[:, 0] ** 2 - 2).max() < 1e-12
    assert "whether a point is real is not known" in samples.doubt
    assert samples.doubt in str(samples)


@pytest.mark.parametrize("equations", [["x^2 + y^2 = 1"], ["x*y*z = 1"], ["x^2 = 2", "y = x"]])
def test_real_samples_are_real_and_on_the_component(equations: list[str]) -> None:
    answer = nag.decompose(equations)
    component = answer.components[0]
    samples = sample_real(component, 5)
    assert samples.points.shape == (5, answer.system.n)
    assert np.array_equal(samples.points.imag, np.zeros_like(samples.points.imag))
    assert samples.residual < 1e-12
    assert all(component.contains(x) for x in samples.points)
    assert sample_real(component, 5) == samples


@pytest.mark.parametrize(
    ("equation", "dimension", "known"),
    [
        ("x*y*z - 1", 2, {2}),
        # Conjugate surfaces that meet in a circle; a line of singular points.
        ("(x^2 + y^2 + z^2 - 1)^2 + (x - y)^2", 2, {1}),
        ("x^2 + y^2*(1 + z^2)", 2, {-1}),
        # An oval with a point beside it: samples are drawn from arcs.
        ("y^2 - x^2*(x - 1)", 1, {1}),
        ("x^2 + y^2", 1, {0}),
    ],
)
def test_real_samples_tell_the_real_dimension_from_the_complex_one(
    equation: str, dimension: int, known: set[int]
) -> None:
    for component in nag.decompose(equation):
        drawn = nag.sample(component, count=3, real=True)
        assert component.dimension == dimension and set(drawn.real_dimensions) == known
        assert len(drawn.real_dimensions) == 3
    assert not nag.sample(component, count=3).real_dimensions


def test_the_prompt_tells_complex_and_real_dimension_apart(tmp_path, capsys) -> None:
    listed = 'variables = ["x", "y", "z"]\nequations = ["{}"]\n'
    file, out = tmp_path / "set.toml", tmp_path / "out.json"
    for equation, told, known in (
        ("(x^2 + y^2 + z^2 - 1)^2 + (x - y)^2", "1", 1),
        ("x^2 + y^2*(1 + z^2)", "not known", None),
    ):
        file.write_text('title = "t"\nkind = "system"\n' + listed.format(equation))
        words = ["sample", str(file), "--real", "--count", "2", "--quiet", "--json", str(out)]
        assert main(words) == 0
        text = capsys.readouterr().out
        assert "complex dimension 2" in text and f"real dimension {told}\n" in text
        assert len(re.findall(rf"^ +[12] .* {told}$", text, re.MULTILINE)) == 2
        document = json.loads(out.read_text())
        assert document["real_dimensions"] == [known] * 2
        jsonschema.validate(document, schema("nag-samples"))


def test_real_samples_of_a_ball_joint_are_spread_as_its_unit_quaternions_are() -> None:
    """It turns about an axis: what is infinite in the chart are a few half turns like others."""
    group = {"groups": [("a", "b", "c")], "nonzero": "1 + a^2 + b^2 + c^2"}
    system = nag.system(["a - c", "2*b - 1"], "a b c", **group)
    (component,) = nag.decompose(system).components
    c = sample_real(component, 400).points[:, 2].real
    halves = np.arctan2(np.sqrt(2) * c, np.sqrt(5 / 4))
    assert np.quantile(halves, [0.25, 0.5, 0.75]) == pytest.approx(
        [-np.pi / 4, 0, np.pi / 4], abs=0.15
    )


def test_real_samples_do_not_pile_up_where_a_curve_goes_to_infinity() -> None:
    (hyperbola,) = nag.decompose("x*y = 1").components
    x = np.abs(sample_real(hyperbola, 400).points[:, 0])
    # The same with the variables exchanged.
    assert np.mean(x < 1) == pytest.approx(0.5, abs=0.1)
    assert np.mean((x > 1 / 4) & (x < 4)) > 0.5


def test_real_samples_are_asked_for_at_the_prompt(tmp_path, capsys) -> None:
    text = 'title = "t"\nkind = "system"\nvariables = ["x", "y"]\nequations = ["x^2 + y^2 = {}"]\n'
    file, out = tmp_path / "circle.toml", tmp_path / "out.json"
    file.write_text(text.format(1))
    assert main(["sample", str(file), "--real", "--count", "4", "--json", str(out)]) == 0
    points = np.array(json.loads(out.read_text())["points"])
    assert np.abs((points[..., 0] ** 2).sum(axis=1) - 1).max() < 1e-12
    assert not points[..., 1].any()
    file.write_text(text.format(-1))
    # Not a mistake: that there are none is an answer.
    capsys.readouterr()
    assert main(["sample", str(file), "--real", "--quiet", "--json", str(out)]) == 0
    told = capsys.readouterr()
    assert "answer     real points: none, proved" in told.out and not told.err
    document = json.loads(out.read_text())
    assert document["points"] == [] and document["complete"]
    jsonschema.validate(document, schema("nag-samples"))


def test_where_none_is_found_the_command_says_so_and_is_not_complete(tmp_path, capsys) -> None:
    file, out = tmp_path / "none.txt", tmp_path / "out.json"
    listed = 'variables = ["x", "y"]\nequations = ["(x - 1)^2 + 1/10^120", "y^2 - x"]\n'
    file.write_text(f'title = "t"\nkind = "system"\n{listed}')
    assert main(["sample", str(file), "--real", "--quiet", "--json", str(out)]) == 1
    told = capsys.readouterr()
    assert "open       real points: none found" in told.out and not told.err
    document = json.loads(out.read_text())
    assert document["points"] == [] and not document["complete"]


def test_lengths_that_forbid_assemblies_prove_that_none_is_real(tmp_path, capsys) -> None:
    # A side that is longer than five others together: too many nearest points to find them all.
    links = "".join(
        f'[[link]]\nname = "{name}"\npins = ["{a}", "{b}"]\nlength = {length}\n'
        for name, a, b, length in zip(
            "abcdef", "ABCDEF", "BCDEFA", (20, 2, 3, 4, 2, 3), strict=True
        )
    )
    case, out = tmp_path / "open.toml", tmp_path / "out.json"
    case.write_text(f'title = "t"\nkind = "linkage"\nground = "a"\n{links}')
    assert main(["sample", str(case), "--real", "--quiet", "--json", str(out)]) == 0
    assert "real points: none, proved: link a is longer than" in capsys.readouterr().out
    assert json.loads(out.read_text())["complete"]
    with pytest.raises(NoRealPointsError, match="none, proved: link a is longer than"):
        nag.sample(case, real=True)
    found = nag.find_real_points(case)
    assert (
        found.reality is NONE and found.each_piece and found.reason.startswith("link a is longer")
    )


def test_none_is_drawn_where_there_is_none() -> None:
    (sphere,) = nag.decompose("x^2 + y^2 + z^2 = -1").components
    with pytest.raises(NoRealPointsError, match="none, proved"):
        sample_real(sphere, 1)


@pytest.mark.parametrize(
    ("equations", "variables", "dimensions"),
    [
        # Conjugate sets that do not meet.
        (["(x*y + z)^2 + 1"], "x y z", []),
        (["x^2 + 1", "y^2 + z^2*w"], "x y z w", []),
        # Conjugate planes through a line; surfaces that meet in two lines, and in a circle.
        (["x^2 + y^2"], "x y z", [1]),
        (["x^2 + y^2*z^2"], "x y z", [1, 1]),
        (["x^2 + (y^2 + z^2 - 1)^2"], "x y z", [1]),
        # Which meet in a curve without real points.
        (["x^2 + (y^2 + z^2 + 1)^2"], "x y z", []),
    ],
)
def test_sets_that_are_not_their_conjugates_have_real_points_where_they_meet(
    equations: list[str], variables: str, dimensions: list[int]
) -> None:
    components = nag.decompose(nag.system(equations, variables)).components
    assert len(components) == 2
    for component in components:
        found = nag.find_real_points(component)
        assert found.each_piece and sorted(found.dimensions) == dimensions
        assert (found.reality is Reality.NONE) == (not dimensions)


def test_real_points_of_a_framework_are_those_of_its_points_not_of_isotropic_coordinates() -> None:
    case = nag.read_case(CASES / "planar" / "peaucellier.toml")
    found = nag.decompose(case)
    assert found.system.isotropic
    for ask in (nag.find_real_points, nag.find_real_curve):
        with pytest.raises(nag.NagError, match="isotropic"):
            ask(found.components[1])
    # Its sides are stretched: asked for are the components of the real assemblies.
    drawn = nag.sample(case, 1, count=1, real=True)
    # Bars O-A and A-C in line reach just as far as O-B and B-C folded: in units of O-A the points
    # C, B and D are at 2, and 10/3 and 10/3.
    assert np.abs(drawn.points[0, :6] - [10 / 3, 0, 2, 0, 10 / 3, 0]).max() < 1e-12


def test_exports_say_that_coordinates_are_isotropic(tmp_path) -> None:
    found = nag.decompose(nag.read_case(CASES / "planar" / "peaucellier.toml"))
    file = tmp_path / "export.json"
    nag.write(found, file)
    assert nag.read(file).system.isotropic
    assert main(["sample", str(file), "--real"]) == 2


def test_a_stretched_inversor_moves_where_its_rhombus_is_folded(capsys) -> None:
    assert main(["decompose", str(CASES / "planar" / "peaucellier.toml")]) == 0
    text = " ".join(capsys.readouterr().out.split())
    # Where the rhombus is folded onto itself, its end P turns about the other two.
    assert "so placed it moves with 1 freedom; a real one was found" in text
    assert "bar O-B is as long as bar O-A, bar B-C and bar A-C together" in text


@pytest.mark.parametrize(
    ("equation", "singular"),
    [
        ("x^2 + y^2", (0, 0)),
        ("x^2 + y^2 + z^2", (0, 0, 0)),
        ("x^4 + y^6", (0, 0)),
        ("(x - 1/3)^2 + (y - sqrt(2))^2", (1 / 3, 2**0.5)),
    ],
)
def test_real_samples_at_a_singular_point_are_as_accurate_as_they_say(
    equation: str, singular: tuple[float, ...]
) -> None:
    for component in nag.decompose(equation):
        found = nag.sample(component, count=3, real=True)
        away = np.linalg.norm(found.points - np.array(singular), axis=1).max()
        # The point that is compared with is itself a rounded one.
        assert away <= found.accuracy * (1 + np.linalg.norm(singular)) <= 1e-15


def test_real_samples_near_a_cusp_are_as_accurate_as_they_say() -> None:
    found = nag.sample(nag.decompose("y^2 - x^3")[0], count=200, real=True)
    far = [
        abs(Fraction(y) ** 2 - Fraction(x) ** 3) / Fraction(float(np.hypot(2 * y, 3 * x * x)))
        for x, y in found.points.real
        if x
    ]
    assert 0 < max(far) <= found.accuracy * (1 + np.abs(found.points).max())
    assert found.accuracy < 1e-12
