"""Whose a model's variables are, and how those that were eliminated follow from the others."""

from __future__ import annotations

from nag.mechanism.euler import EulerModel, slide_directions
from nag.mechanism.model import Model
from nag.mechanism.planar import PlanarModel


def body_rows(model: Model) -> list[tuple[str, str]]:
    """Which variables belong to which body and joint, eliminated ones included.

    Nothing for models in half-angles and others.
    """
    if not isinstance(model.form, EulerModel | PlanarModel):
        return []
    names, bodies = model.form.elimination.original_variables, model.structure.moving
    each, kind = (
        (2, "cosine and sine") if isinstance(model.form, PlanarModel) else (4, "Euler parameters")
    )
    parts = []
    for i, body in enumerate(bodies):
        own = names[each * i : each * i + each]
        parts.append(f"{', '.join(own) if each == 2 else f'{own[0]} to {own[-1]}'} of {body}")
    rows = [("bodies", f"{kind} {', '.join(parts)}")]
    slides = iter(names[each * len(bodies) :])
    along = [(next(slides), j.name) for j in model.structure.joints for _ in slide_directions(j)]
    if along:
        rows.append(("", "distances " + ", ".join(f"{x} of {joint}" for x, joint in along)))
    return rows


def eliminated_lines(model: Model) -> list[str]:
    """The variables that are polynomials in those of the system."""
    if not isinstance(model.form, EulerModel | PlanarModel):
        return []
    elimination = model.form.elimination
    variables = elimination.system.variables
    texts = [
        f"{name} = {image.text(variables)}"
        for i, (name, image) in enumerate(
            zip(elimination.original_variables, elimination.images, strict=True)
        )
        if i not in elimination.kept
    ]
    return ["eliminated", "  " + ", ".join(texts)] if texts else []
