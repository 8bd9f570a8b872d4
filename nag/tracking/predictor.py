"""Where the next step of each lane leads, and what the path's Taylor coefficients say of it."""

from __future__ import annotations

import math

from nag.machine_code.lanes import fma, fnma, load, select_less, splat, square_root, store
from nag.tracking.kernel_arrays import SCALARS

# What a lane does: predict from its base point, correct there, or correct once more.
PREDICT, CORRECT = 0.0, 1.0
# Rows of the lanes' scalars, see `nag.tracking.straight_run`.
T, GOAL, H, H_USED, FIRST, THETA, ACCURACY, GROWTH, SEEN_T, SEEN_RADIUS, LAST = range(SCALARS)
# A step is rejected that is so many times as long as the radius of convergence at its end allows.
OVERLONG = 1.25
# Squares of coefficients that may have lost digits to the range of doubles.
TINY = 1e-200
# Radius of convergence, and step, of a series whose last coefficients vanish.
FAR = 1e6


def _coefficient(s, w, k, j):
    """Taylor coefficient of order ``k`` at the base point."""
    q = 2 * s.N * k + j
    return load(w.base, q), load(w.base, s.N + q)


def predict(s, w, order):
    """Pade (order - 1, 1) from the base point's Taylor coefficients, in the lanes that predict."""
    n = s.N
    half = splat(0.5)
    two = splat(2.0)
    h = load(w.zr, 0)
    m = load(w.mode, 0)
    limit = splat(0.5625)
    tiny = splat(TINY)
    for j in range(n):
        lr, li = _coefficient(s, w, order, j)
        ar, ai = _coefficient(s, w, order - 1, j)
        qr = h * lr
        qi = h * li
        q2 = fma(qr, qr, qi * qi)
        size = fma(ar, ar, ai * ai)
        dr = ar - qr
        di = ai - qi
        inverse = splat(1.0) / fma(dr, dr, di * di)
        sr = fnma(ai, ai, ar * ar)
        si = two * ar * ai
        re = fma(si, di, sr * dr) * inverse
        im = fnma(sr, di, si * dr) * inverse
        # Where the pole is near, or both coefficients are noise, the Taylor polynomial is safer.
        # The square of a coefficient that decays to zero underflows, and the quotient with it.
        re = select_less(tiny, size, select_less(q2, limit * size, re, ar + qr), ar + qr)
        im = select_less(tiny, size, select_less(q2, limit * size, im, ai + qi), ai + qi)
        for k in range(order - 2, 0, -1):
            x, y = _coefficient(s, w, k, j)
            re = fma(h, re, x)
            im = fma(h, im, y)
        re = fma(h, re, load(w.base, j))
        im = fma(h, im, load(w.base, n + j))
        store(w.vr, j, select_less(m, half, re, load(w.vr, j)))
        store(w.vi, j, select_less(m, half, im, load(w.vi, j)))


def estimate_radius(w, order):
    """Radii of convergence from the squared norms of the last Taylor coefficients."""
    far = splat(FAR)
    zero = splat(0.0)
    last = load(w.norms, order + 1)
    inverse = splat(1.0) / last
    one = square_root(load(w.norms, order) * inverse)
    two = square_root(square_root(load(w.norms, order - 1) * inverse))
    radius = select_less(one, two, two, one)
    radius = select_less(radius, far, radius, far)
    store(w.radius, 0, select_less(zero, last, radius, far))


def radius_as_seen(w, lane):
    """Largest radius of convergence at a lane's base point, as seen from further on.

    Radii at two points differ by their distance at most. Where a step was too long for the radius
    at its end, the series at its beginning does not show the branch points that those at its end
    did, between which a path must not be led to another one.
    """
    f = w.scalars
    away = f[8 * T + lane] - f[8 * SEEN_T + lane]
    return away + f[8 * SEEN_RADIUS + lane] if away > 0.0 else FAR


def next_step(w, order, lane, aim, factor):
    """Size of the next step of a lane.

    Args:
        aim: wanted size of the first Newton correction.
        factor: largest step as part of the radius of convergence.
    """
    f = w.scalars
    radius = w.radius[lane]
    last = w.norms[8 * (order + 1) + lane]
    if f[8 * GROWTH + lane] > 0.0:
        h = f[8 * H_USED + lane] * f[8 * GROWTH + lane]
    elif last > 0.0:
        # The next term of the series is about the last one times h over the radius.
        h = (aim * radius / math.sqrt(last)) ** (1.0 / (order + 1))
    else:
        h = FAR
    f[8 * H + lane] = min(factor * min(radius, radius_as_seen(w, lane)), h)


def next_t(w, lane):
    """Where the next step of a lane leads, and the step."""
    f = w.scalars
    t = f[8 * T + lane]
    goal = f[8 * GOAL + lane]
    h = f[8 * H + lane]
    length = t - goal
    if h >= length:
        h = length
        w.tr[lane] = goal
    else:
        # A step that would leave a crumb is halved instead.
        if h > 0.7 * length:
            h = 0.5 * length
        w.tr[lane] = t - h
    w.zr[lane] = -h
    f[8 * H_USED + lane] = h
