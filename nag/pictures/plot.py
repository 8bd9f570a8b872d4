"""Pictures of real curves, motions and mechanisms, with what is said below them."""

from __future__ import annotations

import contextlib
import importlib.util
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from nag.algebra.given import value_text
from nag.algebra.tokens import nearest, quote, shorten_names
from nag.errors import ComponentError, NagError

if TYPE_CHECKING:
    from nag.kinematics.motion import Motion
    from nag.kinematics.scene import Scene
    from nag.mechanism.problem import Problem
    from nag.text.table import Row
    from nag.tracking.run import Run
    from nag.witness.witness import Decomposition, WitnessSet

KINDS = (".svg", ".png", ".pdf")
AXES = ("x", "y", "z")
# Circuits whose configurations are drawn beside each other, at most.
MOST_PANELS = 12
# What a picture may be of; ``onto`` may stand beside ``point``, where it has a default.
DRAWN = ("onto", "joints", "point", "graph", "mechanism", "tree")


@dataclass(frozen=True)
class Picture:
    """A picture that was drawn.

    Attributes:
        path: the file.
        rows: labelled lines that say what is in it.
        notes: what is missing in it, or not certain, as labelled lines.
    """

    path: str
    rows: tuple[Row, ...]
    notes: tuple[Row, ...] = ()

    @property
    def complete(self) -> bool:
        """Whether nothing is missing."""
        return not self.notes

    def __repr__(self) -> str:
        from nag.text.table import named_line

        return named_line(self, f": {self.path}")

    def __str__(self) -> str:
        from nag.text.table import label_lines

        return "\n".join(label_lines([*self.rows, *self.notes, ("picture", self.path)]))


def check_kind(path: str) -> None:
    """Refuse a file that no picture is drawn to.

    Raises:
        NagError: if its name has another ending, or matplotlib is missing.
    """
    if not path.endswith(KINDS):
        raise NagError(f"{path}: name a file that ends in {', '.join(KINDS)}")
    if importlib.util.find_spec("matplotlib") is None:
        raise NagError("matplotlib is missing; pip install matplotlib")


def choose_picture(given: Mapping[str, Any], dashes: str = "") -> str:
    """Which of `DRAWN` is asked for, where each is given by its name.

    Args:
        dashes: what stands before the names in messages.

    Raises:
        NagError: if none is, or several are.
    """
    asked = [name for name in DRAWN if given.get(name) not in (None, False, ())]
    if "point" in asked and "onto" in asked:
        asked.remove("onto")
    if len(asked) != 1:
        text = "give one of" if asked else "say what to draw, one of"
        listed = ", ".join(dashes + name for name in DRAWN)
        also = f"; {dashes}point takes {dashes}onto" if asked else ""
        raise NagError(f"{text} {listed}{also}")
    return asked[0]


def variables_onto(onto: Iterable[str], variables: Sequence[str]) -> tuple[int, ...]:
    """Indices of the variables that a curve is drawn in, two or three.

    Raises:
        NagError: if there is no such variable, or there are more or fewer.
    """
    names = tuple(onto)
    for name in names:
        if name not in variables:
            raise NagError(
                f"onto: {quote(str(name))} is not one of the variables{nearest(name, variables)}; "
                f"they are {shorten_names(variables)}"
            )
    if len(set(names)) != len(names) or len(names) not in (2, 3):
        raise NagError("onto: give two different variables, or three")
    return tuple(variables.index(name) for name in names)


# --- Components


def plot_components(
    answer: Decomposition,
    kind: str,
    onto: Sequence[str] | None,
    title: str,
    path: str,
    run: Run,
    chosen: Mapping[int, WitnessSet] | None = None,
) -> Picture:
    """All components by their dimensions, or the real points of those of dimension one.

    Args:
        kind: ``"tree"`` or ``"onto"``.
        onto: of real points, the names of two or three variables.
        chosen: components by their numbers, of which real points are drawn; all by default.

    Raises:
        NagError: if there is no such variable or curve, or the file cannot be written.
        ComponentError: if no curve was found.
    """
    with _refuse_unwritable(path):
        if kind == "tree":
            return _plot_tree(answer, title, path)
        places = variables_onto(onto or (), answer.system.own_variables)
        taken = chosen or find_drawn(answer, places)
        if taken and all(c.dimension == 2 for c in taken.values()):
            return _plot_surfaces(answer, places, title, path, run, taken)
        picture = _plot_curves(places, title, path, run, taken)
        left_out = 0 if chosen else sum(c.dimension != 1 for c in answer.components)
        if not left_out:
            return picture
        note = ("left out", f"{left_out} of other dimensions than 1")
        return replace(picture, rows=(*picture.rows, note))


def _plot_tree(answer: Decomposition, title: str, path: str) -> Picture:
    from nag.pictures.component_tree import draw_component_tree

    draw_component_tree(answer, title, path)
    return Picture(path, (("components", str(len(answer.components))),))


def find_drawn(answer: Decomposition, onto: Sequence[Any]) -> dict[int, WitnessSet]:
    """The components that are drawn where none is named: curves, or else surfaces in space."""
    numbered = dict(enumerate(answer.components, 1))
    for dimension in (1, 2)[: len(onto) - 1]:
        found = {k: c for k, c in numbered.items() if c.dimension == dimension}
        if found:
            return found
    return {}


def _plot_surfaces(
    answer: Decomposition,
    onto: Sequence[int],
    title: str,
    path: str,
    run: Run,
    chosen: Mapping[int, WitnessSet],
) -> Picture:
    """The zeros of what components of dimension two satisfy in three variables."""
    import numpy as np

    from nag.interpolation.image_ideal import eliminate_component
    from nag.interpolation.point_cloud import AmbientVariables, Cloud
    from nag.interpolation.precise_samples import source_of_component
    from nag.pictures.surface_picture import draw_surface
    from nag.tracking.run import Stream

    if len(onto) != len(AXES):
        raise NagError("onto: surfaces are drawn in three variables")
    equations, rows = [], []
    for number, component in chosen.items():
        source = source_of_component(answer.system, component)
        cloud = Cloud(
            source, AmbientVariables.itself(answer.system), run.random(Stream.PLOTTED_CLOUD), run
        )
        found = eliminate_component(cloud, {}, tuple(onto), None, False, run.tell)
        if found.dimension != component.dimension or len(found.generators) != 1:
            raise ComponentError(f"component {number}: its image is no surface there")
        (equation,) = found.generators
        if found.imaginary:
            if len(found.names) in equation.support:
                raise ComponentError(f"component {number}: its equation there is not real")
            equation = equation.with_variables(len(onto), [*range(len(onto)), 0])
        equations.append((f"component {number}", equation))
        degree = equation.degree
        rows.append((f"component {number}", f"dimension 2; a surface of degree {degree}"))
    sizes = np.vstack([np.array(c.points)[:, list(onto)] for c in chosen.values()])
    names = [answer.system.variables[i] for i in onto]
    draw_surface(equations, names, float(np.median(np.abs(sizes).max(axis=1))), title, path)
    rows.append(("drawn", "lines in which planes cut the closures of the images"))
    return Picture(path, tuple(rows))


def _plot_curves(
    onto: Sequence[int],
    title: str,
    path: str,
    run: Run,
    taken: Mapping[int, WitnessSet],
) -> Picture:
    """The real points of components of dimension one, in two or three variables."""
    from nag.pictures.curve_picture import draw_real_curves
    from nag.real.find_curve import find_real_curve
    from nag.real.shown import answer_text

    if not taken:
        raise NagError(
            "onto: there is no component of dimension 1 to draw, and in three variables none of 2"
        )
    curves, rows, notes = [], [], []
    for number, component in taken.items():
        if component.dimension != 1:
            raise NagError(
                f"component: {number}: has dimension {component.dimension}; curves are drawn"
            )
        run.tell("real curves", len(curves), len(taken))
        try:
            curve = find_real_curve(component, run=run)
        except ComponentError as error:
            notes.append(("open", f"component {number}: {error}"))
            continue
        degree = f"dimension 1, degree {component.degree}"
        rows.append((f"component {number}", f"{degree}; {answer_text(curve)}"))
        if curve.reason:
            notes.append(("open", f"component {number}: {curve.reason}"))
        if curve.vertices or curve.edges:
            curves.append((f"component {number}", curve))
    if not curves:
        why = "; ".join(text for _, text in notes) or "no component of dimension 1 has real points"
        raise (ComponentError if notes else NagError)(why)
    draw_real_curves(curves, onto, title, path)
    return Picture(path, tuple(rows), tuple(notes))


# --- Mechanisms


def plot_mechanism(
    problem: Problem,
    kind: str,
    what: Any,
    title: str,
    path: str,
    run: Run,
    *,
    onto: Sequence[str] | None = None,
    circuit: str | int = "reference",
) -> Picture:
    """Bodies and joints, or what is drawn along a motion.

    Args:
        problem: of a mechanism.
        kind: ``"graph"``, ``"mechanism"``, ``"joints"`` or ``"point"``.
        what: names of two joints, or the point's.
        onto: of a point's path, two of x, y and z.
        circuit: as for `nag.motion`.

    Raises:
        NagError: if there is nothing of such a name, or the file cannot be written.
        ComponentError: if there is no motion to draw.
    """
    from nag.mechanism.problem import in_real_coordinates
    from nag.mechanism.real_assemblies import of_real_assemblies

    if problem.model is None:
        raise NagError(f"{kind}: is for mechanisms; a polynomial system is given")
    with _refuse_unwritable(path):
        real = of_real_assemblies(in_real_coordinates(problem))
        return _plot_mechanism(real, kind, what, title, path, run, onto, circuit)


def _plot_mechanism(
    problem: Problem,
    kind: str,
    what: Any,
    title: str,
    path: str,
    run: Run,
    onto: Sequence[str] | None,
    circuit: str | int,
) -> Picture:
    from nag.kinematics.scene import scene_of

    scene = scene_of(problem)
    if kind == "graph":
        from nag.pictures.joint_graph import draw_joint_graph

        draw_joint_graph(scene, title, path)
        return Picture(
            path, (("bodies", str(len(scene.bodies))), ("joints", str(len(scene.joints))))
        )
    if kind == "mechanism":
        return _plot_configuration(problem, scene, title, path, run, circuit)
    from nag.kinematics.shown import circuit_text
    from nag.pictures.motion_picture import (
        draw_joint_values,
        draw_point_paths,
        joint_indices,
        point_of,
    )

    axes = _axes(onto, scene.planar)
    try:
        _ = joint_indices(scene, what) if kind == "joints" else point_of(scene, what)
    except NagError as error:
        raise NagError(f"{kind}: {error}") from None
    found = _motion(problem, circuit, run)
    if kind == "joints":
        draw_joint_values(found, what, title, path)
    else:
        draw_point_paths(found, what, axes, title, path)
    rows = tuple((f"circuit {c.number}", circuit_text(found, c)) for c in found.circuits)
    return Picture(path, rows, tuple(("open", note) for note in found.notes))


def _plot_configuration(
    problem: Problem, scene: Scene, title: str, path: str, run: Run, circuit: str | int
) -> Picture:
    import numpy as np

    from nag.pictures.mechanism_picture import choose_sample, draw_mechanism
    from nag.text.table import count_text

    if scene.from_reference and problem.reference is not None and circuit == "reference":
        poses = scene.lift(np.array([[float(x) for x in problem.reference]]))
        draw_mechanism(scene, [("", poses)], title, path)
        return Picture(path, (("drawn", "the reference configuration"),))
    found = _motion(problem, circuit, run)
    circuits = found.circuits[:MOST_PANELS]
    shown = []
    for each in circuits:
        at = choose_sample(scene, each.poses)
        shown.append((f"circuit {each.number}", each.poses.at(slice(at, at + 1))))
    draw_mechanism(scene, shown, title, path)
    text = count_text(len(circuits), "circuit")
    if len(circuits) < len(found.circuits):
        text = f"the first {len(circuits)} of {len(found.circuits)} circuits"
    rows = (("drawn", f"{text}, each where its joints are furthest from one line"),)
    return Picture(path, rows, tuple(("open", note) for note in found.notes))


def _motion(problem: Problem, circuit: str | int, run: Run) -> Motion:
    from nag.kinematics.motion import motion

    found = motion(problem, circuit=circuit, run=run)
    if not found.circuits:
        raise ComponentError(f"no motion to draw: {'; '.join(found.notes)}")
    return found


def _axes(onto: Sequence[str] | None, normal: Any) -> tuple[int, int]:
    """Which coordinates of a point are drawn: those that the plane of motion is seen best in."""
    if onto is None:
        left = 2 if normal is None else int(abs(normal).argmax())
        first, second = (i for i in range(3) if i != left)
        return first, second
    names = tuple(onto)
    if len(names) != 2 or names[0] == names[1] or not all(name in AXES for name in names):
        raise NagError(f"onto: {value_text(', '.join(map(str, names)))}: give two of x, y and z")
    return AXES.index(names[0]), AXES.index(names[1])


@contextlib.contextmanager
def _refuse_unwritable(path: str) -> Iterator[None]:
    """Say of a file that cannot be written that it is bad input.

    Raises:
        NagError: if it cannot.
    """
    try:
        yield
    except OSError as error:
        raise NagError(f"{path}: {error.strerror or error}") from None
