"""Planar frameworks in isotropic coordinates: the same sets as in others, and carried over."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from nag.algebra.from_python import system as system_of_equations
from nag.decomposition.decompose import decompose
from nag.decomposition.through import through_points
from nag.mechanism.framework import Framework, placed_framework
from nag.mechanism.framework_model import framework_model
from nag.mechanism.isotropic import isotropic_system
from nag.mechanism.problem import problem_of
from nag.witness.frame import expand_orbits


def placed_in_plane(places, bars):
    exact = {p: tuple(map(Fraction, place)) for p, place in places.items()}
    return placed_framework(2, exact, [tuple(bar) for bar in bars.split()])


def unplaced(placed):
    return Framework(2, placed.points, placed.bars, placed.squared_lengths)


def test_isotropic_and_cartesian_coordinates_find_the_same_realisations():
    places = {"A": (0, 0), "B": (3, 0), "C": (1, 2), "D": (4, 3)}
    placed = placed_in_plane(places, "AB BC CA BD CD")
    models = [framework_model(placed), framework_model(unplaced(placed))]
    assert [m.coordinates for m in models] == ["xy", "z"]
    answers = [[c.points[0] for c in decompose(m.system).components] for m in models]
    assert [len(a) for a in answers] == [4, 4]
    plane = np.array(answers[0])
    isotropic = plane[:, ::2] + 1j * plane[:, 1::2]
    gaps = np.abs(isotropic[:, None] - np.array(answers[1])[None]).max(axis=2)
    assert gaps.min(axis=1).max() < 1e-12
    assert all(m.is_real(x) for m, a in zip(models, answers, strict=True) for x in a)


# Movable, with a dangling bar, on top of each other, and in line: mobile, rigid and shaky ones.
MOVING = {
    "kite": ({"A": (0, 0), "B": (1, 2), "C": (0, 5), "D": (-1, 2)}, "AB BC CD DA"),
    "parallelogram and tail": (
        {"A": (0, 0), "B": (3, 0), "C": (4, 2), "D": (1, 2), "E": (2, 5)},
        "AB BC CD DA CE",
    ),
    "in line": (
        {"A": (0, 0), "B": (2, 0), "C": (3, 0), "D": (1, 0), "E": (1, 1)},
        "AB BC CD DA AE DE",
    ),
    "flat": ({"A": (0, 0), "B": (2, 0), "C": (5, 0), "D": (1, 3)}, "AB BC CA AD DC"),
}


@pytest.mark.parametrize("name", MOVING)
@pytest.mark.parametrize("seed", [0, 1])
def test_components_carried_over_to_the_plane_are_those_found_there(name, seed):
    made = framework_model(placed_in_plane(*MOVING[name]))
    assert made.smaller is not None and made.smaller.paths < made.paths
    options = {"seed": seed, "symmetries": made.symmetries}
    answers = [problem_of(made).decompose(**options), decompose(made.system, **options)]
    assert all(a.complete for a in answers)
    kinds = [
        sorted((c.dimension, c.degree, c.multiplicity, c.orbit) for c in a.components)
        for a in answers
    ]
    assert kinds[0] == kinds[1]
    assert all(a.system == made.system for a in answers)
    at = [("placement", made.reference)]
    through = [through_points(a, at)[0] for a in answers]
    everything = [expand_orbits(a).components for a in answers]
    degrees = [
        sorted(components[i].degree for i in t.components)
        for components, t in zip(everything, through, strict=True)
    ]
    assert degrees[0] == degrees[1] != []


def test_loops_in_isotropic_coordinates_have_the_realisations_of_pairs():
    # The degrees in z are those of the pairs (z, w) with z alone cut.
    for name, (places, bars) in MOVING.items():
        framework = unplaced(placed_in_plane(places, bars))
        kinds = []
        for system in (isotropic_system(framework), pairs_of(framework)):
            found = decompose(system)
            assert found.complete
            kinds.append(
                sorted(
                    (c.dimension, c.degree if c.multidegree is None else in_z(c), c.multiplicity)
                    for c in found.components
                )
            )
        assert kinds[0] == kinds[1], name


def in_z(component):
    return int(component.multidegree[(0,) * component.dimension])


def pairs_of(framework):
    """(z - z')(w - w') = l^2 for every bar, the first one from 0 to 1."""
    free = framework.points_not_on(framework.bars[0])
    names = [f"{letter}_{p}" for letter in "zw" for p in free]
    place = {p: (f"z_{p}", f"w_{p}") for p in free}
    place |= {p: (str(i), str(i)) for i, p in enumerate(framework.bars[0])}
    unit = framework.squared_lengths[0]
    equations = [
        f"({place[a][0]} - {place[b][0]})*({place[a][1]} - {place[b][1]}) - {squared / unit}"
        for (a, b), squared in zip(framework.bars[1:], framework.squared_lengths[1:], strict=True)
    ]
    half = len(free)
    made = system_of_equations(equations, names)
    return replace(made, groups=(tuple(range(half)), tuple(range(half, 2 * half))))


def test_long_loops_keep_bars_as_products():
    ring = {f"p{i}": Fraction(i + 2) for i in range(9)}
    names = list(ring)
    bars = tuple(zip(names, [*names[1:], names[0]], strict=True))
    framework = Framework(2, tuple(names), bars, tuple(x * x for x in ring.values()))
    assert isotropic_system(framework) is None
    assert framework_model(framework).coordinates == "zw"
