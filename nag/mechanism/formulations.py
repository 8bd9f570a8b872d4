"""The formulations of a mechanism, and how many paths each may ask for."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, TypeAlias

from nag.mechanism import FORMULATIONS, PLATFORM_ALONE
from nag.mechanism.assembly_modes import REFERENCE, Modes
from nag.mechanism.axes import Space
from nag.mechanism.euler import EulerModel, estimated_euler_paths, euler_model
from nag.mechanism.graph import Joint
from nag.mechanism.half_angles import ChoiceStopped, HalfAngleModel, LoopClosures, half_angle_model
from nag.mechanism.legs import is_parallel_robot
from nag.mechanism.loops import LoopStructure
from nag.mechanism.path_estimates import MOST_TRACKED, Alternative
from nag.mechanism.planar import PlanarModel, planar_model
from nag.mechanism.rods import RodModel, rod_model
from nag.text.table import count_text, join_words

if TYPE_CHECKING:
    from nag.mechanism.pose_model import PoseModel

Form: TypeAlias = "EulerModel | HalfAngleModel | PlanarModel | PoseModel | RodModel"


def alternative(
    structure: LoopStructure, space: Space, formulation: str, modes: Modes = REFERENCE
) -> Alternative:
    """One formulation of a mechanism."""
    try:
        if formulation == PLATFORM_ALONE:
            from nag.mechanism.pose_model import pose_model

            return Alternative(formulation, pose_model(structure, modes))
        if formulation == "H":
            return Alternative("H", half_angle_model(structure, modes))
        if formulation == "S":
            return Alternative("S", rod_model(structure, modes))
        if space == "planar":
            return Alternative("E", planar_model(structure))
        return Alternative("E", euler_model(structure, space == "spherical", modes))
    except ValueError as error:
        return Alternative(formulation, None, str(error))


def alternatives(
    structure: LoopStructure, space: Space, modes: Modes = REFERENCE
) -> tuple[Alternative, ...]:
    """All formulations, those that cover the mechanism first, by rising number of paths."""
    found = [alternative(structure, space, name, modes) for name in FORMULATIONS]
    return tuple(sorted(found, key=lambda a: (a.form is None, a.paths if a.form else 0)))


def smallest_alternative(
    structure: LoopStructure, space: Space, modes: Modes = REFERENCE
) -> Alternative:
    """The formulation with the fewest estimated paths.

    Its equations are made, and those of no other: half-angles and Euler parameters are estimated
    from the graph. Where rods are few, distances are the smallest. In the plane several loops may
    take fewer paths at once, which only equations show; those of Euler parameters are short there.
    Of a parallel robot that has more paths than are tracked what is asked at a point is left, which
    the short equations of Euler parameters answer soonest. (Loops of others may be tracked apart
    from each other, so that there are fewer.)
    """
    rods = alternative(structure, space, "S", modes)
    if rods.form is not None and rods.paths <= 4 ** (len(structure.loops) + 1):
        return rods
    euler = alternative(structure, space, "E", modes) if space == "planar" else None
    paths = estimated_euler_paths(structure, space == "spherical") if euler is None else euler.paths
    closures, stopped = None, ""
    try:
        closures = LoopClosures.of(structure, modes)
        stopped = closures.stopped
    except ChoiceStopped as error:
        stopped = error.stopped
    except ValueError:
        pass
    most = paths if closures is None else closures.estimated_paths(space)
    if rods.form is not None and rods.paths <= min(most, paths):
        return replace(rods, stopped=stopped)
    reached = most <= MOST_TRACKED or not is_parallel_robot(structure.mechanism)
    if closures is not None and most <= paths and reached:
        return Alternative("H", closures.model, stopped=stopped)
    chosen = euler or alternative(structure, space, "E", modes)
    return replace(chosen, stopped=stopped, fewer=most if most < paths else 0)


def description(alternative: Alternative, space: Space) -> str:
    """The formulation's coordinates in words."""
    if alternative.formulation == "E":
        return "one pair (c, s) for each body" if space == "planar" else "Euler parameters"
    form = alternative.form
    if alternative.formulation == PLATFORM_ALONE:
        place = ", ".join(f"{float(c):.6g}" for c in form.platform.origin)
        kept = [e.factor.joint for leg in form.platform.legs for e in leg.kept if e.factor]
        but = f" but for {join_words(list(dict.fromkeys(kept)))}" if kept else ""
        return (
            f"Study coordinates of {form.platform.robot.platform} about ({place}), its legs "
            f"eliminated{but}: components of its poses; the joints may have several above one, and "
            "others where it stands still"
        )
    if isinstance(form, RodModel):
        free = sum(f.kind == "free" for f in form.charts.plain)
        words = ["Study coordinates" if free else "joint coordinates"]
        if form.rods:
            words.append(
                f"{count_text(len(form.rods), 'rod')} between spherical joints as distances"
            )
        if form.zero_rods:
            count = len(form.zero_rods)
            each = "a spherical joint" if count == 1 else "spherical joints"
            words.append(f"{count_text(count, 'rod')} of length zero as {each}")
        return ", ".join(words)
    if not isinstance(form, HalfAngleModel):
        return "half-angles"
    lost = len({f.joint for c in form.closures for f in c.lost})
    each = ""
    if len(form.closures) > 1:
        each = " of each loop" if all(c.lost for c in form.closures) else " of some loops"
    count = lost // len(form.closures) if lost % len(form.closures) == 0 else 0
    word = {1: "one joint", 2: "two joints"}.get(count, "joints")
    kinds = {f.kind for f in form.charts.factors}
    names = "half-angles" if kinds <= {"turn"} else "joint coordinates"
    return f"{names} with {word}{each} eliminated"


def joints_text(joints: Sequence[Joint]) -> str:
    """ "2 revolute joints and 1 spherical joint"."""
    kinds = Counter(j.type for j in joints)
    return join_words([count_text(number, f"{kind} joint") for kind, number in kinds.items()])
