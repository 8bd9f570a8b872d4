"""A mechanism at some configurations: bodies by lines between their joints, joints by marks."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from nag.kinematics.poses import Poses
from nag.kinematics.scene import Scene, SceneJoint
from nag.page.link_shapes import link_shapes
from nag.pictures.picture_file import COLOURS, DASHES, STYLE, save
from nag.pictures.space_curves import AZIMUTH, ELEVATION

# Marks of joints by what they leave free, and half the length at which their axes are drawn, in
# sizes of the mechanism.
MARKS = {"revolute": "o", "prismatic": "s", "cylindrical": "D", "universal": "P", "spherical": "."}
AXIS = 0.09
# Widths of the ground's lines and of the others'.
WIDE, THIN = 3.2, 1.8
# Room round it all.
MARGIN = 0.08
# In points of print: marks that are one place, and how far a name is from its mark.
NEAR, BESIDE = 2.0, 4.0
# Ways from a mark to its name, the first that cover nothing is taken; and points along a line.
DIRECTIONS = np.array(
    [(1, 0.6), (1, -0.6), (-1, 0.6), (-1, -0.6), (1, 0), (-1, 0), (0, 1), (0, -1)]
)
ALONG = 40
# Inches: a picture of one configuration, and each of several panels.
WHOLE, PANEL = 5.2, 2.9


def draw_mechanism(scene: Scene, shown: Sequence[tuple[str, Poses]], title: str, path: str) -> None:
    """Bodies, each in a style of its own, the ground black; joints with their names and axes.

    A planar mechanism is seen along the normal of its plane, others from a little above.

    Args:
        scene: the bodies and joints.
        shown: configurations, with what they are called; each has a panel of its own.

    Raises:
        OSError: if the file cannot be written.
    """
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    flat = scene.planar is not None
    columns = math.ceil(math.sqrt(len(shown)))
    rows = -(-len(shown) // columns)
    with rc_context(STYLE | {"font.size": 8}):
        size = (PANEL * columns, PANEL * rows)
        figure = Figure(figsize=size if len(shown) > 1 else (WHOLE, WHOLE), layout="constrained")
        for k, (name, poses) in enumerate(shown, 1):
            kind = {} if flat else {"projection": "3d"}
            axes = figure.add_subplot(rows, columns, k, **kind)
            _draw_configuration(axes, scene, poses)
            axes.set_title(name if len(shown) > 1 else title, fontsize=9)
        if len(shown) > 1:
            figure.suptitle(title, fontsize=9)
        handles = dict(zip(*reversed(axes.get_legend_handles_labels()), strict=True))
        figure.legend(handles.values(), handles.keys(), loc="outside lower center", ncols=4,
                      frameon=False)  # fmt: skip
        # Where everything is on paper is known when it is laid out.
        figure.draw_without_rendering()
        for panel, (_, poses) in zip(figure.axes, shown, strict=True):
            _write_names(panel, scene, poses)
        save(figure, path)


def choose_sample(scene: Scene, poses: Poses) -> int:
    """The sample at which joints are as far from one line as they are anywhere on the way.

    Circuits may begin, and cross each other, where links are in line.
    """
    places = np.array(_joint_places(scene, poses))
    spread = places - places.mean(axis=0)
    return int(np.linalg.svd(spread.transpose(1, 0, 2), compute_uv=False)[:, 1].argmax())


def _draw_configuration(axes: Any, scene: Scene, poses: Poses) -> None:
    frame, flat = _frame(scene.planar), scene.planar is not None
    places = [place[0] for place in _joint_places(scene, poses)]
    shown = [_show(point, frame, flat) for point in places]
    for body, name in enumerate(scene.bodies):
        ground = body == scene.ground
        style: dict[str, Any] = {
            "color": "black" if ground else COLOURS[body % len(COLOURS)],
            "linestyle": "-" if ground else DASHES[body % len(DASHES)],
            "linewidth": WIDE if ground else THIN,
        }
        for line in _lines(scene, poses, places, body):
            axes.plot(*_show(line, frame, flat).T, label=name, zorder=1, **style)
    for joint, place, at in zip(scene.joints, places, shown, strict=True):
        if not flat and joint.axis is not None:
            ends = _axis_ends(scene, poses, joint, place)
            axes.plot(*_show(ends, frame, flat).T, color="#777777", linewidth=0.9, zorder=2)
        axes.plot(*at[:, None], marker=MARKS.get(joint.type, "x"), markersize=6, zorder=3,
                  color="white", markeredgecolor="black", linestyle="")  # fmt: skip
    _set_window(axes, np.array(shown))
    axes.set_axis_off()


def _write_names(axes: Any, scene: Scene, poses: Poses) -> None:
    """Names of joints beside their marks, one after another where the fewest things are covered.

    Joints that are drawn in one place have one text.
    """
    frame, flat = _frame(scene.planar), scene.planar is not None
    places = np.array([_show(p[0], frame, flat) for p in _joint_places(scene, poses)])
    if not flat:
        from mpl_toolkits.mplot3d.proj3d import proj_transform

        places = np.array(proj_transform(*places.T, axes.get_proj()))[:2].T
    marks = axes.transData.transform(places)
    dot = axes.figure.dpi / 72
    together: list[list[int]] = []
    for i, mark in enumerate(marks):
        own = next((t for t in together if np.abs(marks[t[0]] - mark).max() < NEAR * dot), None)
        if own is None:
            together.append([i])
        else:
            own.append(i)
    covered = np.vstack([marks, *map(_points_along, axes.lines)])
    taken: list[tuple[np.ndarray, np.ndarray]] = []
    for own in together:
        names = ", ".join(scene.joints[i].name for i in own)
        text = axes.annotate(names, places[own[0]], (0, 0), textcoords="offset points", fontsize=7,
                             ha="center", va="center", zorder=4)  # fmt: skip
        half = np.array(text.get_window_extent().size) / 2
        best = min(
            (direction * (half + BESIDE * dot) for direction in DIRECTIONS),
            key=lambda way, at=marks[own[0]], half=half: _cover(at + way, half, covered, taken),
        )
        taken.append((marks[own[0]] + best, half))
        text.set_position(tuple(best / dot))


def _points_along(line: Any) -> np.ndarray:
    """Points on paper along a line that is drawn, shape ``(k, 2)``."""
    ends = line.get_transform().transform(line.get_xydata())
    t = np.linspace(0, 1, ALONG)[:, None, None]
    return ((1 - t) * ends[:-1] + t * ends[1:]).reshape(-1, 2)


def _cover(
    middle: np.ndarray,
    half: np.ndarray,
    covered: np.ndarray,
    taken: Sequence[tuple[np.ndarray, np.ndarray]],
) -> tuple[float, int]:
    """What a text would cover: an area of other texts, and points of what is drawn."""
    area = 0.0
    for at, size in taken:
        area += float(np.prod(np.clip(half + size - np.abs(middle - at), 0, None)))
    return area, int((np.abs(covered - middle) < half).all(axis=1).sum())


def _frame(normal: np.ndarray | None) -> np.ndarray:
    """Rows: directions to the right, upwards and to the viewer."""
    if normal is None:
        return np.eye(3)
    up = np.eye(3)[1] if abs(normal[1]) < abs(normal).max() else np.eye(3)[2]
    right = np.cross(up, normal)
    right /= np.linalg.norm(right)
    return np.array([right, np.cross(normal, right), normal])


def _show(points: np.ndarray, frame: np.ndarray, flat: bool) -> np.ndarray:
    """Points in the frame of the picture."""
    seen = points @ frame.T
    return seen[..., :2] if flat else seen


def _joint_places(scene: Scene, poses: Poses) -> list[np.ndarray]:
    """Where joints are drawn, each of shape ``(k, 3)``: without a place of their own by others."""
    hubs = link_shapes(scene, {}).hubs
    return [
        poses.move(joint.bodies[0], np.array(hub))
        for joint, hub in zip(scene.joints, hubs, strict=True)
    ]


def _lines(scene: Scene, poses: Poses, places: Sequence[np.ndarray], body: int) -> list[np.ndarray]:
    """What a body is drawn by: lines from its middle to its joints, or between two of them."""
    joints = zip(scene.joints, places, strict=True)
    at = [place for joint, place in joints if body in joint.bodies]
    at += [poses.move(body, point)[0] for b, point in scene.points.values() if b == body]
    if len(at) == 2:
        return [np.array(at)]
    if scene.planar is not None and len(at) > 2:
        return [np.array([*at, at[0]])]
    middle = np.mean(at, axis=0) if at else np.zeros(3)
    return [np.array([middle, point]) for point in at]


def _axis_ends(scene: Scene, poses: Poses, joint: SceneJoint, at: np.ndarray) -> np.ndarray:
    """A piece of a joint's axis, about a place on it."""
    along = AXIS * scene.size * poses.turn(joint.bodies[0], joint.axis_in(0))[0]
    return np.array([at - along, at + along])


def _set_window(axes: Any, points: np.ndarray) -> None:
    low, high = points.min(axis=0), points.max(axis=0)
    middle, half = (low + high) / 2, (0.5 + MARGIN) * (float((high - low).max()) or 1.0)
    names: Sequence[str] = "xyz"[: points.shape[1]]
    for name, centre in zip(names, middle, strict=True):
        getattr(axes, f"set_{name}lim")(centre - half, centre + half)
    if len(names) == 2:
        axes.set_aspect("equal")
    else:
        axes.view_init(ELEVATION, AZIMUTH)
        axes.set_box_aspect((1, 1, 1))
