"""A call that is ended at a time limit: what was found by then comes back, and its process goes."""

from __future__ import annotations

import os
import time
from typing import Any

import pytest

import nag
from nag.tracking.run import DEFAULT_RUN, Run, answers_early, takes_run

EQUATIONS = ["(x^2 + y^2 - 1)*(x^2 + x*y + 3*y^2 - 2)"]


@answers_early
def tell_and_sleep(value: Any, *, run: Run = DEFAULT_RUN) -> Any:
    assert run.found is not None
    run.found((os.getpid(), value))
    time.sleep(600)
    return None


@takes_run
def tell_and_sleep_of_a_part(value: Any, *, run: Run = DEFAULT_RUN) -> Any:
    return tell_and_sleep(value, run=run)


@takes_run
def end_at_once(*, run: Run = DEFAULT_RUN) -> None:
    print("what is printed is no message")
    os._exit(7)


def is_running(process: int) -> bool:
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    return True


def test_a_limit_that_is_not_reached_changes_nothing() -> None:
    assert nag.decompose(EQUATIONS, time_limit=300) == nag.decompose(EQUATIONS)
    told: list[str] = []
    solved = nag.solve("x^2 - 2", time_limit=300, progress=lambda stage, *_: told.append(stage))
    assert solved == nag.solve("x^2 - 2") and told
    curve = nag.decompose("x^2 + y^2 - 1")[0]
    assert curve.sample(0, 1, time_limit=300) == pytest.approx(curve.sample(0, 1))


def test_what_was_found_comes_back_when_the_time_is_over() -> None:
    heard: list[Any] = []
    began = time.monotonic()
    process, value = tell_and_sleep("a part", time_limit=6, found=heard.append)
    assert value == "a part" and heard == [(process, value)]
    assert time.monotonic() - began < 60
    assert process != os.getpid() and not is_running(process)


def test_a_part_of_another_answer_comes_back_with_the_error() -> None:
    with pytest.raises(nag.TimeLimitError, match="time_limit: 6 s are over; `found`") as raised:
        tell_and_sleep_of_a_part("a part", time_limit=6)
    process, value = raised.value.found
    assert value == "a part" and not is_running(process)


def test_where_nothing_was_found_an_error_says_so() -> None:
    for call in (nag.decompose, nag.solve):
        with pytest.raises(nag.TimeLimitError, match="0 s are over; nothing was found") as raised:
            call(EQUATIONS, time_limit=0)
        assert raised.value.found is None


def test_errors_are_those_of_the_call_itself() -> None:
    with pytest.raises(nag.NagError, match="there are components 1 to 2"):
        nag.sample(EQUATIONS, 9, count=1, time_limit=300)
    with pytest.raises(nag.NagError, match="no start system 'none'"):
        nag.solve("x^2 - 2", start="none", time_limit=300)
    with pytest.raises(nag.NagError, match="ended from outside, with status 7"):
        end_at_once(time_limit=300)


@pytest.mark.parametrize("limit", [-1, "5", float("nan"), float("inf"), True])
def test_limits_that_are_no_seconds_are_refused(limit: Any) -> None:
    with pytest.raises(nag.NagError, match=r"time_limit: .* is given; give a number from 0 up"):
        nag.decompose(EQUATIONS, time_limit=limit)


def test_what_cannot_go_to_a_process_is_refused() -> None:
    with pytest.raises(nag.NagError, match="time_limit: what is given cannot be sent"):
        tell_and_sleep(lambda: None, time_limit=5)
