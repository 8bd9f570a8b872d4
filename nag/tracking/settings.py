"""Named settings of the tracker."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Settings:
    """Knobs of step control, corrector and endgame.

    Attributes:
        tolerance: largest first Newton correction after a prediction, relative to the point; the
            tests that saw no path jump used at most 1e-4.
        newton: estimated relative error at which the corrector stops between the ends.
        newton_end: the same where a path arrives, at t = 0 or at a sample of the endgame.
        contraction: largest ratio of the second to the first Newton correction after a prediction;
            it bounds the part that the first one takes of the distance to any other path.
        order: of the Taylor coefficients.
        floor: relative Newton correction that is still accepted where rounding lets nothing
            smaller be reached.
        radius_factor: largest step as part of the radius of convergence that the Taylor
            coefficients indicate (beta_tau of Timme 2021).
        safety: part of ``tolerance`` that the step control aims at.
        max_steps: steps after which a path fails.
        endgame_radius: radius at which the endgame starts, in ``(t / (1 - t)) ** end_exponent``.
        max_winding: largest winding number.
        samples: samples a loop of the Cauchy endgame.
        levels: largest number of radii of the endgame, each a tenth of the one before.
        shortcut: whether paths may run straight to t = 0 where their Taylor series converges.
        retries: how often failed paths are tracked again with ever tighter control.
        double_double_paths: if no more paths than these fail in doubles, they are tracked in
            double-double arithmetic, each of them hundreds of times as long.
        tightened: how often these settings were tightened.
        high_precision_paths: how many of the paths that fail at last are tracked with mpmath; each
            may take seconds to minutes.
        digits: decimal digits of that.
    """

    tolerance: float = 1e-3
    newton: float = 1e-7
    newton_end: float = 1e-12
    contraction: float = 0.1
    order: int = 6
    floor: float = 1e-6
    radius_factor: float = 0.5
    safety: float = 0.2
    max_steps: int = 4000
    endgame_radius: float = 0.1
    max_winding: int = 20
    samples: int = 8
    levels: int = 12
    shortcut: bool = True
    retries: int = 3
    double_double_paths: int = 100
    tightened: int = 0
    high_precision_paths: int = 0
    digits: int = 34


NAMED = {
    "fast": Settings(tolerance=1e-2, radius_factor=0.6),
    "default": Settings(),
    "careful": Settings(
        tolerance=1e-5, radius_factor=0.3, newton=1e-9, max_steps=20000, high_precision_paths=4
    ),
}


def named(settings: Settings | str) -> Settings:
    """``settings`` itself, or the one of that name.

    Raises:
        ValueError: if there is no such name.
    """
    if isinstance(settings, Settings):
        return settings
    if settings not in NAMED:
        raise ValueError(f"no settings {settings!r}; there are {', '.join(NAMED)}")
    return NAMED[settings]


def tighter(settings: Settings) -> Settings:
    """The next tighter settings, for a path that failed or jumped.

    First only the shortcut is given up, as the endgame decides what a straight run cannot, and the
    corrector goes on until small coordinates are accurate as well; then the steps become shorter;
    the endgame begins further in from the third time on, which helps where branch points are near,
    and harms where the Jacobian decays fast.
    """
    from dataclasses import replace

    if settings.shortcut:
        return replace(settings, shortcut=False, newton=min(settings.newton, 1e-10))
    first = settings.tightened == 0
    return replace(
        settings,
        tightened=settings.tightened + 1,
        tolerance=settings.tolerance * 1e-2,
        newton=min(settings.newton, 1e-10),
        contraction=settings.contraction * 0.5,
        radius_factor=settings.radius_factor * 0.6,
        max_steps=settings.max_steps * 2,
        endgame_radius=settings.endgame_radius * (1.0 if first else 0.3),
    )
