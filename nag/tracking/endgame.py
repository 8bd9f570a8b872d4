"""Cauchy endgame: which point to track to next, and when the end of a path is known.

The kernel tracks each lane along straight segments. When a lane arrives, `arrived` looks at its
phase and either names the next target or closes the path. The endgame variable is
``sigma = (t / (1 - t)) ** d``, in which loops are counted (Morgan, Sommese & Wampler 1991; the
judgement of convergence by the Fourier modes of negative order is explained at `_analyze`).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from nag.machine_code.records import Complexes, Reals, Wholes

MAIN, SHORTCUT, LOOP, SHRINK = 0, 1, 2, 3
# Outcomes of a path.
FAILED, STRAIGHT, CAUCHY = 0, 1, 2
# Reasons of failure.
STEP_SIZE, STEPS, START, ENDGAME, NOT_FINITE = 1, 2, 3, 4, 5


class Endgame(NamedTuple):
    """State of the endgame for the eight paths of a batch, and its settings.

    The arrays are flat, the lane is the slowest index: scalar
    ``X`` of a lane is ``real[REALS * lane + X]`` or ``whole[WHOLES * lane + X]``, coordinate ``j``
    of its points is ``best[N * lane + j]``.

    ``samples``: normalised points round the current loop. ``patch``: linear forms that normalise
    them. ``best``: best estimate of the end point so far; ``saved``: the point where the current
    loop or shortcut began. ``mean, turn``: scratch. ``real`` and ``whole``: scalars, see the index
    constants. ``patience``: number of radii at which loops are not made, or broken off, near branch
    points.
    """

    samples: Complexes
    patch: Complexes
    best: Complexes
    saved: Complexes
    mean: Complexes
    turn: Complexes
    real: Reals
    whole: Wholes
    exponent: int
    active: bool
    shortcut: bool
    patience: int
    radius: float
    per_loop: int
    max_winding: int
    levels: int


# Columns of Endgame.real.
(
    RADIUS,
    ANGLE,
    BEST_ERROR,
    LAST_RATIO,
    FIRST_HINT,
    SAVED_RE,
    SAVED_IM,
    SAVED_ANGLE,
    NEXT_RE,
    NEXT_IM,
    NOISE,
    HINT,
) = range(12)
REALS = 12
# Columns of Endgame.whole.
PHASE, SAMPLE, LEVEL, WINDING, LAST_WINDING, SHORT_STEPS, NO_SHORTCUT = range(7)
WHOLES = 7
# Radius of convergence over |t| from where on a path may run straight to t = 0. Where it ends
# singularly, the estimate from the coefficients of t ** q, 0 < q < 1, lies between 1.25 and 1.7,
# and the branch point is found nearer to 0 than this part of |t|.
STRAIGHT_ON, SURELY_STRAIGHT_ON, AT_THE_END = 1.25, 1.7, 0.2
# Radius of convergence in log t within which no other branch point is likely to lie: 8 samples
# a loop tell 1e-6 where it is exp(1.7) times as far as the loop.
ALONE = 2.0
# The same where a loop has met a branch point.
DISTURBED = 1.0
# Growth of the part of negative modes from one radius to the next, and their size in rounding
# errors, that give branch points within a loop away.
GROWTH_WITHIN, CLEARLY = 2.0, 100.0
# Radii at which loops wait for better, unless they are to be made at once.
PATIENCE = 8


def endgame_state(
    N: int,
    exponent: int,
    active: bool,
    shortcut: bool,
    patience: int,
    radius: float,
    per_loop: int,
    max_winding: int,
    levels: int,
) -> Endgame:
    """Fresh state for eight lanes in ``N`` coordinates."""
    room = per_loop * max_winding + 1
    return Endgame(
        np.zeros(8 * room * N if active else 1, dtype=np.complex128),
        np.zeros(8 * N, dtype=np.complex128),
        np.zeros(8 * N, dtype=np.complex128),
        np.zeros(8 * N, dtype=np.complex128),
        np.zeros(N, dtype=np.complex128),
        np.zeros(room, dtype=np.complex128),
        np.zeros(8 * REALS),
        np.zeros(8 * WHOLES, dtype=np.int64),
        exponent,
        active,
        shortcut,
        patience,
        radius ** (1.0 / exponent),
        per_loop,
        max_winding,
        levels,
    )


def _at(s, e, lane, k):
    return (lane * (e.per_loop * e.max_winding + 1) + k) * s.N


def _keep(s, target, lane, x):
    for j in range(s.N):
        target[s.N * lane + j] = x[j]


def _aim(e, lane):
    radius = e.real[REALS * lane + RADIUS]
    angle = e.real[REALS * lane + ANGLE]
    s = complex(radius * math.cos(angle), radius * math.sin(angle))
    t = s / (1.0 + s)
    e.real[REALS * lane + NEXT_RE] = t.real
    e.real[REALS * lane + NEXT_IM] = t.imag


def begin(e, lane):
    """Phase and first target of a path that starts at t = 1."""
    for k in range(WHOLES):
        e.whole[WHOLES * lane + k] = 0
    for k in range(REALS):
        e.real[REALS * lane + k] = 0.0
    e.real[REALS * lane + BEST_ERROR] = 1e300
    e.real[REALS * lane + LAST_RATIO] = 1e300
    e.whole[WHOLES * lane + PHASE] = MAIN
    if e.active:
        e.real[REALS * lane + RADIUS] = e.radius
        _aim(e, lane)


def _begin_loop(s, e, lane, x):
    e.whole[WHOLES * lane + PHASE] = LOOP
    e.whole[WHOLES * lane + SAMPLE] = 0
    last = s.N - 1 if e.exponent > 1 else s.N
    for g in range(s.groups):
        total = 0.0
        for j in range(last):
            if s.group_of[j] == g:
                total += abs(x[j]) ** 2
        for j in range(s.N):
            if s.group_of[j] == g:
                e.patch[s.N * lane + j] = x[j].conjugate() / total if j < last else 0.0


def _keep_sample(s, e, lane, x):
    k = e.whole[WHOLES * lane + SAMPLE]
    for g in range(s.groups):
        scale = 0j
        for j in range(s.N):
            if s.group_of[j] == g:
                scale += e.patch[s.N * lane + j] * x[j]
        for j in range(s.N):
            if s.group_of[j] == g:
                e.samples[_at(s, e, lane, k) + j] = x[j] / scale
    if e.exponent > 1:
        e.samples[_at(s, e, lane, k) + s.N - 1] = 0.0
    e.whole[WHOLES * lane + SAMPLE] = k + 1
    e.real[REALS * lane + ANGLE] += 2.0 * math.pi / (e.per_loop * e.exponent)
    _aim(e, lane)


def _closed(s, e, lane, last):
    """Whether sample ``last`` is the first one again."""
    distance = 0.0
    spread = 0.0
    for j in range(s.N):
        distance = max(
            distance, abs(e.samples[_at(s, e, lane, last) + j] - e.samples[_at(s, e, lane, 0) + j])
        )
        for k in range(1, last):
            spread = max(
                spread, abs(e.samples[_at(s, e, lane, k) + j] - e.samples[_at(s, e, lane, 0) + j])
            )
    return distance <= max(20.0 * e.real[REALS * lane + NOISE], 1e-6 * spread)


def _analyze(s, e, lane, count):
    """Sizes of the samples' modes of negative and positive order; their mean into ``e.mean``.

    Round a loop that encloses no branch point but the centre, a branch is a power series in
    ``sigma ** (1 / w)``: no mode of negative order. Agreement of the means at two radii proves
    less: both loops may lie between inner and outer branch points.
    """
    negative = 0.0
    total = 0.0
    mean = e.mean
    for j in range(s.N):
        mean[j] = 0j
    for k in range(count):
        for j in range(s.N):
            mean[j] += e.samples[_at(s, e, lane, k) + j]
    for j in range(s.N):
        mean[j] /= count
    for k in range(count):
        for j in range(s.N):
            z = e.samples[_at(s, e, lane, k) + j] - mean[j]
            total += z.real * z.real + z.imag * z.imag
    total /= count
    turn = e.turn
    for k in range(count):
        turn[k] = complex(math.cos(2 * math.pi * k / count), math.sin(2 * math.pi * k / count))
    for m in range(1, (count + 1) // 2):
        for j in range(s.N):
            c = 0j
            for k in range(count):
                c += (e.samples[_at(s, e, lane, k) + j] - mean[j]) * turn[(m * k) % count]
            c /= count
            negative += c.real * c.real + c.imag * c.imag
    return math.sqrt(negative), math.sqrt(max(total - negative, 0.0))


def _shrink(e, lane):
    e.whole[WHOLES * lane + LEVEL] += 1
    if e.whole[WHOLES * lane + LEVEL] >= e.levels:
        return False
    e.whole[WHOLES * lane + PHASE] = SHRINK
    e.real[REALS * lane + RADIUS] *= 0.1 ** (1.0 / e.exponent)
    _aim(e, lane)
    return True


def give_up(e, lane):
    """Outcome of a path that cannot go on: its best estimate, if one was judged converged."""
    if e.real[REALS * lane + BEST_ERROR] < 1e-6:
        return CAUCHY
    return FAILED


def arrived(s, e, lane, x, noise, hint, radius, turned, branch, t):
    """A lane arrived at its target.

    Args:
        s: the system; e: endgame state; lane: which one.
        x: the point, shape (N,); ``best`` of the lane receives the end point.
        noise: estimated error of ``x``; hint: pivot ratio of its Jacobian.
        radius: radius of convergence of the Taylor series at ``x``; turned: of that in ``log t``.
        branch: nearest branch point as it seems; t: where the path is.

    Returns:
        0 to go on to the target ``NEXT_RE, NEXT_IM``; -1 to go back to the point ``saved`` first;
        else 10 plus the outcome.
    """
    phase = e.whole[WHOLES * lane + PHASE]
    # Round a loop the largest error counts: estimates of rounding errors may come out too small.
    before = e.real[REALS * lane + NOISE] if phase == LOOP else 1e-15
    e.real[REALS * lane + NOISE] = max(noise, before)
    if phase == MAIN and not e.active:
        _keep(s, e.best, lane, x)
        e.real[REALS * lane + BEST_ERROR] = noise
        e.whole[WHOLES * lane + WINDING] = 1
        e.real[REALS * lane + HINT] = hint
        return 10 + STRAIGHT
    if phase == SHORTCUT:
        if hint > 1e-3 * e.real[REALS * lane + FIRST_HINT] and noise < 1e-8:
            _keep(s, e.best, lane, x)
            e.real[REALS * lane + BEST_ERROR] = noise
            e.real[REALS * lane + HINT] = hint
            e.whole[WHOLES * lane + WINDING] = 1
            return 10 + STRAIGHT
        retreat(s, e, lane, True)
        return -1
    if phase in (MAIN, SHRINK):
        e.real[REALS * lane + FIRST_HINT] = hint
        _keep(s, e.saved, lane, x)
        e.real[REALS * lane + SAVED_RE] = t.real
        e.real[REALS * lane + SAVED_IM] = t.imag
        e.real[REALS * lane + SAVED_ANGLE] = e.real[REALS * lane + ANGLE]
        straight = e.shortcut and e.whole[WHOLES * lane + NO_SHORTCUT] == 0
        far = radius > STRAIGHT_ON * abs(t) and abs(branch) > AT_THE_END * abs(t)
        if straight and (far or radius > SURELY_STRAIGHT_ON * abs(t)):
            e.whole[WHOLES * lane + PHASE] = SHORTCUT
            e.whole[WHOLES * lane + SHORT_STEPS] = 0
            e.real[REALS * lane + NEXT_RE] = 0.0
            e.real[REALS * lane + NEXT_IM] = 0.0
            return 0
        wait = turned < ALONE and e.whole[WHOLES * lane + LEVEL] < e.patience
        if wait and _shrink(e, lane):
            return 0
        _begin_loop(s, e, lane, x)
    _keep_sample(s, e, lane, x)
    last = e.whole[WHOLES * lane + SAMPLE] - 1
    patient = e.whole[WHOLES * lane + LEVEL] < e.patience
    disturbed = patient and turned < DISTURBED
    if not disturbed and (last == 0 or last % e.per_loop != 0):
        return 0
    if disturbed or not _closed(s, e, lane, last):
        # Far out, long cycles are more likely cycles of branch points further in.
        longest = e.max_winding
        if not patient:
            longest = min(longest, 2 << e.whole[WHOLES * lane + LEVEL])
        if not disturbed and last < e.per_loop * longest:
            return 0
        e.real[REALS * lane + LAST_RATIO] = 1e300
        # The path now is on another branch of its cycle: back to its own.
        e.real[REALS * lane + ANGLE] = e.real[REALS * lane + SAVED_ANGLE]
        if _shrink(e, lane):
            return -1
        return 10 + give_up(e, lane)
    winding = last // e.per_loop
    negative, positive = _analyze(s, e, lane, last)
    error = max(negative, e.real[REALS * lane + NOISE] / math.sqrt(last))
    quiet = negative <= 3.0 * e.real[REALS * lane + NOISE]
    ratio = negative / positive if positive > 0.0 else 0.0
    same = winding == e.whole[WHOLES * lane + LAST_WINDING]
    trusted = (
        ratio < 1e-6
        or quiet
        or (ratio < 1e-4 and same and e.real[REALS * lane + LAST_RATIO] < 1e-4)
    )
    # Modes of negative order that outlast a tenth of the radius come from branch points within.
    growing = ratio > GROWTH_WITHIN * e.real[REALS * lane + LAST_RATIO]
    if growing and negative > CLEARLY * e.real[REALS * lane + NOISE]:
        e.real[REALS * lane + BEST_ERROR] = 1e300
        trusted = False
    if trusted:
        known = e.real[REALS * lane + BEST_ERROR]
        if error < known:
            _keep(s, e.best, lane, e.mean)
            e.real[REALS * lane + BEST_ERROR] = error
            e.whole[WHOLES * lane + WINDING] = winding
        # What a tenth of the radius does not improve tenfold is noise.
        if e.real[REALS * lane + BEST_ERROR] < 1e-11 or error > 0.1 * known:
            return 10 + CAUCHY
    e.real[REALS * lane + LAST_RATIO] = ratio
    e.whole[WHOLES * lane + LAST_WINDING] = winding
    # The successor of the last sample was aimed at already.
    e.real[REALS * lane + ANGLE] -= 2.0 * math.pi / (e.per_loop * e.exponent)
    if _shrink(e, lane):
        return 0
    return 10 + give_up(e, lane)


def retreat(s, e, lane, reached):
    """Give the shortcut up and go back to where it began.

    If t = 0 was ``reached``, the path is smooth there and its end singular: a loop will tell.
    Otherwise a branch point is near, and a loop is better made further in.
    """
    e.whole[WHOLES * lane + NO_SHORTCUT] = 1
    if reached or not _shrink(e, lane):
        for j in range(s.N):
            e.mean[j] = e.saved[s.N * lane + j]
        _begin_loop(s, e, lane, e.mean)
        _keep_sample(s, e, lane, e.mean)
