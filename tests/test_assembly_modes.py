"""Assembly modes: their classes, and Bricard's mechanism in all of them."""

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations, product

import numpy as np
import pytest
from linkages import case, closed_chain, general_loop, loops_of_all_joints, residual
from solved import components_of

from nag.mechanism.assembly_modes import all_modes
from nag.mechanism.axes import cross, difference, dot
from nag.mechanism.loops import loop_structure
from nag.mechanism.mode_classes import carries_modes, flips, mode_classes
from nag.mechanism.mode_decomposition import decompose_modes, modes_are_apart
from nag.mechanism.model import model
from nag.witness.witness import WitnessSet

BRICARD = case("bricard-cube")


def degree_counts(components: Sequence[WitnessSet]) -> dict[tuple[int, int], int]:
    """How many components there are of each dimension and degree."""
    counts: dict[tuple[int, int], int] = {}
    for component in components:
        key = component.dimension, component.degree
        counts[key] = counts.get(key, 0) + component.orbit
    return counts


@pytest.fixture(scope="module")
def bricard_in_all_modes():
    return decompose_modes(BRICARD, coordinates="euler")


def test_the_modes_of_linkages_with_common_perpendiculars_are_two_classes_by_parity():
    for mechanism in (case("bennett"), BRICARD, case("planar-four-bar")):
        structure = loop_structure(mechanism)
        first, second = mode_classes(structure)
        assert first.representative == ()
        assert {len(modes) % 2 for modes in first.members} == {0}
        assert {len(modes) % 2 for modes in second.members} == {1}
        assert len(first.members) + len(second.members) == 2 ** len(structure.joints)


def test_offsets_along_the_axes_leave_no_two_modes_alike():
    assert len(mode_classes(loop_structure(general_loop(5, 3)))) == 2**5


def test_a_half_turn_about_another_line_is_no_map_of_modes():
    structure = loop_structure(BRICARD)
    (flip, *_) = flips(structure)
    assert carries_modes(structure, flip)
    for normal in ((1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0)):
        other = type(flip)(flip.body, tuple(map(Fraction, normal)), flip.joints)
        same = all(x == 0 for x in cross(other.normal, flip.normal))
        assert carries_modes(structure, other) is same


def test_modes_of_prismatic_joints_are_four_each():
    chain = closed_chain(
        ("prismatic", (0, 0, 0), (1, 0, 0)),
        ("revolute", (0, 0, 0), (0, 0, 1)),
        ("revolute", (1, 0, 0), (0, 0, 1)),
    )
    assert len(list(all_modes(chain.joints))) == 4 * 2 * 2
    assert modes_are_apart(loop_structure(chain))


def folded_modes() -> dict[str, list[tuple[int, ...]]]:
    """In which modes Bricard's cube can be folded into a mechanism of mobility 2, by geometry.

    Link i is a unit vector w_i across the axes at both its ends; these are orthogonal. Let e_i be
    the sign of the frame (w_i, its axes). Where links i and i + 1 are folded onto each other, the
    axis at the far end is that at the near end, times m_{i+1} e_i e_{i+1}, where m_j = -1 says
    that joint j is changed. Two such pairs, opposite to each other, leave two links that must be
    opposite vectors: the pairs turn freely. Three such pairs turn about one axis. Both close up if
    the signs agree round the loop.
    """
    joints = BRICARD.joints
    points = [j.point for j in joints]
    axes = [j.axis for j in joints]
    links = [difference(points[(i + 1) % 6], points[i]) for i in range(6)]
    e = [dot(links[i], cross(axes[i], axes[(i + 1) % 6])) for i in range(6)]
    found = {"two pairs": [], "three pairs": []}
    for m in product((1, -1), repeat=6):
        for start in range(3):
            folds = [(start + k, (start + k + 1) % 6) for k in (0, 3)]
            signs = [m[j] * e[i] * e[j] for i, j in folds]
            a, b = (start + 2) % 6, (start + 5) % 6
            # From link a over its far joint, the second pair, and back over the first.
            turn = m[a] * m[(a + 1) % 6] * m[b] * m[(b + 1) % 6] * np.prod(signs)
            if e[b] == turn * e[a]:
                found["two pairs"].append(m)
        for start in range(2):
            folds = [((start + 2 * k) % 6, (start + 2 * k + 1) % 6) for k in range(3)]
            round_trip = np.prod([m[j] * e[i] * e[j] for i, j in folds])
            if round_trip * np.prod([m[i] for i, _ in folds]) == 1:
                found["three pairs"].append(m)
    return found


def test_bricards_components_of_dimension_2_are_the_folded_ones(bricard_in_all_modes):
    folded = folded_modes()
    odd = {m for m in product((1, -1), repeat=6) if np.prod(m) == -1}
    assert set(folded["two pairs"]) == set(folded["three pairs"]) == odd
    assert all(folded["two pairs"].count(m) == 3 for m in odd)
    assert all(folded["three pairs"].count(m) == 2 for m in odd)
    # Two angles turn; a full turn of each changes the signs of the bodies that it turns, so that
    # the 32 signs of the Euler parameters fall into 32 / 4 components.
    even, changed = (
        degree_counts(c.decomposition.components) for c in bricard_in_all_modes.classes
    )
    assert even == {(1, 8): 16}
    assert sum(changed.values()) == (3 + 2) * 32 // 4
    assert {d for d, _ in changed} == {2}


def test_bricards_cube_decomposes_in_all_64_modes(bricard_in_all_modes):
    answer = bricard_in_all_modes
    assert answer.complete and answer.apart and answer.meetings == ()
    members = [len(c.modes.members) for c in answer.classes]
    assert members == [32, 32]
    total: dict[tuple[int, int], int] = {}
    for size, each in zip(members, answer.classes, strict=True):
        for key, count in degree_counts(each.decomposition.components).items():
            total[key] = total.get(key, 0) + size * count
    assert total == {(1, 8): 512, (2, 4): 768, (2, 8): 512}
    # Dimension and total degree of the ideal in Euler parameters, modulo 32003 by Singular, are
    # (1, 128) in each of the 32 modes of the one class and (2, 224) in those of the other.
    for each, degree in zip(answer.classes, (128, 224), strict=True):
        counts = degree_counts(each.decomposition.components)
        assert sum(d * count for (_, d), count in counts.items()) == degree


def test_half_angles_have_one_component_for_each_orbit_of_signs(bricard_in_all_modes):
    for each in bricard_in_all_modes.classes:
        m = model(BRICARD, "H", each.modes.representative)
        answer = components_of(m.system)
        assert answer.complete
        dimensions = sorted(c.dimension for c in answer.components)
        assert dimensions == sorted(c.dimension for c in each.decomposition.components)


def test_a_witness_point_of_every_mode_satisfies_the_unreduced_constraints(bricard_in_all_modes):
    for each in bricard_in_all_modes.classes:
        for component in each.decomposition.components:
            point = component.points[0]
            lifted = each.model.lift(point)
            at = [complex(x) for x in each.model.unreduced_point(lifted)]
            values = np.array([complex(f(at)) for f in each.model.unreduced.polynomials])
            assert abs(values).max() < 1e-10 * max(1, max(map(abs, at))) ** 4


def test_every_mode_of_a_class_has_the_same_components_in_half_angles():
    """Not by the map: four modes of Bennett's linkage, each decomposed for itself."""
    structure = loop_structure(case("bennett"))
    for each in mode_classes(structure):
        counts = [
            degree_counts(components_of(model(case("bennett"), "H", modes).system).components)
            for modes in each.members
        ]
        assert all(c == counts[0] for c in counts)


def test_the_export_of_all_modes_holds_every_combination_once(bricard_in_all_modes):
    text = bricard_in_all_modes.document("Bricard", "bricard-cube.toml")
    combinations_ = [tuple(sorted(m.items())) for c in text["classes"] for m in c["modes"]]
    assert len(set(combinations_)) == len(combinations_) == 64
    names = [j.name for j in BRICARD.joints]
    wanted = {tuple((n, 1) for n in chosen) for k in range(7) for chosen in combinations(names, k)}
    assert set(combinations_) == wanted


def test_joint_coordinates_and_euler_parameters_agree_in_every_mode_of_every_joint():
    """Modes are constant displacements in the one, prime components in the other."""
    chain = closed_chain(
        ("prismatic", (0, 0, 0), (1, 2, 2)),
        ("cylindrical", (1, 0, 0), (0, 1, 2)),
        ("spherical", (1, 2, 0)),
        ("revolute", (0, 3, 1), (2, -1, 0)),
    )
    for mechanism in (chain, loops_of_all_joints()["ECRR"]):
        for modes in all_modes(mechanism.joints):
            if len(modes) > 1:
                continue
            half = model(mechanism, "H", modes, "spatial")
            euler = model(mechanism, "E", modes, "spatial")
            answer = components_of(half.system)
            assert answer.complete and answer.components
            for component in answer.components:
                lifted = half.lift(component.points[0])
                at = [complex(x) for x in half.unreduced_point(lifted)]
                assert residual(half.unreduced, at) < 1e-11
                # A prismatic joint ties the signs of its bodies together.
                point = np.array(euler.project(lifted), dtype=complex)
                signs = [np.ones(len(point)), *(np.array(g.signs) for g in euler.symmetries)]
                assert min(residual(euler.system, list(point * s)) for s in signs) < 1e-11
