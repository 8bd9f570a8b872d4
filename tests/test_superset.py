"""Witness supersets, and what their points are decided by."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest

from nag.algebra.expression import parse_polynomial
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.decomposition import ends
from nag.decomposition.decompose import decompose
from nag.decomposition.ends import EveryEnd, SingularEnds
from nag.decomposition.superset import Superset, _Stage, intersection_order, witness_superset
from nag.tracking.run import Run
from nag.witness import membership
from nag.witness.close_to_sets import NearbyZeros, find_nearby_zeros
from nag.witness.confirm import find_vanishing
from nag.witness.cutting import Cut, Equations
from nag.witness.fibres import Fibre, SliceEnds, whole_space
from nag.witness.membership import Membership
from nag.witness.slices import random_rows
from nag.witness.witness import PathCounts


def polynomials(names: str, *texts: str) -> tuple[Polynomial, ...]:
    variables = tuple(names.split())
    return tuple(parse_polynomial(text, variables) for text in texts)


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_what_only_the_first_equations_see_as_multiple_is_not_deflated(seed: int) -> None:
    rng = np.random.default_rng(seed)
    flag = random_rows(rng, 3, 3)
    equations = polynomials("x y z", "y - x^3", "y + x^3", "x*(z^3 + 2)")
    found = witness_superset(equations, {3: [whole_space(flag)]}, rng, Run())
    assert not found.notes and not found.counts.failed
    assert Counter({d: sum(map(len, f)) for d, f in found.fibres.items()}) == Counter({1: 1})
    assert all(not f.cut.deflated for f in found.fibres[1])


@pytest.mark.parametrize("size", [1, 30, 1000])
def test_a_value_of_one_is_told_from_zero_beside_large_terms(size: int) -> None:
    cut = Cut(4, 0, polynomials("x y z w", f"x - {size}", f"y + {size}", f"z - 2*{size}", "w"))
    point = np.array([[size, -size, 2 * size, 0]], dtype=complex)
    rows = np.zeros((0, 5), dtype=complex)
    product, shifted = polynomials("x y z w", "x*y*z*w", "x*y*z*w - 1")
    fibre = Fibre(cut, rows, point)
    assert find_vanishing(fibre, product) == [True]
    assert find_vanishing(fibre, shifted) == [False]


def test_a_small_coordinate_is_told_from_zero() -> None:
    cut = Cut(2, 0, polynomials("x y", "10^24*x - 1", "y - 10^9"))
    point, rows = np.array([[1e-24, 1e9]], dtype=complex), np.zeros((0, 3), dtype=complex)
    x, zero = polynomials("x y", "x", "10^15*x*y - 1")
    fibre = Fibre(cut, rows, point)
    assert find_vanishing(fibre, x) == [False]
    assert find_vanishing(fibre, zero) == [True]


SADDLE, CONE, DOUBLE = "(x*y - z)", "(x*y - z^2)", "(x*y - z)^2"


# What deflation makes regular may lie on larger components, or on others of the same dimension:
# seeds that took such points for components of their own.
@pytest.mark.parametrize(
    ("factors", "seed", "expected"),
    [
        ((DOUBLE, CONE), 1, {(2, 2, 2): 1, (2, 2, 1): 1, (1, 1, 3): 1}),
        ((SADDLE, CONE), 2, {(2, 2, 1): 2, (1, 1, 3): 1}),
        (("(x - 1)", "(y - 2)"), 5, {(2, 1, 1): 2, (1, 1, 3): 1}),
    ],
)
def test_a_triple_line_beside_surfaces_adds_nothing_but_itself(
    factors: tuple[str, ...], seed: int, expected: dict[tuple[int, int, int], int]
) -> None:
    common = "*".join(factors)
    equations = polynomials("x y z", *(f"{common}*{q}" for q in ("x^2", "x*y", "y^2")))
    answer = decompose(PolynomialSystem(("x", "y", "z"), equations), seed=seed)
    assert answer.complete
    assert Counter((c.dimension, c.degree, c.multiplicity) for c in answer.components) == expected


@pytest.mark.parametrize("seed", [0, 1])
def test_an_isolated_end_of_a_deflated_surface_may_lie_on_a_curve(seed: int) -> None:
    curve = ("(y^2 - x^3 - x^2)", "(z + 1)")
    texts = [f"{DOUBLE}*{q}*{c}" for q in ("x^2", "x*y", "y^2") for c in curve]
    system = PolynomialSystem(("x", "y", "z"), polynomials("x y z", *texts))
    answer = decompose(system, seed=seed)
    assert answer.complete
    found = Counter((c.dimension, c.degree, c.multiplicity) for c in answer.components)
    assert found == {(2, 2, 2): 1, (1, 3, 1): 1, (1, 1, 3): 1}


def test_digits_tell_points_from_larger_sets_where_paths_do_not(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    lost = Membership.UNDECIDED, PathCounts()
    monkeypatch.setattr("nag.decomposition.superset.is_on_larger_set", lambda *_: lost)
    # The line x = 0 and the double point (1, 1).
    equations = Equations(polynomials("x y", "x*(x - 1)^2", "x*(y - 1)"), 2)
    points = np.array([[1, 1], [0, 3]], dtype=complex)
    fibre = Fibre(Cut(2, 0, equations.polynomials), np.zeros((0, 3), dtype=complex), points)
    empty = Superset({}, PathCounts(), ())
    stage = _Stage((), (), empty, (), np.random.default_rng(0), Run(), whole=True)
    kept, notes, _ = stage.keep_on_no_other(fibre, {}, equations)
    assert np.array_equal(kept.x, points[:1]) and not notes


# What another cut says of a point: another zero as far as digits go, the same one, or nothing, as
# it has no regular zero there.
@pytest.mark.parametrize(
    ("other", "kept", "untold"),
    [
        *[(f"3*x - 3 - 3/10^{k}", 2, 0) for k in (10, 15, 20, 40, 80)],
        ("3*x - 3", 1, 0),
        ("(x - 1)^2", 1, 1),
    ],
)
def test_regular_ends_of_two_cuts_are_one_point_where_digits_say_so(
    other: str, kept: int, untold: int
) -> None:
    found, rows = np.ones(1, dtype=bool), np.zeros((0, 2), dtype=complex)
    point, accuracy = np.ones((1, 1), dtype=complex), np.full(1, 1e-15)
    cuts = [Cut(1, 0, polynomials("x", text)) for text in ("x - 1", other)]
    pieces = [SliceEnds(cut, rows, point, found, found, ~found, accuracy) for cut in cuts]
    candidates = ends.collect(pieces, ())
    assert sum(map(len, candidates.fibres)) == kept
    assert candidates.untold == untold


@pytest.mark.parametrize(
    ("other", "kept", "doubts"),
    [("x - 1 - 1/10^15", 1, 0), ("x - 1", 0, 0), ("(x - 1)^2", 0, 1)],
)
def test_a_deflated_point_is_left_out_where_digits_say_that_it_is_known(
    other: str, kept: int, doubts: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    alone = Membership.FOREIGN, PathCounts()
    monkeypatch.setattr("nag.decomposition.superset.is_on_larger_set", lambda *_: alone)
    point, rows = np.ones((1, 1), dtype=complex), np.zeros((0, 2), dtype=complex)
    first, second = (
        Fibre(Cut(1, 0, polynomials("x", text)), rows, point) for text in ("x - 1", other)
    )
    empty = Superset({}, PathCounts(), ())
    stage = _Stage((), (), empty, (), np.random.default_rng(0), Run(), whole=True)
    left, notes, _ = stage.keep_on_no_other(first, {0: [second]}, Equations((), 1))
    assert (len(left), len(notes)) == (kept, doubts)


def test_equations_are_met_in_an_order_that_brings_in_few_variables_at_a_time() -> None:
    circles = ("a^2 + b^2 - 1", "c^2 + d^2 - 1", "e^2 + f^2 - 1")
    products = ("a*c + b*d - 2", "c*e + d*f - 2", "a*e + b*f - 3")
    equations = polynomials("a b c d e f", *circles, *products, "a + e")
    assert intersection_order(equations) == [6, 0, 2, 5, 1, 3, 4]


@pytest.mark.parametrize("power", [9, 12, 16, 20])
def test_a_point_close_to_a_conic_is_none_of_its_points(power: int) -> None:
    u, v, w = "(2*x - y + z)", "(x + 3*y - 2*z - 1)", "(y - x + 4*z + 2)"
    conic, near = (f"({u}^2 + {v}^2 - 1)", w), f"1/10^{power}"
    point = (f"({u} - 3/5)", f"({v} - 4/5 - {near})", f"({w} - {near})")
    generators = polynomials("x y z", *(f"{a}*{b}" for a in conic for b in point))
    weights = np.random.default_rng(1).integers(-4, 5, (6, 6)).tolist()
    zero = generators[0] * 0
    equations = [
        sum((g * c for g, c in zip(generators, row, strict=True)), zero) for row in weights
    ]
    answer = decompose(PolynomialSystem(("x", "y", "z"), tuple(equations)))
    assert answer.complete
    found = [(c.dimension, c.degree, c.multiplicity) for c in answer.components]
    assert found == [(1, 2, 1), (0, 1, 1)]


def test_points_closer_to_a_conic_than_doubles_tell_are_isolated() -> None:
    texts = (
        "3*z^4*w - 3*x*z*w^2",
        "4300*x^2*z^2 + 19/10*x*y*w^2 + 100*x*z^2*w - 7/10*x*z*w^2 + 910*x^2*w - 63*z",
        "5/4*x*y + 2*x*z + 2/5*x - 900",
        "-7/10*x*w^2 + 800*y^2*z",
    )
    answer = decompose(PolynomialSystem(tuple("xyzw"), polynomials("x y z w", *texts)))
    assert answer.complete
    found = Counter((c.dimension, c.degree, c.multiplicity) for c in answer.components)
    assert found == {(1, 2, 1): 1, (0, 1, 1): 26, (0, 1, 2): 2}


@pytest.mark.parametrize("located", [True, False])
def test_an_end_that_is_no_known_zero_is_not_taken_for_a_point_of_a_set(
    located: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where its zero is known, and multiple, it is what the paths of the set lead to."""
    monkeypatch.setattr(ends, "find_nearby_zeros", lambda *_: NearbyZeros((), False, located))
    monkeypatch.setattr(ends, "admit_end", lambda *_, **__: False)
    member = (Membership.MEMBER, PathCounts())
    monkeypatch.setattr(ends, "is_on_larger_set", lambda *_: member)
    rng = np.random.default_rng(0)
    singular = ends.SingularEnds(Equations((), 3), np.zeros((0, 4)), rng, Run())
    doubts = singular.add([(np.zeros(3), 1e-15)], {0: []}).doubts
    assert bool(doubts) is not located


@pytest.mark.parametrize(
    ("answers", "whole"), [("UM", "M"), ("UF", "U"), ("FU", "U"), ("FF", "F"), ("", "F")]
)
def test_a_point_is_on_larger_sets_if_it_is_on_one_whatever_others_leave_open(
    answers: str, whole: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    words = {each.name[0]: each for each in Membership}
    given = iter(answers)
    one = PathCounts(1)
    monkeypatch.setattr(membership, "is_member", lambda *_: (words[next(given)], one))
    sets = {k: [] for k in range(len(answers) + 1)}
    rng = np.random.default_rng(0)
    found, counts = membership.is_on_larger_set(np.zeros(1), 1e-15, sets, 0, rng, Run())
    assert found is words[whole] and counts.tracked == len(answers)


@pytest.mark.parametrize(("failed", "said"), [(1, "1 path failed"), (2, "2 paths failed")])
def test_paths_that_failed_are_counted_in_words(failed: int, said: str) -> None:
    assert Superset({}, PathCounts(9, failed), ()).doubts == [f"{said}; points may be missing"]


@pytest.mark.parametrize("seed", range(5))
def test_where_a_variable_vanishes_that_vanishes_at_no_solution_is_no_step_to_one(
    seed: int,
) -> None:
    rng = np.random.default_rng(seed)
    names = ("x*(x - y)*(z - x)", "y^2*(z - 2)*(x - z)", "x*y*z^2 - 1/10^9")
    equations = polynomials("x y z", *names)
    found = witness_superset(equations, {3: [whole_space(random_rows(rng, 3, 3))]}, rng, Run())
    assert not found.notes and not found.counts.failed and found.counts.at_infinity > 0
    # The plane x = z meets the last one in a curve; the line x = y, z = 2 meets it in two points.
    assert {d: sum(map(len, fibres)) for d, fibres in found.fibres.items()} == {1: 4, 0: 2}
    two = np.vstack([fibre.x for fibre in found.fibres[0]])
    assert np.abs(4 * two[:, 0] ** 2 - 1e-9).max() < 1e-22


@pytest.mark.parametrize(
    ("names", "excluded", "unclear"),
    [
        (("(x - 1)^2", "x*y"), True, 0),
        (("(x - 1)^2", "y - x/10^20"), False, 0),  # A double zero beside y = 0.
        (("(x - 1)^2", "(y - x/10^30)*(y - 2*x/10^30)"), False, 0),
        (("(x - 1)^2", "y*(y - x/10^40)"), True, 1),  # One of the two that the end may be.
        (("(x - 1)^2 + 1/100", "y - 1"), True, 1),  # Nothing is known to vanish there.
    ],
)
def test_singular_ends_are_left_out_in_silence_only_where_digits_say_so(
    names: tuple[str, ...], excluded: bool, unclear: int
) -> None:
    cut, found = Cut(2, 0, tuple(polynomials("x y", *names))), np.ones(1, dtype=bool)
    points, rows = np.array([[1, 1e-20j]]), np.zeros((0, 3), dtype=complex)
    end = SliceEnds(cut, rows, points, found, ~found, ~found, np.full(1, 1e-14))
    out, doubtful = ends.find_excluded([Polynomial.variable(2, 1)], end)
    assert (out.tolist(), doubtful) == ([excluded], unclear)


def test_a_variable_that_equations_keep_from_zero_may_be_smaller_than_digits_tell() -> None:
    cut, found = Cut(2, 0, polynomials("x y", "x - 10^30", "y - 1/10^90")), np.ones(1, dtype=bool)
    points, rows = np.array([[1e30, 1e-90 + 0j]]), np.zeros((0, 3), dtype=complex)
    end = SliceEnds(cut, rows, points, found, found, ~found, np.full(1, 1e-15))
    y = Polynomial.variable(2, 1)
    assert ends.find_excluded([y], end, [1])[0].tolist() == [False]
    assert sum(map(len, ends.collect([end], [y], [1]).fibres)) == 1


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(
    ("texts", "multiplicities"),
    [
        # Planes that touch a cone along lines, and a sphere in points of these.
        (("x^2 + y^2 - z^2", "(z - x)*(z + x + 2)", "x^2 + y^2 + z^2 - 2*z"), {2, 4}),
        # A surface, twice, for the first equation; both meet the second in a cusp.
        (("(x*y - z)^2*(x + y)", "z - x*y + y^3", "x + z - 2"), {2, 3, 6}),
    ],
)
def test_paths_end_at_a_zero_as_often_as_its_multiplicity_says(
    texts: tuple[str, ...],
    multiplicities: set[int],
    seed: int,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    counted: list[tuple[int, int]] = []
    add = SingularEnds.add

    def record(self, cluster, *others):
        place = self.equations, self.rows, np.random.default_rng(0)
        found = find_nearby_zeros(cluster, *place).zeros
        if self.every is not None and found:
            multiplicity = sum(zero.multiplicity for zero in found)
            counted.append((self.every.count_near(cluster), multiplicity))
        return add(self, cluster, *others)

    monkeypatch.setattr(SingularEnds, "add", record)
    equations = polynomials("x y z", *texts)
    rng = np.random.default_rng(seed)
    space = whole_space(random_rows(rng, 3, 3))
    witness_superset(equations, {3: [space]}, rng, Run())
    assert counted and all(most == multiplicity for most, multiplicity in counted)
    assert {multiplicity for _, multiplicity in counted} <= multiplicities


def test_ends_that_are_not_known_count_as_near_every_point() -> None:
    x = np.array([[1.0, 0], [1.0001, 0], [np.nan, np.nan], [2, 0]], dtype=complex)
    every = EveryEnd(x, np.array([1, 2, 3, 5]))
    assert every.count_near([(x[0], 1e-12)]) == 6
