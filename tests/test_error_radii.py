"""Witness points are as near to the exact ones as their radii say, against 100 proved digits."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import nag
from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem
from nag.bench.atlas.families import FAMILIES
from nag.bench.reference import Reference
from nag.decomposition import witness_at
from nag.decomposition.decompose import decompose
from nag.files.cases import read_case
from nag.witness.exact_points import sharpen_points
from nag.witness.fibres import Fibre
from nag.witness.frame import expand_orbits
from nag.witness.slices import random_rows, to_slice
from nag.witness.witness import WitnessSet

CASES = Path(__file__).parents[1] / "cases"
FAMILY = {f.name: f for f in FAMILIES}


def known_system(name: str, value: object) -> PolynomialSystem:
    if value is None:
        return read_case(CASES / f"{name}.toml").system
    return FAMILY[name].make(value, np.random.default_rng(0)).system


def off(reference: Reference, points: np.ndarray) -> np.ndarray:
    """Distances of coordinates from those of the proved zeros."""
    return np.abs((points - reference.high) - reference.low)


def assert_within_radii(system: PolynomialSystem, component: WitnessSet) -> None:
    reference = Reference.of(system, component.points, component.slice.rows)
    assert (off(reference, component.points) <= component.radii).all()
    # Nor is anything claimed to be much worse than it is.
    assert component.accuracy < 1e-12


REGULAR = [
    *((n, None) for n in ("slider-crank", "rhombus", "literature/cyclic-4")),
    *(("lengths", k) for k in (4, -8)),
    ("kite", 4),
    ("hyperbola", 8),
    ("moved", "slider-crank"),
    ("moved", "literature/sphere-and-cubic"),
]


@pytest.mark.parametrize(("name", "value"), REGULAR, ids=str)
def test_points_of_a_decomposition_lie_within_their_radii(name: str, value: object) -> None:
    system = known_system(name, value)
    answer = expand_orbits(decompose(system))
    assert answer.components
    for component in answer.components:
        assert_within_radii(system, component)
        assert (component.digits >= 19).all()
        rows = random_rows(np.random.default_rng(3), component.dimension, system.n)
        assert_within_radii(system, witness_at(system, component, to_slice(rows)))


def test_images_under_symmetries_have_the_radii_of_their_coordinates() -> None:
    system = nag.system("(x^2 - 2*y - z)*(y^2 - 2*x - z)*(x*y - 1)", "x y z")
    answer = decompose(system, symmetries=[SignedPermutation((1, 0, 2), (1, 1, 1))])
    assert any(component.images for component in answer.components)
    for component in expand_orbits(answer).components:
        assert_within_radii(system, component)


@pytest.mark.parametrize(("name", "value"), [("cluster-3", 8), ("dependent", 8), ("far", 12)])
def test_isolated_points_lie_within_their_radii(name: str, value: int) -> None:
    system = known_system(name, value)
    for component in decompose(system).components:
        reference = Reference.of(system, component.points, component.slice.rows)
        assert (off(reference, component.points) <= component.radii).all()


def test_points_of_a_multiple_component_lie_within_their_radii() -> None:
    system = nag.system(["(x^2 + y^2 + z^2 - 1)^2*(x - 3)", "(x^2 + y^2 + z^2 - 1)*(x - 3)^2*y"])
    sphere = nag.system("x^2 + y^2 + z^2 - 1", "x y z")
    plane = nag.system("x - 3", "x y z")
    answer = decompose(system)
    multiple = [c for c in answer.components if c.dimension == 2]
    assert sorted(c.degree for c in multiple) == [1, 2]
    for component in multiple:
        assert_within_radii(sphere if component.degree == 2 else plane, component)


def circle_and_slice(error: float) -> tuple[PolynomialSystem, WitnessSet, Fibre]:
    """A circle with witness points that are off by so much."""
    system = nag.system("x^2 + y^2 - 1", "x y")
    (component,) = nag.decompose(system).components
    (fibre,) = component.fibres
    moved = fibre.points + error * np.array([[1, -1j], [1j, 1]])
    return system, component, replace(fibre, points=moved)


@pytest.mark.parametrize("error", [1e-15, 1e-12, 1e-9])
def test_points_that_are_off_become_the_doubles_next_to_the_zeros(error: float) -> None:
    system, component, fibre = circle_and_slice(error)
    reference = Reference.of(system, fibre.points, component.slice.rows)
    sharp = sharpen_points([fibre])
    assert (off(reference, sharp.fibres[0].points) <= sharp.radii).all()
    assert (sharp.radii < 1e-15).all() and (sharp.digits > 16).all()


def test_an_accuracy_is_that_of_the_radii() -> None:
    _, component, _ = circle_and_slice(0.0)
    sizes = 1 + np.linalg.norm(component.points, axis=1)
    errors = np.linalg.norm(component.radii, axis=1) / sizes
    assert component.accuracy == errors.max()
    assert component.precision == component.digits.min() == 40
