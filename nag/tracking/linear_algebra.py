"""Complex LU decomposition in lanes, in any arithmetic: pivoting decided in each lane on its own.

Two rows at a time, so that what is read of the others serves twice, and more sums grow at once
than the processor takes to add. Matrices are numbers of the arithmetic ``z``, row by row.
"""

from __future__ import annotations

from nag.machine_code.lanes import any_less, fma, fnma, load, select_less, splat, store

# Angle, times squares of whole numbers, of right-hand sides that no smooth vector cancels.
PHASE = 1.9416


def _largest(z, n, matrix, k):
    """Largest size in column ``k`` on and below the diagonal, and the row that has it."""
    best = splat(-1.0)
    chosen = splat(float(k))
    for i in range(k, n):
        size = z.size(z.read(matrix, i * n + k))
        chosen = select_less(best, size, splat(float(i)), chosen)
        best = select_less(best, size, size, best)
    return best, chosen


def _exchange(z, n, matrix, k, i, distance):
    """Exchange rows ``k`` and ``i`` in the lanes where the distance is 0."""
    quarter = splat(0.25)
    for j in range(n):
        upper = z.read(matrix, k * n + j)
        lower = z.read(matrix, i * n + j)
        z.write(matrix, k * n + j, z.choose(distance, quarter, lower, upper))
        z.write(matrix, i * n + j, z.choose(distance, quarter, upper, lower))


def _pivot(z, n, matrix, pivots, k):
    """Bring a large entry to the diagonal, and its inverse into its place."""
    here = splat(float(k))
    best, chosen = _largest(z, n, matrix, k)
    size = z.size(z.read(matrix, k * n + k))
    chosen = select_less(size, splat(z.pivot) * best, chosen, here)
    store(pivots, k, chosen)
    if any_less(here, chosen):
        for i in range(k + 1, n):
            difference = chosen - splat(float(i))
            distance = difference * difference
            if any_less(distance, splat(0.25)):
                _exchange(z, n, matrix, k, i, distance)
    pivot = z.inverse(z.read(matrix, k * n + k))
    z.write(matrix, k * n + k, pivot)
    return pivot


def _scale(z, matrix, q, pivot):
    """Multiply an entry by a pivot; minus the product."""
    factor = z.multiply(z.read(matrix, q), pivot)
    z.write(matrix, q, factor)
    return z.negative(factor)


def _add(z, matrix, q, factor, x):
    """Add a product to an entry."""
    z.write(matrix, q, z.add_product(z.read(matrix, q), factor, x))


def factorize(z, n, matrix, pivots):
    """Overwrite the matrix by its factors; the diagonal holds the inverse pivots.

    Two columns at a time: of the rest of the matrix every entry is then read and written once for
    two products. To each entry the same is added in the same order as one column at a time.

    Args:
        z: the arithmetic.
        n: size.
        matrix: number ``i * n + j`` is entry ``(i, j)``.
        pivots: receives the row that was exchanged with row ``k``, as a double.
    """
    for k in range(0, n - 1, 2):
        pivot = _pivot(z, n, matrix, pivots, k)
        x = z.read(matrix, k * n + k + 1)
        for i in range(k + 1, n):
            _add(z, matrix, i * n + k + 1, _scale(z, matrix, i * n + k, pivot), x)
        pivot = _pivot(z, n, matrix, pivots, k + 1)
        for i in range(k + 2, n):
            _scale(z, matrix, i * n + k + 1, pivot)
        factor = _negative(z, matrix, (k + 1) * n + k)
        for j in range(k + 2, n):
            _add(z, matrix, (k + 1) * n + j, factor, z.read(matrix, k * n + j))
        for i in range(k + 2, n - 1, 2):
            _subtract_rows(z, n, matrix, k, i)
        if n % 2 != 0:
            _subtract_rows_of_last(z, n, matrix, k)
    if n % 2 != 0:
        _pivot(z, n, matrix, pivots, n - 1)


def _negative(z, matrix, q):
    return z.negative(z.read(matrix, q))


def _subtract_rows(z, n, matrix, k, i):
    """Multiples of rows ``k`` and ``k + 1`` from rows ``i`` and ``i + 1``, right of the former."""
    first = _negative(z, matrix, i * n + k)
    second = _negative(z, matrix, i * n + k + 1)
    third = _negative(z, matrix, (i + 1) * n + k)
    fourth = _negative(z, matrix, (i + 1) * n + k + 1)
    for j in range(k + 2, n):
        x = z.read(matrix, k * n + j)
        y = z.read(matrix, (k + 1) * n + j)
        upper = z.add_product(z.read(matrix, i * n + j), first, x)
        lower = z.add_product(z.read(matrix, (i + 1) * n + j), third, x)
        z.write(matrix, i * n + j, z.add_product(upper, second, y))
        z.write(matrix, (i + 1) * n + j, z.add_product(lower, fourth, y))


def _subtract_rows_of_last(z, n, matrix, k):
    """The same from the last row alone."""
    first = _negative(z, matrix, (n - 1) * n + k)
    second = _negative(z, matrix, (n - 1) * n + k + 1)
    for j in range(k + 2, n):
        last = z.add_product(z.read(matrix, (n - 1) * n + j), first, z.read(matrix, k * n + j))
        last = z.add_product(last, second, z.read(matrix, (k + 1) * n + j))
        z.write(matrix, (n - 1) * n + j, last)


def order_rows(z, n, pivots, right):
    """Exchange the entries of the right-hand side as the rows were."""
    for k in range(n - 1):
        if any_less(splat(float(k) + 0.5), load(pivots, k)):
            _exchange_entries(z, pivots, right, k)


def _exchange_entries(z, pivots, right, k):
    for lane in range(8):
        p = int(pivots[8 * k + lane])
        if p != k:
            for part in range(2 * z.number.words):
                a = 8 * (2 * z.number.words * k + part) + lane
                b = 8 * (2 * z.number.words * p + part) + lane
                right[a], right[b] = right[b], right[a]


def _sums(z, matrix, q, x, sums):
    """Four sums, which do not wait for one another, less the parts of a product."""
    lr, li = z.read(matrix, q)
    xr, xi = x
    a, b, c, d = sums
    return fnma(lr, xr, a), fnma(lr, xi, b), fma(li, xi, c), fnma(li, xr, d)


def _begin_sums(z, right, i):
    re, im = z.read(right, i)
    return re, im, splat(0.0), splat(0.0)


def _remainder(z, n, matrix, right, i, begin, end):
    """Entry ``i`` of a vector less entries ``begin .. end - 1`` of row ``i`` times those of it."""
    sums = _begin_sums(z, right, i)
    for j in range(begin, end):
        sums = _sums(z, matrix, i * n + j, z.read(right, j), sums)
    a, b, c, d = sums
    return a + c, b + d


def _remainders(z, n, matrix, right, i, begin, end):
    """The same of rows ``i`` and ``i + 1``."""
    upper = _begin_sums(z, right, i)
    lower = _begin_sums(z, right, i + 1)
    for j in range(begin, end):
        x = z.read(right, j)
        upper = _sums(z, matrix, i * n + j, x, upper)
        lower = _sums(z, matrix, (i + 1) * n + j, x, lower)
    a, b, c, d = upper
    e, f, g, h = lower
    return (a + c, b + d), (e + g, f + h)


def substitute(z, n, matrix, pivots, right):
    """Overwrite the right-hand side by the solution, with the factors of `factorize` in doubles."""
    order_rows(z, n, pivots, right)
    for i in range(0, n - 1, 2):
        upper, lower = _remainders(z, n, matrix, right, i, 0, i)
        lower = z.subtract_product(lower, z.read(matrix, (i + 1) * n + i), upper)
        z.write(right, i, upper)
        z.write(right, i + 1, lower)
    odd = n % 2
    if odd != 0:
        i = n - 1
        last = _remainder(z, n, matrix, right, i, 0, i)
        z.write(right, i, z.multiply(z.read(matrix, i * n + i), last))
    for i in range(n - 2 - odd, -1, -2):
        upper, lower = _remainders(z, n, matrix, right, i, i + 2, n)
        lower = z.multiply(z.read(matrix, (i + 1) * n + i + 1), lower)
        upper = z.subtract_product(upper, z.read(matrix, i * n + i + 1), lower)
        z.write(right, i + 1, lower)
        z.write(right, i, z.multiply(z.read(matrix, i * n + i), upper))


def _conjugate(z, matrix, q):
    re, im = z.read(matrix, q)
    return re, -im


def substitute_adjoint(z, n, matrix, pivots, right):
    """The same with the conjugate transposed matrix."""
    for i in range(n):
        x = z.read(right, i)
        for j in range(i):
            x = z.subtract_product(x, _conjugate(z, matrix, j * n + i), z.read(right, j))
        z.write(right, i, z.multiply(_conjugate(z, matrix, i * n + i), x))
    for i in range(n - 2, -1, -1):
        x = z.read(right, i)
        for j in range(i + 1, n):
            x = z.subtract_product(x, _conjugate(z, matrix, j * n + i), z.read(right, j))
        z.write(right, i, x)
    for k in range(n - 1, -1, -1):
        _exchange_entries(z, pivots, right, k)
