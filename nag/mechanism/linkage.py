"""Planar linkages by the shapes of their links: how they are assembled is found by solving.

A link carries pins; links that share a pin are joined there by a revolute joint. Each moving link
has (c, s), the cosine and sine of its turn, and each loop of links closes: two equations, linear in
them (Piipponen & Tuomela 2013, section 5.3).

Isotropic coordinates, z = c + is for each link, take fewer paths, as in frameworks, but equations
with plates have coefficients in Q(i) there, and a plate of bars may be its mirror image. So the
model is in (c, s), and only paths are tracked in z (`nag.decomposition.toric_section`).

The places of the pins are other coordinates, without loops and angles: the first two pins of a link
keep their distance, and its other pins follow from them linearly. Pins are linear in cosines and
sines, and these in the pins: components correspond to each other, of the same dimensions and
degrees, though no equation is the same.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from nag.algebra.from_python import exact_number, exact_vector
from nag.algebra.given import check_type, value_text
from nag.algebra.number import Number, is_zero, square_root
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.algebra.tokens import is_part_name, part_name_text
from nag.errors import MechanismError
from nag.mechanism.assembly import AssemblyModel, Side
from nag.mechanism.axes import difference
from nag.mechanism.given_rotation import GivenFrame, turn_about
from nag.mechanism.graph import connected_to
from nag.mechanism.loops import minimum_cycles
from nag.mechanism.path_estimates import Alternative
from nag.text.table import count_text, lines_of, one_line

Place = tuple[Number, Number]


class LinkageError(MechanismError):
    """A linkage that makes no sense.

    Attributes:
        link: name of the link that is wrong, or None.
        key: the field that is wrong, or None.
    """

    def __init__(self, message: str, link: str | None = None, key: str | None = None) -> None:
        super().__init__(message)
        self.link = link
        self.key = key

    def __str__(self) -> str:
        owner = f"link {self.link!r}" if self.link is not None else ""
        return ": ".join(filter(None, (owner, self.key, self.message)))


@dataclass(frozen=True)
class Link:
    """A rigid plate with pins.

    Attributes:
        name: unique among the links.
        pins: names of its pins, two or more.
        shape: the place of each pin in the link's own frame.
    """

    name: str
    pins: tuple[str, ...]
    shape: tuple[Place, ...]

    def __post_init__(self) -> None:
        if not is_part_name(self.name):
            raise LinkageError(part_name_text(self.name, "link"), self.name, "name")
        if len(self.pins) < 2:
            raise LinkageError("a link needs at least two pins", self.name, "pins")
        if len(set(self.pins)) != len(self.pins):
            raise LinkageError("a pin is there twice; name each pin once", self.name, "pins")
        for i, place in enumerate(self.shape):
            for j, other in enumerate(self.shape[:i]):
                if all(is_zero(x - y) for x, y in zip(place, other, strict=True)):
                    raise LinkageError(
                        f"pins {self.pins[j]!r} and {self.pins[i]!r} are at the same place: a link "
                        "of length zero; make them one pin",
                        self.name,
                        "shape" if len(self.pins) > 2 else "length",
                    )


@dataclass(frozen=True)
class Linkage:
    """Links and the fixed one among them.

    Raises:
        LinkageError: if names are repeated, the ground is no link, or the links do not hang
            together.
    """

    ground: str
    links: tuple[Link, ...]

    @classmethod
    def of(cls, links: Mapping[str, Any], ground: str) -> Linkage:
        """The linkage of links by name.

        Args:
            links: each two pins and their distance, ``("A", "B", 3)``, or a plate, the places of
                its pins in its own frame: ``{"A": (0, 0), "B": (2, 0), "C": (1, 1)}``.
            ground: the fixed one.

        Raises:
            LinkageError: if the linkage makes no sense.
            nag.EquationError: if something is no number.

        >>> import nag
        >>> bars = {"base": "AD2", "left": "AB1", "top": "BC2", "right": "CD1"}
        >>> nag.mobility(nag.Linkage.of(bars, "base")).local_dimension
        1
        """
        check_type(links, Mapping, "links", 'a dict by name, {"base": ("A", "B", 3)}')
        check_type(ground, str, "ground", "the name of a link")
        return cls(ground, tuple(_link_of(str(name), given) for name, given in links.items()))

    def __post_init__(self) -> None:
        object.__setattr__(self, "links", tuple(self.links))
        names = [link.name for link in self.links]
        for i, name in enumerate(names):
            if name in names[:i]:
                raise LinkageError("another link has that name", name, "name")
        if self.ground not in names:
            raise LinkageError(
                f"{self.ground!r} is no link; the links are {', '.join(names)}", key="ground"
            )
        shared: dict[str, list[str]] = {}
        for link in self.links:
            for pin in link.pins:
                shared.setdefault(pin, []).append(link.name)
        reached = connected_to(self.ground, shared.values())
        stray = [name for name in names if name not in reached]
        if stray:
            raise LinkageError(
                f"no pin connects it with the ground {self.ground!r}", stray[0], "pins"
            )

    __repr__ = one_line

    def __str__(self) -> str:
        names = ", ".join(link.name for link in self.links)
        title = f"Linkage of {count_text(len(self.links), 'link')} ({names}), ground {self.ground}"
        return lines_of(title, [(link.name, f"pins {', '.join(link.pins)}") for link in self.links])

    @property
    def gruebler_kutzbach(self) -> int:
        """3 (links - 1) - 2 joints; a pin of k links is k - 1 joints."""
        pins = {p for link in self.links for p in link.pins}
        joints = sum(sum(p in link.pins for link in self.links) - 1 for p in pins)
        return 3 * (len(self.links) - 1) - 2 * joints


def _link_of(name: str, given: Any) -> Link:
    place = f"links[{name!r}]"
    if isinstance(given, Mapping):
        shape = [exact_vector(at, f"{place}[{pin!r}]") for pin, at in given.items()]
        if any(len(at) != 2 for at in shape):
            raise LinkageError("a pin has two coordinates, in the link's own frame", name, "shape")
        return Link(name, tuple(map(str, given)), tuple((x, y) for x, y in shape))
    if not isinstance(given, Iterable) or len(listed := list(given)) != 3:
        raise LinkageError('give ("A", "B", length), or places of pins by name', name)
    first, second, length = listed
    distance = exact_number(length, place)
    if not distance > 0:
        raise LinkageError(
            f"{value_text(length)} is not positive; a link has a positive length", name, "length"
        )
    zero = Fraction(0)
    return Link(name, (str(first), str(second)), ((zero, zero), (distance, zero)))


def hold_pin(linkage: Linkage, pin: str, first: str, second: str, angle: Number) -> Linkage:
    """The linkage with two links fixed at a pin that they share, as one plate.

    Args:
        linkage: the links.
        pin: name of the pin.
        first: the link that stays as it is, and gives the plate its name and frame.
        second: the other one, turned against the first by the angle.
        angle: in radians; rounded to 16 digits where it is no multiple of pi/12.

    Raises:
        LinkageError: if two pins of the plate are at one place.
    """
    links = {link.name: link for link in linkage.links}
    kept, moved = links[first], links[second]
    turn = GivenFrame(turn_about((0, 0, 1), angle).quaternion)
    base, origin = kept.shape[kept.pins.index(pin)], moved.shape[moved.pins.index(pin)]
    pins, shape = list(kept.pins), list(kept.shape)
    for name, place in zip(moved.pins, moved.shape, strict=True):
        if name not in pins:
            x, y, _ = turn.turned((*difference(place, origin), Fraction(0)))
            pins.append(name)
            shape.append((base[0] + x, base[1] + y))
    plate = Link(first, tuple(pins), tuple(shape))
    left = tuple(plate if k.name == first else k for k in linkage.links if k.name != second)
    return Linkage(first if linkage.ground == second else linkage.ground, left)


@dataclass(frozen=True, repr=False)
class LinkageModel(AssemblyModel):
    """All assemblies of a linkage as a system.

    Attributes:
        linkage: what is modelled.
        loops: number of independent loops.
        free: links that hang on one pin only, or on nothing that closes; each turns freely.
        system: norms and loop equations in (c, s) of the moving links that are in loops.
        in_loops: the links that are in loops, the one that is held first.
    """

    linkage: Linkage
    loops: int
    free: tuple[str, ...]
    system: PolynomialSystem
    in_loops: tuple[Link, ...]

    space = "planar"
    formulation_text = "cosines and sines of a linkage"

    @property
    def gruebler_kutzbach(self) -> int:
        """The mobility that counting predicts."""
        return self.linkage.gruebler_kutzbach

    @property
    def freedoms_left_out(self) -> tuple[tuple[int, str], ...]:
        """The turns of links that close nothing."""
        return ((len(self.free), "the links that hang on one pin"),) if self.free else ()

    def pin_places(self, point: Sequence[Any]) -> dict[str, tuple[Any, Any]]:
        """The places of all pins where the moving links have these cosines and sines.

        Links that close nothing are not turned. Places are doubles where these are.
        """
        held, *moving = self.in_loops
        kind = float if any(isinstance(x, float) for x in point) else _as_it_is
        shapes = {
            k.name: [(kind(x), kind(y)) for x, y in k.shape] for k in (held, *self.linkage.links)
        }
        turn: dict[str, tuple[Any, Any]] = {link.name: (1, 0) for link in self.linkage.links}
        turn |= {k.name: (point[2 * i], point[2 * i + 1]) for i, k in enumerate(moving)}
        places: dict[str, tuple[Any, Any]] = dict(zip(held.pins, shapes[held.name], strict=True))
        left = [link for link in self.linkage.links if link.name != held.name]
        while left:
            link = next(k for k in left if places.keys() & set(k.pins))
            left.remove(link)
            (c, s), start = turn[link.name], next(p for p in link.pins if p in places)
            (x0, y0), origin = places[start], shapes[link.name][link.pins.index(start)]
            for pin, (x, y) in zip(link.pins, shapes[link.name], strict=True):
                dx, dy = x - origin[0], y - origin[1]
                places.setdefault(pin, (x0 + c * dx - s * dy, y0 + s * dx + c * dy))
        return places

    def place_polynomials(self) -> dict[str, tuple[Any, Any]]:
        """The pins' places as polynomials in the variables, of links that are in loops."""
        n = self.system.n
        places = self.pin_places(Polynomial.variables(n))
        pins = {p for link in self.in_loops for p in link.pins}
        zero = Polynomial(n, {})
        return {p: (zero + x, zero + y) for p, (x, y) in places.items() if p in pins}

    @property
    def alternatives(self) -> tuple[Alternative, ...]:
        """In turns of the links, in which components are found, and in places of the pins."""
        turns = linkage_model(self.linkage)
        each = {"turns (c, s)": turns, "pins (x, y)": pin_model(turns)}
        return tuple(Alternative.of_parts(name, made) for name, made in each.items())

    @property
    def sides(self) -> tuple[Side, ...]:
        """Pairs of pins of a link in loops; those of two links that share both once."""
        found: dict[frozenset[str], Side] = {}
        for link in self.in_loops:
            for j, second in enumerate(link.pins):
                for i, first in enumerate(link.pins[:j]):
                    gaps = (p - q for p, q in zip(link.shape[i], link.shape[j], strict=True))
                    squared = sum((x * x for x in gaps), square_root(0))
                    side = Side((first, second), squared, f"link {link.name}")
                    found.setdefault(frozenset(side.ends), side)
        return tuple(found.values())

    @property
    def reason(self) -> str:
        """One sentence: what was made of the linkage."""
        loops = count_text(self.loops, "loop")
        text = (
            f"planar linkage of {len(self.linkage.links)} links and {loops}, "
            "given by its links' shapes; one pair (c, s) for each moving link: plates are rational "
            "in these"
        )
        if self.free:
            text += f"; cut off, turning freely: links {', '.join(self.free)}"
        return text


def _as_it_is(x: Number) -> Any:
    return x


def linkage_model(linkage: Linkage) -> LinkageModel:
    """The equations of a linkage.

    Raises:
        LinkageError: if it has no loop.
    """
    kept, free = _in_loops(linkage)
    loops = _loops(kept)
    if not loops:
        links = linkage.links
        alone = [f"{p} of {k.name}" for k in links for p in k.pins if not _is_joined(p, k, links)]
        text = "the links form no loop: each turns freely, there is nothing to solve"
        raise LinkageError(f"{text}; of one link alone are the pins {', '.join(alone)}")
    moving = [link for link in kept if link.name != linkage.ground]
    if len(moving) == len(kept):
        # The ground hangs on a part that turns freely: hold another link instead.
        moving = moving[1:]
    held = next(link for link in kept if link not in moving)
    n = 2 * len(moving)
    variables = Polynomial.variables(n)
    turns: dict[str, tuple[Any, Any]] = {
        link.name: (Polynomial.constant(n, 1), Polynomial.constant(n, 0)) for link in kept
    }
    turns |= {link.name: (variables[2 * i], variables[2 * i + 1]) for i, link in enumerate(moving)}
    equations = [c * c + s * s - 1 for c, s in (turns[link.name] for link in moving)]
    for loop in loops:
        total = [Polynomial(n, {}), Polynomial(n, {})]
        for link, start, end in loop:
            (c, s), places = turns[link.name], dict(zip(link.pins, link.shape, strict=True))
            x, y = (q - p for p, q in zip(places[start], places[end], strict=True))
            total = [total[0] + c * x - s * y, total[1] + s * x + c * y]
        equations += total
    names = tuple(f"{t}_{link.name}" for link in moving for t in "cs")
    system = PolynomialSystem(names, tuple(equations))
    return LinkageModel(linkage, len(loops), free, system, (held, *moving))


def _in_loops(linkage: Linkage) -> tuple[list[Link], tuple[str, ...]]:
    """The links that are joined at two pins at least, and the others."""
    kept = list(linkage.links)
    while True:
        shared = [sum(_is_joined(p, link, kept) for p in link.pins) for link in kept]
        rest = [link for link, count in zip(kept, shared, strict=True) if count >= 2]
        if len(rest) == len(kept):
            names = {link.name for link in kept}
            return kept, tuple(x.name for x in linkage.links if x.name not in names)
        kept = rest


def _is_joined(pin: str, link: Link, links: Sequence[Link]) -> bool:
    return any(pin in other.pins for other in links if other is not link)


def _loops(links: Sequence[Link]) -> list[list[tuple[Link, str, str]]]:
    """A minimum cycle basis of the graph of links and pins; each link from one pin to another."""
    by_name = {link.name: link for link in links}
    loops = []
    edges = ((("link", link.name), ("pin", pin)) for link in links for pin in link.pins)
    for ring in minimum_cycles(edges):
        loop = []
        for i, (kind, name) in enumerate(ring):
            if kind == "link":
                before, after = ring[i - 1][1], ring[(i + 1) % len(ring)][1]
                loop.append((by_name[name], before, after))
        loops.append(loop)
    return sorted(loops, key=lambda loop: [(link.name, a, b) for link, a, b in loop])


@dataclass(frozen=True)
class PinModel(LinkageModel):
    """The same as the places of the pins.

    Attributes:
        system: a distance for each moving link, and two equations for each further pin.
        pins: those that are not on the held link, in the order of the variables.
    """

    pins: tuple[str, ...]

    @property
    def reason(self) -> str:
        """One sentence: what was made of the linkage."""
        return f"planar linkage of {len(self.linkage.links)} links by the places of its pins"

    def place_polynomials(self) -> dict[str, tuple[Any, Any]]:
        """The places of the pins that are in loops, which are the variables."""
        n, held = self.system.n, self.in_loops[0]
        variables = Polynomial.variables(n)
        places: dict[str, tuple[Any, Any]] = {
            pin: (Polynomial.constant(n, x), Polynomial.constant(n, y))
            for pin, (x, y) in zip(held.pins, held.shape, strict=True)
        }
        return places | {p: tuple(variables[2 * i :][:2]) for i, p in enumerate(self.pins)}

    def pin_places(self, point: Sequence[Any]) -> dict[str, tuple[Any, Any]]:
        """The places of all pins where those that move in loops are here.

        Links that close nothing are not turned.
        """
        held, *moving = self.in_loops
        here = dict(zip(held.pins, held.shape, strict=True))
        here |= {pin: (point[2 * i], point[2 * i + 1]) for i, pin in enumerate(self.pins)}
        turns: list[Any] = []
        for link in moving:
            (x, y), (a, b) = (
                (q[0] - p[0], q[1] - p[1])
                for p, q in ((here[pin] for pin in link.pins[:2]), link.shape[:2])
            )
            squared = a * a + b * b
            turns += [(x * a + y * b) / squared, (y * a - x * b) / squared]
        return super().pin_places(turns)

    def places_at(self, point: Sequence[Number]) -> tuple[Number, ...]:
        """The places of the pins where the moving links have these cosines and sines."""
        places = super().pin_places(point)
        return tuple(x for pin in self.pins for x in places[pin])


def pin_model(turns: LinkageModel) -> PinModel:
    """The equations of a linkage's pins, of the links that are in loops."""
    held, *moving = turns.in_loops
    pins = tuple(dict.fromkeys(p for k in moving for p in k.pins if p not in held.pins))
    n = 2 * len(pins)
    x = Polynomial.variables(n)
    places: dict[str, tuple[Polynomial, Polynomial]] = {
        pin: (Polynomial.constant(n, a), Polynomial.constant(n, b))
        for pin, (a, b) in zip(held.pins, held.shape, strict=True)
    }
    places |= {pin: (x[2 * i], x[2 * i + 1]) for i, pin in enumerate(pins)}
    equations = [f for link in moving for f in _rigid(link, places)]
    names = tuple(f"{letter}_{pin}" for pin in pins for letter in "xy")
    system = PolynomialSystem(names, tuple(equations))
    return PinModel(turns.linkage, turns.loops, turns.free, system, turns.in_loops, pins)


def _rigid(link: Link, places: dict[str, tuple[Polynomial, Polynomial]]) -> list[Polynomial]:
    """That the pins of a link have its shape, and not the mirror image."""
    first, second, *others = link.pins
    (a, b), origin = (
        tuple(v - u for u, v in zip(link.shape[0], link.shape[1], strict=True)),
        link.shape[0],
    )
    squared = a * a + b * b
    u, v = (q - p for p, q in zip(places[first], places[second], strict=True))
    equations = [u * u + v * v - squared]
    for pin, place in zip(others, link.shape[2:], strict=True):
        x, y = (q - p for p, q in zip(origin, place, strict=True))
        along, across = (x * a + y * b) / squared, (y * a - x * b) / squared
        here = [q - p for p, q in zip(places[first], places[pin], strict=True)]
        equations += [here[0] - u * along + v * across, here[1] - v * along - u * across]
    return equations
