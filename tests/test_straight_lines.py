"""What lengths alone put in line, and what is said of it."""

from fractions import Fraction
from itertools import combinations, pairwise

from hypothesis import given, settings
from hypothesis import strategies as st

from nag.mechanism.assembly import Side
from nag.mechanism.straight_lines import find_forced_lines


@st.composite
def stretched_rings(draw: st.DrawFn) -> tuple[dict[str, int], dict[str, int]]:
    """Places on a line with the sides between neighbours, between the ends, and some others."""
    gaps = draw(st.lists(st.integers(1, 9), min_size=2, max_size=5))
    at = {name: sum(gaps[:i]) for i, name in enumerate("ABCDEF"[: len(gaps) + 1])}
    names = list(at)
    pairs = [*pairwise(names), (names[0], names[-1])]
    pairs += draw(st.lists(st.sampled_from(list(combinations(names, 2))), max_size=4))
    return at, {p + q: at[q] - at[p] for p, q in draw(st.permutations(list(dict.fromkeys(pairs))))}


@settings(max_examples=60, deadline=None)
@given(stretched_rings(), st.sampled_from([Fraction(1), Fraction(2), Fraction(1, 3)]))
def test_all_places_of_a_stretched_ring_are_in_line_at_their_distances(ring, squared_scale) -> None:
    at, sides = ring
    found = find_forced_lines(
        [Side((name[0], name[1]), squared_scale * x * x, name) for name, x in sides.items()]
    )
    assert not found.obstacle
    (line,) = found.lines
    assert set(line) == set(at)
    for p, q in combinations(at, 2):
        gap = line[q] - line[p]
        assert gap * gap == squared_scale * (at[q] - at[p]) ** 2
    assert found.stretched
    for text in found.stretched:
        side, way = text.removesuffix(" together").split(" is as long as ")
        assert sides[side] == sum(sides[name] for name in way.replace(" and ", ", ").split(", "))


@given(stretched_rings())
def test_a_side_that_is_longer_than_the_way_round_forbids_real_assemblies(ring) -> None:
    at, sides = ring
    names = list(at)
    longest = names[0] + names[-1]
    found = find_forced_lines(
        [
            Side((n[0], n[1]), (x + (n == longest) * Fraction(1, 10**12)) ** 2, n)
            for n, x in sides.items()
        ]
    )
    assert "longer than" in found.obstacle


def test_places_of_one_link_that_are_in_line_are_forced_by_nothing() -> None:
    plate = [
        Side(ends, Fraction(x * x), "link plate")
        for ends, x in [(("A", "B"), 1), (("B", "C"), 2), (("A", "C"), 3)]
    ]
    bars = [Side(("A", "D"), Fraction(4), "bar 1"), Side(("C", "D"), Fraction(9), "bar 2")]
    assert find_forced_lines([*plate, *bars]).lines == ()
    (line,) = find_forced_lines([*plate, bars[0], Side(("C", "D"), Fraction(1), "bar 2")]).lines
    assert set(line) == {"A", "B", "C", "D"}
