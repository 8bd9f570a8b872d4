"""The mechanisms under `cases/` are the papers' own."""

import pytest
from linkages import CASES, case, exact

from nag.files.cases import read_case
from nag.mechanism.axes import cross, difference, dot, vanishes
from nag.mechanism.model import model
from nag.mechanism.quaternion import rotate
from nag.symbolic import bennett, bennett_geometry

OWN = exact("7/4", "5/6", "1/3")


def test_bennetts_case_has_the_geometry_of_lemmas_5_1_5_3_and_6_1():
    mechanism = case("bennett")
    joints = {j.name: j for j in mechanism.joints}
    for i, (point, axis) in enumerate(
        zip(bennett_geometry.points(OWN), bennett_geometry.axes(OWN), strict=True)
    ):
        assert joints[f"J{i}"].point == point
        assert joints[f"J{i}"].axis == axis
        assert joints[f"J{i}"].bodies == (f"B{(i - 1) % 4}", f"B{i}")
    for i, orientation in enumerate(bennett.orientations(OWN)):
        assert mechanism.orientation(f"B{i + 1}") == orientation


def test_bennetts_conditions_hold():
    joints = {j.name: j for j in case("bennett").joints}
    v = [difference(joints[f"J{(i + 1) % 4}"].point, joints[f"J{i}"].point) for i in range(4)]
    chi = [joints[f"J{i}"].axis for i in range(4)]
    assert all(dot(chi[i], v[i]) == dot(chi[i], v[i - 1]) == 0 for i in range(4))
    squares = [dot(x, x) for x in v]
    assert squares[0] == squares[2]
    assert squares[1] == squares[3]
    cosines = [dot(chi[i], chi[(i + 1) % 4]) for i in range(4)]
    assert cosines[0] == cosines[2]
    assert cosines[1] == cosines[3]
    assert squares[0] * (1 - cosines[1] ** 2) == squares[1] * (1 - cosines[0] ** 2)


@pytest.mark.parametrize("name", ["bennett", "bricard-cube"])
def test_the_first_axis_of_each_frame_lies_along_its_link(name):
    mechanism = case(name)
    joints = {j.name: j for j in mechanism.joints}
    n = len(joints)
    for i in range(1, n):
        link = difference(joints[f"J{(i + 1) % n}"].point, joints[f"J{i}"].point)
        along = rotate(mechanism.orientation(f"B{i}"), exact(1, 0, 0))
        assert vanishes(cross(link, along))
        assert dot(link, along) > 0


@pytest.mark.parametrize(
    ("name", "space", "formulation"),
    [
        ("bennett", "spatial", "H"),
        ("bricard-cube", "spatial", "H"),
        ("planar-four-bar", "planar", "H"),
    ],
)
def test_the_model_that_is_chosen(name, space, formulation):
    m = model(case(name))
    assert (m.space, m.formulation) == (space, formulation)
    assert m.reason.startswith(space)
    assert "\n" not in m.reason
    assert m.reason == model(case(name)).reason


@pytest.mark.parametrize("name", ["bennett", "bricard-cube", "planar-four-bar"])
def test_known_degrees_are_within_the_bounds_of_the_models(name):
    truth = read_case(CASES / f"{name}.toml").truth
    for formulation in ("E", "H"):
        m = model(case(name), formulation)
        known = [t for t in truth if t.formulation == formulation]
        assert known
        assert sum(t.count * t.degree * t.multiplicity for t in known) <= m.path_bound
        for t in known:
            # Orbits of the sign group have sizes that divide its order.
            if formulation == "E" and m.space != "planar":
                assert m.sign_group % t.count == 0
            if t.multidegree is not None:
                assert len(t.multidegree) == m.system.n
                assert sum(t.multidegree) == t.degree


def test_bennetts_parameters_may_be_changed(tmp_path):
    text = (CASES / "bennett.toml").read_text()
    for m in (exact(-2, "1/3", "3/5"), exact("11/5", "-7/2", 4)):
        changed = text
        for i, (old, new) in enumerate(zip(OWN, m, strict=True)):
            assert f'm{i} = "{old}"' in changed
            changed = changed.replace(f'm{i} = "{old}"', f'm{i} = "{new}"')
        path = tmp_path / "bennett.toml"
        path.write_text(changed)
        (equation,) = model(read_case(path).mechanism).system.polynomials
        assert equation.exact
        assert equation.degree == 2
