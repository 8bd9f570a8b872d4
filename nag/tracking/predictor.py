"""Where the next step of each lane leads, and what the path's Taylor coefficients say of it."""

from __future__ import annotations

import math

from nag.machine_code.lanes import any_less, fma, fnma, load, select_less, splat, store

# What a lane does: predict from its base point, correct there, or correct once more.
PREDICT, CORRECT = 0.0, 1.0
# Rows of the lanes' scalars.
T_RE, T_IM, GOAL_RE, GOAL_IM, H, H_USED, FIRST, THETA, ACCURACY, GROWTH, LOGARITHMIC = range(11)
SCALARS = 11


def _coefficient(s, w, k, j, turned, logarithmic):
    """Taylor coefficient of order ``k`` at the base point, in t or in the logarithm of t."""
    q = 2 * s.N * k + j
    re = load(w.base, q)
    im = load(w.base, s.N + q)
    if turned:
        half = splat(0.5)
        re = select_less(half, logarithmic, load(w.turned, q - 2 * s.N), re)
        im = select_less(half, logarithmic, load(w.turned, q - s.N), im)
    return re, im


def predict(s, w, order):
    """Pade (order - 1, 1) from the base point's Taylor coefficients, in the lanes that predict."""
    n = s.N
    half = splat(0.5)
    two = splat(2.0)
    hr = load(w.zr, 0)
    hi = load(w.zi, 0)
    m = load(w.mode, 0)
    logarithmic = load(w.scalars, LOGARITHMIC)
    turned = any_less(half, logarithmic)
    limit = splat(0.5625)
    tiny = splat(1e-200)
    for j in range(n):
        lr, li = _coefficient(s, w, order, j, turned, logarithmic)
        ar, ai = _coefficient(s, w, order - 1, j, turned, logarithmic)
        qr = fnma(hi, li, hr * lr)
        qi = fma(hi, lr, hr * li)
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
            x, y = _coefficient(s, w, k, j, turned, logarithmic)
            x = x + fnma(hi, im, hr * re)
            im = y + fma(hi, re, hr * im)
            re = x
        x = load(w.base, j) + fnma(hi, im, hr * re)
        im = load(w.base, n + j) + fma(hi, re, hr * im)
        store(w.vr, j, select_less(m, half, x, load(w.vr, j)))
        store(w.vi, j, select_less(m, half, im, load(w.vi, j)))


def convergence_radius(norms, order, lane):
    """Radius of convergence from the squared norms of the last Taylor coefficients."""
    last = norms[8 * order + lane]
    if not last > 0.0:
        return 1e6
    second = norms[8 * (order - 1) + lane]
    third = norms[8 * (order - 2) + lane]
    return min(1e6, max((second / last) ** 0.5, (third / last) ** 0.25))


def branch_point(s, w, order, lane):
    """Estimated nearest branch point, as if of a square root, from the base point of a lane.

    The coefficients of ``(t - z) ** (1/2)`` of orders k - 1 and k have the ratio
    ``(z - t) k / (k - 3/2)``.
    """
    n = s.N
    product = 0.0 + 0.0j
    total = 0.0
    for j in range(n):
        q = 2 * n * order + j
        last = complex(w.base[8 * q + lane], w.base[8 * (q + n) + lane])
        q -= 2 * n
        product += complex(w.base[8 * q + lane], w.base[8 * (q + n) + lane]) * last.conjugate()
        total += last.real * last.real + last.imag * last.imag
    t = complex(w.scalars[8 * T_RE + lane], w.scalars[8 * T_IM + lane])
    if not total > 0.0:
        return t + 1e6
    return t + product / total * ((order - 1.5) / order)


def next_step(w, order, lane, aim, factor, turned):
    """Size of the next step of a lane, with t or its logarithm as the path's parameter.

    Args:
        aim: wanted size of the first Newton correction.
        factor: largest step as part of the radius of convergence.
        turned: whether the logarithm is the parameter.
    """
    f = w.scalars
    before = f[8 * LOGARITHMIC + lane] > 0.5
    norms = w.turned_norms if turned else w.norms
    top = order - 1 if turned else order + 1
    radius = convergence_radius(norms, top, lane)
    last = norms[8 * top + lane] ** 0.5
    if turned == before and f[8 * GROWTH + lane] > 0.0:
        h = f[8 * H_USED + lane] * f[8 * GROWTH + lane]
    elif last > 0.0:
        # The next term of the series is about the last one times h over the radius.
        h = (aim * radius / last) ** (1.0 / (order + 1))
    else:
        h = 1e6
    f[8 * LOGARITHMIC + lane] = 1.0 if turned else 0.0
    f[8 * H + lane] = min(factor * radius, h)


def next_t(w, lane):
    """Where the next step of a lane leads, and the step, in t or in the logarithm of t."""
    f = w.scalars
    tr, ti = f[8 * T_RE + lane], f[8 * T_IM + lane]
    goal_re, goal_im = f[8 * GOAL_RE + lane], f[8 * GOAL_IM + lane]
    turned = f[8 * LOGARITHMIC + lane] > 0.5
    dr = goal_re - tr
    di = goal_im - ti
    if turned:
        size = tr * tr + ti * ti
        re = (goal_re * tr + goal_im * ti) / size
        im = (goal_im * tr - goal_re * ti) / size
        dr = 0.5 * math.log(re * re + im * im)
        di = math.atan2(im, re)
    length = (dr * dr + di * di) ** 0.5
    h = f[8 * H + lane]
    if h >= length:
        h = length
        w.tr[lane] = goal_re
        w.ti[lane] = goal_im
    else:
        # A step that would leave a crumb is halved instead.
        if h > 0.7 * length:
            h = 0.5 * length
        dr = dr / length * h
        di = di / length * h
        if turned:
            size = math.exp(dr)
            re = size * math.cos(di)
            im = size * math.sin(di)
            w.tr[lane] = tr * re - ti * im
            w.ti[lane] = tr * im + ti * re
        else:
            w.tr[lane] = tr + dr
            w.ti[lane] = ti + di
    w.zr[lane] = dr
    w.zi[lane] = di
    f[8 * H_USED + lane] = h
