"""Decomposition of all assembly modes of a mechanism, one of each class."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from nag.algebra.exact_ranks import rank
from nag.decomposition.decompose import decompose
from nag.decomposition.intersection import intersect_components
from nag.mechanism.coordinates import carry_to_euler
from nag.mechanism.euler import mode_conditions
from nag.mechanism.graph import Mechanism
from nag.mechanism.loops import LoopStructure
from nag.mechanism.mode_classes import ModeClass, mode_classes
from nag.mechanism.model import Model, ModelError, model, with_loops
from nag.mechanism.problem import problem_of
from nag.numerics.read_only import Several, equal_values
from nag.text.table import align, count_text, data_frame, known_or_nan, named_line
from nag.tracking.run import DEFAULT_RUN, Run, takes_run
from nag.witness.frame import expand_orbits
from nag.witness.witness import Decomposition

if TYPE_CHECKING:
    import pandas


@dataclass(frozen=True, eq=False)
class ClassAnswer:
    """The components of one combination of modes, which stand for those of its whole class."""

    modes: ModeClass
    model: Model
    decomposition: Decomposition

    __eq__ = equal_values


@dataclass(frozen=True, eq=False)
class ModesAnswer(Several[ClassAnswer]):
    """The components of all assembly modes.

    Attributes:
        structure: the mechanism's part with loops.
        classes: one answer for each class of modes, that of the reference configuration first.
        apart: whether components of different modes cannot meet: for every joint the equations of
            any two of its modes leave no relative orientation, by exact linear algebra.
        meetings: pairs of components of one mode, of different dimension, that meet, as (class,
            dimension, dimension).
    """

    structure: LoopStructure
    classes: tuple[ClassAnswer, ...]
    apart: bool
    meetings: tuple[tuple[int, int, int], ...]

    __eq__ = equal_values

    @property
    def entries(self) -> tuple[ClassAnswer, ...]:
        """The answers."""
        return self.classes

    def __repr__(self) -> str:
        members = sum(len(each.modes.members) for each in self.classes)
        modes = count_text(members, "combination")
        return named_line(self, f": {modes} of modes in {len(self.classes)} classes")

    def __str__(self) -> str:
        return "\n".join(align(self.rows(), (2, 3)))

    def to_dataframe(self) -> pandas.DataFrame:
        """A row for each component of one combination of each class, counted from 1.

        ``modes`` is how many combinations the class has.

        Raises:
            nag.NagError: if pandas is not installed.
        """
        classes = enumerate(self.classes, 1)
        found = [(k, a, c) for k, a in classes for c in a.decomposition]
        return data_frame(
            {
                "class": [k for k, _, _ in found],
                "modes": [len(answer.modes.members) for _, answer, _ in found],
                "dimension": [c.dimension for _, _, c in found],
                "degree": [c.degree for _, _, c in found],
                "multiplicity": known_or_nan([c.multiplicity for _, _, c in found]),
            }
        )

    @property
    def complete(self) -> bool:
        """Whether every class is."""
        return all(c.decomposition.complete for c in self.classes)

    def rows(self) -> list[list[str]]:
        """Headings, and one row for each class of modes."""
        from nag.mechanism.shown import mode_rows

        return mode_rows(self)

    def document(self, title: str | None = None, file: str = "") -> dict[str, Any]:
        """The answer as a JSON object: for each class the decomposition of one of its modes.

        Args:
            title, file: of the case, where that is known.
        """
        named = {"title": title, "file": file, "kind": "mechanism"}
        case = None if title is None else {key: str(text) for key, text in named.items()}
        return {
            "format": "nag-modes",
            "version": 1,
            "complete": self.complete,
            "modes_apart": self.apart,
            "meetings": [list(meeting) for meeting in self.meetings],
            "classes": [
                {
                    "modes": [dict(modes) for modes in each.modes.members],
                    "decomposition": each.decomposition.document(
                        case, each.model.formulation, each.model.reason
                    ),
                }
                for each in self.classes
            ],
        }


@takes_run
def decompose_modes(
    mechanism: Mechanism,
    formulation: str = "auto",
    coordinates: str = "euler",
    *,
    run: Run = DEFAULT_RUN,
) -> ModesAnswer:
    """Decompose every combination of the joints' assembly modes.

    Args:
        mechanism: in space; a planar mechanism is taken as one in space.
        formulation: of the models that are decomposed.
        coordinates: ``"euler"`` for components in Euler parameters, ``"joint"`` for those in the
            coordinates of the formulation.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Raises:
        ModelError: if the mechanism has too many combinations, or the formulation does not cover
            it.
    """
    structure = with_loops(mechanism)
    try:
        classes = mode_classes(structure)
    except ValueError as error:
        raise ModelError(str(error)) from None
    answers = []
    for k, each in enumerate(classes):
        run.tell("modes", k, len(classes))
        chosen = model(mechanism, formulation, each.representative, "spatial")
        answer = decompose(
            chosen.system,
            run=run,
            symmetries=chosen.symmetries,
        )
        if coordinates == "euler" and chosen.formulation != "E":
            problem, answer = carry_to_euler(problem_of(chosen), answer, threads=run.threads)
            chosen = problem.mechanism
        answers.append(ClassAnswer(each, chosen, answer))
    return ModesAnswer(
        structure,
        tuple(answers),
        modes_are_apart(structure),
        tuple(_meetings(answers, run)),
    )


def modes_are_apart(structure: LoopStructure) -> bool:
    """Whether no configuration belongs to two modes of a joint.

    The equations of both modes together, linear in the relative orientation r, have full rank 4 for
    every pair of modes, so that they leave r = 0, which is no rotation.
    """
    for joint in structure.joints:
        modes = range(joint.of_type.modes)
        conditions = [mode_conditions(joint, mode) for mode in modes]
        for i in modes:
            for j in range(i):
                if rank([*conditions[i], *conditions[j]]) < 4:
                    return False
    return True


def _meetings(answers: Sequence[ClassAnswer], run: Run) -> list[tuple[int, int, int]]:
    """Pairs of dimensions of components of one mode that meet, by computation."""
    found = set()
    for k, answer in enumerate(answers):
        system = answer.decomposition.system
        everything = expand_orbits(answer.decomposition).components
        for first in answer.decomposition.components:
            for second in everything:
                pair = (k, first.dimension, second.dimension)
                if first.dimension >= second.dimension or pair in found:
                    continue
                if intersect_components(system, first, second, run=run).components:
                    found.add(pair)
    return sorted(found)
