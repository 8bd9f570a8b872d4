"""Complex LU decomposition in lanes: pivoting decided in each lane on its own.

Two rows at a time, so that what is read of the others serves twice, and more sums grow at once
than the processor takes to add.
"""

from __future__ import annotations

from nag.machine_code.lanes import any_less, fma, fnma, load, select_less, splat, store

# A row stays where it is unless the square of its pivot is less than this part of the largest one:
# most exchanges of partial pivoting would bring nothing (Duff, Erisman and Reid, Direct Methods for
# Sparse Matrices, 1986, 5.2).
PIVOT = 0.01
# Angle, times squares of whole numbers, of right-hand sides that no smooth vector cancels.
PHASE = 1.9416


def _largest(n, ar, ai, k):
    """Largest square in column ``k`` on and below the diagonal, and the row that has it."""
    best = splat(-1.0)
    chosen = splat(float(k))
    for i in range(k, n):
        re = load(ar, i * n + k)
        im = load(ai, i * n + k)
        size = fma(re, re, im * im)
        chosen = select_less(best, size, splat(float(i)), chosen)
        best = select_less(best, size, size, best)
    return best, chosen


def _exchange(n, data, k, i, distance):
    """Exchange rows ``k`` and ``i`` in the lanes where the distance is 0."""
    quarter = splat(0.25)
    for j in range(n):
        upper = load(data, k * n + j)
        lower = load(data, i * n + j)
        store(data, k * n + j, select_less(distance, quarter, lower, upper))
        store(data, i * n + j, select_less(distance, quarter, upper, lower))


def _pivot(n, ar, ai, pivots, k):
    """Bring a large entry to the diagonal, and its inverse into its place."""
    here = splat(float(k))
    best, chosen = _largest(n, ar, ai, k)
    re = load(ar, k * n + k)
    im = load(ai, k * n + k)
    chosen = select_less(fma(re, re, im * im), splat(PIVOT) * best, chosen, here)
    store(pivots, k, chosen)
    if any_less(here, chosen):
        for i in range(k + 1, n):
            difference = chosen - splat(float(i))
            distance = difference * difference
            if any_less(distance, splat(0.25)):
                _exchange(n, ar, k, i, distance)
                _exchange(n, ai, k, i, distance)
        re = load(ar, k * n + k)
        im = load(ai, k * n + k)
    inverse = splat(1.0) / fma(re, re, im * im)
    re = re * inverse
    im = splat(0.0) - im * inverse
    store(ar, k * n + k, re)
    store(ai, k * n + k, im)
    return re, im


def _put(ar, ai, q, x):
    re, im = x
    store(ar, q, re)
    store(ai, q, im)


def _times(ar, ai, q, x):
    """An entry times a number."""
    xr, xi = x
    re = load(ar, q)
    im = load(ai, q)
    return fnma(im, xi, re * xr), fma(im, xr, re * xi)


def _less(ar, ai, q, x, y):
    """``y`` less an entry times ``x``."""
    xr, xi = x
    re, im = y
    lr = load(ar, q)
    li = load(ai, q)
    return fma(li, xi, fnma(lr, xr, re)), fnma(li, xr, fnma(lr, xi, im))


def _scaled(ar, ai, q, factor):
    """Multiply an entry by a factor."""
    x = _times(ar, ai, q, factor)
    _put(ar, ai, q, x)
    return x


def _subtract(ar, ai, q, factor, x):
    """Subtract a product from an entry."""
    fr, fi = factor
    xr, xi = x
    store(ar, q, fma(fi, xi, fnma(fr, xr, load(ar, q))))
    store(ai, q, fnma(fi, xr, fnma(fr, xi, load(ai, q))))


def factorize(n, ar, ai, pivots):
    """Overwrite the matrix by its factors; the diagonal holds the inverse pivots.

    Args:
        n: size.
        ar, ai: real and imaginary parts, vector ``i * n + j`` is entry ``(i, j)``.
        pivots: receives the row that was exchanged with row ``k``, as a double.
    """
    for k in range(n):
        pivot = _pivot(n, ar, ai, pivots, k)
        for i in range(k + 1, n - 1, 2):
            upper = _scaled(ar, ai, i * n + k, pivot)
            lower = _scaled(ar, ai, (i + 1) * n + k, pivot)
            for j in range(k + 1, n):
                x = load(ar, k * n + j), load(ai, k * n + j)
                _subtract(ar, ai, i * n + j, upper, x)
                _subtract(ar, ai, (i + 1) * n + j, lower, x)
        if k < n - 1 and (n - k) % 2 == 0:
            last = _scaled(ar, ai, (n - 1) * n + k, pivot)
            for j in range(k + 1, n):
                x = load(ar, k * n + j), load(ai, k * n + j)
                _subtract(ar, ai, (n - 1) * n + j, last, x)


def _ordered(n, pivots, br, bi):
    """Exchange the entries of the right-hand side as the rows were."""
    half = splat(0.5)
    for k in range(n - 1):
        if any_less(splat(float(k)) + half, load(pivots, k)):
            for lane in range(8):
                p = int(pivots[8 * k + lane])
                if p != k:
                    a, b = 8 * k + lane, 8 * p + lane
                    br[a], br[b] = br[b], br[a]
                    bi[a], bi[b] = bi[b], bi[a]


def _sums(ar, ai, q, x, sums):
    """Four sums, which do not wait for one another, less the parts of a product."""
    lr, li = load(ar, q), load(ai, q)
    xr, xi = x
    a, b, c, d = sums
    return fnma(lr, xr, a), fnma(lr, xi, b), fma(li, xi, c), fnma(li, xr, d)


def _remainder(n, matrix, vector, i, begin, end):
    """Entry ``i`` of a vector less entries ``begin .. end - 1`` of row ``i`` times those of it."""
    ar, ai = matrix
    br, bi = vector
    zero = splat(0.0)
    sums = load(br, i), load(bi, i), zero, zero
    for j in range(begin, end):
        sums = _sums(ar, ai, i * n + j, (load(br, j), load(bi, j)), sums)
    a, b, c, d = sums
    return a + c, b + d


def _remainders(n, matrix, vector, i, begin, end):
    """The same of rows ``i`` and ``i + 1``."""
    ar, ai = matrix
    br, bi = vector
    zero = splat(0.0)
    upper = load(br, i), load(bi, i), zero, zero
    lower = load(br, i + 1), load(bi, i + 1), zero, zero
    for j in range(begin, end):
        x = load(br, j), load(bi, j)
        upper = _sums(ar, ai, i * n + j, x, upper)
        lower = _sums(ar, ai, (i + 1) * n + j, x, lower)
    a, b, c, d = upper
    e, f, g, h = lower
    return (a + c, b + d), (e + g, f + h)


def substitute(n, ar, ai, pivots, br, bi):
    """Overwrite the right-hand side by the solution, with the factors of `factorize`."""
    matrix, vector = (ar, ai), (br, bi)
    _ordered(n, pivots, br, bi)
    for i in range(0, n - 1, 2):
        upper, lower = _remainders(n, matrix, vector, i, 0, i)
        lower = _less(ar, ai, (i + 1) * n + i, upper, lower)
        _put(br, bi, i, upper)
        _put(br, bi, i + 1, lower)
    odd = n % 2
    if odd != 0:
        i = n - 1
        last = _remainder(n, matrix, vector, i, 0, i)
        _put(br, bi, i, _times(ar, ai, i * n + i, last))
    for i in range(n - 2 - odd, -1, -2):
        upper, lower = _remainders(n, matrix, vector, i, i + 2, n)
        lower = _times(ar, ai, (i + 1) * n + i + 1, lower)
        upper = _less(ar, ai, i * n + i + 1, lower, upper)
        _put(br, bi, i + 1, lower)
        _put(br, bi, i, _times(ar, ai, i * n + i, upper))


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
