"""Named settings of the tracker."""

from __future__ import annotations

from dataclasses import dataclass, replace

from nag.errors import NagError


@dataclass(frozen=True)
class Settings:
    """Knobs of step control, corrector and endgame.

    Attributes:
        tolerance: largest first Newton correction after a prediction, relative to the point; the
            tests that saw no path jump used at most 1e-4.
        newton: estimated relative error at which the corrector stops between the ends.
        newton_end: the same where a path arrives, at its safe point or at t = 0.
        contraction: largest ratio of the second to the first Newton correction after a prediction;
            it bounds the part that the first one takes of the distance to any other path.
        order: of the Taylor coefficients.
        floor: largest relative Newton correction that may be rounding errors alone, about the
            square root of a double's: among larger ones there may be another path as well.
        radius_factor: largest step as part of the radius of convergence that the Taylor
            coefficients indicate (beta_tau of Timme 2021).
        safety: part of ``tolerance`` that the step control aims at.
        max_steps: steps after which a path fails.
        radius: t at which a path's safe point is kept, from which its end is looked for where a
            straight run to t = 0 leaves it doubtful.
        digits: most decimal digits in which that is done, 16, 32, 64 or 120.
        evidence: digits beyond the least to which an end at infinity, or a singular one, must
            satisfy the exact equations (see `nag.tracking.ends.limits.digits_of_evidence`).
        retries: how often paths that prove to have jumped are tracked again, more tightly.
    """

    tolerance: float = 1e-3
    newton: float = 1e-7
    newton_end: float = 1e-12
    contraction: float = 0.1
    order: int = 6
    floor: float = 1e-8
    radius_factor: float = 0.5
    safety: float = 0.2
    max_steps: int = 4000
    radius: float = 0.1
    digits: int = 120
    evidence: int = 0
    retries: int = 3


# What is left of the tolerance for a path that jumped, and where its corrector stops at the latest.
TIGHTER, SHARPER = 1e-2, 1e-10

NAMED = {
    "fast": Settings(tolerance=1e-2, radius_factor=0.6),
    "default": Settings(),
    "careful": Settings(
        tolerance=1e-5, radius_factor=0.3, newton=1e-9, max_steps=20000, evidence=20
    ),
}


def find_settings(settings: Settings | str) -> Settings:
    """``settings`` itself, or the one of that name.

    Raises:
        ValueError: if there is no such name.
    """
    if isinstance(settings, Settings):
        return settings
    if settings not in NAMED:
        raise NagError(f"settings: no settings {settings!r}; there are {', '.join(NAMED)}")
    return NAMED[settings]


def tighten(settings: Settings) -> Settings:
    """Settings for a path that jumped: shorter steps."""
    return replace(
        settings,
        tolerance=settings.tolerance * TIGHTER,
        newton=min(settings.newton, SHARPER),
        contraction=settings.contraction * 0.5,
        radius_factor=settings.radius_factor * 0.6,
        max_steps=settings.max_steps * 2,
    )
