"""What users get is equal to itself after a pickle, and prints as one line."""

from __future__ import annotations

import pickle
from dataclasses import replace
from functools import cache
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import nag

BENNETT = "cases/bennett.toml"


@cache
def found() -> nag.Decomposition:
    return nag.decompose("(x^2 + y^2 - 1)*(x - y)")


@cache
def solved() -> nag.SolveResult:
    return nag.solve(["x^2 - 2", "y^2 - x"])


RESULTS = {
    "decompose": found,
    "component": lambda: found().components[0],
    "member": lambda: nag.member(found(), [0, 1]),
    "sample": lambda: nag.sample(found()),
    "singular": lambda: nag.singular(found()),
    "intersect": lambda: nag.intersect(found(), 1, 2),
    "eliminate": lambda: nag.eliminate(["y - x^2", "z - x^3"], "y, z"),
    "certified components": lambda: nag.certify(found()),
    "certified points": lambda: nag.certify(solved()),
    "solve": solved,
    "family": lambda: nag.solve_family(["x^2 = a"], ["a"], [[1], [2]]),
    "local": lambda: nag.local("x^2 - y^3", [0, 0]),
    "real points": lambda: nag.find_real_points(found().components[0]),
    "real curve": lambda: nag.find_real_curve(found().components[0]),
    "mobility": lambda: nag.mobility(BENNETT),
    "motion": lambda: nag.motion(BENNETT),
    "motion of a linkage": lambda: nag.motion("cases/planar/four-bar.toml"),
    "circuit": lambda: nag.motion(BENNETT).circuits[0],
    "driven motion": lambda: nag.driven_motion(BENNETT, "J0", [0.1, 0.2]),
    "modes": lambda: nag.modes("cases/robots/3-rps.toml"),
    "case": lambda: nag.read(BENNETT),
    "model": lambda: nag.model(BENNETT),
}


@pytest.mark.parametrize("name", RESULTS)
def test_results_are_equal_to_themselves_after_a_pickle(name: str) -> None:
    result: Any = RESULTS[name]()
    assert pickle.loads(pickle.dumps(result)) == result


@pytest.mark.parametrize("name", sorted(RESULTS.keys() - {"case"}))
def test_results_are_one_line_at_the_prompt(name: str) -> None:
    text = repr(RESULTS[name]())
    assert len(text) <= 100 and "\n" not in text


def incomplete() -> dict[str, Any]:
    """Results that are not complete, by how their line begins."""
    told: dict[str, Any] = {}
    patch = pytest.MonkeyPatch()
    patch.setattr("nag.tracking.run.time", SimpleNamespace(monotonic=lambda: 0.0))
    patch.setattr("nag.tracking.run.BETWEEN", 0.0)

    def tell(answer: Any) -> None:
        told[type(answer).__name__] = answer

    nag.decompose(["(x^2 + y^2 - 4)*(x*y - z)", "(x - y)*(x^3 + y*z - 1)"], found=tell)
    nag.solve(["x^2 + y^2 + z^2 - 9", "x*y*z - z^2 + 1", "x^2 + y*z^2 - 3"], found=tell)
    nag.mobility(BENNETT, found=tell)
    nag.motion(BENNETT, found=tell)
    nag.driven_motion(BENNETT, "J0", [0.1, 0.2], found=tell)
    nag.modes("cases/robots/3-rps.toml", found=tell)
    patch.undo()
    family = nag.solve_family(["x^2 = a"], ["a"], [[1], [2]])
    others = [
        replace(family, complete=np.array([True, False])),
        replace(nag.sample(found()), doubt="a point may be missing"),
        replace(nag.eliminate(["y - x^2", "z - x^3"], "y, z"), note="a degree is missing"),
        replace(nag.singular(found()), complete=False),
    ]
    return told | {type(each).__name__: each for each in others}


def test_results_that_are_incomplete_say_so_in_one_line_at_the_prompt() -> None:
    results = incomplete()
    assert {*results} >= {"Decomposition", "SolveResult", "MobilityReport", "Motion"}
    assert {*results} >= {"DrivenMotion", "OperationModes", "FamilySolutions", "ImageIdeal"}
    for name, result in results.items():
        text = repr(result)
        assert text.startswith(f"<{name} (INCOMPLETE)") and len(text) <= 100 and "\n" not in text
    for name in sorted(RESULTS):
        assert "INCOMPLETE" not in repr(RESULTS[name]())


def test_a_component_alone_answers_what_a_decomposition_does() -> None:
    line = next(c for c in found().components if c.degree == 1)
    assert nag.sample(line, count=3).points.shape == (3, 2)
    assert len(nag.member(line, [2, 2]).on) == 1 and not nag.member(line, [1, 0]).on
    for ask in (nag.find_real_curve, nag.find_real_points):
        with pytest.raises(nag.NagError, match="component: something of type Decomposition is"):
            ask(found())
