"""Calls in processes of their own: the slow are ended, failures are told, nothing is lost."""

from __future__ import annotations

import os
import time

from nag.bench.timed_runs import timed_runs


def _work(task: object) -> object:
    if task == "slow":
        while True:
            sum(range(1000))
    if task == "fail":
        raise ValueError("no such thing")
    if task == "vanish":
        os._exit(3)
    if task == "wait":
        time.sleep(1.5)
    return task


def test_every_call_is_answered_by_its_value_or_by_what_became_of_it() -> None:
    tasks = [1, "slow", 2, "fail", "vanish", 3]
    runs = {run.task: run for run in timed_runs(_work, tasks, limit=0.5, first=0)}
    assert list(runs) == tasks
    assert [runs[k].value for k in (1, 2, 3)] == [1, 2, 3]
    assert [task for task in tasks if runs[task].slow] == ["slow", "vanish"]
    assert not runs["slow"].error and runs["slow"].seconds == 0.5
    assert runs["fail"].error == "ValueError: no such thing"
    assert runs["vanish"].error == "the process ended with 3"


def test_waiting_is_no_processor_time() -> None:
    (run,) = timed_runs(_work, ["wait"], limit=1.0)
    assert run.value == "wait" and run.seconds < 1.0


def test_several_processes_share_the_tasks() -> None:
    runs = list(timed_runs(_work, iter(range(20)), limit=1.0, jobs=3))
    assert sorted(run.value for run in runs) == list(range(20))
