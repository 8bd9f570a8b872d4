"""The start system with the least work."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from nag.errors import NagError, StartError
from nag.solving.start import ASKED_FOR
from nag.solving.start.multihomogeneous import (
    MOST_TERMS,
    Groups,
    best_groups,
    multihomogeneous,
    terms_of_start,
)
from nag.solving.start.target import StartSystem, Target, group_degrees
from nag.solving.start.total_degree import Shape, bezout, has_bezouts_volume, total_degree
from nag.tracking.track import find_finished_paths

# The sets of homogeneous coordinates of so many variables are looked through in two milliseconds.
MOST_VARIABLES = 13
# So few paths are tracked in less time than groups of variables take to be found for fewer.
FEW = 64
# Mixed cells of systems with few paths are found in half a millisecond, which each path to infinity
# takes and more; fewer paths than these may as well be tracked.
FEWEST = 4
# Where no start system saves paths, one of so many is tried in doubles, if there are so many in
# all, and at most so many. Where more than this part of them does not end there, the paths of a
# polyhedral start are better: its monomials take less time than products of linear forms in more
# digits, and may keep the target's symmetries.
TRIED_OF, LEAST_TRIED, MOST_TRIED, UNFINISHED = 64, 8, 32, 0.2


def check_kind(kind: str) -> None:
    """Make sure that there is such a start system.

    Raises:
        ValueError: if there is none.
    """
    if kind not in ASKED_FOR:
        raise NagError(f"start: no start system {kind!r}; there are {', '.join(ASKED_FOR)}")


def choose(
    target: Target,
    kind: str,
    given: Groups,
    rng: np.random.Generator,
    threads: int,
    generic: bool = False,
) -> tuple[StartSystem, str]:
    """A start system of the ``kind`` asked for, and why that one, in one sentence.

    With ``generic`` a total degree start has powers of generic linear forms.

    Raises:
        StartError: if there is none, or it would have too many paths.
        ValueError: if there is no such kind.
    """
    check_kind(kind)
    start, reason = _make_start(target, kind, given, rng, threads, generic)
    return replace(start, homotopy=replace(start.homotopy, digits=target.digits)), reason


def _make_start(
    target: Target, kind: str, given: Groups, rng: np.random.Generator, threads: int, generic: bool
) -> tuple[StartSystem, str]:
    total = bezout(target)
    if kind == "total":
        return total_degree(target, rng, generic), f"total degree, as asked: {_paths(total)}"
    if kind == "polyhedral":
        from nag.solving.start.mixed_cells import mixed_cells
        from nag.solving.start.polyhedral import polyhedral

        sparse = target.sparsest
        start = polyhedral(sparse, mixed_cells(sparse.supports, rng), rng, threads)
        return start, f"polyhedral, as asked: {_paths(len(start.points))}; {start.detail}"
    if kind == "monodromy":
        from nag.solving.start.monodromy import monodromy

        start = monodromy(target.sparsest, rng, threads)
        return start, f"monodromy, as asked: {_paths(len(start.points))}; {start.detail}"
    if kind == "multihomogeneous":
        groups, number = _usable_groups(target, given)
        start = multihomogeneous(target, groups, rng)
        return start, f"multihomogeneous, as asked: {_paths(number)} in {_groups(groups)}"
    return _least_work(target, given, rng, threads, generic)


def _least_work(
    target: Target,
    given: Groups,
    rng: np.random.Generator,
    threads: int,
    generic: bool,
) -> tuple[StartSystem, str]:
    """The start system of least work; ``given`` groups are tried."""
    total, shape, sparse = bezout(target), Shape.of(target), target.sparsest
    tracked = total if generic else shape.interchange.paths(target.degrees)
    counts = [f"total degree {total}"]
    groups, number = (tuple(range(target.n)),), total
    if tracked < total:
        counts = [f"total degree {total} ({tracked} but for interchanges of variables)"]
    # Then no start system has fewer paths.
    dense = total > FEWEST and sparse.degrees == target.degrees
    dense = dense and target.n <= MOST_VARIABLES and has_bezouts_volume(sparse.supports)
    if not dense and (tracked == total or tracked > FEW):
        groups, number = _usable_groups(target, given)
    if len(groups) > 1:
        counts.append(f"multihomogeneous {number} in {_groups(groups)}")
    least, most, bound = min(tracked, number), None, None
    # Few paths may still have infinite ends, which so many zeros show to be that.
    if min(total, number) > FEWEST:
        from nag.solving.start.mixed_cells import mixed_cells
        from nag.solving.start.polyhedral import polyhedral

        try:
            cells = None if dense else mixed_cells(sparse.supports, rng)
            volume = bound = total if cells is None else cells.mixed_volume
            counts.append(f"mixed volume {volume}")
            # Its start system is found by a regular path for each of its own, which doubles finish;
            # a path to infinity that it saves takes as much time as ten of these and more.
            if cells is not None and 0 < volume < least:
                start = polyhedral(sparse, cells, rng, threads)
                return start, f"polyhedral, the least work: {', '.join(counts)}"
            # Zeros in a system's polytopes' directions make them fewer than the mixed volume
            # (Bernshtein, The number of roots of a system of equations, 1975, theorem B); with
            # constant terms, also those on coordinate hyperplanes are among these.
            most = volume if sparse.has_constants and volume else None
        except StartError as error:
            counts.append(str(error))
    elif least > 1:
        counts.append("so few that the mixed volume was not needed")
    if number < tracked:
        name, start = "multihomogeneous", multihomogeneous(target, groups, rng)
    else:
        name, start = "total degree", total_degree(target, rng, generic, shape)
    if bound == least and not _are_finished(start, threads):
        try:
            cells = mixed_cells(sparse.supports, rng) if cells is None else cells
            start = polyhedral(sparse, cells, rng, threads)
            counts.append("of whose paths doubles finish more")
            return start, f"polyhedral, the least work: {', '.join(counts)}"
        except StartError as error:
            counts.append(str(error))
    start = replace(start, known=replace(start.known, most=most, bound=bound))
    return start, f"{name}, the least work: {', '.join(counts)}"


def _are_finished(start: StartSystem, threads: int) -> bool:
    """Whether doubles bring most paths to regular ends, judged by a few of them.

    Where the paths are few, this is not asked.
    """
    number = len(start.points)
    tried = min(number // TRIED_OF, MOST_TRIED)
    if tried < LEAST_TRIED:
        return True
    some = start.points[np.linspace(0, number - 1, tried).astype(int)]
    finished = find_finished_paths(start.homotopy, some, threads=threads)
    return float(np.mean(finished)) > 1 - UNFINISHED


def _usable_groups(target: Target, given: Groups) -> tuple[Groups, int]:
    groups, number = best_groups(target, given)
    degrees = group_degrees(target.rows, groups)
    if terms_of_start(degrees, [len(g) for g in groups]) > MOST_TERMS:
        groups = (tuple(range(target.n)),)
        number = bezout(target)
    return groups, number


def _paths(number: int) -> str:
    return f"{number} path{'' if number == 1 else 's'}"


def _groups(groups: Groups) -> str:
    return "groups of " + ", ".join(str(len(g)) for g in groups)


def mixed_volume(target: Target, start: StartSystem, squared: bool) -> int | None:
    """The mixed volume of the equations' polytopes, each with the origin, if it is known or small.

    No system of these supports has more isolated zeros, by multiplicity, also where coordinates
    vanish (Li & Wang, The BKK root count in C^n, 1996).

    Args:
        start: a start system for the target, which may know it.
        squared: whether the target has zeros that are none of the system's.
    """
    if start.known.bound is not None or squared or len(start.points) > FEW:
        return start.known.bound
    from nag.solving.start.mixed_cells import mixed_cells

    try:
        return mixed_cells(target.sparsest.supports, np.random.default_rng(0)).mixed_volume
    except StartError:
        return None
