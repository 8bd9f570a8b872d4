"""What witness sets and decompositions show at the prompt, in notebooks and in the commands."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from nag.algebra.system import system_line
from nag.text.table import (
    align,
    count_text,
    html_table,
    lines_of,
    magnitude,
    number_text,
    point_text,
    printable,
)
from nag.witness.frame import count_expanded
from nag.witness.witness import Decomposition, PathCounts, Status, WitnessSet

if TYPE_CHECKING:
    from nag.witness.projection import Projection
    from nag.witness.real_points import RealPoints
    from nag.witness.sampling import Samples

# Wider multidegrees are left to the JSON export.
WIDEST_MULTIDEGREE = 32

# Of longer lists of points a notebook shows the first; a command fewer, and of wider ones the first
# coordinates.
MOST_POINTS = 40
MOST_SAMPLES, MOST_COLUMNS = 20, 4


@dataclass(frozen=True)
class ComponentKind:
    """Components that are alike in what can be known of them beforehand."""

    dimension: int
    degree: int
    multiplicity: int | None
    multidegree: tuple[int, ...] | None = None

    def text(self, count: int) -> str:
        """``count`` of them in words: "9 components of dimension 2, degree 4"."""
        plural = "" if count == 1 else "s"
        text = f"{count} component{plural} of dimension {self.dimension}, degree {self.degree}"
        if not self.multiplicity:
            return f"{text}, multiplicity not known"
        return text if self.multiplicity == 1 else f"{text}, multiplicity {self.multiplicity}"


def flat(multidegree: object) -> tuple[int, ...] | None:
    """A multidegree's entries in a row."""
    return None if multidegree is None else tuple(np.ravel(np.array(multidegree)).tolist())


def kind(component: WitnessSet) -> ComponentKind:
    """What can be compared of ``component``."""
    return ComponentKind(
        component.dimension,
        component.degree,
        component.multiplicity,
        flat(component.multidegree),
    )


def kinds(components: Iterable[WitnessSet]) -> Counter[ComponentKind]:
    """How many components there are of each kind; each stands for its whole orbit."""
    counts: Counter[ComponentKind] = Counter()
    for component in components:
        counts[kind(component)] += component.orbit
    return counts


def kinds_text(counts: Counter[ComponentKind]) -> str:
    """Counts in words, multidegrees left out, by falling dimension."""
    plain: Counter[ComponentKind] = Counter()
    for each, count in counts.items():
        plain[ComponentKind(each.dimension, each.degree, each.multiplicity)] += count
    order = sorted(plain, key=lambda k: (-k.dimension, k.degree, k.multiplicity or 0))
    return "; ".join(each.text(plain[each]) for each in order) or "no component"


def degree_text(coordinates: str) -> str:
    """To what a degree belongs, which differs between formulations for the same motion.

    Args:
        coordinates: in which formulation or coordinates the equations are, in words.
    """
    return f"belongs to the coordinates, here {coordinates}; in others it may be another"


def multidegree_text(multidegree: np.ndarray | None) -> str:
    """A multidegree in the groups' order: ``(1, 2)`` for a curve, entries ``12: 1`` above.

    Above dimension 1 only entries with ascending groups are given, the others are equal to them.
    """
    if multidegree is None or multidegree.ndim == 0:
        return "-"
    if multidegree.ndim == 1:
        text = "(" + ", ".join(map(str, multidegree.tolist())) + ")"
    else:
        text = ", ".join(
            f"{'.'.join(str(i + 1) for i in index)}: {multidegree[tuple(index)]}"
            for index in np.argwhere(multidegree).tolist()
            if index == sorted(index)
        )
    return text if len(text) <= WIDEST_MULTIDEGREE else "see the export"


def title_line(decomposition: Decomposition) -> str:
    """Like components counted together: "9 components of dimension 2, degree 4"."""
    text = kinds_text(kinds(decomposition.components))
    undecided = sum(c.orbit for c in decomposition.components if c.status is not Status.IRREDUCIBLE)
    return f"{text} ({undecided} undecided)" if undecided else text


def _like(component: WitnessSet) -> tuple[object, ...]:
    return (
        component.dimension,
        component.degree,
        multidegree_text(component.multidegree),
        component.multiplicity,
        str(component.status),
    )


def component_rows(decomposition: Decomposition) -> list[list[str]]:
    """Headings, and one row for components that are alike, with the worst residual among them.

    Each row begins with the numbers by which commands take its components, those of an orbit apart.
    """
    alike: dict[tuple[object, ...], list[WitnessSet]] = {}
    numbers: dict[tuple[object, ...], list[int]] = {}
    following = 1
    for component in decomposition.components:
        key = _like(component)
        alike.setdefault(key, []).append(component)
        after = following + count_expanded(component)
        numbers.setdefault(key, []).extend(range(following, after))
        following = after
    rows = [{"number": ranges_text(numbers[key])} | _row(group) for key, group in alike.items()]
    if not decomposition.system.groups:
        rows = [{k: v for k, v in row.items() if k != "multidegree"} for row in rows]
    return [list(rows[0]), *(list(row.values()) for row in rows)] if rows else []


def component_table(decomposition: Decomposition) -> list[str]:
    """The same as aligned lines."""
    rows = component_rows(decomposition)
    return align(rows, [0, rows[0].index("status")]) if rows else []


def ranges_text(numbers: Sequence[int]) -> str:
    """Numbers in order, neighbours as from the first to the last."""
    parts: list[list[int]] = []
    for number in numbers:
        if parts and number == parts[-1][-1] + 1:
            parts[-1] = [parts[-1][0], number]
        else:
            parts.append([number])
    return ", ".join("-".join(map(str, part)) for part in parts)


def _row(group: Sequence[WitnessSet]) -> dict[str, str]:
    first = group[0]
    return {
        "dimension": str(first.dimension),
        "degree": str(first.degree),
        "multidegree": multidegree_text(first.multidegree),
        "multiplicity": str(first.multiplicity or "?"),
        "count": str(sum(c.orbit for c in group)),
        "status": str(first.status),
        "residual": magnitude(float(np.max([c.residual for c in group]))),
        "accuracy": magnitude(float(np.max([c.accuracy for c in group]))),
        "digits": str(min(c.precision for c in group)),
    }


def remarks(decomposition: Decomposition) -> list[str]:
    """Why an answer is incomplete, one line a reason."""
    lines = [
        f"undecided: dimension {c.dimension}, degree {c.degree}: {c.note or 'no reason given'}"
        for c in decomposition.components
        if c.status is not Status.IRREDUCIBLE
    ]
    return [printable(line) for line in dict.fromkeys([*lines, *decomposition.notes])]


def paths_text(paths: PathCounts) -> str:
    """What became of paths."""
    return f"{paths.tracked} tracked, {paths.at_infinity} to infinity, {paths.failed} failed"


def _rests_on(components: Sequence[WitnessSet]) -> str:
    if not components:
        return "no witness points"
    residual, accuracy = (
        magnitude(float(np.max([getattr(c, name) for c in components])))
        for name in ("residual", "accuracy")
    )
    digits = min(c.precision for c in components)
    return f"residual {residual}, accuracy {accuracy} by {digits} digits"


def decomposition_text(decomposition: Decomposition) -> str:
    """A decomposition in five lines."""
    open_ = remarks(decomposition)
    more = f" (and {len(open_) - 1} more)" if len(open_) > 1 else ""
    status = "complete" if decomposition.complete else f"INCOMPLETE: {'; '.join(open_[:1])}{more}"
    run = f"seed {decomposition.seed}, settings {decomposition.settings}"
    return lines_of(
        f"Decomposition of {system_line(decomposition.system)}",
        [
            ("answer", title_line(decomposition)),
            ("status", status),
            ("rests on", _rests_on(decomposition.components)),
            ("run", f"{run}; paths: {paths_text(decomposition.paths)}"),
        ],
    )


def decomposition_html(decomposition: Decomposition) -> str:
    """A decomposition as a table, like components in one row."""
    status = "complete" if decomposition.complete else "INCOMPLETE"
    note = "; ".join([status, *remarks(decomposition)])
    title = f"{title_line(decomposition)}; {system_line(decomposition.system)}"
    return html_table(title, component_rows(decomposition), note)


def _kind_text(component: WitnessSet) -> str:
    return kind(component).text(1).removeprefix("1 component of ")


def witness_set_text(component: WitnessSet) -> str:
    """A component in five lines."""
    cut = f"a slice of {count_text(component.dimension, 'linear equation')}"
    orbit = f"; one of an orbit of {component.orbit}" if component.orbit > 1 else ""
    doubt = f": {component.note}" if component.note else ""
    known = "not kept" if component.system is None else system_line(component.system)
    return lines_of(
        f"WitnessSet of {_kind_text(component)}",
        [
            ("status", f"{component.status}{doubt}{orbit}"),
            ("points", f"{count_text(component.degree, 'point')} on {cut}"),
            ("rests on", _rests_on([component])),
            ("system", known),
        ],
    )


def witness_set_html(component: WitnessSet) -> str:
    """A component's witness points as a table."""
    n = component.points.shape[1]
    system = component.system
    names = [f"x{i}" for i in range(n)] if system is None else system.variables
    rows = [["point", *names, "error"]]
    errors = np.linalg.norm(component.radii, axis=1)
    for i, point in enumerate(component.points[:MOST_POINTS]):
        cells = map(number_text, point, component.radii[i])
        rows.append([str(i + 1), *cells, magnitude(float(errors[i]))])
    hidden = component.degree - MOST_POINTS
    note = f"{component.status}; {_rests_on([component])}"
    more = f"; {count_text(hidden, 'more point')}" if hidden > 0 else ""
    return html_table(f"Component of {_kind_text(component)}", rows, note + more)


def _point_table(
    caption: str,
    points: np.ndarray,
    more: dict[str, list[str]],
    note: str,
    accuracy: float = 0.0,
) -> str:
    """Points of a relative accuracy as a table, with more columns."""
    rows = [["point", *(f"x{i}" for i in range(points.shape[1])), *more]]
    for i, point in enumerate(points[:MOST_POINTS]):
        error = _error_of(point, accuracy)
        cells = [number_text(z, error) for z in point]
        rows.append([str(i + 1), *cells, *(column[i] for column in more.values())])
    hidden = len(points) - MOST_POINTS
    note += f"; {count_text(hidden, 'more point')}" if hidden > 0 else ""
    return html_table(caption, rows, note)


def _error_of(point: np.ndarray, accuracy: float) -> float:
    """How far a point of a relative accuracy may be off."""
    with np.errstate(over="ignore"):
        return accuracy * (1 + float(np.linalg.norm(point)))


def _first_point(points: np.ndarray, accuracy: float = 0.0) -> str:
    if not len(points):
        return "none"
    more = f" and {len(points) - 1} more" if len(points) > 1 else ""
    return f"{point_text(points[0], _error_of(points[0], accuracy))}{more}"


def _samples_title(samples: Samples) -> str:
    count, n = samples.to_numpy().shape
    return f"Samples: {count_text(count, 'point')} in {count_text(n, 'coordinate')}"


def _samples_rest(samples: Samples) -> str:
    return f"residual {magnitude(samples.residual)}, accuracy {magnitude(samples.accuracy)}"


def samples_text(samples: Samples) -> str:
    """Points of a component in three lines."""
    first = _first_point(samples.to_numpy(), samples.accuracy)
    rows = [("points", first)]
    if samples.real_dimensions:
        rows.append(("real", real_dimension_text(samples.real_dimensions)))
    rows.append(("rests on", _samples_rest(samples)))
    rows += [("open", samples.doubt)] if samples.doubt else []
    return lines_of(_samples_title(samples), rows)


def real_dimension_text(dimensions: Sequence[int]) -> str:
    """Dimensions of the real part round points, in words; -1 where one is not known."""
    counts = sorted(Counter(dimensions).items(), reverse=True)
    texts = [f"real dimension {d}" if d >= 0 else "real dimension not known" for d, _ in counts]
    if len(texts) < 2:
        return "".join(texts)
    own = zip(texts, counts, strict=True)
    return ", ".join(f"{text} at {count_text(count, 'point')}" for text, (_, count) in own)


def sample_rows(samples: Samples, variables: Sequence[str]) -> list[list[str]]:
    """Headings, and a row for each of the first points, in the first of their leading coordinates.

    Args:
        variables: names of the leading coordinates; the imaginary unit may be left out.
    """
    dots = ["..."] if len(variables) > MOST_COLUMNS else []
    real = ["real dimension"] if samples.real_dimensions else []
    rows = [["point", *variables[:MOST_COLUMNS], *dots, *real]]
    for i, point in enumerate(samples.points[:MOST_SAMPLES]):
        error = _error_of(point, samples.accuracy)
        cells = [number_text(z, error) for z in point[: min(len(variables), MOST_COLUMNS)]]
        known = [str(d) if d >= 0 else "not known" for d in samples.real_dimensions[i : i + 1]]
        rows.append([str(i + 1), *cells, *dots, *known])
    return rows


def samples_html(samples: Samples) -> str:
    """Points of a component as a table."""
    note = _samples_rest(samples) + (f"; open: {samples.doubt}" if samples.doubt else "")
    known = [str(d) if d >= 0 else "not known" for d in samples.real_dimensions]
    more = {"real dimension": known} if known else {}
    return _point_table(_samples_title(samples), samples.to_numpy(), more, note, samples.accuracy)


def _real_points_title(found: RealPoints) -> str:
    nearest = f", the nearest at distance {found.distances[0]:.6g}" if len(found) else ""
    return f"RealPoints: {count_text(len(found), 'point')}{nearest}"


def _left_open(found: RealPoints) -> str:
    zeros = f"{count_text(found.undecided, 'more real zero')} may lie on the component"
    return "; ".join([*([zeros] if found.undecided else []), *filter(None, [found.reason])])


def real_points_text(found: RealPoints) -> str:
    """Real points in at most five lines."""
    rows = [("points", _first_point(found.points))]
    if len(found):
        stationary = int(found.stationary.sum())
        rows.append(("distances", f"{_list_numbers(found.distances)}; {stationary} stationary"))
    rows.append(("rests on", f"residual {magnitude(found.residual)}"))
    open_ = _left_open(found)
    return lines_of(_real_points_title(found), [*rows, *([("open", open_)] if open_ else [])])


def _list_numbers(numbers: np.ndarray) -> str:
    most = 6
    shown = [f"{x:.6g}" for x in numbers[:most]]
    return ", ".join([*shown, *(["..."] if len(numbers) > most else [])])


def real_points_html(found: RealPoints) -> str:
    """Real points as a table, the nearest first."""
    more = {
        "distance": [f"{x:.6g}" for x in found.distances],
        "stationary": ["yes" if x else "no" for x in found.stationary],
    }
    open_ = _left_open(found)
    note = f"residual {magnitude(found.residual)}{'; ' if open_ else ''}{open_}"
    return _point_table(_real_points_title(found), found.points, more, note)


def _projection_title(image: Projection) -> str:
    coordinates = ", ".join(map(str, image.coordinates))
    noun = "coordinate" if len(image.coordinates) == 1 else "coordinates"
    return f"Projection to {noun} {coordinates}"


def projection_text(image: Projection) -> str:
    """A projection in five lines."""
    equations = count_text(image.slice.dimension, "linear equation")
    return lines_of(
        _projection_title(image),
        [
            ("image", f"dimension {image.dimension}, degree {image.degree}"),
            ("fibre", f"dimension {image.fibre_dimension}, degree {image.fibre_degree}"),
            ("points", f"{count_text(len(image.points), 'point')} on a slice of {equations}"),
            ("rests on", f"accuracy {magnitude(image.accuracy)}"),
        ],
    )


def projection_html(image: Projection) -> str:
    """The points of a projection's slice as a table."""
    note = (
        f"image of dimension {image.dimension}, degree {image.degree}; fibre of dimension "
        f"{image.fibre_dimension}, degree {image.fibre_degree}; accuracy "
        f"{magnitude(image.accuracy)}"
    )
    return _point_table(_projection_title(image), image.points, {}, note, image.accuracy)
