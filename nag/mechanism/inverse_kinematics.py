"""Whether a serial chain reaches a pose: joint coordinates found by Newton's method.

The product of the factors is to be a multiple of the pose: what stands across the pose, divided by
what stands along it, is to vanish. A step is the shortest one in homogeneous coordinates. Starts
are random; nothing found is no proof that there is nothing.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.mechanism.loop_product import Element
from nag.numerics.double_ranks import NEARLY_SINGULAR
from nag.numerics.zero_values import NONZERO

# Random starts of a round, their steps, and rounds for a pose that is not reached before; fewer
# with real joint coordinates, in which there may be none for a pose that a leg reaches otherwise.
STARTS, STEPS, ROUNDS, REAL_ROUNDS = 24, 60, 12, 3
# Steps from a pose that is reached to rounding.
LAST_STEPS = 4
# What stands along a pose is taken for no less.
TINY = 1e-12
# Decides: Relative residual of a pose that a leg reaches; what it does not reach is said, not
# dismissed.
REACHED = 1e-10
# Decides: Sine of the angle between coordinates of a joint at which two ways to reach a pose are
# one: regular ones are known to rounding times their condition. Closer ones are told as missing.
SAME_WAY = 1e-7
# Least damping of a step; share of a factor's size in the squares that its norm is compared with.
LEAST_DAMPING, LEAST_SHARE = 1e-14, 1e-3

# The product of quaternions: (x y)_k = sum of _QUATERNIONS[i, j, k] x_i y_j.
_QUATERNIONS = np.zeros((4, 4, 4))
for _i, _row in enumerate(
    (
        ((0, 1), (1, 1), (2, 1), (3, 1)),
        ((1, 1), (0, -1), (3, 1), (2, -1)),
        ((2, 1), (3, -1), (0, -1), (1, 1)),
        ((3, 1), (2, 1), (1, -1), (0, -1)),
    )
):
    for _j, (_k, _sign) in enumerate(_row):
        _QUATERNIONS[_i, _j, _k] = _sign
# Likewise that of dual quaternions, a row for each entry of the first.
_PRODUCTS = np.zeros((8, 8, 8))
_PRODUCTS[:4, :4, :4] = _PRODUCTS[:4, 4:, 4:] = _PRODUCTS[4:, :4, 4:] = _QUATERNIONS
_ROWS = _PRODUCTS.reshape(8, 64)


def multiply_poses(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Products of dual quaternions in eight entries, shapes ``(..., 8)``."""
    return (y[..., None, :] @ _from_left(x))[..., 0, :]


def _from_left(x: np.ndarray) -> np.ndarray:
    """Matrices that take rows y to x y, shapes ``(..., 8)`` and ``(..., 8, 8)``."""
    return (x @ _ROWS).reshape(*x.shape, 8)


def conjugate_pose(x: np.ndarray) -> np.ndarray:
    """The conjugates of both parts."""
    return x * np.array([1, -1, -1, -1, 1, -1, -1, -1])


def shift_origin(x: np.ndarray, origin: np.ndarray) -> np.ndarray:
    """The same displacements in coordinates whose origin is another point, shapes ``(..., 8)``."""
    there = np.array([1.0, 0, 0, 0, 0, *(np.asarray(origin) / 2)])
    return multiply_poses(multiply_poses(conjugate_pose(there), x), there)


def reach_poses(
    chains: Sequence[Sequence[Element]],
    poses: np.ndarray,
    length: float,
    rng: np.random.Generator,
    real: bool = False,
    one: bool = False,
) -> np.ndarray:
    """How near products of factors come to poses, by displacements of their joints.

    Args:
        chains: the factors of each product.
        poses: Study coordinates, shape ``(k, 8)``.
        length: by which lengths are measured, from an origin amidst the chains.
        real: whether with real joint coordinates only.
        one: whether one pose that all chains reach is enough.

    Returns:
        The residuals of the best starts, relative to the poses, shape ``(k, chains)``; below
        `REACHED` where a pose is reached.
    """
    scale = np.array([1.0] * 4 + [1.0 / length] * 4)
    generators = [[_generators(e, scale) for e in elements] for elements in chains]
    targets = _unit(poses * scale)
    best = np.full((len(poses), len(chains)), np.inf)
    for _ in range(REAL_ROUNDS if real else ROUNDS):
        reached = best < REACHED
        if reached.all() or (one and reached.all(axis=1).any()):
            break
        for own, residuals, known in zip(generators, best.T, reached.T, strict=True):
            places = np.repeat(np.flatnonzero(~known), STARTS)
            if len(places):
                _approach(own, targets, places, residuals, rng, real)
    return best


def find_reached_pose(
    chains: Sequence[Sequence[Element]],
    basis: np.ndarray,
    forms: Evaluator,
    pose: np.ndarray,
    length: float,
    rng: np.random.Generator,
) -> tuple[np.ndarray, np.ndarray] | None:
    """A real pose that all chains reach with real joint coordinates, of those that equations allow.

    Pose and joint coordinates are sought together: a pose of random size is mostly beyond reach.

    Args:
        chains, length: as for `reach_poses`.
        basis: of the linear space that poses are in, shape ``(m, 8)``.
        forms: of Study coordinates, zero where poses are allowed.
        pose: where poses are looked for from, shape ``(8,)``.

    Returns:
        The pose's Study coordinates, shape ``(8,)``, and the residuals of the chains; None if none
        is found.
    """
    scale = np.array([1.0] * 4 + [1.0 / length] * 4)
    back = conjugate_pose(basis) * scale
    legs = [[_generators(e, scale) for e in own] for own in chains]
    one = np.eye(8)[:1]
    slopes_of_forms = forms.placed_derivatives(8)
    weights = [[_unit(_random(rng, (STARTS, len(g)), True)) for g in own] for own in legs]
    own = np.repeat(_unit(np.linalg.lstsq(basis.T, pose, rcond=None)[0][None]), STARTS, axis=0)
    for _ in range(STEPS):
        # A leg's displacement, and the pose's back, are to be none together.
        found = [
            _across_poses([*generators, back], [*joints, own], one)
            for generators, joints in zip(legs, weights, strict=True)
        ]
        residuals = np.array([size for size, _, _ in found])
        studies = own @ basis
        values = forms.values(studies).real
        arrived = np.vstack([residuals, np.abs(values.T)]).max(axis=0) < REACHED / 10
        regular = np.array([_are_displacements(*each) for each in zip(legs, weights, strict=True)])
        good = arrived & regular.all(axis=0) & _are_poses(studies, length)
        if good.any():
            k = int(np.argmax(good))
            return studies[k], residuals[:, k]
        if arrived.all():
            return None
        slopes = slopes_of_forms(studies).real @ basis.T
        own, weights = _step_together(weights, own, found, values, slopes)
    return None


def _are_poses(studies: np.ndarray, length: float) -> np.ndarray:
    """Where the real part is not zero beside the other one, shape ``(s,)``."""
    scaled = studies * np.array([1.0] * 4 + [1.0 / length] * 4)
    whole = np.linalg.norm(scaled, axis=1)
    return np.asarray(np.linalg.norm(scaled[:, :4], axis=1) > LEAST_SHARE * whole)


def _step_together(
    weights: Sequence[Sequence[np.ndarray]],
    own: np.ndarray,
    found: Sequence[tuple[np.ndarray, np.ndarray, np.ndarray]],
    values: np.ndarray,
    slopes_of_forms: np.ndarray,
) -> tuple[np.ndarray, list[list[np.ndarray]]]:
    """A step of the pose's coordinates and of all joints' of each start, see `_step`."""
    sizes = [sum(w.shape[1] for w in each) for each in weights]
    shared, rows = sum(sizes), 8 * len(weights)
    rest = np.concatenate([*(across for _, across, _ in found), values], axis=1)
    derivative = np.zeros((*rest.shape, shared + own.shape[1]))
    for k, (end, (_, _, slopes)) in enumerate(zip(np.cumsum(sizes), found, strict=True)):
        derivative[:, 8 * k : 8 * k + 8, end - sizes[k] : end] = slopes[:, :, : sizes[k]]
        derivative[:, 8 * k : 8 * k + 8, shared:] = slopes[:, :, sizes[k] :]
    derivative[:, rows:, shared:] = slopes_of_forms
    *joints, own = _step([w for each in weights for w in each] + [own], rest, derivative)
    ends = np.cumsum([len(each) for each in weights])
    return own, [joints[end - len(each) : end] for end, each in zip(ends, weights, strict=True)]


def find_joints(
    elements: Sequence[Element],
    pose: np.ndarray,
    length: float,
    rng: np.random.Generator,
    real: bool = False,
) -> list[np.ndarray] | None:
    """Homogeneous coordinates of factors whose product is a pose, to rounding; None if not found.

    Args:
        pose: Study coordinates, shape ``(8,)``.
        length, real: as for `reach_poses`.
    """
    scale = np.array([1.0] * 4 + [1.0 / length] * 4)
    given = [_given_generators(e) * scale for e in elements]
    generators = list(map(_unit, given))
    targets = _unit(pose[None] * scale)
    for _ in range(ROUNDS):
        best = np.full(1, np.inf)
        found = _approach(generators, targets, np.zeros(STARTS, dtype=int), best, rng, real)
        if found is not None:
            for _ in range(LAST_STEPS):
                _, rest, slopes = _across_poses(generators, found, targets)
                found = _step(found, rest, slopes)
            return [w[0] / np.linalg.norm(g, axis=1) for w, g in zip(found, given, strict=True)]
    return None


def find_all_joints(
    elements: Sequence[Element],
    pose: np.ndarray,
    length: float,
    rng: np.random.Generator,
    count: int,
) -> list[list[np.ndarray]]:
    """All regular ways in which a product of factors is a pose, as far as they are found.

    Args:
        pose, length: as for `find_joints`.
        count: how many there are at most.

    Returns:
        Of each way homogeneous coordinates of the factors, complex ones of length one.
    """
    scale = np.array([1.0] * 4 + [1.0 / length] * 4)
    given = [_given_generators(e) * scale for e in elements]
    sizes = [np.linalg.norm(g, axis=1) for g in given]
    generators = list(map(_unit, given))
    target = _unit(pose[None] * scale)
    free = sum(len(g) - 1 for g, e in zip(generators, elements, strict=True) if e.factor)
    found: list[list[np.ndarray]] = []
    for _ in range(ROUNDS):
        weights = [_unit(_random(rng, (STARTS, len(g)), False)) for g in generators]
        for _ in range(STEPS):
            residuals, rest, slopes = _across_poses(generators, weights, target)
            arrived = (residuals < REACHED) & _are_displacements(generators, weights)
            if arrived.any():
                for way in _regular_ways([w[arrived] for w in weights], generators, target, free):
                    if not any(_ways_apart(way, other) < SAME_WAY for other in found):
                        found.append(way)
                if len(found) >= count:
                    break
            left = ~arrived
            if not left.any():
                break
            weights = _step([w[left] for w in weights], rest[left], slopes[left])
        if len(found) >= count:
            break
    return [[_unit((w / s)[None])[0] for w, s in zip(way, sizes, strict=True)] for way in found]


def _regular_ways(
    weights: Sequence[np.ndarray],
    generators: Sequence[np.ndarray],
    target: np.ndarray,
    free: int,
) -> list[list[np.ndarray]]:
    """Ways that Newton's method ends at, those left out at which it is singular."""
    ends = list(weights)
    for _ in range(LAST_STEPS):
        _, rest, slopes = _across_poses(generators, ends, target)
        ends = _step(ends, rest, slopes)
    slopes = _across_poses(generators, ends, target)[2]
    s = np.linalg.svd(slopes, compute_uv=False)
    regular = s[:, free - 1] > NEARLY_SINGULAR * s[:, 0] if free else np.ones(len(s), dtype=bool)
    return [[w[k] for w in ends] for k in np.flatnonzero(regular)]


def _ways_apart(one: Sequence[np.ndarray], other: Sequence[np.ndarray]) -> float:
    """The largest sine of the angle between the coordinates of a factor in two ways."""
    return max(
        float(np.linalg.norm(v / np.linalg.norm(v) - u * (u.conj() @ v) / np.linalg.norm(v)))
        for u, v in zip(map(_unit_vector, one), other, strict=True)
    )


def _unit_vector(u: np.ndarray) -> np.ndarray:
    return np.asarray(u / np.linalg.norm(u))


def real_ways(ways: Sequence[Sequence[np.ndarray]]) -> list[tuple[np.ndarray, ...]]:
    """Those of all ways to reach a real pose that are real: the conjugate of no other one.

    Ways to a real pose are real or conjugate to each other in pairs.
    """
    found = []
    for k, way in enumerate(ways):
        mirrored = [u.conj() for u in way]
        apart = [_ways_apart(mirrored, other) for other in ways]
        if int(np.argmin(apart)) == k and apart[k] < SAME_WAY:
            found.append(tuple(map(_real_vector, way)))
    return found


def _real_vector(u: np.ndarray) -> np.ndarray:
    """Real homogeneous coordinates that are those of a real point but for a factor."""
    largest = u[np.argmax(np.abs(u))]
    return np.asarray((u * (abs(largest) / largest)).real)


def _generators(element: Element, scale: np.ndarray) -> np.ndarray:
    """Those of a factor in comparable units, each of size one, shape ``(k, 8)``.

    Random coordinates are then as likely to be those of a slide as long as the chain as of none.
    """
    return _unit(_given_generators(element) * scale)


def _given_generators(element: Element) -> np.ndarray:
    return np.array([[float(c) for part in g for c in part] for g in element.generators])


def _approach(
    generators: Sequence[np.ndarray],
    poses: np.ndarray,
    places: np.ndarray,
    best: np.ndarray,
    rng: np.random.Generator,
    real: bool,
) -> list[np.ndarray] | None:
    """Lower the residuals ``best`` of poses from random starts, one for each of ``places``.

    Returns:
        Coordinates of the factors where the last of the poses was reached; None if one was not.
    """
    targets = poses[places]
    weights = [_unit(_random(rng, (len(targets), len(g)), real)) for g in generators]
    for _ in range(STEPS):
        residuals, rest, slopes = _across_poses(generators, weights, targets)
        inside = _are_displacements(generators, weights)
        np.minimum.at(best, places[inside], residuals[inside])
        left = best[places] >= REACHED
        if not left.any():
            nearest = int(np.argmin(np.where(inside, residuals, np.inf)))
            return [w[nearest : nearest + 1] for w in weights]
        places, targets = places[left], targets[left]
        weights = _step([w[left] for w in weights], rest[left], slopes[left])
    return None


def _across_poses(
    generators: Sequence[np.ndarray], weights: Sequence[np.ndarray], targets: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """What stands across the poses, divided by what stands along them.

    Its lengths, it, and its derivatives, shapes ``(s,)``, ``(s, 8)`` and ``(s, 8, k)``.
    """
    value, derivative = _product(generators, weights)
    along = np.sum(value * targets.conj(), axis=1, keepdims=True)
    along = np.where(np.abs(along) > TINY, along, TINY)
    rest = value / along - targets
    slopes = derivative / along[:, :, None]
    turned = np.sum(slopes * targets.conj()[:, :, None], axis=1, keepdims=True)
    slopes -= (rest + targets)[:, :, None] * turned
    return np.linalg.norm(rest, axis=1), rest, slopes


def _random(rng: np.random.Generator, shape: tuple[int, ...], real: bool) -> np.ndarray:
    found = rng.standard_normal(shape)
    return found if real else found + 1j * rng.standard_normal(shape)


def _unit(x: np.ndarray) -> np.ndarray:
    return x / np.linalg.norm(x, axis=1, keepdims=True)


def _product(
    generators: Sequence[np.ndarray], weights: Sequence[np.ndarray]
) -> tuple[np.ndarray, np.ndarray]:
    """Products of the factors and their derivatives, shapes ``(s, 8)`` and ``(s, 8, k)``."""
    values = [w @ g for w, g in zip(weights, generators, strict=True)]
    one = np.zeros_like(values[0])
    one[:, 0] = 1
    before, behind = [one], [one]
    for value in values:
        before.append(multiply_poses(before[-1], value))
    for value in reversed(values):
        behind.append(multiply_poses(value, behind[-1]))
    moved = [own @ _from_left(x) for own, x in zip(generators, before, strict=False)]
    behind = behind[-2::-1]
    rest = [np.repeat(x[:, None], len(own), 1) for own, x in zip(generators, behind, strict=True)]
    columns = multiply_poses(np.concatenate(moved, axis=1), np.concatenate(rest, axis=1))
    return before[-1], columns.transpose(0, 2, 1)


def _step(
    weights: Sequence[np.ndarray], rest: np.ndarray, derivative: np.ndarray
) -> list[np.ndarray]:
    """Steps of Gauss, Newton, Levenberg and Marquardt, the less damped the nearer they are.

    From random starts undamped ones lead nowhere; and of many starts one that arrives is enough,
    so that steps need not be tried as in `nag.witness.gauss_newton`.
    """
    adjoint = derivative.conj().transpose(0, 2, 1)
    square = adjoint @ derivative
    # Each factor's own size is free, so that the square is singular: no damping is beyond rounding.
    sizes = np.trace(square, axis1=1, axis2=2).real
    damping = np.minimum(np.linalg.norm(rest, axis=1), 1.0) ** 2 + LEAST_DAMPING * (1 + sizes)
    square += damping[:, None, None] * np.eye(square.shape[1])
    step = np.linalg.solve(square, (adjoint @ rest[:, :, None]))[:, :, 0]
    ends = np.cumsum([w.shape[1] for w in weights])[:-1]
    parts = np.split(step, ends, axis=1)
    return [_unit(w - d) for w, d in zip(weights, parts, strict=True)]


def _are_displacements(
    generators: Sequence[np.ndarray], weights: Sequence[np.ndarray]
) -> np.ndarray:
    """Whether no factor's norm is zero, shape ``(s,)``."""
    found = np.ones(len(weights[0]), dtype=bool)
    for own, w in zip(generators, weights, strict=True):
        real = (w @ own)[:, :4]
        squares = np.sum(np.abs(real) ** 2, axis=1)
        whole = np.sum(np.abs(w) ** 2, axis=1)
        found &= np.abs(np.sum(real**2, axis=1)) > NONZERO * np.maximum(
            squares, whole * LEAST_SHARE
        )
    return found
