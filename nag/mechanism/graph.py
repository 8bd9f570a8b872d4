"""Mechanisms as graphs: bodies are nodes, joints are edges."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, overload

from nag.algebra.from_python import exact_vector
from nag.algebra.given import ANSWERS, GRAPH_GIVEN, check_listed, check_type, is_a, value_text
from nag.algebra.number import Number, brief_number_text, is_zero
from nag.algebra.tokens import nearest, quote
from nag.errors import MechanismError
from nag.mechanism.joint_types import HELICAL, JOINT_TYPES, SYNONYMS, VECTORS, JointType
from nag.text.table import one_line

if TYPE_CHECKING:
    import networkx

    from nag.numerics.read_only import RealArray

Vector = tuple[Number, Number, Number]
ORIGIN: Vector = (Fraction(0), Fraction(0), Fraction(0))


@dataclass(frozen=True)
class Joint:
    """A joint between two bodies, given in the assembled reference configuration.

    Attributes:
        name: unique among the joints.
        type: a key of `nag.mechanism.joint_types.JOINT_TYPES`, or a synonym of one.
        bodies: names of the two bodies that it joins.
        point: a point of its axis, in global coordinates; the centre of a spherical or universal
            joint; any point for the others, where it may be left out.
        axis: direction of its axis, in global coordinates, of any length but zero: of the turn of
            a revolute or cylindrical joint, of the slide of a prismatic one, the normal of a planar
            one, the axis in the first body of a universal one. None for the others.
        second_axis: of a universal joint, the axis in the second body. None for the others.

    Numbers may be int, Fraction, Decimal, text, NumPy's, sympy's, or float; a float is read as its
    shortest decimal (0.1 is 1/10).

    Raises:
        MechanismError: if a vector holds something that is no number.

    >>> import nag
    >>> joint = nag.Joint("A", "revolute", ("base", "left"), (0, 0.1, "1/3"), (0, 0, 1))
    >>> joint.point
    (Fraction(0, 1), Fraction(1, 10), Fraction(1, 3))
    """

    name: str
    type: str
    bodies: tuple[str, str]
    point: Vector = ORIGIN
    axis: Vector | None = None
    second_axis: Vector | None = None

    if TYPE_CHECKING:
        # What is given is read as exact numbers.
        def __init__(
            self,
            name: str,
            type: str,
            bodies: Iterable[str],
            point: Iterable[Any] | None = ORIGIN,
            axis: Iterable[Any] | None = None,
            second_axis: Iterable[Any] | None = None,
        ) -> None: ...

    def __post_init__(self) -> None:
        object.__setattr__(self, "type", SYNONYMS.get(self.type, self.type))
        object.__setattr__(self, "bodies", _as_tuple(self.bodies, "bodies", joint=self.name))
        if self.point is None:
            object.__setattr__(self, "point", ORIGIN)
        for field in VECTORS:
            value = getattr(self, field)
            if value is not None:
                object.__setattr__(self, field, _exact(value, field, joint=self.name))

    @property
    def of_type(self) -> JointType:
        """What its type asks for and leaves free."""
        return JOINT_TYPES[self.type]

    def freedoms_in(self, space: str) -> int:
        """Its freedoms in a planar, spherical or spatial mechanism."""
        return min(self.of_type.freedoms, 6 if space == "spatial" else 3)

    def axis_in(self, body: str) -> Vector | None:
        """The direction of its axis in one of its two bodies; None if it has none."""
        second = self.second_axis is not None and body == self.bodies[1]
        return self.second_axis if second else self.axis

    def other(self, body: str) -> str:
        """The body at the other end."""
        return self.bodies[1] if body == self.bodies[0] else self.bodies[0]


@dataclass(frozen=True)
class Body:
    """A body that names its own local frame.

    Attributes:
        name: as the joints use it.
        orientation: Euler parameters of the local frame at the reference configuration, of norm 1;
            None for the global frame at that configuration.
    """

    name: str
    orientation: tuple[Number, Number, Number, Number] | None = None

    def __post_init__(self) -> None:
        if self.orientation is not None:
            exact = _exact(self.orientation, "orientation", body=self.name)
            object.__setattr__(self, "orientation", exact)


@dataclass(frozen=True)
class Mechanism:
    """A connected graph of bodies and joints with one fixed body.

    Attributes:
        ground: name of the fixed body.
        joints: at least one.
        bodies: local frames; bodies that are not named here have the global frame.

    Raises:
        MechanismError: if a joint or a body makes no sense, or the graph is not connected.
    """

    ground: str
    joints: tuple[Joint, ...]
    bodies: tuple[Body, ...] = ()

    if TYPE_CHECKING:

        def __init__(
            self, ground: str, joints: Iterable[Joint], bodies: Iterable[Body] = ()
        ) -> None: ...

    def __post_init__(self) -> None:
        for key, kind in (("joints", Joint), ("bodies", Body)):
            values = _as_tuple(getattr(self, key), key)
            for i, value in enumerate(values):
                check_type(value, kind, f"{key}[{i}]", f"a nag.{kind.__name__}")
            object.__setattr__(self, key, values)
        if not self.joints:
            raise MechanismError("a mechanism needs at least one joint")
        for joint in self.joints:
            _check_names(joint)
            _check_joint(joint)
        repeated = _first_repeated(j.name for j in self.joints)
        if repeated is not None:
            raise MechanismError(
                f"two joints are named {repeated!r}; every joint needs a name of its own",
                joint=repeated,
                key="name",
            )
        _check_duplicates(self.joints)
        used = {b for j in self.joints for b in j.bodies}
        repeated = _first_repeated(b.name for b in self.bodies)
        if repeated is not None:
            raise MechanismError(
                f"body {repeated!r} is given twice; give each body once", body=repeated, key="name"
            )
        for body in self.bodies:
            _check_body(body, used)
        if self.ground not in used:
            raise MechanismError(
                f"ground {self.ground!r} is not a body of any joint; the bodies are "
                f"{', '.join(sorted(used))}",
                key="ground",
            )
        self._check_connected(used)

    def _check_connected(self, used: set[str]) -> None:
        stray = sorted(used - connected_to(self.ground, (j.bodies for j in self.joints)))
        if stray:
            joint = next(j for j in self.joints if stray[0] in j.bodies)
            raise MechanismError(
                f"no joint connects {', '.join(stray)} with the ground {self.ground!r}; "
                "every body must be connected with the ground",
                joint=joint.name,
                body=stray[0],
                key="bodies",
            )

    @cached_property
    def body_names(self) -> tuple[str, ...]:
        """All bodies: the ground, then in the order in which they are declared and joined."""
        names = dict.fromkeys([self.ground])
        names.update(dict.fromkeys(b.name for b in self.bodies))
        names.update(dict.fromkeys(b for j in self.joints for b in j.bodies))
        return tuple(names)

    @cached_property
    def graph(self) -> networkx.MultiGraph:
        """Bodies as nodes, joints as edges keyed by name, each with the attribute ``joint``."""
        import networkx

        graph = networkx.MultiGraph()
        graph.add_nodes_from(self.body_names)
        for joint in self.joints:
            graph.add_edge(*joint.bodies, key=joint.name, joint=joint)
        return graph

    @classmethod
    def from_graph(cls, graph: Any, ground: Any = None) -> Mechanism:
        """The mechanism that a networkx graph describes: nodes are bodies, edges joints.

        Each edge has the attributes of a `Joint`: ``type``, and what that type needs (``point``,
        ``axis``). Its name is the attribute ``name``, else its key if that is text, else made of
        its ends. A node may have the ``orientation`` of a `Body`. Other attributes are ignored.
        In a directed graph an edge's first body is its source; of an undirected one
        ``bodies=(first, second)`` says which is first, where that matters.

        Args:
            graph: a `networkx.MultiGraph`, or another of networkx' graphs.
            ground: the node that is fixed; by default the graph's attribute ``ground``.

        Raises:
            MechanismError: if an attribute is missing or makes no sense, or the graph is not
                connected; the message says which edge or node, and what would be right.

        >>> import nag, networkx
        >>> G = networkx.MultiGraph()
        >>> G.add_edge("base", "left", "A", type="revolute", axis=(0, 0, 1), point=(0, 0, 0))
        'A'
        >>> G.add_edge("left", "top", "B", type="revolute", axis=(0, 0, 1), point=(0, 1, 0))
        'B'
        >>> print(nag.Mechanism.from_graph(G, ground="base"))
        Mechanism of 3 bodies (base, left, top), ground base
          A  revolute, base - left, point (0, 0, 0), axis (0, 0, 1)
          B  revolute, left - top, point (0, 1, 0), axis (0, 0, 1)
        """
        from nag.mechanism.networkx_graph import mechanism_from_graph

        return mechanism_from_graph(graph, ground)

    @classmethod
    def from_lines(cls, lines: Iterable[Any]) -> Mechanism:
        """The closed loop of revolute joints about lines, in their order.

        Args:
            lines: each six numbers, a direction and the moment point x direction, or a
                ``NormalizedLine`` of rational-linkages. Exact numbers are kept; floats are taken as
                their shortest decimals, so that a loop that moves for special numbers alone is
                rigid, and nearly mobile (``tolerance`` of `nag.mobility`).

        Raises:
            MechanismError: if one is no line.

        >>> import nag
        >>> places = [(0, 0), (0, 1), (2, 1), (2, 0)]
        >>> lines = [(0, 0, 1, y, -x, 0) for x, y in places]
        >>> nag.mobility(nag.Mechanism.from_lines(lines)).local_dimension
        1
        """
        from nag.mechanism.lines import loop_of_lines

        return loop_of_lines(lines)

    @overload
    def lines(self, exact: Literal[False] = False) -> RealArray: ...

    @overload
    def lines(self, exact: Literal[True]) -> tuple[tuple[Number, ...], ...]: ...

    def lines(self, exact: bool = False) -> RealArray | tuple[tuple[Number, ...], ...]:
        """Direction and moment, point x direction, of each joint that has an axis.

        Args:
            exact: whether the numbers are kept as they are, six of each joint, of which
                `from_lines` makes the same axes; else they are doubles, shape ``(k, 6)``,
                directions of length 1.

        >>> import nag
        >>> bennett = nag.read_case("cases/bennett.toml").mechanism
        >>> nag.mobility(nag.Mechanism.from_lines(bennett.lines(exact=True))).local_dimension
        1
        """
        from nag.mechanism.lines import exact_lines_of, lines_of

        return exact_lines_of(self) if exact else lines_of(self)

    def to_graph(self) -> networkx.MultiGraph:
        """The mechanism as a networkx graph, of which `from_graph` makes the same mechanism.

        Edges are keyed by the joints' names and have their fields as attributes; ``ground`` and
        the order of the ``joints`` are attributes of the graph.

        >>> import nag
        >>> graph = nag.read_case("cases/bennett.toml").mechanism.to_graph()
        >>> graph.number_of_nodes(), graph.number_of_edges(), graph.graph["ground"]
        (4, 4, 'B0')
        >>> nag.Mechanism.from_graph(graph).to_graph().edges == graph.edges
        True
        """
        from nag.mechanism.networkx_graph import graph_of

        return graph_of(self)

    __repr__ = one_line

    def __str__(self) -> str:
        from nag.mechanism.shown import mechanism_text

        return mechanism_text(self)

    def _repr_html_(self) -> str:
        from nag.mechanism.shown import mechanism_html

        return mechanism_html(self)

    def orientation(self, body: str) -> tuple[Number, ...]:
        """Euler parameters of the local frame of ``body`` at the reference configuration."""
        for given in self.bodies:
            if given.name == body and given.orientation is not None:
                return given.orientation
        return (Fraction(1), Fraction(0), Fraction(0), Fraction(0))


def connected_to(start: str, ties: Iterable[Collection[str]]) -> set[str]:
    """Everything that is connected with ``start``, where each of ``ties`` connects its members."""
    around: dict[str, list[Collection[str]]] = {}
    for tie in ties:
        for name in tie:
            around.setdefault(name, []).append(tie)
    reached, frontier = {start}, [start]
    while frontier:
        for tie in around.pop(frontier.pop(), ()):
            frontier += [name for name in tie if name not in reached]
            reached.update(tie)
    return reached


def _exact(values: Any, key: str, **owner: str) -> tuple[Number, ...]:
    try:
        return exact_vector(values, "coordinates")
    except ValueError as error:
        raise MechanismError(str(error), key=key, **owner) from None


def _as_tuple(values: Any, key: str, **owner: str) -> tuple[Any, ...]:
    try:
        check_listed(values, key, f"a list of {key}")
    except ValueError as error:
        raise MechanismError(str(error).partition(": ")[2], key=key, **owner) from None
    return tuple(values)


def _check_joint(joint: Joint) -> None:
    if joint.type not in JOINT_TYPES:
        near = nearest(str(joint.type), JOINT_TYPES)
        given = quote(joint.type) if isinstance(joint.type, str) else value_text(joint.type)
        text = f"joint type {given} is unknown{near}; use one of "
        text += ", ".join(sorted(JOINT_TYPES))
        raise MechanismError(
            HELICAL if joint.type in ("helical", "screw") else text, joint=joint.name, key="type"
        )
    if len(joint.bodies) != 2:
        raise MechanismError(
            f"a joint has two bodies, not {len(joint.bodies)}", joint=joint.name, key="bodies"
        )
    if joint.bodies[0] == joint.bodies[1]:
        raise MechanismError(
            f"the joint connects {joint.bodies[0]!r} with itself; it needs two different bodies",
            joint=joint.name,
            key="bodies",
        )
    for key in VECTORS:
        _check_vector(joint, key)
    if joint.second_axis is not None and _parallel(joint.axis, joint.second_axis):
        raise MechanismError(
            "both axes have the same direction; a universal joint needs two that cross at its "
            "point, else it is a revolute one",
            joint=joint.name,
            key="second_axis",
        )


def _check_duplicates(joints: tuple[Joint, ...]) -> None:
    """A joint given twice is a slip of the pen; two hinges of a door have points of their own."""
    for i, joint in enumerate(joints):
        for other in joints[:i]:
            if set(other.bodies) == set(joint.bodies) and _same_joint(other, joint):
                raise MechanismError(
                    f"the same axis joins {joint.bodies[0]!r} and {joint.bodies[1]!r} in joint "
                    f"{other.name!r} already; leave one of them out",
                    joint=joint.name,
                    key="axis",
                )


def _same_joint(first: Joint, second: Joint) -> bool:
    if first.type != second.type or not first.of_type.keeps_line:
        return False
    here = all(is_zero(x - y) for x, y in zip(second.point, first.point, strict=True))
    return here and _parallel(first.axis, second.axis)


def _check_vector(joint: Joint, key: str) -> None:
    value, known = getattr(joint, key), joint.of_type
    if value is None and key in known.fields:
        raise MechanismError(
            f"a {joint.type} joint needs its {key.replace('_', ' ')}", joint=joint.name, key=key
        )
    if value is None:
        return
    if len(value) != 3:
        raise MechanismError(
            f"{key} has {len(value)} coordinates; it needs 3", joint=joint.name, key=key
        )
    if key != "point" and key not in known.fields + known.optional:
        raise MechanismError(
            f"a {joint.type} joint has no {key.replace('_', ' ')}; leave it out",
            joint=joint.name,
            key=key,
        )
    if key != "point" and all(is_zero(x) for x in value):
        raise MechanismError(
            "the axis has length zero; it needs a direction", joint=joint.name, key=key
        )


def _check_names(joint: Joint) -> None:
    """Names of a joint and its bodies are texts in one line, as a case has them."""
    for key, names in (("name", (joint.name,)), ("bodies", joint.bodies)):
        for name in names:
            if not (isinstance(name, str) and name.strip() and name.isprintable()):
                raise MechanismError(
                    f"{quote(str(name))} is no name; write a text in one line",
                    joint=joint.name,
                    key=key,
                )


def _parallel(u: Vector, v: Vector) -> bool:
    return all(is_zero(u[i] * v[j] - u[j] * v[i]) for i, j in ((0, 1), (1, 2), (2, 0)))


def _check_body(body: Body, used: set[str]) -> None:
    if body.name not in used:
        raise MechanismError(
            f"body {body.name!r} has no joint; the bodies of the joints are "
            f"{', '.join(sorted(used))}",
            body=body.name,
            key="name",
        )
    if body.orientation is None:
        return
    if len(body.orientation) != 4:
        raise MechanismError(
            f"an orientation is 4 Euler parameters, not {len(body.orientation)}",
            body=body.name,
            key="orientation",
        )
    norm = sum((x * x for x in body.orientation[1:]), body.orientation[0] * body.orientation[0])
    if not is_zero(norm - 1):
        raise MechanismError(
            f"the Euler parameters have squared norm {brief_number_text(norm)}; it must be "
            "exactly 1",
            body=body.name,
            key="orientation",
        )


def _first_repeated(names: Iterable[str]) -> str | None:
    seen: set[str] = set()
    for name in names:
        if name in seen:
            return name
        seen.add(name)
    return None


def is_equations(given: Any) -> bool:
    """Whether equations are given, by themselves, in a case, as a system or with an answer."""
    if any(is_a(given, *kind) for kind in ANSWERS):
        return True
    if is_a(given, "nag.files.cases", "Case"):
        return bool(given.kind == "system")
    texts = isinstance(given, str) or is_a(given, "nag.algebra.system", "PolynomialSystem")
    return texts or isinstance(given, list | tuple) or hasattr(given, "free_symbols")


def check_mechanism(given: Any, others: str = "") -> None:
    """Make sure that a mechanism is given.

    Args:
        others: what may be given as well, for the message.

    Raises:
        MechanismError: if something else is; the message says how to make a mechanism of it.
    """
    if isinstance(given, Mechanism):
        return
    if is_a(given, "networkx", "Graph"):
        what = GRAPH_GIVEN
    elif is_a(given, "nag.files.cases", "Case") and not is_equations(given):
        what = (
            f"a nag.Case is given; give its mechanism, case.mechanism{others and ', or '}{others}"
        )
    elif is_a(given, "nag.mechanism.assembly", "AssemblyModel"):
        what = "parts are given that may be assembled in several ways, which have no reference "
        what += f"configuration; give a nag.Mechanism{others and ', or '}{others}"
    elif is_equations(given):
        what = (
            "equations are given, which have no bodies; ask nag.local (the dimension at a point) "
            "or nag.decompose (all components), or give a nag.Mechanism"
            f"{others and ', or '}{others}"
        )
    else:
        what = f"{value_text(given)} is given; give a nag.Mechanism{others and ', or '}{others}"
    raise MechanismError(f"mechanism: {what}")
