"""One self-contained HTML file of a motion."""

from __future__ import annotations

import base64
import json
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from html import escape
from importlib import resources
from typing import Any

import numpy as np

from nag.errors import NagError
from nag.kinematics.driven_motion import DrivenMotion
from nag.kinematics.motion import Circuit, Crossing, Motion
from nag.kinematics.poses import Poses, turn_back, turn_vectors
from nag.kinematics.scene import Scene
from nag.kinematics.shown import (
    circuits_text,
    crossing_text,
    hanging_text,
    range_text,
    turning_text,
    value_text,
)
from nag.kinematics.turning_points import STILL
from nag.page.link_shapes import BodyShape, Shapes, link_shapes, typical_length
from nag.text.table import count_text

# Bytes of a page, and of those the numbers of all circuits in base64, at most: four for each number
# of 24 bits. Circuits have fewer frames where there are many, but so many at least.
MOST_BYTES, BYTES, LEAST_FRAMES = 985_000, 315_000, 12
BITS, BYTES_OF_NUMBER = 24, 4
# Share of a typical link by which what is drawn may be off between frames: two fifths of a rod's
# radius.
HONEST = 0.02
# By what numbers of frames that are tried differ.
THINNER = 1.25
# How often a page is made, after the first time with as much room less as it was too large before,
# and with some bytes to spare for digits of its text.
ROUNDS, SPARE = 3, 500
# Decimals of a frame's number at which something is special.
AT = 3
# Decimals of places in shapes, over the typical link's length.
DECIMALS = 6
# How much of the light of a colour each body has is not decided here: see viewer.js.
NO_COLOUR = -1
# Normals of a plane that look towards the viewer as they are.
UPRIGHT = 0.5


def motion_page(motion: Motion, title: str, file: str) -> str:
    """The page of a motion.

    Args:
        title: what is moving.
        file: name of the case's file without its folder, after which tables to save are named.

    Raises:
        NagError: if there is no circuit, or too many bodies and circuits for one page.
    """
    return _fitting_page(motion, title, file, None)


def driven_page(driven: DrivenMotion, title: str, file: str) -> str:
    """The page of a joint driven through values: one slider more.

    Args:
        driven: what is left at each value.
        title, file: as for `motion_page`.

    Raises:
        NagError: if there is no circuit at any value, or too many for one page.
    """
    circuits, values, families, motions = [], [], [], []
    family = {
        (each.first + i, k): number
        for number, each in enumerate(c for c in driven.continuations if c.moves)
        for i, k in enumerate(each.members)
    }
    for i, motion in enumerate(driven.motions):
        for k, circuit in enumerate(motion.circuits if motion.drive is None else ()):
            circuits.append(circuit)
            motions.append(motion)
            values.append(i)
            families.append(family[i, k])
    shown = [value_text(driven.coordinate, value) for value in driven.values]
    held = _Held(driven.coordinate.name, shown, values, families, motions)
    return _fitting_page(replace(driven[0], circuits=tuple(circuits)), title, file, held)


@dataclass(frozen=True)
class _Held:
    """What the second slider shows.

    Attributes:
        name: of the joint.
        values: as text.
        of_circuit: index of the value that each circuit belongs to.
        family: a number of each circuit, the same for those that continue each other.
        motions: that each circuit is of, in which circuits have their numbers.
    """

    name: str
    values: list[str]
    of_circuit: list[int]
    family: list[int]
    motions: list[Motion]


def _fitting_page(motion: Motion, title: str, file: str, held: _Held | None) -> str:
    """The page with as many frames as fit."""
    if not motion.circuits:
        raise NagError("html: there is no real motion to show")
    bytes_of_frame = BYTES_OF_NUMBER * int((_grids(motion)[:, 1] > 0).sum()) or 1
    thinned = [_thin(circuit, motion.scene) for circuit in motion.circuits]
    room = BYTES
    for _ in range(ROUNDS):
        most = max(room, 0) // bytes_of_frame
        chosen = choose_frames(thinned, most)
        if chosen is None:
            raise _too_large(motion, held, most / sum(_frames_for(thinned, HONEST)))
        page = _with_frames(motion, title, file, *chosen, held)
        excess = len(page.encode()) - MOST_BYTES
        if excess <= 0:
            return page
        room = sum(chosen[0]) * bytes_of_frame - excess - SPARE
    raise _too_large(motion, held, 0.0)


def _too_large(motion: Motion, held: _Held | None, share: float) -> NagError:
    """That there is no page, and what to do; ``share``: of the circuits that would fit."""
    circuits, bodies = len(motion.circuits), len(motion.scene.bodies)
    text = f"html: {circuits} circuits of {bodies} bodies do not fit in one page"
    text += f", though drawn places are off by {100 * HONEST:g} % of a link"
    if held is None:
        return NagError(f"{text}; show one of them").mended_by("circuit")
    some = f", about {max(1, int(len(held.values) * share))}" if share else ""
    return NagError(f"{text}; drive through fewer values{some}").mended_by("drive")


# Numbers of frames of a circuit, and how far drawn places are off between them, from all on.
Thinned = Sequence[tuple[int, float]]


def _thin(circuit: Circuit, scene: Scene) -> Thinned:
    """A circuit with as many frames as samples, and with fewer and fewer."""
    found, frames = [(len(circuit), 0.0)], len(circuit) / THINNER
    while frames >= LEAST_FRAMES:
        found.append((int(frames), _deviation(circuit, int(frames), scene)))
        frames /= THINNER
    return found


def choose_frames(circuits: Sequence[Thinned], most: int) -> tuple[list[int], float] | None:
    """Numbers of frames of all circuits, so many in all at most, and how far places are off.

    As little as can be, the same on all circuits; None where it would be more than is honest.
    """
    errors = sorted({off for each in circuits for _, off in each if off <= HONEST})
    fits = [sum(_frames_for(circuits, off)) <= most for off in errors]
    if not any(fits):
        return None
    off = errors[fits.index(True)]
    return _frames_for(circuits, off), off


def _frames_for(circuits: Sequence[Thinned], off: float) -> list[int]:
    """The least numbers of frames of which places are off by no more."""
    return [min(frames for frames, own in each if own <= off) for each in circuits]


def _deviation(circuit: Circuit, frames: int, scene: Scene) -> float:
    """How far joints' points are from where they are, between frames, over a typical link.

    In space so are places a link beside them: bodies may turn about points that stay.
    """
    at = np.linspace(0, len(circuit) - 1, frames)
    if frames == len(circuit):
        return 0.0
    shown = _poses_at(circuit.poses, at)
    samples = np.arange(len(circuit)) / (len(circuit) - 1) * (frames - 1)
    between = _poses_at(shown, samples)
    points = [own for j in scene.joints for own in zip(j.bodies, j.points, strict=True)]
    points += list(scene.points.values())
    link = typical_length(scene)
    if scene.planar is None:
        points += [(b, p + link * e) for b, p in points for e in np.eye(3)]
    gaps = (between.move(b, p) - circuit.poses.move(b, p) for b, p in points)
    largest = max((float(np.linalg.norm(gap, axis=1).max()) for gap in gaps), default=0.0)
    return largest / link


def _poses_at(poses: Poses, at: np.ndarray) -> Poses:
    """Poses between those that there are, by cubics through four of them.

    As the page's script has them.
    """
    turns, places = (_interpolate(x, at, axis=1) for x in (poses.turns, poses.places))
    return Poses(turns / np.linalg.norm(turns, axis=-1, keepdims=True), places)


def _interpolate(samples: np.ndarray, at: np.ndarray, axis: int) -> np.ndarray:
    """Samples along an axis, at places between them, by cubics through four of them."""
    first = np.clip(at.astype(int) - 1, 0, samples.shape[axis] - 4)
    t = at - first - 1
    weights = (
        -t * (t - 1) * (t - 2) / 6,
        (t + 1) * (t - 1) * (t - 2) / 2,
        -(t + 1) * t * (t - 2) / 2,
        (t + 1) * t * (t - 1) / 6,
    )
    moved = np.moveaxis(samples, axis, -1)
    found = sum(w * moved[..., first + k] for k, w in enumerate(weights))
    return np.moveaxis(np.asarray(found), -1, axis)


def _with_frames(
    motion: Motion,
    title: str,
    file: str,
    frames: Sequence[int],
    off: float,
    held: _Held | None,
) -> str:
    """The page with so many frames of each circuit, between which places are so far off."""
    motions = [motion] * len(motion.circuits) if held is None else held.motions
    data = _page_data(motion, title, file, frames, motions)
    if off > 0:
        counts = join_bounds(min(frames), max(frames))
        text = f"{counts} of each circuit; between them places are off by"
        data["facts"].append(["frames", f"{text} {100 * off:.2g} % of a link at most"])
    if held is not None:
        data["held"] = {"name": held.name, "values": held.values}
        own = zip(data["circuits"], held.of_circuit, held.family, strict=True)
        for number, (each, value, family) in enumerate(own):
            # Circuits are told apart by the others at the same value.
            before = held.of_circuit[:number].count(value)
            count = held.of_circuit.count(value)
            each |= {"number": number + 1, "value": value, "family": family}
            each["label"] = f"circuit {before + 1} of {count}, {_closed_text(each['closed'])}"
    text = json.dumps(data, separators=(",", ":"), allow_nan=False)
    parts = {
        "title": escape(title),
        "subtitle": escape(subtitle(motion, held)),
        "style": _part("viewer.css"),
        "test": _part("self_test.js"),
        "licence": _part("three.LICENSE").strip(),
        "three": _part("three.bundle.js"),
        "data": script_text(text),
        "viewer": _part("viewer.js"),
    }
    return re.sub(r"\{\{(\w+)\}\}", lambda found: parts[found[1]], page_part("page.html"))


def subtitle(motion: Motion, held: _Held | None = None) -> str:
    """What moves, in one line."""
    joints = [j for j in motion.scene.joints if j.type != "rigid"]
    kinds = list(dict.fromkeys(j.type for j in joints))
    counts = [count_text(sum(j.type == kind for j in joints), f"{kind} joint") for kind in kinds]
    degrees = sorted({c.degree for c in motion.components})
    curve = f"curve of degree {degrees[0]}" if len(degrees) == 1 else "curves"
    circuits = circuits_text(motion, len(motion.circuits))
    if held is not None:
        circuits += f" at {count_text(len(held.values), 'value')} of {held.name}"
    return f"{', '.join(counts)}; {circuits}; {curve}"


def script_text(text: str) -> str:
    """JSON as it may stand in a page's script: nothing in it may end that."""
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def page_part(name: str) -> str:
    """A file that pages are made of."""
    return resources.files("nag.page").joinpath(name).read_text("utf-8")


def _part(name: str) -> str:
    # In a page a script ends at its closing tag wherever that stands.
    return re.sub(r"</(script|style)", r"<\\/\1", page_part(name), flags=re.IGNORECASE)


def join_bounds(low: int, high: int) -> str:
    """``40``, or ``20 to 40``."""
    return str(low) if low == high else f"{low} to {high}"


def _page_data(
    motion: Motion, title: str, file: str, frames: Sequence[int], motions: Sequence[Motion]
) -> dict[str, Any]:
    """What the page shows, for its script; ``motions`` that each circuit has its number in."""
    scene = motion.scene
    shapes = link_shapes(scene, _slide_ranges(motion))
    root = _root_turn(motion)
    colours = _colours(motion)
    ground = motion.circuits[0].poses.turns[scene.ground, 0]
    grids = _grids(motion)
    return {
        "title": title,
        "file": re.sub(r"\.toml$", "", file),
        "planar": scene.planar is not None,
        "link": shapes.link,
        "root": root.tolist(),
        "up": turn_vectors(
            turn_back(ground), turn_vectors(turn_back(root), np.array([0.0, 1.0, 0.0]))
        ).tolist(),
        "ground": scene.ground,
        "feet": _feet(motion, shapes),
        "axis": f"{_what(motion)} along the motion (length {{length}})",
        "bodies": [
            {
                "name": name,
                "colour": colours[i],
                "middle": _round_point(scene.centres[i], shapes.link),
                "shapes": [_shape_data(s, shapes.link) for s in shapes.bodies[i]],
            }
            for i, name in enumerate(scene.bodies)
        ],
        "hubs": _hub_data(motion, shapes, colours),
        "coordinates": [
            {"name": each.name, "kind": each.kind} for each in motion.circuits[0].values.coordinates
        ],
        "facts": facts(motion),
        "grids": grids.tolist(),
        "circuits": [
            _circuit_data(own, c, count, grids)
            for own, c, count in zip(motions, motion.circuits, frames, strict=True)
        ],
    }


def _what(motion: Motion) -> str:
    kinds = {each.kind for each in motion.circuits[0].values.coordinates}
    names = " and ".join(
        n for n, k in (("joint angles", "angle"), ("slides", "slide")) if k in kinds
    )
    if not names:
        return "no joint has an angle or a slide of its own;"
    return f"{names} from the reference configuration," if motion.scene.from_reference else names


def facts(motion: Motion) -> list[list[str]]:
    """What is said of the whole motion beside the picture."""
    rows = [["mobility", motion.sentence], ["model", motion.reason]]
    for i, component in enumerate(motion.components):
        name = "component" if len(motion.components) == 1 else f"component {i + 1}"
        on = sum(c.component == i for c in motion.circuits)
        text = f"dimension {component.dimension}, degree {component.degree}"
        if component.is_multiple:
            text += f", multiplicity {component.multiplicity}"
        rows.append([name, f"{text}; {circuits_text(motion, on)}"])
    if motion.idle:
        rows.append(["idle", motion.idle])
    hanging = hanging_text(motion)
    if hanging:
        rows.append(["hanging", hanging])
    if motion.left_out:
        rows.append(["left out", motion.left_out])
    rows += [["open", note] for note in motion.notes]
    return rows


def _slide_ranges(motion: Motion) -> dict[str, tuple[float, float]]:
    """By joint, from where to where it slides in any circuit; along its axis where it has one."""
    ranges: dict[str, tuple[float, float]] = {}
    for circuit in motion.circuits:
        for each, (low, high) in zip(
            circuit.values.coordinates, circuit.values.ranges, strict=True
        ):
            if each.kind == "slide":
                before = ranges.get(each.joint, (0.0, 0.0))
                ranges[each.joint] = (min(before[0], float(low)), max(before[1], float(high)))
    return ranges


def _root_turn(motion: Motion) -> np.ndarray:
    """The quaternion that turns the plane of motion towards the viewer; none in space."""
    normal = motion.scene.planar
    if normal is None or normal[2] > UPRIGHT + UPRIGHT * (1 - DECIMALS**-DECIMALS):
        return np.array([1.0, 0.0, 0.0, 0.0])
    half = np.array([1 + normal[2], normal[1], -normal[0], 0.0])
    if np.linalg.norm(half) < 10.0**-DECIMALS:
        # The plane from behind: half a turn about the upward direction.
        return np.array([0.0, 0.0, 1.0, 0.0])
    return half / np.linalg.norm(half)


def _colours(motion: Motion) -> list[int]:
    """A number for each body's colour; the ground has none."""
    found, count = [], 0
    for i in range(len(motion.scene.bodies)):
        if i == motion.scene.ground:
            found.append(NO_COLOUR)
        else:
            found.append(count)
            count += 1
    return found


def _round_point(point: Sequence[float] | np.ndarray, link: float) -> list[float]:
    scale = 10.0 ** np.floor(np.log10(link))
    return [round(float(x) / scale, DECIMALS) * scale for x in point]


def _shape_data(shape: BodyShape, link: float) -> dict[str, Any]:
    return {
        "kind": shape.kind,
        "at": [_round_point(p, link) for p in shape.at],
        "sizes": _round_point(shape.sizes, link),
    }


def _hub_data(motion: Motion, shapes: Shapes, colours: Sequence[int]) -> list[dict[str, Any]]:
    """Points whose paths are shown, and which the view has to hold."""
    scene = motion.scene
    found = []
    for joint, at in zip(scene.joints, shapes.hubs, strict=True):
        body = joint.bodies[0]
        colour = max(colours[b] for b in joint.bodies)
        if scene.planar is not None:
            at = tuple(np.add(at, shapes.front * _normal(motion, body)))
        found.append(
            {"body": body, "at": list(at), "path": joint.type != "rigid", "colour": colour}
        )
    named = [] if scene.joints and scene.planar is not None else list(scene.points.values())
    for body, point in named:
        found.append(
            {"body": body, "at": point.tolist(), "path": True, "colour": max(colours[body], 0)}
        )
    return found


def _normal(motion: Motion, body: int) -> np.ndarray:
    """The normal of the plane of motion in a body's frame."""
    circuit = motion.circuits[0]
    assert motion.scene.planar is not None
    return turn_vectors(turn_back(circuit.poses.turns[body, 0]), motion.scene.planar)


def _feet(motion: Motion, shapes: Shapes) -> list[list[float]]:
    """Where posts hold the ground's link, in its frame: a third from either end of each piece."""
    feet: list[list[float]] = []
    for shape in shapes.bodies[motion.scene.ground]:
        if shape.kind in ("rod", "tube"):
            points = np.array(shape.at)
            steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
            way = np.concatenate([[0.0], np.cumsum(steps)])
            for share in (1 / 3, 2 / 3):
                feet.append([float(np.interp(share * way[-1], way, x)) for x in points.T])
    if not feet:
        own = [
            at
            for joint, at in zip(motion.scene.joints, shapes.hubs, strict=True)
            if joint.bodies[0] == motion.scene.ground
        ]
        feet = [list(at) for at in own]
    return feet


def _rows_of(circuit: Circuit, poses: Poses, values: np.ndarray) -> np.ndarray:
    """All numbers of frames, a row each: quaternions and places of bodies, values of joints.

    Args:
        values: shape ``(coordinates, frames)``; angles come out in degrees.
    """
    angles = np.array([each.kind == "angle" for each in circuit.values.coordinates], dtype=bool)
    values = np.where(angles[:, None], np.degrees(values), values)
    flat = (np.moveaxis(x, 1, 2).reshape(-1, x.shape[1]) for x in (poses.turns, poses.places))
    return np.vstack([*flat, values])


def _grids(motion: Motion) -> np.ndarray:
    """Of each row of numbers the first point of a grid, in steps, and the step; shape ``(r, 2)``.

    They are whole multiples of the step, of 24 bits from the first one on, as many as those of a
    float of four bytes. Of a number that never changes the step is 0, and it is the first point.
    """
    rows = [_rows_of(c, c.poses, c.values.values.T) for c in motion.circuits]
    low, high = (
        f([g(own, axis=1) for own in rows], axis=0) for f, g in ((np.min, np.min), (np.max, np.max))
    )
    still = high - low < STILL * np.maximum(1.0, np.abs(high))
    steps = np.where(still, 0.0, (high - low) / (2**BITS - 3))
    first = np.floor(low / np.where(still, 1.0, steps))
    middle = (low + high) / 2
    return np.stack([np.where(still, np.where(abs(middle) < STILL, 0.0, middle), first), steps], -1)


def _circuit_data(
    motion: Motion, circuit: Circuit, frames: int, grids: np.ndarray
) -> dict[str, Any]:
    at = np.linspace(0, len(circuit) - 1, frames)
    values = _interpolate(circuit.values.values.T, at, axis=1)
    rows = _rows_of(circuit, _poses_at(circuit.poses, at), values)
    return {
        "number": circuit.number,
        "label": circuit_label(motion, circuit),
        "closed": circuit.closed,
        "length": f"{circuit.length:.2f}",
        "arc": circuit.length,
        "frames": frames,
        "rows": _encode(rows, grids),
        "dead": [_dead_data(circuit, p, frames) for p in circuit.values.turning],
        "crossings": [_crossing_data(motion, circuit, c, frames) for c in circuit.crossings],
        "facts": [
            [each.name, range_text(motion, circuit.values, i)]
            for i, each in enumerate(circuit.values.coordinates)
        ],
    }


def circuit_label(motion: Motion, circuit: Circuit) -> str:
    """What a circuit is called in the menu."""
    text = f"circuit {circuit.number} of {len(motion.circuits)}, "
    text += _closed_text(circuit.closed)
    if circuit.through_reference and len(motion.circuits) > 1:
        text += ", through the reference"
    return text


def _closed_text(closed: bool) -> str:
    return "closed" if closed else "open"


def _encode(rows: np.ndarray, grids: np.ndarray) -> str:
    """Those rows of numbers that change, as little-endian integers of three bytes, in base64."""
    moving = grids[:, 1] > 0
    first, steps = grids[moving].T
    places = np.round(rows[moving] / steps[:, None]) - first[:, None]
    # Between samples next to an extreme one cubics lead a little beyond it, and off the grid.
    places = np.clip(places, 0, 2**BITS - 1)
    numbers = np.ascontiguousarray(places, dtype="<u4").view(np.uint8).reshape(-1, 4)[:, :3]
    return base64.b64encode(np.ascontiguousarray(numbers).tobytes()).decode("ascii")


def _dead_data(circuit: Circuit, point: Any, frames: int) -> dict[str, Any]:
    names = [each.name for each in circuit.values.coordinates]
    column = names.index(point.coordinate)
    angle = circuit.values.coordinates[column].kind == "angle"
    return {
        "at": round(point.arc / circuit.length * (frames - 1), AT),
        "column": column,
        "value": float(f"{np.degrees(point.value) if angle else point.value:.7g}"),
        "text": turning_text(circuit, point),
    }


def _crossing_data(
    motion: Motion, circuit: Circuit, crossing: Crossing, frames: int
) -> dict[str, Any]:
    return {
        "at": round(crossing.arc / circuit.length * (frames - 1), AT),
        "text": crossing_text(motion, circuit, crossing),
    }
