"""The graph of bodies and joints."""

from __future__ import annotations

import numpy as np

from nag.kinematics.scene import Scene
from nag.pictures.picture_file import COLOURS, DASHES, STYLE, save

# Of a circle of radius one: how far joints of the same two bodies are apart.
APART = 0.24
# Decimals of places.
PLACES = 3


def draw_joint_graph(scene: Scene, title: str, path: str) -> None:
    """Bodies, the ground a square; joints as lines, a style for each type.

    Raises:
        OSError: if the file cannot be written.
    """
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    places = _places(scene)
    types = list(dict.fromkeys(joint.type for joint in scene.joints))
    pairs = [tuple(sorted(joint.bodies)) for joint in scene.joints]
    with rc_context(STYLE | {"font.size": 8}):
        figure = Figure(figsize=(5.2, 5.2), layout="constrained")
        plane = figure.subplots()
        for i, (joint, pair) in enumerate(zip(scene.joints, pairs, strict=True)):
            k = types.index(joint.type)
            among = pairs[:i].count(pair) - (pairs.count(pair) - 1) / 2
            first, second = places[list(pair)]
            across = np.array([first[1] - second[1], second[0] - first[0]])
            bend = APART * among * across / np.linalg.norm(across)
            t = np.linspace(0, 1, 33)[:, None]
            line = first + t * (second - first) + 4 * t * (1 - t) * bend
            plane.plot(*line.T, linewidth=1.3, color=COLOURS[k % len(COLOURS)], zorder=1,
                       linestyle=DASHES[k % len(DASHES)], label=joint.type)  # fmt: skip
            plane.annotate(joint.name, line[16], ha="center", va="center", fontsize=7, zorder=2,
                           bbox={"boxstyle": "round", "fc": "white", "ec": "none",
                                 "pad": 0.15})  # fmt: skip
        for i, name in enumerate(scene.bodies):
            shape = "square" if i == scene.ground else "round"
            edge = 1.8 if i == scene.ground else 0.9
            plane.annotate(name, places[i], ha="center", va="center", weight="bold", zorder=3,
                           bbox={"boxstyle": shape, "fc": "#e8e8e8", "lw": edge})  # fmt: skip
        plane.set_xlim(-1.25, 1.25)
        plane.set_ylim(-1.25, 1.25)
        plane.set_aspect("equal")
        plane.axis("off")
        plane.set_title(title, fontsize=9)
        handles = dict(zip(*reversed(plane.get_legend_handles_labels()), strict=True))
        figure.legend(handles.values(), handles.keys(), loc="outside lower center", ncols=4,
                      frameon=False)  # fmt: skip
        save(figure, path)


def _places(scene: Scene) -> np.ndarray:
    """Where bodies are drawn, shape ``(bodies, 2)``: distances are like those in the graph."""
    import networkx

    count = len(scene.bodies)
    angles = np.pi / 2 - 2 * np.pi * np.arange(count) / count
    circle = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    graph = networkx.Graph()
    graph.add_nodes_from(range(count))
    graph.add_edges_from(joint.bodies for joint in scene.joints)
    if not networkx.is_connected(graph):
        return circle
    laid = networkx.kamada_kawai_layout(graph, pos=dict(enumerate(circle)))
    return np.round([laid[i] for i in range(count)], PLACES)
