"""Random mechanisms of one to three loops with joints of all types, against screws and Newton.

Tangent and local dimension by `nag.mobility` are compared with what the joints' screws say in
doubles: the nullity of the loops' closure at the reference, and at configurations near by to which
Newton's method leads in joint coordinates. Nothing of the package's equations is used for that.
Numbers are small whole ones, some times a square root of 2 or 3.

    python tests/random_mechanisms.py --count 1000
"""

from __future__ import annotations

import argparse
import random
import time
from collections import Counter
from collections.abc import Sequence

import numpy as np
import scipy

import nag
from nag.algebra.expression import parse_number
from nag.mechanism.graph import Joint, Mechanism

KINDS = ("revolute", "prismatic", "cylindrical", "universal", "spherical", "planar")
STEP, NEAR = 0.02, 1e-7


def random_mechanism(seed: int) -> Mechanism:
    """A ring of bodies, and chains between two of its bodies for every loop more."""
    rng = random.Random(seed)
    root = rng.choice(("", "", "*sqrt(2)", "*sqrt(3)"))
    flat = rng.random() < 0.3
    special = rng.random() < 0.5
    joints: list[Joint] = []
    bodies = ["base"]

    def number() -> object:
        text = str(rng.randint(-4, 4))
        return parse_number(text + (root if rng.random() < 0.4 else ""))

    def vector() -> tuple:
        while True:
            if flat:
                return tuple(map(parse_number, ("0", "0", "1")))
            found = tuple(parse_number(str(rng.randint(-1, 1))) for _ in range(3))
            if special and any(found):
                return found
            found = (number(), number(), number())
            if any(float(x) for x in found):
                return found

    def across(axis: tuple) -> tuple:
        while True:
            other = vector() if not flat else tuple(map(parse_number, ("1", "0", "0")))
            if np.linalg.norm(np.cross(*np.array([axis, other], dtype=float))) > 0.1:
                return other

    def chain(first: str, last: str, length: int) -> None:
        at = first
        for i in range(length):
            to = last if i == length - 1 else f"B{len(bodies)}"
            if to != last:
                bodies.append(to)
            kind = rng.choice(("revolute", "prismatic") if flat else ("revolute", *KINDS))
            axis = vector()
            if flat and kind == "prismatic":
                axis = (number(), number(), parse_number("0"))
                if not any(float(x) for x in axis):
                    axis = tuple(map(parse_number, ("1", "0", "0")))
            given = {"point": (number(), number(), number()), "axis": axis}
            if kind == "universal":
                given["second_axis"] = across(axis)
            if kind == "spherical":
                del given["axis"]
            joints.append(Joint(f"J{len(joints)}", kind, (at, to), **given))
            at = to

    chain("base", "base", rng.randint(3, 7))
    for _ in range(rng.randint(0, 2)):
        first, last = rng.sample(bodies, 2) if len(bodies) > 1 else ("base", "base")
        chain(first, last, rng.randint(2, 5))
    return Mechanism("base", tuple(joints))


def screws_of(joint: Joint) -> list[tuple[np.ndarray, np.ndarray | None]]:
    """Of each freedom a direction, and the point that a turn goes through; None for a slide."""
    point = None if joint.point is None else np.array([float(x) for x in joint.point])
    axes = [
        None
        if a is None
        else np.array([float(x) for x in a]) / np.linalg.norm([float(x) for x in a])
        for a in (joint.axis, joint.second_axis)
    ]
    u, v = axes
    plane = [] if u is None else list(np.linalg.svd(u[None])[2][1:])
    return {
        "revolute": lambda: [(u, point)],
        "prismatic": lambda: [(u, None)],
        "cylindrical": lambda: [(u, point), (u, None)],
        "universal": lambda: [(u, point), (v, point)],
        "spherical": lambda: [(e, point) for e in np.eye(3)],
        "planar": lambda: [(plane[0], None), (plane[1], None), (u, np.zeros(3))],
    }[joint.type]()


class Closure:
    """The loops of a mechanism in coordinates of its joints."""

    def __init__(self, mechanism: Mechanism) -> None:
        self.joints = mechanism.joints
        self.screws = [screws_of(j) for j in self.joints]
        self.starts = np.cumsum([0, *map(len, self.screws)])
        self.n = int(self.starts[-1])
        self.tree: list[tuple[str, str, int]] = []
        reached = [mechanism.ground]
        for parent in reached:
            for i, j in enumerate(self.joints):
                if parent in j.bodies:
                    child = j.bodies[1 - j.bodies.index(parent)]
                    if child not in reached:
                        reached.append(child)
                        self.tree.append((parent, child, i))
        used = {i for *_, i in self.tree}
        self.closing = [i for i in range(len(self.joints)) if i not in used]
        self.ground = mechanism.ground

    def displacement(self, i: int, q: np.ndarray) -> np.ndarray:
        """Of a joint's second body against its first, a matrix of shape (4, 4)."""
        total = np.eye(4, dtype=q.dtype)
        for (u, p), x in zip(self.screws[i], q[self.starts[i] :], strict=False):
            own = np.eye(4, dtype=q.dtype)
            if p is None:
                own[:3, 3] = x * u
            else:
                hat = np.array([[0, -u[2], u[1]], [u[2], 0, -u[0]], [-u[1], u[0], 0]])
                own[:3, :3] += np.sin(x) * hat + (1 - np.cos(x)) * hat @ hat
                own[:3, 3] = p - own[:3, :3] @ p
            total = total @ own
        return total

    def gaps(self, q: np.ndarray) -> np.ndarray:
        """What keeps the loops from closing, shape (6 loops,)."""
        at = {self.ground: np.eye(4, dtype=q.dtype)}
        for parent, child, i in self.tree:
            own = self.displacement(i, q)
            forward = self.joints[i].bodies[0] == parent
            at[child] = at[parent] @ (own if forward else np.linalg.inv(own))
        found = []
        for i in self.closing:
            first, second = self.joints[i].bodies
            m = np.linalg.inv(at[second]) @ at[first] @ self.displacement(i, q)
            found += [m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], *m[:3, 3]]
        return np.array(found)

    def jacobian(self, q: np.ndarray) -> np.ndarray:
        """By complex steps."""
        steps = 1e-30j * np.eye(self.n)
        return np.array([self.gaps(q + s).imag / 1e-30 for s in steps]).T

    def nullity(self, q: np.ndarray) -> int | None:
        """Of the derivative; None if that is not clear."""
        rows = self.jacobian(q)
        size = max(1.0, float(np.abs(rows).max(initial=0)))
        s = scipy.linalg.svd(rows / size, compute_uv=False) if rows.size else np.zeros(0)
        if ((s > 1e-11) & (s < 1e-6)).any():
            return None
        return self.n - int((s >= 1e-6).sum())

    def near(self, rng: np.random.Generator) -> np.ndarray | None:
        """A configuration near the reference, generic in a tangent direction; None if none."""
        zero = np.zeros(self.n)
        rows = self.jacobian(zero)
        kernel = scipy.linalg.null_space(rows, rcond=1e-9) if rows.size else np.eye(self.n)
        q = STEP * kernel @ rng.standard_normal(kernel.shape[1])
        for _ in range(60):
            gap = self.gaps(q)
            step = scipy.linalg.lstsq(self.jacobian(q), -gap, cond=NEAR)[0]
            if np.abs(step).max(initial=0) > 1:
                return None
            q = q + step
            if np.abs(step).max(initial=0) < 1e-14:
                break
        converged = np.abs(self.gaps(q)).max(initial=0) < 1e-12
        return q if converged and np.abs(q).max(initial=0) < 20 * STEP else None


def dimensions(mechanism: Mechanism, seed: int) -> tuple[int | None, int | None]:
    """Tangent and local dimension by screws and Newton's method; None where that is not clear."""
    closure = Closure(mechanism)
    tangent = closure.nullity(np.zeros(closure.n))
    if not tangent:
        return tangent, tangent
    rng = np.random.default_rng(seed)
    found: list[int] = []
    for _ in range(6):
        q = closure.near(rng)
        if q is None or np.abs(q).max(initial=0) < STEP / 100:
            continue
        nullity = closure.nullity(q)
        if nullity is not None:
            found.append(nullity)
    # At most points of the largest component the nullity is least among those near by.
    if not found:
        return tangent, None
    return tangent, tangent if min(found) == tangent else None


def main(arguments: Sequence[str] | None = None) -> int:
    """Compare, and print what differs."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--first", type=int, default=0)
    options = parser.parse_args(arguments)
    seen: Counter[str] = Counter()
    slow: list[tuple[float, int]] = []
    for seed in range(options.first, options.first + options.count):
        mechanism = random_mechanism(seed)
        start = time.perf_counter()
        report = nag.mobility(mechanism, detail="local")
        slow.append((time.perf_counter() - start, seed))
        tangent, local = dimensions(mechanism, seed)
        ours = report.tangent_dimension, report.local_dimension
        if tangent is None:
            seen["not clear in doubles"] += 1
        elif ours[0] != tangent or (local is not None and ours[1] not in (local, None)):
            seen["wrong"] += 1
            print(f"{seed}: {ours} for {(tangent, local)}", flush=True)
        elif ours[1] is None:
            seen["undecided"] += 1
            print(f"{seed}: undecided, tangent dimension {tangent}", flush=True)
        else:
            seen["both the same" if local is not None else "tangent dimension the same"] += 1
    slow.sort()
    print(dict(seen))
    print(
        f"median {slow[len(slow) // 2][0]:.2f} s, largest",
        *(f"{t:.1f} s ({i})" for t, i in slow[-5:]),
    )
    return int(seen["wrong"] > 0)


if __name__ == "__main__":
    raise SystemExit(main())
