"""Random planar linkages of any number of loops."""

from __future__ import annotations

import random
from fractions import Fraction

from nag.mechanism.linkage import Link, Linkage, Place


def random_linkage(loops: int, seed: int, rigid: bool = False) -> Linkage:
    """A four-bar, and dyads between plates of what there is, each a loop more; one freedom.

    Args:
        rigid: whether a bar between two plates takes that freedom.
    """
    rng = random.Random(seed)
    plates: dict[str, list[str]] = {name: [] for name in ("base", "crank", "coupler", "rocker")}
    places: dict[str, Place] = {}
    pins = 0

    def joined(first: str, second: str) -> None:
        nonlocal pins
        pins += 1
        for plate in (first, second):
            plates[plate].append(f"P{pins}")
        places[f"P{pins}"] = (_number(rng), _number(rng))

    for first, second in zip(plates, [*list(plates)[1:], "base"], strict=True):
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
    links = []
    for name, own in plates.items():
        # A bar of another length than the placement's: what it holds is in general position.
        size = Fraction(11, 10) if name == "bar" else Fraction(1)
        (x, y), *_ = (places[pin] for pin in own)
        shape = tuple(((places[p][0] - x) * size, (places[p][1] - y) * size) for p in own)
        links.append(Link(name, tuple(own), shape))
    return Linkage("base", tuple(links))


def _number(rng: random.Random) -> Fraction:
    return Fraction(rng.randint(-60, 60), 6)
