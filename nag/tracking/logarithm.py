"""Taylor coefficients of a path in the logarithm of t.

Near a singular end a path is a power series in ``t ** (1 / w)``. In t its radius of convergence
is the distance from t = 0, in ``u = log t`` it is infinite, or that to the next branch point:
steps need not become shorter towards the end, and few of them lead round a loop.
"""

from __future__ import annotations

from math import factorial

import numpy as np

from nag.machine_code.lanes import fma, fnma, load, splat, store


def composition(order: int) -> np.ndarray:
    """Taylor coefficients of ``(exp(h) - 1) ** m``: entry ``(m - 1, k - 1)`` is that of ``h^k``."""
    first = np.array([1.0 / factorial(k) for k in range(1, order + 1)])
    rows = [first]
    for _ in range(1, order):
        rows.append(np.concatenate([[0.0], np.convolve(rows[-1], first)[: order - 1]]))
    return np.array(rows)


def turn(s, w, order, tr, ti):
    """Taylor coefficients in ``log t`` and their squared norms, from those in t in ``base``.

    Args:
        tr, ti: where the lanes' bases are.
    """
    n = s.N
    zero = splat(0.0)
    for k in range(order):
        store(w.turned_norms, k, zero)
    for j in range(2 * n * order):
        store(w.turned, j, zero)
    pr = tr
    pi = ti
    for m in range(order):
        for j in range(n):
            cr = load(w.base, 2 * n * (m + 1) + j)
            ci = load(w.base, 2 * n * (m + 1) + n + j)
            re = fnma(ci, pi, cr * pr)
            im = fma(ci, pr, cr * pi)
            for k in range(m, order):
                c = splat(w.composition[order * m + k])
                q = 2 * n * k + j
                store(w.turned, q, fma(c, re, load(w.turned, q)))
                store(w.turned, q + n, fma(c, im, load(w.turned, q + n)))
        qr = fnma(pi, ti, pr * tr)
        pi = fma(pi, tr, pr * ti)
        pr = qr
    for k in range(order):
        total = zero
        for j in range(n):
            re = load(w.turned, 2 * n * k + j)
            im = load(w.turned, 2 * n * k + n + j)
            total = fma(re, re, fma(im, im, total))
        store(w.turned_norms, k, total)
