"""Mechanisms from networkx graphs and back: bodies are nodes, joints are edges with attributes."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Mapping
from dataclasses import fields
from typing import TYPE_CHECKING, Any

from nag.algebra.tokens import quote
from nag.errors import MechanismError
from nag.mechanism.graph import Body, Joint, Mechanism
from nag.mechanism.joint_types import JOINT_TYPES, SYNONYMS

if TYPE_CHECKING:
    import networkx

# What an edge says beside its ends and its name: type, axis, point, ...
_ATTRIBUTES = tuple(f.name for f in fields(Joint) if f.name not in ("name", "bodies"))


def mechanism_from_graph(graph: Any, ground: Any = None) -> Mechanism:
    """The mechanism that a graph describes, see `Mechanism.from_graph`."""
    if not hasattr(graph, "edges") or not hasattr(graph, "nodes"):
        raise MechanismError(
            f"graph: something of type {type(graph).__name__} is given; give a networkx graph"
        )
    if ground is None:
        ground = graph.graph.get("ground")
    if ground is None:
        raise MechanismError("is missing; name the fixed body, ground=...", key="ground")
    names = _body_names(graph)
    joints: list[Joint] = []
    for u, v, key, data in _edges(graph):
        joints.append(_joint((names[u], names[v]), key, data, joints, graph.is_directed()))
    # networkx lists edges by their nodes.
    order = {name: i for i, name in enumerate(graph.graph.get("joints", ()))}
    joints.sort(key=lambda joint: order.get(joint.name, len(order)))
    bodies = []
    for node, data in graph.nodes(data=True):
        _check_typing(data, ("orientation",), f"node {names[node]!r}", {"body": names[node]})
        if data.get("orientation") is not None:
            bodies.append(Body(names[node], data["orientation"]))
    return Mechanism(str(ground), tuple(joints), tuple(bodies))


def graph_of(mechanism: Mechanism) -> networkx.MultiGraph:
    """The graph that `mechanism_from_graph` makes the same mechanism of."""
    import networkx

    names = tuple(joint.name for joint in mechanism.joints)
    graph = networkx.MultiGraph(ground=mechanism.ground, joints=names)
    for name in mechanism.body_names:
        given = next((b.orientation for b in mechanism.bodies if b.name == name), None)
        graph.add_node(name, **({} if given is None else {"orientation": given}))
    for joint in mechanism.joints:
        given = {name: getattr(joint, name) for name in _ATTRIBUTES}
        known = {name: value for name, value in given.items() if value is not None}
        graph.add_edge(*joint.bodies, key=joint.name, bodies=joint.bodies, **known)
    return graph


def _body_names(graph: Any) -> dict[Any, str]:
    names: dict[Any, str] = {}
    for node in graph.nodes:
        name = str(node)
        if name in names.values():
            raise MechanismError(
                f"two nodes are written {name!r}; give each body a name of its own", body=name
            )
        if graph.degree(node) == 0:
            raise MechanismError(
                f"body {name!r} has no joint; add an edge to it or remove the node", body=name
            )
        names[node] = name
    return names


def _edges(graph: Any) -> Iterable[tuple[Any, Any, Any, Mapping[str, Any]]]:
    if graph.is_multigraph():
        return graph.edges(keys=True, data=True)
    return ((u, v, None, data) for u, v, data in graph.edges(data=True))


def _joint(
    ends: tuple[str, str],
    key: Any,
    data: Mapping[str, Any],
    before: Iterable[Joint],
    directed: bool,
) -> Joint:
    name = data.get("name", key)
    if not isinstance(name, str):
        # networkx numbers the edges between two nodes from 0 on.
        name = "_".join([*ends, *([str(name)] if name else [])])
    if any(name == joint.name for joint in before):
        raise MechanismError(
            f"two joints are named {name!r}; every joint needs a name of its own",
            joint=name,
            key="name",
        )
    where = {"joint": name}
    _check_typing(data, (*_ATTRIBUTES, "bodies", "name"), f"edge {' - '.join(ends)}", where)
    kind = JOINT_TYPES.get(SYNONYMS.get(data.get("type"), data.get("type")))
    for attribute in ("type", *(kind.fields if kind else ())):
        if data.get(attribute) is None:
            raise MechanismError(
                f"the edge {' - '.join(ends)} has no {attribute}; add the attribute "
                f"{attribute}=...",
                joint=name,
                key=attribute,
            )
    bodies = tuple(map(str, data.get("bodies", ends)))
    if sorted(bodies) != sorted(ends):
        raise MechanismError(
            f"the edge's bodies are {', '.join(map(quote, bodies))}, its ends are "
            f"{', '.join(map(quote, ends))}; leave the attribute out or name the ends",
            joint=name,
            key="bodies",
        )
    given = {a: data[a] for a in _ATTRIBUTES if data.get(a) is not None}
    axes = [attribute for attribute in given if attribute.endswith("axis")]
    if len(axes) > 1 and not directed and "bodies" not in data:
        raise MechanismError(
            "each axis belongs to one body, and an undirected edge has no first one; add "
            f"bodies=({quote(ends[0])}, {quote(ends[1])}), in the order of the axes",
            joint=name,
            key="bodies",
        )
    return Joint(name=name, bodies=bodies, **given)


def _check_typing(
    data: Mapping[str, Any], known: Iterable[str], place: str, where: Mapping[str, str]
) -> None:
    """Attributes of other programs are none of our business; misspelt ones of ours are."""
    missing = [name for name in known if data.get(name) is None]
    for name in map(str, data):
        meant = difflib.get_close_matches(name, missing, n=1, cutoff=0.75)
        if name not in known and meant:
            raise MechanismError(
                f"{place} has an attribute {quote(name)} (did you mean {meant[0]!r}?)", **where
            )
