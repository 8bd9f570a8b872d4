"""What is said of motions at the prompt and in tables."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np

from nag.kinematics.driven import DrivenAssembly
from nag.kinematics.driven_motion import DrivenMotion, range_of
from nag.kinematics.joint_values import Coordinate, joint_coordinates
from nag.kinematics.motion import Circuit, Crossing, Motion
from nag.kinematics.poses import turn_product
from nag.kinematics.turning_points import STILL, TurningPoint, Values
from nag.text.table import align, count_text, join_words, lines_of

# Coordinates whose dead points are written out, assemblies besides circuits, and those of a joint
# that is driven through values; more are counted.
MOST_POINTS, MOST_BESIDES, MOST_DRIVEN = 6, 20, 60


def value_text(coordinate: Coordinate, value: float) -> str:
    """An angle in degrees, or a slide."""
    if coordinate.kind == "angle":
        # The sum has no negative zero.
        return f"{round(float(np.degrees(value)), 2) + 0.0:.2f}\u00b0"
    return f"{_no_zero(value):.5g}"


def _no_zero(value: float) -> float:
    """The number, without the sign and digits of one that is zero to rounding."""
    return 0.0 if abs(value) < STILL else float(value)


def range_text(motion: Motion, values: Values, index: int) -> str:
    """How far a joint moves in a circuit."""
    each = values.coordinates[index]
    if not each.in_loop:
        return "moves freely, in no loop"
    if each.name in _held_names(motion):
        return "held"
    if values.still[index]:
        return "does not move"
    low, high = (value_text(each, x) for x in values.ranges[index])
    if not values.turns_fully(index):
        return f"{low} to {high}"
    whole = abs(int(values.turns[index]))
    if whole:
        return "turns fully" + (f", {whole} times" if whole > 1 else "")
    return f"turns fully, {low} to {high}, and back"


def turning_text(circuit: Circuit, point: TurningPoint) -> str:
    """One dead point."""
    each = next(c for c in circuit.values.coordinates if c.name == point.coordinate)
    share = 100 * point.arc / circuit.length
    return f"{each.name} {point.kind}, {value_text(each, point.value)}, at {share:.1f} %"


def crossing_text(motion: Motion, circuit: Circuit, crossing: Crossing) -> str:
    """One singular configuration on the way."""
    share = 100 * crossing.arc / circuit.length
    others = [str(n) for n in crossing.circuits if n != circuit.number]
    texts = []
    if others:
        noun = "circuit" if len(others) == 1 else "circuits"
        texts.append(f"{noun} {join_words(others)}")
    if circuit.number in crossing.circuits:
        texts.append("itself")
    # Components of the circuits that are named are not others besides.
    named = {c.component for c in motion.circuits if str(c.number) in others}
    unnamed = len(crossing.components or ()) - len(named - {circuit.component})
    if unnamed > 0:
        texts.append(count_text(unnamed, "other component"))
    where = f"crosses {join_words(texts)}" if texts else "singular"
    return f"{where} at {share:.1f} % of its length"


def circuit_rows(motion: Motion, circuit: Circuit) -> list[str]:
    """The table of a circuit: a line for each joint, and where another one is at dead points.

    What the motion passes more than once is written once, with how often. Empty where no joint has
    an angle or slide, as of bars in space.
    """
    values = circuit.values
    if not values.coordinates:
        return []
    rows = [["joint", "moves", "turns back at (another joint then)"]]
    moving = [k for k, c in enumerate(values.coordinates) if c.in_loop and not values.still[k]]
    for i, each in enumerate(values.coordinates):
        own = [p for p in values.turning if p.coordinate == each.name]
        driver = next((k for k in moving if k != i), None)
        passed = Counter(_dead_point_text(values, p, each, driver) for p in own)
        texts = [
            text if times == 1 else f"{text} {'twice' if times == 2 else f'{times} times'}"
            for text, times in list(passed.items())[:MOST_POINTS]
        ]
        if len(passed) > MOST_POINTS:
            texts.append(f"and {len(passed) - MOST_POINTS} more")
        rows.append([each.name, range_text(motion, values, i), ", ".join(texts)])
    if not any(row[2] for row in rows[1:]):
        rows = [row[:2] for row in rows]
    return align(rows, left=(0, 1, 2))


def _dead_point_text(
    values: Values, point: TurningPoint, own: Coordinate, driver: int | None
) -> str:
    """Where a joint turns back, and where another one is then, of an angle within a turn."""
    text = value_text(own, point.value)
    if driver is None:
        return text
    other = values.coordinates[driver]
    value = point.others[driver]
    if other.kind == "angle":
        value = np.pi - (np.pi - value) % (2 * np.pi)
        # Half a turn back, as it is written, is half a turn forth.
        value = abs(value) if value_text(other, value) == value_text(other, -np.pi) else value
    return f"{text} ({other.name} {value_text(other, value)})"


def circuit_text(motion: Motion, circuit: Circuit) -> str:
    """One circuit in one line."""
    text = "closed" if circuit.closed else "open"
    if circuit.unbounded:
        text += ", to infinity, followed for five sizes at most"
    if circuit.through_reference:
        begins = "begins at" if circuit.from_reference else "runs through"
        text += f", {begins} the reference configuration"
    if len(motion.components) > 1:
        text += f", on component {circuit.component + 1}"
    return f"{text}; length {circuit.length:.4g}"


def circuits_text(motion: Motion, number: int) -> str:
    """How many circuits there are; a component may have others, which were not asked for."""
    where = " through the reference configuration" if motion.which == "reference" else ""
    return f"{count_text(number, 'circuit')}{where}"


def motion_rows(motion: Motion) -> list[tuple[str, str]]:
    """Labelled lines of the whole."""
    rows = [("mobility", motion.sentence), ("model", motion.reason)]
    for i, (component, curve) in enumerate(zip(motion.components, motion.curves, strict=True)):
        text = f"dimension {component.dimension}, degree {component.degree}"
        own = [c for c in motion.circuits if c.component == i]
        elsewhere = motion.which == "reference" and curve.edges
        none = circuits_text(motion, 0) if elsewhere else "no real motion of its own"
        text += f"; {circuits_text(motion, len(own)) if own else none}"
        rows.append(("component" if len(motion.components) == 1 else f"component {i + 1}", text))
    if motion.left_out:
        rows.append(("left out", f"{motion.left_out}, whose motions have more freedoms"))
    rigid = rigid_text(motion)
    if rigid:
        rows.append(("rigid", rigid))
    if motion.idle:
        rows.append(("idle", motion.idle))
    hanging = hanging_text(motion)
    if hanging:
        rows.append(("hanging", hanging))
    still = _never_moving(motion)
    if still:
        rows.append(
            ("still", f"{join_words(still)} never {'moves' if len(still) == 1 else 'move'}")
        )
    return rows


def hanging_text(motion: Motion) -> str:
    """Which joints are in no loop, and with how many freedoms they move; empty if none is."""
    names = [joint.name for joint in motion.scene.hanging_joints]
    if not names:
        return ""
    noun = "joint" if len(names) == 1 else "joints"
    freedoms = count_text(motion.hanging_count, "freedom")
    if motion.scene.from_reference:
        shown = f"{'it' if len(names) == 1 else 'them'} as drawn"
    else:
        shown = "its link unturned" if len(names) == 1 else "their links unturned"
    return (
        f"{noun} {join_words(names)} in no loop, moving freely with {freedoms}; tables and pages "
        f"show {shown}"
    )


def _held_names(motion: Motion) -> set[str]:
    """Angles and slides that are held, where circuits are those of what is left."""
    return {drive.coordinate for drive in motion.held}


def rigid_text(motion: Motion) -> str:
    """How many real assemblies do not move, and where they were not looked for.

    Empty where there is none. With joints or bodies held they are counted with what is held.
    """
    alone = motion.drive is None and not motion.held and not motion.poses
    texts = []
    if alone and motion.assemblies:
        count = count_text(len(motion.assemblies), "real assembly", "real assemblies")
        more = len(motion.assemblies) - MOST_BESIDES
        texts.append(f"{count} besides that cannot move, on no circuit")
        if more > 0:
            texts[-1] += f" (the first {MOST_BESIDES} are shown)"
    if motion.not_looked_for:
        what = "others" if texts else "real assemblies that cannot move"
        texts.append(f"{what} were not looked for {motion.not_looked_for}")
    return "; ".join(texts)


def _never_moving(motion: Motion) -> list[str]:
    """Joints that stand still in all circuits, but for what is held of them."""
    if not motion.circuits:
        return []
    still = np.all([c.values.still for c in motion.circuits], axis=0)
    coordinates, held = motion.circuits[0].values.coordinates, _held_names(motion)
    own = [(c.joint, s) for c, s in zip(coordinates, still, strict=True) if c.name not in held]
    return [
        joint
        for joint in dict.fromkeys(joint for joint, _ in own)
        if all(s for other, s in own if other == joint)
    ]


def assembly_rows(motion: Motion) -> list[str]:
    """The table of assemblies: a line for each; of those besides circuits for the first ones.

    Joints in no loop may have any value in each, and are left out. The place of the body that is
    farthest from the ground stands before the joints, which may be many.
    """
    besides = motion.circuits and motion.drive is None
    shown = motion.assemblies[: MOST_BESIDES if besides else None]
    cells = _assembly_cells(motion, shown, joint_coordinates(motion.scene))
    numbers = ["assembly", *(str(k) for k in range(1, len(shown) + 1))]
    return align([[number, *own] for number, own in zip(numbers, cells, strict=True)])


def _assembly_cells(
    motion: Motion, shown: Sequence[DrivenAssembly], coordinates: Sequence[Coordinate]
) -> list[list[str]]:
    """Headings of assemblies' circuits, the hand's place, angles and slides, and their texts.

    Args:
        coordinates: of all joints, in their order.
    """
    own = [i for i, each in enumerate(coordinates) if each.in_loop]
    on_circuits = motion.drive is not None
    joints = [coordinates[i].name for i in own]
    rows = [[*["circuit"] * on_circuits, *_hand_heads(motion), *joints]]
    for each in shown:
        texts = [str(each.circuit or "-")] * on_circuits + _hand_cells(motion, each)
        rows.append(texts + [value_text(coordinates[i], each.values[i]) for i in own])
    return rows


def _hand_of(motion: Motion) -> int | None:
    """The body whose place is told of assemblies; None of what is placed, or not drawn at all."""
    scene = motion.scene
    return scene.farthest_body if scene.from_reference and not motion.poses else None


def _hand_axes(motion: Motion) -> list[int]:
    """Along which axes it moves: not along a normal of the plane of motion."""
    normal = motion.scene.planar
    return [k for k in range(3) if normal is None or abs(normal[k]) < 1 - STILL]


def _hand_heads(motion: Motion) -> list[str]:
    """Headings of the columns that tell a body's place in assemblies; none if none do."""
    body = _hand_of(motion)
    if body is None:
        return []
    name = motion.scene.bodies[body]
    return [*(f"{name}.{'xyz'[k]}" for k in _hand_axes(motion)), f"{name} turned"]


def _hand_cells(motion: Motion, assembly: DrivenAssembly) -> list[str]:
    """Where that body's frame is, and by how much it is turned from how it is drawn."""
    body = _hand_of(motion)
    if body is None:
        return []
    scene, place = motion.scene, assembly.poses.places[body, 0]
    end, joint = next((j.bodies.index(body), j) for j in scene.joints if body in j.bodies)
    turn = turn_product(assembly.poses.turns[body, 0], joint.frames[end])
    along = turn[1:] @ scene.planar if scene.planar is not None else np.linalg.norm(turn[1:])
    angle = (2 * np.arctan2(along, turn[0]) + np.pi) % (2 * np.pi) - np.pi
    if scene.planar is None:
        angle = abs(angle)
    texts = [f"{_no_zero(place[k]):.5g}" for k in _hand_axes(motion)]
    return [*texts, value_text(Coordinate("", "", "angle"), angle)]


def hand_text(motion: Motion) -> str:
    """What is told of that body's place, in words; empty if nothing is."""
    heads = _hand_heads(motion)
    if not heads:
        return ""
    return (
        f"{heads[0]} to {heads[-2]}: the place of its frame, which is how far it is moved from "
        "where it is drawn"
    )


def drive_text(motion: Motion) -> str:
    """What is held, and how many assemblies there are that do not move."""
    coordinates = {c.name: c for c in joint_coordinates(motion.scene)}
    drives = motion.held if motion.drive is None else (motion.drive,)
    texts = []
    for drive in drives:
        each = coordinates.get(drive.coordinate)
        value = value_text(each or Coordinate("", "", "angle"), drive.value)
        texts.append(f"{drive.coordinate} at {value}")
    for pose in motion.poses:
        # The origin of the body's frame is the global one where it is drawn.
        text = f"{pose.body} moved by {_numbers_text(pose.place)} from where it is drawn"
        if pose.quaternion is not None:
            text += f", with the quaternion {_numbers_text(pose.quaternion)}"
        texts.append(text)
    return f"{', '.join(texts)}{_assemblies_text(motion)}"


def _numbers_text(numbers: Sequence[float]) -> str:
    return f"({', '.join(f'{x:.6g}' for x in numbers)})"


def _assemblies_text(motion: Motion) -> str:
    count = count_text(len(motion.assemblies), "real assembly", "real assemblies")
    throughout = throughout_text(motion)
    if throughout:
        return f": {throughout}; {count} besides"
    if not motion.circuits or motion.drive is not None:
        return f": {count}"
    return f"; {count} besides that do not move" if motion.assemblies else ""


def throughout_text(motion: Motion) -> str:
    """Which circuits have the value all along, as the joint stands still there; empty if none."""
    if not motion.throughout:
        return ""
    noun, verb = ("circuit", "is") if len(motion.throughout) == 1 else ("circuits", "are")
    numbers = join_words([str(number) for number in motion.throughout])
    return f"{noun} {numbers} {verb} at this value throughout"


def throughout_rows(driven: DrivenMotion) -> list[tuple[str, str]]:
    """The values that circuits have all along: a labelled line for each."""
    return [
        ("throughout", f"{value_text(driven.coordinate, value)}: {throughout_text(motion)}")
        for value, motion in zip(driven.values, driven.motions, strict=True)
        if motion.throughout
    ]


def driven_rows(driven: DrivenMotion) -> list[str]:
    """The table of a joint driven through values: a line for each."""
    rows = [[driven.coordinate.name, "circuits", "lengths", "assemblies"]]
    for value, motion in zip(driven.values, driven.motions, strict=True):
        # Along the circuits of one freedom the joint itself moves, but on those at the value.
        moving = [
            c for c in motion.circuits if motion.drive is None or c.number in motion.throughout
        ]
        lengths = ", ".join(f"{c.length:.4g}" for c in moving)
        shown = value_text(driven.coordinate, value)
        rows.append([shown, str(len(moving)), lengths, str(len(motion.assemblies))])
    return align(rows, left=(2,))


def driven_assembly_rows(driven: DrivenMotion) -> list[str]:
    """The assemblies at each value of a joint: a line for each of the first ones; none if none."""
    head, rows = list[str](), list[list[str]]()
    for value, motion in zip(driven.values, driven.motions, strict=True):
        coordinates = joint_coordinates(motion.scene)
        cells = _assembly_cells(motion, motion.assemblies, coordinates)
        own = [k for k, name in enumerate(cells[0]) if name != driven.coordinate.name]
        head = head or [cells[0][k] for k in own]
        at = value_text(driven.coordinate, value)
        for number, row in enumerate(cells[1:], start=1):
            rows.append([at, str(number), *(row[k] for k in own)])
    if not rows:
        return []
    return align([[driven.coordinate.name, "assembly", *head], *rows[:MOST_DRIVEN]])


def more_assemblies_text(driven: DrivenMotion) -> str:
    """How many assemblies there are, where not all of them are shown; else empty."""
    count = sum(len(motion.assemblies) for motion in driven.motions)
    if count <= MOST_DRIVEN:
        return ""
    return f"{count}, of which the first {MOST_DRIVEN} are shown"


def continuation_rows(driven: DrivenMotion) -> list[tuple[str, str]]:
    """How circuits go on from value to value: a labelled line for each."""
    rows = []
    for number, each in enumerate((c for c in driven.continuations if c.moves), start=1):
        last = each.first + len(each.members) - 1
        ends = [value_text(driven.coordinate, driven.values[i]) for i in (each.first, last)]
        lengths = [f"{x:.4g}" for x in range_of(driven.motions, each)]
        where = f"from {ends[0]} to {ends[1]}" if last > each.first else f"at {ends[0]} only"
        rows.append((f"circuit {number}", f"{where}, length {' to '.join(dict.fromkeys(lengths))}"))
    return rows


def driven_text(driven: DrivenMotion) -> str:
    """What is seen at the prompt."""
    values = count_text(len(driven), "value")
    rows = [("model", driven.motions[0].reason), *continuation_rows(driven)]
    rows += throughout_rows(driven)
    rows += [("open", note) for note in driven.notes]
    return lines_of(f"{driven.coordinate.name} driven through {values}", rows)


def motion_text(motion: Motion) -> str:
    """What is seen at the prompt."""
    rows = motion_rows(motion)
    rows += [(f"circuit {c.number}", circuit_text(motion, c)) for c in motion.circuits]
    if motion.drive is not None or motion.held or motion.poses:
        rows.append(("driven", drive_text(motion)))
    rows += [("open", note) for note in motion.notes]
    if motion.circuits or not motion.assemblies:
        return lines_of(f"Motion of {count_text(len(motion.circuits), 'circuit')}", rows)
    count = len(motion.assemblies)
    what = f"{count} real assemblies" if count > 1 else "one real assembly"
    return lines_of(f"Motion, {what} with what is held", rows)
