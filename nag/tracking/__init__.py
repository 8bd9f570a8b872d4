"""Homotopy path tracking: predictor, corrector, ends in as many digits as they need.

In order of reading: `run` and `settings`; `compiled`, `homotopy` and `projective` (what is
tracked); `taylor`
(values and series of a path) and `predictor`, `linear_algebra` and `newton_kernel` on
`kernel_arrays`; `straight_run` (many paths at once in doubles); `track` (their ends judged, by
`newton`) with `jumps` and `known` (what a start system says of them); `ends` (the doubtful ones,
followed in more digits, by `numbers`); `paths` (what is known in the end) and `evaluations` (what
it took). `close_paths` starts where doubles would lose them; `certified_paths` on `moving_discs`
proves. The numbers that decide something about an end stand in `nag.thresholds`.
"""
