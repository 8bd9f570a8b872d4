from fractions import Fraction

from hypothesis import assume, given, settings
from hypothesis import strategies as st

from nag.mechanism.axes import cross, difference, dot
from nag.mechanism.quaternion import (
    H,
    H_tilde,
    K,
    K_tilde,
    R,
    add,
    conjugate,
    dual_conjugate,
    dual_multiply,
    line,
    multiply,
    norm_squared,
    rotate,
    scale,
    translation,
)

rationals = st.builds(Fraction, st.integers(-30, 30), st.integers(1, 12))
quaternions = st.tuples(*[rationals] * 4)
vectors = st.tuples(*[rationals] * 3)
dual_quaternions = st.tuples(quaternions, quaternions)
laws = settings(max_examples=20)


def product(a, b):
    return tuple(tuple(dot(row, column) for column in zip(*b, strict=True)) for row in a)


def transpose(a):
    return tuple(zip(*a, strict=True))


def apply(a, v):
    return tuple(dot(row, v) for row in a)


def hat(v):
    return (Fraction(0), *v)


@laws
@given(quaternions, quaternions, quaternions)
def test_quaternions_are_an_algebra_with_multiplicative_norm(a, b, c):
    assert multiply(multiply(a, b), c) == multiply(a, multiply(b, c))
    assert multiply(a, add(b, c)) == add(multiply(a, b), multiply(a, c))
    assert conjugate(multiply(a, b)) == multiply(conjugate(b), conjugate(a))
    assert norm_squared(multiply(a, b)) == norm_squared(a) * norm_squared(b)
    assert multiply(a, conjugate(a)) == (norm_squared(a), 0, 0, 0)


@laws
@given(quaternions, quaternions)
def test_identities_1_of_t25(a, b):
    assert transpose(R(a)) == R(conjugate(a))
    assert apply(transpose(K_tilde(a)), b) == apply(transpose(K(b)), a) == multiply(b, a)
    assert R(apply(transpose(K(b)), a)) == product(R(b), R(a))
    block = product(K_tilde(a), transpose(K(a)))
    assert block[0] == (norm_squared(a), 0, 0, 0)
    assert tuple(row[1:] for row in block[1:]) == R(a)
    assert product(H_tilde(a), transpose(H(a))) == R(a)


@laws
@given(quaternions)
def test_k_and_r_are_orthogonal_up_to_the_norm(a):
    n = norm_squared(a)
    for matrix, factor in ((K(a), n), (K_tilde(a), n), (R(a), n * n)):
        gram = product(matrix, transpose(matrix))
        size = len(gram)
        assert gram == tuple(
            tuple(factor if i == j else 0 for j in range(size)) for i in range(size)
        )
    rows = R(a)
    assert dot(cross(rows[0], rows[1]), rows[2]) == n**3


@laws
@given(vectors, vectors)
def test_lemma_2_1_of_t25_the_square_of_l(y, v):
    matrix = product(K_tilde(hat(v)), transpose(K(hat(y))))
    assert matrix == transpose(matrix)
    square = product(matrix, matrix)
    n = dot(v, v) * dot(y, y)
    assert square == tuple(tuple(n if i == j else 0 for j in range(4)) for i in range(4))


@laws
@given(vectors, vectors, quaternions)
def test_lemma_2_1_of_t25_the_eigenspace(direction, turned, a):
    # y and v of the same rational length, as rotations of one vector.
    y, v = direction, rotate(a, direction)
    n = norm_squared(a)
    assume(n != 0)
    v = tuple(x / n for x in v)
    size = dot(y, y)
    matrix = product(K_tilde(hat(v)), transpose(K(hat(y))))
    # (L + |v||y|) turns any vector into one of the eigenspace of |v||y|.
    any_vector = (*turned, Fraction(1))
    eigen = add(apply(matrix, any_vector), scale(any_vector, size))
    assert apply(matrix, eigen) == scale(eigen, size)
    assert (size - dot(v, y)) * eigen[0] + dot(eigen[1:], cross(y, v)) == 0
    assert dot(difference(v, y), eigen[1:]) == 0
    # Lemma 3.1: the eigenvectors are the turns that take v to y.
    assert rotate(eigen, v) == tuple(norm_squared(eigen) * x for x in y)


@laws
@given(vectors, vectors, vectors, vectors)
def test_lemma_2_1_of_t25_the_commutator(y, v, u, z):
    first = product(K_tilde(hat(v)), transpose(K(hat(y))))
    second = product(transpose(K_tilde(hat(u))), K(hat(z)))
    commutator = tuple(
        difference(r, s)
        for r, s in zip(product(first, second), product(second, first), strict=True)
    )
    d, q = cross(y, z), cross(u, v)
    expected = tuple(
        add(scale(r, 2 * dot(u, v)), scale(s, 2 * dot(y, z)))
        for r, s in zip(K(hat(d)), K_tilde(hat(q)), strict=True)
    )
    assert commutator == expected


@laws
@given(dual_quaternions, dual_quaternions, dual_quaternions)
def test_dual_quaternions_are_associative_and_conjugation_reverses(x, y, z):
    assert dual_multiply(dual_multiply(x, y), z) == dual_multiply(x, dual_multiply(y, z))
    assert dual_conjugate(dual_multiply(x, y)) == dual_multiply(
        dual_conjugate(y), dual_conjugate(x)
    )


@laws
@given(vectors, vectors)
def test_a_line_squares_to_minus_its_squared_length(point, axis):
    h = line(point, axis)
    assert dual_multiply(h, h) == ((-dot(axis, axis), 0, 0, 0), (0, 0, 0, 0))


@laws
@given(vectors, vectors, rationals, rationals)
def test_a_turn_about_a_line_keeps_the_points_of_the_line(point, axis, c, s):
    (_, *primal), dual = line(point, axis)
    turn = ((c, *(s * x for x in primal)), tuple(s * x for x in dual))
    moved, n = translation(turn)
    for t in (0, 1, 3):
        place = tuple(p + t * x for p, x in zip(point, axis, strict=True))
        image = tuple(x + y for x, y in zip(rotate(turn[0], place), moved, strict=True))
        assert image == tuple(n * x for x in place)
