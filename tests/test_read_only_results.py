"""Results are never altered: nothing in them can be written to."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Callable, Iterator, Mapping
from dataclasses import FrozenInstanceError, fields, is_dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import nag
from nag.decomposition import (
    discover,
    genus,
    intersect_components,
    project,
    real_points_near,
    sample,
    singular_locus,
    singular_parameters,
    witness_at,
)
from nag.numerics.large_arrays import empty_array, leave_to_file
from nag.numerics.read_only import handed_over
from nag.witness.witness import even_radii

ROOT = Path(__file__).parent.parent
CLOSE = ["x^2 + y^2 + z^2 - 1", "(x + 2*y - 1)^2 - 2/10^30"]


def lines() -> Any:
    return nag.decompose("x*y")


def double_parabola() -> Any:
    """Its points are kept with unknowns that deflation added."""
    return nag.decompose(["x^2 - y", "z^2"])


def curve() -> Any:
    return nag.decompose(["x*y - z^2 + 1", "x^2 + y*z - 2"])


def bowl() -> Any:
    return nag.decompose("(x^2 + y^2 - z)*(x - y)")


def bennett() -> Any:
    return nag.read_case(ROOT / "cases" / "bennett.toml")


RESULTS: dict[str, Callable[[], Any]] = {
    "decomposition": lines,
    "curve": curve,
    "by sampling": lambda: discover(nag.system("x^2 + y^2 = 1"), starts=3),
    "deflated": double_parabola,
    "close sheets": lambda: nag.decompose(CLOSE),
    "mechanism": lambda: nag.decompose(bennett().mechanism),
    "moved": lambda: witness_at(
        bowl().system,
        bowl().components[1],
        nag.Slice(np.array([[1, 0, 0], [0, 0, 1]]), np.array([1, 3])),
    ),
    "intersection": lambda: intersect_components(bowl().system, *bowl().components),
    "samples": lambda: sample(lines().system, lines().components[0], 2),
    "projection": lambda: project(lines().system, lines().components[0], [0]),
    "real points": lambda: real_points_near(lines().system, lines().components[0], np.ones(2)),
    "genus": lambda: genus(lines().system, lines().components[0]),
    "singular locus": lambda: singular_locus(lines()),
    "singular parameters": lambda: singular_parameters(nag.system("x^2 + a*x + b", "x a b"), 2),
    "solutions": lambda: nag.solve(["x^2 + y^2 - 1", "x - y"]),
    "multiple solutions": lambda: nag.solve(["x^2 + y^3", "x*y + y^3"], start="total"),
    "solutions beside a curve": lambda: nag.solve(["x*(x - z)", "x*(y - 1)", "x*(z - 2) + y*x"]),
    "no variables": lambda: nag.solve("1", "x"),
    "local dimension": lambda: nag.local_dimension(nag.system("x^3 = y^2"), (0, 0)),
    "local dimension nearby": lambda: nag.local_dimension(nag.system("x^3 = y^2"), (1.0, 1.0)),
    "no local dimension": lambda: nag.local_dimension(nag.system("x^3 = y^2"), (1.0, 2.0)),
    "mobility": lambda: nag.mobility(bennett().mechanism, detail="curves"),
    "mobility of parts": lambda: nag.mobility(
        nag.read_case(ROOT / "cases/planar/four-bar-folding.toml").assembly, detail="curves"
    ),
    "model": lambda: nag.model(bennett().mechanism),
    "configuration": lambda: nag.model(bennett().mechanism).lift((0, 0)),
    "case": bennett,
    "system": lambda: nag.system("x^2 + y^2 = 1"),
    "slice": lambda: nag.Slice(np.eye(2), np.zeros(2)),
}


def parts(value: Any, place: str, seen: set[int]) -> Iterator[tuple[str, Any]]:
    """What a value holds at any depth, with its place; what is computed from it is left out."""
    if id(value) in seen:
        return
    seen.add(id(value))
    yield place, value
    if isinstance(value, Mapping):
        for key, item in value.items():
            yield from parts(item, f"{place}[{key!r}]", seen)
    elif isinstance(value, list | tuple):
        for i, item in enumerate(value):
            yield from parts(item, f"{place}[{i}]", seen)
    elif is_dataclass(value):
        for field in fields(value):
            if not field.name.startswith("_"):
                yield from parts(getattr(value, field.name), f"{place}.{field.name}", seen)


def writable(value: Any) -> bool:
    """Whether a value lets itself be written to; tried, not asked."""
    if isinstance(value, np.ndarray):
        # Of an array without entries nothing can be assigned; it could be resized.
        if not value.size:
            return value.flags.writeable
        try:
            value[(0,) * value.ndim] = value[(0,) * value.ndim]
        except ValueError:
            return False
        return True
    if isinstance(value, Mapping):
        try:
            value["new"] = 1  # type: ignore[index]
        except TypeError:
            return False
        return True
    if is_dataclass(value) and fields(value):
        try:
            setattr(value, fields(value)[0].name, None)
        except FrozenInstanceError:
            return False
        return True
    return isinstance(value, list | set | dict | bytearray)


@pytest.mark.parametrize("name", RESULTS)
def test_nothing_in_a_result_can_be_written_to(name: str) -> None:
    found = list(parts(RESULTS[name](), name, set()))
    assert found
    assert [place for place, value in found if writable(value)] == []


def test_the_parts_of_a_component_are_looked_at() -> None:
    for name, place in (
        ("curve", "slice.A"),
        ("curve", "radii"),
        ("curve", "fibres[0].points"),
        ("deflated", "fibres[0].cut.polynomials[0].terms"),
        ("close sheets", "fibres[0].fine[0].words"),
    ):
        places = {place for place, _ in parts(RESULTS[name](), name, set())}
        assert f"{name}.components[0].{place}" in places


def test_the_arrays_that_a_result_is_made_of_stay_the_callers() -> None:
    (component,) = curve().components
    (fibre,) = component.fibres
    points, own = np.array(component.points), np.array(fibre.points)
    fine: dict[int, Any] = {}
    made = nag.WitnessSet(
        component.slice,
        points,
        1,
        "irreducible",
        0.0,
        even_radii(points, 1e-15),
        [16] * len(points),
        1,
        fibres=(type(fibre)(fibre.cut, 1, own, fine),),
    )
    before = made.points.copy()
    points += 1
    own += 1
    fine[0] = None
    assert np.array_equal(made.points, before)
    assert np.array_equal(made.fibres[0].points, before)
    assert not made.fibres[0].fine


def test_a_view_of_an_array_that_can_be_written_to_is_copied() -> None:
    a = np.eye(2)
    view = a[:]
    view.setflags(write=False)
    cut = nag.Slice(view, np.zeros(2))
    a[0, 0] = 5
    assert cut.A[0, 0] == 1


@pytest.mark.parametrize("copied", [copy.deepcopy, lambda x: pickle.loads(pickle.dumps(x))])
def test_results_can_be_copied_and_pickled(copied: Callable[[Any], Any]) -> None:
    for answer in (curve(), double_parabola(), RESULTS["close sheets"]()):
        assert copied(answer) == answer
    report = RESULTS["mobility"]()
    assert repr(copied(report)) == repr(report)
    node = RESULTS["singular locus"]().sets[0]
    assert copied(node).multiplicities == node.multiplicities == {0: 1, 1: 1}


def test_a_large_array_is_handed_over_where_it_lies(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("nag.numerics.large_arrays.LARGE", 1)
    for whole in (empty_array((3, 2), complex), empty_array((4,), bool)):
        given = handed_over(whole)
        assert np.shares_memory(given, whole) and given.dtype == whole.dtype
        with pytest.raises(ValueError, match="WRITEABLE"):
            given.setflags(write=True)
    leave_to_file(given)
