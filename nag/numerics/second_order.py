"""Whether a real motion can leave a real singular zero, by terms of second order.

Along a real curve x + v s^k + .. of zeros v is a tangent vector, and the terms of order 2k say that
the second derivatives along v lie in the Jacobian's image. So if for one w in the left kernel the
form v -> w . D2F(v, v) is definite on the tangent space, the zero is isolated among the real ones,
whatever the dimension of the complex solution set. (Such a w is a stress that blocks all of the
tangent space.) If it is so only beside the directions in which no form sees anything, real curves
leave in these alone. The converse is not true: where there is none, nothing is known.

Reference:
    Connelly & Whiteley, Second-order rigidity and prestress stability for tensegrity frameworks,
    SIAM J. Discrete Math. 9, 1996.
"""

from __future__ import annotations

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.system import PolynomialSystem
from nag.numerics.double_ranks import INDEPENDENT
from nag.numerics.doubles import CLEAR

# Step of derivatives by complex numbers, which lose no digits.
COMPLEX_STEP = 1e-40
# Decides: Parts of the forms that are none.
UNSEEN = 1e-12
# Combinations that are tried; each is better than the one before in the direction that was worst.
TRIALS = 200


def count_real_directions(system: PolynomialSystem, point: np.ndarray, corank: int) -> int:
    """The dimension of a space of tangents in which all real curves of zeros leave a real zero.

    The corank where terms of second order prove nothing, and where the point is not real.

    Args:
        point: a zero, correct to rounding, shape ``(n,)``.
        corank: of the Jacobian there, which is taken as decided.

    >>> import nag
    >>> from nag.numerics.second_order import count_real_directions
    >>> count_real_directions(nag.system("x^2 + y^2", "x y z"), np.zeros(3), 3)
    1
    >>> count_real_directions(nag.system("x^2 - y^2", "x y z"), np.zeros(3), 3)
    3
    """
    evaluator = Evaluator.of(system.polynomials, system.n)
    if not corank or np.any(np.imag(point)):
        return corank
    real = np.real(point)
    jacobian = evaluator.jacobian(real).real
    left, singular, right = np.linalg.svd(jacobian)
    rank = system.n - corank
    if rank and singular[rank - 1] < INDEPENDENT * max(1.0, singular[0]):
        return corank
    tangents, stresses = right[rank:], left[:, rank:]
    aside = real + 1j * COMPLEX_STEP * tangents
    moved = np.array([evaluator.jacobian(x).imag for x in aside]) / COMPLEX_STEP
    second = np.einsum("arn,bn->rab", moved, tangents)
    forms = np.einsum("rk,rab->kab", stresses, second)
    size = np.abs(forms).max(initial=0.0)
    if size < CLEAR:
        # Rounding, or too little to tell: largest coefficients are one.
        return corank
    _, seen, directions = np.linalg.svd((forms / size).reshape(-1, corank))
    seen = np.concatenate([seen, np.zeros(corank - len(seen))])
    if ((seen > UNSEEN) & (seen < CLEAR)).any():
        return corank
    beside = directions[seen >= CLEAR]
    blocked = _has_definite_combination(np.einsum("pa,kab,qb->kpq", beside, forms / size, beside))
    return corank - len(beside) if blocked else corank


def count_unreal_directions(
    system: PolynomialSystem, point: np.ndarray, corank: int, dimension: int
) -> int:
    """How much less than ``dimension`` real sets of zeros through a zero have at least.

    Zero where terms of second order prove nothing; see `count_real_directions`.

    Args:
        dimension: of the complex zeros at the point.
    """
    if corank <= dimension:
        return 0
    return max(0, dimension - count_real_directions(system, point, corank))


def _has_definite_combination(forms: np.ndarray) -> bool:
    """Whether one of these symmetric matrices' combinations, as it was found, is definite.

    A vector on which the last combination is not positive corrects it (the perceptron, which ends
    if there is a definite one); what no combination changes forbids all.

    Args:
        forms: of size one, shape ``(k, t, t)``.
    """
    weights = _unit(np.trace(forms, axis1=1, axis2=2))
    for _ in range(TRIALS):
        values, vectors = np.linalg.eigh(np.einsum("k,kab->ab", _unit(weights), forms))
        if values[0] > CLEAR:
            return True
        worst = vectors[:, 0]
        correction = np.einsum("kab,a,b->k", forms, worst, worst)
        if np.linalg.norm(correction) < CLEAR:
            return False
        weights = weights + _unit(correction)
    return False


def _unit(vector: np.ndarray) -> np.ndarray:
    length = float(np.linalg.norm(vector))
    return vector / length if length else vector
