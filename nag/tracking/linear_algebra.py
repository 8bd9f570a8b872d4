"""Complex LU decomposition in lanes: partial pivoting decided in each lane on its own."""

from __future__ import annotations

from nag.machine_code.lanes import any_less, fma, fnma, load, select_less, splat, store


def factorize(n, ar, ai, pivots):
    """Overwrite the matrix by its factors; the diagonal holds the inverse pivots.

    Args:
        n: size.
        ar, ai: real and imaginary parts, vector ``i * n + j`` is entry ``(i, j)``.
        pivots: receives the row that was exchanged with row ``k``, as a double.
    """
    one = splat(1.0)
    quarter = splat(0.25)
    for k in range(n):
        re = load(ar, k * n + k)
        im = load(ai, k * n + k)
        best = fma(re, re, im * im)
        chosen = splat(float(k))
        for i in range(k + 1, n):
            re = load(ar, i * n + k)
            im = load(ai, i * n + k)
            size = fma(re, re, im * im)
            chosen = select_less(best, size, splat(float(i)), chosen)
            best = select_less(best, size, size, best)
        store(pivots, k, chosen)
        for i in range(k + 1, n):
            difference = chosen - splat(float(i))
            distance = difference * difference
            if any_less(distance, quarter):
                for j in range(n):
                    upper = load(ar, k * n + j)
                    lower = load(ar, i * n + j)
                    store(ar, k * n + j, select_less(distance, quarter, lower, upper))
                    store(ar, i * n + j, select_less(distance, quarter, upper, lower))
                    upper = load(ai, k * n + j)
                    lower = load(ai, i * n + j)
                    store(ai, k * n + j, select_less(distance, quarter, lower, upper))
                    store(ai, i * n + j, select_less(distance, quarter, upper, lower))
        inverse = one / best
        pr = load(ar, k * n + k) * inverse
        pi = splat(0.0) - load(ai, k * n + k) * inverse
        store(ar, k * n + k, pr)
        store(ai, k * n + k, pi)
        for i in range(k + 1, n):
            re = load(ar, i * n + k)
            im = load(ai, i * n + k)
            lr = fnma(im, pi, re * pr)
            li = fma(im, pr, re * pi)
            store(ar, i * n + k, lr)
            store(ai, i * n + k, li)
            for j in range(k + 1, n):
                ur = load(ar, k * n + j)
                ui = load(ai, k * n + j)
                store(ar, i * n + j, fma(li, ui, fnma(lr, ur, load(ar, i * n + j))))
                store(ai, i * n + j, fnma(li, ur, fnma(lr, ui, load(ai, i * n + j))))


def _remainder(n, matrix, vector, i, begin, end):
    """Entry ``i`` of a vector less entries ``begin .. end - 1`` of row ``i`` times those of it.

    Two sums of each part, which do not wait for one another.
    """
    ar, ai = matrix
    br, bi = vector
    re = load(br, i)
    im = load(bi, i)
    re_too = splat(0.0)
    im_too = splat(0.0)
    for j in range(begin, end):
        lr = load(ar, i * n + j)
        li = load(ai, i * n + j)
        xr = load(br, j)
        xi = load(bi, j)
        re = fnma(lr, xr, re)
        im = fnma(lr, xi, im)
        re_too = fma(li, xi, re_too)
        im_too = fnma(li, xr, im_too)
    return re + re_too, im + im_too


def substitute(n, ar, ai, pivots, br, bi):
    """Overwrite the right-hand side by the solution, with the factors of `factorize`."""
    half = splat(0.5)
    for k in range(n - 1):
        if any_less(splat(float(k)) + half, load(pivots, k)):
            for lane in range(8):
                p = int(pivots[8 * k + lane])
                if p != k:
                    a, b = 8 * k + lane, 8 * p + lane
                    br[a], br[b] = br[b], br[a]
                    bi[a], bi[b] = bi[b], bi[a]
    for i in range(1, n):
        re, im = _remainder(n, (ar, ai), (br, bi), i, 0, i)
        store(br, i, re)
        store(bi, i, im)
    for i in range(n - 1, -1, -1):
        re, im = _remainder(n, (ar, ai), (br, bi), i, i + 1, n)
        pr = load(ar, i * n + i)
        pi = load(ai, i * n + i)
        store(br, i, fnma(im, pi, re * pr))
        store(bi, i, fma(im, pr, re * pi))


def substitute_adjoint(n, ar, ai, pivots, br, bi):
    """Overwrite the right-hand side by the solution with the conjugate transposed matrix."""
    for i in range(n):
        re = load(br, i)
        im = load(bi, i)
        for j in range(i):
            ur = load(ar, j * n + i)
            ui = load(ai, j * n + i)
            xr = load(br, j)
            xi = load(bi, j)
            re = fnma(ui, xi, fnma(ur, xr, re))
            im = fma(ui, xr, fnma(ur, xi, im))
        pr = load(ar, i * n + i)
        pi = load(ai, i * n + i)
        store(br, i, fma(im, pi, re * pr))
        store(bi, i, fnma(re, pi, im * pr))
    for i in range(n - 2, -1, -1):
        re = load(br, i)
        im = load(bi, i)
        for j in range(i + 1, n):
            lr = load(ar, j * n + i)
            li = load(ai, j * n + i)
            xr = load(br, j)
            xi = load(bi, j)
            re = fnma(li, xi, fnma(lr, xr, re))
            im = fma(li, xr, fnma(lr, xi, im))
        store(br, i, re)
        store(bi, i, im)
    for k in range(n - 1, -1, -1):
        for lane in range(8):
            p = int(pivots[8 * k + lane])
            if p != k:
                a, b = 8 * k + lane, 8 * p + lane
                br[a], br[b] = br[b], br[a]
                bi[a], bi[b] = bi[b], bi[a]
