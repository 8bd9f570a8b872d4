"""Square systems that cut a set at a zero that is known to a hundred digits.

Doubles read ranks of sheets that are 1e-9 apart as those of one sheet of the multiplicities'
sum: deflated so, the equations have another zero than the given ones have there. Ranks at a zero
in digits are those at the zero itself (Hauenstein & Wampler, Isosingular sets and deflation, 2013).
"""

from __future__ import annotations

from collections.abc import Sequence

import flint
import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.ball_ranks import regular_block
from nag.numerics.digits import BITS, in_bits, middle
from nag.numerics.double_newton import newton_steps
from nag.numerics.singular_point import SingularEnd
from nag.numerics.zero_values import ZERO, all_vanish, is_negligible
from nag.witness.close_points import CLOSE, PointInWords, fine_of_balls, with_newton_constant
from nag.witness.close_to_sets import find_nearby_zeros
from nag.witness.confirm import zero_in_digits
from nag.witness.cutting import MOST_DEFLATIONS, Cut, Equations, dyadic
from nag.witness.fibres import Fibre, admit_end
from nag.witness.isosingular import DeflatedEquations
from nag.witness.slices import pad_rows

# Decides: Part of its size that a point is off where doubles tell Newton's constant there: other
# zeros are not close where it is below 1e4, which at conditions up to 1e8 rounding is.
PROBED = 1e-6
# How many digits larger slices are made than equations.
FIRST = 40
# Digits of coefficients from which on multiple zeros are told in digits from the first.
LONG = 12


def cut_fibres(
    points: np.ndarray,
    accuracy: float,
    equations: Equations,
    rows: np.ndarray,
    rng: np.random.Generator,
    deflate: bool,
) -> list[Fibre] | None:
    """Points on the slice ``rows`` with cuts; None if a point is no regular zero of any.

    Points at which doubles see no rank are looked at in digits.
    """
    fibres: list[Fibre] = []
    # Null vectors are read best at a small point, and serve the others as well.
    for i in np.argsort(np.linalg.norm(points, axis=1), kind="stable"):
        x = points[i]
        if admit_end(x, accuracy, fibres, equations, rows, rng, deflate):
            continue
        zeros = find_nearby_zeros([(x, accuracy)], equations, rows, rng, whole=True).zeros
        if len(zeros) != 1 or (zeros[0].multiplicity != 1) != deflate:
            return None
        if not admit_zero(zeros[0], fibres, equations, rows, rng):
            return None
    return fibres


def admit_zero(
    zero: SingularEnd,
    fibres: list[Fibre],
    equations: Equations,
    rows: np.ndarray,
    rng: np.random.Generator,
) -> bool:
    """Put an isolated zero on ``rows`` into the fibre whose cut makes it regular.

    A cut is found if there is none: some of the equations, of a deflation if the zero is multiple.
    As `nag.witness.fibres.admit_end`, for zeros that doubles need not tell from others.
    """
    if zero.precise is None:
        return False
    x = list(zero.precise.centre)
    with in_bits(BITS):
        for i, fibre in enumerate(fibres):
            if fibre.cut.deflated != (zero.multiplicity != 1):
                continue
            z = _lift_point(fibre.cut, x)
            if z is not None and _is_regular_zero(fibre.cut, rows, z):
                fine = with_newton_constant(fibre.cut.polynomials, rows, fine_of_balls(z, 1.0))
                points = np.vstack([fibre.points, fine.rounded])
                known = {**fibre.fine, len(fibre): fine}
                fibres[i] = Fibre(fibre.cut, rows, points, known)
                return True
        found = _find_cut(equations, rows, x, rng)
        if found is None:
            return False
        cut, z = found
        fine = with_newton_constant(cut.polynomials, rows, fine_of_balls(z, 1.0))
    fibres.append(Fibre(cut, rows, fine.rounded[None], {0: fine}))
    return True


def is_alone(fibre: Fibre, i: int, equations: Equations) -> bool:
    """Whether a point that doubles found is the zero of all equations, and no other is close."""
    cut, rows, z = fibre.cut, fibre.rows, fibre.points[i]
    if not len(z):
        # Where linear equations leave no coordinates there is one point.
        return True
    if cut.deflated and max(f.digits for f in equations.polynomials) > LONG:
        return False
    # Rounding errors make Newton's constant seem larger, and take a part of the time of digits.
    if not (
        _curvature_in_doubles(cut, rows, z) < 1 / CLOSE
        or with_newton_constant(cut.polynomials, rows, PointInWords.of_doubles(z)).curvature
        < 1 / CLOSE
    ):
        return False
    if not cut.deflated and len(cut.polynomials) == len(equations.polynomials):
        # The cut is all equations: they have the zero that Newton's method converges to.
        return True
    digits = zero_in_digits(fibre, i)
    return digits is not None and all_vanish(equations.polynomials, digits) is True


@np.errstate(over="ignore", invalid="ignore")
def _curvature_in_doubles(cut: Cut, rows: np.ndarray, z: np.ndarray) -> float:
    """Newton's constant at a zero as `with_newton_constant` tells it.

    It is infinite where doubles do not show it. Other zeros nearer than the probes are off do not
    let the corrections contract, so that it is then at least about the inverse of their distance.
    """
    a, size, most = pad_rows(rows, 1 + len(z)), 1 + float(np.linalg.norm(z)), 0.0
    for turn in (1, 2):
        x = z + PROBED * size * np.exp(1j * np.arange(1, len(z) + 1) ** 2 * turn)
        lengths = []
        for _ in range(2):
            matrix = np.vstack([cut.evaluator.jacobian(x), a[:, 1:]])
            right = np.concatenate([cut.evaluator.values(x[None])[0], a[:, 0] + a[:, 1:] @ x])
            if not (np.isfinite(matrix).all() and np.isfinite(right).all()):
                return np.inf
            (step,) = newton_steps(right[None], matrix[None])
            if not np.isfinite(step).all():
                return np.inf
            x = x - step
            lengths.append(float(np.abs(step).max(initial=0.0)) / size)
        most = max(most, lengths[1] / lengths[0] ** 2 if lengths[0] else np.inf)
    return most


def _lift_point(cut: Cut, x: list[flint.acb]) -> list[flint.acb] | None:
    """A point with the unknowns that deflation added; None where they are not determined."""
    for level in cut.levels:
        unknowns = _unknowns(level.polynomials, level.q1, level.q2, x)
        if unknowns is None:
            return None
        x = [*x, *unknowns]
    return x if len(x) == cut.n + cut.aux else None


def _is_regular_zero(cut: Cut, rows: np.ndarray, z: list[flint.acb]) -> bool:
    if not all(is_negligible(f, z) for f in cut.polynomials):
        return False
    return _independent(cut.polynomials, pad_rows(rows, 1 + len(z)), z) is not None


def _find_cut(
    equations: Equations, rows: np.ndarray, x: list[flint.acb], rng: np.random.Generator
) -> tuple[Cut, list[flint.acb]] | None:
    """A square system with ``x`` as a regular zero on the slice, and ``x`` with its unknowns."""
    n, z = equations.n, x
    system = DeflatedEquations.none(equations.polynomials, equations.evaluator, n)
    for _ in range(1 + MOST_DEFLATIONS):
        chosen = _independent(system.polynomials, pad_rows(rows, 1 + len(z)), z)
        if chosen is not None:
            subset = tuple(system.polynomials[i] for i in chosen)
            return Cut(n, system.total - n, subset, system.levels), z
        free = system.total - len(rows)
        q = dyadic(rng, (system.total, free))
        m = (
            free
            - regular_block(_times(_slopes(system.polynomials, _none(z), z), q), free, ZERO).rank
        )
        if not m or system.too_large(free, m):
            return None
        q1, q2 = q[:, :m], q[:, m:]
        unknowns = _unknowns(system.polynomials, q1, q2, z)
        if unknowns is None:
            return None
        system, z = system.once_more(q1, q2), [*z, *unknowns]
    return None


def _unknowns(
    polynomials: Sequence[Polynomial], q1: np.ndarray, q2: np.ndarray, z: list[flint.acb]
) -> list[flint.acb] | None:
    """The ``L`` with ``J (q1 + q2 L) = 0`` at ``z``, column by column; None where there are more.

    That equations besides those that determine it hold as well is for the caller to see.
    """
    slopes = _slopes(polynomials, _none(z), z)
    matrix, right = _times(slopes, q2), _times(slopes, q1)
    block = regular_block(matrix, q2.shape[1], ZERO)
    if block.rank < q2.shape[1]:
        return None
    try:
        solved = block.solve(matrix, right)
    except ZeroDivisionError:
        return None
    table = dict(zip(block.columns, solved, strict=True))
    return [middle(-table[i][j]) for j in range(q1.shape[1]) for i in sorted(table)]


def _slopes(
    polynomials: Sequence[Polynomial], slices: np.ndarray, z: Sequence[flint.acb]
) -> flint.acb_mat:
    """The Jacobian at a zero of a hundred digits; what may vanish in these does.

    Beside a multiple zero all slopes of an equation may be as small as what is left of the point.
    """
    with in_bits(BITS):
        side = flint.arb(10) ** int(ZERO) * max([flint.arb(1), *(abs(c).mid() for c in z)])
        disc = flint.acb(flint.arb(0, side.mid()), flint.arb(0, side.mid()))
        near = BallPolynomials.of(polynomials, slices).jacobian([c + disc for c in z], BITS)
        at = BallPolynomials.of(polynomials, slices).jacobian(z, BITS).mid()
        pairs = zip(near.entries(), at.entries(), strict=True)
        entries = [flint.acb(0) if wide.contains(0) else c for wide, c in pairs]
        return flint.acb_mat(at.nrows(), at.ncols(), entries)


def _none(z: Sequence[flint.acb]) -> np.ndarray:
    """No slices."""
    return np.zeros((0, 1 + len(z)), dtype=complex)


def _times(slopes: flint.acb_mat, q: np.ndarray) -> list[list[flint.acb]]:
    """The Jacobian times a matrix, its rows divided by their own sizes in the Jacobian."""
    sizes = [_size(row) for row in slopes.tolist()]
    product = slopes * flint.acb_mat([[flint.acb(float(c)) for c in row] for row in q])
    return [
        [middle(c / size) if size else middle(c) for c in row]
        for row, size in zip(product.tolist(), sizes, strict=True)
    ]


def _size(row: Sequence[flint.acb]) -> flint.arb:
    return max((abs(z).mid() for z in row), default=flint.arb(0))


def corank_in_digits(polynomials: Sequence[Polynomial], x: Sequence[flint.acb]) -> int:
    """Corank of the Jacobian at a zero of a hundred digits."""
    with in_bits(BITS):
        rows = []
        for row in _slopes(polynomials, _none(x), x).tolist():
            size = _size(row)
            rows.append([middle(z / size) for z in row] if size else row)
        return len(x) - regular_block(rows, len(x), ZERO).rank


def _independent(
    polynomials: Sequence[Polynomial], slices: np.ndarray, x: list[flint.acb]
) -> list[int] | None:
    """As many equations as determine a point on slices; None if they do not."""
    n, need = len(x), len(x) - len(slices)
    jacobian = _slopes(polynomials, slices, x).tolist()
    matrix = []
    for i, row in enumerate(jacobian):
        size = _size(row)
        # The slices are the largest by far, and come first.
        unit = size if i < len(polynomials) else size / flint.arb(10) ** FIRST
        matrix.append([middle(z / unit) if size else middle(z) for z in row])
    chosen = regular_block(matrix, n, ZERO).rows
    found = sorted(i for i in chosen if i < len(polynomials))
    return found if len(found) == need and len(chosen) == n else None
