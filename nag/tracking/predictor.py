"""Where the next step of each lane leads, and what the path's Taylor coefficients say of it."""

from __future__ import annotations

import math

from nag.machine_code.lanes import fma, fnma, load, select_less, splat, square_root, store

# What a lane does: predict from its base point, correct there, or correct once more.
PREDICT, CORRECT = 0.0, 1.0
# Decides: Steps over what the radius of convergence at their ends allows, which is estimated: of
# 182 steps to another path 166 lay above 4/3 and 177 above 1.11; of others 0.3 and 4 in 100.
OVERLONG = 1.25
# Squares of coefficients that may have lost digits to the range of doubles.
TINY = 1e-200
# Radius of convergence, and step, of a series whose last coefficients vanish.
FAR = 1e6


def predict(z, s, w, order):
    """Pade (order - 1, 1) from the base point's Taylor coefficients, in the lanes that predict."""
    n = s.N
    half = splat(0.5)
    two = splat(2.0)
    h = load(w.ahead, 0)
    m = load(w.mode, 0)
    limit = splat(0.5625)
    tiny = splat(TINY)
    for j in range(n):
        a = z.read(w.base, n * (order - 1) + j)
        ar, ai = a
        q = z.stretch(z.read(w.base, n * order + j), h)
        qr, qi = q
        q2 = z.square(q)
        size = z.square(a)
        d = z.subtract(a, q)
        dr, di = d
        inverse = splat(1.0) / z.square(d)
        sr = fnma(ai, ai, ar * ar)
        si = two * ar * ai
        re = fma(si, di, sr * dr) * inverse
        im = fnma(sr, di, si * dr) * inverse
        # Where the pole is near, or both coefficients are noise, the Taylor polynomial is safer.
        # The square of a coefficient that decays to zero underflows, and the quotient with it.
        re = select_less(tiny, size, select_less(q2, limit * size, re, ar + qr), ar + qr)
        im = select_less(tiny, size, select_less(q2, limit * size, im, ai + qi), ai + qi)
        x = z.exact(re, im)
        for k in range(order - 2, -1, -1):
            x = z.add_multiple(z.read(w.base, n * k + j), x, h)
        z.write(w.slots, j, z.choose(m, half, x, z.read(w.slots, j)))


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
    away = w.here[lane] - w.seen_t[lane]
    return away + w.seen_radius[lane] if away > 0.0 else FAR


def next_step(w, order, lane, aim, factor):
    """Size of the next step of a lane.

    Args:
        aim: wanted size of the first Newton correction.
        factor: largest step as part of the radius of convergence.
    """
    radius = w.radius[lane]
    last = w.norms[8 * (order + 1) + lane]
    if w.growth[lane] > 0.0:
        h = w.taken_h[lane] * w.growth[lane]
    elif last > 0.0:
        # The next term of the series is about the last one times h over the radius.
        h = (aim * radius / math.sqrt(last)) ** (1.0 / (order + 1))
    else:
        h = FAR
    w.h[lane] = min(factor * min(radius, radius_as_seen(w, lane)), h)


def next_t(w, lane):
    """Where the next step of a lane leads, and the step."""
    t = w.here[lane]
    goal = w.goal[lane]
    h = w.h[lane]
    length = t - goal
    if h >= length:
        h = length
        w.t[lane] = goal
    else:
        # A step that would leave a crumb is halved instead.
        if h > 0.7 * length:
            h = 0.5 * length
        w.t[lane] = t - h
    w.ahead[lane] = -h
    w.taken_h[lane] = h
