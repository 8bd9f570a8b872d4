"""Points of curves and of the plane itself meet hypersurfaces where algebra says."""

from __future__ import annotations

import numpy as np
import pytest
from cuts import curve, fibre

from nag.decomposition.hypersurface import hypersurface_section, intersect
from nag.tracking.run import Run
from nag.witness.cutting import Cut
from nag.witness.fibres import Fibre, whole_space
from nag.witness.slices import random_rows, unit_complex

TRACKER = Run()
CIRCLE, LINE = "x^2 + y^2 - 1", "3*x - 4*y"


def finite(ends) -> np.ndarray:
    return ends.points[ends.finite]


@pytest.mark.parametrize("seed", range(3))
def test_a_circle_meets_a_line_in_its_two_points(seed: int) -> None:
    rng = np.random.default_rng(seed)
    flag = random_rows(rng, 2, 2)
    points = fibre(CIRCLE, flag[0])
    ends = intersect(points, curve(LINE), complex(unit_complex(rng)), TRACKER)
    found = finite(ends)[:, :2]
    assert ends.counts.tracked == 2 and ends.regular.all()
    assert np.abs(found[np.argsort(found[:, 0].real)] - [[-0.8, -0.6], [0.8, 0.6]]).max() < 1e-14


@pytest.mark.parametrize(
    ("equation", "regular", "singular", "infinite"),
    [
        ("x*y - 1/4", 4, 0, 0),
        ("y - x^2 - 1", 2, 2, 0),  # Touches at (0, 1).
        ("x^2 + y^2 - x - 3", 2, 0, 2),  # Meets circles at infinity.
        ("x - 1", 0, 2, 0),
    ],
)
def test_ends_are_as_many_as_the_product_of_the_degrees(
    equation: str, regular: int, singular: int, infinite: int
) -> None:
    rng = np.random.default_rng(7)
    flag = random_rows(rng, 2, 2)
    ends = intersect(fibre(CIRCLE, flag[0]), curve(equation), 1j, TRACKER)
    counted = (ends.regular.sum(), (ends.finite & ~ends.regular).sum(), ends.counts.at_infinity)
    assert counted == (regular, singular, infinite) and ends.counts.failed == 0


@pytest.mark.parametrize(
    ("equation", "finite_ones", "infinite"),
    [
        ("x - 1", 0, 2),  # Touches at (1, 0).
        ("x*y", 2, 2),  # Also at (0, 1) and (0, -1).
        ("y - 1/10^20", 2, 0),
        ("x - 1 + 1/10^20", 2, 0),  # At y of about 1.4e-10.
    ],
)
@pytest.mark.parametrize("seed", range(3))
def test_ends_at_a_variable_that_must_not_vanish_count_as_infinite_and_small_ones_do_not(
    equation: str, finite_ones: int, infinite: int, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    flag = random_rows(rng, 2, 2)
    gamma = complex(unit_complex(rng))
    ends = intersect(fibre(CIRCLE, flag[0]), curve(equation), gamma, TRACKER, nonzero=(1,))
    counted = (int(ends.finite.sum()), ends.counts.at_infinity, ends.counts.failed)
    assert counted == (finite_ones, infinite, 0)
    assert (ends.x[ends.finite, 1] != 0).all()


def test_what_lies_on_the_hypersurface_stays_and_the_rest_is_cut() -> None:
    rng = np.random.default_rng(8)
    flag = random_rows(rng, 2, 2)
    both = fibre(f"({CIRCLE})*({LINE})", flag[0])
    crossed = hypersurface_section({1: [both]}, curve(LINE), rng, TRACKER)
    (kept,) = crossed.kept[1]
    assert len(kept) == 1 and abs(3 * kept.x[0, 0] - 4 * kept.x[0, 1]) < 1e-12
    (ends,) = crossed.ends[0]
    assert ends.cut.polynomials[-1] == curve(LINE) and ends.counts.tracked == 2
    found = finite(ends)[:, :2]
    assert np.abs(np.abs(found) - [[0.8, 0.6]] * 2).max() < 1e-8
    assert crossed.counts.tracked == 2


def test_the_whole_plane_is_cut_to_the_hypersurface_itself() -> None:
    rng = np.random.default_rng(10)
    flag = random_rows(rng, 2, 2)
    point = np.linalg.solve(flag[:, 1:], -flag[:, 0])
    plane = Fibre(Cut(2, 0, ()), flag, point[None])
    crossed = hypersurface_section({2: [plane]}, curve(CIRCLE), rng, TRACKER)
    found = finite(crossed.ends[1][0])[:, :2]
    assert len(found) == 2
    assert np.abs((found**2).sum(axis=1) - 1).max() < 1e-14
    assert np.abs(flag[0, 0] + found @ flag[0, 1:]).max() < 1e-14


@pytest.mark.parametrize(("nonzero", "kept"), [((), 3), ((0,), 2), ((1,), 3), ((0, 1), 2)])
def test_zeros_on_a_line_where_a_variable_vanishes_that_must_not_are_no_ends(
    nonzero: tuple[int, ...], kept: int
) -> None:
    flag = random_rows(np.random.default_rng(3), 2, 2)
    ends = intersect(whole_space(flag), curve("x*(x - 1/10^20)*(y - 1)"), 1j, TRACKER, nonzero)
    assert (int(ends.finite.sum()), int(ends.regular.sum())) == (kept, kept)
    assert not ends.counts.tracked and not ends.failed.any()
    assert np.isclose(ends.x[ends.finite, 0], 1e-20, rtol=1e-12, atol=0).sum() == 1
