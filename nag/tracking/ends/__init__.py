"""Ends of paths in as many digits as they need.

What a straight run in doubles leaves doubtful is followed in the logarithm of t, from a point where
it was safe. In order of reading, top-down: `follow` (the endgame: what becomes of the paths),
`runs` (batches of them), `end_run` (one step for eight paths, with `records`, `corrector`,
`log_series`, `linear_algebra`, `newton_steps`, `kept_points`, `branch`), `inclusion` (proof that an
end is regular), `limits` on `terms` (other ends, and whether the exact equations agree),
`at_infinity` and `initial_forms` (whether those at infinity are ends at all).
"""
