"""Homotopy path tracking: predictor, corrector, ends in as many digits as they need.

In order of reading, bottom-up: `run` and `settings`; `compiled`, `homotopy` and `projective` (what
is tracked); `kernel_arrays` (the tape that all kernels read), `numbers` (the arithmetics that they
are compiled for), `evaluation` and `linear_algebra` in any of these; `taylor` (series of a path)
and `predictor`, `newton_kernel`, `straight_run` (many paths at once in doubles); `track` (from
`starts`, their ends judged, by `newton`) with `jumps` and `known` (what a start system says of
them); `ends` (the endgame: the doubtful ones, followed in more digits, by `numbers`); `paths` (what
is known in the end) and `evaluations` (what it took). `close_paths` starts where doubles would lose
them; `certified_paths` on `moving_discs` proves. `blocks` (work found again in a `ledger`, or done
by an `executor`) is asked by `track` and `ends`; `timed_call` ends what takes too long.
`nag.thresholds` lists the numbers that decide something about an end; each is set in the file that
uses it.
"""
