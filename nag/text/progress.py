"""How far work is, as text: the stage, its steps, how it goes, a bar.

It is shown by processes that load little, so that nothing is imported here.
"""

from __future__ import annotations

# Parts a stage's name from what else is told of how it goes, which makes no other stage of it.
REMARK = "; "
# Places of a bar.
BAR = 20


def stage_name(stage: str) -> str:
    """The name of a stage, without what is told of how it goes.

    >>> stage_name("tracking 8 paths; 2 doubtful")
    'tracking 8 paths'
    """
    return stage.partition(REMARK)[0]


def stage_text(stage: str, done: int, total: int) -> str:
    """A stage, its steps, and how it goes; a ``total`` of 0 is not known.

    >>> stage_text("tracking 8 paths; 2 doubtful", 4, 8)
    'tracking 8 paths: 4 of 8, 2 doubtful'
    """
    name, _, remark = stage.partition(REMARK)
    if total:
        name = f"{name}: {done} of {total}"
    elif done:
        name = f"{name}: {done}"
    return f"{name}, {remark}" if remark else name


def draw_bar(done: int, total: int) -> str:
    """A bar of the part that is done; empty where that is not known.

    >>> draw_bar(3, 8)
    '[#######-------------] 37 %'
    >>> draw_bar(8191, 8192)[-4:]
    '99 %'
    """
    if not total:
        return ""
    # Rounded down: the whole is said only of the whole.
    done = min(max(done, 0), total)
    full = done * BAR // total
    return f"[{'#' * full}{'-' * (BAR - full)}] {100 * done // total} %"
