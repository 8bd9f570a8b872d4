"""Random planar linkages of any number of loops, by their links or placed in space."""

from __future__ import annotations

import random
from collections.abc import Sequence
from fractions import Fraction

from nag.mechanism.graph import Joint, Mechanism
from nag.mechanism.linkage import Link, Linkage, Place

Axes = tuple[Sequence[int], Sequence[int], Sequence[int]]
FLAT: Axes = ((1, 0, 0), (0, 1, 0), (0, 0, 1))


def random_linkage(loops: int, seed: int, rigid: bool = False) -> Linkage:
    """The links of a four-bar and of dyads between plates of what there is, each a loop more.

    Args:
        rigid: whether a bar between two plates takes the freedom that is left.
    """
    plates, places = _placed(loops, seed, rigid)
    links = []
    for name, own in plates.items():
        # A bar of another length than the placement's: what it holds is in general position.
        size = Fraction(11, 10) if name == "bar" else Fraction(1)
        x, y = places[own[0]]
        shape = tuple(((places[p][0] - x) * size, (places[p][1] - y) * size) for p in own)
        links.append(Link(name, tuple(own), shape))
    return Linkage("base", tuple(links))


def random_planar_mechanism(loops: int, seed: int, axes: Axes = FLAT) -> Mechanism:
    """The same links, placed along the first two of the axes and turning about the third."""
    plates, places = _placed(loops, seed, False)
    joints = []
    for pin, (x, y) in places.items():
        bodies = [name for name, own in plates.items() if pin in own]
        point = tuple(x * a + y * b for a, b in zip(*axes[:2], strict=True))
        joints.append(Joint(pin, "revolute", (bodies[0], bodies[1]), point, tuple(axes[2])))
    return Mechanism("base", tuple(joints))


def _placed(loops: int, seed: int, rigid: bool) -> tuple[dict[str, list[str]], dict[str, Place]]:
    """The pins of each plate, each on two of them, and the place of each."""
    rng = random.Random(seed)
    plates: dict[str, list[str]] = {name: [] for name in ("base", "crank", "coupler", "rocker")}
    places: dict[str, Place] = {}

    def joined(first: str, second: str) -> None:
        pin = f"P{len(places) + 1}"
        for plate in (first, second):
            plates[plate].append(pin)
        places[pin] = (_number(rng), _number(rng))

    ring = list(plates)
    for first, second in zip(ring, [*ring[1:], "base"], strict=True):
        joined(first, second)
    for k in range(1, loops):
        ends = rng.sample(list(plates), 2)
        dyad = [f"first{k}", f"second{k}"]
        plates |= {name: [] for name in dyad}
        for first, second in zip([ends[0], *dyad], [*dyad, ends[1]], strict=True):
            joined(first, second)
    if rigid:
        ends = rng.sample(list(plates), 2)
        plates["bar"] = []
        for end in ends:
            joined("bar", end)
    return plates, places


def _number(rng: random.Random) -> Fraction:
    return Fraction(rng.randint(-60, 60), 6)
