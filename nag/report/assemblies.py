"""What a decomposition says of a mechanism that was given by its parts."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from nag.report.model import Rows, rank_rows
from nag.witness.witness import Decomposition, WitnessSet

if TYPE_CHECKING:
    from nag.mechanism.assembly import AssemblyModel
    from nag.mechanism.framework import Framework

_WHAT = {"dh": "closing", "framework": "realisation", "linkage": "assembly"}


def parts_rows(assembly: AssemblyModel) -> Rows:
    """What was made of the parts, and what counting and ranks say of them."""
    from nag.mechanism.dh import DHModel
    from nag.mechanism.framework_model import FrameworkModel
    from nag.mechanism.linkage import LinkageModel

    rows = [("model", assembly.reason)]
    if isinstance(assembly, DHModel):
        rows += [("besides", text) for text in assembly.zero_links]
        rows += rank_rows(assembly.rank, assembly.system.n, False)
    if isinstance(assembly, FrameworkModel):
        rows += _framework_rows(assembly.framework)
    if isinstance(assembly, LinkageModel):
        rows.append(("counting", f"Gruebler-Kutzbach counts {assembly.linkage.gruebler_kutzbach}"))
    return rows


def _framework_rows(framework: Framework) -> Rows:
    generic, count = framework.generic_motions(), framework.freedoms
    text = "rigid" if generic == 0 else f"mobile with {_freedoms(generic)}"
    if generic > count:
        dependent = generic - count
        text += f", {dependent} bar{'' if dependent == 1 else 's'} more than are independent"
    rows = [("graph", f"counting gives {count}; for almost all lengths {text}")]
    here = framework.infinitesimal_motions()
    if here is not None:
        stresses = here - count
        rows.append(
            (
                "placement",
                (
                    "infinitesimally rigid"
                    if here == 0
                    else f"infinitesimally mobile with {_freedoms(here)}"
                )
                + f", self-stresses {stresses}",
            )
        )
    return rows


def assembly_rows(kind: str, assembly: AssemblyModel, decomposition: Decomposition) -> Rows:
    """How many assemblies there are, and whether they move."""
    what = _WHAT[kind]
    plural = {"assembly": "assemblies"}.get(what, f"{what}s")
    isolated = [c for c in decomposition.components if c.dimension == 0]
    moving = [c for c in decomposition.components if c.dimension > 0]
    parts = []
    if moving:
        largest = max(c.dimension for c in moving) + _free_links(assembly)
        count = sum(c.orbit for c in moving)
        on = f"{count} component{'' if count == 1 else 's'}"
        parts.append(f"mobile, mobility {largest} at most, on {on}{_reality(assembly, moving)}")
    if isolated:
        each = _points_of_each(assembly)
        count = sum(c.orbit * len(c.points) for c in isolated) // each
        real = sum(c.orbit * sum(assembly.is_real(x) for x in c.points) for c in isolated) // each
        motions = " up to motions" if kind == "framework" else ""
        parts.append(
            f"{count} {what if count == 1 else plural}{motions}, {real} of them real"
            + (", that cannot move" if moving else "; rigid in each of them")
            + (", but for the links that turn freely" if _free_links(assembly) else "")
        )
    if not parts:
        parts = [f"no {what}, not even a complex one: the parts do not fit"]
    return [(plural, "; ".join(parts))]


def _free_links(assembly: AssemblyModel) -> int:
    from nag.mechanism.linkage import LinkageModel

    return len(assembly.free) if isinstance(assembly, LinkageModel) else 0


def _reality(assembly: AssemblyModel, moving: Iterable[WitnessSet]) -> str:
    from nag.mechanism.real_assemblies import real_text

    if assembly.reference is not None:
        return ""
    return f"; {real_text(assembly, {c.corank for c in moving})}"


def real_row(kind: str, assembly: AssemblyModel, points: Iterable[Sequence[complex]]) -> Rows:
    """How many solutions are real assemblies; isotropic coordinates of these are not real."""
    real = [assembly.is_real(x) for x in points]
    each = _points_of_each(assembly)
    plural = {"assembly": "assemblies"}.get(_WHAT[kind], f"{_WHAT[kind]}s")
    return [(plural, f"{len(real) // each}, {sum(real) // each} of them real")]


def _points_of_each(assembly: AssemblyModel) -> int:
    """How many points of the system each assembly is: Euler parameters have signs."""
    from nag.mechanism.dh_euler import DHEulerModel

    return 2 ** len(assembly.symmetries) if isinstance(assembly, DHEulerModel) else 1


def _freedoms(count: int) -> str:
    return f"{count} freedom" if count == 1 else f"{count} freedoms"
