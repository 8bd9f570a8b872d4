"""What makes no sense as an argument is refused in one line that names it and says what would."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import networkx
import numpy as np
import pandas
import pytest

import nag
import nag.decomposition as D
from nag.decomposition.decompose import decompose
from nag.witness.membership import memberships

ROOT = Path(__file__).parent.parent
NAN = float("nan")


@cache
def case() -> Any:
    return nag.read_case(ROOT / "cases" / "bennett.toml")


@cache
def answer() -> Any:
    return nag.decompose("x*y*(x^2 + y^2 - 1)")


@cache
def line() -> Any:
    return answer().components[0]


@cache
def roots() -> Any:
    return nag.solve("x^2 = 2")


def graph() -> Any:
    made = networkx.MultiGraph()
    made.add_edge("a", "b", type="revolute", axis=(0, 0, 1), point=(0, 0, 0))
    return made


def mechanism() -> Any:
    return case().mechanism


def system() -> Any:
    return answer().system


def in_space() -> Any:
    return nag.system("x + y + z")


def joint(**changed: Any) -> Any:
    given = {"name": "A", "type": "revolute", "bodies": ("a", "b"), "axis": (0, 0, 1)}
    return nag.Joint(**(given | changed))


ODD: dict[str, list[Callable[[], Any]]] = {
    "mechanism": [
        lambda: nag.model(graph()),
        lambda: nag.model(None),
        lambda: nag.model(3),
        lambda: nag.gruebler_kutzbach(None),
        lambda: nag.gruebler_kutzbach(graph()),
        lambda: nag.mobility(graph()),
        lambda: nag.mobility(system()),
        lambda: nag.mobility("bennett"),
    ],
    "modes": [lambda: nag.model(mechanism(), modes=3)],
    "space": [lambda: nag.model(mechanism(), space="flat")],
    "formulation": [
        lambda: nag.model(mechanism(), "X"),
        lambda: nag.mobility(mechanism(), formulation=3),
    ],
    "detail": [lambda: nag.mobility(mechanism(), detail="all")],
    "system": [
        lambda: nag.local_dimension(["x^2"], (0,)),
        lambda: nag.local_dimension(None, (0,)),
        lambda: nag.decompose(graph()),
        lambda: nag.solve(None),
        lambda: decompose("x*y"),
        lambda: D.sample(None, line(), 2),
        lambda: D.project(answer(), line(), [0]),
        lambda: D.discover("x*y"),
        lambda: D.genus(None, line()),
        lambda: D.singular_parameters(None, 1),
        lambda: D.singular_parameters(nag.system(["x + y", "x*y"], "x y a"), 2),
        lambda: nag.Decomposition(None, (), answer().paths, 0, "default", (), True),
        lambda: nag.WitnessSet(
            line().slice, line().points, 1, "irreducible", 0.0, line().radii, line().digits, 1
        ).sample(0),
    ],
    "point": [
        lambda: nag.local_dimension(system(), None),
        lambda: nag.local_dimension(system(), (1,)),
        lambda: nag.mobility(mechanism(), point=3),
        lambda: nag.model(mechanism()).lift([1]),
        lambda: nag.model(mechanism()).lift(None),
        lambda: line().contains(3),
        lambda: line().contains({"x": 1}),
        lambda: memberships(answer(), None),
        lambda: memberships(answer(), [1]),
        lambda: system()([1]),
    ],
    "point[1]": [
        lambda: line().contains([1, NAN]),
        lambda: D.components_through(answer(), [1, float("inf")]),
        lambda: memberships(answer(), [1, "x"]),
    ],
    "accuracy": [
        lambda: line().contains([1.0, 2.0], accuracy=NAN),
        lambda: line().contains([1, 2], accuracy=-1),
        lambda: line().contains([1, 2], accuracy="high"),
        lambda: nag.local_dimension(system(), (1, 0), accuracy=NAN),
        lambda: nag.local_dimension(system(), (1, 0), accuracy="high"),
        lambda: memberships(answer(), [1, 2], accuracy=float("inf")),
        lambda: D.components_through(answer(), [1, 2], accuracy=-3),
    ],
    "coordinates": [
        lambda: line().project(0),
        lambda: line().project(None),
        lambda: line().project([]),
        lambda: line().project(["x", 0]),
        lambda: line().project([1.5]),
        lambda: D.project(system(), line(), [9]),
    ],
    "symmetries": [
        lambda: nag.decompose("x*y", symmetries=5),
        lambda: nag.decompose("x*y", symmetries={"x": "-x"}),
        lambda: decompose(system(), symmetries=4),
        lambda: D.discover(system(), symmetries=[3]),
    ],
    "symmetries[0]": [
        lambda: nag.decompose("x*y", symmetries=[5]),
        lambda: nag.decompose("x*y", symmetries=[("a", "b")]),
    ],
    "seed": [
        lambda: nag.local_dimension(system(), (1, 0), seed=-1),
        lambda: nag.local_dimension(system(), (1, 0), seed="s"),
        lambda: nag.mobility(mechanism(), seed=-1),
        lambda: line().project([0], seed=1.5),
        lambda: line().contains([1, 0], seed=True),
        lambda: D.sample(system(), line(), 2, seed=None),
        lambda: decompose(system(), seed=-1),
    ],
    "threads": [
        lambda: nag.mobility(mechanism(), threads=0),
        lambda: line().contains([1, 0], threads=0),
        lambda: line().sample(0, threads=None),
        lambda: nag.solve("x^2 - 1", threads=0.5),
        lambda: D.singular_locus(answer(), threads=0),
    ],
    "settings": [
        lambda: nag.mobility(mechanism(), settings="slow"),
        lambda: nag.decompose("x*y", settings=3),
        lambda: nag.solve("x^2 - 1", settings=None),
        lambda: line().sample(0, settings="slow"),
        lambda: D.components_through(answer(), [1, 2], settings=7),
    ],
    "progress": [lambda: nag.decompose("x*y", progress=3), lambda: nag.solve("x^2", progress="a")],
    "start": [lambda: nag.solve("x^2 - 1", start="bad"), lambda: nag.solve("x - 1", start=None)],
    "decomposition": [
        lambda: nag.write_decomposition(None, "x.json"),
        lambda: nag.write_decomposition(roots(), "x.json"),
        lambda: memberships(None, [1, 2]),
        lambda: D.components_through(line(), [1, 2]),
        lambda: D.singular_locus(None),
    ],
    "result": [lambda: nag.write_solutions(answer(), "x.json")],
    "title": [lambda: nag.write_solutions(roots(), "x.json", 3)],
    "origin": [lambda: nag.write_decomposition(answer(), "x.json", 3)],
    "path": [
        lambda: nag.write_decomposition(answer(), None),
        lambda: nag.write_solutions(roots(), 3),
        lambda: nag.read_decomposition(None),
        lambda: nag.read_solutions(b"x"),
        lambda: nag.read_case(3),
    ],
    "set": [lambda: nag.read_case(ROOT / "cases" / "bennett.toml", 3)],
    "component": [
        lambda: D.sample(system(), None, 2),
        lambda: D.sample(in_space(), line(), 2),
        lambda: D.witness_at(system(), 3, line().slice),
        lambda: D.genus(system(), None),
        lambda: D.real_points_near(system(), answer(), [1, 2]),
    ],
    "first": [
        lambda: D.intersect_components(system(), 3, line()),
    ],
    "second": [
        lambda: D.intersect_components(system(), line(), None),
    ],
    "equations": [
        lambda: D.intersect_equations(system(), line(), "x"),
        lambda: nag.system(None),
        lambda: nag.system(answer()),
        lambda: nag.system(roots()),
    ],
    "target": [
        lambda: D.witness_at(system(), line(), None),
        lambda: D.witness_at(system(), line(), nag.Slice(np.eye(2), [1, 2])),
    ],
    "near": [
        lambda: D.real_points_near(system(), line(), None),
        lambda: D.real_points_near(system(), line(), ["a", "b"]),
        lambda: D.real_points_near(system(), line(), [1j, 2]),
    ],
    "starts": [
        lambda: D.real_points_near(system(), line(), [1, 2], starts=0),
        lambda: D.discover(system(), starts="many"),
    ],
    "count": [
        lambda: D.sample(system(), line(), 2.5),
        lambda: line().sample(0, -1),
        lambda: D.singular_parameters(system(), 0),
        lambda: D.singular_parameters(system(), 9),
    ],
    "only": [
        lambda: D.singular_locus(answer(), only=3),
        lambda: D.singular_locus(answer(), only=[9]),
    ],
    "rng": [lambda: line().sample(None), lambda: line().sample(-1)],
    "ground": [
        lambda: nag.Mechanism.from_graph(graph()),
        lambda: nag.Mechanism.from_graph(graph(), ground="floor"),
        lambda: nag.Mechanism(None, mechanism().joints),
    ],
    "graph": [lambda: nag.Mechanism.from_graph(3)],
    "joints": [lambda: nag.Mechanism("a", None)],
    "joints[0]": [lambda: nag.Mechanism("a", [3])],
    "bodies": [lambda: nag.Mechanism("a", [joint()], 3)],
    "bodies[0]": [lambda: nag.Mechanism("a", [joint()], [3])],
    "joint 'A': bodies": [
        lambda: joint(bodies=3),
        lambda: joint(bodies="ab"),
        lambda: nag.Mechanism("a", [joint(bodies=("a",))]),
    ],
    "joint 'A': axis": [lambda: joint(axis=3), lambda: nag.Mechanism("a", [joint(axis=None)])],
    "joint 'A': type": [lambda: nag.Mechanism("a", [joint(type="bad")])],
    "variables": [
        lambda: nag.system("x*y", 5),
        lambda: nag.PolynomialSystem("x", ()),
        lambda: nag.PolynomialSystem(("x", "x"), ()),
    ],
    "polynomials": [
        lambda: nag.PolynomialSystem(("x",), ("x",)),
        lambda: nag.PolynomialSystem(("x",), (nag.Polynomial(2, {}),)),
    ],
    "parameters": [lambda: nag.system("x", parameters=3)],
    "groups": [lambda: nag.system("x", groups=3), lambda: nag.system("x", groups=[["x"], ["x"]])],
    "groups[0]": [lambda: nag.system("x", groups=["q"])],
    "terms": [
        lambda: nag.Polynomial(2, None),
        lambda: nag.Polynomial(2, {3: 1}),
        lambda: nag.Polynomial(2, {(1, 2): "x"}),
        lambda: nag.Polynomial(2, {(1,): 1}),
    ],
    "sources": [lambda: nag.SignedPermutation(3, (1,))],
    "signs": [lambda: nag.SignedPermutation.of_signs(3)],
    "images": [lambda: nag.SignedPermutation.of_map(3, ("x",))],
    "A, b": [lambda: nag.Slice([[1, 2]], [1, 2]), lambda: nag.Slice([[1, 2]], 3)],
    "A": [lambda: nag.Slice("a", [1]), lambda: nag.Slice([[1, 2], [3]], [1, 2])],
    "b": [lambda: nag.Slice([[1, 2]], ["one"])],
    "slice": [
        lambda: nag.WitnessSet(
            3, line().points, 1, "irreducible", 0.0, line().radii, line().digits, 1
        )
    ],
    "components": [lambda: nag.Decomposition(system(), 3, answer().paths, 0, "default", (), True)],
}


@pytest.mark.parametrize("name", ODD)
def test_the_message_names_the_argument(name: str) -> None:
    for call in ODD[name]:
        with pytest.raises(ValueError, match=f"^{re.escape(name)}(: | )") as refused:
            call()
        message = str(refused.value)
        assert "\n" not in message
        assert not re.search(r"(\b\w+: )\1", message)


NOTHING = np.array([])
HUGE = 10**400
ROBOT = """<robot name="arm">
<link name="base"/><link name="one"/><link name="two"/>
<joint name="j1" type="revolute"><parent link="base"/><child link="one"/><axis xyz="0 0 1"/></joint>
<joint name="j2" type="revolute"><parent link="one"/><child link="two"/><origin xyz="1 0 0"/>
<axis xyz="0 0 1"/></joint></robot>"""
FOUR_BAR = """
title = "four bars"
kind = "linkage"
ground = "base"
link = [{ name = "base", pins = ["A", "D"], length = 2 },
{ name = "a", pins = ["A", "B"], length = "b" },
{ name = "c", pins = ["B", "C"], length = 2 }, { name = "d", pins = ["C", "D"], length = 1 }]
[parameters]
b = 1
"""
SQUARES = (["x^2 - a"], ["a"], [[1]])


@pytest.mark.parametrize(
    ("ask", "name"),
    [
        *((lambda k=k: nag.solve("x^2", **{k: NOTHING}), k) for k in ("start", "imaginary", "run")),
        (lambda: nag.solve("x^2", settings=NOTHING), "settings"),
        (lambda: nag.solve("x^2", imaginary=3), "imaginary"),
        (lambda: nag.system("x^2", imaginary=3), "imaginary"),
        (lambda: nag.solve("x^2", time_limit=HUGE), "time_limit"),
        (lambda: nag.solve(b"abc"), "equations"),
        (lambda: nag.decompose("x*y", expand="foo"), "expand"),
        (lambda: nag.decompose("x*y", method=NOTHING), "method"),
        (lambda: nag.decompose("x*y", hold=NOTHING[:0], at="j1=0.3"), "at"),
        (lambda: nag.decompose("x*y", hold=np.array(["a", "b"])), "hold"),
        (lambda: nag.sample(answer(), 1, real="foo"), "real"),
        (lambda: nag.sample(answer(), 1, count=HUGE), "count"),
        (lambda: nag.sample(answer(), 1, count=10**5000), "count"),
        (lambda: nag.certify(answer(), NOTHING), "paths"),
        (lambda: line().contains((0, 0), accuracy=HUGE), "accuracy"),
        (lambda: nag.read(ROOT / "cases" / "bennett.toml", format=3), "format"),
        (lambda: nag.read(ROOT / "cases" / "bennett.toml", hold=3), "hold"),
        (lambda: nag.model(case(), formulation=NOTHING), "formulation"),
        (lambda: nag.write(answer(), "found.csv"), "path"),
        (lambda: nag.write("x", "x.toml", title=3), "title"),
        (lambda: nag.plot(answer(), 3, onto="x, y"), "path"),
        (lambda: nag.plot(case(), "joints.svg", joints="J0"), "joints"),
        (lambda: nag.driven_motion(case(), 3, [0.1]), "coordinate"),
        (lambda: nag.driven_motion(case(), "J0", b"abc"), "values"),
        (lambda: nag.driven_motion(case(), "J0", [HUGE]), "values"),
        (lambda: nag.motion(case(), drive={"J0": HUGE}), "drive"),
        (lambda: nag.mobility(case(), tolerance=HUGE), "tolerance"),
        (lambda: nag.mobility(case(), budget=HUGE), "budget"),
        (lambda: nag.sweep_parameter(ROOT / "cases" / "rhombus.toml", 3, [1, 2]), "parameter"),
        (lambda: nag.sweep_parameter(ROOT / "cases" / "rhombus.toml", "b", b"abc"), "values"),
        (lambda: nag.write_report([], "report.html"), "given"),
        (lambda: nag.write_report(None, "report.html"), "given"),
        (lambda: nag.solve_family(*SQUARES[:2], [[HUGE]]), "values"),
        (lambda: nag.solve_family(*SQUARES, known=()), "known"),
        (lambda: nag.solve_family(*SQUARES, known={}), "known"),
        (lambda: nag.solve_family(*SQUARES, known=([1], "x")), "known"),
    ],
)
def test_what_is_nothing_of_the_kind_that_is_declared_is_named(
    ask: Callable[[], Any], name: str
) -> None:
    with pytest.raises(nag.NagError, match=rf"^{name}(\[[^]]*\])?: ") as raised:
        ask()
    assert "\n" not in str(raised.value) and len(str(raised.value)) < 250


def test_joint_values_and_links_may_be_those_of_other_libraries(tmp_path: Path) -> None:
    path = tmp_path / "arm.urdf"
    path.write_text(ROBOT)
    expected = nag.read(path, hold=["two"], at={"j1": "0.3", "j2": 1})
    for hold in ("two", np.array(["two"]), pandas.Series(["two"])):
        for values in ({"j1": np.float32(0.3), "j2": np.int64(1)}, {"j1": 0.3, "j2": 1}):
            for at in (values, pandas.Series(values, dtype=object)):
                assert nag.read(path, hold=hold, at=at).mechanism == expected.mechanism
    with pytest.raises(nag.NagError, match=r"^at: 'j1=0.3' is given; give a dict"):
        nag.read(path, hold=["two"], at="j1=0.3")


@pytest.mark.parametrize("value", [0, -1])
def test_a_sweep_says_at_which_value_its_case_makes_no_sense(value: int, tmp_path: Path) -> None:
    path = tmp_path / "bars.toml"
    path.write_text(FOUR_BAR)
    with pytest.raises(nag.NagError, match=rf"^at b = {value}: .*'a': length: "):
        nag.sweep_parameter(path, "b", [1, value])
